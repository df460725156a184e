"""The curve tables of the control: static memory outlives the power, dynamic memory does not (9.2.1, 9.2.4, 9.2.7).

A number is unique over both. A table is locked by CTABLOCK, and by couplings as long as they use it.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State, retained
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.curve_tables.curve import CurveTable
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Static and dynamic memory, as MD20905 and CTABMEMTYP number them.
STATIC, DYNAMIC = "SRAM", "DRAM"
MEMORIES = (STATIC, DYNAMIC)
#: Kinds of segments: lines, polynomials.
LINE, POLYNOMIAL = "L", "P"
CURVE_TABLES, CURVE_LOCKS = "curve tables", "curve table locks"
#: Machine data with the limits of each memory: tables, segments of polynomials, lines, polynomials.
_LIMITS = {
    STATIC: (
        "$MN_MM_NUM_CURVE_TABS",
        "$MN_MM_NUM_CURVE_SEGMENTS",
        "$MN_MM_NUM_CURVE_SEG_LIN",
        "$MN_MM_NUM_CURVE_POLYNOMS",
    ),
    DYNAMIC: (
        "$MN_MM_NUM_CURVE_TABS_DRAM",
        "$MN_MM_NUM_CURVE_SEGMENTS_DRAM",
        "$MN_MM_NUM_CURVE_SEG_LIN_DRAM",
        "$MN_MM_NUM_CURVE_POLYNOMS_DRAM",
    ),
}


@dataclass(slots=True)
class Usage:
    """What tables take up, or may take up: tables, segments by kind, polynomials."""

    tables: int = 0
    segments: dict[str, int] = field(default_factory=lambda: {LINE: 0, POLYNOMIAL: 0})
    polynomials: int = 0

    @classmethod
    def of(cls, tables: Iterable[CurveTable]) -> Usage:
        """Of some tables."""
        usage = cls()
        for table in tables:
            usage.tables += 1
            for segment in table.segments:
                usage.segments[LINE if segment.is_straight else POLYNOMIAL] += 1
                usage.polynomials += segment.polynomials
        return usage


@dataclass(slots=True)
class CurveTables(State, lifetime=Lifetime.POWER):
    """The tables, which all channels share.

    Attributes:
        static: Tables by number in static memory.
        locks: Numbers that CTABLOCK has locked; the value has no meaning.
        dynamic: Tables by number in dynamic memory.
        used: How many couplings use a table, by number.
        unlocked: Numbers whose lock ends with the last coupling that uses them.
    """

    static: dict[int, CurveTable] = retained(CURVE_TABLES, of_control=True)
    locks: dict[int, bool] = retained(CURVE_LOCKS, of_control=True)
    dynamic: dict[int, CurveTable] = field(default_factory=dict)
    used: dict[int, int] = field(default_factory=dict)
    unlocked: dict[int, bool] = field(default_factory=dict)

    @classmethod
    def first(cls, channel: Channel) -> CurveTables:
        """Those that are retained, and those that channels share."""
        made = cls(*(channel.retained.table(name, 0) for name in (CURVE_TABLES, CURVE_LOCKS)))
        shared = channel.group.shared if channel.group is not None else {}
        for name in ("dynamic", "used", "unlocked"):
            setattr(made, name, shared.setdefault(f"curve tables {name}", {}))
        return made

    def find(self, number: int) -> CurveTable | None:
        """The table of a number; None where there is none."""
        return self.static.get(number) or self.dynamic.get(number)

    def of_memory(self, memory: str) -> dict[int, CurveTable]:
        """The tables of one memory by number."""
        return self.static if memory == STATIC else self.dynamic

    def memory_of(self, number: int) -> str | None:
        """The memory of a table; None where there is none."""
        return next((memory for memory in MEMORIES if number in self.of_memory(memory)), None)

    # ---- locks ---------------------------------------------------------------------------------------------

    def is_used(self, number: int) -> bool:
        """Whether a coupling uses a table."""
        return self.used.get(number, 0) > 0

    def is_protected(self, number: int) -> bool:
        """Whether a table may neither be deleted nor overwritten."""
        return number in self.locks or self.is_used(number)

    def lock(self, numbers: Iterable[int]) -> None:
        """CTABLOCK."""
        for number in numbers:
            self.locks[number] = True
            self.unlocked.pop(number, None)

    def unlock(self, numbers: Iterable[int]) -> None:
        """CTABUNLOCK: at once, or as soon as no coupling uses the table any more."""
        for number in numbers:
            if number not in self.locks:
                continue
            if self.is_used(number):
                self.unlocked[number] = True
            else:
                del self.locks[number]

    def use(self, number: int) -> None:
        """A coupling uses a table from now on."""
        self.used[number] = self.used.get(number, 0) + 1

    def leave(self, number: int) -> None:
        """A coupling uses a table no more."""
        self.used[number] = self.used.get(number, 0) - 1
        if self.used[number] <= 0:
            del self.used[number]
            if self.unlocked.pop(number, False):
                self.locks.pop(number, None)

    # ---- tables --------------------------------------------------------------------------------------------

    def check_free(self, number: int) -> None:
        """Alarm 10940 where a number may not be defined anew."""
        if self.is_protected(number):
            raise AlarmError("10940", number=number)

    def put(self, channel: SinumerikChannel, table: CurveTable, memory: str) -> None:
        """Store a table; alarm 10941 where the memory is full."""
        self.check_free(table.number)
        others = [each for each in self.of_memory(memory).values() if each.number != table.number]
        needed, limit = Usage.of((*others, table)), limits(channel, memory)
        too_many = any(needed.segments[kind] > limit.segments[kind] for kind in needed.segments)
        if too_many or needed.tables > limit.tables or needed.polynomials > limit.polynomials:
            raise AlarmError("10941", number=table.number)
        self.delete((table.number,))
        self.of_memory(memory)[table.number] = table

    def delete(self, numbers: Iterable[int]) -> None:
        """Take tables away."""
        for number in numbers:
            self.static.pop(number, None)
            self.dynamic.pop(number, None)


def table_of(channel: SinumerikChannel, number: int) -> CurveTable:
    """The table of a number; alarm 16776 where there is none."""
    found = CurveTables.of(channel).find(number)
    if found is None:
        raise AlarmError("16776", number=number)
    return found


def memory_named(channel: SinumerikChannel, value: object) -> str:
    """The memory that an argument names; without one that of MD20905. Alarm 14020 for anything else."""
    if value is None:
        return MEMORIES[1 if channel.memory.data.integer("$MC_CTAB_DEFAULT_MEMORY_TYPE") else 0]
    memory = str(value).upper()
    if memory not in MEMORIES:
        raise AlarmError("14020", text=str(value))
    return memory


def limits(channel: SinumerikChannel, memory: str) -> Usage:
    """What a memory may hold (MD18400 to MD18410)."""
    tables, segments, lines, polynomials = (channel.memory.data.integer(name) for name in _LIMITS[memory])
    return Usage(tables, {LINE: lines, POLYNOMIAL: segments}, polynomials)
