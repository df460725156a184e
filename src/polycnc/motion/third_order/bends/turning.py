"""How much a path turns, and how far around a place knots may be apart for that.

A cubic B-spline with knots h apart leaves a path at a knot by `(P(s - h) - 2·P(s) + P(s + h))/6`, by no more than a
sixth of the tent moment of its turning: `M(s, h) = ∫ (h - |t - s|) |dq'(t)|` over the h before and behind. What q'
turns by counts by the tolerance there, so that M may be 6. With C the sum of the turning up to a way and A the integral
of C, M is `A(s + h) - 2·A(s) + A(s - h)`.
"""

from __future__ import annotations

from math import inf

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.layout import Floats, Ints
from polycnc.motion.third_order.bends.stretches import ARC, Stretches, between

#: M at which the tolerance is used up, the share of it that is, and part of it to which that is met.
FULL, SHARE, EXACT = 6.0, 0.985, 0.01
STEPS = 60


class Turning(NamedTuple):
    """Turning of a path in tolerances: its sum up to each of the m + 1 ends, before and behind the turn there.

    `area` is its integral up to there; `weight` is a factor for each of the m stretches, by which its turning counts.
    `joint` is what q' turns by where each of them begins, `own` what it does along it, as they are.
    """

    before: Floats
    behind: Floats
    area: Floats
    weight: Floats
    joint: Floats
    own: Floats


def measure(path: Stretches, n: int, smooth: Ints, turning: Turning) -> None:
    """Find what a path turns by; `smooth` is what `curve_lines` makes of it. All of it counts as it is."""
    for e in range(len(path.form)):
        turning.weight[e] = 1.0
        turning.joint[e] = 0.0 if e == 0 or smooth[e] != 0 else between(path, e - 1, e, n, False)
        is_line = path.form[e] != ARC and smooth[e] == 0 and smooth[e + 1] == 0
        turning.own[e] = 0.0 if is_line else between(path, e, e, n, True)


def sum_turning(path: Stretches, turning: Turning) -> None:
    """Fill in the sums of the turning of a path that is measured."""
    total, area, count = 0.0, 0.0, len(path.form)
    for e in range(count):
        turning.before[e] = total
        if e > 0:
            total += max(turning.weight[e - 1], turning.weight[e]) * turning.joint[e]
        turning.behind[e], turning.area[e] = total, area
        own = turning.weight[e] * turning.own[e]
        area += (path.way[e + 1] - path.way[e]) * (total + 0.5 * own)
        total += own
    turning.before[count] = turning.behind[count] = total
    turning.area[count] = area


def turned_to(path: Stretches, turning: Turning, e: int, way: float) -> float:
    """Sum of the turning up to a way on stretch e, or beyond the path's ends."""
    if way <= path.way[0]:
        return 0.0
    if way >= path.way[e + 1]:
        total: float = turning.before[e + 1]
        return total
    slope = (turning.before[e + 1] - turning.behind[e]) / (path.way[e + 1] - path.way[e])
    here: float = turning.behind[e] + slope * (way - path.way[e])
    return here


def area_to(path: Stretches, turning: Turning, e: int, way: float) -> float:
    """Integral of the sum of the turning up to a way on stretch e, or beyond the path's ends."""
    if way <= path.way[0]:
        return 0.0
    t, length = way - path.way[e], path.way[e + 1] - path.way[e]
    if t >= length:
        beyond: float = turning.area[e + 1] + turning.before[e + 1] * (t - length)
        return beyond
    slope = (turning.before[e + 1] - turning.behind[e]) / length
    area: float = turning.area[e] + t * (turning.behind[e] + 0.5 * slope * t)
    return area


def reach(path: Stretches, turning: Turning, e: int, way: float, guess: float, most: float) -> float:
    """The largest distance h of knots around a way on stretch e that the tolerance allows, `most` at most.

    M grows ever faster with h, so that Newton's steps come down to it from above; where a corner lies between they may
    be short far off.
    """
    alone = reach_alone(path, turning, e, way)
    if alone > 0.0:
        return min(alone, most)
    here, h, low, high, last = area_to(path, turning, e, way), min(guess, most), e, e, len(path.form) - 1
    for _ in range(STEPS):
        while low > 0 and path.way[low] > way - h:
            low -= 1
        while low < e and path.way[low + 1] <= way - h:
            low += 1
        while high < last and path.way[high + 1] < way + h:
            high += 1
        while high > e and path.way[high] >= way + h:
            high -= 1
        moment = area_to(path, turning, high, way + h) - 2.0 * here + area_to(path, turning, low, way - h)
        slope = turned_to(path, turning, high, way + h) - turned_to(path, turning, low, way - h)
        over = moment - SHARE * FULL
        if over <= 0.0 and h >= most:
            return most
        if abs(over) <= EXACT * FULL:
            return h
        h = min(h - over / slope, 4.0 * h, most) if slope > 0.0 else min(2.0 * h, most)
    return h if h < inf else most


def reach_alone(path: Stretches, turning: Turning, e: int, way: float) -> float:
    """The same at a corner between two straight lines, where it ends on both; else 0."""
    if e == 0 or way != path.way[e]:
        return 0.0
    turn = turning.behind[e] - turning.before[e]
    if turn <= 0.0 or turning.before[e] > turning.behind[e - 1] or turning.before[e + 1] > turning.behind[e]:
        return 0.0
    h: float = SHARE * FULL / turn
    return h if h <= min(way - path.way[e - 1], path.way[e + 1] - way) else 0.0
