"""A and C splines through points, as polynomials of degree three (job planning 4.2, for curve tables 9.2.1).

The ends are as BNAT, BTAN, BAUTO and ENAT, ETAN, EAUTO say.
"""

from __future__ import annotations

from itertools import pairwise
from math import dist

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.polynomials import trimmed
from polycnc.geometry.through_points import End, akima_tangents, cubic_tangents, lengths

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.geometry.polynomials import Coefficients

Point = tuple[float, float]
#: Ends of a spline: without bend; along the way before or behind; the first (last) two pieces are one cubic.
NATURAL, TANGENT, AUTOMATIC = "NAT", "TAN", "AUTO"
_ENDS = {NATURAL: End.STRAIGHT, TANGENT: End.STRAIGHT, AUTOMATIC: End.FREE}


def curve(
    points: Sequence[Point],
    *,
    akima: bool,
    begin: str = NATURAL,
    end: str = NATURAL,
    before: Point | None = None,
    behind: Point | None = None,
) -> list[tuple[Coefficients, Coefficients]]:
    """The pieces from point to point: for both coordinates a polynomial of a parameter from 0 to 1.

    Args:
        points: At least two, each away from the one before.
        akima: An A spline, not a C spline.
        begin: How the spline begins: NATURAL, TANGENT, AUTOMATIC.
        end: How it ends.
        before: The point before the spline, for TANGENT; without it a tangent end is a natural one.
        behind: The one behind it.
    """
    starts = _tangent(before, points[0]) if begin == TANGENT else None
    ends = _tangent(points[-1], behind) if end == TANGENT else None
    make = akima_tangents if akima else cubic_tangents
    tangents = make(points, starts or _ENDS[begin], ends or _ENDS[end])
    pieces = zip(pairwise(points), pairwise(tangents), lengths(points), strict=True)
    return [
        (
            _cubic(a[0], b[0], s[0] * width, t[0] * width),
            _cubic(a[1], b[1], s[1] * width, t[1] * width),
        )
        for (a, b), (s, t), width in pieces
    ]


def _tangent(start: Point | None, end: Point | None) -> Point | None:
    """The direction of a way; None for none."""
    if start is None or end is None or start == end:
        return None
    return (end[0] - start[0]) / dist(start, end), (end[1] - start[1]) / dist(start, end)


def _cubic(start: float, end: float, leaving: float, arriving: float) -> Coefficients:
    rise = end - start
    return trimmed((start, leaving, 3.0 * rise - 2.0 * leaving - arriving, leaving + arriving - 2.0 * rise))
