"""From the code of expressions to what the scanner calculates: operations on a stack, operands first."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk.layout import STACK, Operation
from polycnc.language.expressions import nodes
from polycnc.language.expressions.code import Code, Lifted, constant, dotted
from polycnc.language.expressions.operators import checked_value

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

_ZERO, _READ, _READ_INDIRECT = constant(0.0), dotted("m.read"), dotted("m.read_indirect")
_OPERATORS = {
    nodes.Add: Operation.ADD,
    nodes.Sub: Operation.SUBTRACT,
    nodes.Mult: Operation.MULTIPLY,
    nodes.Div: Operation.DIVIDE,
}
_COMPARISONS: dict[object, int] = {
    nodes.Gt: Operation.GREATER,
    nodes.GtE: Operation.GREATER_OR_EQUAL,
    nodes.Lt: Operation.LESS,
    nodes.LtE: Operation.LESS_OR_EQUAL,
}
#: By their names too; they tell a vacant variable from zero.
_EQUALITIES: dict[object, int] = {"eq_": Operation.EQUAL, "ne_": Operation.NOT_EQUAL}
#: By their names in generated code; each gets the memory and a number.
_FUNCTIONS = {
    "sin_": Operation.SIN,
    "cos_": Operation.COS,
    "sqrt_": Operation.SQRT,
    "abs_": Operation.ABS,
    "fix_": Operation.FIX,
    "fup_": Operation.FUP,
    "tan_": Operation.TANGENT,
    "acos_": Operation.ACOS,
    "round_": Operation.HALF_AWAY,
    "asin_": Operation.ASIN,
    "atan_": Operation.ATAN,
}
#: Operators by their names, without the memory.
_NAMED_OPERATORS = {
    "mod_": Operation.MODULO,
    "and_": Operation.BITS_AND,
    "or_": Operation.BITS_OR,
    "xor_": Operation.BITS_XOR,
}


class OtherError(Exception):
    """Code that the scanner does not calculate."""


def formulas(
    words: Iterable[tuple[int, Code]], literals: Mapping[int, int], *, within_turn: bool = True
) -> tuple[int, ...] | None:
    """Pairs of operation and argument; None where the interpreter must calculate.

    Args:
        words: Indices of values, and the code of each.
        literals: Lifted numbers of the code, by the order in which they stand in formulas of the block.
        within_turn: Angles of arc functions are not below zero.
    """
    postfix = Postfix(literals, within_turn=within_turn)
    try:
        for slot, code in words:
            postfix.value(code)
            postfix.done += (Operation.STORE, slot)
    except OtherError:
        return None
    return tuple(postfix.done)


class Postfix:
    """Operations of one or more pieces of code.

    Args:
        literals: Lifted numbers of the code, by the order in which they stand among the numbers at hand.
        numbers: These, where vacant variables mean something: #0 is known by its number.
        within_turn: Angles of arc functions are not below zero.

    Attributes:
        done: Pairs of operation and argument so far.
    """

    def __init__(
        self, literals: Mapping[int, int], numbers: Sequence[float] = (), *, within_turn: bool = True
    ) -> None:
        self._literals = literals
        self._numbers = numbers
        self._within_turn = within_turn
        self.done: list[int] = []

    def value(self, code: Code) -> None:
        """Add what leaves the value of code on the stack.

        Raises:
            OtherError: It is the interpreter's.
        """
        if self._put(code) > STACK:
            raise OtherError

    def condition(self, code: Code) -> None:
        """Add what leaves 1 on the stack where a condition holds, else 0; as `value`."""
        if code.kind == nodes.Compare:
            operands, operation = (code[1], *_parts(code[3])), _COMPARISONS.get(_parts(code[2])[0])
        else:
            operands, operation = _operands(code), _EQUALITIES.get(_called(code))
        if operation is None:
            raise OtherError
        left, right = operands
        assert isinstance(left, Code)
        assert isinstance(right, Code)
        if max(self._put_any(left), 1 + self._put_any(right)) > STACK:
            raise OtherError
        self.done += (operation, 0)

    def assignment(self, code: Code) -> None:
        """Add what gives a variable a value; as `value`."""
        (target,), value = _parts(code[1]), code[2]
        assert isinstance(target, Code)
        assert isinstance(value, Code)
        if self._put_any(value) > STACK:
            raise OtherError
        self.done += (Operation.ASSIGN, self._variable(target))

    def numbered_assignment(self, value: Code) -> None:
        """Add what gives the variable whose number is on the stack a value; as `value`."""
        if 1 + self._put_any(value) > STACK:
            raise OtherError
        self.done += (Operation.ASSIGN_NUMBERED, 0)

    def _put_any(self, code: Code) -> int:
        """A value that may be vacant."""
        if code.kind == nodes.Subscript:
            self.done += (Operation.VARIABLE_OR_VACANT, self._variable(code))
            return 1
        if code.kind == nodes.Call and code[1] == _READ and isinstance(code[2], tuple):
            number = code[2][0]
            if isinstance(number, Lifted) and self._numbers and self._numbers[number.place] == 0:
                self.done += (Operation.VACANT, 0)
                return 1
        if (number := _indirect(code)) is not None:
            depth = self._put(number)
            self.done += (Operation.NUMBERED_OR_VACANT, 0)
            return depth
        return self._put(code)

    def _put(self, code: Code) -> int:
        """Add the operations of code; gives how many values they need at a time."""
        checked = checked_value(code)
        if checked is not None:
            return self._put(checked)
        if isinstance(code, Lifted):
            self.done += (Operation.NUMBER, self._literals[code.place])
            return 1
        if code.kind == nodes.Subscript:
            self.done += (Operation.VARIABLE, self._variable(code))
            return 1
        if code.kind == nodes.BoolOp:
            return self._put_or_zero(code)
        if code.kind == nodes.BinOp:
            _, left, operator, right = code
            assert isinstance(left, Code)
            assert isinstance(right, Code)
            depth = max(self._put(left), 1 + self._put(right))
            self.done += (_OPERATORS.get(operator) or _other(), 0)  # type: ignore[call-overload]
            return depth
        return self._put_applied(code)

    def _put_or_zero(self, code: Code) -> int:
        """A variable that counts as zero while it is vacant."""
        parts = code[2]
        assert isinstance(parts, tuple)
        if code[1] != nodes.Or or parts[1] != _ZERO:
            raise OtherError
        if (number := _indirect(parts[0])) is not None:
            depth = self._put(number)
            self.done += (Operation.NUMBERED_OR_ZERO, 0)
            return depth
        if parts[0].kind != nodes.Subscript:
            raise OtherError
        self.done += (Operation.VARIABLE_OR_ZERO, self._variable(parts[0]))
        return 1

    def _put_applied(self, code: Code) -> int:
        """A sign, a function, an operator by its name, a variable by its number."""
        if (number := _indirect(code)) is not None:
            depth = self._put(number)
            self.done += (Operation.NUMBERED, 0)
            return depth
        name = _called(code)
        operands = _operands(code)
        if len(operands) == 2 and name in _NAMED_OPERATORS:
            return self._put_two(operands, _NAMED_OPERATORS[name])
        if len(operands) == 3 and name == "atan_":
            depth = self._put_two(operands[1:], Operation.ATAN2)
            self._turn()
            return depth
        if code.kind == nodes.UnaryOp and code[1] in (nodes.USub, nodes.UAdd):
            operand, operation = code[2], Operation.NEGATIVE if code[1] == nodes.USub else None
        elif code.kind == nodes.Call and isinstance(code[2], tuple) and len(code[2]) == 2:
            operand, operation = code[2][1], _FUNCTIONS.get(name) or _other()
        else:
            raise OtherError
        assert isinstance(operand, Code)
        depth = self._put(operand)
        if operation is not None:
            self.done += (operation, 0)
        if operation == Operation.ASIN:
            self._turn()
        return depth

    def _put_two(self, operands: Sequence[object], operation: int) -> int:
        left, right = operands
        assert isinstance(left, Code)
        assert isinstance(right, Code)
        depth = max(self._put(left), 1 + self._put(right))
        self.done += (operation, 0)
        return depth

    def _turn(self) -> None:
        if self._within_turn:
            self.done += (Operation.TURN, 0)

    def _variable(self, code: Code) -> int:
        """Where the number of a variable stands that lies in the memory."""
        base, index = code[1], code[2]
        if not (isinstance(base, Code) and base.kind == nodes.Attribute and isinstance(index, Lifted)):
            raise OtherError
        return self._literals[index.place]


def _called(code: Code) -> str:
    """The name of the function that code calls; empty where it calls none by its name."""
    function = code[1] if code.kind == nodes.Call else None
    return str(function[1]) if isinstance(function, Code) and function.kind == nodes.Name else ""


def _operands(code: Code) -> tuple[object, ...]:
    return _parts(code[2]) if code.kind == nodes.Call else ()


def _indirect(code: object) -> Code | None:
    """The number in `#[…]`; None for any other code."""
    if not isinstance(code, Code) or code.kind != nodes.Call or code[1] != _READ_INDIRECT:
        return None
    number = _parts(code[2])[0]
    assert isinstance(number, Code)
    return number


def _parts(field: object) -> tuple[object, ...]:
    return field if isinstance(field, tuple) else ()


def _other() -> int:
    raise OtherError
