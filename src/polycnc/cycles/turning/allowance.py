"""A contour with stock left on it along both axes, for roughing.

The stock is what the material sweeps when it is moved by the allowances. A wall that looks the way of the move is moved
with it; one that looks the other way, as the near wall of a relief does, stays where it is, for the moved one would lie
inside of the material.
"""

from __future__ import annotations

from math import copysign, hypot

from polycnc.cycles.turning.contour import Contour, Piece, shifted, slopes
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, offset
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge

_ROUNDING = 1e-9


def with_stock(contour: Sequence[Piece], way: Point, towards: float) -> Contour:
    """The contour of the material when it is swept by a way.

    Args:
        contour: In its own direction.
        way: Along both coordinates, mm.
        towards: Direction of infeed, 1 or -1: the material lies that way.

    Raises:
        ValueError: Nothing is left between two walls.
    """
    if hypot(*way) <= NO_WAY:
        return list(contour)
    onwards = copysign(1.0, contour[-1].edge.end[0] - contour[0].edge.start[0])
    outside = -onwards * towards  # 1: the tool is on the left
    parts = [part for piece in slopes(contour) for part in _split(piece, way)]
    looks = [_looks_along(part.edge, way, outside) for part in parts]
    if all(looks):
        return shifted(contour, *way)
    moved = [shifted([part], *way)[0] if look else part for part, look in zip(parts, looks, strict=True)]
    result = _joined(moved, outside)
    # At the end that the stock is moved away from, what stays begins under the stock on the front.
    begin, end = contour[0].edge.start, contour[-1].edge.end
    if way[0] * (begin[0] - end[0]) > 0.0 and not looks[0]:
        return [Piece(offset.line(_plus(begin, way), begin)), *result]
    if way[0] * (end[0] - begin[0]) > 0.0 and not looks[-1]:
        return [*result, Piece(offset.line(end, _plus(end, way)))]
    return result


def _plus(point: Point, way: Point) -> Point:
    return point[0] + way[0], point[1] + way[1]


def _split(piece: Piece, way: Point) -> list[Piece]:
    """The parts of an arc on both sides of where it runs along the way."""
    edge = piece.edge
    if edge.center is None:
        return [piece]
    radius, length = arcs.radius_of(edge.center, edge.end), hypot(*way)
    across = (-way[1] / length * radius, way[0] / length * radius)
    for sign in (1.0, -1.0):
        point = (edge.center[0] + sign * across[0], edge.center[1] + sign * across[1])
        is_within = arcs.contains_direction(edge.start, edge.end, edge.center, edge.ccw, point)
        if is_within and min(_apart(point, edge.start), _apart(point, edge.end)) > NO_WAY:
            return [
                Piece(offset.arc(start, end, edge.center, edge.ccw), piece.is_rapid)
                for start, end in ((edge.start, point), (point, edge.end))
            ]
    return [piece]


def _apart(a: Point, b: Point) -> float:
    return hypot(b[0] - a[0], b[1] - a[1])


def _looks_along(edge: Edge, way: Point, outside: float) -> bool:
    """Whether the outside of an edge looks the way of a move, or the edge runs along it."""
    u, v = edge.departing
    if edge.center is not None:
        middle = arcs.point_on_arc(edge.start, edge.end, edge.center, edge.ccw, 0.5)
        u, v = arcs.tangent_at(edge.center, middle, edge.ccw)
    return outside * (u * way[1] - v * way[0]) >= -_ROUNDING


def _joined(pieces: list[Piece], outside: float) -> Contour:
    """Pieces that meet, or are apart at corners: outer ones are joined, at inner ones they are cut where they cross."""
    result: Contour = []
    is_apart = False
    for piece in pieces:
        if not result:
            result.append(piece)
            continue
        last, edge = result[-1].edge, piece.edge
        if not is_apart and _apart(last.end, edge.start) <= NO_WAY:
            result.append(piece)
            continue
        if not is_apart and _is_outer(last, edge, outside):
            result += [Piece(offset.line(last.end, edge.start), piece.is_rapid), piece]
            continue
        is_apart = not _cut(result, piece)
    if is_apart:
        raise ValueError("no room")
    return result


def _is_outer(last: Edge, edge: Edge, outside: float) -> bool:
    """Whether the contour turns away from its outside between two edges; where it goes straight on, the gap tells."""
    (u, v), (nu, nv) = last.arriving, edge.departing
    turn = outside * (u * nv - v * nu)
    if abs(turn) > _ROUNDING:
        return turn < 0.0
    return (edge.start[0] - last.end[0]) * u + (edge.start[1] - last.end[1]) * v > 0.0


def _cut(result: Contour, piece: Piece) -> bool:
    """Go on with a piece where it crosses what there is; whether it does."""
    for number in range(len(result) - 1, -1, -1):
        before = result[number]
        met = [
            p
            for p in offset.crossings(before.edge, piece.edge, 0.0, 0.0)
            if _is_on(before.edge, p) and _is_on(piece.edge, p)
        ]
        if met:
            # The first crossing on the new piece leaves most of it.
            point = min(met, key=lambda p: _apart(p, piece.edge.start))
            result[number:] = [
                Piece(_between(before.edge, before.edge.start, point), before.is_rapid),
                Piece(_between(piece.edge, point, piece.edge.end), piece.is_rapid),
            ]
            result[:] = [each for each in result if each.edge.length > NO_WAY]
            return True
    return False


def _is_on(edge: Edge, point: Point) -> bool:
    """Whether a point of the edge's curve lies between its ends."""
    if edge.center is not None:
        return arcs.contains_direction(edge.start, edge.end, edge.center, edge.ccw, point, _ROUNDING)
    u, v = edge.departing
    along = (point[0] - edge.start[0]) * u + (point[1] - edge.start[1]) * v
    return -NO_WAY <= along <= edge.length + NO_WAY


def _between(edge: Edge, start: Point, end: Point) -> Edge:
    if edge.center is None or _apart(start, end) <= NO_WAY:
        return offset.line(start, end)
    return offset.arc(start, end, edge.center, edge.ccw)
