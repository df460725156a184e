"""Parallel curves in a plane: what an edge of a contour becomes at a distance, and how two such curves meet.

An `Edge` is a straight line or an arc with its directions of travel. An offset is a signed distance:
positive to the left of the direction of travel, negative to the right. Where two edges meet in a corner,
the tool passes one or more points near it; each is told as its vector from the corner, and a `Corner` is
the list of these vectors in the order of travel: the first ends the edge in front, the last starts the next
one.
"""

from __future__ import annotations

from enum import Enum
from math import atan2, cos, degrees, hypot, pi, sqrt

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs
from polycnc.geometry.tolerances import NO_WAY, ROUNDED_MM, SMOOTH_MM

if TYPE_CHECKING:
    from polycnc.geometry.arcs import Point

#: A way shorter than this (mm) against the direction of travel is rounding: that of the points at its two ends.
BACKWARDS_MM = 2.0 * ROUNDED_MM
#: What is left of it where a way round leads past it without harm: driven back, it cuts the corner by as much.
BRIDGED_MM = 1e-6
_PARALLEL = 1e-12


class Edge(NamedTuple):
    """A line or an arc of a contour.

    Attributes:
        start: First point, mm.
        end: Last point, mm.
        departing: Unit direction of travel at the start; zero for an edge without length.
        arriving: Unit direction of travel at the end.
        center: Centre of an arc; None for a line.
        ccw: Sense of an arc.
    """

    start: Point
    end: Point
    departing: Point
    arriving: Point
    center: Point | None = None
    ccw: bool = True

    def moved(self, by: Point) -> Edge:
        """The same line or arc elsewhere."""
        center = None if self.center is None else arcs.plus(self.center, by)
        return self._replace(start=arcs.plus(self.start, by), end=arcs.plus(self.end, by), center=center)

    @property
    def length(self) -> float:
        """Length, mm."""
        if self.center is None:
            return hypot(self.end[0] - self.start[0], self.end[1] - self.start[1])
        return arcs.arc_length(self.start, self.end, self.center, self.ccw)

    @property
    def sweep(self) -> float:
        """Angle of an arc, radians, always positive; 0 for a line."""
        if self.center is None:
            return 0.0
        return abs(arcs.sweep_angle(self.start, self.end, self.center, self.ccw))

    @property
    def is_full_circle(self) -> bool:
        """Whether an arc ends where it starts."""
        return self.sweep >= arcs.TAU


def line(start: Point, end: Point) -> Edge:
    """The straight edge between two points; its direction is that of the kernels, bit for bit."""
    du, dv = end[0] - start[0], end[1] - start[1]
    length = sqrt(du * du + dv * dv)
    direction = (du / length, dv / length) if length > 0.0 else (0.0, 0.0)
    return Edge(start, end, direction, direction)


def ray(start: Point, direction: Point) -> Edge:
    """The straight edge that leaves a point in a direction of any length but zero."""
    return line(start, (start[0] + direction[0], start[1] + direction[1]))


def arc(start: Point, end: Point, center: Point, ccw: bool) -> Edge:
    """The arc edge between two points about a centre; both points must be off the centre."""
    return Edge(
        start, end, arcs.tangent_at(center, start, ccw), arcs.tangent_at(center, end, ccw), center, ccw
    )


def square(direction: Point, offset: float) -> Point:
    """The vector of length `offset` that stands square on a direction, to its left."""
    return (-offset * direction[1], offset * direction[0])


def turn(a: Edge, b: Edge) -> float:
    """Angle (radians, -pi to pi) by which the direction turns between two edges, left positive."""
    (au, av), (bu, bv) = a.arriving, b.departing
    return atan2(au * bv - av * bu, au * bu + av * bv)


def is_outer(a: Edge, b: Edge, offset: float) -> bool:
    """Whether the tool goes round the corner: the path turns away from the tool, or back on itself."""
    return _leads_out(turn(a, b), offset)


def _leads_out(angle: float, offset: float) -> bool:
    return abs(angle) > pi - 1e-9 or angle * offset < -SMOOTH_MM


def offset_radius(radius: float, offset: float, ccw: bool) -> float:
    """Radius of the parallel arc: smaller on the centre's side; not positive where the tool does not fit."""
    return radius - offset if ccw else radius + offset


def is_point(edge: Edge, at: Point, offset: float) -> bool:
    """Whether the tool is as large as an inner arc: its parallel is the centre, as far as rounded points tell.

    Args:
        edge: A line or an arc.
        at: An end of it.
        offset: Signed offset.
    """
    if edge.center is None:
        return False
    return abs(offset_radius(arcs.radius_of(edge.center, at), offset, edge.ccw)) <= 3.0 * ROUNDED_MM


def meet(a: Edge, b: Edge, offset_a: float, offset_b: float) -> Point | None:
    """Where the curve parallel to `a` meets the curve parallel to `b` near the corner between them, or None.

    Of two intersections the one nearer to the corner is meant: it is the one that tends to the corner as
    the offset tends to zero, since both lie symmetric about the line that joins the centres (or the
    centre's foot on the line).
    """
    near = (0.5 * (a.end[0] + b.start[0]), 0.5 * (a.end[1] + b.start[1]))
    found = crossings(a, b, offset_a, offset_b)
    return min(found, key=lambda p: hypot(p[0] - near[0], p[1] - near[1]), default=None)


def crossings(a: Edge, b: Edge, offset_a: float, offset_b: float) -> list[Point]:
    """All points where the curve parallel to `a` meets the curve parallel to `b`, both without ends."""
    if a.center is None and b.center is None:
        point = _line_line(a, b, offset_a, offset_b)
        return [] if point is None else [point]
    if a.center is None:
        return _line_circle(a, a.end, offset_a, b, b.start, offset_b)
    if b.center is None:
        return _line_circle(b, b.start, offset_b, a, a.end, offset_a)
    return _circle_circle(a, b, offset_a, offset_b)


def _line_line(a: Edge, b: Edge, offset_a: float, offset_b: float) -> Point | None:
    """Two parallels: at a common corner with one offset `o·(n1 + n2)/(1 + n1·n2)`, else Cramer's rule."""
    (au, av), (bu, bv) = a.arriving, b.departing
    na, nb = square(a.arriving, offset_a), square(b.departing, offset_b)
    if a.end == b.start and offset_a == offset_b:
        share = 1.0 + au * bu + av * bv
        if share < _PARALLEL:
            return None
        return (a.end[0] + (na[0] + nb[0]) / share, a.end[1] + (na[1] + nb[1]) / share)
    cross = au * bv - av * bu
    if abs(cross) < _PARALLEL:
        return None
    p = (a.end[0] + na[0], a.end[1] + na[1])
    q = (b.start[0] + nb[0], b.start[1] + nb[1])
    along = ((q[0] - p[0]) * bv - (q[1] - p[1]) * bu) / cross
    return (p[0] + along * au, p[1] + along * av)


def _parallel_circle(edge: Edge, through: Point, offset: float) -> tuple[Point, float]:
    center = edge.center or through
    return center, abs(offset_radius(arcs.radius_of(center, through), offset, edge.ccw))


def _line_circle(
    a: Edge, at: Point, offset_a: float, b: Edge, through: Point, offset_b: float
) -> list[Point]:
    du, dv = a.arriving
    n = square(a.arriving, offset_a)
    p = (at[0] + n[0], at[1] + n[1])
    center, radius = _parallel_circle(b, through, offset_b)
    along = (center[0] - p[0]) * du + (center[1] - p[1]) * dv
    foot = (p[0] + along * du, p[1] + along * dv)
    half = _half_chord(radius, hypot(foot[0] - center[0], foot[1] - center[1]))
    if half is None:
        return []
    return [(foot[0] - half * du, foot[1] - half * dv), (foot[0] + half * du, foot[1] + half * dv)]


def _circle_circle(a: Edge, b: Edge, offset_a: float, offset_b: float) -> list[Point]:
    (c1, r1), (c2, r2) = _parallel_circle(a, a.end, offset_a), _parallel_circle(b, b.start, offset_b)
    du, dv = c2[0] - c1[0], c2[1] - c1[1]
    distance = hypot(du, dv)
    if distance < NO_WAY:
        return []
    if max(distance - (r1 + r2), abs(r1 - r2) - distance) > ROUNDED_MM:
        return []
    du, dv = du / distance, dv / distance
    along = (distance * distance + r1 * r1 - r2 * r2) / (2.0 * distance)
    half = sqrt(max(r1 * r1 - along * along, 0.0))
    foot = (c1[0] + along * du, c1[1] + along * dv)
    return [(foot[0] + half * dv, foot[1] - half * du), (foot[0] - half * dv, foot[1] + half * du)]


def _half_chord(radius: float, distance: float) -> float | None:
    """Half the chord that a line cuts out of a circle; a line that misses it by the rounding of a point touches it."""
    if distance > radius + ROUNDED_MM:
        return None
    return sqrt(max(radius * radius - distance * distance, 0.0))


def reverses(edge: Edge, first: Point, last: Point, rounding: float = BACKWARDS_MM) -> bool:
    """Whether the parallel edge, from vector `first` to vector `last`, runs against the edge.

    A line is reversed where the way along its direction is negative. An arc is reversed where its sweep,
    less what the vectors cut off (plus what they add) at both ends, is negative: the difference of 180
    degrees and more that FANUC's arc check names (5.4.6 of the lathe manual), without its blind spot at
    arcs above a semicircle. One that the tool fills is passed on the spot, whatever the vectors' directions.

    Args:
        edge: A line or an arc.
        first: Vector at its start.
        last: Vector at its end.
        rounding: A way back up to this is none, mm.
    """
    if edge.center is None:
        du, dv = edge.departing
        return edge.length + (last[0] - first[0]) * du + (last[1] - first[1]) * dv < -rounding
    if (
        max(_from_center(edge.center, edge.start, first), _from_center(edge.center, edge.end, last))
        <= 3.0 * ROUNDED_MM
    ):
        return False
    moved = _angle_moved(edge.center, edge.end, last) - _angle_moved(edge.center, edge.start, first)
    left = edge.sweep + (moved if edge.ccw else -moved)
    return left * arcs.radius_of(edge.center, edge.start) < -rounding


def _from_center(center: Point, point: Point, vector: Point) -> float:
    return hypot(point[0] + vector[0] - center[0], point[1] + vector[1] - center[1])


def _angle_moved(center: Point, point: Point, vector: Point) -> float:
    u, v = point[0] - center[0], point[1] - center[1]
    a, b = u + vector[0], v + vector[1]
    return atan2(u * b - v * a, u * a + v * b)


class Joint(Enum):
    """How the tool goes from one vector of a corner to the next."""

    LINE = "line"
    ARC = "arc"
    SPLINE = "spline"


@dataclass(slots=True)
class Corner:
    """The vectors of a corner in the order of travel, and what joins them (arcs turn about the corner)."""

    vectors: list[Point]
    joint: Joint = Joint.LINE


@dataclass(frozen=True, slots=True)
class Outer:
    """How a control goes round an outer corner.

    Attributes:
        intersection_limit_deg: Turns of up to this angle are taken by the intersection of the two parallels.
        beyond: What is done at sharper turns: `LINE` runs on by the radius on both sides and joins these
            two points; `ARC` turns about the corner.
        extend_as_circles: For intersections, arcs go on as circles; otherwise along their tangents.
        disc_percent: How far an arc is raised towards the intersection (SINUMERIK `DISC`, 0 to 100).
    """

    intersection_limit_deg: float = 90.0
    beyond: Joint = Joint.LINE
    extend_as_circles: bool = False
    disc_percent: float = 0.0


def corner(a: Edge, b: Edge, offset: float, outer: Outer) -> Corner | None:
    """The corner between two edges at one offset; None where an inner one has no intersection.

    Where the tool fills one of them, all that happens within the rounding of points about its centre happens there.
    """
    found = _corner(a, b, offset, outer)
    if a.center is None and b.center is None:
        return found
    for edge, at in ((a, a.end), (b, b.start)):
        if found is not None and edge.center is not None and is_point(edge, at, offset):
            center = (edge.center[0] - at[0], edge.center[1] - at[1])
            if all(hypot(u - center[0], v - center[1]) <= 3.0 * ROUNDED_MM for u, v in found.vectors):
                return Corner([center])
    return found


def _corner(a: Edge, b: Edge, offset: float, outer: Outer) -> Corner | None:
    angle = turn(a, b)
    if abs(offset * angle) <= SMOOTH_MM:
        # Not a corner: the vector square on an arc keeps a full circle closed.
        return Corner([square(a.arriving if a.center is not None else b.departing, offset)])
    if _leads_out(angle, offset):
        return _outer_corner(a, b, offset, outer, abs(angle))
    point = meet(a, b, offset, offset)
    return None if point is None else Corner([(point[0] - a.end[0], point[1] - a.end[1])])


def outer_corner(a: Edge, b: Edge, offset: float, outer: Outer) -> Corner:
    """The way round an outer corner; only the directions at the corner and the kinds of edges matter."""
    return _outer_corner(a, b, offset, outer, abs(turn(a, b)))


def _outer_corner(a: Edge, b: Edge, offset: float, outer: Outer, angle: float) -> Corner:
    first, last = square(a.arriving, offset), square(b.departing, offset)
    if degrees(angle) <= outer.intersection_limit_deg + 1e-9:
        if outer.extend_as_circles and (a.center is not None or b.center is not None):
            point = meet(a, b, offset, offset)
            if point is not None:
                return Corner([(point[0] - a.end[0], point[1] - a.end[1])])
        else:
            share = 1.0 + cos(angle)
            tips = [((first[0] + last[0]) / share, (first[1] + last[1]) / share)]
            return Corner(_with_arc_ends(a, b, first, tips, last))
    elif outer.beyond is Joint.LINE:
        reach = abs(offset)
        (au, av), (bu, bv) = a.arriving, b.departing
        tips = [(first[0] + reach * au, first[1] + reach * av), (last[0] - reach * bu, last[1] - reach * bv)]
        return Corner(_with_arc_ends(a, b, first, tips, last))
    if outer.disc_percent > 0.0 and degrees(angle) < 179.0:
        return Corner(_raised(first, last, angle, outer.disc_percent), Joint.SPLINE)
    return Corner([first, last], Joint.ARC)


def _with_arc_ends(a: Edge, b: Edge, first: Point, tips: list[Point], last: Point) -> list[Point]:
    """A line runs on to the tip; an arc must end square on itself before the tip's straight line begins."""
    return [*([first] if a.center is not None else []), *tips, *([last] if b.center is not None else [])]


def _raised(first: Point, last: Point, angle: float, percent: float) -> list[Point]:
    """A conic from vector to vector, tangent to both edges, raised from the arc towards the intersection.

    As a rational Bézier curve of degree two its top is `(m + w·v)/(1 + w)`, m the middle of the ends and v
    the intersection; the weight of the circular arc is `w = cos(angle/2)`. Points lie every 5 degrees of
    the turn.
    """
    share = 1.0 + cos(angle)
    tip = ((first[0] + last[0]) / share, (first[1] + last[1]) / share)
    if percent >= 100.0:
        return [first, tip, last]
    # Heights over the corner, in radii: middle cos(angle/2), arc 1, intersection 1/cos(angle/2).
    half = cos(0.5 * angle)
    top = 1.0 + 0.01 * percent * (1.0 / half - 1.0)
    weight = (top - half) / (1.0 / half - top)
    count = max(2, round(degrees(angle) / 5.0))
    points = []
    for k in range(count + 1):
        s = k / count
        x, y, z = (1.0 - s) ** 2, 2.0 * s * (1.0 - s) * weight, s * s
        points.append(tuple((x * first[i] + y * tip[i] + z * last[i]) / (x + y + z) for i in (0, 1)))
    return [(p[0], p[1]) for p in points]


# ---- corners that are cut off


class Cuts(NamedTuple):
    """Where a corner is cut off.

    Attributes:
        leaving: Last point of the edge in front; `part_a` of that edge lies before it, 0 to 1.
        entering: First point of the next edge; `part_b` of that edge lies before it.
        center: Of a rounding; None for a chamfer.
    """

    leaving: Point
    part_a: float
    entering: Point
    part_b: float
    center: Point | None = None


#: Directions that differ by less (radians) have no corner between them.
_STRAIGHT_ON = 1e-6
_SLACK = 1e-9


def rounded(a: Edge, b: Edge, radius: float) -> Cuts | None:
    """The cuts for a tangent arc between two edges; None where it does not fit."""
    way_round = turn(a, b)
    if abs(way_round) > pi - _STRAIGHT_ON:
        return None
    distance = radius if way_round > 0.0 else -radius
    center = meet(a, b, distance, distance)
    if center is None:
        return None
    leaving, entering = _nearest(a, center), _nearest(b, center)
    if abs(arcs.radius_of(center, leaving) - radius) + abs(arcs.radius_of(center, entering) - radius) > 1e-6:
        return None  # a rounding larger than an arc does not fit inside it
    return _fitting(Cuts(leaving, _part(a, leaving), entering, _part(b, entering), center))


def chamfered(a: Edge, b: Edge, leg: float) -> Cuts | None:
    """The cuts for a straight way that leaves out `leg` of both edges; None where it does not fit."""
    if abs(turn(a, b)) > pi - _STRAIGHT_ON:
        return None
    part_a, part_b = 1.0 - leg / a.length, leg / b.length
    return _fitting(Cuts(_at(a, part_a), part_a, _at(b, part_b), part_b))


def leg_of_chamfer(a: Edge, b: Edge, length: float) -> float:
    """What a chamfer of a length leaves out of both edges."""
    return 0.5 * length / cos(0.5 * turn(a, b))


def _fitting(cuts: Cuts) -> Cuts | None:
    if not (-_SLACK <= cuts.part_a < 1.0 and 0.0 < cuts.part_b <= 1.0 + _SLACK):
        return None
    return cuts._replace(part_a=max(cuts.part_a, 0.0), part_b=min(cuts.part_b, 1.0))


def _nearest(edge: Edge, center: Point) -> Point:
    """Where a circle about `center` touches the line or circle of an edge."""
    if edge.center is None:
        du, dv = edge.departing
        along = (center[0] - edge.start[0]) * du + (center[1] - edge.start[1]) * dv
        return (edge.start[0] + along * du, edge.start[1] + along * dv)
    radius = arcs.radius_of(edge.center, edge.end)
    return arcs.point_at(edge.center, radius, arcs.angle_at(edge.center, center))


def _part(edge: Edge, point: Point) -> float:
    """How much of an edge lies before a point on it; below 0 before its start, above 1 behind its end."""
    if edge.center is None:
        du, dv = edge.departing
        return ((point[0] - edge.start[0]) * du + (point[1] - edge.start[1]) * dv) / edge.length
    if hypot(point[0] - edge.start[0], point[1] - edge.start[1]) <= NO_WAY:
        return 0.0
    return abs(arcs.sweep_angle(edge.start, point, edge.center, edge.ccw)) / edge.sweep


def _at(edge: Edge, part: float) -> Point:
    if edge.center is None:
        (u0, v0), (u1, v1) = edge.start, edge.end
        return (u0 + part * (u1 - u0), v0 + part * (v1 - v0))
    return arcs.point_on_arc(edge.start, edge.end, edge.center, edge.ccw, part)
