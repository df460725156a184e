"""Corners between two straight rows at which it takes less time to rest than to pass them on the bent path.

A corner that turns the way of an axis by D, with knots h before and behind it, has a q'' of D/h and a q''' of D/h²: by
its acceleration a and its jerk j the axis passes it at `√(a·h/D)` and at `∛(j·h²/D)`, steadily on 2·h; more slowly
maybe by parameters. A line between two rests takes the least time, by averages of its own (`kernels/alone.py`).

At corners of lines that take a few hundredths of a second a rest would save two to four parts in a hundred, but a run
begins anew behind it, which takes as long to plan as ten of such rows: these are passed.
"""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.alone import alone_pull, alone_top, best_ramp, rest_to_rest
from polycnc.motion.kernels.columns import Limits, State
from polycnc.motion.third_order.bends.at_corners import half_line, step_reach
from polycnc.motion.third_order.bends.stretches import Stretches, between
from polycnc.motion.third_order.bends.turning import FULL

#: Steps in which the speed between two corners is found.
HALVINGS = 12
#: A law takes so many times as long as is reckoned here.
LED = 1.02
#: Seconds from rest to rest below which a line is not worth a rest at its end.
WORTHWHILE_S = 0.1


def is_sooner_with_rest(n: int, limits: Limits, lead: State, path: Stretches, e: int, wanted: float) -> bool:
    """Whether the axes rest before stretch e, a whole straight row as the one before is.

    `wanted` is the speed of the second row, `run.wanted` that of the first one; 0 if it is not straight.
    """
    turn = between(path, e - 1, e, n, False)
    if turn <= 0.0 or lead.run.wanted == 0.0:
        return False
    h, top = FULL / turn, min(wanted, lead.run.wanted)
    if h >= half_line(path, e):
        return False
    corner = corner_speed(n, limits, lead.joint.ease, path, e, h)
    if path.step2[e] < corner * corner:
        corner, h = sqrt(path.step2[e]), step_reach(path, e)
    if corner >= top:
        return False
    first, second = path.way[e] - path.way[e - 1], path.way[e + 1] - path.way[e]
    before = alone_s(n, limits, path.arrive, (e - 1) * n, first, top, lead.joint.ease)
    behind = alone_s(n, limits, path.leave, e * n, second, top, lead.joint.ease)
    resting = before + behind
    if min(before, behind) < WORTHWHILE_S or resting * corner >= first + second:
        return False
    passing = passed_s(n, limits, path.arrive, (e - 1) * n, first, top, lead.joint.ease, corner, h)
    passing += passed_s(n, limits, path.leave, e * n, second, top, lead.joint.ease, corner, h)
    return resting < LED * passing


def corner_speed(n: int, limits: Limits, ease: float, path: Stretches, e: int, h: float) -> float:
    """Speed at which the corner before stretch e is passed with knots h before and behind it."""
    cube, x2 = inf, path.spread2[e]
    for i in range(n):
        step = abs(path.leave[e * n + i] - path.arrive[(e - 1) * n + i])
        if step > 0.0:
            x2 = min(x2, ease * limits.acceleration[i] * h / step)
            cube = min(cube, ease * limits.jerk[i] * h * h / step)
    speed: float = min(sqrt(x2), cube ** (1.0 / 3.0))
    return speed


def able(n: int, limits: Limits, ways: Floats, at: int, ease: float) -> tuple[float, float]:
    """Acceleration and jerk along a line, of whose axes the ways by its length begin at `at`."""
    pull, jerk = inf, inf
    for i in range(n):
        share = abs(ways[at + i])
        if share > 0.0:
            pull, jerk = (
                min(pull, ease * limits.acceleration[i] / share),
                min(jerk, ease * limits.jerk[i] / share),
            )
    return pull, jerk


def alone_s(n: int, limits: Limits, ways: Floats, at: int, length: float, top: float, ease: float) -> float:
    """Seconds of a line from rest to rest."""
    pull, jerk = able(n, limits, ways, at, ease)
    ramp = best_ramp(length, top, pull, jerk)
    own = alone_pull(ramp, pull, jerk)
    return ramp + rest_to_rest(length, 0.0, alone_top(length, top, own, ramp), own)


def passed_s(
    n: int,
    limits: Limits,
    ways: Floats,
    at: int,
    length: float,
    top: float,
    ease: float,
    corner: float,
    h: float,
) -> float:
    """Seconds of a line between two corners that are passed at a speed, steady on h beside each."""
    pull, jerk = able(n, limits, ways, at, ease)
    way, gain = length - 2.0 * h, top - corner
    seconds = rise_s(gain, pull, jerk)
    if (2.0 * corner + gain) * seconds > way:
        low, high = 0.0, gain
        for _ in range(HALVINGS):
            gain = 0.5 * (low + high)
            seconds = rise_s(gain, pull, jerk)
            if (2.0 * corner + gain) * seconds > way:
                high = gain
            else:
                low = gain
        gain = low
        seconds = rise_s(gain, pull, jerk)
    level = way - (2.0 * corner + gain) * seconds
    return 2.0 * h / corner + 2.0 * seconds + level / (corner + gain)


def rise_s(gain: float, pull: float, jerk: float) -> float:
    """Seconds in which the speed goes up by so much, steady before and behind."""
    return 2.0 * sqrt(gain / jerk) if gain * jerk < pull * pull else gain / pull + pull / jerk
