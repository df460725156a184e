"""Runs with limited jerk as the planner leads them: from rows to windows, each with its path and its law."""

from __future__ import annotations

from array import array
from bisect import bisect_left, bisect_right
from collections import deque

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, cast
from polycnc.motion.compiled import run_kernel
from polycnc.motion.kernels.columns import CURVE_WIDTH, SHARES, Rows, State
from polycnc.motion.third_order.laws.compiled import kernels
from polycnc.motion.third_order.laws.courses import Phase
from polycnc.motion.third_order.laws.records import NEAR, RowEnds, Track, Walk
from polycnc.motion.third_order.laying.room import RunRoom, axes_of
from polycnc.motion.third_order.laying.rows import NO_STRETCH, ROW_ENDS, RUN_ENDS
from polycnc.motion.third_order.parts import whole
from polycnc.motion.third_order.runs import Rooms, RunPlanner

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.motion.kernels.columns import Limits
    from polycnc.motion.third_order.windows import Window


class LedWindow(NamedTuple):
    """A window of a run, with its rows.

    Attributes:
        track: Its path.
        phases: Its law.
        rows: The rows that lie in it; the last one may end behind it.
        walk: From where on no records have been written.
        planned_rows: Number of the first row that is not planned with it: that which goes on behind it, or the one
            behind the run.
    """

    track: Track
    phases: array[float]
    rows: RowEnds
    walk: Walk
    planned_rows: int

    def add_times(self, slots: array[float], times: array[float], first_row: int) -> None:
        """Add up how long its rows take: in their slots, and for each row from one on (`laws/records.py`)."""
        walk = Walk.from_buffer_copy(self.walk)
        kernels().add_times(self.phases, self.rows, walk, slots, times, first_row)

    def put_records(self, records: array[float]) -> int:
        """Write the records of its next pieces; their number, 0 where all are written."""
        return kernels().put_records(self.track, self.phases, self.rows, self.walk, records)


class LawRuns:
    """The run that is being laid.

    Args:
        n: Number of axes.
        compiled: Use compiled kernels where they are there.

    Attributes:
        windows: Those that are settled, in order; whoever takes one, takes it away.
        room: Stretches that are not in a window yet.
        reached: The first row that is not laid yet.
    """

    def __init__(self, n: int, *, compiled: bool = True) -> None:
        self._n = n
        self._lay = run_kernel(compiled=compiled)
        self.windows: deque[LedWindow] = deque()
        self.room = RunRoom(n)
        self.reached = 0
        #: The row of each stretch that is handed on, but for those of rows that have ended in a window.
        self._rows = array("q")
        self._planner: RunPlanner | None = None
        self._rooms = Rooms()
        #: The first row of a run, for which the next chunk may come before it is known what it is.
        self._row: tuple[Rows, array[float]] | None = None

    @property
    def is_open(self) -> bool:
        """Whether a run is laid, and not over."""
        return self.room.is_open

    def lay(
        self,
        rows: Rows,
        first: int,
        curves: array[float],
        number: int,
        contexts: array[float],
        limits: Limits,
        pieces: array[float],
        state: State,
    ) -> tuple[int, int]:
        """Lay rows out, see `lay_runs`; the next row, and what the kernel has stopped for."""
        room, laid = self.room, self.room.laid
        if not self.is_open:
            room.tell(limits)
        while True:
            first = self._lay(
                rows, first, curves, number, contexts, limits, pieces, state,
                room.lead, room.path, room.slots, laid,
            )  # fmt: skip
            self.reached = number + first
            if laid.why != NO_STRETCH:
                break
            if not room.grow():
                self._hand_on(limits, left=1)
        if laid.why not in (RUN_ENDS, ROW_ENDS):
            self._keep(rows, curves, number)
        return first, laid.why

    @property
    def row(self) -> tuple[Rows, array[float], int]:
        """The only row of a run that is over, its curve parameters and its number; it is a straight one."""
        assert self._row is not None
        number = self.room.laid.first_row
        self.room.clear()
        return (*self._row, number)

    @property
    def is_row(self) -> bool:
        """Whether the run, as far as it is laid, is one straight row."""
        laid = self.room.laid
        return laid.rows == 1 and laid.stretches == 1 and self._planner is None

    def end(self, limits: Limits) -> None:
        """The run is over: the rest of its windows are settled."""
        self._hand_on(limits, left=0).finish()
        self._planner = None
        self.room.clear()
        del self._rows[:]

    def _hand_on(self, limits: Limits, *, left: int) -> RunPlanner:
        """Hand all stretches on but so many, which the next row may meet."""
        if self._planner is None:
            self._planner = RunPlanner(axes_of(limits), self._note, rooms=self._rooms)
        taken = self.room.cut_off(left)
        self._rows.extend(cast("array[int]", taken.row))
        self._planner.take(taken, closed=left == 0)
        return self._planner

    def _note(self, window: Window) -> None:
        """A window is settled."""
        part = window.part
        ended, ways = part.rows[:], part.row_way[:]
        del self._rows[: bisect_right(self._rows, ended[-1]) if ended else 0]
        planned = ended[-1] + 1 if ended else 0
        if not ways or ways[-1] < part.way[-1] - NEAR:  # a row goes on behind the window
            planned = self._rows[0]
            ended.append(planned)
            ways.append(part.way[-1])
        track = Track(part.way, part.place, part.first, part.second, part.cap2)
        walk = Walk(axes=self._n, pieces=len(part.cap2), phases=len(window.phases) // Phase.SIZE)
        rows = RowEnds(ways, ended, self._slots_of(ended))
        self.windows.append(LedWindow(track, window.phases, rows, walk, planned))

    def _slots_of(self, rows: Sequence[int]) -> array[int]:
        """The slot of each row."""
        found, count, pairs = whole(len(rows)), self.room.laid.slots, self.room.slots
        since, slots = pairs[0 : 2 * count : 2], pairs[1 : 2 * count : 2]
        for k, slot in enumerate(slots):
            begin = bisect_left(rows, since[k]) if k else 0
            end = bisect_left(rows, since[k + 1]) if k + 1 < count else len(rows)
            found[begin:end] = array("q", (slot,)) * (end - begin)
        return found

    def _keep(self, rows: Rows, curves: array[float], number: int) -> None:
        """Keep the only row of a run that is open, for its chunk goes."""
        row = self.room.laid.first_row - number
        if not self.is_row or not 0 <= row < len(rows.kind):
            return
        n, own = self._n, slice(row, row + 1)
        at = rows.curve[row] * CURVE_WIDTH
        curve = curves[at : at + CURVE_WIDTH] if at >= 0 else array("d")
        shares = (column[row * SHARES : (row + 1) * SHARES] for column in (rows.share, rows.top, rows.ease))
        kept = Rows(
            rows.kind[own], rows.context[own], rows.feed[own], rows.end[row * n : (row + 1) * n],
            array("i", [0 if at >= 0 else -1]), array("B"), *shares,
        )  # fmt: skip
        self._row = kept, curve
