"""Curves through points: cubic splines and Akima splines, by the tangents in their points.

The parameter is the length of the chords. A segment between two points is the cubic that has the tangents of both.

Sources: de Boor, A Practical Guide to Splines, 1978, chapter IV (cubic interpolation, not-a-knot); Akima, A new method
of interpolation and smooth curve fitting, J. ACM 17 (1970).
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from itertools import pairwise
from math import hypot

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

Point = Sequence[float]
#: A chord is no shorter than this, so that slopes stay numbers.
_LEAST = 1e-6


#: Radians by which the curve turns along a chord at most, within the curve and where one rests.
_MOST_TURN, _MOST_TURN_AT_REST = 0.02, 0.004
#: The shortest part of a segment that a chord stands for.
_SHORTEST_PART = 1.0 / 4096.0


class End(StrEnum):
    """What holds at an end of a curve where no tangent is given."""

    FREE = "free"
    """Cubic: its first two segments are one; Akima: slopes go on as they change."""
    STRAIGHT = "straight"
    """No curvature."""


def lengths(points: Sequence[Point]) -> list[float]:
    """Lengths of the chords, mm, none below a nanometre or so."""
    return [max(hypot(*(b - a for a, b in zip(*pair, strict=True))), _LEAST) for pair in pairwise(points)]


def cubic_tangents(points: Sequence[Point], start: Point | End, end: Point | End) -> list[list[float]]:
    """Tangents of the cubic spline whose curvature is continuous, by the length of chords.

    Args:
        points: At least two.
        start: Tangent at the first point, or what holds there.
        end: The same of the last one.
    """
    h = lengths(points)
    slopes = _slopes(points, h)
    count = len(points)
    below, diagonal, above = [0.0] * count, [1.0] * count, [0.0] * count
    right: list[list[float]] = [[] for _ in points]
    for i in range(1, count - 1):
        below[i], diagonal[i], above[i] = h[i], 2.0 * (h[i - 1] + h[i]), h[i - 1]
        right[i] = _sum(slopes[i - 1], 3.0 * h[i], slopes[i], 3.0 * h[i - 1])
    diagonal[0], above[0], right[0] = _end_row(start, h[:2], slopes[:2], count)
    diagonal[-1], below[-1], right[-1] = _end_row(end, h[:-3:-1], slopes[:-3:-1], count)
    return _solve(below, diagonal, above, right)


def _end_row(
    condition: Point | End, h: Sequence[float], slopes: Sequence[Point], count: int
) -> tuple[float, float, list[float]]:
    """The equation of an end: factors of its tangent and of the next one, and the right side."""
    if not isinstance(condition, End):
        return 1.0, 0.0, list(condition)
    if condition is End.STRAIGHT or count < 4:
        return 2.0, 1.0, [3.0 * s for s in slopes[0]]
    both = h[0] + h[1]
    right = _sum(slopes[0], (h[0] + 2.0 * both) * h[1] / both, slopes[1], h[0] * h[0] / both)
    return h[1], both, right


def _solve(
    below: list[float], diagonal: list[float], above: list[float], right: list[list[float]]
) -> list[list[float]]:
    """Solve a system of three diagonals."""
    count = len(diagonal)
    for i in range(1, count):
        factor = below[i] / diagonal[i - 1]
        diagonal[i] -= factor * above[i - 1]
        right[i] = _sum(right[i], 1.0, right[i - 1], -factor)
    found = [[0.0]] * count
    found[-1] = [r / diagonal[-1] for r in right[-1]]
    for i in range(count - 2, -1, -1):
        found[i] = [(r - above[i] * n) / diagonal[i] for r, n in zip(right[i], found[i + 1], strict=True)]
    return found


def akima_tangents(points: Sequence[Point], start: Point | End, end: Point | End) -> list[list[float]]:
    """Tangents of an Akima spline: each depends on two chords to either side. Arguments as of `cubic_tangents`."""
    slopes = _slopes(points, lengths(points))
    first, last = slopes[0], slopes[-1]
    second, before_last = (slopes[1], slopes[-2]) if len(slopes) > 1 else (first, last)
    front = [_sum(first, 3.0, second, -2.0), _sum(first, 2.0, second, -1.0)]
    back = [_sum(last, 2.0, before_last, -1.0), _sum(last, 3.0, before_last, -2.0)]
    all_slopes = [*front, *slopes, *back]
    tangents = [_akima(*all_slopes[i : i + 4]) for i in range(len(points))]
    for at, beside, slope, condition in ((0, 1, first, start), (-1, -2, last, end)):
        if not isinstance(condition, End):
            tangents[at] = list(condition)
        elif condition is End.STRAIGHT:
            tangents[at] = _sum(slope, 1.5, tangents[beside], -0.5)
    return tangents


def _akima(*slopes: Point) -> list[float]:
    """The tangent between the second and the third of four chords, axis by axis."""
    return [_akima_slope(*of_axis) for of_axis in zip(*slopes, strict=True)]


def _akima_slope(a: float, b: float, c: float, d: float) -> float:
    after, before = abs(d - c), abs(b - a)
    if after + before > 1e-12 * max(map(abs, (a, b, c, d))):
        return (after * b + before * c) / (after + before)
    return 0.5 * (b + c)


def chords(
    start: Point,
    end: Point,
    at_start: Point,
    at_end: Point,
    tolerance: float,
    *,
    rests: tuple[bool, bool] = (True, True),
) -> Iterator[tuple[float, list[float]]]:
    """Points of a segment behind its start, so close that their chords stay near it; the last is the end.

    Each comes with its parameter, 0 to 1. A chord leaves the curve by the tolerance at most, and turns by few degrees,
    so that who derives directions and curvature from chords finds those of the curve.

    Args:
        start: Where it begins.
        end: Where it ends.
        at_start: Its tangent there, by the length of the chord.
        at_end: The same at the end.
        tolerance: mm.
        rests: Whether who goes along it rests at its start and its end: the direction there is that of the chord alone,
            which turns less.
    """
    (length,) = lengths((start, end))
    cubic = _Cubic(
        start, [b - a for a, b in zip(start, end, strict=True)],
        [t * length for t in at_start], [t * length for t in at_end],
    )  # fmt: skip
    open_parts = [(0.0, 1.0)]
    while open_parts:
        low, high = open_parts.pop()
        rested = (rests[0] and low == 0.0) or (rests[1] and high == 1.0)
        turn = _MOST_TURN_AT_REST if rested else _MOST_TURN
        if high - low > _SHORTEST_PART and not cubic.is_nearly_straight(low, high, tolerance, turn):
            middle = 0.5 * (low + high)
            open_parts += [(middle, high), (low, middle)]
        elif high < 1.0:
            yield high, cubic.at(high)
    yield 1.0, list(end)


class _Cubic(NamedTuple):
    """A segment: where it begins, its way, and its derivatives at both ends by the parameter."""

    start: Point
    way: Point
    leaving: Point
    arriving: Point

    def at(self, u: float) -> list[float]:
        """The point at a parameter."""
        along, a, b = u * u * (3.0 - 2.0 * u), u * (1.0 - u) ** 2, u * u * (u - 1.0)
        return [p + along * w + a * s + b * e for p, w, s, e in zip(*self, strict=True)]

    def slope(self, u: float) -> list[float]:
        """The derivative there."""
        along, a, b = 6.0 * u * (1.0 - u), (1.0 - u) * (1.0 - 3.0 * u), u * (3.0 * u - 2.0)
        return [along * w + a * s + b * e for _, w, s, e in zip(*self, strict=True)]

    def bend(self, u: float) -> list[float]:
        """The second derivative there."""
        along, a, b = 6.0 - 12.0 * u, 6.0 * u - 4.0, 6.0 * u - 2.0
        return [along * w + a * s + b * e for _, w, s, e in zip(*self, strict=True)]

    def is_nearly_straight(self, low: float, high: float, tolerance: float, turn: float) -> bool:
        """Whether one chord stands for a part."""
        bend = max(hypot(*self.bend(low)), hypot(*self.bend(high)))
        if bend * (high - low) ** 2 > 8.0 * tolerance:
            return False
        before, after = self.slope(low), self.slope(high)
        sizes = hypot(*before) or _LEAST, hypot(*after) or _LEAST
        return hypot(*(a / sizes[0] - b / sizes[1] for a, b in zip(before, after, strict=True))) <= turn


def _slopes(points: Sequence[Point], h: Sequence[float]) -> list[list[float]]:
    return [
        [(b - a) / length for a, b in zip(*pair, strict=True)]
        for pair, length in zip(pairwise(points), h, strict=True)
    ]


def _sum(a: Point, of_a: float, b: Point, of_b: float) -> list[float]:
    return [of_a * x + of_b * y for x, y in zip(a, b, strict=True)]
