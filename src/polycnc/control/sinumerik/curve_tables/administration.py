"""Curve tables by number: deletion, locks, properties, resources (job planning 9.2.2 to 9.2.5, 9.2.7)."""

from __future__ import annotations

from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.curve_tables.memory import (
    DYNAMIC,
    LINE,
    MEMORIES,
    POLYNOMIAL,
    CurveTables,
    Usage,
    limits,
    memory_named,
    table_of,
)
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel

    Amount = Callable[[SinumerikChannel, str], Usage]
    Counting = Callable[[SinumerikChannel, Arguments], int]

#: What functions say of a table that is not there.
NONE = -1
#: CTABISLOCK: locked by CTABLOCK, used by a coupling; both add up.
_LOCKED, _USED = 1, 2


def _named(channel: SinumerikChannel, name: str, args: Arguments) -> list[int]:
    """The tables that `(n)`, `(n,m)`, `(n,m,memory)`, `()` or `(,,memory)` name, those that are there."""
    first, last, memory = (*args, None, None, None)[:3]
    if len(args) > 3 or (first is None and last is not None):
        raise AlarmError("14020", text=name)
    memories = MEMORIES if memory is None else (memory_named(channel, memory),)
    tables = CurveTables.of(channel)
    numbers = sorted(number for each in memories for number in tables.of_memory(each))
    if first is None:
        return numbers
    low = arguments.whole(first)
    high = low if last is None else arguments.whole(last)
    if high < low:
        raise AlarmError("14020", text=f"{name}({low},{high})")
    return [number for number in numbers if low <= number <= high]


def delete(channel: SinumerikChannel, args: Arguments) -> None:
    """CTABDEL: tables are no more; none of them goes where one is locked or used by a coupling."""
    tables, numbers = CurveTables.of(channel), _named(channel, "CTABDEL", args)
    if not any(map(tables.is_protected, numbers)):
        tables.delete(numbers)


def lock(channel: SinumerikChannel, args: Arguments) -> None:
    """CTABLOCK: tables may neither be deleted nor overwritten."""
    CurveTables.of(channel).lock(_named(channel, "CTABLOCK", args))


def unlock(channel: SinumerikChannel, args: Arguments) -> None:
    """CTABUNLOCK: they may again; those that a coupling uses as soon as it ends."""
    CurveTables.of(channel).unlock(_named(channel, "CTABUNLOCK", args))


# ---- properties


def exists(channel: SinumerikChannel, args: Arguments) -> bool:
    """CTABEXISTS(n)."""
    return CurveTables.of(channel).find(args[0]) is not None


def number_at(channel: SinumerikChannel, args: Arguments) -> int:
    """CTABID(p,memory): number of the p-th table; the first one has the highest number. -1 beyond the last one."""
    tables = CurveTables.of(channel).of_memory(memory_named(channel, args[1]))
    numbers = sorted(tables, reverse=True)
    return numbers[args[0] - 1] if 1 <= args[0] <= len(numbers) else NONE


def lock_state(channel: SinumerikChannel, args: Arguments) -> int:
    """CTABISLOCK(n): 0 free, 1 by CTABLOCK, 2 by a coupling, 3 by both; -1 for no table."""
    tables, number = CurveTables.of(channel), args[0]
    if tables.find(number) is None:
        return NONE
    return _LOCKED * (number in tables.locks) + _USED * tables.is_used(number)


def memory_type(channel: SinumerikChannel, args: Arguments) -> int:
    """CTABMEMTYP(n): 0 static, 1 dynamic memory; -1 for no table."""
    memory = CurveTables.of(channel).memory_of(args[0])
    return NONE if memory is None else int(memory == DYNAMIC)


def periodicity(channel: SinumerikChannel, args: Arguments) -> int:
    """CTABPERIOD(n): as in CTABDEF; -1 for no table."""
    table = CurveTables.of(channel).find(args[0])
    return NONE if table is None else table.period


# ---- resources


def count(channel: SinumerikChannel, _args: Arguments) -> int:
    """CTABNO: tables in both memories."""
    return sum(len(CurveTables.of(channel).of_memory(memory)) for memory in MEMORIES)


def _of_kind(segments: Mapping[str, int], kind: object) -> int:
    """Segments of the named kind; of both without one."""
    if kind is None:
        return sum(segments.values())
    if str(kind).upper() not in segments:
        raise AlarmError("14020", text=str(kind))
    return segments[str(kind).upper()]


def _used(channel: SinumerikChannel, memory: str) -> Usage:
    return Usage.of(CurveTables.of(channel).of_memory(memory).values())


def _free(channel: SinumerikChannel, memory: str) -> Usage:
    most, used = limits(channel, memory), _used(channel, memory)
    return Usage(
        most.tables - used.tables,
        {kind: most.segments[kind] - used.segments[kind] for kind in (LINE, POLYNOMIAL)},
        most.polynomials - used.polynomials,
    )


def _tables(amount: Amount) -> Counting:
    """CTABNOMEM, CTABFNO (memory): tables."""
    return lambda channel, args: amount(channel, memory_named(channel, args[0])).tables


def _segments(amount: Amount) -> Counting:
    """CTABSEG, CTABFSEG, CTABMSEG (memory,kind): segments."""
    return lambda channel, args: _of_kind(amount(channel, memory_named(channel, args[0])).segments, args[1])


def _polynomials(amount: Amount) -> Counting:
    """CTABPOL, CTABFPOL, CTABMPOL (memory): polynomials."""
    return lambda channel, args: amount(channel, memory_named(channel, args[0])).polynomials


def segments_of(channel: SinumerikChannel, args: Arguments) -> int:
    """CTABSEGID(n,kind): segments of a table."""
    return _of_kind(Usage.of((table_of(channel, args[0]),)).segments, args[1])


def polynomials_of(channel: SinumerikChannel, args: Arguments) -> int:
    """CTABPOLID(n): polynomials of a table."""
    return Usage.of((table_of(channel, args[0]),)).polynomials


PROCEDURES = {"CTABDEL": delete, "CTABLOCK": lock, "CTABUNLOCK": unlock}
FUNCTIONS = {
    "CTABEXISTS": exists,
    "CTABID": number_at,
    "CTABISLOCK": lock_state,
    "CTABMEMTYP": memory_type,
    "CTABPERIOD": periodicity,
    "CTABNO": count,
    "CTABNOMEM": _tables(_used),
    "CTABFNO": _tables(_free),
    "CTABSEGID": segments_of,
    "CTABSEG": _segments(_used),
    "CTABFSEG": _segments(_free),
    "CTABMSEG": _segments(limits),
    "CTABPOLID": polynomials_of,
    "CTABPOL": _polynomials(_used),
    "CTABFPOL": _polynomials(_free),
    "CTABMPOL": _polynomials(limits),
}
