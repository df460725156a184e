"""The least time of a block that a law leads, by which a function beside its motion is known to outlast it.

Plan and main run must both let the axes rest behind such a block, or neither may. What each has laid of it when it asks
differs: the plan has handed windows on, the main run has pieces that a corner has bent. So the rows are laid anew, each
from rest by itself, and count at the highest speed that feed and axes allow.
"""

from __future__ import annotations

from math import inf, sqrt

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.kernels.columns import DWELL, ContextRecord, Rows, new_state
from polycnc.motion.kernels.lay import take_row
from polycnc.motion.third_order.laying.room import RunRoom
from polycnc.motion.third_order.laying.rows import NO_STRETCH, add_row, begin_run, goes_by_law
from polycnc.motion.time_constants import use_of

if TYPE_CHECKING:
    from array import array
    from collections.abc import Mapping, Sequence

    from polycnc.motion.kernels.columns import Limits
    from polycnc.motion.limits import ContextTables
    from polycnc.motion.time_constants import Uses
    from polycnc.motion.transformed import RealAxes
    from polycnc.toolpath import Context


class ChunkRows(NamedTuple):
    """Rows of a chunk.

    Attributes:
        rows: Its columns.
        curves: Its curve parameters.
        number: Number of its first row in the toolpath.
        enters: Machine positions before rows where a transformation begins or ends.
        contexts: Of the toolpath.
        tables: What the kernels know of them.
        real: The machine, as a transformation shows it.
        uses: What rows run by.
    """

    rows: Rows
    curves: array[float]
    number: int
    enters: Mapping[int, Sequence[float]]
    contexts: Sequence[Context]
    tables: ContextTables
    real: RealAxes
    uses: Uses

    def least_seconds(self, first: int, last: int, n: int) -> float | None:
        """The least time of the rows `first` to `last`, of n axes; None where no law leads one of them.

        A row before them says where they begin.
        """
        moves = [row for row in range(first, last + 1) if self.rows.kind[row] < DWELL]
        if not any(self._is_led(row, n) for row in moves):
            return None
        room = RunRoom(n)
        return sum(self._seconds(row, n, room) for row in moves)

    def _told(self, row: int) -> tuple[array[float], Limits]:
        """Contexts and limits by which a row is laid."""
        context = self.contexts[self.rows.context[row]]
        use = use_of(self.rows.kind[row], context, self.uses)
        return self.tables.of(use), self.real.limits(context, use)

    def _is_led(self, row: int, n: int) -> bool:
        contexts, limits = self._told(row)
        record = self.rows.context[row] * (ContextRecord.OFFSETS + n)
        return goes_by_law(self.rows.kind[row], record, contexts, limits)

    def _seconds(self, row: int, n: int, room: RunRoom) -> float:
        """The least time of one row."""
        contexts, limits = self._told(row)
        start, path, laid = new_state(n), room.path, room.laid
        if row in self.enters:
            start.position[:n] = self.enters[row]
        else:
            take_row(self.rows, row - 1, self.curves, self.number, contexts, limits, start)
            start.position[:] = start.target
        begin_run(n, path, start, room.lead, laid)
        while not add_row(
            self.rows,
            row,
            self.curves,
            self.number,
            contexts,
            limits,
            room.lead,
            room.path,
            room.slots,
            laid,
        ):
            if laid.why != NO_STRETCH:
                return 0.0
            laid.why = 0
            room.widen()
        path = room.path
        ways = (path.way[e + 1] - path.way[e] for e in range(laid.stretches))
        return sum(
            way / sqrt(cap2) if cap2 > 0.0 else inf for way, cap2 in zip(ways, path.cap2, strict=False)
        )
