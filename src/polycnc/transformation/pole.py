"""A place where a rotary axis has no direction: the centre of a polar plane.

On the way to it the rotary axis turns ever faster, and through it by half a round in no time. So a path rests there
while the axis turns: it ends and begins on a small ring round the pole, on which every point has its direction.
"""

from __future__ import annotations

from math import cos, hypot, sin
from typing import TYPE_CHECKING

from polycnc.deferred.records import dataclass

if TYPE_CHECKING:
    from collections.abc import Sequence


@dataclass(frozen=True, slots=True)
class Pole:
    """Where a rotary axis has no direction.

    Attributes:
        columns: The two columns of the plane in points of the path.
        place: Their numbers there, mm.
        linear: Column of the axis that leads away from the pole; `side` is its sign on the side where it is.
        rotary: Column of the rotary axis.
    """

    columns: tuple[int, int]
    place: tuple[float, float]
    linear: int
    rotary: int
    side: float = 1.0

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
        moved[self.linear] = self.side * radius
        return moved
