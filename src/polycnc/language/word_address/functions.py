"""Functions and operators of custom macro B; angles in degrees. `m` is the memory whose parameters decide variants.

The memory offers `fail(name)` (the alarm for a mistake), `angle_range_signed` (6004#0 NAT) and `increment` (the least
increment of lengths in the program's unit).
"""

from __future__ import annotations

import math

from polycnc.deferred.typing import Any
from polycnc.geometry.frames import cos_sin_deg
from polycnc.language.expressions.operators import overflow

#: Results this close to the next integer count as it: what the control's decimal arithmetic gives.
GUARD = 1e-9


def round_half_away(x: float) -> float:
    """Nearest integer, halves away from zero, of the decimal value (1234.4999999999 from 1.2345 counts as a half)."""
    return math.copysign(math.floor(abs(x) * (1.0 + 1e-12) + 0.5 + GUARD), x) if x else 0.0


def sin_(_m: Any, x: float) -> float:
    """Sine."""
    return cos_sin_deg(x)[1] if x % 90.0 == 0.0 else math.sin(math.radians(x))


def cos_(_m: Any, x: float) -> float:
    """Cosine."""
    return cos_sin_deg(x)[0] if x % 90.0 == 0.0 else math.cos(math.radians(x))


def tan_(m: Any, x: float) -> float:
    """Tangent; an alarm at odd multiples of 90 degrees."""
    c, s = cos_sin_deg(x)
    if c == 0.0:
        raise m.fail("zero_divide")
    return s / c


def asin_(m: Any, x: float) -> float:
    """Arc sine: 270…360, 0…90, or -90…90 where the parameter says so."""
    if not -1.0 <= x <= 1.0:
        raise m.fail("argument_range")
    angle = math.degrees(math.asin(x))
    return angle if m.angle_range_signed or angle >= 0.0 else angle + 360.0


def acos_(m: Any, x: float) -> float:
    """Arc cosine: 0…180."""
    if not -1.0 <= x <= 1.0:
        raise m.fail("argument_range")
    return math.degrees(math.acos(x))


def atan_(m: Any, y: float, x: float | None = None) -> float:
    """Arc tangent: of one argument -90…90; of two the direction, 0…360 or -180…180 by parameter."""
    if x is None:
        return math.degrees(math.atan(y))
    angle = math.degrees(math.atan2(y, x))
    return angle if m.angle_range_signed or angle >= 0.0 else angle + 360.0


def sqrt_(m: Any, x: float) -> float:
    """Square root."""
    if x < 0.0:
        raise m.fail("argument_range")
    return math.sqrt(x)


def abs_(_m: Any, x: float) -> float:
    """Absolute value."""
    return abs(x)


def ln_(m: Any, x: float) -> float:
    """Natural logarithm."""
    if x <= 0.0:
        raise m.fail("argument_range")
    return math.log(x)


def exp_(_m: Any, x: float) -> float:
    """Exponential."""
    return math.exp(x)


def pow_(m: Any, base: float, exponent: float) -> float:
    """Power; a negative base needs a whole exponent."""
    if (base < 0.0 and exponent != int(exponent)) or (base == 0.0 and exponent < 0.0):
        raise m.fail("argument_range")
    return float(base**exponent)


def round_(_m: Any, x: float) -> float:
    """Nearest integer."""
    return round_half_away(x)


def round_increment_(m: Any, x: float) -> float:
    """Inside a word ROUND goes to the least increment."""
    return round_half_away(x / m.increment) * float(m.increment)


def fix_(_m: Any, x: float) -> float:
    """Integer part, toward zero."""
    return math.copysign(math.floor(abs(x) + GUARD), x) if x else 0.0


def fup_(_m: Any, x: float) -> float:
    """Next integer away from zero."""
    return math.copysign(math.ceil(abs(x) - GUARD), x) if x else 0.0


def bin_(m: Any, x: float) -> float:
    """Binary-coded decimal digits to a number: BIN[37] = 25."""
    digits = f"{_whole(m, x, MOST_BCD):x}"
    if not digits.isdigit():
        raise m.fail("argument_range")
    return float(int(digits))


def bcd_(m: Any, x: float) -> float:
    """A number to binary-coded decimal digits: BCD[25] = 37."""
    return float(int(str(_whole(m, x)), 16))


#: Eight decimal digits as binary-coded decimals.
MOST_BCD = 0x9999_9999


def _whole(m: Any, x: float, most: int = 99_999_999) -> int:
    if x < 0.0 or x > most:
        raise m.fail("argument_range")
    return int(round_half_away(x))


def _bits(x: float) -> int:
    return int(round_half_away(x))


def and_(a: float, b: float) -> float:
    """Bitwise AND of the integers."""
    return float(_bits(a) & _bits(b))


def or_(a: float, b: float) -> float:
    """Bitwise OR of the integers."""
    return float(_bits(a) | _bits(b))


def xor_(a: float, b: float) -> float:
    """Bitwise XOR of the integers."""
    return float(_bits(a) ^ _bits(b))


def mod_(a: float, b: float) -> float:
    """Remainder of the rounded integers, with the sign of `a`; `ZeroDivisionError` for b = 0."""
    x, y = _bits(a), _bits(b)
    return math.copysign(abs(x) % abs(y), x) if x else 0.0 * (1 // y)


def eq_(a: float | None, b: float | None) -> bool:
    """Equal; a vacant variable equals only a vacant one."""
    return a is b if a is None or b is None else a == b


def ne_(a: float | None, b: float | None) -> bool:
    """Not equal."""
    return not eq_(a, b)


def joined_(m: Any, left: bool, operator: str, right: bool) -> bool:
    """Conditions joined by AND, OR, XOR, where the control allows it."""
    if not m.joined_conditions:
        raise m.fail("condition", hint=m.joining_hint)
    return {"and": left and right, "or": left or right, "xor": left is not right}[operator]


#: What generated code may call.
NAMESPACE: dict[str, object] = {name: value for name, value in globals().items() if name.endswith("_")} | {
    "__builtins__": {}, "range": range, "len": len, "min": min, "overflow": overflow,
}  # fmt: skip
