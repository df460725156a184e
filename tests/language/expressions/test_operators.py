"""The reader of expressions, with a table of its own, held against brackets set by hand."""

from __future__ import annotations

import ast
from typing import cast

import pytest

from polycnc.language.expressions import code, nodes
from polycnc.language.expressions.code import Lifted
from polycnc.language.expressions.operators import (
    MAX_DEPTH,
    TIGHTEST,
    Operator,
    OperatorReader,
    applied,
    calculated,
    overflow,
)

INFIX = {
    "=": Operator(1, nodes.Eq),
    "+": Operator(2, nodes.Add),
    "-": Operator(2, nodes.Sub),
    "*": Operator(3, nodes.Mult),
}
PREFIX = {"-": Operator(TIGHTEST, nodes.USub), "~": Operator(1, nodes.Invert)}


class Letters(OperatorReader[str, str]):
    """Every character is a token; values are texts with all brackets."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.left = list(text)

    def operand(self) -> str:
        return self.left.pop(0)

    def prefix_ahead(self) -> Operator | None:
        return PREFIX.get(self.left[0])

    def infix_ahead(self) -> Operator | None:
        return INFIX.get(self.left[0]) if self.left else None

    def take_operator(self) -> str:
        return self.left.pop(0)

    def signed(self, _operator: Operator, mark: str, operand: str) -> str:
        return f"({mark}{operand})"

    def joined(self, _operator: Operator, mark: str, left: str, right: str) -> str:
        return f"({left}{mark}{right})"

    def too_deep(self) -> Exception:
        return OverflowError()


@pytest.mark.parametrize(
    ("text", "bracketed"),
    [
        ("a", "a"),
        ("a+b*c", "(a+(b*c))"),
        ("a*b+c", "((a*b)+c)"),
        ("a-b-c", "((a-b)-c)"),
        ("a=b+c=d", "((a=(b+c))=d)"),
        ("-a*b", "((-a)*b)"),
        ("--a", "(-(-a))"),
        ("~a+b=c", "((~(a+b))=c)"),
        ("a+~b*c=d", "((a+(~(b*c)))=d)"),
    ],
)
def test_operators_bind_as_their_table_says(text: str, bracketed: str) -> None:
    assert Letters(text).expression() == bracketed


def test_operators_that_bind_less_closely_are_left_unread() -> None:
    reader = Letters("a*b+c")
    assert reader.expression(2) == "(a*b)"
    assert reader.left == ["+", "c"]


@pytest.mark.parametrize("text", ["-" * MAX_DEPTH + "a", "a" + "+a" * MAX_DEPTH])
def test_an_expression_that_is_nested_too_deeply_is_refused(text: str) -> None:
    with pytest.raises(OverflowError):
        Letters(text).expression()
    assert Letters(text[-2 * (MAX_DEPTH // 2) + 1 :]).expression()


A, B = Lifted("n", 0), code.name("b")


def test_a_chain_of_operators_is_asked_once_whether_it_is_finite() -> None:
    product = calculated(nodes.Mult, B, B)
    chain = calculated(nodes.Add, calculated(nodes.Div, product, A), B)
    assert ast.unparse(code.node(chain)).count("overflow()") == 1
    assert ast.unparse(code.node(calculated(nodes.Sub, B, product))).count("overflow()") == 2


def test_counting_by_a_number_of_the_block_is_not_asked() -> None:
    assert calculated(nodes.Add, B, A) == applied(nodes.Add, B, A)
    assert calculated(nodes.Gt, calculated(nodes.Mult, B, B), B).kind == nodes.Compare


@pytest.mark.parametrize(("gives", "value"), [(nodes.Mult, 1e200), (nodes.Add, 1.7e308), (nodes.Div, 1e-320)])
def test_a_result_that_is_not_finite_overflows(gives: nodes.Kind, value: float) -> None:
    left = B if gives != nodes.Div else code.constant(1.0)
    tree = ast.fix_missing_locations(ast.Expression(cast("ast.expr", code.node(calculated(gives, left, B)))))
    function = compile(tree, "", "eval")
    with pytest.raises(OverflowError):
        eval(function, {"b": value, "overflow": overflow})
    assert eval(function, {"b": 2.0, "overflow": overflow}) in {4.0, 0.5}
