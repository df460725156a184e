"""Sections of a program that DELAYFSTON and IPTRLOCK begin, and the settings of single axes and of smoothing.

A section ends with the program level that began it; inside it, beginning again and ending on a deeper level have no
effect. Source: job planning 8.4, 8.5 (sections), 4.11, 4.12 (motion end, SCPARA), 8.8 (CTOL, OTOL, ATOL).
"""

from __future__ import annotations

from collections.abc import Callable
from math import hypot
from typing import TYPE_CHECKING, Any

from polycnc.control.sinumerik import arguments
from polycnc.control.sinumerik.positions import number
from polycnc.language.sinumerik.values import Axis, Type
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.block import Draft, Step, Values
    from polycnc.control.sinumerik.memory import Memory
    from polycnc.language.sinumerik.words import WordShape

Arguments = tuple[Any, ...]
Procedure = Callable[["Channel", Arguments], None]
Row = tuple[Type, Callable[["Channel", Arguments], Any], None, bool]

STOP_DELAY, POINTER_LOCK = "DELAYFST", "IPTRLOCK"
#: $AA_MOTEND for each criterion; without one it is that of exact stop fine.
MOTION_ENDS = {"FINEA": 1, "COARSEA": 2, "IPOENDA": 3, "IPOBRKA": 4}
#: ADISPOSA: no window, one about the set position, one about the actual position.
WINDOW_MODES = (0, 1, 2)
PARAMETER_SETS = range(1, 7)
NO_TOLERANCE = -1.0


# ---- sections


def begin(section: str) -> Procedure:
    """DELAYFSTON, IPTRLOCK: the section begins, unless one is open."""

    def run(channel: Channel, _args: Arguments) -> None:
        if not is_open(channel, section):
            channel.memory.sections[section] = channel.level

    return run


def end(section: str) -> Procedure:
    """DELAYFSTOF, IPTRUNLOCK: the section ends, on the level that began it."""

    def run(channel: Channel, _args: Arguments) -> None:
        if channel.memory.sections.get(section) is channel.level:
            del channel.memory.sections[section]

    return run


def is_open(channel: Channel, section: str) -> bool:
    """Whether a section is open: its level has not ended."""
    level = channel.memory.sections.get(section)
    return any(level is each for each in channel.stack)


# ---- settings of axes


def motion_end(name: str) -> Procedure:
    """FINEA, COARSEA, IPOENDA, IPOBRKA: when a positioning axis counts as arrived."""

    def run(channel: Channel, args: Arguments) -> None:
        # IPOBRKA takes an axis and a percentage, the others take axes.
        axes = args[:1] if name == "IPOBRKA" else args
        if not axes:
            raise AlarmError("12040", text=name)
        for axis in axes:
            channel.memory.values["MOTEND", (arguments.column(channel, axis),)] = MOTION_ENDS[name]
        if name == "IPOBRKA" and len(args) > 1:
            _set_braking_share(channel, axes[0], args[1])

    return run


def _set_braking_share(channel: Channel, axis: Axis, value: Any) -> None:
    """IPOBRKA(axis, percent): where in the braking ramp the block changes; 100 is its beginning (SD43600)."""
    percent = arguments.real(value)
    if not 0.0 <= percent <= 100.0:
        raise AlarmError("12560", text="IPOBRKA")
    channel.memory.data.write("$SA_IPOBRAKE_BLOCK_EXCHANGE", (axis,), percent)


def end_window(draft: Draft, position: int, shape: WordShape) -> Step:
    """ADISPOSA[axis]=(mode,size): with IPOBRKA, the axis must also be within a window of its end (SD43610)."""
    column = axis_column(draft, position, shape)

    def run(channel: Channel, values: Values) -> None:
        listed = values[position]
        if not isinstance(listed, tuple) or not 1 <= len(listed) <= 2 or listed[0] not in WINDOW_MODES:
            raise WordAlarm("12560", position, text="ADISPOSA")
        channel.memory.values["ADISPOSA", (column,)] = int(listed[0])
        if len(listed) > 1:
            channel.memory.data.write("$SA_ADISPOSA_VALUE", (channel.axes[column],), float(listed[1]))

    return run


def _motion_end(channel: Channel, indices: Arguments) -> int:
    """$AA_MOTEND: 5 and 6 where IPOBRKA has a window as well."""
    end: int = _of_axis("$AA_MOTEND", "MOTEND", MOTION_ENDS["FINEA"])(channel, indices)
    if end == MOTION_ENDS["IPOBRKA"]:
        end += _of_axis("$AA_MOTEND", "ADISPOSA", 0)(channel, indices)
    return end


def parameter_set(draft: Draft, position: int, shape: WordShape) -> Step:
    """SCPARA[axis]: servo parameter set 1 to 6."""
    column = axis_column(draft, position, shape)

    def run(channel: Channel, values: Values) -> None:
        value = number(values, position)
        if value not in PARAMETER_SETS:
            raise WordAlarm("12560", position, text="SCPARA")
        channel.memory.values["SCPARA", (column,)] = int(value)

    return run


def axis_column(draft: Draft, position: int, shape: WordShape) -> int:
    """Column of the axis in the brackets of a word; alarm 12040 without one."""
    if not isinstance(shape.index, Axis):
        raise WordAlarm("12040", position, text=str(shape.index or ""))
    return draft.memory.column(shape.index.name)


def _of_axis(name: str, key: str, default: int) -> Callable[[Channel, Arguments], Any]:
    def read(channel: Channel, indices: Arguments) -> Any:
        if len(indices) != 1 or not isinstance(indices[0], Axis):
            raise AlarmError("12400", text=name)
        memory: Memory = channel.memory
        return memory.values.get((key, (memory.column(indices[0].name),)), default)

    return read


# ---- tolerances


def tolerance(draft: Draft, position: int, shape: WordShape) -> Step:
    """CTOL, OTOL, ATOL[axis]: tolerance of smoothing; a negative value takes it back."""
    key = () if shape.index is None else (axis_column(draft, position, shape),)

    def run(channel: Channel, values: Values) -> None:
        value = number(values, position)
        channel.memory.values[shape.address, key] = value if value >= 0.0 else NO_TOLERANCE
        channel.context_changed()

    return run


def contour_tolerance(memory: Memory) -> float:
    """CTOL, mm; 0 where none is programmed."""
    return max(float(memory.values.get(("CTOL", ()), NO_TOLERANCE)), 0.0)


def _programmed(address: str) -> Callable[[Channel, Arguments], float]:
    return lambda channel, _indices: float(channel.memory.values.get((address, ()), NO_TOLERANCE))


def _programmed_of_axis(channel: Channel, indices: Arguments) -> float:
    return float(_of_axis("$PA_ATOL", "ATOL", -1)(channel, indices))


def _axis_tolerance(channel: Channel, column: int) -> float:
    memory: Memory = channel.memory
    geometry = [i for i in channel.coordinates.geometry if i >= 0]
    contour = contour_tolerance(memory)
    if contour and column in geometry:
        return float(contour / len(geometry) ** 0.5)
    own = float(memory.values.get(("ATOL", (column,)), NO_TOLERANCE))
    return own if own >= 0.0 else memory.data.number("$MA_COMPRESS_POS_TOL", channel.axes[column])


def _active_of_axis(channel: Channel, indices: Arguments) -> float:
    if len(indices) != 1 or not isinstance(indices[0], Axis):
        raise AlarmError("12400", text="$AA_ATOL")
    return _axis_tolerance(channel, channel.memory.column(indices[0].name))


def _active_contour(channel: Channel, _indices: Arguments) -> float:
    geometry = [i for i in channel.coordinates.geometry if i >= 0]
    return contour_tolerance(channel.memory) or hypot(*(_axis_tolerance(channel, i) for i in geometry))


SECTION_VARIABLES: dict[str, Row] = {
    "$P_DELAYFST": (Type.INT, lambda channel, _indices: int(is_open(channel, STOP_DELAY)), None, False),
    "$AC_DELAYFST": (Type.INT, lambda channel, _indices: int(is_open(channel, STOP_DELAY)), None, True),
    "$P_IPTRLOCK": (Type.BOOL, lambda channel, _indices: is_open(channel, POINTER_LOCK), None, False),
    "$AA_MOTEND": (Type.INT, _motion_end, None, True),
    "$AA_SCPAR": (Type.INT, _of_axis("$AA_SCPAR", "SCPARA", 1), None, True),
    "$P_CTOL": (Type.REAL, _programmed("CTOL"), None, False),
    "$P_OTOL": (Type.REAL, _programmed("OTOL"), None, False),
    "$PA_ATOL": (Type.REAL, _programmed_of_axis, None, False),
    "$AC_CTOL": (Type.REAL, _active_contour, None, True),
    "$AA_ATOL": (Type.REAL, _active_of_axis, None, True),
}
