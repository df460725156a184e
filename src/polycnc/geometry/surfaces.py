"""Where a straight way first touches a surface: what a probe does.

A surface is the boundary of a solid: a half space, a ball or a cylinder, or the rest of space around a ball or a
cylinder (a bore). A probe's tip touches where its centre comes as near as its radius.
"""

from __future__ import annotations

from math import hypot, sqrt

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.geometry.vectors import dot, minus, times

if TYPE_CHECKING:
    from polycnc.geometry.frames import Vector


@dataclass(frozen=True, slots=True)
class Surface:
    """A plane, a sphere or a cylinder.

    Attributes:
        at: A point of the plane, of the cylinder's axis, or the centre of the sphere, mm.
        direction: Normal of the plane, out of the solid, or the cylinder's axis; no vector for a sphere.
        radius: Of the sphere or the cylinder, mm; 0 for a plane.
        inside: The solid lies around the sphere or the cylinder.
        tip: Radius of the probe's tip, mm.
    """

    at: Vector
    direction: Vector = (0.0, 0.0, 0.0)
    radius: float = 0.0
    inside: bool = False
    tip: float = 0.0

    def touched(self, start: Vector, end: Vector) -> float | None:
        """The share of a straight way at which the tip comes to the surface from outside; None if it never does."""
        place = minus(start, self.at)
        way = minus(end, start)
        length = hypot(*self.direction)
        if length > 0.0:
            normal = times(self.direction, 1.0 / length)
            if self.radius == 0.0:
                return _crossing(dot(place, normal) - self.tip, dot(way, normal))
            place = minus(place, times(normal, dot(place, normal)))
            way = minus(way, times(normal, dot(way, normal)))
        return self._around(place, way)

    def _around(self, place: Vector, way: Vector) -> float | None:
        """The way relative to the centre: a quadratic equation for the distance from it."""
        reach = self.radius - self.tip if self.inside else self.radius + self.tip
        square, along = dot(way, way), dot(place, way)
        gap = dot(place, place) - reach * reach
        sense = 1.0 if self.inside else -1.0
        if square <= NO_WAY * NO_WAY or reach < 0.0:
            return None
        root = along * along - square * gap
        if root < 0.0:
            return None  # the way passes by
        share = (-along + sense * sqrt(root)) / square
        slack = NO_WAY / sqrt(square)
        return min(max(share, 0.0), 1.0) if -slack <= share <= 1.0 + slack else None


def first_touch(surfaces: tuple[Surface, ...], start: Vector, end: Vector) -> float | None:
    """The share of a straight way at which the first of several surfaces is touched."""
    touches = [share for surface in surfaces if (share := surface.touched(start, end)) is not None]
    return min(touches, default=None)


def _crossing(gap: float, change: float) -> float | None:
    """When a distance that changes evenly comes to zero from above."""
    if change >= 0.0 or gap < -NO_WAY or gap + change > NO_WAY:
        return None
    return min(max(-gap / change, 0.0), 1.0)
