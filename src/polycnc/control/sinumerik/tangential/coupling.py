"""Where a coupled axis stands: the direction of the path in the plane of its leading axes, and what follows from it.

The direction counts from the first leading axis towards the second one, in the basic system, and goes on without jumps:
at a corner it turns the short way.
"""

from __future__ import annotations

from math import atan2, ceil, degrees, hypot, inf, pi, sqrt

from polycnc.channel.moves.move_path import MovePath
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.angles import TURN_DEG, nearest_turn

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.moves.path import Move
    from polycnc.geometry.frames import Frame

#: Angles that differ by less are the same, degrees.
SAME_DEG = 1e-7
#: What is less than a right direction along the leading axes: a part of the way, or mm.
_NO_DIRECTION = 1e-9
#: A path that turns back: so near to half a turn.
_REVERSAL_DEG = 1e-5
#: Steps in which the direction along an arc is followed, radians.
_STEP = pi / 16.0


class Course(NamedTuple):
    """The direction along a move.

    Attributes:
        parts: Parts of the way, from 0 to 1.
        angles: The direction there, degrees, without jumps.
    """

    parts: tuple[float, ...]
    angles: tuple[float, ...]

    def turned(self, part: float) -> float:
        """By how much the direction has turned at a part of the way."""
        at = 1
        while self.parts[at] < part and at < len(self.parts) - 1:
            at += 1
        a, b = self.parts[at - 1], self.parts[at]
        share = (part - a) / (b - a)
        return self.angles[at - 1] + (self.angles[at] - self.angles[at - 1]) * share - self.angles[0]


def course(
    move: Move, geometry: tuple[int, int, int], leading: tuple[int, int], frame: Frame
) -> Course | None:
    """The direction of a move in the plane of two axes; None where these stand.

    Args:
        move: The move.
        geometry: Columns of X, Y and Z.
        leading: Columns of the leading axes.
        frame: From the work to the basic system.
    """
    path = MovePath(move, geometry)
    count = max(ceil(abs(path.sweep) / _STEP), 8) if move.center is not None else 1
    beside = [b - a for a, b in zip(move.start, move.end, strict=True)]
    angles: list[float] = []
    for k in range(count + 1):
        along = frame.direct(*path.direction(k / count))
        u, v = (along[geometry.index(i)] if i in geometry else beside[i] for i in leading)
        if hypot(u, v) <= _NO_DIRECTION:
            continue
        angle = degrees(atan2(v, u))
        angles.append(nearest_turn(angle, angles[-1]) if angles else angle)
    if not angles:
        return None
    total, last = angles[-1] - angles[0], len(angles) - 1
    if last < count or all(abs(a - angles[0] - total * k / last) < SAME_DEG for k, a in enumerate(angles)):
        return Course((0.0, 1.0), (angles[0], angles[-1]))
    return Course(tuple(k / count for k in range(count + 1)), tuple(angles))


@dataclass(slots=True)
class Coupling:
    """One axis that follows the path.

    Attributes:
        column: Of the following axis.
        leading: Columns of the two axes whose direction counts.
        factor: Degrees of the axis for a degree of the path's direction.
        offset: Offset angle, degrees; `added` is what words of the axis have put to it.
        lifts: At corners of more than `lift_deg` the path stands while the axis turns (TLIFT), at `lift_feed` in
            degrees/s, or on a circle of `lift_radius` at the speed of the path where that is not 0, mm.
        leads_speed: Optimisation P: the path waits for the axis at corners.
        smoothing_mm: With P, the way over which the axis may still turn behind a corner.
        tolerance_deg: With P, by how much it may be off meanwhile.
        velocity: Highest velocity, degrees/s; `acceleration` degrees/s².
        range: Lowest and highest position that the working area allows, in work coordinates.
        at: Where the axis stands behind the last move.
        direction: Of the path behind the last move, degrees; None before the first.
    """

    column: int
    leading: tuple[int, int]
    factor: float
    offset: float
    lifts: bool
    lift_deg: float
    lift_feed: float
    lift_radius: float
    leads_speed: bool
    smoothing_mm: float
    tolerance_deg: float
    velocity: float
    acceleration: float
    at: float
    range: tuple[float, float] = (-inf, inf)
    added: float = 0.0
    direction: float | None = None
    applied: float = 0.0
    turns: float = 0.0

    def meet(self, angle: float) -> float:
        """Where the axis must stand where a way in a direction begins; the direction goes on from there."""
        before = self.direction
        if before is None:
            self.direction = angle
            wanted = self.factor * angle + self._offset
            self.turns = nearest_turn(wanted, self.at) - wanted
        else:
            turn = (angle - before) % TURN_DEG
            self.direction = before + (turn - TURN_DEG if turn > 180.0 + _REVERSAL_DEG else turn)
            if abs(turn - 180.0) < _REVERSAL_DEG:
                self._reverse()
        return self._place

    @property
    def _offset(self) -> float:
        return self.offset + self.applied

    @property
    def _place(self) -> float:
        return self.factor * (self.direction or 0.0) + self._offset + self.turns

    def _reverse(self) -> None:
        """The path turns back: outside the working area the negative offset angle is tried."""
        if self._allows(self._place):
            return
        kept = self.offset, self.added, self.applied, self.turns
        self.offset, self.added, self.applied = -self.offset, -self.added, -self.applied
        place = nearest_turn(self._place, self.at)
        self.turns += place - self._place
        if not self._allows(place):
            self.offset, self.added, self.applied, self.turns = kept

    def _allows(self, place: float) -> bool:
        return self.range[0] - SAME_DEG <= place <= self.range[1] + SAME_DEG

    def seconds_for(self, angle: float) -> float:
        """How long the axis takes to turn by an angle from rest to rest."""
        angle = abs(angle)
        if self.velocity <= 0.0:
            return 0.0
        if self.acceleration <= 0.0:
            return angle / self.velocity
        if angle * self.acceleration <= self.velocity**2:
            return 2.0 * sqrt(angle / self.acceleration)
        return angle / self.velocity + self.velocity / self.acceleration

    def follow(self, along: Course | None, jump: float, share: float, parts: Sequence[float]) -> list[float]:
        """Positions at parts of a move; the axis has made up for a jump after a share of the way."""
        change = self.added - self.applied
        first = self.at
        places = [
            first
            + jump * (min(part / share, 1.0) if share else 1.0)
            + (self.factor * along.turned(part) if along is not None else 0.0)
            + change * part
            for part in parts
        ]
        self.applied = self.added
        if along is not None and self.direction is not None:
            self.direction += along.turned(1.0)
        self.at = places[-1]
        return places
