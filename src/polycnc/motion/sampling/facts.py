"""What samples must know of the rows that they belong to, as columns: chunk by chunk noted, and forgotten behind."""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.standing.waits import ORIENT
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.events import Auxiliary
from polycnc.toolpath.kinds import CURVE_WIDTH

if TYPE_CHECKING:
    from polycnc.motion.planner import Planner
    from polycnc.motion.sampling.run import Numbers, Places
    from polycnc.toolpath import Toolpath
    from polycnc.toolpath.table import Chunk


class RowFacts(NamedTuple):
    """What a sample must know of its row."""

    kind: int
    program: int
    line: int
    context: Context
    rpm: float
    lead: float


class Facts:
    """Those of all rows that samples may still come of.

    Args:
        toolpath: The toolpath.
        planner: Plans it, and knows how fast the spindle turns.
    """

    def __init__(self, toolpath: Toolpath, planner: Planner) -> None:
        import numpy as np

        self._toolpath, self._planner = toolpath, planner
        self._first = 0
        nothing: Places = np.zeros(0, np.int64)
        self._kind = self._program = self._line = self._context = nothing
        self._rpm: Numbers = np.zeros(0)
        self._leads: dict[int, float] = {}

    @property
    def end(self) -> int:
        """The row behind the last one."""
        return self._first + len(self._kind)

    def take(self, chunk: Chunk) -> None:
        """Note the rows of a chunk."""
        import numpy as np

        columns = chunk.numpy()
        if not len(self._kind):
            self._first = chunk.first
        self._kind = np.concatenate([self._kind, columns.kind])
        self._program = np.concatenate([self._program, columns.program])
        self._line = np.concatenate([self._line, columns.line])
        self._context = np.concatenate([self._context, columns.context])
        self._rpm = np.concatenate((self._rpm, self._speeds(chunk)))
        threads = np.isin(columns.kind, (Kind.THREAD, Kind.TAP)) & (columns.curve >= 0)
        for row in np.flatnonzero(threads).tolist():
            self._leads[chunk.first + row] = chunk.curves[chunk.curve[row] * CURVE_WIDTH]

    def _speeds(self, chunk: Chunk) -> Numbers:
        """Speed of the spindle in every row, (n,)."""
        import numpy as np

        speeds, facing, n = np.zeros(len(chunk)), self._planner.facing, chunk.axes
        for number, first, end in chunk.context_runs():
            context = self._toolpath.contexts[number]
            if not context.surface_speed or facing < 0:
                speeds[first:end] = context.spindle_direction * self._planner.rpm(context, 0.0)
                continue
            radii = chunk.end[first * n + facing : end * n : n]
            speeds[first:end] = [
                context.spindle_direction * self._planner.rpm(context, abs(radius)) for radius in radii
            ]
        for row in np.flatnonzero(chunk.numpy().kind == Kind.EVENT).tolist():
            event = chunk.events[chunk.curve[row]]
            if (
                isinstance(event, Auxiliary) and event.code == ORIENT
            ):  # where the context is still the one before
                speeds[row] = 0.0
        return speeds

    def of(self, row: int) -> RowFacts | None:
        """The facts of a row; None where it is forgotten."""
        k = row - self._first
        if not 0 <= k < len(self._kind):
            return None
        context = self._toolpath.contexts[int(self._context[k])]
        numbers = int(self._kind[k]), int(self._program[k]), int(self._line[k])
        return RowFacts(*numbers, context, float(self._rpm[k]), self._leads.get(row, 0.0))

    def places(self, rows: Places) -> tuple[Places, Places]:
        """Program and line of rows, (k,) each."""
        return self._program[rows - self._first], self._line[rows - self._first]

    def rpm(self, rows: Places) -> Numbers:
        """Speed of the spindle in rows, (k,)."""
        return self._rpm[rows - self._first]

    def forget(self, before: int) -> None:
        """Nobody asks for a row before this one."""
        k = before - self._first
        if k <= len(self._kind) // 2:  # to drop a few would move all others
            return
        self._kind, self._program = self._kind[k:].copy(), self._program[k:].copy()
        self._line, self._context = self._line[k:].copy(), self._context[k:].copy()
        self._rpm = self._rpm[k:].copy()
        self._first = before
        for row in [row for row in self._leads if row < before]:
            del self._leads[row]
