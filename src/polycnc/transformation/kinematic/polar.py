"""Polar plane: a linear and a rotary axis become a Cartesian plane (G12.1, TRANSMIT).

The linear axis follows by the distance of a point from the centre, the rotary one by its direction.
"""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.transformation.contract import unchanged
from polycnc.transformation.numbers import (
    DEGREE,
    RADIAN,
    angle_deg,
    cosine,
    distance,
    kept_off,
    sine,
    where_less,
)
from polycnc.transformation.pole import Pole

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.transformation.contract import Geometry
    from polycnc.transformation.numbers import N

#: Nearer to the pole than this (mm) the derivatives are those at this distance: they would grow without end.
CLOSEST_MM = 1e-6


@dataclass(frozen=True, slots=True)
class PolarPlane:
    """How the axes follow a point of the plane.

    Attributes:
        linear: Column of the plane's first axis.
        rotary: Column of the rotary axis.
        geometry: Columns of X, Y and Z while the plane is chosen.
        start_deg: Where the rotary axis stands in the direction of the first axis.
        eccentricity: Zero of the plane against the centre, mm.
        side: -1 where the linear axis stands on the negative side of the centre.
        virtual: Column of the plane's second axis where it has one of its own, beside the rotary axis; else -1. In
            points of the path the column of the rotary axis says then where the machine's axis of that column stands.
        pole_deg: Where the rotary axis stands in the centre itself; None for where the first axis leads there.
    """

    linear: int
    rotary: int
    geometry: Geometry
    start_deg: float = 0.0
    eccentricity: tuple[float, float] = (0.0, 0.0)
    side: float = 1.0
    virtual: int = -1
    pole_deg: float | None = None

    @property
    def second(self) -> int:
        """Column of the plane's second axis."""
        return self.rotary if self.virtual < 0 else self.virtual

    @property
    def pole(self) -> Pole:
        """The centre, in which the rotary axis has no direction."""
        place = (-self.eccentricity[0], -self.eccentricity[1])
        return Pole((self.linear, self.second), place, self.linear, self.rotary, self.side)

    def to_machine(self, work: Sequence[N]) -> list[N]:
        """Distance (mm, radius) and direction (degrees) of a point of the plane."""
        first = self.side * (work[self.linear] + self.eccentricity[0])
        second = self.side * (work[self.second] + self.eccentricity[1])
        axes = list(work)
        if self.virtual >= 0:
            axes[self.virtual] = work[self.rotary]
        away, direction = distance(first, second), self.start_deg + angle_deg(second, first)
        axes[self.linear] = self.side * away
        axes[self.rotary] = (
            direction if self.pole_deg is None else where_less(away, CLOSEST_MM, self.pole_deg, direction)
        )
        return axes

    def to_work(self, axes: Sequence[N]) -> list[N]:
        """The point of the plane."""
        away, angle = axes[self.linear], (axes[self.rotary] - self.start_deg) * RADIAN
        work = list(axes)
        if self.virtual >= 0:
            work[self.rotary] = axes[self.virtual]
        work[self.linear] = away * cosine(angle) - self.eccentricity[0]
        work[self.second] = away * sine(angle) - self.eccentricity[1]
        return work

    def jacobian(self, work: Sequence[N]) -> list[list[N | float]]:
        """Along the direction of the point, and across it by its distance. In the centre: as just beside it."""
        (along, across), second = self.eccentricity, self.second
        x, y, away = kept_off(work[self.linear] + along, work[second] + across, CLOSEST_MM)
        slopes, own = unchanged(work), self.linear
        linear, rotary, square = slopes[own], slopes[self.rotary], away * away
        linear[own], linear[second] = self.side * x / away, self.side * y / away
        rotary[own], rotary[second] = -DEGREE * y / square, DEGREE * x / square
        if self.virtual >= 0:
            rotary[self.rotary] = slopes[self.virtual][self.virtual] = 0.0
            slopes[self.virtual][self.rotary] = 1.0
        return slopes

    def solutions(self, work: Sequence[float]) -> list[list[float]]:
        """The point on this side of the centre, and on the other one with the rotary axis turned by half a round."""
        axes = self.to_machine(work)
        other = list(axes)
        other[self.linear] = -axes[self.linear]
        other[self.rotary] = axes[self.rotary] + 180.0
        return [axes, other]
