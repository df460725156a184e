"""Slots and elongated holes (SINUMERIK SLOT1, SLOT2, LONGHOLE)."""

from __future__ import annotations

from math import asin, degrees, hypot, radians, tan

from polycnc.cycles.milling.pockets import Insertion
from polycnc.cycles.milling.stroke import Cavity, Place, arc, cut, rapid, slot_ring, steps
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.geometry.frames import cos_sin_deg
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.cycles.milling.stroke import MillStroke
    from polycnc.geometry.arcs import Point


class Shape(Protocol):
    """A slot by its middle line."""

    @property
    def start(self) -> Point:
        """Where the middle line begins."""

    @property
    def length(self) -> float:
        """Length of the middle line."""

    def round(self, half_width: float, ccw: bool, feed: float) -> Iterator[MillStroke]:
        """From the start once round at a distance from the middle line, and back to the start."""

    def along(self, feed: float, w: float, back: float) -> Iterator[MillStroke]:
        """Along the middle line to a level half way, and back to `back`."""


@dataclass(frozen=True, slots=True)
class Straight:
    """A straight slot: origin at one end's centre, x along it."""

    place: Place
    length: float

    @property
    def start(self) -> Point:
        """The centre of the first end."""
        return self.place(0.0, 0.0)

    def round(self, half_width: float, ccw: bool, feed: float) -> Iterator[MillStroke]:
        """Lines and half circles."""
        yield from slot_ring(self.place, self.length, half_width, ccw, feed)
        if half_width > NO_WAY:
            yield cut(feed, self.start)

    def along(self, feed: float, w: float, back: float) -> Iterator[MillStroke]:
        """There and back."""
        yield cut(feed, self.place(self.length, 0.0), w)
        yield cut(feed, self.start, back)


@dataclass(frozen=True, slots=True)
class Curved:
    """A slot along a circle: origin at its centre, begins on the x axis, counter-clockwise over an angle."""

    place: Place
    radius: float
    angle_deg: float

    @property
    def start(self) -> Point:
        """The centre of the first end."""
        return self.place(self.radius, 0.0)

    @property
    def length(self) -> float:
        """Length of the middle line."""
        return self.radius * radians(self.angle_deg)

    def _at(self, radius: float, angle: float) -> Point:
        c, s = cos_sin_deg(angle)
        return self.place(radius * c, radius * s)

    def round(self, half_width: float, ccw: bool, feed: float) -> Iterator[MillStroke]:
        """The outer arc, the half circle about the end, the inner arc, the half circle about the start."""
        center, angle = self.place(0.0, 0.0), self.angle_deg
        if half_width <= NO_WAY:
            yield arc(feed, self._at(self.radius, angle), center, True)
            yield arc(feed, self.start, center, False)
            return
        near, far = self.radius - half_width, self.radius + half_width
        first, second = (far, near) if ccw else (near, far)
        yield cut(feed, self._at(first, 0.0))
        yield arc(feed, self._at(first, angle), center, True)
        yield arc(feed, self._at(second, angle), self._at(self.radius, angle), ccw)
        yield arc(feed, self._at(second, 0.0), center, False)
        yield arc(feed, self._at(first, 0.0), self.start, ccw)
        yield cut(feed, self.start)

    def along(self, feed: float, w: float, back: float) -> Iterator[MillStroke]:
        """There and back on helices."""
        center = self.place(0.0, 0.0)
        yield arc(feed, self._at(self.radius, self.angle_deg), center, True, w)
        yield arc(feed, self.start, center, False, back)


def angle_of(chord: float, radius: float) -> float:
    """Angle under which a chord is seen from the centre, degrees."""
    return 2.0 * degrees(asin(min(chord / (2.0 * radius), 1.0)))


@dataclass(frozen=True, slots=True)
class Slotting(Cavity):
    """How slots are milled: half the width of the slot; levels, steps, allowances and feeds as in `pockets.Pocket`.

    `steepest_deg` is the greatest angle of an oscillating insertion, 0 for one way there and back.
    """

    half_width: float
    radius: float
    reference: float
    safe: float
    retract: float
    depth: float
    infeed: float
    finishing_infeed: float
    allowance: float
    base_allowance: float
    feed: float
    depth_feed: float
    finishing_feed: float
    ccw: bool
    insertion: Insertion = Insertion.FEED
    steepest_deg: float = 0.0

    @property
    def leaves_allowance(self) -> bool:
        """Whether roughing leaves something for finishing."""
        return self.allowance > NO_WAY or self.base_allowance > NO_WAY


def rough(slotting: Slotting, shape: Shape) -> Iterator[MillStroke]:
    """Mill one slot out, from positioning over its start to the safety plane."""
    yield rapid(shape.start)
    yield rapid(w=slotting.safe)
    off = max(slotting.half_width - slotting.radius - slotting.allowance, 0.0)
    above = slotting.safe
    for below in steps(slotting.total - slotting.base_allowance, slotting.infeed):
        level = slotting.level(below)
        yield from _plunge(slotting, shape, above, level)
        yield from shape.round(off, slotting.ccw, slotting.feed)
        above = level
    yield rapid(w=slotting.safe)


def finish(slotting: Slotting, shape: Shape) -> Iterator[MillStroke]:
    """Follow the finished edge of one slot in steps, from positioning to the safety plane."""
    yield rapid(shape.start)
    yield rapid(w=slotting.safe)
    off = max(slotting.half_width - slotting.radius, 0.0)
    for below in steps(slotting.total, slotting.finishing_infeed):
        yield cut(slotting.depth_feed, w=slotting.level(below))
        yield from shape.round(off, slotting.ccw, slotting.finishing_feed)
    yield rapid(w=slotting.safe)


def _plunge(slotting: Slotting, shape: Shape, above: float, level: float) -> Iterator[MillStroke]:
    """Into the material at the start of the slot, or down along its middle line, there and back."""
    if slotting.insertion is Insertion.RAPID:
        yield rapid(w=level)
    elif slotting.insertion is Insertion.FEED:
        yield cut(slotting.depth_feed, w=level)
    else:
        slope = tan(radians(slotting.steepest_deg))
        most = 2.0 * shape.length * slope
        down = level - above
        before = 0.0
        for part in steps(abs(down), most):
            middle, end = above + down * (before + part) / 2.0 / abs(down), above + down * part / abs(down)
            yield from shape.along(slotting.feed, middle, end)
            before = part


class HoleLevels(Protocol):
    """Levels that an elongated hole needs."""

    @property
    def retract(self) -> float:
        """Level at the end."""

    @property
    def reference(self) -> float:
        """The blank's face."""

    @property
    def safe(self) -> float:
        """The safety plane."""

    @property
    def depth(self) -> float:
        """The base."""


def to_and_fro(
    ends: tuple[Point, Point],
    tool: Point,
    levels: HoleLevels,
    infeed: float,
    feed: float,
    depth_feed: float,
) -> Iterator[MillStroke]:
    """An elongated hole: from the end nearer to the tool to and fro, deeper at every reversal."""
    first, second = ends
    if _distance(second, tool) < _distance(first, tool):
        first, second = second, first
    yield rapid(first)
    yield rapid(w=levels.safe)
    down = -1.0 if levels.depth < levels.reference else 1.0
    for number, below in enumerate(steps(abs(levels.reference - levels.depth), infeed)):
        yield cut(depth_feed, w=levels.reference + down * below)
        yield cut(feed, first if number % 2 else second)
    yield rapid(w=levels.retract)


def _distance(a: Point, b: Point) -> float:
    return hypot(a[0] - b[0], a[1] - b[1])
