"""Involutes of a circle: the curve that the end of a taut thread makes when it is wound off.

With the roll angle `p` a point is `r·sqrt(1 + p²)` from the centre of the base circle of radius `r`, and `p - atan(p)`
farther round it than where the curve leaves that circle. The radius of curvature is `r·p`, the direction turns by `dp`,
and the length from the base circle is `r·p²/2`.
"""

from __future__ import annotations

from math import atan, cos, hypot, sin, sqrt

from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs

if TYPE_CHECKING:
    from polycnc.geometry.arcs import Point

_ENOUGH = 60
_NEARLY_NOTHING = 1e-6


@dataclass(frozen=True, slots=True)
class Involute:
    """A piece of an involute.

    Attributes:
        center: Of the base circle, mm.
        radius: Of the base circle, mm, above 0.
        bearing: Direction from the centre to the start, radians.
        first: Roll angle at the start, radians, not negative.
        last: Roll angle at the end.
        ccw: Whether it goes round the centre counter-clockwise.
    """

    center: Point
    radius: float
    bearing: float
    first: float
    last: float
    ccw: bool

    @property
    def sweep(self) -> float:
        """Angle between the directions to start and end, radians, whole turns included."""
        return abs(unwound(self.last) - unwound(self.first))

    def at(self, roll: float) -> Point:
        """The point at a roll angle."""
        angle = abs(unwound(roll) - unwound(self.first))
        distance = self.radius * sqrt(1.0 + roll * roll)
        bearing = self.bearing + (angle if self.ccw else -angle)
        return self.center[0] + distance * cos(bearing), self.center[1] + distance * sin(bearing)

    def direction(self, roll: float) -> Point:
        """Unit direction away from the base circle at a roll angle: square to the thread."""
        angle = unwound(roll) - unwound(self.first)
        away = (self.last > self.first) is self.ccw
        bearing = self.bearing + (angle if away else -angle) + (atan(roll) if away else -atan(roll))
        return cos(bearing), sin(bearing)

    @property
    def end(self) -> Point:
        """The last point."""
        return self.at(self.last)

    def chords(self, error: float) -> list[tuple[Point, float]]:
        """End points of chords that keep within an error (mm), each with the share of the length up to it."""
        turn, widest = self.last - self.first, self.radius * max(self.first, self.last)
        parts = arcs.parts_for_chord_error(widest, turn, error)
        rolls = [self.first + turn * k / parts for k in range(1, parts + 1)]
        length = self.last**2 - self.first**2
        return [(self.at(roll), (roll**2 - self.first**2) / length) for roll in rolls]


def unwound(roll: float) -> float:
    """How far round the centre a roll angle leads, radians."""
    return roll - atan(roll)


def roll_at_distance(distance: float, radius: float) -> float:
    """The roll angle at a distance from the centre; ValueError inside the base circle."""
    ratio = distance / radius
    if ratio < 1.0 - 1e-9:
        raise ValueError("inside the base circle")
    return sqrt(max(ratio * ratio - 1.0, 0.0))


def roll_at_angle(angle: float) -> float:
    """The roll angle that leads round the centre by an angle (radians, not negative).

    Newton's method from above: `p - atan(p)` is convex for `p > 0`, so that no step goes too far.
    """
    roll = angle + 2.0
    for _ in range(_ENOUGH):
        excess = unwound(roll) - angle
        if abs(excess) <= 1e-15 * roll or not roll:
            break
        roll -= excess * (1.0 + roll * roll) / (roll * roll)
    return max(roll, 0.0)


def to_point(start: Point, end: Point, center: Point, radius: float, ccw: bool) -> Involute:
    """The involute from a point to where it comes nearest to another one; ValueError inside the base circle."""
    first = roll_at_distance(hypot(start[0] - center[0], start[1] - center[1]), radius)
    last = roll_at_distance(hypot(end[0] - center[0], end[1] - center[1]), radius)
    curve = Involute(center, radius, arcs.angle_at(center, start), first, last, ccw)
    (u, v), (du, dv) = curve.end, curve.direction(last)
    along = (end[0] - u) * du + (end[1] - v) * dv
    # A point that is rounded lies beside the curve mostly along it: far out it runs nearly round the centre.
    nearest = last + along / (radius * last) if last > _NEARLY_NOTHING else last
    return replace(curve, last=max(nearest, 0.0))


def by_angle(start: Point, center: Point, radius: float, angle: float, ccw: bool) -> Involute:
    """The involute from a point by an angle round the centre, positive away from the base circle, radians.

    Raises:
        ValueError: The start lies inside the base circle, or the angle leads beyond it.
    """
    first = roll_at_distance(hypot(start[0] - center[0], start[1] - center[1]), radius)
    wanted = unwound(first) + angle
    if wanted < -1e-9:
        raise ValueError("beyond the base circle")
    return Involute(center, radius, arcs.angle_at(center, start), first, roll_at_angle(max(wanted, 0.0)), ccw)
