"""Rows that are prepared become stretches of a run that a law leads."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from math import inf

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.kernels.arcs import asked_on_arc
from polycnc.motion.kernels.columns import ContextRecord, new_state
from polycnc.motion.kernels.feeds import counted_length, follows_radius, radius_on_line, straight_speed
from polycnc.motion.third_order.bends.stretches import ARC
from polycnc.motion.third_order.laying.room import RunRoom
from polycnc.motion.third_order.laying.rows import NO_STRETCH, add_row, begin_run, goes_by_law

if TYPE_CHECKING:
    from array import array

    from polycnc.mainrun.preparation.items import ChannelRates, Move
    from polycnc.mainrun.preparation.layout import PreparedRow
    from polycnc.motion.third_order.bends.stretches import Stretches

#: FREE of the kernels: no feed bounds a stretch, for overrides act on that.
WITHOUT_FEED = 1.0


class RowOfRun(NamedTuple):
    """A row of a run: where it begins and ends along it, mm, and what its axes allow as a square of the speed."""

    move: Move
    begin: float
    end: float
    top2: float


class LawRows:
    """The rows of a run, in order.

    Args:
        n: Number of axes.
        rates: What the operator has set.

    Attributes:
        rows: Those that are known, and do not lie behind.
        bars: One was not to be run when it became known.
    """

    def __init__(self, n: int, rates: ChannelRates) -> None:
        self._room, self._n, self._rates = RunRoom(n), n, rates
        self.rows: list[RowOfRun] = []
        self._ends: list[float] = []
        self._found: dict[float, RowOfRun] = {}
        self.bars = False

    def add(self, move: Move, contexts: array[float]) -> bool:
        """Let the run go on along a row; false where that is not of it, or the axes rest before it."""
        prepared, room = move.prepared, self._room
        if prepared is None or prepared.rows is None:
            return False
        rows, limits = prepared.rows, prepared.limits
        record = rows.context[0] * (ContextRecord.OFFSETS + self._n)
        if not goes_by_law(rows.kind[0], record, contexts, limits):
            return False
        if not self.rows:
            room.tell(limits)
            start = new_state(self._n, prepared.before.vectors[0])
            begin_run(self._n, room.path, start, room.lead, room.laid)
            room.lead.run.free = WITHOUT_FEED
        elif prepared.rests:
            return False
        first, begin = room.laid.stretches, room.path.way[room.laid.stretches]
        while not add_row(
            rows,
            0,
            prepared.curves,
            prepared.number,
            contexts,
            limits,
            room.lead,
            room.path,
            room.slots,
            room.laid,
        ):
            if room.laid.why != NO_STRETCH:
                return False
            room.laid.why = 0
            room.widen()
        count = room.laid.stretches
        if count == first:
            return True  # it has no way
        if follows_radius(contexts, record, room.lead):
            move.asks = self._asks(prepared, record, contexts, first)
        end, top2 = room.path.way[count], min(room.path.cap2[first:count])
        row = RowOfRun(move, begin, end, top2)
        self.rows.append(row)
        self._ends.append(end)
        self._found[move.row] = row
        for e in range(first, count):
            share = (0.5 * (room.path.way[e] + room.path.way[e + 1]) - begin) / (end - begin)
            cap2 = self._rates.cap2(move, room.path.cap2[e], move.asked(share))
            self.bars = self.bars or cap2 == 0.0
            room.path.cap2[e] = cap2 or room.path.cap2[e]
        return True

    def _asks(
        self, prepared: PreparedRow, record: int, contexts: array[float], first: int
    ) -> tuple[tuple[float, float], ...]:
        """What the program asks for in the stretches of a row whose spindle follows the radius, by shares of its way.

        Each has the radius in its middle, as in the plan (`add_line`, `add_arc`).
        """
        lead, limits, way = self._room.lead, prepared.limits, self._room.path.way
        count, begin = self._room.laid.stretches - first, way[first]
        told, asks = (prepared.curves, contexts, record), []
        for part in range(count):
            middle = (part + 0.5) / count
            if self._room.path.form[first] == ARC:
                asked = asked_on_arc(*told, limits, lead, way[first + count] - begin, middle)
            else:
                length, weight = counted_length(contexts, record, self._n, limits, lead)
                radius = radius_on_line(contexts, record, limits, lead, middle)
                asked = straight_speed(*told, lead, length, radius, weight)
            share = (way[first + part + 1] - begin) / (way[first + count] - begin)
            asks.append((share, asked if asked > 0.0 else inf))
        return tuple(asks)

    def forget(self, row: RowOfRun) -> None:
        """Nobody will ask for what lies before a row."""
        behind = bisect_right(self._ends, row.begin)
        if 2 * behind > len(self.rows):
            for each in self.rows[:behind]:
                del self._found[each.move.row]
            del self.rows[:behind], self._ends[:behind]

    def take(self, *, closed: bool) -> Stretches:
        """The stretches that nobody has taken; of a run that goes on, all but the last one, which a row may meet."""
        return self._room.cut_off(0 if closed else 1)

    @property
    def is_one_line(self) -> bool:
        """Whether the run, as far as it is known, is one straight row."""
        return len(self.rows) == 1 and self._room.laid.stretches == 1

    @property
    def waits(self) -> int:
        """How many stretches nobody has taken."""
        return self._room.laid.stretches

    def cap2(self, begin: float, end: float, *, asked: bool) -> float:
        """Largest square of the speed between two ways, by what the rows allow, and by what is asked for."""
        k, found = min(bisect_right(self._ends, begin), len(self.rows) - 1), inf
        while k < len(self.rows) and (self.rows[k].begin < end or found == inf):
            row = self.rows[k]
            found = min(found, row.top2)
            if asked:
                middle = 0.5 * (max(begin, row.begin) + min(end, row.end))
                found = min(found, self._asked2(row, (middle - row.begin) / (row.end - row.begin)))
            k += 1
        return found

    def _asked2(self, row: RowOfRun, share: float = 0.5) -> float:
        """Square of the speed at a share of a row, by what the operator has set."""
        return self._rates.cap2(row.move, row.top2, row.move.asked(min(max(share, 0.0), 1.0)))

    def barred_from(self, way: float, far: float) -> float:
        """Where the first row ahead begins, before a way, that may not be run now: behind the row at another one."""
        first, end = bisect_right(self._ends, way) + 1, bisect_right(self._ends, far) + 1
        return next((row.begin for row in self.rows[first:end] if self._asked2(row) == 0.0), inf)

    def number_from(self, way: float) -> float:
        """Number of the first row that begins at a way or behind it; inf where it is not known."""
        k = bisect_left(self._ends, way) + 1
        return self.rows[k].move.row if k < len(self.rows) else inf

    def find(self, number: float) -> RowOfRun | None:
        """The row of a number."""
        return self._found.get(number)
