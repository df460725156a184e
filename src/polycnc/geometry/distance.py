"""How near lines and arcs of a plane come to each other."""

from __future__ import annotations

from math import hypot

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, offset
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge

#: An arc reaches this much (radians) beyond its ends, so that rounding opens no gap between two edges.
_SLACK = 1e-9
#: A point this near to an edge lies on it.
_ON_MM = 1e-7


def of_point(point: Point, edge: Edge) -> float:
    """Distance (mm) of a point from a line or an arc with ends."""
    if edge.center is None:
        return arcs.radius_of(point, _foot(point, edge))
    ends = min(arcs.radius_of(point, edge.start), arcs.radius_of(point, edge.end))
    if not arcs.contains_direction(edge.start, edge.end, edge.center, edge.ccw, point, _SLACK):
        return ends
    return min(ends, abs(arcs.radius_of(edge.center, point) - arcs.radius_of(edge.center, edge.end)))


def nearest_point(point: Point, edge: Edge) -> Point:
    """The point of a line or an arc with ends that is nearest to a point; of an arc about the point its start."""
    if edge.center is None:
        return _foot(point, edge)
    away = arcs.radius_of(edge.center, point)
    if away > NO_WAY and arcs.contains_direction(edge.start, edge.end, edge.center, edge.ccw, point, _SLACK):
        reach = arcs.radius_of(edge.center, edge.end) / away
        du, dv = arcs.minus(point, edge.center)
        return edge.center[0] + reach * du, edge.center[1] + reach * dv
    return min(edge.start, edge.end, key=lambda end: arcs.radius_of(end, point))


def between(a: Edge, b: Edge) -> float:
    """Smallest distance (mm) of two lines or arcs with ends; 0 where they touch or cross.

    It lies at an end of one of them, where they cross, or on the line through the centre of an arc that is square on
    the other edge.
    """
    found = [of_point(a.start, b), of_point(a.end, b), of_point(b.start, a), of_point(b.end, a)]
    candidates = [*offset.crossings(a, b, 0.0, 0.0), *_square_on(a, b), *_square_on(b, a)]
    for point in candidates:
        nearer, farther = sorted((of_point(point, a), of_point(point, b)))
        if nearer <= _ON_MM:
            found.append(farther)
    return min(found)


def _square_on(a: Edge, b: Edge) -> list[Point]:
    """Points of `a` whose perpendicular passes through the centre of `b`."""
    if b.center is None:
        return []
    if a.center is None:
        return [_foot(b.center, a)]
    du, dv = arcs.minus(b.center, a.center)
    way = hypot(du, dv)
    if way <= NO_WAY:
        return []
    reach = arcs.radius_of(a.center, a.end) / way
    return [(a.center[0] + sign * reach * du, a.center[1] + sign * reach * dv) for sign in (1.0, -1.0)]


def _foot(point: Point, edge: Edge) -> Point:
    """The point of a straight edge that is nearest to a point."""
    du, dv = arcs.minus(edge.end, edge.start)
    square = du * du + dv * dv
    if square == 0.0:
        return edge.start
    u, v = arcs.minus(point, edge.start)
    part = min(max((u * du + v * dv) / square, 0.0), 1.0)
    return (edge.start[0] + part * du, edge.start[1] + part * dv)
