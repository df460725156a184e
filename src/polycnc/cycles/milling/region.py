"""What the middle of a cutter may reach between closed contours, and the loops at a distance from them.

Walls are closed loops of edges. A normalised wall has the free side on its left, so a wall round the outside runs
counter-clockwise and an island clockwise. The loops at a distance R are the points of the free side whose nearest wall
is R away. They are made of the parallels of all edges and of arcs about the corners that point into the free side: cut
where they meet, kept where no wall is nearer, chained. Each loop has the free side on its left as well. Nothing is
handed on that comes nearer to a wall than it was asked for; `RegionError` where that cannot be had.
"""

from __future__ import annotations

from math import atan2, floor, hypot, pi

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, distance, offset
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge

#: The rectangle round something: least and greatest u and v.
Box = tuple[float, float, float, float]
#: A closed way of edges, each beginning where the one before ends.
Loop = list["Edge"]
#: A way is closed where its ends are no farther apart, mm.
CLOSED_MM = 1e-3
#: A loop may come nearer to a wall by as much, mm: rounding.
NEARER_MM = 1e-6
#: Ends of pieces that are as near as this belong together, mm.
_JOINED_MM = 1e-5
#: Shorter pieces of parallels are rounding, mm.
_SHORT_MM = 1e-7
_TINY_TURN = 1e-9
#: Where an arc is cut so that neither part has a chord like that of the whole.
_UNEVEN = 0.37
#: The size of the squares in which ends of pieces are looked for, mm.
_SQUARE_MM = 1e-4
#: Longest piece that may be left over, mm.
_LONGEST_TAIL_MM = 0.1


class RegionError(ValueError):
    """Contours that enclose nothing that could be milled: open, crossing, nested, or without inside."""


# ---- walls


def walls(
    outline: Sequence[Edge], islands: Sequence[Sequence[Edge]] = (), *, free_outside: bool = False
) -> list[Loop]:
    """Closed contours as walls, in any sense.

    Args:
        outline: Of a pocket, or of the blank round spigots.
        islands: What stands in it.
        free_outside: What lies outside the outline is free, so it is no wall but a blank.

    Raises:
        RegionError: A contour is not closed, two edges cross, or an island lies outside the outline or in another.
    """
    loops = [_closed(contour) for contour in (outline, *islands)]
    _refuse_crossings(loops[1:] if free_outside else loops)
    first, *others = loops
    for number, loop in enumerate(others):
        within = [other for k, other in enumerate(others) if k != number and contains(other, loop[0].start)]
        if within or not contains(first, loop[0].start):
            raise RegionError("nested")
    return [
        loop if (area(loop) > 0.0) is (number == 0) else reversed_loop(loop)
        for number, loop in enumerate(loops)
    ]


def _closed(contour: Sequence[Edge]) -> Loop:
    """The contour without edges of no length, full circles in two halves, and closed."""
    loop: Loop = []
    for edge in contour:
        if edge.center is not None and edge.is_full_circle:
            middle = arcs.point_on_arc(edge.start, edge.end, edge.center, edge.ccw, 0.5)
            loop += [
                offset.arc(edge.start, middle, edge.center, edge.ccw),
                offset.arc(middle, edge.end, edge.center, edge.ccw),
            ]
        elif edge.length > NO_WAY:
            loop.append(edge)
    if not loop or arcs.radius_of(loop[0].start, loop[-1].end) > CLOSED_MM:
        raise RegionError("open")
    if abs(area(loop)) <= NO_WAY:
        raise RegionError("no inside")
    return loop


def _refuse_crossings(loops: Sequence[Loop]) -> None:
    """No two edges may meet but neighbours at their common end."""
    places = [(number, k) for number, loop in enumerate(loops) for k in range(len(loop))]
    edges = [loops[number][k] for number, k in places]
    for i, j in _meeting_boxes([_box(edge, 0.0) for edge in edges]):
        (loop_a, a), (loop_b, b) = places[i], places[j]
        count = len(loops[loop_a])
        beside = loop_a == loop_b and (b - a) % count in (1, count - 1)
        ends = (edges[i].start, edges[i].end) if beside else ()
        for point in meetings(edges[i], edges[j]):
            if all(arcs.radius_of(point, end) > CLOSED_MM for end in ends):
                raise RegionError("crossing")


def _meeting_boxes(boxes: Sequence[Box]) -> Iterator[tuple[int, int]]:
    """Pairs of numbers of boxes that overlap, the smaller number first: a line swept across them finds them."""
    active: list[int] = []
    for i in sorted(range(len(boxes)), key=lambda k: boxes[k][0]):
        active = [j for j in active if boxes[j][2] >= boxes[i][0]]
        for j in active:
            if _overlap(boxes[i], boxes[j]):
                yield (i, j) if i < j else (j, i)
        active.append(i)


def reversed_loop(loop: Iterable[Edge]) -> Loop:
    """The loop travelled the other way."""
    return [_reversed(edge) for edge in reversed(list(loop))]


def _reversed(edge: Edge) -> Edge:
    if edge.center is None:
        return offset.line(edge.end, edge.start)
    return offset.arc(edge.end, edge.start, edge.center, not edge.ccw)


def area(loop: Iterable[Edge]) -> float:
    """Enclosed area, mm², above 0 counter-clockwise: of the chords, and of what arcs add to them."""
    total = 0.0
    for edge in loop:
        (u0, v0), (u1, v1) = edge.start, edge.end
        total += 0.5 * (u0 * v1 - u1 * v0)
        if edge.center is not None:
            r = arcs.radius_of(edge.center, edge.end)
            sweep = edge.sweep if edge.ccw else -edge.sweep
            du, dv = arcs.minus(edge.start, edge.center)
            eu, ev = arcs.minus(edge.end, edge.center)
            total += 0.5 * (r * r * sweep - (du * ev - eu * dv))
    return total


def contains(loop: Iterable[Edge], point: Point) -> bool:
    """Whether a loop runs round a point that lies on none of its edges: by how often it turns about it."""
    return round(sum(_turn_about(edge, point) for edge in loop) / (2.0 * pi)) % 2 != 0


def _turn_about(edge: Edge, point: Point) -> float:
    """Angle by which the direction from a point to an edge turns along it, radians."""
    (au, av), (bu, bv) = arcs.minus(edge.start, point), arcs.minus(edge.end, point)
    angle = atan2(au * bv - av * bu, au * bu + av * bv)
    if edge.center is None or arcs.radius_of(edge.center, point) >= arcs.radius_of(edge.center, edge.end):
        return angle
    du, dv = arcs.minus(edge.end, edge.start)
    beside = (av * du - au * dv) / hypot(du, dv)
    if (
        abs(beside) <= NEARER_MM
    ):  # on the chord, where the sign says nothing: parts of the arc have other chords
        cut = arcs.point_on_arc(edge.start, edge.end, edge.center, edge.ccw, _UNEVEN)
        halves = piece_of(edge, edge.start, cut), piece_of(edge, cut, edge.end)
        return sum(_turn_about(half, point) for half in halves)
    # Between chord and arc the arc goes round the point on its other side.
    if (beside > 0.0) is edge.ccw:
        angle += 2.0 * pi if edge.ccw else -2.0 * pi
    return angle


def is_free(loops: Sequence[Loop], point: Point, *, free_outside: bool = False) -> bool:
    """Whether a point lies on the free side of all walls."""
    return (sum(contains(loop, point) for loop in loops) % 2 != 0) is not free_outside


# ---- distances


def clearance(loops: Iterable[Loop], point: Point) -> float:
    """Distance of a point from the nearest wall, mm."""
    return min(distance.of_point(point, edge) for loop in loops for edge in loop)


def room_along(loops: Iterable[Loop], edge: Edge) -> float:
    """Smallest distance of an edge from the walls, mm."""
    return min(distance.between(edge, wall) for loop in loops for wall in loop)


def nearest(loops: Iterable[Loop], point: Point) -> Point:
    """The point of the walls that is nearest to a point."""
    places = [distance.nearest_point(point, edge) for loop in loops for edge in loop]
    return min(places, key=lambda place: arcs.radius_of(place, point))


# ---- loops at a distance


def loops_at(loops: Sequence[Loop], away: float) -> list[Loop]:
    """All loops at a distance from walls that have their free side on the left; none where nothing is left.

    Raises:
        RegionError: Rounding leaves a way open, or one too near to a wall.
    """
    near = _Nearby([edge for loop in loops for edge in loop], away)
    pieces = []
    for piece in _split(_raw(loops, away)):
        middle = middle_of(piece)
        if all(distance.of_point(middle, edge) >= away - NEARER_MM for edge in near.to((*middle, *middle))):
            pieces.append(piece)
    for piece in pieces:
        walls_near = near.to(_box(piece, 0.0))
        if any(distance.between(piece, edge) < away - 10.0 * NEARER_MM for edge in walls_near):
            raise RegionError("too near")
    return _chained(_without_tails(pieces))


def _raw(loops: Sequence[Loop], away: float) -> list[Edge]:
    """Parallels of all edges, and arcs about the corners that point into the free side.

    Parallels that meet in an inner corner end there, so that nothing of a smooth contour is left over.
    """
    result: list[Edge] = []
    for loop in loops:
        met = _inner_corners(loop, away)
        for k, edge in enumerate(loop):
            follower = loop[(k + 1) % len(loop)]
            start = met[k - 1] or _beside(edge.start, edge.departing, away)
            end = met[k] or _beside(edge.end, edge.arriving, away)
            if edge.center is None:
                result.append(offset.line(start, end))
            elif _radius_beside(edge, away) > NEARER_MM:
                result.append(offset.arc(start, end, edge.center, edge.ccw))
            if offset.turn(edge, follower) < -_TINY_TURN:
                onto = _beside(follower.start, follower.departing, away)
                if arcs.radius_of(end, onto) > _SHORT_MM:
                    result.append(offset.arc(end, onto, edge.end, ccw=False))
    return result


def _radius_beside(edge: Edge, away: float) -> float:
    assert edge.center is not None
    return offset.offset_radius(arcs.radius_of(edge.center, edge.end), away, edge.ccw)


def _inner_corners(loop: Loop, away: float) -> list[Point | None]:
    """Where the parallels of each edge and its follower meet; None where they do not, or one would be reversed."""
    met: list[Point | None] = []
    for edge, follower in zip(loop, [*loop[1:], loop[0]], strict=True):
        vanish = any(e.center is not None and _radius_beside(e, away) <= NEARER_MM for e in (edge, follower))
        inner = offset.turn(edge, follower) > _TINY_TURN
        met.append(offset.meet(edge, follower, away, away) if inner and not vanish else None)
    reversed_edges = []
    for k, edge in enumerate(loop):
        before, after = met[k - 1], met[k]
        first = arcs.minus(before, edge.start) if before else offset.square(edge.departing, away)
        last = arcs.minus(after, edge.end) if after else offset.square(edge.arriving, away)
        if offset.reverses(edge, first, last, -_JOINED_MM):
            reversed_edges.append(k)
    for k in reversed_edges:
        met[k - 1] = met[k] = None
    return met


def _beside(point: Point, direction: Point, away: float) -> Point:
    return arcs.plus(point, offset.square(direction, away))


def _split(edges: Sequence[Edge]) -> list[Edge]:
    """Edges cut wherever two of them meet."""
    cuts: list[list[Point]] = [[] for _ in edges]
    # In the order of their numbers, so that the same contour gives the same loops.
    for i, j in sorted(_meeting_boxes([_box(edge, _JOINED_MM) for edge in edges])):
        a, b = edges[i], edges[j]
        found = [*meetings(a, b), b.start, b.end, a.start, a.end]
        cuts[i] += [p for p in found if distance.of_point(p, a) <= _JOINED_MM]
        cuts[j] += [p for p in found if distance.of_point(p, b) <= _JOINED_MM]
    return [part for edge, points in zip(edges, cuts, strict=True) for part in _parts(edge, points)]


def _parts(edge: Edge, points: list[Point]) -> list[Edge]:
    """An edge between points on it."""
    result = []
    at = edge.start
    for point in [*sorted(points, key=lambda p: _along(edge, p)), edge.end]:
        if arcs.radius_of(at, point) > _JOINED_MM:
            result.append(piece_of(edge, at, point))
            at = point
    return result


def piece_of(edge: Edge, start: Point, end: Point) -> Edge:
    """The part of an edge between two points on it."""
    return offset.line(start, end) if edge.center is None else offset.arc(start, end, edge.center, edge.ccw)


def _along(edge: Edge, point: Point) -> float:
    """How far along an edge a point on it lies, as a measure for sorting."""
    if edge.center is None:
        du, dv = arcs.minus(point, edge.start)
        return du * edge.departing[0] + dv * edge.departing[1]
    if arcs.radius_of(edge.start, point) <= _JOINED_MM:
        return 0.0
    if arcs.radius_of(edge.end, point) <= _JOINED_MM:
        return edge.sweep
    return abs(arcs.sweep_angle(edge.start, point, edge.center, edge.ccw))


def middle_of(edge: Edge) -> Point:
    """The point half way along an edge."""
    if edge.center is None:
        return 0.5 * (edge.start[0] + edge.end[0]), 0.5 * (edge.start[1] + edge.end[1])
    return arcs.point_on_arc(edge.start, edge.end, edge.center, edge.ccw, 0.5)


def meetings(a: Edge, b: Edge) -> list[Point]:
    """Points that lie on both of two edges, as far as these are not parallel."""
    if a.center is None and b.center is None and a.end == b.start:
        return [a.end]
    return [
        point
        for point in offset.crossings(a, b, 0.0, 0.0)
        if distance.of_point(point, a) <= _JOINED_MM and distance.of_point(point, b) <= _JOINED_MM
    ]


def _without_tails(pieces: list[Edge]) -> list[Edge]:
    """Pieces that something goes on from and leads to: ends that are left over where ways part at a small angle go.

    Raises:
        RegionError: What leads nowhere is no such end.
    """
    while True:
        starts, ends = {_square(edge.start) for edge in pieces}, {_square(edge.end) for edge in pieces}
        goes_on = [_is_near(edge.end, starts) and _is_near(edge.start, ends) for edge in pieces]
        if all(goes_on):
            return pieces
        if any(
            edge.length > _LONGEST_TAIL_MM for edge, good in zip(pieces, goes_on, strict=True) if not good
        ):
            raise RegionError("open way")
        pieces = [edge for edge, good in zip(pieces, goes_on, strict=True) if good]


def _is_near(point: Point, squares: set[tuple[int, int]]) -> bool:
    u, v = _square(point)
    return any((u + du, v + dv) in squares for du in (-1, 0, 1) for dv in (-1, 0, 1))


def _chained(pieces: list[Edge]) -> list[Loop]:
    """Loops out of pieces, each going on with the one that begins nearest to where it ends."""
    left = dict(enumerate(pieces))
    begins: dict[tuple[int, int], list[int]] = {}
    for number, piece in left.items():
        begins.setdefault(_square(piece.start), []).append(number)
    result: list[Loop] = []
    while left:
        first = next(iter(left))
        loop = [left.pop(first)]
        while arcs.radius_of(loop[0].start, loop[-1].end) > 2.0 * _JOINED_MM:
            follower = _follower(loop[-1].end, left, begins)
            if follower is None:
                raise RegionError("open way")
            loop.append(left.pop(follower))
        result.append(loop)
    return [loop for loop in result if sum(edge.length for edge in loop) > 4.0 * _JOINED_MM]


def _square(point: Point) -> tuple[int, int]:
    return round(point[0] / _SQUARE_MM), round(point[1] / _SQUARE_MM)


def _follower(at: Point, left: dict[int, Edge], begins: dict[tuple[int, int], list[int]]) -> int | None:
    """The piece that begins at a point; None for none."""
    u, v = _square(at)
    best, least = None, 4.0 * _JOINED_MM
    for du in (-1, 0, 1):
        for dv in (-1, 0, 1):
            for number in begins.get((u + du, v + dv), ()):
                if number in left and arcs.radius_of(left[number].start, at) < least:
                    best, least = number, arcs.radius_of(left[number].start, at)
    return best


# ---- boxes


class _Nearby:
    """Edges by the squares of a grid that lie within a distance of them: most walls are far from most places.

    Args:
        edges: The walls.
        away: The distance, mm.
    """

    def __init__(self, edges: Sequence[Edge], away: float) -> None:
        self._size = max(2.0 * away, 1.0)
        self._cells: dict[tuple[int, int], list[tuple[Edge, Box]]] = {}
        for edge in edges:
            box = _box(edge, away)
            for cell in self._covered(box):
                self._cells.setdefault(cell, []).append((edge, box))

    def _covered(self, box: Box) -> Iterator[tuple[int, int]]:
        u0, v0, u1, v1 = (floor(value / self._size) for value in box)
        for u in range(u0, u1 + 1):
            for v in range(v0, v1 + 1):
                yield u, v

    def to(self, box: Box) -> Iterator[Edge]:
        """The edges whose boxes, widened by the distance, meet a box; some of them more than once."""
        for cell in self._covered(box):
            for edge, near in self._cells.get(cell, ()):
                if _overlap(near, box):
                    yield edge


def _box(edge: Edge, more: float) -> Box:
    """The rectangle round an edge, wider by a distance on all sides."""
    ends = [edge.start, edge.end]
    if edge.center is not None:
        u, v = edge.center
        r = arcs.radius_of(edge.center, edge.end)
        sides = ((u + r, v), (u, v + r), (u - r, v), (u, v - r))
        ends += [p for p in sides if arcs.contains_direction(edge.start, edge.end, edge.center, edge.ccw, p)]
    us, vs = [p[0] for p in ends], [p[1] for p in ends]
    return min(us) - more, min(vs) - more, max(us) + more, max(vs) + more


def _overlap(a: Box, b: Box) -> bool:
    return a[0] <= b[2] and b[0] <= a[2] and a[1] <= b[3] and b[1] <= a[3]


def bounds(loops: Iterable[Loop]) -> Box:
    """The rectangle round loops."""
    boxes = [_box(edge, 0.0) for loop in loops for edge in loop]
    return (
        min(box[0] for box in boxes),
        min(box[1] for box in boxes),
        max(box[2] for box in boxes),
        max(box[3] for box in boxes),
    )


def size(box: Box) -> float:
    """Length of the diagonal of a rectangle, mm."""
    return hypot(box[2] - box[0], box[3] - box[1])
