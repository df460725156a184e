"""System variables of FANUC controls with custom macro B (FANUC macro B reference §2).

A row names a range of variables and what reads and writes it; the functions get the offset within the range.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.word_address.coordinates import refresh_zero
from polycnc.control.word_address.length import renew_length
from polycnc.control.word_address.memory import EXTERNAL
from polycnc.control.word_address.subprograms import sequences_of
from polycnc.control.word_address.variables import Read, Registry, SystemRange, Write

if TYPE_CHECKING:
    from polycnc.control.word_address.variables import MacroMemory

# ---- interface signals ------------------------------------------------------------


def _signal(prefix: str) -> Read:
    return lambda m, i: float(bool(m.signals.get(f"{prefix}{i:03d}", 0)))


def _signal_word(prefix: str) -> Read:
    return lambda m, _i: float(sum(1 << bit for bit in range(16) if m.signals.get(f"{prefix}{bit:03d}")))


def _set_signal(m: MacroMemory, i: int, value: float | None, _text: str) -> None:
    m.signals[f"UO{i:03d}"] = int(bool(value))


def _set_signal_word(m: MacroMemory, _i: int, value: float | None, _text: str) -> None:
    word = int(value or 0.0)
    for bit in range(16):
        m.signals[f"UO{bit:03d}"] = word >> bit & 1


# ---- messages and control ------------------------------------------------------------


def _raise_user_alarm(m: MacroMemory, _i: int, value: float | None, text: str) -> None:
    """#3000 = n (TEXT)."""
    raise m.channel.control.macro_alarm(m.channel, int(value or 0.0), text)


def _show_and_stop(m: MacroMemory, _i: int, _value: float | None, text: str) -> None:
    """#3006 = 1 (TEXT): message, then stop as M00."""
    m.channel.event("message", text=text)
    m.channel.stop("M00")


def _switch(name: str) -> tuple[Read, Write]:
    def read(m: MacroMemory, _i: int) -> float:
        return float(m.control_switches.get(name, 0))

    def write(m: MacroMemory, _i: int, value: float | None, _text: str) -> None:
        m.control_switches[name] = int(value or 0.0)
        m.channel.context_changed()

    return read, write


def _clock(name: str, unit: float) -> tuple[Read, Write]:
    """A clock in units of so many seconds: programmed dwells count, moves do not, because macros are read ahead.

    Each look takes a millisecond, so that a loop which waits for the clock ends.
    """

    def read(m: MacroMemory, _i: int) -> float:
        value = round((m.waited - m.clock_zero.get(name, 0.0)) / unit, 9)
        m.waited += 0.001
        return value

    def write(m: MacroMemory, _i: int, value: float | None, _text: str) -> None:
        m.clock_zero[name] = m.waited - (value or 0.0) * unit

    return read, write


# ---- tool offsets ------------------------------------------------------------


def _tool_field(field: str) -> tuple[Read, Write]:
    def read(m: MacroMemory, i: int) -> float:
        return m.to_program_unit(getattr(m.offset_number(i + 1), field))

    def write(m: MacroMemory, i: int, value: float | None, _text: str) -> None:
        setattr(m.offset_number(i + 1), field, m.from_program_unit(value))
        renew_length(m.channel)

    return read, write


# ---- work offsets ------------------------------------------------------------


def _work_offset(name: str) -> tuple[Read, Write]:
    def read(m: MacroMemory, i: int) -> float:
        return m.to_program_unit(m.work_offset(name)[_axis(m, i)])

    def write(m: MacroMemory, i: int, value: float | None, _text: str) -> None:
        m.work_offset(name)[_axis(m, i)] = m.from_program_unit(value)
        refresh_zero(m.channel)

    return read, write


def _axis(m: MacroMemory, i: int) -> int:
    if i >= len(m.channel.axes):
        raise m.fail("variable_number")
    return i


# ---- modal information and positions ------------------------------------------------------------


def _modal(group: str) -> Read:
    return lambda m, _i: float(m.channel.mode[group][1:])


def _interrupted(group: str) -> Read:
    """A modal code of the block that an interruption macro has cut."""

    def read(m: MacroMemory, _i: int) -> float | None:
        running = m.interruptions.running if m.interruptions is not None else []
        return float(running[-1].mode[group][1:]) if running else None

    return read


def _feed(m: MacroMemory, _i: int) -> float:
    feed = m.channel.feed
    if feed != feed:
        return 0.0
    scale = 1.0 if m.channel.mode["feed"] in ("G95", "G99") else 60.0
    return round(m.to_program_unit(feed * scale), 6)


def _end_point(m: MacroMemory, i: int) -> float:
    """Work coordinates of the block end, as programmed."""
    return m.to_program_unit(m.channel.coordinates.position[_axis(m, i)])


def _machine(m: MacroMemory, i: int) -> float:
    """Machine position now."""
    return m.to_program_unit(m.channel.coordinates.machine[_axis(m, i)])


def _work_with_length(m: MacroMemory, i: int) -> float:
    """Work position now: machine position less work zero, the tool length not taken off."""
    axis = _axis(m, i)
    return m.to_program_unit(m.channel.coordinates.position[axis] + m.length_offset[axis])


def _skip(m: MacroMemory, i: int) -> float:
    """Where the last G31 ended; as the work position, with the tool length in it."""
    axis = _axis(m, i)
    position = m.skip_position or m.channel.coordinates.position
    return m.to_program_unit(position[axis] + m.length_offset[axis])


def _length(m: MacroMemory, i: int) -> float:
    return m.to_program_unit(m.length_offset[_axis(m, i)])


def _nothing(_m: MacroMemory, _i: int) -> float:
    return 0.0


def _extended(m: MacroMemory, _i: int) -> float:
    return float(m.wcs[7:]) if m.wcs.startswith("G54.1 P") else 0.0


def _sequence(m: MacroMemory, _i: int) -> float:
    return float(sequences_of(m.channel.level).sequence(m.channel.level.current))


def _program(m: MacroMemory, _i: int) -> float:
    return float(m.channel.level.code.program.number or 0)


def _main_program(m: MacroMemory, _i: int) -> float:
    return float(m.channel.stack[0].code.program.number or 0)


#: Modal groups in the order of #4001 to #4030 (machining centres).
MILLING_GROUPS = {1: "motion", 2: "plane", 3: "distance", 4: "stroke", 5: "feed", 6: "unit", 7: "compensation",
                  8: "length", 9: "cycle", 10: "return", 11: "scaling", 12: "macro", 13: "surface_speed", 14: "wcs",
                  15: "path", 16: "rotation", 17: "polar", 22: "mirror"}  # fmt: skip


def _rows_modal(first: int, groups: dict[int, str]) -> list[SystemRange]:
    rows = [SystemRange(first + n, first + n, _modal(group)) for n, group in groups.items()]
    words: dict[int, Read] = {
        102: _nothing,
        108: _nothing,
        107: lambda m, _i: float(m.d),
        109: _feed,
        111: lambda m, _i: float(m.h),
        113: lambda m, _i: float(m.last_m),
        114: _sequence,
        115: _program,
        119: lambda m, _i: float(m.spindle_speed),
        120: lambda m, _i: float(m.next_tool),
        130: _extended,
    }
    return rows + [SystemRange(first + n, first + n, read) for n, read in words.items()]


def _rows_positions() -> list[SystemRange]:
    rows: list[SystemRange] = []
    for first, further, name, read in (
        (5001, 100001, "_ABSIO", _end_point),
        (5021, 100051, "_ABSMT", _machine),
        (5041, 100101, "_ABSOT", _work_with_length),
        (5061, 100151, "_ABSKP", _skip),
        (5081, 100201, "_TOFS", _length),
        (5101, 100251, "_SVERR", _nothing),
        (5181, 100801, "_DIST", _nothing),
    ):
        rows += [SystemRange(first, first + 19, read, name=name), SystemRange(further, further + 49, read)]
    return rows


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


def _rows_tools() -> list[SystemRange]:
    return [
        SystemRange(2001, 2200, *_tool_field("length_wear")),
        SystemRange(2201, 2400, *_tool_field("length")),
        SystemRange(10001, 10999, *_tool_field("length_wear"), name="_OFSHW"),
        SystemRange(11001, 11999, *_tool_field("length"), name="_OFSHG"),
        SystemRange(12001, 12999, *_tool_field("radius_wear"), name="_OFSDW"),
        SystemRange(13001, 13999, *_tool_field("radius"), name="_OFSDG"),
    ]


def modal_names() -> dict[str, tuple[int, int]]:
    """Names of modal information: `_BUFG[g]` of the blocks before, `_ACTG` of the running one, `_INTG` interrupted."""
    words = {"B": 102, "D": 107, "E": 108, "F": 109, "H": 111, "M": 113, "N": 114, "O": 115, "S": 119, "T": 120,
             "WZP": 130}  # fmt: skip
    names: dict[str, tuple[int, int]] = {}
    for prefix, first in (("_BUF", 4000), ("_ACT", 4200), ("_INT", 4400)):
        names[prefix + "G"] = (first + 1, first + 30)
        names |= {prefix + word: (first + number, first + number) for word, number in words.items()}
    return names


#: What every FANUC control has.
COMMON_VARIABLES = [
    SystemRange(1000, 1015, _signal("UI"), name="_UI"),
    SystemRange(1032, 1032, _signal_word("UI"), name="_UIW"),
    SystemRange(1100, 1115, _signal("UO"), _set_signal, name="_UO"),
    SystemRange(1132, 1132, _signal_word("UO"), _set_signal_word, name="_UOW"),
    SystemRange(3000, 3000, None, _raise_user_alarm, name="_ALM"),
    SystemRange(3001, 3001, *_clock("clock1", 0.001), name="_CLOCK1"),
    SystemRange(3002, 3002, *_clock("clock2", 3600.0), name="_CLOCK2"),
    SystemRange(3003, 3003, *_switch("cntl1"), name="_CNTL1"),
    SystemRange(3004, 3004, *_switch("cntl2"), name="_CNTL2"),
    SystemRange(3005, 3005, *_switch("settings"), name="_SETDT"),
    SystemRange(3006, 3006, None, _show_and_stop, name="_MSGSTP"),
    SystemRange(3007, 3007, _nothing, name="_MRIMG"),
    SystemRange(3008, 3008, _nothing, name="_PRSTR"),
    SystemRange(3011, 3011, lambda m, _i: float(m.date), name="_DATE"),
    SystemRange(3012, 3012, lambda m, _i: float(m.time), name="_TIME"),
    SystemRange(3100, 3100, lambda _m, _i: None, name="_EMPTY"),
    SystemRange(3101, 3101, lambda _m, _i: 3.141592653589793, name="_PI"),
    SystemRange(3102, 3102, lambda _m, _i: 2.718281828459045, name="_E"),
    SystemRange(3901, 3901, *_switch("parts"), name="_PRTSA"),
    SystemRange(3902, 3902, *_switch("parts_required"), name="_PRTSN"),
    SystemRange(4000, 4000, _main_program, name="_MAINO"),
]

MILLING_VARIABLES = Registry(
    COMMON_VARIABLES
    + _rows_modal(4000, MILLING_GROUPS)
    + _rows_modal(4200, MILLING_GROUPS)
    + [SystemRange(4400 + n, 4400 + n, _interrupted(group)) for n, group in MILLING_GROUPS.items()]
    + _rows_positions()
    + _rows_work_offsets()
    + _rows_tools(),
    modal_names(),
)
