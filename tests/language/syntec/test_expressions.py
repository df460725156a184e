from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.language.syntec.expressions import Reader, syntec_shapes
from polycnc.language.syntec.tokens import tokenize
from polycnc.language.syntec.values import VACANT, divide, modulo
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable


class Memory:
    """Variables in two dictionaries."""

    def __init__(self) -> None:
        self.locals: dict[int, Any] = {1: 3, 2: 2.5, 3: 1}
        self.globals: dict[int, Any] = {7: 70}
        self.functions: dict[str, Callable[..., Any]] = {"AXID": lambda name: {"Y": 2}.get(name, VACANT)}

    def variable(self, index: Any) -> Any:
        return self.locals.get(index, VACANT)

    def register(self, index: Any) -> Any:
        return self.globals.get(index, VACANT)


def value(text: str) -> Any:
    reader = Reader(tokenize([text], macro=True), syntec_shapes())
    evaluate = reader.evaluator(reader.expression())
    assert reader.token.kind == "end"
    channel: Any = SimpleNamespace(memory=Memory())
    return evaluate(channel)


@pytest.mark.parametrize(
    ("text", "result"),
    [
        ("2+3*4", 14),
        ("(2+3)*4", 20),
        ("-2*-3", 6),
        ("- -2", 2),
        ("10/4*2", 4),
        ("10/4.*2", 5.0),
        ("#1+#[#3]", 6),
        ("#[#[#3]]", 1),
        ("@7/2", 35),
        ("#9=#0", 1),
        ("#9=0", 0),
        ("1<2=1", 1),
        ("1=1<>0", 1),
        ("2 OR 1 AND 0", 2),
        ("1 XOR 3 OR 4", 6),
        ("NOT 0 AND 6", 6),
        ("0x10+1", 17),
        ("AXID(Y)*2", 4),
        ("AXID(Q)=#0", 1),
        ("SQRT(16)+ABS(-3)", 7.0),
        ("ROUND(2.5)/2", 1),
        ('"AB"="AB"', 1),
    ],
)
def test_expressions_give_what_the_reference_says(text: str, result: float) -> None:
    assert value(text) == result
    assert type(value(text)) is type(result)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("1+", "COM-003"),
        ("(1", "COM-003"),
        ("[1]", "COM-003"),
        ("SIN()", "COM-003"),
        ("SIN(1,2)", "COM-003"),
        ("X", "COM-003"),
        ("(" * 200 + "1" + ")" * 200, "COM-005"),
        ("-" * 300 + "#1", "COM-005"),
        ("1" + " AND 1" * 250, "COM-005"),
        ("1" + "+1" * 5000, "COM-005"),
        ("SQRT(-1)", "COR-004"),
        ("TAN(90)", "COR-004"),
        ("ASIN(2)", "COR-004"),
        ("LN(0)", "COR-004"),
        ("POW(0,-1)", "COR-004"),
        ("READDI(1)", "PC0001"),
        ("AR[1]", "COR-016"),
        ('1+"2"', "COR-023"),
        ("1234567890123456789", "COM-003"),
    ],
)
def test_what_has_no_value_is_an_alarm(text: str, code: str) -> None:
    with pytest.raises(AlarmError, match=code):
        value(text)


def test_expressions_of_one_shape_share_one_function() -> None:
    shapes = syntec_shapes()
    for text in ("#11*2.5+SIN(30)", "#12*9+SIN(45.5)"):
        reader = Reader(tokenize([text], macro=True), shapes)
        reader.evaluator(reader.expression())
    assert len(shapes) == 1


Tree = Any
NUMBERS = st.one_of(st.integers(0, 999), st.floats(0, 999).map(lambda x: round(x, 3)))
TREES: st.SearchStrategy[Tree] = st.recursive(
    NUMBERS, lambda inner: st.tuples(st.sampled_from("+-*/<="), inner, inner), max_leaves=12
)


def written(tree: Tree) -> str:
    if isinstance(tree, tuple):
        return f"({written(tree[1])}{tree[0]}{written(tree[2])})"
    return f"{tree:.3f}" if isinstance(tree, float) else str(tree)


def worked_out(tree: Tree) -> Any:
    if not isinstance(tree, tuple):
        return tree
    operator, a, b = tree[0], worked_out(tree[1]), worked_out(tree[2])
    if operator == "/":
        return divide(a, b)
    return {"+": a + b, "-": a - b, "*": a * b, "<": int(a < b), "=": int(a == b)}[operator]


@given(TREES)
def test_brackets_make_any_tree_of_operators_readable(tree: Tree) -> None:
    try:
        expected = worked_out(tree)
    except AlarmError:
        with pytest.raises(AlarmError):
            value(written(tree))
        return
    assert value(written(tree)) == pytest.approx(expected)


@given(st.lists(st.tuples(st.sampled_from("+-*"), st.integers(0, 99)), max_size=20), st.integers(0, 99))
def test_without_brackets_products_bind_closer_than_sums(rest: list[tuple[str, int]], first: int) -> None:
    text = str(first) + "".join(f"{operator}{number}" for operator, number in rest)
    assert value(text) == eval(text)


@given(st.lists(st.integers(1, 99), min_size=2, max_size=8))
def test_equal_ranks_go_from_left_to_right(numbers: list[int]) -> None:
    expected: Any = numbers[0]
    for i, number in enumerate(numbers[1:]):
        expected = modulo(expected, number) if i % 2 else divide(expected, number)
    text = str(numbers[0]) + "".join(f"{' MOD ' if i % 2 else '/'}{n}" for i, n in enumerate(numbers[1:]))
    assert value(text) == expected
