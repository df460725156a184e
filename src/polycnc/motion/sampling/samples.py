"""What the axes and the spindle do at even times: the sampled motion of a planned toolpath.

A `Sampler` listens to a planner. It needs the chunks (for lines and contexts), the waits and the final pieces, and
gives columns of samples, run by run; what it has given it forgets.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.kernels.columns import PieceRecord, piece_width
from polycnc.motion.sampling.facts import Facts, RowFacts
from polycnc.motion.sampling.own_ways import OwnWays
from polycnc.motion.sampling.spindle import SpindleCourse
from polycnc.motion.standing.positioning import AxisOnItsWay
from polycnc.toolpath import Context, Kind

if TYPE_CHECKING:
    from array import array
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from polycnc.machine import Machine
    from polycnc.motion.planner import Planner
    from polycnc.motion.sampling.run import Moved, Numbers, Places, Run
    from polycnc.motion.settings import Settings
    from polycnc.motion.standing.beside import Begins
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


class Sampler:
    """Samples a toolpath while it is planned.

    Args:
        toolpath: The toolpath.
        machine: Its machine.
        planner: Plans the toolpath; its hooks are taken.
        settings: Those of the planner.
        period: Seconds from sample to sample.
        give: Called with samples, in order.

    Attributes:
        line: The farthest line of the main program, which is the first of the toolpath, that was sampled.
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
        self._facts = Facts(toolpath, planner)
        self._waits: dict[int, list[tuple[str, float]]] = {}
        self._open: list[Numbers] = []
        self._followed: _Followed | None = None
        self._time, self._count, self._spindle = 0.0, 0, SpindleCourse()
        self._tap_way: Numbers | None = None
        self._tails: list[tuple[Run, float]] = []
        self._own, self._begins = OwnWays(), dict[int, list[AxisOnItsWay]]()
        self._row = RowFacts(Kind.EVENT, 0, 0, Context(), 0.0, 0.0)
        self._position: Sequence[float] | Numbers = planner.position
        self._rest: Sequence[float] | Numbers = self._position
        self.line = 0
        planner.on_pieces, planner.on_wait = self._pieces, self._wait
        planner.tell_begins(self._begin)

    # ---- what the planner tells ----------------------------------------------------------------------------

    def take(self, chunk: Chunk) -> None:
        """Note what the samples of a chunk's rows must know; comes before the planner takes the chunk."""
        if len(chunk):
            self._facts.take(chunk)

    def _wait(self, row: int, share: str, _context: int, seconds: float) -> None:
        self._waits.setdefault(row, []).append((share, seconds))

    def _begin(self, step: Begins) -> None:
        if isinstance(step.work, AxisOnItsWay):
            self._begins.setdefault(step.row, []).append(step.work)

    def _pieces(self, records: array[float], count: int) -> None:
        width = piece_width(self._n)
        pieces = np.array(records[: count * width]).reshape(count, width)
        starts = np.flatnonzero(pieces[:, PieceRecord.SPEED2] == 0.0)
        edges = [0, *starts.tolist(), count]
        for k, (first, last) in enumerate(pairwise(edges)):
            if k:
                self._close_run(
                    float(min(pieces[first, PieceRecord.EARLY], pieces[first, PieceRecord.PAUSE]))
                )
            if last > first:
                self._open.append(pieces[first:last])
        self._follow()

    @property
    def count(self) -> int:
        """Samples so far."""
        return self._count

    @property
    def time(self) -> float:
        """Seconds up to which the motion is known."""
        return self._time

    def close(self) -> None:
        """Give what is left, when the planner has finished."""
        self._close_run()
        self._stand(max((self._facts.end - 1, *self._waits, *self._begins)))

    # ---- time ----------------------------------------------------------------------------------------------

    def _follow(self) -> None:
        """Give the samples of the run so far, as far as nothing to come can change them, and keep no more than needed.

        What a thread or a tap does depends on the whole run.
        """
        if not self._open:
            return
        if self._followed is None:
            facts = self._facts.of(int(self._open[0][0, PieceRecord.ROW]))
            assert facts is not None
            if facts.kind in (Kind.THREAD, Kind.TAP):
                return
        followed = self._taken_up()
        if followed.run.can_go_on:
            self._turn(followed)
            self._give_moves(followed, self._times(followed.run.known_s, is_whole=False))
            followed.forget((self._count - 1) * self._period - self._time)
            self._spindle.forget((self._count - 1) * self._period)
            self._facts.forget(int(followed.run.rows[0]))

    def _taken_up(self) -> _Followed:
        """The run with all pieces so far; the waits in front of it are over."""
        from polycnc.motion.sampling.run import Run

        pieces = np.concatenate(self._open)
        self._open = []
        if self._followed is None:
            first = int(pieces[0, PieceRecord.ROW])
            facts = self._facts.of(first)
            assert facts is not None
            run = Run(pieces, self._n, self._planner.rapids_of(pieces[0], facts.context))
            self._stand(first, run)
            self._followed = _Followed(run, self._facts)
        else:
            self._followed.go_on(pieces, self._facts)
        return self._followed

    def _close_run(self, early: float = 0.0) -> None:
        """The axes come to rest: give the samples of the run, up to where the next one begins.

        That is `early` seconds before its end where two strokes overlap.
        """
        if not self._open and self._followed is None:
            return
        followed = self._taken_up() if self._open else self._followed
        assert followed is not None
        self._followed = None
        run = followed.run
        seconds = run.seconds - early
        self._move(followed, seconds)
        self._tails = [(tail, at + seconds) for tail, at in self._tails if at + seconds < tail.seconds]
        if early:
            self._tails.append((run, seconds))
        self._position = run.end
        still = np.zeros((1, self._n))
        self._rest = self._planner.real_axes.motion((run.end[None], still, still), self._row.context)[0][0]
        self._facts.forget(int(run.rows[-1]))

    def _stand(self, until: int, run: Run | None = None) -> None:
        """Spend the waits of all rows up to one, at rest; the last begins a run."""
        for row in sorted(row for row in {*self._waits, *self._begins} if row <= until):
            self._row = self._facts.of(row) or self._row
            for way in self._begins.pop(row, ()):
                self._position, self._rest = np.array(self._position), np.array(self._rest)
                self._position[way.column] = self._rest[way.column] = self._own.begin(way, self._time)
            for share, seconds in self._waits.pop(row, ()):
                self._rest_for(seconds, share)
        if run is not None:
            self._row = self._facts.of(until) or self._row

    def _times(self, seconds: float, *, is_whole: bool = True) -> Numbers:
        """Sample times within the next seconds, from now; surely within them where these are not the whole."""
        whole = np.ceil((self._time + seconds) / self._period - 1e-9)
        last = int(whole if is_whole else np.floor((self._time + seconds) / self._period - 1e-6))
        counts = np.arange(self._count, max(last, self._count), dtype=np.float64)
        times: Numbers = counts * self._period - self._time
        self._count = max(last, self._count)
        return times

    def _rest_for(self, seconds: float, share: str) -> None:
        """Rest while a row waits; the spindle goes evenly to a speed that is waited for, or runs up beside it."""
        if share == "spindle_s":
            self._spindle.go_evenly(self._time, self._row.rpm, seconds)
        elif share == "tool_change_s" and self._planner.stops_for_change(self._row.context):
            self._spindle.go_to(self._time, 0.0, self._planner.spindle_pull(self._row.context))
        elif share != "tool_change_s" and self._planner.runs_up_beside(self._row.context):
            self._spindle.go_to(self._time, self._row.rpm, self._planner.spindle_pull(self._row.context))
        for times in _batches(self._times(seconds)):
            still = np.zeros((len(times), self._n))
            place = np.repeat(np.array([self._rest]), len(times), axis=0)
            program, line = (np.full(len(times), number) for number in (self._row.program, self._row.line))
            self._say(times, (place, still, still), *self._spindle.at(times + self._time), program, line)
        self._time += seconds
        self._spindle.forget((self._count - 1) * self._period)

    def _turn(self, followed: _Followed) -> None:
        """The spindle turns as the rows of a run ask, as far as they are known."""
        pull = self._planner.spindle_pull(self._row.context)
        for time, rpm in followed.pop_speeds():
            self._spindle.go_to(self._time + time, rpm, pull)

    def _move(self, followed: _Followed, seconds: float) -> None:
        """Follow a run to its end; the spindle of a tap follows the axes, else it turns as the rows ask."""
        run, first = followed.run, self._row
        sense, angle = self._tap_sense(run, first), self._spindle.angle(self._time)
        if sense == 0.0:
            self._turn(followed)
        self._give_moves(followed, self._times(seconds), sense)
        self._time += seconds
        if sense != 0.0:
            turned = sense * 360.0 * float(np.abs(run.end - self._position)[run.main_axis]) / first.lead
            self._spindle.stand(self._time, angle + turned)

    def _give_moves(self, followed: _Followed, times: Numbers, sense: float = 0.0) -> None:
        """Samples of a run; `sense` says how a tap turns the spindle."""
        run, first = followed.run, self._row
        for part in _batches(times):
            moved = self._with_tails(part, run.at(part))
            if sense != 0.0:
                axis = run.main_axis
                angle = (
                    self._spindle.angle(self._time)
                    + sense * 360.0 * np.abs(moved[0][:, axis] - self._position[axis]) / first.lead
                )
                speed = sense * 60.0 * np.abs(moved[1][:, axis]) / first.lead
            else:
                speed, angle = self._spindle.at(part + self._time)
            program, line = self._facts.places(run.rows[run.piece_at(part)])
            moved = self._planner.real_axes.motion(moved, first.context)
            self._say(part, moved, speed, angle, program, line)

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
        self, times: Numbers, moved: Moved, rpm: Numbers, angle: Numbers, program: Places, line: Places
    ) -> None:
        if len(times):
            moved = self._own.add(times + self._time, moved)
            self.line = max(self.line, int(line[program == 0].max(initial=0)))
            self._give(Samples(times + self._time, *moved, rpm, angle, program, line))


class _Followed:
    """A run that is sampled, and the speeds that its rows ask of the spindle.

    Args:
        run: The run.
        facts: Those of its rows.
    """

    def __init__(self, run: Run, facts: Facts) -> None:
        self.run, self._last = run, -1
        self._speeds: list[tuple[float, float]] = []
        self._note_speeds(facts, np.zeros(1))

    def go_on(self, pieces: Numbers, facts: Facts) -> None:
        """More pieces of the run."""
        self.run.go_on(pieces)
        self._note_speeds(facts, np.zeros(0))

    def _note_speeds(self, facts: Facts, first: Numbers) -> None:
        """Note what rows ask that have become known; the first one from the beginning of the run on."""
        rows = self.run.rows if len(self.run.rows) == 1 else np.unique(self.run.rows)
        rows = rows[rows > self._last]
        if len(rows):
            self._last = int(rows[-1])
            rpm = facts.rpm(rows)
            changes = np.flatnonzero(np.diff(rpm, prepend=np.nan) != 0.0)
            starts = self.run.enters(rows[changes]) if len(rows) > 1 or not len(first) else first
            starts[: len(first)] = first
            self._speeds += zip(starts.tolist(), rpm[changes].tolist(), strict=True)

    def pop_speeds(self) -> list[tuple[float, float]]:
        """From when on which speed is asked for, as far as nobody has been told yet."""
        speeds, self._speeds = self._speeds, []
        return speeds

    def forget(self, before: float) -> None:
        """Nobody asks for a time before this one."""
        self.run.forget(before)


def _batches(times: Numbers) -> list[Numbers]:
    return [times[k : k + BATCH] for k in range(0, len(times), BATCH)]
