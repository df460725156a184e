"""System variables that all FANUC controls with custom macro B have (FANUC macro B reference §2).

A row names a range of variables and what reads and writes it; the functions get the offset within the range.
`milling_variables` and `turning_variables` add what belongs to their machines.
"""

from __future__ import annotations

from polycnc.control.word_address.auxiliary.functions import Clocks
from polycnc.control.word_address.macro_b.variables import ControlSwitches, Read, SystemRange, Write
from polycnc.control.word_address.memory import SentCodes
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.events import Message

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.word_address.macro_b.variables import MacroMemory

#: Date (YYYYMMDD) and time (HHMMSS) of the simulated clock: not the host's, so the same input gives the same output.
DATE, TIME_OF_DAY = 20000101.0, 0.0

# ---- interface signals ------------------------------------------------------------


def _signal(prefix: str) -> Read:
    return lambda m, i: float(bool(m.signals.get(f"{prefix}{i:03d}", 0)))


def _signal_word(prefix: str, first: int = 0, bits: int = 16) -> Read:
    """Signals as one number, from signal `first` on; 100 numbers on for each further variable of a range."""

    def read(m: MacroMemory, i: int) -> float:
        at = first + 100 * i
        return float(sum(1 << bit for bit in range(bits) if m.signals.get(f"{prefix}{at + bit:03d}")))

    return read


def _set_signal(m: MacroMemory, i: int, value: float | None, _text: str) -> None:
    m.signals[f"UO{i:03d}"] = int(bool(value))


def _set_signal_word(first: int = 0, bits: int = 16) -> Write:
    def write(m: MacroMemory, i: int, value: float | None, _text: str) -> None:
        word, at = int(value or 0.0), first + 100 * i
        for bit in range(bits):
            m.signals[f"UO{at + bit:03d}"] = word >> bit & 1

    return write


# ---- messages and control ------------------------------------------------------------


def _raise_user_alarm(m: MacroMemory, _i: int, value: float | None, text: str) -> None:
    """#3000 = n (TEXT)."""
    raise m.channel.control.macro_alarm(m.channel, int(value or 0.0), text)


def _show_and_stop(m: MacroMemory, _i: int, _value: float | None, text: str) -> None:
    """#3006 = 1 (TEXT): message, then stop as M00."""
    m.channel.event(Message(text))
    m.channel.stop("M00")


def _switch(name: str) -> tuple[Read, Write]:
    def read(m: MacroMemory, _i: int) -> float:
        return float(ControlSwitches.of(m.channel).values.get(name, 0))

    def write(m: MacroMemory, _i: int, value: float | None, _text: str) -> None:
        ControlSwitches.of(m.channel).values[name] = int(value or 0.0)
        m.channel.context_changed()

    return read, write


def _clock(name: str, unit: float) -> tuple[Read, Write]:
    """A clock in units of so many seconds: programmed dwells count, moves do not, because macros are read ahead.

    Each look takes a millisecond, so that a loop which waits for the clock ends.
    """

    def read(m: MacroMemory, _i: int) -> float:
        clocks = Clocks.of(m.channel)
        value = round((clocks.seconds - clocks.zero.get(name, 0.0)) / unit, 9)
        clocks.seconds += 0.001
        clocks.is_read = True
        return value

    def write(m: MacroMemory, _i: int, value: float | None, _text: str) -> None:
        clocks = Clocks.of(m.channel)
        clocks.zero[name] = clocks.seconds - (value or 0.0) * unit

    return read, write


# ---- modal information and positions ------------------------------------------------------------


def axis_at(m: MacroMemory, i: int) -> int:
    """The axis of a variable that stands for one; an alarm where the channel has no such axis."""
    if i >= len(m.channel.axes):
        raise m.fail("variable_number")
    return i


def nothing(_m: MacroMemory, _i: int) -> float:
    """What is always zero here."""
    return 0.0


def _feed(m: MacroMemory, _i: int) -> float:
    feed = m.channel.feed
    if feed != feed:
        return 0.0
    scale = 1.0 if m.channel.mode["feed"] in ("G95", "G99") else 60.0
    return round(m.to_program_unit(feed * scale), 6)


def _sequence(m: MacroMemory, _i: int) -> float:
    return float(m.channel.level.code.sequence(m.channel.level.current))


def _program(m: MacroMemory, _i: int) -> float:
    return float(m.channel.level.code.program.number or 0)


def _main_program(m: MacroMemory, _i: int) -> float:
    return float(m.channel.stack[0].code.program.number or 0)


def modal_rows(first: int, codes: Mapping[int, Read], words: Mapping[int, Read]) -> list[SystemRange]:
    """Modal codes by group and modal words, of the blocks before (4000) or the running one (4200)."""
    common: dict[int, Read] = {
        109: _feed,
        113: lambda m, _i: float(SentCodes.of(m.channel).m),
        114: _sequence,
        115: _program,
        119: lambda m, _i: float(m.spindle.speed),
    }
    return [SystemRange(first + n, first + n, read) for n, read in ({**codes, **common, **words}).items()]


#: Modal words by their number from that of the groups on.
_MODAL_WORDS = {"B": 102, "D": 107, "E": 108, "F": 109, "H": 111, "M": 113, "N": 114, "O": 115, "S": 119, "T": 120,
                "WZP": 130}  # fmt: skip
_MODAL_NAMES = {"_BUF": 4000, "_ACT": 4200, "_INT": 4400}


def modal_names(*prefixes: str) -> dict[str, tuple[int, int]]:
    """Names of modal information: `_BUFG[g]` of the blocks before, `_ACTG` of the running one, `_INTG` interrupted."""
    names: dict[str, tuple[int, int]] = {}
    for prefix in prefixes:
        first = _MODAL_NAMES[prefix]
        names[prefix + "G"] = (first + 1, first + 30)
        names |= {prefix + word: (first + number, first + number) for word, number in _MODAL_WORDS.items()}
    return names


#: Positions by axis: 20 axes, and 50 further on.
_POSITIONS = (
    (5001, 100001, "_ABSIO"),
    (5021, 100051, "_ABSMT"),
    (5041, 100101, "_ABSOT"),
    (5061, 100151, "_ABSKP"),
    (5081, 100201, "_TOFS"),
    (5101, 100251, "_SVERR"),
    (5181, 100801, "_DIST"),
)


def position_rows(*reads: Read) -> list[SystemRange]:
    """Positions by axis.

    Args:
        reads: The block's end, the machine, the work system, the last skip, the offset in force; then, where the
            control has them, servo deviation and distance to go.
    """
    rows: list[SystemRange] = []
    for (first, further, name), read in zip(_POSITIONS, reads, strict=False):
        rows += [SystemRange(first, first + 19, read, name=name), SystemRange(further, further + 49, read)]
    # The handwheel interrupts nothing here.
    return [*rows, SystemRange(5121, 5140, nothing, name="_MIRTP")]


#: What every FANUC control has.
COMMON_VARIABLES = [
    SystemRange(1000, 1015, _signal("UI"), name="_UI", index=0),
    SystemRange(1032, 1032, _signal_word("UI"), name="_UIW"),
    SystemRange(1033, 1035, _signal_word("UI", 100, 32), name="_UIL", index=0),
    SystemRange(1100, 1115, _signal("UO"), _set_signal, name="_UO", index=0),
    SystemRange(1132, 1132, _signal_word("UO"), _set_signal_word(), name="_UOW"),
    SystemRange(1133, 1135, _signal_word("UO", 100, 32), _set_signal_word(100, 32), name="_UOL", index=0),
    SystemRange(3000, 3000, None, _raise_user_alarm, name="_ALM"),
    SystemRange(3001, 3001, *_clock("clock1", 0.001), name="_CLOCK1"),
    SystemRange(3002, 3002, *_clock("clock2", 3600.0), name="_CLOCK2"),
    SystemRange(3003, 3003, *_switch("cntl1"), name="_CNTL1"),
    SystemRange(3004, 3004, *_switch("cntl2"), name="_CNTL2"),
    SystemRange(3005, 3005, *_switch("settings"), name="_SETDT"),
    SystemRange(3006, 3006, None, _show_and_stop, name="_MSGSTP"),
    SystemRange(3007, 3007, nothing, name="_MRIMG"),
    SystemRange(3008, 3008, nothing, name="_PRSTR"),
    SystemRange(3011, 3011, lambda _m, _i: DATE, name="_DATE"),
    SystemRange(3012, 3012, lambda _m, _i: TIME_OF_DAY, name="_TIME"),
    SystemRange(3100, 3100, lambda _m, _i: None, name="_EMPTY"),
    SystemRange(3101, 3101, lambda _m, _i: 3.141592653589793, name="_PI"),
    SystemRange(3102, 3102, lambda _m, _i: 2.718281828459045, name="_E"),
    SystemRange(3901, 3901, *_switch("parts"), name="_PRTSA"),
    SystemRange(3902, 3902, *_switch("parts_required"), name="_PRTSN"),
    SystemRange(4000, 4000, _main_program, name="_MAINO"),
]
