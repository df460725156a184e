"""Functions that compiled blocks call (job planning 1.3 to 1.9). Angles in degrees; INDEX counts from 0."""

from __future__ import annotations

import re
from functools import partial
from math import (
    acos,
    asin,
    atan2,
    ceil,
    cos,
    degrees,
    exp,
    floor,
    fmod,
    isclose,
    isfinite,
    log,
    radians,
    sin,
    sqrt,
    tan,
    trunc,
)

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.expressions.operators import overflow
from polycnc.language.sinumerik.errors import arithmetic
from polycnc.language.sinumerik.lexer import number_of
from polycnc.language.sinumerik.names import frame as nc_frame
from polycnc.language.sinumerik.names.values import (
    Axis,
    Type,
    char_of_text,
    checked_char,
    checked_int,
    joined,
    real_text,
    round_half_up,
)
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.interface import LanguageMemory, SystemVariable
    from polycnc.language.sinumerik.names.frame import NcFrame

#: Comparisons take values as equal that differ by no more than this part of the greater one (1.5).
near = partial(isclose, rel_tol=1e-12)

_EXACT_SINE = {0.0: 0.0, 90.0: 1.0, 180.0: 0.0, 270.0: -1.0}
_NUMBER = regex(r"\s*[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:EX[+-]?\d{1,3})?\s*", re.IGNORECASE | re.ASCII)


def sind(x: float) -> float:
    """Sine, exact at multiples of 90 degrees."""
    return sin(radians(x)) if x % 90.0 else _EXACT_SINE[x % 360.0]


def cosd(x: float) -> float:
    """Cosine, exact at multiples of 90 degrees."""
    return cos(radians(x)) if x % 90.0 else _EXACT_SINE[(x + 90.0) % 360.0]


def tand(x: float) -> float:
    """Tangent; alarm 14051 where it has no value."""
    if x % 90.0:
        return tan(radians(x))
    if x % 180.0:
        raise arithmetic("TAN")
    return 0.0


def asind(x: float) -> float:
    """Arc sine; alarm 14051 outside -1…1."""
    if not -1.0 <= x <= 1.0:
        raise arithmetic("ASIN")
    return degrees(asin(x))


def acosd(x: float) -> float:
    """Arc cosine; alarm 14051 outside -1…1."""
    if not -1.0 <= x <= 1.0:
        raise arithmetic("ACOS")
    return degrees(acos(x))


def atan2d(across: float, along: float) -> float:
    """Angle of a vector: first the part across, then the part along the reference direction; -180…180."""
    return degrees(atan2(across, along))


def root(x: float) -> float:
    """Square root; alarm 14051 for a negative number."""
    if x < 0.0:
        raise arithmetic("SQRT")
    return sqrt(x)


def finite(x: float) -> float:
    """A number as it is; alarm 14051 for one that has grown beyond the range of REAL."""
    if isfinite(x):
        return x
    raise arithmetic()


def square(x: float) -> float:
    """POT; alarm 14051 beyond the range of REAL."""
    return finite(float(x * x))


def natural_log(x: float) -> float:
    """LN; alarm 14051 outside its domain."""
    if x <= 0.0:
        raise arithmetic("LN")
    return log(x)


def power_of_e(x: float) -> float:
    """EXP; alarm 14051 beyond the range of REAL."""
    try:
        return exp(x)
    except OverflowError:
        raise arithmetic("EXP") from None


def bound(low: float, high: float, x: float) -> float:
    """BOUND: the value, or the limit that it exceeds."""
    return float(low if x < low else min(x, high))


def int_quotient(a: int, b: int) -> int:
    """DIV of two INT: cut towards zero."""
    return (
        trunc(a / b)
        if abs(a) < 2**31 and abs(b) < 2**31
        else abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)
    )


def real_quotient(a: float, b: float) -> float:
    """DIV of REAL values: the whole part of the quotient."""
    return float(trunc(a / b))


def remainder(a: float, b: float) -> float:
    """MOD: the remainder has the sign of the dividend; of two INT an INT, else a REAL (job planning 10.2)."""
    if b == 0:
        raise ZeroDivisionError
    rest = fmod(a, b)
    return int(rest) if isinstance(a, int) and isinstance(b, int) else rest


def number_in(text: str) -> float:
    """NUMBER: alarm 14098 if the text is no number."""
    if not _NUMBER.fullmatch(text):
        raise AlarmError("14098", text=text)
    stripped = text.strip()
    if stripped[0] in "+-":
        value = number_of(stripped[1:])
        return float(-value if stripped[0] == "-" else value)
    return float(number_of(stripped))


def is_number(text: str) -> bool:
    """ISNUMBER: whether NUMBER can convert the text."""
    return _NUMBER.fullmatch(text) is not None


def axis_named(memory: LanguageMemory, text: str) -> Axis:
    """AXNAME: alarm 14097 for a name that is no axis of the channel."""
    axis = memory.axes.get(text.strip().upper())
    if axis is None:
        raise AlarmError("14097", text=text)
    return axis


def first_of(text: str, characters: str) -> int:
    """MINDEX: the first place at which one of the characters stands, -1 for none."""
    return min((place for place in map(text.find, characters) if place >= 0), default=-1)


def part_of(text: str, start: int, count: int | None = None) -> str:
    """SUBSTR: from a place on, at most so many characters; alarm 14020 for negative numbers."""
    if start < 0 or (count is not None and count < 0):
        raise AlarmError("14020", text="SUBSTR")
    return text[start:] if count is None else text[start : start + count]


def char_at(text: str, index: int) -> int:
    """One character of a string as CHAR; alarm 17020 outside the string."""
    if not 0 <= index < len(text):
        raise AlarmError("17020", text=text, index=index)
    return ord(text[index])


def with_char(text: str, index: int, code: int) -> str:
    """The string after one character was written; a code of 0 ends it there (1.9)."""
    if not 0 <= index < len(text):
        raise AlarmError("17020", text=text, index=index)
    return text[:index] if code == 0 else text[:index] + chr(code) + text[index + 1 :]


def fitting(text: str, length: int) -> str:
    """A text that is stored in a STRING[length]; alarm 12210 if it is longer. Character 0 ends it."""
    end = text.find("\0")
    if end >= 0:
        text = text[:end]
    if len(text) > length:
        raise AlarmError("12210", text=text)
    return text


def limited(value: Any, low: float | None, high: float | None, name: str) -> Any:
    """A value that is stored in a variable with LLI or ULI; alarms 17080 and 17090 beyond them."""
    if low is not None and value < low:
        raise AlarmError("17080", text=name)
    if high is not None and value > high:
        raise AlarmError("17090", text=name)
    return value


def out_of_range(name: str, dimension: int, index: int) -> int:
    """Alarm 17020, 17030 or 17035: an array has no element with this first, second or third index."""
    raise AlarmError(("17020", "17030", "17035")[dimension - 1], text=name, index=index)


def set_elements(items: list[Any], start: int, values: Sequence[Any]) -> None:
    """SET: values from an element on; alarm 12260 if the array ends before the list."""
    if start + len(values) > len(items):
        raise AlarmError("12260", text="SET")
    items[start : start + len(values)] = values


def repeat_element(items: list[Any], start: int, value: Any, count: int | None = None) -> None:
    """REP: one value from an element on, to the end or so many times; alarm 12260 beyond the end."""
    if count is None:
        count = len(items) - start
    if count < 0 or start + count > len(items):
        raise AlarmError("12260", text="REP")
    items[start : start + count] = [value] * count


def set_system_elements(
    channel: Channel, variable: SystemVariable, indices: tuple[Any, ...], values: Sequence[Any]
) -> None:
    """SET and REP on a system variable: the last number of the indices advances, no axis (1.1.12)."""
    place = max((i for i, index in enumerate(indices) if isinstance(index, int)), default=-1)
    if place < 0:
        raise AlarmError("12430", text="SET")
    for step, value in enumerate(values):
        at = (*indices[:place], indices[place] + step, *indices[place + 1 :])
        write_length(channel, variable, at, value)


def elements_left(channel: Channel, variable: SystemVariable, indices: tuple[Any, ...]) -> int:
    """REP without a number on a system variable: its elements from one on; 12260 where their number is not told."""
    count = variable.element_count(channel)
    if count is None or len(indices) != 1 or not isinstance(indices[0], int):
        raise AlarmError("12260", text="REP")
    return variable.first + count - indices[0]


def read_length(channel: Channel, variable: SystemVariable, indices: tuple[Any, ...]) -> Any:
    """The value of a system variable that may be a length, in the unit of the program."""
    value, unit = variable.read(channel, indices), variable.unit(channel, indices) if variable.unit else 1.0
    return value / unit if unit != 1.0 else value


def write_length(channel: Channel, variable: SystemVariable, indices: tuple[Any, ...], value: Any) -> None:
    """Set a system variable that may be a length, told in the unit of the program."""
    unit = variable.unit(channel, indices) if variable.unit else 1.0
    variable.write(channel, indices, value * unit if unit != 1.0 else value)


#: Frame functions and components that are lengths.
_SHIFTS = frozenset(("ctrans", "cfine", "TR", "FI"))


def frame_of(channel: Channel, kind: str, pairs: tuple[Any, ...]) -> NcFrame:
    """CTRANS, CFINE, CROT, CSCALE with axis and value in turn, CMIRROR with axes."""
    try:
        if kind == "cmirror":
            return nc_frame.cmirror(axis.name for axis in pairs)
        values = {axis.name: float(value) for axis, value in zip(pairs[::2], pairs[1::2], strict=True)}
        if kind in _SHIFTS:
            values = {axis: value * channel.control.unit_of(channel, axis) for axis, value in values.items()}
        build: Callable[[dict[str, float]], NcFrame] = getattr(nc_frame, kind)
        return build(values)
    except ValueError:
        raise AlarmError("14092", text=kind.upper()) from None


def inverse_frame(frame: NcFrame) -> NcFrame:
    """INVFRAME."""
    return frame.inverse()


def frame_component(channel: Channel, frame: NcFrame, axis: Axis, component: str) -> float:
    """`FRAME[axis, component]`."""
    value = frame.component(axis.name, component)
    return value / channel.control.unit_of(channel, axis.name) if component in _SHIFTS else value


def with_component(channel: Channel, frame: NcFrame, axis: Axis, component: str, value: float) -> NcFrame:
    """The frame after `FRAME[axis, component] = value`."""
    try:
        if component in _SHIFTS:
            value *= channel.control.unit_of(channel, axis.name)
        return frame.with_component(axis.name, component, value)
    except ValueError:
        raise AlarmError("12560", text=f"{axis},{component}") from None


def default_value(type_: Type, memory: LanguageMemory) -> Any:
    """The value of a variable that nothing has set (1.1.7)."""
    if type_ is Type.AXIS:
        return memory.default_axis
    return _DEFAULTS[type_]


_DEFAULTS: dict[Type, Any] = {
    Type.INT: 0,
    Type.REAL: 0.0,
    Type.BOOL: False,
    Type.CHAR: 0,
    Type.STRING: "",
    Type.FRAME: nc_frame.NEUTRAL,
}

#: Names that compiled code may use.
NAMESPACE: dict[str, Any] = {
    function.__name__: function
    for function in (
        sind, cosd, tand, asind, acosd, atan2d, root, square, natural_log, power_of_e, bound, int_quotient,
        real_quotient, remainder, number_in, is_number, axis_named, first_of, part_of, char_at, with_char,
        fitting, limited, out_of_range, set_elements, repeat_element, set_system_elements,
        elements_left, frame_of,
        read_length, write_length,
        inverse_frame, frame_component, with_component, joined, real_text, round_half_up, checked_int,
        checked_char, char_of_text, trunc, floor, ceil, finite,
    )
} | {"near": near, "overflow": overflow}  # fmt: skip
