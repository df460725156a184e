"""Workpiece counters: `$AC_REQUIRED_PARTS`, `$AC_TOTAL_PARTS`, `$AC_ACTUAL_PARTS`, `$AC_SPECIAL_PARTS` (14.8.3).

MD27880 says which of them count, and whether at M2 and M30 or at an M function of MD27882.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State, retained
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import Alarm, AlarmError
from polycnc.toolpath.events import Deed

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, RowWithStop

MODE, CODES = "$MC_PART_COUNTER", "$MC_PART_COUNTER_MCODE"
REQUIRED, TOTAL, ACTUAL, SPECIAL = (
    "$AC_REQUIRED_PARTS", "$AC_TOTAL_PARTS", "$AC_ACTUAL_PARTS", "$AC_SPECIAL_PARTS",
)  # fmt: skip
MOST = 999_999_999
#: MD27880: the target is watched; by the special counter, else by that of the parts so far.
IS_WATCHED, BY_SPECIAL = 1, 2
#: M functions that end a program.
ENDS = (2, 30)
TARGET_REACHED = "21800"


class Counter(NamedTuple):
    """Bits of MD27880 and place in MD27882 of a counter."""

    counts: int
    by_m_function: int
    place: int


COUNTERS = {TOTAL: Counter(4, 5, 0), ACTUAL: Counter(8, 9, 1), SPECIAL: Counter(12, 13, 2)}


@dataclass(slots=True)
class PartCounts(State, lifetime=Lifetime.POWER):
    """The counters by their variables; they last beyond power-off."""

    counts: dict[str, int] = retained("workpiece counters")


def count(channel: SinumerikChannel, code: int) -> None:
    """An M function, M2 and M30 too: the counters that go by it count when the axes are there."""
    mode, data = channel.memory.data.integer(MODE), channel.memory.data
    counting = [
        name
        for name, counter in COUNTERS.items()
        if mode >> counter.counts & 1
        and (
            code == data.integer(CODES, counter.place) if mode >> counter.by_m_function & 1 else code in ENDS
        )
    ]
    if not counting:
        return

    program = channel.level.code.program
    alarm = Alarm(channel.control.id, TARGET_REACHED, program.name, channel.line, channel=channel.number)

    def do() -> None:
        for name in counting:
            if (
                _add(channel, name)
                and mode & IS_WATCHED
                and name == (SPECIAL if mode & BY_SPECIAL else ACTUAL)
            ):
                channel.alarms.append(alarm)

    if channel.main_run is None:
        do()
    else:
        channel.event(Deed("PARTS", None, do))


def _add(channel: SinumerikChannel, name: str) -> bool:
    """A part more; whether that is the target, at which the parts so far begin again."""
    counts = PartCounts.of(channel).counts
    counts[name] = min(counts.get(name, 0) + 1, MOST)
    reached = 0 < counts.get(REQUIRED, 0) <= counts[name]
    if reached and name == ACTUAL:
        counts[name] = 0
    return reached


def _counter(name: str) -> RowWithStop:
    def read(channel: SinumerikChannel, _indices: Indices) -> int:
        return PartCounts.of(channel).counts.get(name, 0)

    def write(channel: SinumerikChannel, _indices: Indices, value: Any) -> None:
        if not 0 <= value <= MOST:
            raise AlarmError("12560", text=name)
        PartCounts.of(channel).counts[name] = int(value)

    return Type.INT, read, write, True


PART_COUNTS: dict[str, RowWithStop] = {name: _counter(name) for name in (REQUIRED, *COUNTERS)}
