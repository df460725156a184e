"""Points on rational B-splines (Piegl, Tiller: The NURBS Book, 3.1 and 4.2).

A curve of order p (degree p - 1) with n poles has n + p knots that never fall. A pole is a point of any dimension
with a weight.
"""

from __future__ import annotations

from bisect import bisect_right
from math import sqrt

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

Pole = tuple[float, ...]
#: Chords of a knot span at most.
MAX_CHORDS = 1024


def nurbs_point(
    u: float, order: int, knots: Sequence[float], poles: Sequence[Pole], weights: Sequence[float]
) -> Pole:
    """The point at a parameter, by de Boor's algorithm on weighted poles.

    Args:
        u: Parameter within `knots[order - 1] … knots[-order]`.
        order: Degree + 1.
        knots: As many as poles and order together, not falling.
        poles: Points, all of one dimension.
        weights: One for each pole, positive.
    """
    degree = order - 1
    span = min(max(bisect_right(knots, u) - 1, degree), len(poles) - 1)
    while span > degree and knots[span] == knots[span + 1]:
        span -= 1
    points = [
        [weights[i] * value for value in poles[i]] + [weights[i]] for i in range(span - degree, span + 1)
    ]
    for level in range(1, order):
        for j in range(degree, level - 1, -1):
            left = knots[span - degree + j]
            width = knots[span + 1 + j - level] - left
            part = (u - left) / width if width > 0.0 else 0.0
            points[j] = [(1.0 - part) * a + part * b for a, b in zip(points[j - 1], points[j], strict=True)]
    *point, weight = points[degree]
    return tuple(value / weight for value in point)


def nurbs_chords(
    order: int, knots: Sequence[float], poles: Sequence[Pole], weights: Sequence[float], tolerance: float
) -> Iterator[Pole]:
    """Points along the curve, its first one included, so close that the curve stays within `tolerance` of the chords.

    Each knot span is halved until the curve half-way along every chord lies on it; so the middle of a span of a bent
    curve is always a point.
    """
    degree = order - 1

    def at(u: float) -> Pole:
        return nurbs_point(u, order, knots, poles, weights)

    yield at(knots[degree])
    for i in range(degree, len(poles)):
        low, width = knots[i], knots[i + 1] - knots[i]
        if width <= 0.0:
            continue
        chords = 1 if degree == 1 else 2
        # Points of the chords, and between each two the curve half-way.
        points = [at(low + width * k / (2 * chords)) for k in range(2 * chords + 1)]
        while chords < MAX_CHORDS and degree > 1 and _deviation(points) > tolerance:
            chords *= 2
            points = [at(low + width * k / (2 * chords)) for k in range(2 * chords + 1)]
        yield from points[2::2]


def _deviation(points: Sequence[Pole]) -> float:
    """Greatest distance of the odd points from the middle of their neighbours."""
    triples = zip(points[:-2:2], points[1:-1:2], points[2::2], strict=True)
    return max(
        sqrt(sum((half - 0.5 * (a + b)) ** 2 for a, half, b in zip(*triple, strict=True)))
        for triple in triples
    )
