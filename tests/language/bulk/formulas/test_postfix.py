"""Code of expressions as operations on a stack."""

from __future__ import annotations

import pytest

from polycnc.control.registry import control
from polycnc.control.word_address.control import WordAddressControl
from polycnc.language.bulk.formulas.postfix import formulas
from polycnc.language.bulk.layout import STACK, Operation
from polycnc.language.expressions import nodes
from polycnc.language.expressions.code import Lifted, binary, call
from polycnc.language.word_address.executable import BlockReader

N, V, Z = Operation.NUMBER, Operation.VARIABLE, Operation.VARIABLE_OR_ZERO


def of(text: str) -> tuple[int, ...] | None:
    fanuc = control("fanuc-m")
    assert isinstance(fanuc, WordAddressControl)
    reader = BlockReader(text, fanuc.grammar, text)
    code = reader.factor()
    return formulas([(4, code)], {i: i for i in range(len(reader.numbers))})


@pytest.mark.parametrize(
    ("text", "operations"),
    [
        ("#1", (V, 0)),
        ("[#1]", (V, 0)),
        ("-#1", (Z, 0, Operation.NEGATIVE, 0)),
        ("+#1", (Z, 0)),
        ("[1+2*#3]", (N, 0, N, 1, Z, 2, Operation.MULTIPLY, 0, Operation.ADD, 0)),
        ("[[1-#2]/3]", (N, 0, Z, 1, Operation.SUBTRACT, 0, N, 2, Operation.DIVIDE, 0)),
        ("[SIN[#500]]", (Z, 0, Operation.SIN, 0)),
        ("[TAN[1]]", (N, 0, Operation.TANGENT, 0)),
        ("[ASIN[1]]", (N, 0, Operation.ASIN, 0, Operation.TURN, 0)),
        ("[ACOS[1]]", (N, 0, Operation.ACOS, 0)),
        ("[ATAN[1]]", (N, 0, Operation.ATAN, 0)),
        ("[ATAN[1]/[#2]]", (N, 0, Z, 1, Operation.ATAN2, 0, Operation.TURN, 0)),
        ("[ATAN[1,2]]", (N, 0, N, 1, Operation.ATAN2, 0, Operation.TURN, 0)),
        ("[ROUND[1]]", (N, 0, Operation.HALF_AWAY, 0)),
        ("[1MOD2]", (N, 0, N, 1, Operation.MODULO, 0)),
        ("[1AND2]", (N, 0, N, 1, Operation.BITS_AND, 0)),
        ("[1OR2]", (N, 0, N, 1, Operation.BITS_OR, 0)),
        ("[1XOR2]", (N, 0, N, 1, Operation.BITS_XOR, 0)),
        ("#[1]", (N, 0, Operation.NUMBERED, 0)),
        ("[#[#1]+1]", (Z, 0, Operation.NUMBERED_OR_ZERO, 0, N, 1, Operation.ADD, 0)),
        (
            "[1*2*3*4]",
            (N, 0, N, 1, Operation.MULTIPLY, 0, N, 2, Operation.MULTIPLY, 0, N, 3, Operation.MULTIPLY, 0),
        ),
    ],
)
def test_operands_come_first(text: str, operations: tuple[int, ...]) -> None:
    assert of(text) == (*operations, Operation.STORE, 4)


@pytest.mark.parametrize(
    "text", ["#5001", "#[#5001]", "[LN[1]]", "[EXP[1]]", "[BIN[1]]", "[POW[1,2]]", "[PRM[1]]", "[1MOD#5001]"]
)
def test_what_the_scanner_does_not_calculate_is_none(text: str) -> None:
    assert of(text) is None


def test_more_values_than_have_room_are_none() -> None:
    deep = Lifted("n", 0)
    code = binary(nodes.Mult, deep, deep)
    for _ in range(STACK):
        code = binary(nodes.Mult, deep, code)
    assert formulas([(0, code)], {0: 0}) is None
    assert formulas([(0, call("unknown", deep, deep))], {0: 0}) is None
