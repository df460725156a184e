"""Look-ahead over pieces: the fastest speeds that every later limit allows.

The two passes are those of time-optimal path parametrisation by reachability (H. Pham and Q.-C. Pham, "A New
Approach to Time-Optimal Path Parameterization Based on Reachability Analysis", IEEE T-RO 34, 2018), on
squared speed, with the axis limits imposed at both ends of each piece. On straight pieces they are the plain
trapezoid. Each pass visits every piece once.
"""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.columns import Form, Limits, PieceRecord, State, piece_width

#: Tries for the speed in the middle of a curved piece, and steps to the crest of `highest2`.
TRIES = 16
#: What an axis may add along the path counts as nothing below this part of its acceleration.
NOTHING = 1e-9


def settled(pieces: Floats, n: int, state: State) -> int:
    """The number of pieces laid that no row to come can change: the last ones wait for the rows behind them."""
    width, count = piece_width(n), state.run.pieces
    reach = 0.5 * sqrt(state.run.top2) * state.run.window
    if state.run.window == 0.0:
        reach = 0.5 * state.run.length  # the corner behind the last row may bend so much of it
    last, way = count - 1, 0.0
    if state.run.chord != 0.0 and last > 0 and pieces[last * width + PieceRecord.PAUSE] == 0.0:
        last -= 1  # what bounds the joint before it has not been spread
    while last > 0 and way < reach and pieces[last * width + PieceRecord.PAUSE] == 0.0:
        way += pieces[last * width + PieceRecord.LENGTH]
        last -= 1
    return min(last, count - state.run.straight_pieces) if state.run.alone == 2.0 else last


def backward(pieces: Floats, count: int, n: int, limits: Limits) -> int:
    """Fill REACH2 of the first `count` pieces, behind which the axes stop.

    The last joint whose reach does not depend on what comes behind it, because its own cap bounds it; -1 for
    none.
    """
    independent, width, x2 = -1, piece_width(n), 0.0
    for p in range(count - 1, -1, -1):
        at = p * width
        cap2 = pieces[at + PieceRecord.ENTRY2]
        if pieces[at + PieceRecord.FORM] <= Form.BENT:
            x2 += 2.0 * pieces[at + PieceRecord.PULL] * pieces[at + PieceRecord.LENGTH]
        elif x2 < cap2 and pieces[at + PieceRecord.FORM] != Form.TIMED:
            x2 = max(x2, highest2(pieces, at, n, limits, x2))
        if x2 >= cap2:
            x2 = cap2
            if independent < 0:
                independent = p
        pieces[at + PieceRecord.REACH2] = x2
    return independent


def forward(
    pieces: Floats,
    count: int,
    n: int,
    limits: Limits,
    end2: float,
    slots: Floats,
    rows: Floats,
    first_row: int,
) -> None:
    """Choose SPEED2, END2 and TIME of the first `count` pieces, given SPEED2 of the first and REACH2 of all.

    Args:
        pieces: Records of pieces.
        count: Pieces to plan.
        n: Number of axes.
        limits: The machine.
        end2: Reach behind the last of them.
        slots: Seconds and length of every slot, in turn; the pieces' are added.
        rows: Seconds and length of every row from `first_row` on, in turn; the pieces' are added.
        first_row: Number of the first row in `rows`.
    """
    width = piece_width(n)
    x2 = pieces[PieceRecord.SPEED2]
    for p in range(count):
        at = p * width
        length = pieces[at + PieceRecord.LENGTH]
        next2 = pieces[at + width + PieceRecord.REACH2] if p + 1 < count else end2
        peak2, rate = 0.0, pieces[at + PieceRecord.PULL]
        if pieces[at + PieceRecord.FORM] <= Form.BENT:
            next2 = min(next2, x2 + 2.0 * rate * length)
            cap2, rise = pieces[at + PieceRecord.CAP2], pieces[at + PieceRecord.RISE]
            if rise == 0.0:
                peak2 = straight_peak2(x2, next2, cap2, rate, length)
                seconds = straight_time(x2, next2, cap2, rate, length)
            else:
                seconds, peak2 = rising_time(x2, next2, cap2, rise, rate, length)
        elif pieces[at + PieceRecord.FORM] != Form.TIMED:
            next2 = min(next2, max(bound2(pieces, at, n, limits, x2, False)[0], 0.0))
            seconds, peak2, rate = curved_time(pieces, at, n, limits, x2, next2)
        else:
            next2, seconds = 0.0, rate
        pieces[at + PieceRecord.SPEED2], pieces[at + PieceRecord.END2], pieces[at + PieceRecord.TIME] = (
            x2,
            next2,
            seconds,
        )
        pieces[at + PieceRecord.PEAK2], pieces[at + PieceRecord.RATE] = peak2, rate
        seconds += pieces[at + PieceRecord.PAUSE] - min(
            pieces[at + PieceRecord.EARLY], pieces[at + PieceRecord.PAUSE]
        )
        x2 = next2
        slot = 2 * int(pieces[at + PieceRecord.SLOT])
        slots[slot] += seconds
        slots[slot + 1] += length
        row = 2 * (int(pieces[at + PieceRecord.ROW]) - first_row)
        rows[row] += seconds
        rows[row + 1] += length


def straight_time(start2: float, end2: float, cap2: float, pull: float, length: float) -> float:
    """Seconds of a straight piece: up to the peak, along it, down to the end (a trapezoid, or a triangle)."""
    peak2 = straight_peak2(start2, end2, cap2, pull, length)
    if peak2 <= 0.0:
        return 0.0
    peak = sqrt(peak2)
    level = length - (2.0 * peak2 - start2 - end2) / (2.0 * pull)
    return (2.0 * peak - sqrt(start2) - sqrt(end2)) / pull + max(level, 0.0) / peak


def straight_peak2(start2: float, end2: float, cap2: float, pull: float, length: float) -> float:
    """Highest x on a straight piece."""
    return max(min(cap2, 0.5 * (start2 + end2) + pull * length), start2, end2)


def ways_to_cap(
    start2: float, end2: float, cap2: float, rise: float, pull: float, length: float
) -> tuple[float, float]:
    """Ways up to a cap on x, CAP2 at the start of a straight piece, that rises evenly along it, and down from it.

    Neither is longer than the piece; together they are as long where the cap is not reached. One that changes faster
    than the acceleration `pull` lets x change is not.
    """
    up = down = length
    if 2.0 * pull > abs(rise):
        up = (cap2 - start2) / (2.0 * pull - rise)
        down = (cap2 + rise * length - end2) / (2.0 * pull + rise)
    if up + down >= length:
        up = 0.5 * length + 0.25 * (end2 - start2) / pull
        down = length - up
    return min(max(up, 0.0), length), min(max(down, 0.0), length)


def rising_time(
    start2: float, end2: float, cap2: float, rise: float, pull: float, length: float
) -> tuple[float, float]:
    """Seconds of a straight piece under a cap that rises evenly along it, and highest x on it."""
    up, down = ways_to_cap(start2, end2, cap2, rise, pull, length)
    first2, last2 = start2 + 2.0 * pull * up, end2 + 2.0 * pull * down
    first, last = sqrt(first2), sqrt(last2)
    if first + last <= 0.0:
        return 0.0, 0.0
    level = 2.0 * max(length - up - down, 0.0) / (first + last)
    seconds = (first - sqrt(start2) + last - sqrt(end2)) / pull + level
    return seconds, max(first2, last2, start2, end2)


def bound2(
    pieces: Floats, at: int, n: int, limits: Limits, known2: float, at_start: bool
) -> tuple[float, float, float]:
    """Upper bound on x at one end of a curved piece (`at_start` says which) for the x at the other end.

    With `u = (x₁ - x₀) / (2·length)` each limit `|q''·x + q'·u| <= a` at either end is linear in both x. The
    bound, and intercept and slope by `known2` of the limit that sets it. An axis that does not move along the path at
    the known end bounds the x there, not the acceleration: divided by a direction that is zero but for rounding, its
    limit would ask for a stop.
    """
    here, there, half = (
        at + PieceRecord.VECTORS + n,
        at + PieceRecord.VECTORS,
        -0.5 / pieces[at + PieceRecord.LENGTH],
    )
    if at_start:
        here, there, half = there, here, -half
    flat = 2.0 * pieces[at + PieceRecord.PATH_PULL] * pieces[at + PieceRecord.LENGTH]
    lowest, intercept, slope = known2 + flat, flat, 1.0
    cap2 = pieces[at + PieceRecord.CAP2]
    for i in range(n):
        a = limits.acceleration[i]
        push = pieces[here + i] * half
        own = pieces[here + 2 * n + i] - push
        if own != 0.0:
            rise, flat = -push / own, a / abs(own)
            if flat + rise * known2 < lowest:
                lowest, intercept, slope = flat + rise * known2, flat, rise
        push = pieces[there + i] * half
        if abs(push) * cap2 > NOTHING * a:
            rise, flat = (pieces[there + 2 * n + i] + push) / push, a / abs(push)
            if flat + rise * known2 < lowest:
                lowest, intercept, slope = flat + rise * known2, flat, rise
    return lowest, intercept, slope


def highest2(pieces: Floats, at: int, n: int, limits: Limits, end2: float) -> float:
    """Largest x at the start of a curved piece from which some x up to `end2` can be reached at its end.

    The bound is the least of straight lines over the end's x: concave. Where it falls at `end2`, its crest
    lies before; the crossing of a rising and a falling line closes in on it.
    """
    best, falling, fall = bound2(pieces, at, n, limits, end2, True)
    if fall >= 0.0 or end2 <= 0.0:
        return best
    value, rising, rise = bound2(pieces, at, n, limits, 0.0, True)
    best = max(best, value)
    for _ in range(TRIES):
        if rise <= fall:
            break
        x2 = (falling - rising) / (rise - fall)
        if not 0.0 < x2 < end2:
            break
        value, intercept, slope = bound2(pieces, at, n, limits, x2, True)
        best = max(best, value)
        if slope in (rise, fall):
            break
        if slope > 0.0:
            rising, rise = intercept, slope
        else:
            falling, fall = intercept, slope
    return best


def curved_time(
    pieces: Floats, at: int, n: int, limits: Limits, start2: float, end2: float
) -> tuple[float, float, float]:
    """Seconds of a curved piece, highest x, and the acceleration to it: steady, or over a peak if quicker.

    A peak costs acceleration to the side; what is left at its height, at the worse end and for the worst
    axis, serves to go up and down. Half the height is tried where too little is left.
    """
    length, seconds = pieces[at + PieceRecord.LENGTH], inf
    high2 = max(start2, end2)
    if high2 > 0.0:
        seconds = 2.0 * length / (sqrt(start2) + sqrt(end2))
    peak2 = min(pieces[at + PieceRecord.CAP2], high2 + pieces[at + PieceRecord.PULL] * length)
    steady = abs(end2 - start2) / (2.0 * length)
    if start2 + end2 >= 1.96 * peak2:
        return seconds, high2, steady  # nearly level at the peak: nothing to win
    first = at + PieceRecord.VECTORS
    for _ in range(TRIES):
        left = pieces[at + PieceRecord.PATH_PULL]
        for i in range(2 * n):
            share = abs(pieces[first + i])
            if share > 0.0:
                spent = abs(pieces[first + 2 * n + i]) * peak2
                left = min(left, (limits.acceleration[i % n] - spent) / share)
        if left > 0.0 and abs(end2 - start2) <= 2.0 * left * length:
            over = straight_time(start2, end2, peak2, left, length)
            if over < seconds:
                return over, straight_peak2(start2, end2, peak2, left, length), left
            break
        peak2 = high2 + 0.5 * (peak2 - high2)
    return seconds, high2, steady
