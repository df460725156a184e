"""Where a path can have a seam at the least cost, by the path around alone."""

from __future__ import annotations

from math import sqrt

from polycnc.kernels.layout import Floats, Ints
from polycnc.motion.third_order.bends.controls import Spline, lay_controls, shape
from polycnc.motion.third_order.bends.keeping import forget
from polycnc.motion.third_order.bends.seams import BESIDES, SIDE
from polycnc.motion.third_order.bends.stretches import Stretches, curve_lines, length_of
from polycnc.motion.third_order.bends.turning import Turning, measure, reach, sum_turning
from polycnc.motion.third_order.bends.within import most_used

#: On a straight line knots of a seam are apart by this part of it: there they bend nothing. Elsewhere by this part of
#: what the turning allows.
OF_LINE, OF_REACH = 1.0 / 40.0, 0.98
#: Which of the stretches are looked at, and how much better another one must be than the longest.
EVERY, MUCH = 8, 1.1
#: So many distances around a seam are looked at.
FARTHEST = 8
#: Part of the tolerance that a seam may use; times that its knots are brought closer for that, and by how much; how
#: far apart, in the distance of its knots, those may lie that follow.
USED, TIMES, CLOSER, OUTER = 0.97, 120, 0.9, (0.2, 1.0)


def find_seam(
    path: Stretches,
    low: int,
    high: int,
    smooth: Ints,
    turning: Turning,
    spline: Spline,
    found: Floats,
) -> int:
    """Find a place for a seam: where knots can be farthest apart, on the longest stretch or one of some others.

    Args:
        path: The path around; what may be looked at. Tangents of lines that are chords of a curve are set.
        low: The first stretch on which it may lie.
        high: The one behind the last.
        smooth: Room for a number for each end of a stretch.
        turning: Room.
        spline: Room for `2 * SIDE + 5` knots.
        found: Set to the way of the seam and the distance of its knots.

    Returns:
        1, or 0 where there is none that keeps to the tolerance.
    """
    n, e = len(path.rotary), low
    curve_lines(path, n, smooth)
    measure(path, n, smooth, turning)
    sum_turning(path, turning)
    for k in range(low, high):
        if length_of(path, k) > length_of(path, e):
            e = k
    here = reach_around(path, turning, e)
    for k in range(low, high, EVERY):
        other = reach_around(path, turning, k)
        if other > MUCH * here:
            e, here = k, other
    way, most = 0.5 * (path.way[e] + path.way[e + 1]), most_apart(path, e)
    found[0], found[1] = way, kept_apart(path, n, spline, way, min(OF_REACH * here, most))
    if turning.before[e + 1] <= turning.behind[e]:
        # On a straight line: the corners keep the rest of it, and the parts of what is wanted can be compared.
        length = length_of(path, e)
        close = OF_LINE * length
        corners = reach(path, turning, e, path.way[e], most, most)
        corners = max(corners, reach(path, turning, e, path.way[e + 1], most, most))
        if (0.5 * length - SIDE * close) * here >= found[1] * corners:
            found[1] = close
    return 1 if found[1] > 0.0 else 0


def most_apart(path: Stretches, e: int) -> float:
    """The largest distance of knots of a seam on stretch e by what is known of the path."""
    way = 0.5 * (path.way[e] + path.way[e + 1])
    return min(way - path.way[BESIDES], path.way[len(path.form) - BESIDES] - way) / FARTHEST


def reach_around(path: Stretches, turning: Turning, e: int) -> float:
    """What the turning allows in the middle of stretch e."""
    most = most_apart(path, e)
    return reach(path, turning, e, 0.5 * (path.way[e] + path.way[e + 1]), most, most)


def kept_apart(path: Stretches, n: int, spline: Spline, way: float, apart: float) -> float:
    """The distance of the knots of a seam, or a smaller one with which it keeps to the tolerance; 0 for none."""
    for _ in range(TIMES):
        used = 0.0
        for outer in OUTER:
            used = max(used, used_by(path, n, spline, way, apart, outer))
        if used <= USED:
            return apart
        apart *= CLOSER
    return 0.0


def far_enough(
    path: Stretches, since: int, first: int, fewest: int, seconds: float, most: int, passed: Floats
) -> int:
    """The stretch from which on a part may end: so many stretches and seconds behind its start, as the feed counts.

    Args:
        path: The path.
        since: The first stretch of the part.
        first: The first one that is not looked at yet.
        fewest: Stretches at least.
        seconds: Seconds at least, but where the part has the most stretches.
        most: That number.
        passed: Seconds up to `first`; go on.

    Returns:
        Its number, that of all stretches where none is far enough yet.
    """
    top = 0.0
    for speed in path.top:
        top = max(top, speed)
    for e in range(first, len(path.form)):
        if e - since >= most or (e - since >= fewest and passed[0] >= seconds):
            return e
        passed[0] += length_of(path, e) / min(sqrt(path.cap2[e]), top)
    return len(path.form)


def used_by(path: Stretches, n: int, spline: Spline, way: float, apart: float, outer: float) -> float:
    """The largest part of the tolerance that is used around a seam; `outer` knots are apart by so much of the inner."""
    pieces = 2 * SIDE + 4
    for k in range(2 * SIDE + 1):
        spline.way[k + 2] = way + (k - SIDE) * apart
    for k in range(2):
        beyond = (SIDE + (2 - k) * outer) * apart
        spline.way[k], spline.way[pieces - k] = way - beyond, way + beyond
    forget(spline, pieces)
    lay_controls(path, n, spline, pieces)
    shape(spline, n, pieces)
    return most_used(path, n, spline, 1, pieces - 1)
