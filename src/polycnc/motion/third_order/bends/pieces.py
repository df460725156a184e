"""What is known of the pieces of the spline: the row of each, and the highest speed by feed and axes."""

from __future__ import annotations

from math import inf, sqrt

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.layout import Floats, Ints
from polycnc.motion.third_order.bends.at_corners import SLIVER, corner_cap2, spread_reach, step_reach
from polycnc.motion.third_order.bends.controls import Spline, greville
from polycnc.motion.third_order.bends.stretches import Stretches

#: Stretches whose x differ by no more than this share one piece.
ALIKE = 1.1


class Pieces(NamedTuple):
    """Of each piece the largest square of the speed, that by corners alone, the part of the limits, its first row.

    What the program leaves the rows around counts for corners: there the axes of one row move in another.
    """

    cap2: Floats
    corner2: Floats
    ease: Floats
    row: Ints


def take_left(path: Stretches, spline: Spline, count: int, pieces: Pieces) -> None:
    """Set `corner2` of every piece to what the program leaves the rows from which the piece has its q'.

    Between two control points the spline's q' is a mean of that of the path, and so is no more of an axis asked for
    than the mean of the rows' slownesses, 1/√left2, allows. On a piece q' is a mean of three of these. `moved` is of
    no use behind this.
    """
    last, limited = len(path.form) - 1, False
    for e in range(last + 1):
        limited = limited or path.left2[e] < inf
    if not limited:
        for k in range(count):
            pieces.corner2[k] = inf
        return
    e = 0
    for k in range(count + 2):
        start, end = greville(spline, count, k), greville(spline, count, k + 1)
        while e < last and path.way[e + 1] <= start:
            e += 1
        at, slow = start, 0.0
        while e < last and path.way[e + 1] < end:
            slow += (path.way[e + 1] - at) / sqrt(path.left2[e])
            e += 1
            at = path.way[e]
        spline.moved[k] = (slow + (end - at) / sqrt(path.left2[e])) / (end - start)
    for k in range(count):
        slowest = max(spline.moved[k], spline.moved[k + 1], spline.moved[k + 2])
        pieces.corner2[k] = 1.0 / (slowest * slowest) if slowest > 0.0 else inf


def cut_pieces(
    path: Stretches, n: int, spline: Spline, count: int, first: int, last: int, pieces: Pieces
) -> int:
    """Cut pieces where the programmed speed, or the part of the limits, changes: a slow row slows no other one.

    Args:
        path: The programmed path.
        n: Number of axes.
        spline: It gets more knots; it stays the same curve. `moved` is of no use behind this.
        count: Its pieces.
        first: The first of them to cut.
        last: The one behind the last of them.
        pieces: `corner2` of each goes on with its parts.

    Returns:
        How many pieces it has then, -1 where there is no room.
    """
    cuts = find_cuts(path, spline, first, last)
    made = count + cuts
    if cuts < 0 or made >= len(spline.way):
        return -1
    k, to = count, made
    while to > k:  # from behind, to where nothing is cut any more
        cut = spline.moved[to - k - 1]
        if k < count:
            pieces.corner2[to] = pieces.corner2[k]
        if spline.way[k] > cut:
            spline.way[to] = spline.way[k]
            for i in range(n):
                spline.place[to * n + i] = spline.place[k * n + i]
                spline.first[to * n + i] = spline.first[k * n + i]
                spline.second[to * n + i] = spline.second[k * n + i]
            k -= 1
        else:
            put_knot(spline, n, k, to, cut)
        to -= 1
    return made


def find_cuts(path: Stretches, spline: Spline, first: int, last: int) -> int:
    """Write the ways at which pieces are cut into `moved`; their number, -1 where there is no room."""
    e, end, cuts, room = 0, len(path.form) - 1, 0, len(spline.moved) - 8
    bounded = bounds_corners(path)
    for k in range(first, last):
        while e < end and path.way[e + 1] <= spline.way[k]:
            e += 1
        low, high, ease, other = path.cap2[e], path.cap2[e], path.ease[e], e
        if bounded:
            cuts = cut_around(path, spline, k, e, 1.0, cuts)
        while other < end and path.way[other + 1] < spline.way[k + 1]:
            way, other = path.way[other + 1], other + 1
            if bounded:
                cuts = cut_around(path, spline, k, other, -1.0, cuts)
            low, high = min(low, path.cap2[other]), max(high, path.cap2[other])
            if high > ALIKE * low or path.ease[other] != ease:
                low, high, ease = path.cap2[other], path.cap2[other], path.ease[other]
                cuts = cut_at(spline, k, way, cuts)
            if bounded:
                cuts = cut_around(path, spline, k, other, 1.0, cuts)
            if cuts > room:
                return -1
        if bounded and other < end:
            cuts = cut_around(path, spline, k, other + 1, -1.0, cuts)
        if cuts > room:
            return -1
    return cuts


def bounds_corners(path: Stretches) -> bool:
    """Whether anything bounds the speed at corners."""
    for e in range(len(path.form)):  # noqa: SIM110 - kernels have no generators
        if path.step2[e] < inf or path.spread2[e] < inf:
            return True
    return False


def cut_at(spline: Spline, k: int, way: float, cuts: int) -> int:
    """Cut piece k at a way, if it is not near to its ends or to the last cut; the number of cuts."""
    if not spline.way[k] + SLIVER < way < spline.way[k + 1] - SLIVER:
        return cuts
    if cuts > 0 and way <= spline.moved[cuts - 1] + SLIVER:
        return cuts
    spline.moved[cuts] = way
    return cuts + 1


def cut_around(path: Stretches, spline: Spline, k: int, e: int, side: float, cuts: int) -> int:
    """Cut piece k where what bounds the corner before stretch e begins (side -1) and ends (1); the number of cuts."""
    if e == 0:
        return cuts
    fastest2 = max(path.cap2[e - 1], path.cap2[e])
    step = step_reach(path, e) if path.step2[e] < fastest2 else 0.0
    spread = spread_reach(path, e) if path.spread2[e] < fastest2 else 0.0
    first, last = min(step, spread), max(step, spread)
    if side < 0.0:
        first, last = last, first
    if first > 0.0:
        cuts = cut_at(spline, k, path.way[e] + side * first, cuts)
    if last > 0.0:
        cuts = cut_at(spline, k, path.way[e] + side * last, cuts)
    return cuts


def put_knot(spline: Spline, n: int, k: int, to: int, way: float) -> None:
    """Write knot `to` at a way between knot k and the one behind `to`, on the cubic between them."""
    t, length = way - spline.way[k], spline.way[to + 1] - spline.way[k]
    spline.way[to] = way
    for i in range(n):
        first, second = spline.first[k * n + i], spline.second[k * n + i]
        third = (spline.second[(to + 1) * n + i] - second) / length
        spline.place[to * n + i] = spline.place[k * n + i] + t * (
            first + t * (0.5 * second + t * third / 6.0)
        )
        spline.first[to * n + i] = first + t * (second + 0.5 * t * third)
        spline.second[to * n + i] = second + t * third


def bound_pieces(path: Stretches, n: int, spline: Spline, count: int, pieces: Pieces) -> None:
    """Set caps, ease and row of every piece."""
    e, last, bounded = 0, len(path.form) - 1, bounds_corners(path)
    for k in range(count):
        start, end = spline.way[k], spline.way[k + 1]
        while e < last and path.way[e + 1] <= start:
            e += 1
        pieces.row[k] = path.row[e]
        cap2, ease, corner2, other = path.cap2[e], path.ease[e], pieces.corner2[k], e
        if bounded and e > 0:
            corner2 = min(corner2, corner_cap2(path, e, start, end))
        while other < last and path.way[other + 1] < end:
            other += 1
            cap2, ease = min(cap2, path.cap2[other]), min(ease, path.ease[other])
            if bounded:
                corner2 = min(corner2, corner_cap2(path, other, start, end))
        if bounded and other < last:
            corner2 = min(corner2, corner_cap2(path, other + 1, start, end))
        pieces.ease[k], pieces.corner2[k] = ease, corner2
        pieces.cap2[k] = axes_cap2(path, n, spline, k, min(cap2, corner2))


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
    half, longest2, least2 = 0.5 * (spline.way[k + 1] - spline.way[k]), 1.0, cap2
    start2, middle2, end2 = 0.0, 0.0, 0.0
    for i in range(n):
        q = k * n + i
        start, end = spline.first[q], spline.first[q + n]
        middle = start + half * spline.second[q]
        most = max(abs(start), abs(middle), abs(end))
        if most * most * least2 > path.top[i] * path.top[i]:
            fastest = path.top[i] / most
            least2 = fastest * fastest
        if path.rotary[i] == 0.0:
            start2, middle2 = start2 + start * start, middle2 + middle * middle
            end2 += end * end
    longest2 = max(longest2, start2, middle2, end2)
    return min(cap2 / longest2, least2)
