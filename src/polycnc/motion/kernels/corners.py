"""How fast the path may go where two rows meet."""

from __future__ import annotations

from math import inf, sqrt

from polycnc.motion.kernels.columns import (
    AT_STATION,
    EXIT2,
    METRIC,
    ROW_LENGTH,
    SMOOTH,
    SMOOTH_COS,
    SPLINE,
    STATION,
    STOP,
    TOLERANCE,
    Floats,
    Limits,
    State,
)

#: Directions that differ by less count as one; a path that turns back by more than this cosine says stops.
SAME_DIRECTION, TURNS_BACK = 1e-9, -0.999999


def join(
    kind: int, contexts: Floats, base: int, limits: Limits, state: State, length: float, weight: float, cap2: float
) -> float:
    """Largest x at the joint between the row before and this one, which starts along `unit` with `cap2`.

    Zero after a stop and where the feed counts another length than before. Where two chords of a spline meet without
    a corner, `now[SMOOTH]` becomes 2 and the curvature decides instead of the corner.
    """
    now = state.now
    stopped = now[STOP] != 0.0 or now[METRIC] != weight or now[AT_STATION] != contexts[base + STATION]
    smooth = kind == SPLINE and now[SMOOTH] != 0.0 and not stopped
    now[STOP], now[SMOOTH] = 0.0, 0.0
    if stopped:
        return 0.0
    cosine = 0.0
    for i in range(len(state.unit)):
        w = weight if limits.rotary[i] != 0 else 1.0
        cosine += w * w * state.unit[i] * state.tangent[i]
    if cosine <= TURNS_BACK:
        return 0.0
    cap2 = min(cap2, now[EXIT2])
    if smooth and cosine > SMOOTH_COS:
        now[SMOOTH] = 2.0
        return cap2
    shorter = min(length, now[ROW_LENGTH])
    tolerance = contexts[base + TOLERANCE]
    if tolerance > 0.0:
        return min(cap2, rounded2(limits, state, shorter, tolerance))
    return min(cap2, jump2(limits, state, shorter))


def jump2(limits: Limits, state: State, shorter: float) -> float:
    """Largest x at a corner that is passed without deviation.

    The velocity of each axis may step by its allowed jump. That alone would let a curve of ever shorter lines go ever
    faster: the step, spread over the shorter of the two lines, must also stay within the axis's acceleration.
    """
    x2 = inf
    for i in range(len(state.unit)):
        step = abs(state.unit[i] - state.tangent[i])
        if step > SAME_DIRECTION:
            jump = limits.jump[i] / step
            x2 = min(x2, jump * jump, limits.acceleration[i] * shorter / step)
    return x2


def rounded2(limits: Limits, state: State, shorter: float, tolerance: float) -> float:
    """Largest x at a corner that is rounded within a contour tolerance.

    The corner is taken as if by the arc that touches both lines and comes within the tolerance of their corner
    ("junction deviation", S. K. Jeon, "Improving Grbl: Cornering Algorithm", 2011), with no more than half of the shorter
    line used up. For half the angle of turn b, the radius is `tolerance·cos b / (1 - cos b)`, and its tangents have the
    length `radius·tan b`. The acceleration on the arc points along normals that turn by 2b; each axis must hold the
    largest part that it gets of them. A rotary axis changes its pace evenly over both tangents.
    """
    n = len(state.unit)
    before, after, apart, together = 0.0, 0.0, 0.0, 0.0
    for i in range(n):
        if limits.rotary[i] == 0:
            before += state.tangent[i] * state.tangent[i]
            after += state.unit[i] * state.unit[i]
    before, after = sqrt(before), sqrt(after)
    tangents = 0.5 * shorter
    radius, sin_b, cos_b, faster = inf, 0.0, 1.0, max(before, after)
    if before > SAME_DIRECTION and after > SAME_DIRECTION:
        for i in range(n):
            if limits.rotary[i] == 0:
                a, b = state.tangent[i] / before, state.unit[i] / after
                apart += (b - a) * (b - a)
                together += (b + a) * (b + a)
        sin_b, cos_b = 0.5 * sqrt(apart), 0.5 * sqrt(together)
        if sin_b > SAME_DIRECTION:
            slower = min(before, after)
            radius = min(tolerance * cos_b * (1.0 + cos_b) / (sin_b * sin_b), tangents * slower * cos_b / sin_b)
            tangents = min(tangents, radius * sin_b / (cos_b * slower))
    x2 = inf
    for i in range(n):
        if limits.rotary[i] != 0:
            step = abs(state.unit[i] - state.tangent[i])
            if step > SAME_DIRECTION:
                x2 = min(x2, limits.acceleration[i] * 2.0 * tangents / step)
        elif radius < inf:
            a, b = state.tangent[i] / before, state.unit[i] / after
            share = largest_share(0.5 * (b - a) / sin_b, 0.5 * (b + a) / cos_b, sin_b, cos_b)
            if share > 0.0:
                x2 = min(x2, limits.acceleration[i] * radius / (share * faster * faster))
    return x2


def largest_share(middle: float, along: float, sin_b: float, cos_b: float) -> float:
    """Largest part of an axis in the normals of an arc from -b to b, where `middle` and `along` are the axis's parts of the
    normal and the tangent in its middle: of `middle·cos φ + along·sin φ`, at the crest if that lies on the arc.
    """
    middle, along = abs(middle), abs(along)
    if along * cos_b <= middle * sin_b:
        return sqrt(middle * middle + along * along)
    return middle * cos_b + along * sin_b
