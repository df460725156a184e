"""Rectangular, circular and polygonal spigots: on a half circle in, once round, out, level by level.

Source: SINUMERIK milling cycles (CYCLE76, CYCLE77, CYCLE79).
"""

from __future__ import annotations

from math import pi, tan

from polycnc.cycles.milling.stroke import Place, arc, cut, rapid, ring
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.cycles.milling.stroke import MillStroke
    from polycnc.geometry.arcs import Point

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


def mill(spigot: Spigot, levels: Sequence[float], outside: Sequence[float] = (0.0,)) -> Iterator[MillStroke]:
    """All levels, from positioning beside the blank to the retraction plane.

    Args:
        spigot: The spigot.
        levels: Where it is followed.
        outside: On each level once round this far outside of the outline, from the outside inwards; the last is 0.
    """
    ways = [_way(spigot, off) for off in outside]
    yield rapid(ways[0].begin)
    yield rapid(w=spigot.safe)
    for number, level in enumerate(levels):
        if number and ways[-1].begin != ways[0].begin:
            yield cut(spigot.feed, ways[0].begin)
        yield cut(spigot.depth_feed, w=level)
        for before, way in zip((ways[0], *ways), ways, strict=False):
            if way.begin != before.begin:
                yield cut(spigot.feed, way.begin)
            yield arc(spigot.feed, way.onto, way.middle, not spigot.ccw)
            yield from spigot.outline.follow(spigot.place, way.off, spigot.ccw, spigot.feed)
            yield arc(spigot.feed, way.begin, way.middle, not spigot.ccw)
    yield rapid(w=spigot.retract)


class _Way(NamedTuple):
    """Once round: how far off the outline, and the half circle on which the tool comes and goes."""

    off: float
    begin: Point
    middle: Point
    onto: Point


def _way(spigot: Spigot, outside: float) -> _Way:
    place, reach = spigot.place, spigot.outline.reach
    side = reach + spigot.radius + outside
    beside = max(spigot.blank, reach) + spigot.clearance + spigot.radius
    arc_radius = max(0.5 * (beside - side), 0.5 * spigot.radius)
    begin, middle = place(side + 2.0 * arc_radius, 0.0), place(side + arc_radius, 0.0)
    return _Way(spigot.radius + outside, begin, middle, place(side, 0.0))
