"""Functions of the macro language: what exists, what each takes, and those that only calculate.

Functions that need the control (AXID, PARAM, ALARM …) are here by name only; the control's memory executes
them.
"""

from __future__ import annotations

import math

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import cos_sin_deg
from polycnc.language.syntec.values import DOMAIN, WRONG_TYPE, Text, Value, number
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

NEGATIVE_BASE = "COR-122"


@dataclass(frozen=True, slots=True)
class Function:
    """A function of the language.

    Attributes:
        least: Arguments that must be given.
        most: Arguments that may be given.
        names: Positions of arguments that are written as a name without quotes (`AXID(Y)`, `GETARG(X1)`).
        statement: It may stand alone as a statement.
        calculate: What it gives, where only its arguments decide.
    """

    least: int
    most: int
    names: frozenset[int] = frozenset()
    statement: bool = False
    calculate: Callable[..., Value] | None = None


def round_half_away(value: Value) -> int:
    """`ROUND`: the nearest Long, halves away from zero."""
    x = number(value)
    nearest = math.trunc(x)
    return nearest + (int(math.copysign(1, x)) if abs(x - nearest) >= 0.5 else 0)


def _ceil(value: Value) -> int:
    return math.ceil(number(value))


def _floor(value: Value) -> int:
    return math.floor(number(value))


def _sign(value: Value) -> int:
    x = number(value)
    return (x > 0) - (x < 0)


def _abs(value: Value) -> int | float:
    return abs(number(value))


def _domain(inside: bool) -> None:
    if not inside:
        raise AlarmError(DOMAIN)


def _sqrt(value: Value) -> float:
    x = number(value)
    _domain(x >= 0)
    return math.sqrt(x)


def _sin(value: Value) -> float:
    return cos_sin_deg(number(value))[1]


def _cos(value: Value) -> float:
    return cos_sin_deg(number(value))[0]


def _tan(value: Value) -> float:
    cos, sin = cos_sin_deg(number(value))
    _domain(cos != 0.0)
    return sin / cos


def _asin(value: Value) -> float:
    x = number(value)
    _domain(-1 <= x <= 1)
    return math.degrees(math.asin(x))


def _acos(value: Value) -> float:
    x = number(value)
    _domain(-1 <= x <= 1)
    return math.degrees(math.acos(x))


def _atan(value: Value) -> float:
    return math.degrees(math.atan(number(value)))


def _atan2(y: Value, x: Value) -> float:
    a, b = number(y), number(x)
    _domain(a != 0 or b != 0)
    return math.degrees(math.atan2(a, b))


def _pow(base: Value, exponent: Value) -> float:
    b, e = float(number(base)), float(number(exponent))
    if b < 0:
        raise AlarmError(NEGATIVE_BASE)
    _domain(b > 0 or e >= 0)
    return math.pow(b, e)


def _exp(value: Value) -> float:
    return math.exp(number(value))


def _ln(value: Value) -> float:
    x = number(value)
    _domain(x > 0)
    return math.log(x)


def _max(a: Value, b: Value) -> int | float:
    return max(number(a), number(b))


def _min(a: Value, b: Value) -> int | float:
    return min(number(a), number(b))


def _text_to_integer(value: Value) -> int:
    """`STR2INT`: the number a text begins with, its fraction dropped; a letter in it is an alarm."""
    if not isinstance(value, Text):
        raise AlarmError(WRONG_TYPE)
    try:
        result = float(value)
    except ValueError:
        result = math.nan
    if any(char.isalpha() for char in value) or not math.isfinite(result):
        raise AlarmError(WRONG_TYPE, text=str(value))
    return math.trunc(result)


def _calculated(count: int, calculate: Callable[..., Value]) -> Function:
    return Function(count, count, calculate=calculate)


def _queried(least: int, most: int | None = None, names: tuple[int, ...] = ()) -> Function:
    return Function(least, least if most is None else most, frozenset(names))


def _ordered(least: int, most: int | None = None) -> Function:
    return Function(least, least if most is None else most, statement=True)


FUNCTIONS: dict[str, Function] = {
    "ABS": _calculated(1, _abs),
    "SQRT": _calculated(1, _sqrt),
    "SIN": _calculated(1, _sin),
    "COS": _calculated(1, _cos),
    "TAN": _calculated(1, _tan),
    "ASIN": _calculated(1, _asin),
    "ACOS": _calculated(1, _acos),
    "ATAN": _calculated(1, _atan),
    "ATAN2": _calculated(2, _atan2),
    "POW": _calculated(2, _pow),
    "EXP": _calculated(1, _exp),
    "LN": _calculated(1, _ln),
    "MAX": _calculated(2, _max),
    "MIN": _calculated(2, _min),
    "SIGN": _calculated(1, _sign),
    "ROUND": _calculated(1, round_half_away),
    "CEIL": _calculated(1, _ceil),
    "FLOOR": _calculated(1, _floor),
    "STR2INT": _calculated(1, _text_to_integer),
    "RANDOM": _queried(0),
    "STD": _queried(1, 2),
    "STDAX": _queried(2, names=(1,)),
    "GETARG": _queried(1, names=(0,)),
    "GETTRAPARG": _queried(1, names=(0,)),
    "AXID": _queried(1, names=(0,)),
    "PARAM": _queried(1, 2),
    "SYSVAR": _queried(2),
    "SYSDATA": _queried(1),
    "DRVDATA": _queried(2),
    "GETPR": _queried(1, 2),
    "SETPR": _ordered(2),
    "SCANTEXT": _queried(1),
    "STKTOP": _queried(1),
    "PUSH": _ordered(1),
    "POP": _ordered(0),
    "READDI": _queried(1),
    "READDO": _queried(1),
    "READABIT": _queried(1),
    "READRREGBIT": _queried(2),
    "SETDO": _ordered(2),
    "SETABIT": _ordered(2),
    "SETRREGBIT": _ordered(3),
    "OPEN": _ordered(1, 2),
    "PRINT": _ordered(1),
    "CLOSE": _ordered(0),
    "DBOPEN": _ordered(1),
    "DBNEW": _ordered(1),
    "DBLOAD": _ordered(1),
    "DBSAVE": _ordered(1),
    "DBINSERT": _ordered(2),
    "DBDELETE": _ordered(1),
    "WAIT": _ordered(0),
    "SLEEP": _ordered(0),
    "ALARM": _ordered(1, 2),
    "MSG": _ordered(1, 2),
    "SETDRAW": _ordered(1, 3),
    "DRAWHOLE": _ordered(0),
    "CHKMN": _queried(1),
    "CHKSN": _queried(1),
    "CHKMT": _queried(1),
    "CHKMI": _queried(1),
    "CHKINF": _queried(2),
}
