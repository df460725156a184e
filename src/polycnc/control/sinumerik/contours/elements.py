"""The pieces of a contour: lines and arcs in the abscissa and ordinate of the working plane."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, degrees, floor, sqrt

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, offset
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge

#: Angles of elements are counted modulo half a turn, degrees.
HALF_TURN = 180.0
#: Turning points of an arc that lie nearer to its ends are its ends, mm; heights that differ by less are the same.
SAME_MM = 1e-6
#: Directions that differ by less are the same, degrees: rounding of a line along an axis.
SAME_DEG = 1e-9
#: Units of the motion code.
RAPID, LINE, CLOCKWISE, COUNTER_CLOCKWISE = range(4)


@dataclass(frozen=True, slots=True)
class Element:
    """A line or an arc of a contour.

    Attributes:
        edge: Its geometry, mm.
        modes: Hundreds and tens of its motion code: absolute or incremental, and the unit.
        is_rapid: It is a G0.
    """

    edge: Edge
    modes: int
    is_rapid: bool = False

    @property
    def code(self) -> int:
        """Column 2 of a table of CONTPRON."""
        if self.edge.center is not None:
            return self.modes + (COUNTER_CLOCKWISE if self.edge.ccw else CLOCKWISE)
        return self.modes + (RAPID if self.is_rapid else LINE)

    def between(self, start: Point, end: Point) -> Element:
        """A part of the element."""
        return Element(_between(self.edge, start, end), self.modes, self.is_rapid)

    def turned_round(self) -> Element:
        """The element travelled the other way."""
        edge = self.edge
        if edge.center is None:
            return Element(offset.line(edge.end, edge.start), self.modes, self.is_rapid)
        return Element(offset.arc(edge.end, edge.start, edge.center, not edge.ccw), self.modes)


def _between(edge: Edge, start: Point, end: Point) -> Edge:
    if edge.center is None:
        return offset.line(start, end)
    return offset.arc(start, end, edge.center, edge.ccw)


class Side(NamedTuple):
    """From which side a contour is machined: what is high, and which axis angles are counted from.

    Attributes:
        across: Face turning: heights lie along the abscissa, and angles count from the ordinate.
        sign: 1 where the material lies above the contour, -1 below it.
    """

    across: bool
    sign: float

    def height(self, point: Point) -> float:
        """How high a point lies."""
        return self.sign * point[0 if self.across else 1]

    def raised(self, point: Point, height: float) -> Point:
        """The point at another height."""
        value = self.sign * height
        return (value, point[1]) if self.across else (point[0], value)

    def angle(self, edge: Edge) -> float:
        """Greatest angle between an edge and the axis, degrees, 0 to 180; of a line below 180."""
        along, across = edge.departing
        first = degrees(atan2(along, across) if self.across else atan2(across, along))
        if edge.center is None:
            angle = first % HALF_TURN
            return angle if HALF_TURN - angle > SAME_DEG else 0.0
        sweep = degrees(edge.sweep)
        turns_left = edge.ccw is not self.across
        low, high = (first, first + sweep) if turns_left else (first - sweep, first)
        multiple = HALF_TURN * floor((high + SAME_DEG) / HALF_TURN)
        return HALF_TURN if multiple > low + SAME_DEG else high - multiple

    def slopes(self, element: Element) -> list[Element]:
        """An arc in parts that rise or fall, cut where it is highest or lowest; a line is one part."""
        edge = element.edge
        center = edge.center
        if center is None:
            return [element]
        middle, radius = self.height(center), arcs.radius_of(center, edge.start)
        tips = [self.raised(center, middle + radius), self.raised(center, middle - radius)]
        ends = (edge.start, edge.end)
        inside = [
            tip
            for tip in tips
            if arcs.contains_direction(edge.start, edge.end, center, edge.ccw, tip)
            and all(arcs.radius_of(tip, end) > SAME_MM for end in ends)
        ]
        inside.sort(key=lambda tip: abs(arcs.sweep_angle(edge.start, tip, center, edge.ccw)))
        return [element.between(*part) for part in pairwise([edge.start, *inside, edge.end])]

    def at_height(self, edge: Edge, height: float) -> Point:
        """Where an edge that rises throughout passes a height."""
        low, high = self.height(edge.start), self.height(edge.end)
        if edge.center is None:
            share = (height - low) / (high - low)
            (u0, v0), (u1, v1) = edge.start, edge.end
            return self.raised((u0 + share * (u1 - u0), v0 + share * (v1 - v0)), height)
        center = edge.center
        middle, radius = self.height(center), arcs.radius_of(center, edge.start)
        half = sqrt(max(radius * radius - (height - middle) ** 2, 0.0))
        u, v = self.raised(center, height)
        points = [(u, v - half), (u, v + half)] if self.across else [(u - half, v), (u + half, v)]
        return min(points, key=lambda point: abs(arcs.sweep_angle(edge.start, point, center, edge.ccw)))


def is_full_circle(edge: Edge) -> bool:
    """Whether an arc ends where it begins."""
    return edge.center is not None and arcs.radius_of(edge.start, edge.end) <= NO_WAY
