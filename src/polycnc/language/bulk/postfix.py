"""From the code of expressions to what the scanner calculates: operations on a stack, operands first."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from polycnc.language.bulk.layout import STACK, Operation
from polycnc.language.expressions.code import Code, Lifted, constant
from polycnc.language.expressions.operators import checked_value

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

_ZERO = constant(0.0)
_OPERATORS = {
    ast.Add: Operation.ADD,
    ast.Sub: Operation.SUBTRACT,
    ast.Mult: Operation.MULTIPLY,
    ast.Div: Operation.DIVIDE,
}
#: By their names in generated code; each gets the memory and a number.
_FUNCTIONS = {
    "sin_": Operation.SIN,
    "cos_": Operation.COS,
    "sqrt_": Operation.SQRT,
    "abs_": Operation.ABS,
    "fix_": Operation.FIX,
    "fup_": Operation.FUP,
}


class _OtherError(Exception):
    """Code that the scanner does not calculate."""


def formulas(words: Iterable[tuple[int, Code]], literals: Mapping[int, int]) -> tuple[int, ...] | None:
    """Pairs of operation and argument; None where the interpreter must calculate.

    Args:
        words: Indices of values, and the code of each.
        literals: Lifted numbers of the code, by the order in which they stand in formulas of the block.
    """
    done: list[int] = []
    try:
        for slot, code in words:
            if _put(code, literals, done) > STACK:
                return None
            done += (Operation.STORE, slot)
    except _OtherError:
        return None
    return tuple(done)


def _put(code: Code, literals: Mapping[int, int], done: list[int]) -> int:
    """Add the operations of code; gives how many values they need at a time."""
    checked = checked_value(code)
    if checked is not None:
        return _put(checked, literals, done)
    if isinstance(code, Lifted):
        done += (Operation.NUMBER, literals[code.place])
        return 1
    if code.kind is ast.Subscript:
        done += (Operation.VARIABLE, _variable(code, literals))
        return 1
    if code.kind is ast.BoolOp:
        return _put_or_zero(code, literals, done)
    if code.kind is ast.BinOp:
        _, left, operator, right = code
        assert isinstance(left, Code)
        assert isinstance(right, Code)
        depth = max(_put(left, literals, done), 1 + _put(right, literals, done))
        done += (_OPERATORS.get(operator) or _other(), 0)  # type: ignore[call-overload]
        return depth
    return _put_applied(code, literals, done)


def _put_or_zero(code: Code, literals: Mapping[int, int], done: list[int]) -> int:
    """A variable that counts as zero while it is vacant."""
    parts = code[2]
    assert isinstance(parts, tuple)
    if code[1] is not ast.Or or parts[0].kind is not ast.Subscript or parts[1] != _ZERO:
        raise _OtherError
    done += (Operation.VARIABLE_OR_ZERO, _variable(parts[0], literals))
    return 1


def _put_applied(code: Code, literals: Mapping[int, int], done: list[int]) -> int:
    """A sign or a function."""
    if code.kind is ast.UnaryOp and code[1] in (ast.USub, ast.UAdd):
        operand, operation = code[2], Operation.NEGATIVE if code[1] is ast.USub else None
    elif code.kind is ast.Call and isinstance(code[2], tuple) and len(code[2]) == 2:
        function = code[1]
        name = function[1] if isinstance(function, Code) and function.kind is ast.Name else None
        operand, operation = code[2][1], _FUNCTIONS.get(str(name)) or _other()
    else:
        raise _OtherError
    assert isinstance(operand, Code)
    depth = _put(operand, literals, done)
    if operation is not None:
        done += (operation, 0)
    return depth


def _variable(code: Code, literals: Mapping[int, int]) -> int:
    """Where the number of a variable stands that lies in the memory."""
    base, index = code[1], code[2]
    if not (isinstance(base, Code) and base.kind is ast.Attribute and isinstance(index, Lifted)):
        raise _OtherError
    return literals[index.place]


def _other() -> int:
    raise _OtherError
