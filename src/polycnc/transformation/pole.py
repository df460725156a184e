"""A place where a rotary axis has no direction: the centre of a polar plane.

On the way to it the rotary axis turns ever faster, and through it by half a round in no time. So a path rests there
while the axis turns: it ends and begins on a small ring round the pole, on which every point has its direction.
"""

from __future__ import annotations

from math import ceil, cos, hypot, pi, sin

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

#: A path that comes so near to the pole (mm) leads through it.
POLE_MM = 1e-3


class Round(Protocol):
    """An arc: its whole angle, its length, and the angle from its start at which it comes nearest to a point."""

    @property
    def angle(self) -> float:
        """Of the whole way, radians."""

    @property
    def length(self) -> float:
        """Of the way, mm."""

    @property
    def angle_of(self) -> Callable[[Sequence[float]], float]:
        """Angle from the start at which it comes nearest to a point, radians."""


@dataclass(frozen=True, slots=True)
class Pole:
    """Where a rotary axis has no direction.

    Attributes:
        columns: The two columns of the plane in points of the path.
        place: Their numbers there, mm.
        linear: Column of the axis that leads away from the pole; `side` is its sign on the side where it is.
        rotary: Column of the rotary axis.
        zero: Where the linear axis is in the pole: a tool along it lies between, mm.
    """

    columns: tuple[int, int]
    place: tuple[float, float]
    linear: int
    rotary: int
    side: float = 1.0
    zero: float = 0.0

    def away(self, point: Sequence[float]) -> tuple[float, float]:
        """From the pole to a point of the path."""
        (i, j), (x, y) = self.columns, self.place
        return point[i] - x, point[j] - y

    def distance(self, point: Sequence[float]) -> float:
        """Of a point of the path, mm."""
        return hypot(*self.away(point))

    def beside(self, point: Sequence[float], angle: float, radius: float) -> list[float]:
        """The point, moved to an angle (radians) and a distance from the pole."""
        moved = list(point)
        for column, centre, part in zip(self.columns, self.place, (cos(angle), sin(angle)), strict=True):
            moved[column] = centre + radius * part
        return moved

    def axes_beside(self, axes: Sequence[float], radius: float) -> list[float]:
        """Positions of the axes at a distance from the pole, in the direction in which the rotary axis stands."""
        moved = list(axes)
        moved[self.linear] = self.zero + self.side * radius
        return moved


def is_at(pole: Pole, point: Sequence[float]) -> bool:
    """Whether a point counts as the pole."""
    return pole.distance(point) <= POLE_MM


def shares_at_pole(
    pole: Pole,
    path: Callable[[float], Sequence[float]],
    arc: Round | None,
    start: Sequence[float],
    end: Sequence[float],
) -> list[float]:
    """Shares of the way of a line (`arc` is None) or an arc at which it is at the pole."""
    found = []
    if arc is not None:
        turns = (arc.angle_of(pole.beside(start, 0.0, 0.0)), 2.0 * pi)
        near = min(0.25, 2.0 * POLE_MM / max(arc.length, POLE_MM))
        found = [(turns[0] + k * turns[1]) / arc.angle for k in range(ceil(arc.angle / turns[1]) + 1)]
    else:
        (a, b), (c, d) = pole.away(start), pole.away(end)
        square, near = (c - a) ** 2 + (d - b) ** 2, 0.0
        found = [(a * (a - c) + b * (b - d)) / square] if square > 0.0 else []
    ends = [f for f, point in ((0.0, start), (1.0, end)) if is_at(pole, point)]
    low, high = (near if 0.0 in ends else 0.0), (1.0 - near if 1.0 in ends else 1.0)
    if arc is None and ends:
        found = []
    return sorted({*ends, *(f for f in found if low < f < high and is_at(pole, path(f)))})
