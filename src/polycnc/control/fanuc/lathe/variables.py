"""System variables of the lathe: tool offsets by axis, positions in diameter, modal groups (FANUC macro B §2)."""

from __future__ import annotations

from polycnc.control.fanuc.lathe.tools.offset_memory import OffsetMemory
from polycnc.control.fanuc.lathe.tools.offsets import OffsetState, offset_changed, refresh
from polycnc.control.fanuc.system_variables import (
    COMMON_VARIABLES,
    axis_at,
    modal_names,
    modal_rows,
    nothing,
    position_rows,
)
from polycnc.control.word_address.macro_b.variables import Read, Registry, SystemRange, Write
from polycnc.control.word_address.memory import EXTERNAL
from polycnc.control.word_address.states import LastSkip
from polycnc.control.word_address.tools.radius import tool_position
from polycnc.control.word_address.transformations import cylinder
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.memory import TurningMemory

#: Modal groups in the order of #4001 to #4030.
GROUPS = {1: "motion", 2: "surface_speed", 3: "distance", 4: "turret_mirror", 5: "feed", 6: "unit", 7: "compensation",
          8: "fluctuation", 9: "stroke", 10: "cycle", 11: "return", 12: "macro", 14: "wcs", 15: "path", 16: "plane",
          17: "rotation", 19: "normal_line", 20: "polygon", 21: "polar_interpolation", 22: "mirror"}  # fmt: skip


def _shown(m: TurningMemory, axis: int, value: float) -> float:
    """A position as the program sees it: diameter, inches, degrees."""
    channel = m.channel
    if channel.axis_data[axis].rotary:
        return value
    factor = 2.0 if channel.control.is_diameter(channel, axis) else 1.0
    return m.to_program_unit(value * factor)


def _place(m: TurningMemory, i: int, position: list[float]) -> float:
    """A coordinate of a position of the display."""
    axis = axis_at(m, i)
    return _shown(m, axis, cylinder.shown(m.channel, axis, position[axis]))


def _taken(m: TurningMemory, axis: int, value: float | None) -> float:
    """A value of the program as a position."""
    if m.channel.axis_data[axis].rotary:
        return value or 0.0
    return m.radius_of(axis, m.from_program_unit(value))


# ---- tool offsets ------------------------------------------------------------------------------------------------


def _offset(memory: str, name: str) -> tuple[Read, Write]:
    """Offset along an axis, geometry or wear."""

    def read(m: TurningMemory, i: int) -> float:
        values = getattr(OffsetMemory.of(m.channel).at(i + 1), memory)
        value: float = values.get(name, 0.0)
        axis = m.channel.axis_index.get(name)
        return m.to_program_unit(value) if axis is None or m.parameters.ORC else _shown(m, axis, value)

    def write(m: TurningMemory, i: int, value: float | None, _text: str) -> None:
        values = getattr(OffsetMemory.of(m.channel).at(i + 1), memory)
        axis = m.channel.axis_index.get(name)
        if axis is None or m.parameters.ORC:
            values[name] = m.from_program_unit(value)
        else:
            values[name] = _taken(m, axis, value)
        offset_changed(m.channel)

    return read, write


def _nose(field: str) -> tuple[Read, Write]:
    """Nose radius."""

    def read(m: TurningMemory, i: int) -> float:
        return m.to_program_unit(getattr(OffsetMemory.of(m.channel).at(i + 1), field))

    def write(m: TurningMemory, i: int, value: float | None, _text: str) -> None:
        setattr(OffsetMemory.of(m.channel).at(i + 1), field, m.from_program_unit(value))

    return read, write


def _tip() -> tuple[Read, Write]:
    def read(m: TurningMemory, i: int) -> float:
        return float(OffsetMemory.of(m.channel).at(i + 1).tip)

    def write(m: TurningMemory, i: int, value: float | None, _text: str) -> None:
        OffsetMemory.of(m.channel).at(i + 1).tip = int(value or 0)

    return read, write


def _rows_tools() -> list[SystemRange]:
    return [
        SystemRange(2001, 2064, *_offset("wear", "X")),
        SystemRange(2101, 2164, *_offset("wear", "Z")),
        SystemRange(2201, 2264, *_nose("radius_wear")),
        SystemRange(2301, 2364, *_tip()),
        SystemRange(2401, 2449, *_offset("wear", "Y")),
        SystemRange(2451, 2499, *_offset("geometry", "Y")),
        SystemRange(2701, 2749, *_offset("geometry", "X")),
        SystemRange(2801, 2849, *_offset("geometry", "Z")),
        SystemRange(2901, 2964, *_nose("radius")),
        SystemRange(10001, 10999, *_offset("wear", "X"), name="_OFSXW"),
        SystemRange(11001, 11999, *_offset("wear", "Z"), name="_OFSZW"),
        SystemRange(12001, 12999, *_nose("radius_wear"), name="_OFSRW"),
        SystemRange(13001, 13999, *_tip(), name="_OFST"),
        SystemRange(14001, 14999, *_offset("wear", "Y"), name="_OFSYW"),
        SystemRange(15001, 15999, *_offset("geometry", "X"), name="_OFSXG"),
        SystemRange(16001, 16999, *_offset("geometry", "Z"), name="_OFSZG"),
        SystemRange(17001, 17999, *_nose("radius"), name="_OFSRG"),
        SystemRange(19001, 19999, *_offset("geometry", "Y"), name="_OFSYG"),
    ]


# ---- coordinates -------------------------------------------------------------------------------------------------


def _work_shift(name: str) -> tuple[Read, Write]:
    def read(m: TurningMemory, _i: int) -> float:
        axis = m.channel.axis_index[name]
        return _shown(m, axis, OffsetMemory.of(m.channel).work_shift[axis])

    def write(m: TurningMemory, _i: int, value: float | None, _text: str) -> None:
        axis = m.channel.axis_index[name]
        OffsetMemory.of(m.channel).work_shift[axis] = _taken(m, axis, value)
        refresh(m.channel)

    return read, write


def _work_offset(name: str) -> tuple[Read, Write]:
    def read(m: TurningMemory, i: int) -> float:
        return _shown(m, axis_at(m, i), m.work_offset(name)[i])

    def write(m: TurningMemory, i: int, value: float | None, _text: str) -> None:
        m.work_offset(name)[axis_at(m, i)] = _taken(m, i, value)
        refresh(m.channel)

    return read, write


def _rows_work_offsets() -> list[SystemRange]:
    rows = [SystemRange(2501, 2501, *_work_shift("X")), SystemRange(2601, 2601, *_work_shift("Z"))]
    for i, name in enumerate([EXTERNAL, "G54", "G55", "G56", "G57", "G58", "G59"]):
        shown = f"_WZ{name}" if i else "_WZCMN"
        rows.append(SystemRange(5201 + 20 * i, 5220 + 20 * i, *_work_offset(name), name=shown))
    extended = (
        SystemRange(7001 + 20 * (p - 1), 7020 + 20 * (p - 1), *_work_offset(f"G54.1 P{p}"), name=f"_WZP{p}")
        for p in range(1, 49)
    )
    return [*rows, *extended]


def _end_point(m: TurningMemory, i: int) -> float:
    """Work coordinates of the block end, before the offset that moves the point; one still owed is not in it."""
    c = m.channel.coordinates
    return _place(m, i, [point + owed for point, owed in zip(c.programmed, c.pending, strict=True)])


def _machine(m: TurningMemory, i: int) -> float:
    axis, channel = axis_at(m, i), m.channel
    return _shown(m, axis, channel.coordinates.to_machine(tool_position(channel))[axis])


def _work(m: TurningMemory, i: int) -> float:
    return _place(m, i, tool_position(m.channel))


def _skip(m: TurningMemory, i: int) -> float:
    position = LastSkip.here(m.channel)
    return _place(m, i, position)


def _offset_in_force(m: TurningMemory, i: int) -> float:
    shift = OffsetState.of(m.channel).shift
    return _shown(m, axis_at(m, i), shift[i] + m.frames.offset[i])


# ---- modal information -------------------------------------------------------------------------------------------


def _modal(group: str) -> Read:
    def read(m: TurningMemory, _i: int) -> float:
        code: str = m.channel.control.written_code(m.channel, group)
        return float(code[1:].split(maxsplit=1)[0])

    return read


def _rows_modal(first: int) -> list[SystemRange]:
    words: dict[int, Read] = {120: lambda m, _i: float(OffsetState.of(m.channel).tool_word)}
    return modal_rows(first, {n: _modal(group) for n, group in GROUPS.items()}, words)


TURNING_VARIABLES = Registry(
    COMMON_VARIABLES
    + _rows_modal(4000)
    + _rows_modal(4200)
    + position_rows(_end_point, _machine, _work, _skip, _offset_in_force, nothing)
    + _rows_work_offsets()
    + _rows_tools(),
    modal_names("_BUF", "_ACT"),
)
