"""Limited jerk: the axes follow the interpolator through averages over time.

The interpolator runs along the path with steps of acceleration; overrides and feed hold change only what it does from
now on. The axes are where its way, averaged over RAMP, was BLEND ago, and their positions are averaged over BLEND twice
(`motion/averaging.py`). So whatever an operator does, no axis gets a jerk that the planner has not allowed for:
an acceleration that steps by 2·u gives at most a jerk of 2·u/RAMP. The axes come to rest RAMP + 2·BLEND behind the
interpolator.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.averaging import under_tent
from polycnc.motion.kernels.jerk import window_s
from polycnc.motion.law import Law

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.mainrun.preparation.items import Piece
    from polycnc.motion.law import Phase

#: Phases that are kept before old ones are dropped.
KEPT = 256


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
        self._alone: list[tuple[Law, float]] = []
        self._ways: list[float] = []
        self._pieces: list[tuple[float, Piece]] = []
        #: The machine position that was asked for last, and when: displays ask for that of one moment again and again.
        self._known: tuple[float, list[float]] | None = None

    def begin(self, time: float, ramp: float, blend: float) -> None:
        """The axes stand, and a run begins whose averages are over these times."""
        self._ramp, self._blend, self.window = ramp, blend, window_s(ramp, blend)
        self._law, self._alone, self._ways, self._pieces = Law(time, 0.0), [], [], []
        self._known = None
        if self._before is not None:
            self._before.let_rest(time)

    def let_rest(self, time: float) -> None:
        """Forget the run before, if it has come to rest."""
        if time >= self._rest:
            self._before = self._known = None

    def enter(self, piece: Piece, length: float, behind: float) -> None:
        """The interpolator comes to a piece of a length; `behind` is how much of the one before it has run."""
        self._known = None
        self._ways.append(self._ways[-1] + behind if self._ways else 0.0)
        self._pieces.append((length, piece))

    def exchange(self, piece: Piece, length: float, behind: float) -> None:
        """Another piece takes the place of the last one; it begins `behind` mm after its beginning, or before it."""
        self._known = None
        begins = self._ways[-1] + behind
        while self._ways and self._ways[-1] >= begins:
            self._ways.pop()
            self._pieces.pop()
        self._ways.append(begins)
        self._pieces.append((length, piece))

    def follow(self, time: float, done: float, phases: Sequence[Phase]) -> None:
        """From a time on the interpolator runs these phases, `done` mm behind the start of the last piece."""
        self._known = None
        self._law.run(time, self._ways[-1] + done, phases)
        if self._law.phases > KEPT:
            before = time - self.window - self._ramp
            kept = max(bisect_right(self._ways, self._law.at(before)) - 1, 0)
            del self._ways[:kept], self._pieces[:kept]
            self._law.forget(before)

    def follow_alone(self, time: float, moves: Sequence[tuple[float, Sequence[Phase], float]]) -> None:
        """From a time on every axis runs phases of its own, from a position, and is averaged over a time of its own."""
        self._known = None
        if not self._alone:
            self._alone = [(Law(time, position), ramp) for position, _, ramp in moves]
        for (law, _), (position, phases, _) in zip(self._alone, moves, strict=True):
            law.run(time, position, phases)

    def machine(self, time: float) -> list[float]:
        """Machine position of the axes."""
        if self._known is None or self._known[0] != time:
            own = self._machine(time)
            if self._before is not None and time < self._rest:
                last = self._before.machine(time)
                own = [a + b - c for a, b, c in zip(own, last, self._rest_place, strict=True)]
            self._known = time, own
        return list(self._known[1])

    def _machine(self, time: float) -> list[float]:
        if self._alone:
            return [law.mean(time, ramp) for law, ramp in self._alone]
        if self._blend == 0.0:
            return self._place(time)
        middle = time - self._blend
        return under_tent(self._place, middle, self._blend, self._edges(middle))

    def speed(self, time: float) -> float:
        """Speed along the path, or of the fastest axis where each runs by itself."""
        middle = time - self._blend
        laws = self._alone or [(self._law, self._ramp)]
        return max(abs(law.mean_speed(middle, ramp)) for law, ramp in laws)

    def along(self, time: float) -> tuple[float, float, float] | None:
        """Way, speed and acceleration of the axes on a row from rest; None where they follow more than one."""
        if self._alone or self._before is not None or self._blend > 0.0 or len(self._pieces) != 1:
            return None
        law, ramp = self._law, self._ramp
        return law.mean(time, ramp), law.mean_speed(time, ramp), law.mean_pull(time, ramp)

    def _edges(self, middle: float) -> list[float]:
        """When, around a time, the averaged way begins to follow another rule, or comes to another piece."""
        first, last = middle - self._blend, middle + self._blend
        edges = self._law.edges(first, last, self._ramp)
        low = bisect_right(self._ways, self._law.mean(first, self._ramp))
        high = bisect_left(self._ways, self._law.mean(last, self._ramp))
        return edges + [self._law.when_mean(way, self._ramp) for way in self._ways[low:high]]

    def _place(self, time: float) -> list[float]:
        """Where on the path the averaged way is."""
        way = self._law.mean(time, self._ramp)
        k = max(bisect_right(self._ways, way) - 1, 0)
        length, piece = self._pieces[k]
        return piece.at((way - self._ways[k]) / length)
