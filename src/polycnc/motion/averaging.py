"""Limited jerk by averages: from the motion of the interpolator to that of the axes.

The way of the interpolator is averaged over a window (`law.py`). The positions that this average leads to are averaged
twice more, which is once under a tent; the second derivative of that is a plain second difference of positions
(`kernels/jerk.py` says what the averages are for and how long they are).

Between the edges, where a phase or a piece of the path begins, positions are polynomials in time, whose average under
the tent Gauss' rule gives exactly: so positions are the integral of the velocity, and that of the acceleration. What
takes a number also takes an array: the main run follows moment by moment, sampling asks for many at once (`tents.py`).
"""

from __future__ import annotations

from itertools import pairwise

from polycnc.deferred.typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    import numpy as np
    from numpy.typing import NDArray

#: A number, or one for each of many times.
Value = TypeVar("Value", float, "NDArray[np.float64]")

#: Places (-1 to 1) and weights of Gauss' rule with six places, exact up to degree 11: the way is cubic in time, a curve
#: cubic in the way, and the tent linear.
GAUSS = (
    (-0.932469514203152, 0.171324492379170),
    (-0.661209386466265, 0.360761573048139),
    (-0.238619186083197, 0.467913934572691),
    (0.238619186083197, 0.467913934572691),
    (0.661209386466265, 0.360761573048139),
    (0.932469514203152, 0.171324492379170),
)


def way_after(seconds: Value, speed: Value, pull: Value, jerk: Value | float = 0.0) -> Value:
    """Way after some seconds of a phase that begins at a speed and an acceleration."""
    return seconds * (speed + seconds * (0.5 * pull + seconds * jerk / 6.0))


def area_after(seconds: Value, place: Value, speed: Value, pull: Value, jerk: Value | float = 0.0) -> Value:
    """Area below the places after some seconds of a phase that begins at a place, a speed and an acceleration."""
    return seconds * (
        place + seconds * (0.5 * speed + pull * seconds / 6.0 + seconds * seconds * jerk / 24.0)
    )


def average(before: Value, after: Value, window: float) -> Value:
    """Average over a window of that whose integral is `before` at its start and `after` at its end."""
    return (after - before) / window


def tent_acceleration(first: Value, middle: Value, last: Value, blend: float) -> Value:
    """Second derivative of an average under a tent of half width `blend`, by the positions at its corners."""
    return (first - 2.0 * middle + last) / (blend * blend)


def under_tent(
    place: Callable[[float], Sequence[float]], middle: float, blend: float, edges: Iterable[float]
) -> list[float]:
    """The average of places under a tent of half width `blend` around a time; `edges` are those within it."""
    total: list[float] = []
    marks = sorted({middle - blend, middle, middle + blend, *edges})
    for first, last in pairwise(marks):
        half, centre = 0.5 * (last - first), 0.5 * (first + last)
        for knot, weight in GAUSS:
            time = centre + half * knot
            share = half * weight * (blend - abs(time - middle)) / (blend * blend)
            here = place(time)
            total = [a + share * b for a, b in zip(total or [0.0] * len(here), here, strict=True)]
    return total
