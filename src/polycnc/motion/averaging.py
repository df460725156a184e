"""Limited jerk by averages: from the motion of the interpolator to that of the axes.

The interpolator runs in phases of constant acceleration, so that the way is piecewise quadratic in time and the area
below it piecewise cubic: the average of the way over a window is the difference of two areas. The positions that this
average leads to are averaged twice more, which is once under a tent; the second derivative of that is a plain second
difference of positions (`kernels/jerk.py` says what the averages are for and how long they are).

Every function takes numbers as well as arrays: the main run follows moment by moment, sampling asks for many at once.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

#: A number, or one for each of many times.
Value = TypeVar("Value", float, "NDArray[np.float64]")

#: Parts of each half of the tent; even.
PARTS = 8
#: Weights of positions at 2·PARTS + 1 times, one part apart, in the average under the tent.
TENT = tuple((PARTS - abs(k)) / PARTS**2 for k in range(-PARTS, PARTS + 1))
#: Weights of PARTS + 1 of them in the average over half of the window, by Simpson's rule.
HALF = tuple((1.0 if k in (0, PARTS) else 4.0 if k % 2 else 2.0) / (3.0 * PARTS) for k in range(PARTS + 1))


def way_after(seconds: Value, speed: Value, pull: Value) -> Value:
    """Way after some seconds of a phase that begins at a speed."""
    return seconds * (speed + 0.5 * pull * seconds)


def area_after(seconds: Value, place: Value, speed: Value, pull: Value) -> Value:
    """Area below the places after some seconds of a phase that begins at a place and a speed."""
    return seconds * (place + seconds * (0.5 * speed + pull * seconds / 6.0))


def average(before: Value, after: Value, window: float) -> Value:
    """Average over a window of that whose integral is `before` at its start and `after` at its end."""
    return (after - before) / window


def tent_acceleration(first: Value, middle: Value, last: Value, blend: float) -> Value:
    """Second derivative of an average under a tent of half width `blend`, by the positions at its corners."""
    return (first - 2.0 * middle + last) / (blend * blend)
