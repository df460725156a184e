"""The reader of expressions: operands joined by operators, as tables of operators tell (V. Pratt, 1973).

A language gives its tables and says how its operands are read, which operator stands at its cursor, and what an
operator makes of its operands. Values `V` are what the language builds: code, or code with a type.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from sys import float_info

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import Generic, TypeVar
from polycnc.language.expressions import code, nodes
from polycnc.language.expressions.code import Code, Lifted
from polycnc.language.expressions.nodes import Kind

#: How deep an expression may be nested, in brackets, signs and operators; Python's own limit is not far.
MAX_DEPTH = 200
#: Power of signs: their operand holds no other operators.
TIGHTEST = 100

#: Operators whose results may be greater than both operands, and those that may count up by a number.
_GROWING, _COUNTING = (nodes.Add, nodes.Sub, nodes.Mult, nodes.Div), (nodes.Add, nodes.Sub)
_OVERFLOW = code.call("overflow")
_IN_RANGE = f"r if {-float_info.max!r} <= (r := {{0}}) <= {float_info.max!r} else overflow()"

V = TypeVar("V")
M = TypeVar("M")


class Operator(NamedTuple):
    """An operator as a row of a table.

    Attributes:
        power: How closely it binds; the greater, the closer. Operators of equal power work from left to right. Before
            an operand: the operand holds operators of greater power only.
        gives: Python's operator (a `Kind`), or the name of a function.
        family: Which operands it takes, in the language's own words.
    """

    power: int
    gives: Kind | str
    family: str = ""


class OperatorReader(ABC, Generic[M, V]):
    """Reads expressions; `M` is the operator's mark in the text, for alarms."""

    #: How deep the part that is being read is nested.
    depth = 0

    # ---- what a language says --------------------------------------------------------------------------------

    @abstractmethod
    def operand(self) -> V:
        """Read an operand without signs."""

    @abstractmethod
    def prefix_ahead(self) -> Operator | None:
        """The operator that stands before the next operand, unread."""

    @abstractmethod
    def infix_ahead(self) -> Operator | None:
        """The operator that stands behind the operand just read, unread."""

    @abstractmethod
    def take_operator(self) -> M:
        """Read the operator that was found ahead."""

    @abstractmethod
    def signed(self, operator: Operator, mark: M, operand: V) -> V:
        """The value of an operator before its operand."""

    @abstractmethod
    def joined(self, operator: Operator, mark: M, left: V, right: V) -> V:
        """The value of an operator between two operands."""

    @abstractmethod
    def too_deep(self) -> Exception:
        """The alarm for an expression that is nested too deeply."""

    # ---- reading -----------------------------------------------------------------------------------------------

    def expression(self, power: int = 0) -> V:
        """Read an operand and all operators behind it that bind more closely than `power`."""
        depth = self.depth
        self._deeper()
        operator = self.prefix_ahead()
        if operator is None:
            left = self.operand()
        else:
            mark = self.take_operator()
            left = self.signed(operator, mark, self.expression(operator.power))
        while (operator := self.infix_ahead()) is not None and operator.power > power:
            mark = self.take_operator()
            self._deeper()
            left = self.joined(operator, mark, left, self.expression(operator.power))
        self.depth = depth
        return left

    def _deeper(self) -> None:
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise self.too_deep()


def applied(gives: Kind | str, left: Code, right: Code) -> Code:
    """The code of an operator with its operands."""
    if not isinstance(gives, Kind):
        return code.call(gives, left, right)
    if gives in nodes.COMPARISONS:
        return code.compared(left, gives, right)
    return code.either(gives, left, right) if gives in nodes.LOGIC else code.binary(gives, left, right)


def calculated(gives: Kind | str, left: Code, right: Code) -> Code:
    """The code of an operator between numbers; `overflow()` is called where its result is not finite.

    A chain of operators is asked at its end: what has left the range on its left does not come back. A sum is not asked
    for a number of the block, which leads nothing out of the range. The namespace of the code has `overflow`.
    """
    if gives not in _GROWING:
        return applied(gives, left, right)
    chain = checked_value(left)
    result = applied(gives, chain or left, right)
    counts = gives in _COUNTING and (isinstance(left, Lifted) or isinstance(right, Lifted))
    return result if counts and chain is None else code.quoted(_IN_RANGE, result)


def overflow() -> None:
    """The result of a calculation is no number of the control: `Control.arithmetic_alarm` says its alarm.

    Raises:
        OverflowError: Always.
    """
    raise OverflowError


def checked_value(value: Code) -> Code | None:
    """What is asked whether it is finite; None for any other code."""
    test = value[1] if value.kind == nodes.IfExp and value[3] == _OVERFLOW else None
    if not isinstance(test, Code) or not isinstance(test[3], tuple):
        return None
    result = test[3][0][2]
    assert isinstance(result, Code)
    return result


def applied_to_one(gives: Kind | str, operand: Code) -> Code:
    """The code of an operator before its operand."""
    if not isinstance(gives, Kind):
        return code.call(gives, operand)
    return code.unary(gives, operand)
