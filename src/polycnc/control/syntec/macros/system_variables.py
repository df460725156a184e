"""System variables of the SYNTEC control by number (macro language reference, section 5)."""

from __future__ import annotations

from math import isnan

from polycnc.control.syntec.builder import macro_program
from polycnc.control.syntec.coordinates.systems import WORK_SYSTEMS
from polycnc.control.syntec.coordinates.turns import PostureState, TurnState, turn_preset_frame
from polycnc.control.syntec.macros.variables import (
    USER,
    BitState,
    FunctionState,
    Read,
    Registry,
    Space,
    SpaceState,
    Write,
    stored,
)
from polycnc.control.syntec.motion.arcs import ArcState
from polycnc.control.syntec.motion.moves import SkipState
from polycnc.control.syntec.motion.oscillation import check_frame
from polycnc.control.syntec.motion.polar import block_start
from polycnc.control.word_address.coordinates.systems import ZeroState, refresh_zero
from polycnc.control.word_address.memory import EXTERNAL, ToolOffsets
from polycnc.control.word_address.states import LastSkip
from polycnc.control.word_address.tools.length import renew_length
from polycnc.control.word_address.tools.radius import active_compensation
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING, cast
from polycnc.geometry.units import INCH_MM
from polycnc.language.syntec.values import VACANT, Value, number, to_long, whole
from polycnc.messages import AlarmError

with loaded_when_called():
    from polycnc.control.syntec.macros import machine_parameters
    from polycnc.control.syntec.motion import quiet

if TYPE_CHECKING:
    from polycnc.control.syntec.memory import SyntecMemory

AXIS_PLACES = 18
#: System variable to the modal group whose active code it shows.
MODAL = {
    1000: "motion", 1002: "plane", 1004: "distance", 1006: "stroke", 1008: "feed", 1010: "unit",
    1012: "compensation", 1014: "length", 1016: "scaling", 1018: "surface_speed", 1020: "path",
    1022: "rotation",
}  # fmt: skip


# ---- modal state -----------------------------------------------------------------------------------------


def code_number(code: str) -> int | float:
    """The number of a code: `G1` is 1, `G2.4` is 2.4."""
    text = code[1:]
    return float(text) if "." in text else int(text)


def _modal(group: str) -> Read:
    return lambda memory, _offset: code_number(memory.channel.mode[group])


def _interpolation(memory: SyntecMemory, _offset: int) -> Value:
    """#1000: code of the active cycle, else of the interpolation."""
    mode = memory.channel.mode
    cycle = mode.codes.get("cycle", "G80")
    return code_number(mode["motion"] if cycle == "G80" else cycle)


def _set_interpolation(memory: SyntecMemory, _offset: int, value: Value) -> None:
    """A code of motion, or that of a macro: the blocks behind it that name no code of motion call it again."""
    channel = memory.channel
    code = f"G{number(value):g}"
    if code not in ("G0", "G1", "G2", "G3", "G33") and macro_program(channel, code) is None:
        raise AlarmError("PC0001", hint="hint.not-supported", code=f"#1000 := {code[1:]}")
    channel.mode = channel.mode.with_codes([("motion", code), ("cycle", "G80")])


def _work_system(memory: SyntecMemory, _offset: int) -> Value:
    state = ZeroState.of(memory.channel)
    return WORK_SYSTEMS.index(state.system) + 1 if state.system in WORK_SYSTEMS else 0


def _sequence(memory: SyntecMemory, _offset: int) -> Value:
    """#1042: the last N number at or before the running block."""
    level = memory.channel.level
    return level.code.sequence_at(level.current)


def _line(memory: SyntecMemory, _offset: int) -> Value:
    return memory.channel.line


def _feed(memory: SyntecMemory, _offset: int) -> Value:
    """#1046: F per minute or per revolution, in the program's unit."""
    channel = memory.channel
    if isnan(channel.feed):
        return 0.0
    per = 1.0 if channel.mode["feed"] == "G95" else 60.0
    unit = INCH_MM if memory.is_inch and channel.mode["feed"] != "G93" else 1.0
    return channel.feed * per / unit


# ---- positions -------------------------------------------------------------------------------------------


def shown(memory: SyntecMemory, axis: int, value: float) -> float:
    """A position or length of an axis (mm radius, degrees) as the program sees it."""
    if memory.channel.axis_data[axis].rotary:
        return value
    if memory.is_diameter(axis):
        value *= 2.0
    return value / INCH_MM if memory.is_inch else value


def meant(memory: SyntecMemory, axis: int, value: Value) -> float:
    """A value of the program for an axis in internal units."""
    result = float(number(value))
    if memory.channel.axis_data[axis].rotary:
        return result
    if memory.is_diameter(axis):
        result /= 2.0
    return result * INCH_MM if memory.is_inch else result


def _by_axis(first: int, values: object) -> Space:
    """Eighteen places, one an axis; axes that do not exist read zero."""

    def read(memory: SyntecMemory, offset: int) -> Value:
        positions: list[float] = values(memory)  # type: ignore[operator]
        return shown(memory, offset, positions[offset]) if offset < len(positions) else 0.0

    return Space(first, first + AXIS_PLACES - 1, read)


def _position(memory: SyntecMemory) -> list[float]:
    return memory.channel.coordinates.position


def _tool(memory: SyntecMemory) -> list[float]:
    """Where the tool is: beside a compensated contour not where the block was programmed. Programs WAIT() first."""
    channel = memory.channel
    stage, position = active_compensation(channel), channel.coordinates.position
    return position if stage is None else stage.beside(position)


def _machine(memory: SyntecMemory) -> list[float]:
    return memory.channel.coordinates.to_machine(_tool(memory))


def _skip(memory: SyntecMemory) -> list[float]:
    return LastSkip.of(memory.channel).position or []


def _machine_skip(memory: SyntecMemory) -> list[float]:
    at = LastSkip.of(memory.channel).position
    return (
        []
        if at is None
        else SkipState.of(memory.channel).machine or memory.channel.coordinates.to_machine(at)
    )


def _skip_flags(memory: SyntecMemory, _offset: int) -> Value:
    """#1608; where an input of the main run has cut the move, G31 has."""
    return SkipState.of(memory.channel).flags or int(LastSkip.of(memory.channel).position is not None)


def _length(memory: SyntecMemory) -> list[float]:
    return ZeroState.of(memory.channel).length


def _center(memory: SyntecMemory, offset: int) -> Value:
    return shown(
        memory, memory.channel.coordinates.geometry[offset], ArcState.of(memory.channel).last_center[offset]
    )


# ---- control words and status ----------------------------------------------------------------------------


def _word(index: int) -> tuple[Read, Write]:
    """A word that is kept and has no effect on the path (overrides, reload marks, colours)."""

    def read(memory: SyntecMemory, _offset: int) -> Value:
        return SpaceState.of(memory.channel).words.get(index, 0)

    def write(memory: SyntecMemory, _offset: int, value: Value) -> None:
        SpaceState.of(memory.channel).words[index] = to_long(value)

    return read, write


def _quiet(memory: SyntecMemory, _offset: int) -> int:
    return int(quiet.is_quiet(memory.channel))


def _set_quiet(memory: SyntecMemory, _offset: int, value: Value) -> None:
    """#1500: quiet mode."""
    quiet.switch_quiet(memory.channel, on=number(value) != 0)


def _constant(value: int) -> Read:
    return lambda _memory, _offset: value


def _channel_number(memory: SyntecMemory, _offset: int) -> Value:
    return memory.channel.number


def _diameter_mask(memory: SyntecMemory, _offset: int) -> Value:
    """#1814: bit n is set while axis n (from 1) is a diameter axis."""
    axes = range(len(memory.channel.axes))
    return sum(1 << (axis + 1) for axis in axes if memory.is_diameter(axis))


# ---- frames and offsets ----------------------------------------------------------------------------------


def _read_shift(memory: SyntecMemory, offset: int) -> Value:
    shifts = ZeroState.of(memory.channel).preset
    return shown(memory, offset, shifts[offset]) if offset < len(shifts) else 0.0


def _write_shift(memory: SyntecMemory, offset: int, value: Value) -> None:
    state = ZeroState.of(memory.channel)
    if offset >= len(state.preset):
        raise AlarmError("COR-016", variable=f"#{1901 + offset}")
    check_frame(memory)
    state.preset[offset] = meant(memory, offset, value)
    refresh_zero(memory.channel)


def _read_preset_axis(memory: SyntecMemory, offset: int) -> Value:
    return TurnState.of(memory.channel).axis[offset]


def _write_preset_axis(memory: SyntecMemory, offset: int, value: Value) -> None:
    state = TurnState.of(memory.channel)
    axis = [float(number(value)) if place == offset else old for place, old in enumerate(state.axis)]
    turn_preset_frame(memory.channel, state.angle, axis, f"#{1931 + offset}")
    refresh_zero(memory.channel)


def _read_preset_angle(memory: SyntecMemory, _offset: int) -> Value:
    return TurnState.of(memory.channel).angle


def _write_preset_angle(memory: SyntecMemory, _offset: int, value: Value) -> None:
    turn_preset_frame(memory.channel, float(number(value)), TurnState.of(memory.channel).axis, "#1930")
    refresh_zero(memory.channel)


def _read_length(memory: SyntecMemory, offset: int) -> Value:
    tool = ToolOffsets.of(memory.channel).numbers.get(offset + 1)
    value = tool.length if tool else 0.0
    return value / INCH_MM if memory.is_inch else value


def _write_length(memory: SyntecMemory, offset: int, value: Value) -> None:
    length = float(number(value)) * (INCH_MM if memory.is_inch else 1.0)
    memory.offset_number(offset + 1).length = length
    renew_length(memory.channel)


def _frame_place(offset: int) -> tuple[str, int]:
    """Work system and axis of #20001 on: twenty numbers a frame, the external one first."""
    frame, axis = divmod(offset, 20)
    return (EXTERNAL if frame == 0 else WORK_SYSTEMS[frame - 1]), axis


def _read_work_offset(memory: SyntecMemory, offset: int) -> Value:
    name, axis = _frame_place(offset)
    values = memory.work_offset(name)
    return shown(memory, axis, values[axis]) if axis < len(values) else 0.0


def _write_work_offset(memory: SyntecMemory, offset: int, value: Value) -> None:
    name, axis = _frame_place(offset)
    values = memory.work_offset(name)
    if axis >= len(values):
        raise AlarmError("COR-016", variable=f"#{20001 + offset}")
    check_frame(memory)
    values[axis] = meant(memory, axis, value)
    refresh_zero(memory.channel)


# ---- spaces of the user ----------------------------------------------------------------------------------


def _read_user(memory: SyntecMemory, offset: int) -> Value:
    return SpaceState.of(memory.channel).user.get(offset, 0.0)


def _write_user(memory: SyntecMemory, offset: int, value: Value) -> None:
    SpaceState.of(memory.channel).user[offset] = float(number(value))


def _write_modal_long(memory: SyntecMemory, offset: int, value: Value) -> None:
    SpaceState.of(memory.channel).modal_longs[offset] = to_long(value)


def _parameter(first: int) -> Read:
    return lambda memory, offset: machine_parameters.read_long(memory, first + offset) or 0


def _skip_input(memory: SyntecMemory, offset: int) -> Value:
    """#6001 on: C101 on."""
    return BitState.of(memory.channel).bits.get(f"C{101 + offset}", 0)


def system_variable(memory: SyntecMemory, group: Value, index: Value) -> Value:
    """SYSVAR(g, n): #n of an axis group."""
    channels, wanted = memory.channel.group, whole(group, "COR-023")
    if wanted == memory.channel.number:
        return memory.variable(index)
    if channels is None or not channels.has(wanted):
        raise AlarmError("COR-016", variable=f"SYSVAR({wanted})")
    other = channels.channel(wanted).memory
    return VACANT if other is None else cast("Value", other.variable(index))


_DOUBLES = stored(lambda state: state.modal_doubles)
SYSTEM_VARIABLES = Registry(
    [
        Space(USER[0], USER[-1], _read_user, _write_user),
        Space(1000, 1000, _interpolation, _set_interpolation),
        *(Space(index, index, _modal(group)) for index, group in MODAL.items() if index != 1000),
        Space(1040, 1040, _work_system),
        Space(1042, 1042, _sequence),
        Space(1046, 1046, _feed),
        Space(1048, 1048, _line),
        Space(1080, 1099, stored(lambda state: state.modal_longs)[0], _write_modal_long),
        _by_axis(1301, _position),
        _by_axis(1321, _machine),
        _by_axis(1341, _tool),
        _by_axis(1361, _skip),
        _by_axis(1381, _length),
        Space(1401, 1403, _center),
        _by_axis(1411, lambda memory: block_start(memory.channel)),
        _by_axis(1441, _machine_skip),
        Space(1500, 1500, _quiet, _set_quiet),
        *(Space(index, index, *_word(index)) for index in (1502, 1504, 1510, 1517, 1610, 1612, 1614, 1820)),
        Space(1506, 1506, _constant(0)),
        Space(1508, 1508, _channel_number),
        Space(1600, 1600, lambda memory, _offset: memory.least_unit),
        Space(1602, 1602, lambda memory, _offset: memory.least_angle),
        Space(1604, 1604, lambda memory, _offset: memory.parameters.uvw_increments),
        Space(1606, 1606, lambda memory, _offset: len(FunctionState.of(memory.channel).stack)),
        Space(1608, 1608, _skip_flags),
        Space(1616, 1616, _constant(0)),
        Space(1618, 1618, _constant(0)),
        Space(1620, 1620, _sequence),
        Space(1622, 1622, _line),
        Space(1624, 1624, _constant(1)),
        Space(1814, 1814, _diameter_mask),
        Space(1848, 1848, lambda memory, _offset: int(PostureState.of(memory.channel).in_work)),
        Space(1849, 1849, lambda memory, _offset: int(TurnState.of(memory.channel).by_table)),
        Space(1880, 1896, _read_work_offset, _write_work_offset),
        Space(1901, 1918, _read_shift, _write_shift),
        Space(1930, 1930, _read_preset_angle, _write_preset_angle),
        Space(1931, 1933, _read_preset_axis, _write_preset_axis),
        Space(2001, 3100, *_DOUBLES),
        Space(4001, 4200, _parameter(4001)),
        Space(5001, 5500, _parameter(5001)),
        Space(6001, 6032, _skip_input),
        Space(11001, 11400, _read_length, _write_length),
        Space(20001, 20658, _read_work_offset, _write_work_offset),
    ]
)


def found(index: int) -> Space:
    """The space of a system variable; COR-016 for none."""
    return SYSTEM_VARIABLES.find(index)
