"""Look-ahead over pieces: the fastest speeds that every later limit allows.

The two passes are those of time-optimal path parametrisation by reachability (Q.-C. Pham and H. Pham, "A New Approach
to Time-Optimal Path Parameterization Based on Reachability Analysis", IEEE T-RO 34, 2018), on squared speed, with the
axis limits imposed at both ends of each piece. On a straight piece they are the plain trapezoid. Each pass visits
every piece once.
"""

from __future__ import annotations

from math import inf, sqrt

from polycnc.motion.kernels.columns import CURVED, STRAIGHT, TIMED, Floats, Limits, Pieces

#: Tries for the speed in the middle of a curved piece, and steps to the crest of `highest2`.
TRIES = 16


def backward(pieces: Pieces, count: int, limits: Limits) -> int:
    """Fill `reach2` of the first `count` pieces, with `reach2[count]` given.

    The last joint whose reach does not depend on what comes behind it, because its own cap bounds it; -1 for none.
    """
    independent = -1
    x2 = pieces.reach2[count]
    for p in range(count - 1, -1, -1):
        cap2 = pieces.entry2[p]
        if pieces.form[p] == STRAIGHT:
            x2 += 2.0 * pieces.pull[p] * pieces.length[p]
        elif x2 < cap2 and pieces.form[p] == CURVED:
            x2 = max(x2, highest2(pieces, p, limits, x2))
        if x2 >= cap2:
            x2 = cap2
            if independent < 0:
                independent = p
        pieces.reach2[p] = x2
    return independent


def forward(
    pieces: Pieces, count: int, limits: Limits, seconds_of: Floats, way_of: Floats, row_s: Floats, first_row: int
) -> None:
    """Choose `speed2` and `time` of the first `count` pieces, with `speed2[0]` given and `reach2` known.

    Adds time and length of each piece to its slot, and the time to its row; `row_s` begins with row `first_row`.
    """
    x2 = pieces.speed2[0]
    for p in range(count):
        length, end2 = pieces.length[p], pieces.reach2[p + 1]
        if pieces.form[p] == STRAIGHT:
            end2 = min(end2, x2 + 2.0 * pieces.pull[p] * length)
            seconds = straight_time(x2, end2, pieces.cap2[p], pieces.pull[p], length)
        elif pieces.form[p] == CURVED:
            end2 = min(end2, max(bound2(pieces, p, limits, x2, False)[0], 0.0))
            seconds = curved_time(pieces, p, limits, x2, end2)
        else:
            end2, seconds = 0.0, pieces.pull[p]
        x2 = pieces.speed2[p + 1] = end2
        pieces.time[p] = seconds
        seconds_of[pieces.slot[p]] += seconds
        way_of[pieces.slot[p]] += length
        row_s[pieces.row[p] - first_row] += seconds


def straight_time(start2: float, end2: float, cap2: float, pull: float, length: float) -> float:
    """Seconds of a straight piece: up to the peak, along it, down to the end (trapezoid, or triangle without the middle)."""
    peak2 = min(cap2, 0.5 * (start2 + end2) + pull * length)
    peak2 = max(peak2, start2, end2)
    if peak2 <= 0.0:
        return 0.0
    peak = sqrt(peak2)
    level = length - (2.0 * peak2 - start2 - end2) / (2.0 * pull)
    return (2.0 * peak - sqrt(start2) - sqrt(end2)) / pull + max(level, 0.0) / peak


def bound2(pieces: Pieces, p: int, limits: Limits, known2: float, at_start: bool) -> tuple[float, float, float]:
    """Upper bound on x at one end of a curved piece (`at_start` says which) for the x at the other end.

    With `u = (x₁ - x₀) / (2·length)` each limit `|q''·x + q'·u| <= a` at either end is linear in both x. The bound, and
    intercept and slope by `known2` of the limit that sets it.
    """
    n = len(limits.acceleration)
    v = pieces.vectors
    at = p * 4 * n
    here, there, half = at + n, at, -0.5 / pieces.length[p]
    if at_start:
        here, there, half = at, at + n, -half
    lowest, intercept, slope = inf, inf, 0.0
    for i in range(n):
        a = limits.acceleration[i]
        push = v[here + i] * half
        own = v[here + 2 * n + i] - push
        if own != 0.0:
            rise, flat = -push / own, a / abs(own)
            if flat + rise * known2 < lowest:
                lowest, intercept, slope = flat + rise * known2, flat, rise
        push = v[there + i] * half
        if push != 0.0:
            rise, flat = (v[there + 2 * n + i] + push) / push, a / abs(push)
            if flat + rise * known2 < lowest:
                lowest, intercept, slope = flat + rise * known2, flat, rise
    return lowest, intercept, slope


def highest2(pieces: Pieces, p: int, limits: Limits, end2: float) -> float:
    """Largest x at the start of a curved piece from which some x up to `end2` can be reached at its end.

    The bound is the least of straight lines over the end's x: concave. Where it falls at `end2`, its crest lies before; the
    crossing of a rising and a falling line closes in on it.
    """
    value, falling, fall = bound2(pieces, p, limits, end2, True)
    if fall >= 0.0 or end2 <= 0.0:
        return value
    best, rising, rise = bound2(pieces, p, limits, 0.0, True)
    best = max(best, value)
    for _ in range(TRIES):
        if rise <= fall:
            break
        x2 = (falling - rising) / (rise - fall)
        if not 0.0 < x2 < end2:
            break
        value, intercept, slope = bound2(pieces, p, limits, x2, True)
        best = max(best, value)
        if slope == rise or slope == fall:
            break
        if slope > 0.0:
            rising, rise = intercept, slope
        else:
            falling, fall = intercept, slope
    return best


def curved_time(pieces: Pieces, p: int, limits: Limits, start2: float, end2: float) -> float:
    """Seconds of a curved piece: under constant acceleration, or over a peak where that is quicker and within the limits.

    A peak costs acceleration to the side; what is left at its height, at the worse end and for the worst axis, serves to go
    up and down. Half the height is tried where too little is left.
    """
    length = pieces.length[p]
    seconds = inf
    high2 = max(start2, end2)
    if high2 > 0.0:
        seconds = 2.0 * length / (sqrt(start2) + sqrt(end2))
    peak2 = min(pieces.cap2[p], high2 + pieces.pull[p] * length)
    if peak2 <= 1.02 * high2:
        return seconds
    n = len(limits.acceleration)
    at = p * 4 * n
    for _ in range(TRIES):
        left = inf
        for i in range(at, at + 2 * n):
            share = abs(pieces.vectors[i])
            if share > 0.0:
                left = min(left, (limits.acceleration[(i - at) % n] - abs(pieces.vectors[i + 2 * n]) * peak2) / share)
        if left > 0.0 and abs(end2 - start2) <= 2.0 * left * length:
            return min(seconds, straight_time(start2, end2, peak2, left, length))
        peak2 = high2 + 0.5 * (peak2 - high2)
    return seconds
