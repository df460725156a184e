"""Milling along a contour with approach and return (SINUMERIK CYCLE72)."""

from __future__ import annotations

from enum import Enum

from polycnc.cycles.milling.stroke import MillStroke, arc, cut, rapid
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.cycles.turning.contour import Contour
    from polycnc.geometry.arcs import Point


class ApproachShape(Enum):
    """How the tool comes to the contour, or leaves it."""

    DIRECT = 0
    STRAIGHT = 1
    QUARTER = 2
    HALF = 3


@dataclass(frozen=True, slots=True)
class Approach:
    """A way to the contour or off it: its shape, its length or radius, and whether it changes the level as well."""

    way: ApproachShape
    size: float = 0.0
    spatial: bool = False


@dataclass(frozen=True, slots=True)
class PathMilling:
    """How a contour is milled; mm.

    Attributes:
        path: Way of the tool's centre.
        side: On which side of the contour the tool is: 1 left, -1 right, 0 on it.
        approach, leave: Ways to the contour and off it.
        feed, depth_feed: In the plane and in depth.
        between: Feed between the levels, 0 for rapid.
        lifts: Level to which the tool rises between the levels, for each level; None to stay.
        safe, retract: Level of the safety plane and of the end.
    """

    path: Contour
    side: float
    approach: Approach
    leave: Approach
    feed: float
    depth_feed: float
    between: float
    lifts: Sequence[float | None]
    safe: float
    retract: float


def mill(work: PathMilling, levels: Sequence[float]) -> Iterator[MillStroke]:
    """All levels, from positioning to the retraction plane."""
    first, last = work.path[0].edge, work.path[-1].edge
    begin = _outer_point(first.start, first.departing, work.side, work.approach, -1.0)
    yield rapid(begin)
    yield rapid(w=work.safe)
    for number, level in enumerate(levels):
        if number:
            yield _between(work, begin)
        if not work.approach.spatial:
            yield cut(work.depth_feed, w=level)
        onto = level if work.approach.spatial else None
        yield from _way(work, work.approach, first.start, first.start, first.departing, onto)
        for piece in work.path:
            stroke = piece.stroke()
            yield MillStroke(
                Kind.FEED if stroke.kind is Kind.RAPID else stroke.kind,
                stroke.end,
                None,
                work.feed,
                stroke.center,
            )
        end = _outer_point(last.end, last.arriving, work.side, work.leave, 1.0)
        lift = work.lifts[number]
        off = lift if work.leave.spatial else None
        yield from _way(work, work.leave, end, last.end, last.arriving, off)
        if lift is not None and off is None:
            yield cut(work.between, w=lift) if work.between else rapid(w=lift)
    yield rapid(w=work.retract)


def _between(work: PathMilling, point: Point) -> MillStroke:
    return cut(work.between, point) if work.between else rapid(point)


def _square(direction: Point, side: float) -> Point:
    """The direction from the contour to the tool."""
    return -side * direction[1], side * direction[0]


def _outer_point(at: Point, direction: Point, side: float, way: Approach, sense: float) -> Point:
    """Where an approach begins (sense -1), or a return ends (1)."""
    n, size = _square(direction, side), way.size
    along, across = {
        ApproachShape.DIRECT: (0.0, 0.0),
        ApproachShape.STRAIGHT: (sense * size, 0.0),
        ApproachShape.QUARTER: (sense * size, size),
        ApproachShape.HALF: (0.0, 2.0 * size),
    }[way.way]
    return at[0] + along * direction[0] + across * n[0], at[1] + along * direction[1] + across * n[1]


def _way(
    work: PathMilling, way: Approach, to: Point, contact: Point, direction: Point, w: float | None
) -> Iterator[MillStroke]:
    """Straight or on an arc that touches the contour at `contact`."""
    if way.way in (ApproachShape.DIRECT, ApproachShape.STRAIGHT):
        yield cut(work.feed, to, w)
        return
    n = _square(direction, work.side)
    center = contact[0] + way.size * n[0], contact[1] + way.size * n[1]
    yield arc(work.feed, to, center, work.side > 0.0, w)
