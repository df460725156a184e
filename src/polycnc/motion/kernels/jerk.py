"""Limited jerk: how much speed and acceleration along the path lines, corners and curves allow.

The speed along the path is averaged over RAMP_S (T), then the position of every axis twice over BLEND_S (τ),
symmetrically in time. The first makes the jerk along the path at most `2·pull/T`; the path stays as it is. The
second turns what is left into bounded jerk: a jump of velocity, Δv at a corner, becomes a peak of acceleration
`Δv/τ` with a jerk of `Δv/τ²`, and a deviation of `Δv·τ/6`; a jump of acceleration, Δa where the curvature
changes, a jerk of `Δa/τ`; a steady acceleration a across the path deviates by `a·τ²/12`.

Each of these gets a part of the axis's jerk and acceleration and of the contour tolerance; the parts that can
come together add up to no more than one.
"""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.columns import ContextRecord, Limits, State

#: Parts of the acceleration: along the path; across it; in corners.
ALONG, ACROSS, CORNER = 0.7, 0.3, 0.3
#: Parts of the jerk: of one corner; of a row of short lines; where the curvature changes; on a
#: curve by its speed and by its change of speed; at a corner by the change of speed; by the uneven q'' of a chord.
JERK_CORNER, JERK_LINES, JERK_ENTRY, JERK_CURVE, JERK_BOTH, JERK_TURN = 0.5, 0.3, 0.4, 0.25, 0.2, 0.25
JERK_BOW = 0.15
#: Parts of the tolerance: of one corner, of the acceleration across the path.
DEVIATION_CORNER, DEVIATION_CURVE = 0.5, 0.5
#: Turns smaller than this count as none.
NO_TURN = 1e-9
#: One number is above another for certain, whatever was rounded, if it is above so many times that.
SURELY = 1.000001


def window_s(ramp: float, blend: float) -> float:
    """Seconds by which the axes rest later than what their averages follow: all of them, one behind the other."""
    return ramp + 2.0 * blend


def axis_pull(ramp: float, limits: Limits, i: int) -> float:
    """Acceleration of an axis that neither exceeds its own limit nor, averaged over `ramp` seconds, that of jerk."""
    pull = limits.acceleration[i]
    if ramp > 0.0:
        pull = min(pull, 0.5 * limits.jerk[i] * ramp)
    return pull


def line_pull(contexts: Floats, record: int, n: int, limits: Limits, state: State, alone: bool) -> float:
    """Acceleration along the row at hand, from `unit`; `alone`: from rest to rest, so that nothing else needs a part.

    Else it does not depend on the direction: then it is the same on both sides of most joints.
    """
    pull = inf
    for i in range(n):
        share = abs(state.unit[i])
        if share > 0.0:
            own = axis_pull(contexts[record + ContextRecord.RAMP_S], limits, i)
            pull = min(pull, own / share if alone else ALONG * own / max(share, 1.0))
    return pull


def corner_hold2(
    contexts: Floats, record: int, n: int, limits: Limits, state: State, length: float, cap2: float
) -> float:
    """Largest x up to `cap2` at the joint between two rows; lowers the joint's pull, the acceleration around it.

    Short lines make the axes accelerate like a curve, by the change of direction over the mean length, `bow`. What
    of that is as it was at the joint before needs no jerk: `JERK_LINES` is for what changes.
    """
    unit, tangent, bow = state.unit, state.tangent, state.bow
    bend, before = state.bend, state.bent_before
    blend, x2, least = contexts[record + ContextRecord.BLEND_S], cap2, inf
    shorter, mean, turn = min(length, state.run.length), 0.5 * (length + state.run.length), 0.0
    for i in range(n):
        a = state.joint.ease * limits.acceleration[i]
        j = state.joint.ease * limits.jerk[i]
        step, bowed = abs(unit[i] - tangent[i]), (unit[i] - tangent[i]) / mean
        if limits.rotary[i] == 0.0:
            turn += step * step
        if step > NO_TURN:
            jump = min(JERK_CORNER * j * blend * blend, CORNER * a * blend) / step
            begins2 = JERK_LINES * j * blend * shorter / step
            enough = max(x2, begins2)
            goes_on2 = step_top2(j, blend, abs(bowed - bow[i]), mean, JERK_LINES, enough)
            x2 = min(x2, jump * jump, ACROSS * a * shorter / step, max(begins2, goes_on2))
            if goes_on2 > begins2:
                least = min(least, j / abs(bowed))
            state.joint.pull = min(state.joint.pull, JERK_TURN * j * blend / step)
        bow[i] = bowed
        change = abs(bend[i] - before[i])
        if change > NO_TURN:
            x2 = min(x2, JERK_ENTRY * j * blend / change)
    turn = sqrt(turn)
    if turn > NO_TURN:
        deviation = contexts[record + ContextRecord.TOLERANCE] / (blend * turn)
        x2 = min(
            x2,
            12.0 * DEVIATION_CURVE * deviation / blend * shorter,
            (6.0 * DEVIATION_CORNER * deviation) ** 2,
            (contexts[record + ContextRecord.ROUNDING] / blend) ** 2,
        )
    if least < inf and x2 > 0.0:
        state.joint.pull = min(state.joint.pull, JERK_BOTH * least / (3.0 * sqrt(x2)))
    return x2


def left_across(a: float, j: float, blend: float, along: float) -> float:
    """What is left of an axis's acceleration on a curve, beside that along the path and that of a corner."""
    corner = min(CORNER * a, JERK_CORNER * j * blend)
    return max(ACROSS * a, a - corner - along)


def step_top2(j: float, blend: float, step: float, spacing: float, part: float, enough: float) -> float:
    """Largest x where the mean of an axis's q'' changes by a step from chord to chord, which are `spacing` mm apart.

    `part` is that of the jerk for one step. On a way shorter than that the average of the positions sees one step,
    `x·step/τ`; on a longer one as many as lie in it, which is `v³·step/spacing`. What is above `enough` is above it
    here too, and need not be known: most rows do without the root.
    """
    if step <= NO_TURN:
        return inf
    top2, cube = part * j * blend / step, JERK_CURVE * j * spacing / step
    least = min(top2, enough)
    if cube * cube > SURELY * least * least * least:
        return top2
    root2: float = cube ** (2.0 / 3.0)
    return min(top2, root2)


def bow_top2(j: float, blend: float, bow: float, length: float) -> float:
    """Largest x on a chord along which an axis's q'' changes by `bow` to either side of its mean.

    Over a whole chord that cancels out: the second difference of q' over a way longer than the chord has no more than
    `bow·length` of it, which gives a jerk of `v·bow·length/τ²`. On a shorter way the average sees the change along
    the chord, `2·v³·bow/length`, and the steps at its ends, `2·x·bow/τ`.
    """
    if bow <= NO_TURN:
        return inf
    long = JERK_BOW * j * blend * blend / (bow * length)
    short = min(0.5 * JERK_BOW * j * blend / bow, (0.5 * JERK_BOW * j * length / bow) ** (2.0 / 3.0))
    top2: float = max(long * long, short)
    return top2


def arc_hold(
    contexts: Floats, record: int, limits: Limits, state: State, curvature: float, speed: float
) -> tuple[float, float]:
    """Largest x and acceleration along an arc of a curvature (1/mm) that is asked to run at a speed."""
    blend = contexts[record + ContextRecord.BLEND_S]
    a, j, pull = inf, inf, inf
    for k in range(3):
        i = limits.geometry[k]
        if i >= 0:
            pull = min(
                pull,
                ALONG * state.row.ease * axis_pull(contexts[record + ContextRecord.RAMP_S], limits, i),
            )
            if state.basis[k] != 0.0 or state.basis[3 + k] != 0.0:
                a, j = min(a, limits.acceleration[i]), min(j, limits.jerk[i])
    tolerance = contexts[record + ContextRecord.TOLERANCE]
    cap2 = min(
        speed * speed,
        ACROSS * a / curvature,
        12.0 * DEVIATION_CURVE * tolerance / (blend * blend * curvature),
    )
    cap2 = min(cap2, (JERK_CURVE * j / (curvature * curvature)) ** (2.0 / 3.0))
    return cap2, min(pull, JERK_BOTH * state.row.ease * j / (3.0 * curvature * sqrt(cap2)))
