"""What the axes and the spindle do at even times: the sampled motion of a planned toolpath.

A `Sampler` listens to a planner. It needs the chunks (for lines and contexts), the waits and the final pieces, and
gives columns of samples, run by run; what it has given it forgets.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.motion.kernels.columns import PieceRecord, piece_width
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.kinds import CURVE_WIDTH

if TYPE_CHECKING:
    from array import array
    from collections.abc import Callable, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from polycnc.machine import Machine
    from polycnc.motion.planner import Planner
    from polycnc.motion.sampling.run import Moved, Numbers, Run
    from polycnc.motion.settings import Settings
    from polycnc.toolpath import Toolpath
    from polycnc.toolpath.table import Chunk

#: Samples that are worked out at once.
BATCH = 20_000


class Samples(NamedTuple):
    """Columns of samples, one row a time.

    Attributes:
        time: Seconds from the start, (k,).
        position: Machine positions, mm or degrees, (k, axes).
        velocity: Per second, (k, axes).
        acceleration: Per second squared, (k, axes).
        spindle_rpm: Speed of the master spindle, negative counter-clockwise, (k,).
        spindle_angle: Degrees turned since the start, (k,).
        program: Number of the program in the toolpath's list, (k,).
        line: Line of the program, (k,).
    """

    time: Numbers
    position: Numbers
    velocity: Numbers
    acceleration: Numbers
    spindle_rpm: Numbers
    spindle_angle: Numbers
    program: NDArray[np.int64]
    line: NDArray[np.int64]


class RowFacts(NamedTuple):
    """What a sample must know of its row."""

    kind: int
    program: int
    line: int
    context: Context
    rpm: float
    lead: float
    start_angle: float


class Sampler:
    """Samples a toolpath while it is planned.

    Args:
        toolpath: The toolpath.
        machine: Its machine.
        planner: Plans the toolpath; its hooks are taken.
        settings: Those of the planner.
        period: Seconds from sample to sample.
        give: Called with samples, in order.
    """

    def __init__(
        self,
        toolpath: Toolpath,
        machine: Machine,
        planner: Planner,
        settings: Settings,
        period: float,
        give: Callable[[Samples], None],
    ) -> None:
        self._toolpath, self._machine, self._settings = toolpath, machine, settings
        self._planner, self._period, self._give = planner, period, give
        self._n = len(toolpath.axes)
        self._facts: dict[int, RowFacts] = {}
        self._waits: dict[int, list[tuple[str, float]]] = {}
        self._open: list[Numbers] = []
        self._time, self._count, self._angle, self._rpm = 0.0, 0, 0.0, 0.0
        self._tap_way: Numbers | None = None
        self._tails: list[tuple[Run, float]] = []
        self._row = RowFacts(Kind.EVENT, 0, 0, Context(), 0.0, 0.0, 0.0)
        self._forgotten = 0
        self._position: Sequence[float] | Numbers = planner.position
        self._rest: Sequence[float] | Numbers = self._position
        planner.on_pieces, planner.on_wait = self._pieces, self._wait

    # ---- what the planner tells ----------------------------------------------------------------------------

    def take(self, chunk: Chunk) -> None:
        """Note what the samples of a chunk's rows must know; comes before the planner takes the chunk."""
        facing = self._planner.facing
        for row in range(len(chunk)):
            kind, at = chunk.kind[row], chunk.curve[row] * CURVE_WIDTH
            context = self._toolpath.contexts[chunk.context[row]]
            radius = abs(chunk.end[row * self._n + facing]) if facing >= 0 else 0.0
            rpm = context.spindle_direction * self._planner.rpm(context, radius)
            lead, angle = 0.0, 0.0
            if kind in (Kind.THREAD, Kind.TAP) and at >= 0:
                lead, angle = chunk.curves[at : at + 2]
            self._facts[chunk.first + row] = RowFacts(
                kind, chunk.program[row], chunk.line[row], context, rpm, lead, angle
            )

    def _wait(self, row: int, share: str, _context: int, seconds: float) -> None:
        self._waits.setdefault(row, []).append((share, seconds))

    def _pieces(self, records: array[float], count: int) -> None:
        import numpy as np

        width = piece_width(self._n)
        pieces = np.array(records[: count * width]).reshape(count, width)
        starts = np.flatnonzero(pieces[:, PieceRecord.SPEED2] == 0.0)
        edges = [0, *starts.tolist(), count]
        for first, last in pairwise(edges):
            if first in starts:
                self._close_run(
                    float(min(pieces[first, PieceRecord.EARLY], pieces[first, PieceRecord.PAUSE]))
                )
            if last > first:
                self._open.append(pieces[first:last])

    @property
    def time(self) -> float:
        """Seconds up to which the motion is known."""
        return self._time

    def close(self) -> None:
        """Give what is left, when the planner has finished."""
        self._close_run()
        self._stand(max((*self._facts, *self._waits), default=-1))

    # ---- time ----------------------------------------------------------------------------------------------

    def _close_run(self, early: float = 0.0) -> None:
        """The axes come to rest: give the samples of the run, up to where the next one begins.

        That is `early` seconds before its end where two strokes overlap.
        """
        import numpy as np

        if not self._open:
            return
        from polycnc.motion.sampling.run import Run

        pieces = np.concatenate(self._open)
        self._open = []
        first = int(pieces[0, PieceRecord.ROW])
        run = Run(pieces, self._n, self._planner.rapids_of(pieces[0], self._facts[first].context))
        self._stand(first, run)
        seconds = run.seconds - early
        self._move(run, seconds)
        self._tails = [(tail, at + seconds) for tail, at in self._tails if at + seconds < tail.seconds]
        if early:
            self._tails.append((run, seconds))
        self._position = run.end
        still = np.zeros((1, self._n))
        self._rest = self._planner.real_axes.motion((run.end[None], still, still), self._row.context)[0][0]
        for row in range(self._forgotten, int(pieces[-1, PieceRecord.ROW])):
            self._facts.pop(row, None)
        self._forgotten = int(pieces[-1, PieceRecord.ROW])

    def _stand(self, until: int, run: Run | None = None) -> None:
        """Spend the waits of all rows up to one, at rest; the last begins a run."""
        for row in sorted(row for row in self._waits if row <= until):
            self._row = self._facts.get(row, self._row)
            for share, seconds in self._waits.pop(row):
                thread = share == "spindle_s" and self._row.kind == Kind.THREAD
                if thread and run is not None and self._row.rpm != 0.0:
                    self._spin(self._until_mark(run), self._row.rpm)
                else:
                    self._spin(seconds, self._row.rpm if share == "spindle_s" else self._rpm)
        if run is not None:
            self._row = self._facts[until]

    def _until_mark(self, run: Run) -> float:
        """Seconds until the axes may start, so that the thread begins at its start angle.

        The axes lag behind the spindle by what they need to get up to speed; that is allowed for, as if they had
        been in step from the start of the thread.
        """
        degrees_s = abs(self._row.rpm) * 6.0
        ahead = self._row.start_angle - degrees_s * run.lag(abs(self._row.rpm) / 60.0 * self._row.lead)
        sense = 1.0 if self._row.rpm > 0.0 else -1.0
        return ((ahead - sense * self._angle) % 360.0) / degrees_s

    def _times(self, seconds: float) -> Numbers:
        """Sample times within the next seconds, from now."""
        import numpy as np

        last = int(np.ceil((self._time + seconds) / self._period - 1e-9))
        counts = np.arange(self._count, max(last, self._count), dtype=np.float64)
        times: Numbers = counts * self._period - self._time
        self._count = max(last, self._count)
        return times

    def _spin(self, seconds: float, rpm: float) -> None:
        """Rest while the spindle goes evenly to a speed."""
        import numpy as np

        for times in _batches(self._times(seconds)):
            still = np.zeros((len(times), self._n))
            place = np.repeat(np.array([self._rest]), len(times), axis=0)
            share = times / seconds
            speed = self._rpm + share * (rpm - self._rpm)
            angle = self._angle + 3.0 * (self._rpm + speed) * times
            self._say(times, (place, still, still), speed, angle, None)
        self._angle += 3.0 * (self._rpm + rpm) * seconds
        self._rpm = rpm
        self._time += seconds

    def _move(self, run: Run, seconds: float) -> None:
        """Follow a run for a time; the spindle of a tap follows the axes, else it turns as the rows ask."""
        import numpy as np

        rows = np.unique(run.rows)
        facts = {int(row): self._facts[int(row)] for row in rows}
        tap = facts[int(rows[0])]
        sense = self._tap_sense(run, tap)
        rpm = np.array([facts[int(row)].rpm for row in rows])
        start = np.array([run.enters(row) for row in rows] + [seconds])
        start[0] = 0.0
        turned = np.concatenate([[0.0], np.cumsum(6.0 * rpm * np.diff(start))])
        for times in _batches(self._times(seconds)):
            moved = self._with_tails(times, run.at(times))
            k = np.clip(np.searchsorted(start, times, "right") - 1, 0, len(rpm) - 1)
            if sense != 0.0:
                axis = run.main_axis
                angle = (
                    self._angle + sense * 360.0 * np.abs(moved[0][:, axis] - self._position[axis]) / tap.lead
                )
                speed = sense * 60.0 * np.abs(moved[1][:, axis]) / tap.lead
            else:
                speed, angle = rpm[k], self._angle + turned[k] + 6.0 * rpm[k] * (times - start[k])
            said = [facts[int(row)] for row in run.rows[run.piece_at(times)]]
            moved = self._planner.real_axes.motion(moved, tap.context)
            self._say(times, moved, speed, angle, said)
        if sense != 0.0:
            self._angle += sense * 360.0 * float(np.abs(run.end - self._position)[run.main_axis]) / tap.lead
            self._rpm = 0.0
        else:
            self._angle += float(turned[-1])
            self._rpm = float(rpm[-1])
        self._time += seconds

    def _with_tails(self, times: Numbers, moved: Moved) -> Moved:
        """What the axes do while runs before this one still come to rest."""
        position, velocity, acceleration = moved
        for tail, at in self._tails:
            left, slowing, braking = tail.at(times + at)
            position, velocity = position + left - tail.end, velocity + slowing
            acceleration = acceleration + braking
        return position, velocity, acceleration

    def _tap_sense(self, run: Run, facts: RowFacts) -> float:
        """How a tap turns the spindle: as programmed on the way in, back on the way out; 0 for no tap."""
        if facts.kind != Kind.TAP or facts.lead <= 0.0:
            self._tap_way = None
            return 0.0
        way = run.end - self._position
        if self._tap_way is None:
            self._tap_way = way
        turning = -1.0 if facts.context.spindle_direction < 0 else 1.0
        return turning if float((way * self._tap_way).sum()) > 0.0 else -turning

    def _say(
        self, times: Numbers, moved: Moved, rpm: Numbers, angle: Numbers, facts: list[RowFacts] | None
    ) -> None:
        import numpy as np

        if len(times):
            rows = facts if facts is not None else [self._row] * len(times)
            program = np.array([row.program for row in rows])
            line = np.array([row.line for row in rows])
            self._give(Samples(times + self._time, *moved, rpm, angle, program, line))


def _batches(times: Numbers) -> list[Numbers]:
    return [times[k : k + BATCH] for k in range(0, len(times), BATCH)]
