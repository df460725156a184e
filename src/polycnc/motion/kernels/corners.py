"""How fast the path may go where two rows meet."""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.alone import pays_to_rest
from polycnc.motion.kernels.columns import (
    ACCELERATION,
    BLEND_S,
    CORNER_EASE,
    CORNER_SPEED,
    EXIT2,
    EXIT_PULL,
    JOINT_PULL,
    JUMP,
    KIND,
    LIMIT_BLOCKS,
    METRIC,
    RAMP_S,
    REST,
    ROTARY,
    ROUNDING,
    ROW_LENGTH,
    RUN_BLEND,
    RUN_RAMP,
    SMOOTH,
    SMOOTH_COS,
    SPLINE,
    STATE_BLOCKS,
    STOP,
    TANGENT,
    TOLERANCE,
    UNIT,
    WINDOW,
)
from polycnc.motion.kernels.feeds import is_rapid
from polycnc.motion.kernels.jerk import corner_hold2

#: Directions that differ by less count as one; a path whose turn has a cosine below this turns back.
SAME_DIRECTION, TURNS_BACK = 1e-9, -0.999999


def join(
    contexts: Floats,
    record: int,
    n: int,
    limits: Floats,
    state: Floats,
    length: float,
    weight: float,
    cap2: float,
    wanted: float,
) -> float:
    """Largest x at the joint between the row before and this one, which starts along `unit` with `cap2`.

    Zero after a stop, where the path turns back, and where the feed counts another length than before. Where
    two chords of a spline meet without a corner, SMOOTH becomes 2, and the curvature decides instead of the
    corner. With limited jerk JOINT_PULL becomes the pull around the joint, and REST the seconds until the averages
    have come to rest; it also rests where that takes less time (`alone.py`).
    """
    ramp = contexts[record + RAMP_S]
    state[WINDOW] = ramp + 2.0 * contexts[record + BLEND_S]
    state[RUN_RAMP], state[RUN_BLEND] = ramp, contexts[record + BLEND_S]
    state[REST], state[JOINT_PULL] = 0.0, state[EXIT_PULL]
    stopped = state[STOP] != 0.0 or state[METRIC] != weight
    smooth = state[KIND] == SPLINE and state[SMOOTH] != 0.0
    state[STOP] = state[SMOOTH] = 0.0
    if stopped:
        state[REST], state[JOINT_PULL] = state[WINDOW], inf
        return 0.0
    unit, tangent = STATE_BLOCKS + UNIT * n, STATE_BLOCKS + TANGENT * n
    cosine = 0.0
    for i in range(n):
        w = weight if limits[ROTARY * n + i] != 0.0 else 1.0
        cosine += w * w * state[unit + i] * state[tangent + i]
    if cosine <= TURNS_BACK:
        state[REST], state[JOINT_PULL] = state[WINDOW], inf
        return 0.0
    cap2 = min(cap2, state[EXIT2])
    if smooth and cosine > SMOOTH_COS:
        state[SMOOTH] = 2.0
        if ramp == 0.0:
            return cap2
    shorter = min(length, state[ROW_LENGTH])
    tolerance = contexts[record + TOLERANCE]
    if state[SMOOTH] != 2.0:
        own2 = jump2(n, limits, state, shorter)
        if tolerance > 0.0:
            own2 = rounded2(tolerance, contexts[record + ROUNDING], n, limits, state, shorter)
        cap2 = min(cap2, own2, stepped2(n, limits, state))
    if ramp > 0.0:
        cap2 = corner_hold2(contexts, record, n, limits, state, length, cap2)
        if wanted > 0.0 and state[SMOOTH] != 2.0 and pays_to_rest(n, limits, state, length, cap2, wanted):
            state[REST], state[JOINT_PULL] = state[WINDOW], inf
            return 0.0
    return cap2


def stepped2(n: int, limits: Floats, state: Floats) -> float:
    """Largest x at a corner of two cuts at which the velocity of no axis steps by more than CORNER_SPEED."""
    step, speed = 0.0, limits[LIMIT_BLOCKS * n + CORNER_SPEED]
    for i in range(n):
        unit, tangent = state[STATE_BLOCKS + UNIT * n + i], state[STATE_BLOCKS + TANGENT * n + i]
        step = max(step, abs(unit - tangent))
    return inf if step <= SAME_DIRECTION or is_rapid(state) else (speed / step) ** 2


def jump2(n: int, limits: Floats, state: Floats, shorter: float) -> float:
    """Largest x at a corner that is passed without deviation.

    The velocity of each axis may step by its allowed jump. That alone would let a curve of ever shorter lines
    go ever faster: the step, spread over the shorter of the two lines, must also stay within the axis's
    acceleration.
    """
    unit, tangent = STATE_BLOCKS + UNIT * n, STATE_BLOCKS + TANGENT * n
    x2 = inf
    for i in range(n):
        step = abs(state[unit + i] - state[tangent + i])
        if step > SAME_DIRECTION:
            jump = state[CORNER_EASE] * limits[JUMP * n + i] / step
            x2 = min(x2, jump * jump, state[CORNER_EASE] * limits[ACCELERATION * n + i] * shorter / step)
    return x2


def rounded2(
    tolerance: float, rounding: float, n: int, limits: Floats, state: Floats, shorter: float
) -> float:
    """Largest x at a corner that is rounded within a contour tolerance and a distance from the corner.

    The corner is taken as if by the arc that touches both lines and comes within the tolerance of their
    corner ("junction deviation", S. K. Jeon, "Improving Grbl: Cornering Algorithm", 2011), with no more than
    half of the shorter line used up. For half the angle of turn b the radius is `tolerance·cos b / (1 - cos
    b)`, and its tangents have the length `radius·tan b`. The acceleration on the arc points along normals
    that turn by 2b; each axis must hold the largest part that it gets of them. A rotary axis changes its pace
    evenly over both tangents.
    """
    unit, tangent = STATE_BLOCKS + UNIT * n, STATE_BLOCKS + TANGENT * n
    before, after, sin_b, cos_b = half_turn(n, limits, state)
    if cos_b <= SAME_DIRECTION:
        return 0.0
    touch, radius = min(0.5 * shorter, rounding), inf
    if sin_b > SAME_DIRECTION:
        slower = min(before, after)
        radius = min(tolerance * cos_b * (1.0 + cos_b) / (sin_b * sin_b), touch * slower * cos_b / sin_b)
        touch = min(touch, radius * sin_b / (cos_b * slower))
    x2, faster = inf, max(before, after)
    for i in range(n):
        if limits[ROTARY * n + i] != 0.0:
            step = abs(state[unit + i] - state[tangent + i])
            if step > SAME_DIRECTION:
                x2 = min(x2, state[CORNER_EASE] * limits[ACCELERATION * n + i] * 2.0 * touch / step)
        elif radius < inf:
            a, b = state[tangent + i] / before, state[unit + i] / after
            share = largest_share(0.5 * (b - a) / sin_b, 0.5 * (b + a) / cos_b, sin_b, cos_b)
            if share > 0.0:
                pull = state[CORNER_EASE] * limits[ACCELERATION * n + i]
                x2 = min(x2, pull * radius / (share * faster * faster))
    return x2


def half_turn(n: int, limits: Floats, state: Floats) -> tuple[float, float, float, float]:
    """Speed of the linear axes before and after a corner, per path speed; sine, cosine of half the turn."""
    unit, tangent = STATE_BLOCKS + UNIT * n, STATE_BLOCKS + TANGENT * n
    before, after, apart, together = 0.0, 0.0, 0.0, 0.0
    for i in range(n):
        if limits[ROTARY * n + i] == 0.0:
            before += state[tangent + i] * state[tangent + i]
            after += state[unit + i] * state[unit + i]
    before, after = sqrt(before), sqrt(after)
    if before <= SAME_DIRECTION or after <= SAME_DIRECTION:
        return before, after, 0.0, 1.0
    for i in range(n):
        if limits[ROTARY * n + i] == 0.0:
            a, b = state[tangent + i] / before, state[unit + i] / after
            apart += (b - a) * (b - a)
            together += (b + a) * (b + a)
    return before, after, 0.5 * sqrt(apart), 0.5 * sqrt(together)


def largest_share(middle: float, along: float, sin_b: float, cos_b: float) -> float:
    """Largest part of an axis in the normals of an arc from angle -b to b.

    `middle` and `along` are the axis's parts of normal and tangent in the arc's middle: the largest of
    `middle·cos φ + along·sin φ`, at its crest if that lies on the arc, else at an end.
    """
    middle, along = abs(middle), abs(along)
    if along * cos_b <= middle * sin_b:
        return sqrt(middle * middle + along * along)
    return middle * cos_b + along * sin_b
