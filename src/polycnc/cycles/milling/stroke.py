"""What milling cycles yield: strokes in a plane and across it, and the shapes that they are drawn in."""

from __future__ import annotations

from math import nan

from polycnc.cycles.count import parts
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import cos_sin_deg
from polycnc.geometry.tolerances import NO_WAY
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.geometry.arcs import Point

#: Divisions that miss a whole number by this much hit it: 6/2 are three steps.
_WHOLE = 1e-6


@dataclass(frozen=True, slots=True)
class MillStroke:
    """One stroke of the tool.

    Attributes:
        kind: RAPID, FEED, CW or CCW.
        point: Where it ends in the plane, mm; None to stay.
        w: Where it ends across the plane, mm; None to stay.
        feed: Feed of a cut.
        center: Centre of an arc.
    """

    kind: Kind
    point: Point | None = None
    w: float | None = None
    feed: float = nan
    center: Point | None = None


def rapid(point: Point | None = None, w: float | None = None) -> MillStroke:
    """A rapid move."""
    return MillStroke(Kind.RAPID, point, w)


def cut(feed: float, point: Point | None = None, w: float | None = None) -> MillStroke:
    """A straight cut."""
    return MillStroke(Kind.FEED, point, w, feed)


def arc(feed: float, point: Point, center: Point, ccw: bool, w: float | None = None) -> MillStroke:
    """An arc, or a helix with `w`; a full turn where it ends above its start."""
    return MillStroke(Kind.CCW if ccw else Kind.CW, point, w, feed, center)


@dataclass(frozen=True, slots=True)
class Place:
    """Where a shape lies: its own origin and axes in the plane of the cycle."""

    origin: Point = (0.0, 0.0)
    angle_deg: float = 0.0

    def __call__(self, x: float, y: float) -> Point:
        """A point of the shape in the plane."""
        c, s = cos_sin_deg(self.angle_deg)
        return self.origin[0] + x * c - y * s, self.origin[1] + x * s + y * c


class Cavity:
    """What is milled into a face: depths count from its reference level to that of the finished base."""

    __slots__ = ()
    reference: float
    depth: float

    def level(self, below: float) -> float:
        """Level of a depth below the reference plane."""
        return self.reference - below if self.depth < self.reference else self.reference + below

    @property
    def total(self) -> float:
        """Depth of the finished base below the reference plane."""
        return abs(self.reference - self.depth)


def steps(total: float, most: float) -> list[float]:
    """A way in equal steps of at most `most`, as ends of the steps; one step for a `most` of 0."""
    count = max(1, parts(total, most, _WHOLE)) if most > 0.0 else 1
    return [total * k / count for k in range(1, count)] + [total]


def ring(
    place: Place, half_length: float, half_width: float, corner: float, ccw: bool, feed: float
) -> Iterator[MillStroke]:
    """Once round a rectangle with rounded corners, from the middle of its right side and back there.

    A rectangle whose corners leave no straight sides is a circle, and one without corner radius four lines.
    """
    a, b = half_length, half_width
    if abs(a - corner) < NO_WAY and abs(b - corner) < NO_WAY:
        if corner > NO_WAY:
            yield arc(feed, place(a, 0.0), place(0.0, 0.0), ccw)
        return
    side = 1.0 if ccw else -1.0
    corners = ((a, b), (-a, b), (-a, -b), (a, -b))
    for x, y in corners:
        inner = (x - corner if x > 0.0 else x + corner, y - corner if y > 0.0 else y + corner)
        # The corners at the top right and bottom left are reached along y, the others along x.
        along_y = x * y > 0.0
        first, last = ((x, inner[1]), (inner[0], y)) if along_y else ((inner[0], y), (x, inner[1]))
        yield cut(feed, place(first[0], side * first[1]))
        if corner > NO_WAY:
            yield arc(feed, place(last[0], side * last[1]), place(inner[0], side * inner[1]), ccw)
    yield cut(feed, place(a, 0.0))


def slot_ring(place: Place, length: float, half_width: float, ccw: bool, feed: float) -> Iterator[MillStroke]:
    """Once round a straight slot from its origin's side, and back: lines and half circles about both ends.

    Args:
        place: Origin at one end's centre, x along the slot.
        length: Between the centres of its ends.
        half_width: Distance of the path from the middle line; 0 for a way there and back along it.
        ccw: Sense of rotation.
        feed: Feed.
    """
    h = half_width if ccw else -half_width
    if half_width <= NO_WAY:
        yield cut(feed, place(length, 0.0))
        yield cut(feed, place(0.0, 0.0))
        return
    yield cut(feed, place(0.0, -h))
    yield cut(feed, place(length, -h))
    yield arc(feed, place(length, h), place(length, 0.0), ccw)
    yield cut(feed, place(0.0, h))
    yield arc(feed, place(0.0, -h), place(0.0, 0.0), ccw)
