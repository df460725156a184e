"""How far around a corner holds what parameters of the control bound its speed by."""

from __future__ import annotations

from math import inf, sqrt

from polycnc.motion.third_order.bends.stretches import Stretches, between
from polycnc.motion.third_order.bends.turning import FULL

#: Ways that lie so near to each other are one, mm.
SLIVER = 1e-8
#: What a velocity may change by at a corner bounds the speed before and behind it, for so many seconds at that speed,
#: and on so many mm at least.
AT_CORNER_S, AT_CORNER_MM = 0.004, 1e-3


def half_line(path: Stretches, e: int) -> float:
    """Half of the shorter one of the two stretches that meet before stretch e."""
    return 0.5 * min(path.way[e] - path.way[e - 1], path.way[e + 1] - path.way[e])


def step_reach(path: Stretches, e: int) -> float:
    """How far around the corner before stretch e its `step2` holds."""
    return min(max(AT_CORNER_S * sqrt(path.step2[e]), AT_CORNER_MM), half_line(path, e))


def spread_reach(path: Stretches, e: int) -> float:
    """The same of its `spread2`: as far as the path may bend for the corner."""
    turn = between(path, e - 1, e, len(path.rotary), False)
    return min(FULL / turn, half_line(path, e)) if turn > 0.0 else half_line(path, e)


def corner_cap2(path: Stretches, e: int, start: float, end: float) -> float:
    """Largest square of the speed between two ways by the corner before stretch e."""
    x2, apart = inf, max(path.way[e] - end, start - path.way[e], 0.0) + SLIVER
    if path.step2[e] < inf and apart < step_reach(path, e):
        x2 = path.step2[e]
    if path.spread2[e] < x2 and path.spread2[e] < inf and apart < spread_reach(path, e):
        x2 = path.spread2[e]
    return x2
