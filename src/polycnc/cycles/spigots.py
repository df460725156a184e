"""Rectangular, circular and polygonal spigots: on a half circle in, once round, out, level by level.

Source: SINUMERIK milling cycles (CYCLE76, CYCLE77, CYCLE79).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, tan
from typing import TYPE_CHECKING

from polycnc.cycles.mill_stroke import Place, arc, cut, rapid, ring

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.cycles.mill_stroke import MillStroke


@dataclass(frozen=True, slots=True)
class Spigot:
    """A spigot and how it is milled; mm.

    Attributes:
        place: Its middle and its length.
        half_length, half_width, corner: Of the finished spigot.
        blank: Half the length of the blank.
        radius: Of the tool, with the allowance that is left.
        clearance: Distance from the blank at which the tool goes down.
        ccw: Sense in which the spigot is followed.
        feed, depth_feed: In the plane and in depth.
        safe, retract: Level of the safety plane and of the end.
    """

    place: Place
    half_length: float
    half_width: float
    corner: float
    blank: float
    radius: float
    clearance: float
    ccw: bool
    feed: float
    depth_feed: float
    safe: float
    retract: float

    @property
    def reach(self) -> float:
        """Radius of the half circles: the tool goes down beside the blank."""
        side = self.half_length + self.radius
        beside = max(self.blank, self.half_length) + self.clearance + self.radius
        return max(0.5 * (beside - side), 0.5 * self.radius)


def mill(spigot: Spigot, levels: Sequence[float]) -> Iterator[MillStroke]:
    """All levels, from positioning beside the blank to the retraction plane."""
    off, reach = spigot.radius, spigot.reach
    side = spigot.half_length + off
    begin, middle = spigot.place(side + 2.0 * reach, 0.0), spigot.place(side + reach, 0.0)
    yield rapid(begin)
    yield rapid(w=spigot.safe)
    for level in levels:
        yield cut(spigot.depth_feed, w=level)
        yield arc(spigot.feed, spigot.place(side, 0.0), middle, not spigot.ccw)
        yield from ring(
            spigot.place, side, spigot.half_width + off, spigot.corner + off, spigot.ccw, spigot.feed
        )
        yield arc(spigot.feed, begin, middle, not spigot.ccw)
    yield rapid(w=spigot.retract)


FEWEST_EDGES = 3


@dataclass(frozen=True, slots=True)
class Polygon:
    """A spigot with equal edges; the middle of one of them lies on the place's x axis. Fields as in `Spigot`.

    `inner` is the radius of the circle that touches all edges.
    """

    place: Place
    count: int
    inner: float
    corner: float
    blank: float
    radius: float
    clearance: float
    ccw: bool
    feed: float
    safe: float
    retract: float


def inner_radius(count: int, edge: float) -> float:
    """Radius of the circle that touches all edges of a regular polygon, from the length of an edge."""
    return edge / (2.0 * tan(pi / count))


def mill_polygon(polygon: Polygon, levels: Sequence[float]) -> Iterator[MillStroke]:
    """All levels: on a half circle in, once round with arcs about the corners, out."""
    side = polygon.inner + polygon.radius
    beside = max(polygon.blank, polygon.inner) + polygon.clearance + polygon.radius
    reach = max(0.5 * (beside - side), 0.5 * polygon.radius)
    begin, middle = polygon.place(side + 2.0 * reach, 0.0), polygon.place(side + reach, 0.0)
    yield rapid(begin)
    yield rapid(w=polygon.safe)
    for level in levels:
        yield cut(polygon.feed, w=level)
        yield arc(polygon.feed, polygon.place(side, 0.0), middle, not polygon.ccw)
        yield from _edges(polygon, side)
        yield arc(polygon.feed, begin, middle, not polygon.ccw)
    yield rapid(w=polygon.retract)


def _edges(polygon: Polygon, side: float) -> Iterator[MillStroke]:
    """Once round, from the middle of the first edge and back there."""
    sense = 1.0 if polygon.ccw else -1.0
    pitch = 360.0 / polygon.count
    half = (polygon.inner - polygon.corner) * tan(pi / polygon.count)
    around = polygon.inner - polygon.corner
    for k in range(polygon.count):
        first = Place(polygon.place.origin, polygon.place.angle_deg + sense * k * pitch)
        second = Place(polygon.place.origin, polygon.place.angle_deg + sense * (k + 1) * pitch)
        yield cut(polygon.feed, first(side, sense * half))
        if polygon.corner + polygon.radius > 0.0:
            center = first(around, sense * half)
            yield arc(polygon.feed, second(side, -sense * half), center, polygon.ccw)
    yield cut(polygon.feed, polygon.place(side, 0.0))
