"""Rectangular, circular and polygonal spigots: on a half circle in, once round, out, level by level.

Source: SINUMERIK milling cycles (CYCLE76, CYCLE77, CYCLE79).
"""

from __future__ import annotations

from math import pi, tan
from typing import TYPE_CHECKING, Protocol

from polycnc.cycles.milling.stroke import Place, arc, cut, rapid, ring
from polycnc.deferred.records import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.cycles.milling.stroke import MillStroke

FEWEST_EDGES = 3


class Outline(Protocol):
    """The finished outline of a spigot; its flank across the place's x axis is where the tool comes and goes."""

    @property
    def reach(self) -> float:
        """From the middle to that flank, mm."""

    def follow(self, place: Place, off: float, ccw: bool, feed: float) -> Iterator[MillStroke]:
        """Once round, `off` outside the outline, from the middle of that flank and back there."""


@dataclass(frozen=True, slots=True)
class Rectangle:
    """A rectangle with rounded corners; with no straight side left it is a circle; mm."""

    half_length: float
    half_width: float
    corner: float

    @property
    def reach(self) -> float:
        """Half the length."""
        return self.half_length

    def follow(self, place: Place, off: float, ccw: bool, feed: float) -> Iterator[MillStroke]:
        """As `Outline.follow`."""
        return ring(place, self.half_length + off, self.half_width + off, self.corner + off, ccw, feed)


@dataclass(frozen=True, slots=True)
class Polygon:
    """A polygon of `count` equal edges with rounded corners; `inner` is the radius of the circle within it, mm."""

    count: int
    inner: float
    corner: float

    @property
    def reach(self) -> float:
        """The inner radius."""
        return self.inner

    def follow(self, place: Place, off: float, ccw: bool, feed: float) -> Iterator[MillStroke]:
        """As `Outline.follow`."""
        side, sense = self.inner + off, 1.0 if ccw else -1.0
        around = self.inner - self.corner
        half = around * tan(pi / self.count)
        for k in range(self.count):
            first, second = (
                Place(place.origin, place.angle_deg + sense * edge * 360.0 / self.count)
                for edge in (k, k + 1)
            )
            yield cut(feed, first(side, sense * half))
            if self.corner + off > 0.0:
                yield arc(feed, second(side, -sense * half), first(around, sense * half), ccw)
        yield cut(feed, place(side, 0.0))


def inner_radius(count: int, edge: float) -> float:
    """Radius of the circle that touches all edges of a regular polygon, from the length of an edge."""
    return edge / (2.0 * tan(pi / count))


@dataclass(frozen=True, slots=True)
class Spigot:
    """A spigot and how it is milled; mm.

    Attributes:
        place: Its middle and its x axis.
        outline: Of the finished spigot.
        blank: From the middle to the flank of the blank.
        radius: Of the tool, with the allowance that is left.
        clearance: Distance from the blank at which the tool goes down.
        ccw: Sense in which the spigot is followed.
        feed, depth_feed: In the plane and in depth.
        safe, retract: Level of the safety plane and of the end.
    """

    place: Place
    outline: Outline
    blank: float
    radius: float
    clearance: float
    ccw: bool
    feed: float
    depth_feed: float
    safe: float
    retract: float


def mill(spigot: Spigot, levels: Sequence[float]) -> Iterator[MillStroke]:
    """All levels, from positioning beside the blank to the retraction plane."""
    place, outline, feed, ccw = spigot.place, spigot.outline, spigot.feed, spigot.ccw
    side = outline.reach + spigot.radius
    beside = max(spigot.blank, outline.reach) + spigot.clearance + spigot.radius
    arc_radius = max(0.5 * (beside - side), 0.5 * spigot.radius)
    begin, middle = place(side + 2.0 * arc_radius, 0.0), place(side + arc_radius, 0.0)
    yield rapid(begin)
    yield rapid(w=spigot.safe)
    for level in levels:
        yield cut(spigot.depth_feed, w=level)
        yield arc(feed, place(side, 0.0), middle, not ccw)
        yield from outline.follow(place, spigot.radius, ccw, feed)
        yield arc(feed, begin, middle, not ccw)
    yield rapid(w=spigot.retract)
