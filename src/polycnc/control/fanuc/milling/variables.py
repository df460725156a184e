"""System variables of FANUC and MELDAS machining centres: offsets by number, work systems, modal groups, positions."""

from __future__ import annotations

from polycnc.control.fanuc.system_variables import (
    COMMON_VARIABLES,
    axis_at,
    modal_names,
    modal_rows,
    nothing,
    position_rows,
)
from polycnc.control.word_address.coordinates import on_table
from polycnc.control.word_address.coordinates.systems import ZeroState, refresh_zero
from polycnc.control.word_address.macro_b.interruption import InterruptionState
from polycnc.control.word_address.macro_b.variables import Read, Registry, SystemRange, Write
from polycnc.control.word_address.memory import EXTERNAL
from polycnc.control.word_address.states import LastSkip, LengthState
from polycnc.control.word_address.tools.length import renew_length
from polycnc.control.word_address.tools.radius import RadiusState, tool_position
from polycnc.control.word_address.transformations import cylinder
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.word_address.family import MacroChannel
    from polycnc.control.word_address.macro_b.variables import MacroMemory

# ---- tool offsets ------------------------------------------------------------


def _tool_field(field: str) -> tuple[Read, Write]:
    def read(m: MacroMemory, i: int) -> float:
        return m.to_program_unit(getattr(m.offset_number(i + 1), field))

    def write(m: MacroMemory, i: int, value: float | None, _text: str) -> None:
        setattr(m.offset_number(i + 1), field, m.from_program_unit(value))
        renew_length(m.channel)

    return read, write


def _rows_tools() -> list[SystemRange]:
    return [
        SystemRange(2001, 2200, *_tool_field("length_wear")),
        SystemRange(2201, 2400, *_tool_field("length")),
        SystemRange(10001, 10999, *_tool_field("length_wear"), name="_OFSHW"),
        SystemRange(11001, 11999, *_tool_field("length"), name="_OFSHG"),
        SystemRange(12001, 12999, *_tool_field("radius_wear"), name="_OFSDW"),
        SystemRange(13001, 13999, *_tool_field("radius"), name="_OFSDG"),
    ]


# ---- work offsets ------------------------------------------------------------


def _work_offset(name: str) -> tuple[Read, Write]:
    def read(m: MacroMemory, i: int) -> float:
        return m.to_program_unit(m.work_offset(name)[axis_at(m, i)])

    def write(m: MacroMemory, i: int, value: float | None, _text: str) -> None:
        m.work_offset(name)[axis_at(m, i)] = m.from_program_unit(value)
        refresh_zero(m.channel)

    return read, write


def _rows_work_offsets() -> list[SystemRange]:
    rows: list[SystemRange] = []
    names = [EXTERNAL, "G54", "G55", "G56", "G57", "G58", "G59"]
    for i, name in enumerate(names):
        rows.append(
            SystemRange(
                5201 + 20 * i, 5220 + 20 * i, *_work_offset(name), name="_WZCMN" if not i else f"_WZ{name}"
            )
        )
    for axis in range(4):
        for i, name in enumerate(names):
            read, write = _work_offset(name)
            number = 2500 + 100 * axis + i
            rows.append(SystemRange(number, number, _shifted(read, axis), _shifted_write(write, axis)))
    for p in range(1, 301):
        pair = _work_offset(f"G54.1 P{p}")
        if p <= 48:
            rows.append(SystemRange(7001 + 20 * (p - 1), 7020 + 20 * (p - 1), *pair))
        rows.append(SystemRange(14001 + 20 * (p - 1), 14020 + 20 * (p - 1), *pair, name=f"_WZP{p}"))
    return rows


def _shifted(read: Read, axis: int) -> Read:
    return lambda m, _i: read(m, axis)


def _shifted_write(write: Write, axis: int) -> Write:
    return lambda m, _i, value, text: write(m, axis, value, text)


# ---- work zeros on a rotary table --------------------------------------------


def _in_unit(m: MacroMemory, axis: int, value: float) -> float:
    return value if m.channel.axis_data[axis].rotary else m.to_program_unit(value)


def _fixture(number: int) -> tuple[Read, Write]:
    """A fixture offset (G54.2): lengths of linear axes, reference angles of rotary ones."""
    name = on_table.fixture_name(number)

    def read(m: MacroMemory, i: int) -> float:
        return _in_unit(m, axis_at(m, i), m.work_offset(name)[i])

    def write(m: MacroMemory, i: int, value: float | None, _text: str) -> None:
        rotary = m.channel.axis_data[axis_at(m, i)].rotary
        m.work_offset(name)[i] = (value or 0.0) if rotary else m.from_program_unit(value)
        _follow(m)

    return read, write


def _present_fixture(m: MacroMemory, i: int) -> float:
    """How far the fixture offset that acts shifts an axis now."""
    axis, c = axis_at(m, i), m.channel.coordinates
    place = c.geometry.index(axis) if axis in c.geometry else None
    return 0.0 if place is None else m.to_program_unit(ZeroState.of(m.channel).fixture[place])


def _workpiece_error(number: int) -> tuple[Read, Write]:
    """A workpiece error (G54.4): lengths along X, Y, Z, then angles."""

    def read(m: MacroMemory, i: int) -> float:
        value = on_table.values_of(m.channel, number)[i]
        return m.to_program_unit(value) if i < on_table.LINEAR.stop else value

    def write(m: MacroMemory, i: int, value: float | None, _text: str) -> None:
        linear = i < on_table.LINEAR.stop
        on_table.values_of(m.channel, number)[i] = m.from_program_unit(value) if linear else value or 0.0
        _follow(m)

    return read, write


def _follow(m: MacroMemory) -> None:
    if on_table.OnTable.of(m.channel).acts:
        on_table.follow(m.channel)


def _rows_on_table() -> list[SystemRange]:
    rows = [
        SystemRange(5500, 5500, lambda m, _i: float(on_table.OnTable.of(m.channel).fixture)),
        SystemRange(5501, 5520, _present_fixture),
    ]
    numbers, last = range(1, on_table.FIXTURES + 1), on_table.ERROR_VALUES - 1
    fixtures = (SystemRange(5501 + 20 * n, 5520 + 20 * n, *_fixture(n)) for n in numbers)
    firsts = ((on_table.FIRST_VARIABLE + on_table.VARIABLES * n, n) for n in range(on_table.ERRORS + 1))
    errors = (SystemRange(first, first + last, *_workpiece_error(n)) for first, n in firsts)
    return [*rows, *fixtures, *errors]


# ---- modal information and positions ------------------------------------------------------------

#: Modal groups in the order of #4001 to #4030 (machining centres).
MILLING_GROUPS = {1: "motion", 2: "plane", 3: "distance", 4: "stroke", 5: "feed", 6: "unit", 7: "compensation",
                  8: "length", 9: "cycle", 10: "return", 11: "scaling", 12: "macro", 13: "surface_speed", 14: "wcs",
                  15: "path", 16: "rotation", 17: "polar", 18: "normal_line", 22: "mirror"}  # fmt: skip


def _modal(group: str) -> Read:
    return lambda m, _i: float(m.channel.mode[group][1:])


def _interrupted(group: str) -> Read:
    """A modal code of the block that an interruption macro has cut."""

    def read(m: MacroMemory, _i: int) -> float | None:
        running = InterruptionState.of(m.channel).running
        return float(running[-1].mode[group][1:]) if running else None

    return read


def _extended(m: MacroMemory, _i: int) -> float:
    state = ZeroState.of(m.channel)
    return float(state.system[7:]) if state.system.startswith("G54.1 P") else 0.0


def _rows_modal(first: int) -> list[SystemRange]:
    words: dict[int, Read] = {
        102: nothing,
        107: lambda m, _i: float(RadiusState.of(m.channel).number),
        108: nothing,
        111: lambda m, _i: float(LengthState.of(m.channel).number),
        120: lambda m, _i: float(m.tool.next),
        130: _extended,
    }
    return modal_rows(first, {n: _modal(group) for n, group in MILLING_GROUPS.items()}, words)


def _shown(m: MacroMemory, axis: int, value: float) -> float:
    """A position as the program sees it: inches, degrees."""
    if m.channel.axis_data[axis].rotary:
        return cylinder.shown(m.channel, axis, value)
    return m.to_program_unit(value)


def _end_point(m: MacroMemory, i: int) -> float:
    """Work coordinates of the block end, as programmed."""
    axis = axis_at(m, i)
    return _shown(m, axis, m.channel.coordinates.named(m.channel.coordinates.position)[axis])


def _machine(m: MacroMemory, i: int) -> float:
    """Machine position now."""
    axis, channel = axis_at(m, i), m.channel
    machine = channel.coordinates.to_machine(tool_position(channel))[axis]
    return machine if channel.axis_data[axis].rotary else m.to_program_unit(machine)


def _lengths(channel: MacroChannel) -> list[float]:
    """The tool length along every axis, on a tilted plane along those of the plane."""
    c, lengths = channel.coordinates, list(ZeroState.of(channel).length)
    if not c.zero.is_identity:
        x, y, z = (lengths[axis] if axis >= 0 else 0.0 for axis in c.geometry)
        for axis, part in zip(c.geometry, c.zero.inverse().direct(x, y, z), strict=True):
            if axis >= 0:
                lengths[axis] = part
    return lengths


def _work_with_length(m: MacroMemory, i: int) -> float:
    """Work position now: machine position less work zero, the tool length not taken off."""
    axis = axis_at(m, i)
    place = m.channel.coordinates.named(tool_position(m.channel))
    return _shown(m, axis, place[axis] + _lengths(m.channel)[axis])


def _skip(m: MacroMemory, i: int) -> float:
    """Where the last G31 ended; as the work position, with the tool length in it."""
    axis = axis_at(m, i)
    position = LastSkip.here(m.channel)
    return m.to_program_unit(position[axis] + _lengths(m.channel)[axis])


def _length(m: MacroMemory, i: int) -> float:
    return m.to_program_unit(_lengths(m.channel)[axis_at(m, i)])


MILLING_VARIABLES = Registry(
    COMMON_VARIABLES
    + _rows_modal(4000)
    + _rows_modal(4200)
    + [SystemRange(4400 + n, 4400 + n, _interrupted(group)) for n, group in MILLING_GROUPS.items()]
    + position_rows(_end_point, _machine, _work_with_length, _skip, _length, nothing, nothing)
    + _rows_work_offsets()
    + _rows_on_table()
    + _rows_tools(),
    modal_names("_BUF", "_ACT", "_INT"),
)
