"""What is known of the pieces of the spline: the row of each, and the highest speed by feed and axes."""

from __future__ import annotations

from math import inf
from typing import NamedTuple

from polycnc.kernels.layout import Floats, Ints
from polycnc.motion.third_order.bends.controls import Spline
from polycnc.motion.third_order.bends.stretches import Stretches


class Pieces(NamedTuple):
    """Of each piece the largest square of the speed, the part of acceleration and jerk, and of its rows the first."""

    cap2: Floats
    ease: Floats
    row: Ints


def bound_pieces(path: Stretches, n: int, spline: Spline, count: int, pieces: Pieces) -> None:
    """Set cap, ease and row of every piece."""
    e, last = 0, len(path.form) - 1
    for k in range(count):
        start, end = spline.way[k], spline.way[k + 1]
        while e < last and path.way[e + 1] <= start:
            e += 1
        pieces.row[k] = path.row[e]
        cap2, ease, other = path.cap2[e], path.ease[e], e
        while other < last and path.way[other + 1] < end:
            other += 1
            cap2, ease = min(cap2, path.cap2[other]), min(ease, path.ease[other])
        pieces.ease[k] = ease
        pieces.cap2[k] = axes_cap2(path, n, spline, k, cap2)


def end_rows(path: Stretches, start: float, end: float, rows: Ints, ways: Floats) -> int:
    """Write the rows that end behind one way and up to another, and the ways at which they do; their number."""
    found, last = 0, len(path.form) - 1
    for e in range(last + 1):
        way = path.way[e + 1]
        if start < way <= end and (e == last or path.row[e] != path.row[e + 1]):
            rows[found], ways[found] = path.row[e], way
            found += 1
    return found


def axes_cap2(path: Stretches, n: int, spline: Spline, k: int, cap2: float) -> float:
    """Largest x on piece k by a bound on the speed of the linear axes together, and by that of each axis.

    On the piece q' is quadratic and stays within the hull of its three Bézier points.
    """
    half, longest2, least = 0.5 * (spline.way[k + 1] - spline.way[k]), 1.0, inf
    start2, middle2, end2 = 0.0, 0.0, 0.0
    for i in range(n):
        q = k * n + i
        start, end = spline.first[q], spline.first[q + n]
        middle = start + half * spline.second[q]
        most = max(abs(start), abs(middle), abs(end))
        if most > 0.0:
            least = min(least, path.top[i] / most)
        if path.rotary[i] == 0.0:
            start2, middle2 = start2 + start * start, middle2 + middle * middle
            end2 += end * end
    longest2 = max(longest2, start2, middle2, end2)
    return min(cap2 / longest2, least * least)
