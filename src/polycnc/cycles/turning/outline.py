"""The outline of what a contour cycle turns: a contour led on to the edges of its blank, and limits of the work.

Coordinates are those of `contour`: `a` along the cuts, `b` in the direction of infeed. A contour says where the work
ends, its blank how far it reaches in front of it and above it.
"""

from __future__ import annotations

from itertools import pairwise

from polycnc.cycles.turning.contour import Piece, points, runs, slopes, swapped
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.cycles.turning.contour import Contour
    from polycnc.geometry.arcs import Point

_HAIR = 1e-7


def farthest(contour: Sequence[Piece], axis: int, direction: float) -> float:
    """The coordinate of a contour's point that lies farthest in a direction, 1 or -1, along one of its axes."""
    return direction * max(direction * point[axis] for piece in contour for point in points(piece.edge))


def from_front(contour: Contour, front: float) -> Contour:
    """A contour from the front of its blank on, along the cuts, to where it begins."""
    begin, end = contour[0].edge.start, contour[-1].edge.end
    onwards = 1.0 if end[0] >= begin[0] else -1.0
    if onwards * (begin[0] - front) <= NO_WAY:
        return list(contour)
    return [Piece(offset.line((front, begin[1]), begin)), *contour]


def walled(contour: Contour, wall: float, top: float, towards: float) -> Contour:
    """A contour up to a wall along the cuts, and straight up from there to the top of its blank.

    One that ends in front of the wall goes on to it, unless it ends with a wall of its own.
    """
    onwards = 1.0 if contour[-1].edge.end[0] >= contour[0].edge.start[0] else -1.0
    result = not_beyond(contour, wall, onwards) or list(contour[:1])
    end = result[-1].edge
    corners = [end.end]
    if onwards * (wall - end.end[0]) > NO_WAY and abs(end.arriving[0]) > _HAIR:
        corners.append((wall, end.end[1]))
    if towards * (end.end[1] - top) > NO_WAY:
        corners.append((corners[-1][0], top))
    return result + [Piece(offset.line(p, q)) for p, q in pairwise(corners)]


def without_reliefs(contour: Contour, towards: float) -> Contour:
    """A contour that is led straight along the cuts from every summit to where it rises above that, or to its end."""
    result: Contour = []
    summit: Point | None = None
    for piece in slopes(contour):
        edge = piece.edge
        if summit is None:
            if towards * (edge.end[1] - edge.start[1]) > NO_WAY:
                summit = edge.start
            else:
                result.append(piece)
            continue
        risen = next((run for is_deep, run in runs([piece], summit[1], towards) if not is_deep), None)
        if risen is not None:
            result += _led(summit, (risen[0].edge.start[0], summit[1]))
            result += risen
            summit = None
    if summit is not None:
        result += _led(summit, (contour[-1].edge.end[0], summit[1]))
    return result


def _led(start: Point, end: Point) -> Contour:
    return [Piece(offset.line(start, end))] if abs(end[0] - start[0]) > NO_WAY else []


def not_deeper(contour: Contour, level: float, towards: float) -> Contour:
    """A contour whose parts below a level are led along it."""
    result: Contour = []
    for is_deep, run in runs(contour, level, towards):
        if not is_deep:
            result += run
            continue
        begin, end = run[0].edge.start[0], run[-1].edge.end[0]
        if abs(end - begin) > NO_WAY:
            result.append(Piece(offset.line((begin, level), (end, level))))
    return result


def not_beyond(contour: Contour, limit: float, onwards: float) -> Contour:
    """What of a contour lies in front of a limit along `a`, up to where it first passes it."""
    result: Contour = []
    for is_beyond, run in runs(swapped(contour), limit, onwards):
        if is_beyond:
            break
        result += swapped(run)
    return result
