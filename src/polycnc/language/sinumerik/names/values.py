"""Data types of the NC language and the conversions between them (job planning 1.1.13, 1.8).

Values inside are plain Python values: INT `int`, REAL `float`, BOOL `bool`, CHAR `int` (the code), STRING
`str`, AXIS `Axis`, FRAME `NcFrame`. The type of an expression is known when its block is compiled.
"""

from __future__ import annotations

from enum import Enum
from math import floor

from polycnc.deferred.records import dataclass
from polycnc.memory.encoding import encoded
from polycnc.messages import AlarmError

INT_MIN, INT_MAX = -(2**31), 2**31 - 1
MAX_STRING = 255


class Type(Enum):
    """A data type of the NC language."""

    INT = "INT"
    REAL = "REAL"
    BOOL = "BOOL"
    CHAR = "CHAR"
    STRING = "STRING"
    AXIS = "AXIS"
    FRAME = "FRAME"

    @property
    def is_number(self) -> bool:
        """Whether values of the type can be calculated with."""
        return self in _NUMBERS


_NUMBERS = (Type.INT, Type.REAL, Type.BOOL, Type.CHAR)


@encoded("axis")
@dataclass(frozen=True, slots=True)
class Axis:
    """An axis or spindle identifier as a value, in upper case."""

    name: str

    def __str__(self) -> str:
        return self.name


def round_half_up(value: float) -> int:
    """REAL to INT: a fraction from 0.5 on goes up (1.8). Alarm 12160 outside the range of INT."""
    result = floor(value + 0.5)
    if not INT_MIN <= result <= INT_MAX:
        raise AlarmError("12160", text=real_text(value))
    return result


def checked_int(value: int) -> int:
    """An INT result that is stored; alarm 12160 outside the range."""
    if not INT_MIN <= value <= INT_MAX:
        raise AlarmError("12160", text=str(value))
    return value


def checked_char(value: int) -> int:
    """A code that is stored as CHAR; alarm 12160 outside 0…255."""
    if not 0 <= value <= 255:
        raise AlarmError("12160", text=str(value))
    return value


def char_of_text(value: str) -> int:
    """STRING to CHAR: exactly one character, else alarm 14096."""
    if len(value) != 1:
        raise AlarmError("14096", text=value)
    return ord(value)


def real_text(value: float) -> str:
    """A REAL as text: up to 10 decimals, no trailing zeros (1.9.1)."""
    text = f"{value:.10f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def joined(*parts: str) -> str:
    """The `<<` operator; alarm 14099 if the result is longer than a string may be."""
    result = "".join(parts)
    if len(result) > MAX_STRING:
        raise AlarmError("14099", text=result[:32])
    return result
