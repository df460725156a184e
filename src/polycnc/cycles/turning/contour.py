"""The contour of a turning cycle: edges from the start point over the shape, levels across it, and its checks.

Points are (a, b): `a` runs along the strokes, `b` is the direction of infeed. For longitudinal turning in ZX that is
(Z, X as radius), for facing (X as radius, Z); `swapped` changes one into the other.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise
from math import pi, sqrt

from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, offset
from polycnc.geometry.tolerances import NO_WAY
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge


@dataclass(frozen=True, slots=True)
class Piece:
    """One edge of a contour, and whether it is traversed at rapid."""

    edge: Edge
    is_rapid: bool = False

    def stroke(self) -> PlaneStroke:
        """The piece as a motion to its end."""
        edge = self.edge
        if edge.center is None:
            return PlaneStroke(Kind.RAPID if self.is_rapid else Kind.FEED, edge.end)
        return PlaneStroke(Kind.CCW if edge.ccw else Kind.CW, edge.end, edge.center)


Contour = list[Piece]


def shifted(contour: Sequence[Piece], da: float, db: float) -> Contour:
    """The contour moved."""

    def move(point: Point) -> Point:
        return (point[0] + da, point[1] + db)

    return [_mapped(piece, move, piece.edge.ccw) for piece in contour]


def swapped(contour: Sequence[Piece]) -> Contour:
    """The contour with its two coordinates exchanged; arcs turn the other way then."""
    return [_mapped(piece, lambda p: (p[1], p[0]), not piece.edge.ccw) for piece in contour]


def swapped_stroke(stroke: PlaneStroke) -> PlaneStroke:
    """A stroke with its two coordinates exchanged."""
    kind = {Kind.CW: Kind.CCW, Kind.CCW: Kind.CW}.get(stroke.kind, stroke.kind)
    center = None if stroke.center is None else (stroke.center[1], stroke.center[0])
    return replace(stroke, kind=kind, end=(stroke.end[1], stroke.end[0]), center=center)


def _mapped(piece: Piece, move: object, ccw: bool) -> Piece:
    edge = piece.edge
    start, end = move(edge.start), move(edge.end)  # type: ignore[operator]
    if edge.center is None:
        return Piece(offset.line(start, end), piece.is_rapid)
    return Piece(offset.arc(start, end, move(edge.center), ccw), piece.is_rapid)  # type: ignore[operator]


def reversal(contour: Sequence[Piece], axis: int, direction: float) -> float:
    """How far the contour runs back against a direction along one of its coordinates, mm."""
    worst = 0.0
    reached = contour[0].edge.start[axis] * direction if contour else 0.0
    for piece in contour:
        for value in (point[axis] for point in points(piece.edge)):
            worst = max(worst, reached - value * direction)
            reached = max(reached, value * direction)
    return worst


def points(edge: Edge) -> list[Point]:
    """Start, turning points of an arc, and end of an edge, in the order of travel."""
    return [edge.start, edge.end] if edge.center is None else list(_arc_points(edge, edge.center))


@lru_cache(maxsize=1024)
def _arc_points(edge: Edge, center: Point) -> tuple[Point, ...]:
    """As `points`. A roughing cycle asks for the same arcs at every level."""
    radius = arcs.radius_of(center, edge.end)
    turning = [
        (center[0] + da * radius, center[1] + db * radius) for da, db in ((1, 0), (0, 1), (-1, 0), (0, -1))
    ]
    inside = [p for p in turning if arcs.contains_direction(edge.start, edge.end, center, edge.ccw, p)]
    inside.sort(key=lambda p: abs(arcs.sweep_angle(edge.start, p, center, edge.ccw)) % arcs.TAU)
    return (edge.start, *inside, edge.end)


def crossings(edge: Edge, level: float) -> list[Point]:
    """Points of an edge at a level of `b`, in the order of travel; a run along the level gives none."""
    if edge.center is None:
        (a0, b0), (a1, b1) = edge.start, edge.end
        if abs(b1 - b0) <= NO_WAY or not min(b0, b1) - NO_WAY <= level <= max(b0, b1) + NO_WAY:
            return []
        part = min(max((level - b0) / (b1 - b0), 0.0), 1.0)
        return [(a0 + part * (a1 - a0), level)]
    center = edge.center
    radius = arcs.radius_of(center, edge.start)
    height = level - center[1]
    if abs(height) > radius + NO_WAY:
        return []
    half = sqrt(max(radius * radius - height * height, 0.0))
    points = [(edge.center[0] + sign * half, level) for sign in (1.0, -1.0)]
    inside = [
        point
        for point in points
        if arcs.contains_direction(edge.start, edge.end, edge.center, edge.ccw, point, 1e-9)
    ]
    return sorted(inside, key=lambda p: abs(arcs.sweep_angle(edge.start, p, center, edge.ccw)) % arcs.TAU)


@dataclass(frozen=True, slots=True)
class Gap:
    """Where a level lies free above the contour, between two points of it.

    Attributes:
        start: `a` at which it begins, seen in the contour's direction.
        end: `a` at which the contour comes up to the level again, or ends.
        piece: Number of the piece that ends it; the number of pieces where the contour ends first.
    """

    start: float
    end: float
    piece: int


def gaps(contour: Sequence[Piece], level: float, towards: float) -> list[Gap]:
    """The gaps of a level: where the contour is deeper; `towards` is the direction of infeed, 1 or -1."""
    result: list[Gap] = []
    opened: float | None = None
    for number, piece in enumerate(contour):
        for part in _split(piece.edge, level):
            deeper = towards * (_middle(part)[1] - level) > NO_WAY
            if deeper and opened is None:
                opened = part.start[0]
            elif not deeper and opened is not None and towards * (_middle(part)[1] - level) < -NO_WAY:
                result.append(Gap(opened, part.start[0], number))
                opened = None
    if opened is not None:
        result.append(Gap(opened, contour[-1].edge.end[0], len(contour)))
    return result


def _split(edge: Edge, level: float) -> Iterator[Edge]:
    """The parts of an edge between its crossings of a level."""
    last = edge.start
    for point in [*crossings(edge, level), edge.end]:
        if abs(point[0] - last[0]) + abs(point[1] - last[1]) > NO_WAY:
            yield _between(edge, last, point)
            last = point


def _between(edge: Edge, start: Point, end: Point) -> Edge:
    if edge.center is None:
        return offset.line(start, end)
    return offset.arc(start, end, edge.center, edge.ccw)


def _middle(edge: Edge) -> Point:
    if edge.center is None:
        return (0.5 * (edge.start[0] + edge.end[0]), 0.5 * (edge.start[1] + edge.end[1]))
    return arcs.point_on_arc(edge.start, edge.end, edge.center, edge.ccw, 0.5)


def climb(contour: Sequence[Piece], gap: Gap, level: float, until: float, towards: float) -> Contour:
    """The contour from the end of a gap up to a higher level, or to where it turns down again or ends.

    What runs level on the way belongs to it, for stock lies on that up to the higher level.
    """
    path: Contour = []
    at: Point = (gap.end, level)
    for piece in contour[gap.piece :]:
        for part in _split(piece.edge, until):
            if part.end == at or _is_before(part, at):
                continue
            start = at if not path else part.start
            falls = towards * (part.end[1] - start[1]) > NO_WAY
            if falls or towards * (_middle(part)[1] - until) < NO_WAY:
                return path
            path.append(Piece(_between(piece.edge, start, part.end), piece.is_rapid))
    return path


def _is_before(part: Edge, at: Point) -> bool:
    """Whether a part of an edge ends where the climb begins."""
    return abs(part.end[0] - at[0]) + abs(part.end[1] - at[1]) <= NO_WAY


def deepest(contour: Sequence[Piece], towards: float) -> float:
    """The deepest `b` of a contour; `towards` is the direction of infeed, 1 or -1."""
    most = towards * contour[0].edge.start[1]
    for piece in contour:
        edge = piece.edge
        if edge.center is None:
            most = max(most, towards * edge.end[1])
        else:
            most = max(most, *(towards * b for _, b in points(edge)))
    return towards * most


def runs(contour: Sequence[Piece], level: float, towards: float) -> list[tuple[bool, Contour]]:
    """The contour in runs that lie at a level or deeper (true), and above it (false), in turn."""
    result: list[tuple[bool, Contour]] = []
    for piece in contour:
        edge = piece.edge
        below, above = _heights(edge, level, towards)
        if below <= NO_WAY or above <= NO_WAY:
            parts, is_whole = [edge], True  # most pieces do not cross the level
        else:
            parts, is_whole = list(_split(edge, level)), False
        for part in parts:
            is_deep = above <= NO_WAY if is_whole else towards * (_middle(part)[1] - level) > -NO_WAY
            if not result or result[-1][0] != is_deep:
                result.append((is_deep, []))
            result[-1][1].append(piece if is_whole else Piece(part, piece.is_rapid))
    return result


def _heights(edge: Edge, level: float, towards: float) -> Point:
    """How far an edge lies below a level at most, and above it; 0 or less where it does not."""
    first, last = towards * (edge.start[1] - level), towards * (edge.end[1] - level)
    if edge.center is None:
        return (first, -last) if first > last else (last, -first)
    heights = [towards * (b - level) for _, b in points(edge)]
    return max(heights), -min(heights)


def bumps(contour: Sequence[Piece], towards: float) -> list[Contour]:
    """The parts of a contour that go down and come up again, from ridge to ridge; slopes and steps are none."""
    if len(contour) == 1 and contour[0].edge.center is None:
        return []
    pieces = slopes(contour)
    parts: list[Contour] = []
    falls = True
    for piece in pieces:
        fall = towards * (piece.edge.end[1] - piece.edge.start[1])
        is_ridge = fall > NO_WAY and not falls
        if not parts or is_ridge:
            parts.append([])
        parts[-1].append(piece)
        falls = fall > NO_WAY if abs(fall) > NO_WAY else falls
    return [part for part in parts if _sags(part, towards)]


def _sags(contour: Contour, towards: float) -> bool:
    ends = max(towards * contour[0].edge.start[1], towards * contour[-1].edge.end[1])
    return towards * deepest(contour, towards) > ends + 1e-6


def slopes(contour: Sequence[Piece]) -> Contour:
    """The contour with its arcs cut at their turning points: every piece falls, rises or is flat."""
    return [
        Piece(_between(piece.edge, start, end), piece.is_rapid)
        for piece in contour
        for start, end in pairwise(points(piece.edge))
        if piece.edge.center is None or abs(end[0] - start[0]) + abs(end[1] - start[1]) > NO_WAY
    ]


def turned_round(contour: Sequence[Piece]) -> Contour:
    """The contour travelled the other way."""
    result: Contour = []
    for piece in reversed(contour):
        edge = piece.edge
        if edge.center is None:
            result.append(Piece(offset.line(edge.end, edge.start), piece.is_rapid))
        else:
            result.append(Piece(offset.arc(edge.end, edge.start, edge.center, not edge.ccw), piece.is_rapid))
    return result


#: Round every outer corner on an arc.
_ROUND = offset.Outer(intersection_limit_deg=0.0, beyond=offset.Joint.ARC)


def parallel(contour: Sequence[Piece], distance: float, *, leaves_fillets: bool = False) -> Contour:
    """The contour at a distance, positive to the left of its direction; outer corners become arcs.

    Args:
        contour: What is followed.
        distance: How far off.
        leaves_fillets: Stock may stay in an inner arc between two lines that is too narrow: they meet without it.

    Raises:
        ValueError: An inner corner or arc is too narrow for the distance.
    """
    if abs(distance) <= NO_WAY:
        return list(contour)
    if leaves_fillets:
        contour = _without_fillets(contour, distance)
    edges = [piece.edge for piece in contour]
    corners = []
    for a, b in pairwise(edges):
        corner = offset.corner(a, b, distance, _ROUND)
        if corner is None:
            raise ValueError("corner too narrow")
        corners.append(corner)
    begins = [offset.square(edges[0].departing, distance), *(corner.vectors[-1] for corner in corners)]
    ends = [*(corner.vectors[0] for corner in corners), offset.square(edges[-1].arriving, distance)]
    result: Contour = []
    for number, (piece, first, last) in enumerate(zip(contour, begins, ends, strict=True)):
        edge = piece.edge
        if offset.reverses(edge, first, last) or _is_too_narrow(edge, distance):
            raise ValueError("edge too short")
        start, end = _plus(edge.start, first), _plus(edge.end, last)
        if edge.center is None:
            result.append(Piece(offset.line(start, end), piece.is_rapid))
        elif not offset.is_point(edge, edge.end, distance):  # a nose as large as an inner arc rests in it
            result.append(Piece(offset.arc(start, end, edge.center, edge.ccw), piece.is_rapid))
        if number < len(corners) and corners[number].joint is offset.Joint.ARC:
            onto = _plus(edge.end, corners[number].vectors[-1])
            result.append(Piece(offset.arc(end, onto, edge.end, distance < 0.0), piece.is_rapid))
    return [piece for piece in result if piece.edge.length > NO_WAY]


def _without_fillets(contour: Sequence[Piece], distance: float) -> Contour:
    """The contour with the lines at both ends of an arc that is too narrow led on to where they meet."""
    result = list(contour)
    for k in range(1, len(result) - 1):
        before, edge, after = (piece.edge for piece in result[k - 1 : k + 2])
        if not _is_too_narrow(edge, distance) or before.center is not None or after.center is not None:
            continue
        met = offset.crossings(before, after, 0.0, 0.0)
        if met and edge.sweep < pi:
            corner = met[0]
            result[k - 1] = Piece(offset.line(before.start, corner), result[k - 1].is_rapid)
            result[k + 1] = Piece(offset.line(corner, after.end), result[k + 1].is_rapid)
            result[k] = Piece(offset.line(corner, corner))
    return [piece for piece in result if piece.edge.length > NO_WAY]


def _is_too_narrow(edge: Edge, distance: float) -> bool:
    """Whether an arc has less radius than the distance on its inner side: its parallel would lie beyond it."""
    if edge.center is None or offset.is_point(edge, edge.end, distance):
        return False
    return offset.offset_radius(arcs.radius_of(edge.center, edge.end), distance, edge.ccw) < 0.0


def _plus(point: Point, vector: Point) -> Point:
    return point[0] + vector[0], point[1] + vector[1]
