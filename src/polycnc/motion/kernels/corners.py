"""How fast the path may go where two rows meet."""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.alone import pays_to_rest
from polycnc.motion.kernels.columns import (
    AT_START,
    SMOOTH_COS,
    SPLINE,
    SURELY,
    ContextRecord,
    Limits,
    State,
    square,
)
from polycnc.motion.kernels.feeds import is_rapid, left_angle, left_tolerance
from polycnc.motion.kernels.jerk import ARC_DEVIATION, corner_hold2, forget_bow, row_deviation2, window_s
from polycnc.motion.kernels.rounding import bend_corner

#: Directions that differ by less count as one; a path whose turn has a cosine below this turns back.
SAME_DIRECTION, TURNS_BACK = 1e-9, -0.999999


def join(
    contexts: Floats,
    record: int,
    n: int,
    limits: Limits,
    state: State,
    length: float,
    weight: float,
    cap2: float,
    wanted: float,
) -> float:
    """Largest x at the joint between the row before and this one, which starts along `unit` with `cap2`.

    Zero after a stop, where the path turns back, and where the feed counts another length than before. Where
    two chords of a spline meet without a corner, `run.smooth` becomes 2, and they decide (`chords.py`). With
    limited jerk `joint.pull` becomes the pull around the joint, and `joint.rest` the seconds until the averages
    have come to rest; it also rests where that takes less time (`alone.py`).
    """
    ramp = contexts[record + ContextRecord.RAMP_S]
    state.run.window = window_s(ramp, contexts[record + ContextRecord.BLEND_S])
    state.joint.ramp, state.joint.blend = ramp, contexts[record + ContextRecord.BLEND_S]
    state.joint.rest, state.joint.pull = 0.0, state.run.exit_pull
    stopped = state.run.stop != 0.0 or state.run.metric != weight
    smooth = state.row.kind == SPLINE and state.run.smooth != 0.0
    state.run.stop = state.run.smooth = 0.0
    if stopped:
        begin_anew(n, state)
        state.joint.rest, state.joint.pull = state.run.window, inf
        return 0.0
    cosine = cosine_of_turn(n, limits, state, weight)
    if cosine <= TURNS_BACK:
        begin_anew(n, state)
        state.joint.rest, state.joint.pull = state.run.window, inf
        return 0.0
    cap2 = min(cap2, state.run.exit2)
    if smooth and cosine > SMOOTH_COS:
        state.run.smooth = 2.0
        state.run.passed = state.run.lone = state.run.gap = 0.0
        return cap2
    shorter = min(length, state.run.length)
    tolerance = left_tolerance(contexts, record, max(state.run.off, state.row.off))
    angle, distance = (
        contexts[record + ContextRecord.TURN_TOLERANCE],
        contexts[record + ContextRecord.TURN_DISTANCE],
    )
    turns = not (angle > 0.0 or distance > 0.0)
    if ramp == 0.0:
        reach = min(0.5 * shorter, state.share_end[AT_START] * length, state.run.corner_reach)
        own2 = bend_corner(contexts, record, n, limits, state, reach)
    elif tolerance > 0.0:
        rounding = contexts[record + ContextRecord.ROUNDING]
        own2 = rounded2(tolerance, rounding, turns, n, limits, state, shorter, cap2)
    else:
        own2 = jump2(turns, n, limits, state, shorter)
    if ramp > 0.0 and not turns:
        own2 = min(own2, turned2(angle, distance, n, limits, state, shorter))
    cap2 = min(cap2, own2, stepped2(contexts, record, n, limits, state, shorter))
    if ramp > 0.0:
        cap2 = corner_hold2(contexts, record, n, limits, state, length, cap2)
        if wanted > 0.0 and pays_to_rest(n, limits, state, length, cap2, wanted):
            begin_anew(n, state)
            state.joint.rest, state.joint.pull = state.run.window, inf
            return 0.0
    return cap2


def begin_anew(n: int, state: State) -> None:
    """The axes rest, or a spline goes on: no row of short lines does, and no joint is near."""
    state.run.passed = state.run.lone = state.run.gap = 0.0
    forget_bow(n, state)


def cosine_of_turn(n: int, limits: Limits, state: State, weight: float) -> float:
    """Cosine of the angle between the row before and the row at hand, as the feed counts it."""
    cosine = 0.0
    for i in range(n):
        w = weight if limits.rotary[i] != 0.0 else 1.0
        cosine += w * w * state.unit[i] * state.tangent[i]
    return cosine


def goes_on_smoothly(n: int, limits: Limits, state: State, weight: float) -> bool:
    """Whether the row at hand is a chord of a spline that goes on with the one before it."""
    if state.row.kind != SPLINE or state.run.smooth == 0.0:
        return False
    if state.run.stop != 0.0 or state.run.metric != weight:
        return False
    return cosine_of_turn(n, limits, state, weight) > SMOOTH_COS


def stepped2(contexts: Floats, record: int, n: int, limits: Limits, state: State, shorter: float) -> float:
    """Largest x at a corner of two cuts at which the velocity of no axis steps by more than parameters allow.

    Spread over the time that the shorter of the two lines takes, the step is an acceleration, which they bound too.
    """
    x2, least2 = inf, square(limits.path.bend_least)
    if is_rapid(state) or contexts[record + ContextRecord.AHEAD] == 0.0:
        return x2
    for i in range(n):
        step = abs(state.unit[i] - state.tangent[i])
        if step > SAME_DIRECTION:
            x2 = min(x2, square(limits.step[i] / step), max(limits.bend[i] * shorter / step, least2))
    return x2


def turned2(angle: float, distance: float, n: int, limits: Limits, state: State, shorter: float) -> float:
    """Largest x at a corner at which rotary axes leave their way by an angle, or within a distance of it.

    A rotary axis changes its pace evenly as far around the corner as it may; on the way `touch` before and behind
    it that takes it off by `step·touch/4`. No more than half of the shorter line is used up. Averages are as long as
    all of the angle allows: where ends are moved by a part of it, they must be passed more slowly.
    """
    x2, swung, blend = inf, max(state.run.swung, state.row.swung), state.joint.blend
    left = left_angle(angle, state)
    for i in range(n):
        step = abs(state.unit[i] - state.tangent[i])
        if limits.rotary[i] != 0.0 and step > SAME_DIRECTION:
            touch = 0.5 * shorter
            if angle > 0.0:
                touch = min(touch, 4.0 * left / step)
            if distance > 0.0:
                touch = min(touch, distance)
            x2 = min(x2, state.joint.ease * limits.acceleration[i] * 2.0 * touch / step)
            if blend > 0.0 and swung > 0.0:
                x2 = min(x2, row_deviation2(ARC_DEVIATION * left / step, shorter, blend))
    return x2


def jump2(turns: bool, n: int, limits: Limits, state: State, shorter: float) -> float:
    """Largest x at a corner that is passed without deviation; of rotary axes too where that concerns them (`turns`).

    The velocity of each axis may step by its allowed jump. That alone would let a curve of ever shorter lines
    go ever faster: the step, spread over the shorter of the two lines, must also stay within the axis's
    acceleration.
    """
    unit, tangent = state.unit, state.tangent
    x2 = inf
    for i in range(n):
        step = abs(unit[i] - tangent[i])
        if step > SAME_DIRECTION and (turns or limits.rotary[i] == 0.0):
            jump = state.joint.ease * limits.jump[i] / step
            x2 = min(x2, jump * jump, state.joint.ease * limits.acceleration[i] * shorter / step)
    return x2


def rounded2(
    tolerance: float,
    rounding: float,
    turns: bool,
    n: int,
    limits: Limits,
    state: State,
    shorter: float,
    cap2: float,
) -> float:
    """Largest x up to `cap2` at a corner that is rounded within a contour tolerance and a distance from the corner.

    The corner is taken as if by the arc that touches both lines and comes within the tolerance of their
    corner ("junction deviation", S. K. Jeon, "Improving Grbl: Cornering Algorithm", 2011), with no more than
    half of the shorter line used up. For half the angle of turn b the radius is `tolerance·cos b / (1 - cos
    b)`, and its tangents have the length `radius·tan b`. The acceleration on the arc points along normals
    that turn by 2b; each axis must hold the largest part that it gets of them. A rotary axis changes its pace
    evenly over both tangents.
    """
    unit, tangent = state.unit, state.tangent
    before, after, sin_b, cos_b = half_turn(n, limits, state)
    if cos_b <= SAME_DIRECTION:
        return 0.0
    touch, radius = min(0.5 * shorter, rounding), inf
    if sin_b > SAME_DIRECTION:
        slower = min(before, after)
        radius = min(tolerance * cos_b * (1.0 + cos_b) / (sin_b * sin_b), touch * slower * cos_b / sin_b)
        touch = min(touch, radius * sin_b / (cos_b * slower))
    x2, faster = cap2, max(before, after)
    a_before, an_after, across, along = 0.0, 0.0, 0.0, 0.0
    if radius < inf:  # a division takes as long as ten products
        a_before, an_after, across, along = 1.0 / before, 1.0 / after, 0.5 / sin_b, 0.5 / cos_b
    for i in range(n):
        pull = state.joint.ease * limits.acceleration[i]
        if limits.rotary[i] != 0.0:
            step = abs(unit[i] - tangent[i])
            if turns and step > SAME_DIRECTION:
                x2 = min(x2, pull * 2.0 * touch / step)
        elif (
            radius < inf and pull * radius < SURELY * x2 * faster * faster
        ):  # else no share of it is too large
            a, b = tangent[i] * a_before, unit[i] * an_after
            share = largest_share(across * (b - a), along * (b + a), sin_b, cos_b)
            if share > 0.0:
                x2 = min(x2, pull * radius / (share * faster * faster))
    return x2


def half_turn(n: int, limits: Limits, state: State) -> tuple[float, float, float, float]:
    """Speed of the linear axes before and after a corner, per path speed; sine, cosine of half the turn."""
    unit, tangent = state.unit, state.tangent
    before, after, apart, together = 0.0, 0.0, 0.0, 0.0
    for i in range(n):
        if limits.rotary[i] == 0.0:
            before += tangent[i] * tangent[i]
            after += unit[i] * unit[i]
    before, after = sqrt(before), sqrt(after)
    if before <= SAME_DIRECTION or after <= SAME_DIRECTION:
        return before, after, 0.0, 1.0
    a_before, an_after = 1.0 / before, 1.0 / after
    for i in range(n):
        if limits.rotary[i] == 0.0:
            a, b = tangent[i] * a_before, unit[i] * an_after
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
