"""Where a moving outline first runs into a region of the plane: protection zones.

Outlines are polygons whose last point is the first again; arcs have been cut into chords. What is protected lies to the
left of a region's outline, so a clockwise outline protects everything outside it. A moving outline is convex and runs
counter-clockwise; a single point stands for a tool without extent. Lengths are in millimetres, parts of a way run from
0 to 1 and beyond.
"""

from __future__ import annotations

from itertools import pairwise

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.geometry.arcs import Point

#: Outlines that overlap by less than this, mm, only touch.
TOUCH_MM = 1e-6
#: How far beyond a contact it is looked whether the outlines really overlap, mm.
PROBE_MM = 1e-4


def area(outline: Sequence[Point]) -> float:
    """Signed area of a closed outline: positive counter-clockwise."""
    return 0.5 * sum(a[0] * b[1] - b[0] * a[1] for a, b in pairwise(outline))


def is_convex(outline: Sequence[Point]) -> bool:
    """Whether a counter-clockwise outline never turns right."""
    around = [*outline, outline[1]]
    return all(_cross(a, b, c) >= -TOUCH_MM for a, b, c in zip(around, around[1:], around[2:], strict=False))


def moved(outline: Sequence[Point], by: Point) -> list[Point]:
    """An outline shifted."""
    return [(u + by[0], v + by[1]) for u, v in outline]


def grown(outline: Sequence[Point], by: float) -> list[Point]:
    """The smallest convex outline around squares at all points of a convex one, which reach so far to either side."""
    if by == 0.0:
        return list(outline)
    corners = sorted({(u + a, v + b) for u, v in outline for a in (-by, by) for b in (-by, by)})
    lower, upper = _chain(corners), _chain(corners[::-1])
    return [*lower[:-1], *upper]


def _chain(points: Sequence[Point]) -> list[Point]:
    """Of points in the order of one coordinate those at which their convex hull turns left (A. M. Andrew, 1979)."""
    hull: list[Point] = []
    for point in points:
        while len(hull) > 1 and _cross(hull[-2], hull[-1], point) <= 0.0:
            hull.pop()
        hull.append(point)
    return hull


def overlaps(moving: Sequence[Point], region: Sequence[Point]) -> bool:
    """Whether a convex outline (or a single point) and the protected side of a region share more than a border."""
    inner = _shrunk(moving)
    if any(_is_protected(point, region) for point in inner):
        return True
    if len(inner) < 2:
        return False
    if any(_cut(a, b, c, d) for a, b in pairwise(inner) for c, d in pairwise(region)):
        return True
    return area(region) > 0.0 and any(_is_left_of_all(point, inner) for point in region)


def first_contact(moving: Sequence[Point], region: Sequence[Point], way: Point) -> float | None:
    """The part of a straight way at which an outline begins to overlap a region; None if it never does.

    The way is a vector; contacts behind its end count as well (parts above 1). An outline that overlaps from the start
    has its contact at 0.
    """
    if overlaps(moving, region):
        return 0.0
    length: float = (way[0] ** 2 + way[1] ** 2) ** 0.5
    if length < TOUCH_MM:
        return None
    step = PROBE_MM / length
    for part in sorted(set(_entries(moving, region, way))):
        beyond = part + step
        if overlaps(moved(moving, (way[0] * beyond, way[1] * beyond)), region):
            return part
    return None


def _entries(moving: Sequence[Point], region: Sequence[Point], way: Point) -> Iterator[float]:
    """Parts of the way at which a corner of one outline passes an edge of the other one inwards."""
    back = -way[0], -way[1]
    for a, b in pairwise(region):
        if _faces(way, a, b):
            for corner in moving:
                yield from _hit(corner, way, a, b)
    for a, b in pairwise(moving):
        if _faces(back, a, b):
            for corner in region:
                yield from _hit(corner, back, a, b)


def _faces(way: Point, a: Point, b: Point) -> bool:
    """Whether a way leads from the right of an edge to its left."""
    return (b[0] - a[0]) * way[1] - (b[1] - a[1]) * way[0] > 1e-12


def _hit(point: Point, way: Point, a: Point, b: Point) -> Iterator[float]:
    """The part of a way at which a point comes to an edge, if it does."""
    edge = b[0] - a[0], b[1] - a[1]
    from_point = a[0] - point[0], a[1] - point[1]
    denominator = way[0] * edge[1] - way[1] * edge[0]
    part = (from_point[0] * edge[1] - from_point[1] * edge[0]) / denominator
    place = (from_point[0] * way[1] - from_point[1] * way[0]) / denominator
    if part >= -1e-12 and -1e-12 <= place <= 1.0 + 1e-12:
        yield max(part, 0.0)


def _shrunk(outline: Sequence[Point]) -> list[Point]:
    """A convex outline a little smaller, so that borders do not count."""
    if len(outline) < 2:
        return list(outline)
    count = len(outline) - 1
    u, v = (sum(point[i] for point in outline[:-1]) / count for i in (0, 1))
    reach = max(abs(p[0] - u) + abs(p[1] - v) for p in outline) or 1.0
    factor = 1.0 - min(TOUCH_MM / reach, 0.5)
    return [(u + (p[0] - u) * factor, v + (p[1] - v) * factor) for p in outline]


def _is_protected(point: Point, region: Sequence[Point]) -> bool:
    """Whether a point lies on the protected side, farther from the border than a touch."""
    u, v = point
    inside = False
    for (a, b), (c, d) in pairwise(region):
        if _distance(point, (a, b), (c, d)) < 0.1 * TOUCH_MM:
            return False
        if (b > v) != (d > v) and u < a + (v - b) / (d - b) * (c - a):
            inside = not inside
    return inside is (area(region) > 0.0)


def _distance(point: Point, a: Point, b: Point) -> float:
    edge = b[0] - a[0], b[1] - a[1]
    square = edge[0] ** 2 + edge[1] ** 2
    along = ((point[0] - a[0]) * edge[0] + (point[1] - a[1]) * edge[1]) / square if square else 0.0
    along = min(max(along, 0.0), 1.0)
    return float(((point[0] - a[0] - along * edge[0]) ** 2 + (point[1] - a[1] - along * edge[1]) ** 2) ** 0.5)


def _is_left_of_all(point: Point, outline: Sequence[Point]) -> bool:
    return all(_cross(a, b, point) > 0.0 for a, b in pairwise(outline))


def _cut(a: Point, b: Point, c: Point, d: Point) -> bool:
    """Whether two edges cross, not merely touch."""
    return (_cross(a, b, c) > 0.0) != (_cross(a, b, d) > 0.0) and (_cross(c, d, a) > 0.0) != (
        _cross(c, d, b) > 0.0
    )


def _cross(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
