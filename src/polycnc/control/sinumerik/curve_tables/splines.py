"""A and C splines through points, as polynomials of degree three (job planning 4.2, for curve tables 9.2.1).

The parameter is the length of the chords. The A spline bends near a point that moves and nowhere else (Akima); the
C spline turns and bends without a jump, and its ends are as BNAT, BTAN, BAUTO and ENAT, ETAN, EAUTO say.
"""

from __future__ import annotations

from itertools import pairwise
from math import dist
from typing import TYPE_CHECKING

from polycnc.geometry.polynomials import trimmed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.geometry.polynomials import Coefficients

Point = tuple[float, float]
#: Ends of a C spline: without bend; along the way before or behind; the first (last) two pieces are one cubic.
NATURAL, TANGENT, AUTOMATIC = "NAT", "TAN", "AUTO"


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
        begin: How a C spline begins: NATURAL, TANGENT, AUTOMATIC.
        end: How it ends.
        before: The point before the spline, for TANGENT.
        behind: The one behind it.
    """
    widths = [dist(a, b) for a, b in pairwise(points)]
    columns = []
    for axis in (0, 1):
        values = [point[axis] for point in points]
        rises = [(b - a) / width for (a, b), width in zip(pairwise(values), widths, strict=True)]
        if akima:
            slopes = _akima(rises)
        else:
            first = None if before is None else (points[0][axis] - before[axis]) / dist(before, points[0])
            last = None if behind is None else (behind[axis] - points[-1][axis]) / dist(points[-1], behind)
            slopes = _smooth(widths, rises, begin, end, first, last)
        columns.append([
            _cubic(values[k], values[k + 1], slopes[k] * width, slopes[k + 1] * width)
            for k, width in enumerate(widths)
        ])  # fmt: skip
    return list(zip(*columns, strict=True))


def _cubic(start: float, end: float, leaving: float, arriving: float) -> Coefficients:
    rise = end - start
    return trimmed((start, leaving, 3.0 * rise - 2.0 * leaving - arriving, leaving + arriving - 2.0 * rise))


def _akima(rises: Sequence[float]) -> list[float]:
    """Slopes at the points by the rises of the two chords on both sides; beyond the ends chords go on evenly."""
    if len(rises) == 1:
        return [rises[0], rises[0]]
    first, last = rises[0] - rises[1], rises[-1] - rises[-2]
    m = [rises[0] + 2 * first, rises[0] + first, *rises, rises[-1] + last, rises[-1] + 2 * last]
    slopes = []
    for k in range(len(rises) + 1):
        left, right = abs(m[k + 3] - m[k + 2]), abs(m[k + 1] - m[k])
        total = left + right
        near = max(map(abs, m[k : k + 4]))
        slopes.append(
            (left * m[k + 1] + right * m[k + 2]) / total
            if total > 1e-12 * near
            else 0.5 * (m[k + 1] + m[k + 2])
        )
    return slopes


def _smooth(
    widths: Sequence[float],
    rises: Sequence[float],
    begin: str,
    end: str,
    first: float | None,
    last: float | None,
) -> list[float]:
    """Slopes at the points of a spline without a jump of its bend: three diagonals, solved from the top."""
    count = len(widths) + 1
    rows = [_end_row(widths, rises, begin, first)]
    for k in range(1, count - 1):
        a, b = 1.0 / widths[k - 1], 1.0 / widths[k]
        rows.append((a, 2.0 * (a + b), b, 3.0 * (rises[k - 1] * a + rises[k] * b)))
    lower = _end_row(widths[::-1], rises[::-1], end, last)
    rows.append((lower[2], lower[1], 0.0, lower[3]))
    above: list[tuple[float, float]] = []
    for low, middle, high, right in rows:
        share, carried = above[-1] if above else (0.0, 0.0)
        pivot = middle - low * share
        above.append((high / pivot, (right - low * carried) / pivot))
    slopes = [0.0] * count
    for k in range(count - 1, -1, -1):
        share, value = above[k]
        slopes[k] = value - share * (slopes[k + 1] if k + 1 < count else 0.0)
    return slopes


def _end_row(
    widths: Sequence[float], rises: Sequence[float], kind: str, slope: float | None
) -> tuple[float, float, float, float]:
    """The equation at an end, its own slope in the middle and that of the next point above."""
    if kind == TANGENT and slope is not None:
        return 0.0, 1.0, 0.0, slope
    if kind == AUTOMATIC and len(widths) > 1:
        # The first two pieces are one cubic: its third derivative does not jump (elimination of the third slope).
        a, b = widths[0], widths[1]
        right = ((3.0 * a * b + 2.0 * b * b) * rises[0] + a * a * rises[1]) / (a + b)
        return 0.0, b, a + b, right
    return 0.0, 2.0, 1.0, 3.0 * rises[0]
