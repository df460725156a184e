"""Limited jerk: the axes follow the interpolator through averages over time.

The interpolator runs along the path with steps of acceleration; overrides and feed hold change only what it does from
now on. The axes are where its way, averaged over RAMP, was BLEND ago, and their positions are averaged over BLEND twice
(`motion/averaging.py`). So whatever an operator does, no axis gets a jerk that the planner has not allowed for:
an acceleration that steps by 2·u gives at most a jerk of 2·u/RAMP. The axes come to rest RAMP + 2·BLEND behind the
interpolator.
"""

from __future__ import annotations

from bisect import bisect_right
from math import inf
from typing import TYPE_CHECKING

from polycnc.motion.averaging import PARTS, TENT, area_after, average, way_after
from polycnc.motion.kernels.jerk import window_s

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from polycnc.mainrun.motion.speed import Phase
    from polycnc.mainrun.preparation.items import Piece

#: Phases that are kept before old ones are dropped.
KEPT = 256


class Law:
    """One place over time: phases of constant acceleration, at rest before and behind them.

    Args:
        time: When it begins.
        place: Where it is then.
    """

    def __init__(self, time: float, place: float) -> None:
        # When a phase begins, where, speed and pull in it, and the area below the places before it.
        self._rows = [(time, place, 0.0, 0.0, 0.0)]
        self._origin = place

    def run(self, time: float, place: float, phases: Iterable[Phase]) -> None:
        """What happens from a time on, in place of what was said before."""
        rows = self._rows
        while len(rows) > 1 and rows[-1][0] >= time:
            rows.pop()
        area = self._area(time)
        for phase in phases:
            rows.append((time, place, phase.speed, phase.pull, area))
            area += area_after(phase.seconds, place - self._origin, phase.speed, phase.pull)
            time, place = time + phase.seconds, place + phase.way
        rows.append((time, place, 0.0, 0.0, area))

    def forget(self, before: float) -> None:
        """Nobody will ask for a time before this one; areas count from there, so that they stay small and exact."""
        last = bisect_right(self._rows, (before, inf)) - 1
        if last > 0:
            since, origin, _, _, gone = self._rows[last]
            rise = origin - self._origin
            self._rows = [
                (time, place, speed, pull, area - gone - rise * (time - since))
                for time, place, speed, pull, area in self._rows[last:]
            ]
            self._origin = origin

    @property
    def phases(self) -> int:
        """How many phases are kept."""
        return len(self._rows)

    def at(self, time: float) -> float:
        """The place at a time."""
        start, place, speed, pull, _ = self._rows[max(bisect_right(self._rows, (time, inf)) - 1, 0)]
        seconds = max(time - start, 0.0)
        return place + way_after(seconds, speed, pull)

    def mean(self, time: float, window: float) -> float:
        """The average place over the time `window` before."""
        if window <= 0.0:
            return self.at(time)
        return self._origin + average(self._area(time - window), self._area(time), window)

    def mean_speed(self, time: float, window: float) -> float:
        """The average speed over the time `window` before, which is not nothing."""
        return average(self.at(time - window), self.at(time), window)

    def _area(self, time: float) -> float:
        """The integral of the places, counted from the origin, over the time before."""
        start, place, speed, pull, area = self._rows[max(bisect_right(self._rows, (time, inf)) - 1, 0)]
        return area + area_after(max(time - start, 0.0), place - self._origin, speed, pull)


class Follower:
    """The axes behind the interpolator, from one standstill to the next.

    Args:
        before: What leads the axes to rest while the run already begins, where two strokes overlap.
        rest: When it has led them there, and `place`: where.

    Attributes:
        window: Seconds by which the axes rest later than the interpolator; 0 without limited jerk.
    """

    def __init__(
        self, before: Follower | None = None, rest: float = 0.0, place: Sequence[float] = ()
    ) -> None:
        self._before, self._rest, self._rest_place = before, rest, tuple(place)
        self.window = 0.0
        self._ramp = self._blend = 0.0
        self._law = Law(0.0, 0.0)
        self._alone: list[Law] = []
        self._ways: list[float] = []
        self._pieces: list[tuple[float, Piece]] = []

    def begin(self, time: float, ramp: float, blend: float) -> None:
        """The axes stand, and a run begins whose averages are over these times."""
        self._ramp, self._blend, self.window = ramp, blend, window_s(ramp, blend)
        self._law, self._alone, self._ways, self._pieces = Law(time, 0.0), [], [], []
        if self._before is not None:
            self._before.let_rest(time)

    def let_rest(self, time: float) -> None:
        """Forget the run before, if it has come to rest."""
        if time >= self._rest:
            self._before = None

    def enter(self, piece: Piece, length: float, behind: float) -> None:
        """The interpolator comes to a piece of a length; `behind` is how much of the one before it has run."""
        self._ways.append(self._ways[-1] + behind if self._ways else 0.0)
        self._pieces.append((length, piece))

    def follow(self, time: float, done: float, phases: Sequence[Phase]) -> None:
        """From a time on the interpolator runs these phases, `done` mm behind the start of the last piece."""
        self._law.run(time, self._ways[-1] + done, phases)
        if self._law.phases > KEPT:
            before = time - self.window - self._ramp
            kept = max(bisect_right(self._ways, self._law.at(before)) - 1, 0)
            del self._ways[:kept], self._pieces[:kept]
            self._law.forget(before)

    def follow_alone(self, time: float, moves: Sequence[tuple[float, Sequence[Phase]]]) -> None:
        """From a time on every axis runs phases of its own, from a position."""
        if not self._alone:
            self._alone = [Law(time, position) for position, _ in moves]
        for law, (position, phases) in zip(self._alone, moves, strict=True):
            law.run(time, position, phases)

    def machine(self, time: float) -> list[float]:
        """Machine position of the axes."""
        own = self._machine(time)
        if self._before is None or time >= self._rest:
            return own
        last = self._before.machine(time)
        return [a + b - c for a, b, c in zip(own, last, self._rest_place, strict=True)]

    def _machine(self, time: float) -> list[float]:
        if self._alone:
            return [law.mean(time, self._ramp) for law in self._alone]
        if self._blend == 0.0:
            return self._place(time)
        places = self._places(time)
        return [sum(w * p for w, p in zip(TENT, axis, strict=True)) for axis in zip(*places, strict=True)]

    def speed(self, time: float) -> float:
        """Speed along the path, or of the fastest axis where each runs by itself."""
        middle = time - self._blend
        laws = self._alone or [self._law]
        return max(abs(law.mean_speed(middle, self._ramp)) for law in laws)

    def _places(self, time: float) -> list[list[float]]:
        step = self._blend / PARTS
        return [self._place(time - k * step) for k in range(2 * PARTS, -1, -1)]

    def _place(self, time: float) -> list[float]:
        """Where on the path the averaged way is."""
        way = self._law.mean(time, self._ramp)
        k = max(bisect_right(self._ways, way) - 1, 0)
        length, piece = self._pieces[k]
        return piece.at((way - self._ways[k]) / length)
