"""Values of the SYNTEC macro language: Long is `int`, Double `float`, text `Text`, no value `VACANT`.

The type of a value decides what operators do (Long / Long drops the fraction) and how a word is read (a Long
counts least input units), so it is kept through every operation. Arithmetic and order count VACANT as zero;
`=` does not.
"""

from __future__ import annotations

from math import isfinite, trunc

from polycnc.deferred.typing import TypeAlias
from polycnc.messages import AlarmError

DOMAIN = "COR-004"
WRONG_TYPE = "COR-023"
TYPE_MISMATCH = "COR-054"
LONG_MIN, LONG_MAX = -(2**31), 2**31 - 1


class Vacant:
    """The value of a variable that has none. There is one object of this class, `VACANT`."""

    __slots__ = ()

    def __repr__(self) -> str:
        return "VACANT"

    def __bool__(self) -> bool:
        return False

    def __neg__(self) -> int:
        return 0

    def __add__(self, other: Number) -> Number:
        return 0 + other

    def __radd__(self, other: Number) -> Number:
        return other + 0

    def __sub__(self, other: Number) -> Number:
        return 0 - other

    def __rsub__(self, other: Number) -> Number:
        return other - 0

    def __mul__(self, other: Number) -> Number:
        return 0 * other

    def __rmul__(self, other: Number) -> Number:
        return other * 0

    def __lt__(self, other: Number) -> bool:
        return other > 0

    def __le__(self, other: Number) -> bool:
        return other >= 0

    def __gt__(self, other: Number) -> bool:
        return other < 0

    def __ge__(self, other: Number) -> bool:
        return other <= 0


VACANT = Vacant()


class Text(str):
    """A text value. It can be stored, passed and compared, but not calculated with."""

    __slots__ = ()

    def _refuse(self, *_: object) -> int:
        raise AlarmError(WRONG_TYPE, hint="hint.syntec.text-in-calculation")

    __neg__ = __radd__ = __sub__ = __rsub__ = _refuse
    __add__ = __mul__ = __rmul__ = _refuse  # type: ignore[assignment]
    __lt__ = __le__ = __gt__ = __ge__ = _refuse  # type: ignore[assignment]


Number: TypeAlias = int | float | Vacant
Value: TypeAlias = int | float | Text | Vacant


def number(value: Value) -> int | float:
    """A value to calculate with; VACANT counts as zero."""
    if isinstance(value, Vacant):
        return 0
    if isinstance(value, Text):
        raise AlarmError(WRONG_TYPE, hint="hint.syntec.text-in-calculation")
    return value


def bits(value: Value) -> int:
    """A Long for operators that work on bits; a Double is a type mismatch."""
    value = number(value)
    if isinstance(value, float):
        raise AlarmError(TYPE_MISMATCH)
    return value


def whole(value: Value, code: str) -> int:
    """A value without fraction as an int, whatever its type; else the alarm `code`."""
    if isinstance(value, Vacant | Text) or (isinstance(value, float) and not value.is_integer()):
        raise AlarmError(code)
    return int(value)


def is_true(value: Value) -> bool:
    """Whether a condition holds: its value is not zero."""
    return bool(number(value))


def divide(a: Value, b: Value) -> int | float:
    """`/`: of two Longs a Long, the fraction dropped (towards zero); else a Double."""
    a, b = number(a), number(b)
    if b == 0:
        raise AlarmError(DOMAIN, hint="hint.syntec.division-by-zero")
    if isinstance(a, int) and isinstance(b, int):
        return a // b if (a < 0) == (b < 0) else -(-a // b)
    return a / b


def modulo(a: Value, b: Value) -> int:
    """`MOD` of two Longs, with the sign of the dividend; a Double is a type mismatch."""
    x, y = bits(a), bits(b)
    if y == 0:
        raise AlarmError(DOMAIN, hint="hint.syntec.division-by-zero")
    return x - y * int(divide(x, y))


def bit_and(a: Value, b: Value) -> int:
    """`AND`, `&`."""
    return bits(a) & bits(b)


def bit_or(a: Value, b: Value) -> int:
    """`OR`."""
    return bits(a) | bits(b)


def bit_xor(a: Value, b: Value) -> int:
    """`XOR`."""
    return bits(a) ^ bits(b)


def bit_not(a: Value) -> int:
    """`NOT`: every bit turned over, -(x + 1); it is no logical negation."""
    return ~bits(a)


def storable(value: Value) -> Value:
    """A value that a variable can hold: a Long of 32 bits, a finite Double, a text, VACANT."""
    if isinstance(value, int) and not LONG_MIN <= value <= LONG_MAX:
        raise AlarmError(DOMAIN, hint="hint.syntec.overflow")
    if isinstance(value, float) and not isfinite(value):
        raise AlarmError(DOMAIN, hint="hint.syntec.overflow")
    return value


def to_long(value: Value) -> int:
    """A value as a register of 32 bits holds it: the fraction is dropped."""
    result = number(value)
    return int(storable(trunc(result) if isinstance(result, float) and isfinite(result) else result))  # type: ignore[arg-type]
