"""Limited jerk: how much speed and acceleration along the path lines, corners and curves allow.

The speed along the path is averaged over RAMP_S (T), then the position of every axis twice over BLEND_S (τ),
symmetrically in time. The first makes the jerk along the path at most `2·pull/T`; the path stays as it is. The
second turns what is left into bounded jerk: a jump of velocity, Δv at a corner, becomes a peak of acceleration
`Δv/τ` with a jerk of `Δv/τ²`, and a deviation of `Δv·τ/6`; a jump of acceleration, Δa where the curvature
changes, a jerk of `Δa/τ`; a steady acceleration a across the path deviates by `a·τ²/12`.

Each of these gets a part of the axis's jerk and acceleration and of the contour tolerance; the parts that can
come together add up to no more than one. On a line, and along an arc, nothing else needs a part but at the joints, as
far as the averages reach: there the joint's own bounds hold (`hold.py`).
"""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.columns import (
    SPLINE,
    SURELY,
    ContextRecord,
    Limits,
    State,
    lowered,
    square,
)
from polycnc.motion.kernels.feeds import left_tolerance

#: Parts of the acceleration beside a joint in a row: along the path, across it.
ALONG, ACROSS = 0.7, 0.3
#: On an arc away from its ends: part of the acceleration across the path, of the jerk by its speed, of the tolerance.
ARC_ACROSS, ARC_JERK, ARC_DEVIATION = 0.85, 0.3, 0.98
#: At a joint that no other one is near to: part of the jerk along the path; all that is given away.
LONE_ALONG, LONE = 0.2, 0.98
#: In a row of corners: part of the acceleration across the path. Of tents that are `h` of their half width apart, less
#: than one, no more than `(1 + h²/TENTS)/h` add up anywhere, and no more than `MOST_TENTS/h`.
ROW_ACROSS, TENTS, MOST_TENTS = 0.8, 3.5, 1.125
#: Parts of the jerk: of one corner; of a row of short lines; where the curvature changes; on a
#: curve by its speed and by its change of speed; at a corner by the change of speed; by the uneven q'' of a chord.
JERK_CORNER, JERK_LINES, JERK_ENTRY, JERK_CURVE, JERK_BOTH, JERK_TURN = 0.5, 0.3, 0.4, 0.25, 0.2, 0.25
JERK_BOW = 0.25
#: How soon lines of different length in a row count as one corner more.
UNEVEN = 2.0
#: All that the joints of a row need, beside the acceleration along the path.
ROW = 0.85
#: Parts of the tolerance: of one corner, of the acceleration across the path.
DEVIATION_CORNER, DEVIATION_CURVE = 0.5, 0.5
#: Turns smaller than this count as none.
NO_TURN = 1e-9


def window_s(ramp: float, blend: float) -> float:
    """Seconds by which the axes rest later than what their averages follow: all of them, one behind the other."""
    return ramp + 2.0 * blend


def averaged_s2(ramp: float, blend: float) -> float:
    """Mean of the squares of the times over which the averages spread a motion, s²: T²/12 of one over T.

    A way under a steady acceleration c is ahead by half of it times c, behind the averages.
    """
    return (ramp * ramp + 2.0 * blend * blend) / 12.0


def axis_pull(ramp: float, limits: Limits, i: int) -> float:
    """Acceleration of an axis that neither exceeds its own limit nor, averaged over `ramp` seconds, that of jerk."""
    pull = limits.acceleration[i]
    if ramp > 0.0:
        pull = min(pull, 0.5 * limits.jerk[i] * ramp)
    return pull


def line_pull(contexts: Floats, record: int, n: int, limits: Limits, state: State, alone: bool) -> float:
    """Acceleration along the row at hand, from `unit`; `alone`: from rest to rest.

    Else it does not depend on the direction: then it is the same on both sides of most joints. Of a rotary axis whose
    degrees count as so many millimetres no more than one of them falls to a millimetre.
    """
    pull, weight = inf, contexts[record + ContextRecord.ROTARY_WEIGHT]
    for i in range(n):
        share = abs(state.unit[i])
        if share > 0.0:
            own = axis_pull(contexts[record + ContextRecord.RAMP_S], limits, i)
            most = 1.0 / weight if limits.rotary[i] != 0.0 and weight > 0.0 else 1.0
            pull = lowered(pull, own, share if alone else max(share, most))
    return pull


def corner_hold2(
    contexts: Floats, record: int, n: int, limits: Limits, state: State, length: float, cap2: float
) -> float:
    """Largest x up to `cap2` at the joint between two rows; lowers the joint's pull, the acceleration around it.

    A joint that no other one is near to may use what there is; else it gets the parts of one in a row. `run.lone` says
    how fast the last lone joint is passed: as long as the average sees that one, no other one may need a part.
    """
    run, pull, is_spline = state.run, state.joint.pull, state.row.kind == SPLINE or state.run.chord != 0.0
    blend, turn, bow, curved = contexts[record + ContextRecord.BLEND_S], 0.0, 0.0, False
    run.gap += run.length
    for i in range(n):
        step, before = state.unit[i] - state.tangent[i], 0.0 if run.chord != 0.0 else state.bent_before[i]
        turn = max(turn, abs(step), abs(state.bow[i]) * run.length)
        curved = curved or abs(state.bend[i]) > NO_TURN or abs(before) > NO_TURN
        if limits.rotary[i] == 0.0:
            bow += max(state.bend[i] * state.bend[i], before * before)
    bow = sqrt(bow)
    if turn <= NO_TURN and not curved and not is_spline:
        forget_bow(n, state)
        return cap2
    if run.lone > 0.0:
        left = max(run.gap / blend - run.lone, 0.0)
        cap2 = min(cap2, left * left)
    x2 = row_hold2(contexts, record, n, limits, state, length, cap2, bow, is_spline or curved)
    lone, pull_in_row, state.joint.pull = 0.0, state.joint.pull, pull
    if not is_spline:
        lone = lone_speed(contexts, record, n, limits, state, length, cap2, bow, x2)
    run.lone = run.gap = 0.0
    if lone * lone > x2:
        x2, run.lone = lone * lone, lone
    else:
        state.joint.pull = pull_in_row
    run.passed = sqrt(x2)
    return x2


def forget_bow(n: int, state: State) -> None:
    """No row of short lines goes on."""
    for i in range(n):
        state.bow[i] = 0.0


def lone_speed(
    contexts: Floats,
    record: int,
    n: int,
    limits: Limits,
    state: State,
    length: float,
    cap2: float,
    bow: float,
    enough: float,
) -> float:
    """Largest speed, its square up to `cap2`, at the joint at hand if the average sees no other one with it.

    Sets `joint.pull`. 0 where the square is no more than `enough`.

    It sees none on τ before and behind the joint, nor one that is seen with that: the next joint must be so far away
    that both can be passed so. The jerk of a corner is `Δq'·v/τ²`, that of a step of curvature `Δq''·v²/τ`, that of the
    curves themselves `κ·ω·v³` (`arc_hold`); by a change of speed come `2·q'·u/T`, `Δq'·u/τ` and `3·κ·v·u`. `bow` is κ,
    of a rotary axis its own q''.
    """
    ramp, blend = contexts[record + ContextRecord.RAMP_S], contexts[record + ContextRecord.BLEND_S]
    unit, tangent, bend, before = state.unit, state.tangent, state.bend, state.bent_before
    turn2, away = 0.0, state.run.gap / blend - state.run.passed
    v = min(sqrt(cap2), 0.5 * length / blend, away)
    if v <= 0.0 or v * v <= enough:
        return 0.0
    for i in range(n):
        if limits.rotary[i] == 0.0:
            turn2 += square(unit[i] - tangent[i])
    turn = sqrt(turn2)
    if turn > NO_TURN:
        v = min(v, contexts[record + ContextRecord.ROUNDING] / blend)
    deviates = (v * turn / 6.0 + v * v * bow * blend / 12.0) * blend
    tolerance = left_tolerance(contexts, record, max(state.run.off, state.row.off))
    v *= min(1.0, ARC_DEVIATION * tolerance / max(deviates, 1e-300))
    slow = 1.0
    for i in range(n):
        a, j = state.joint.ease * limits.acceleration[i], state.joint.ease * limits.jerk[i]
        step, change = abs(unit[i] - tangent[i]), abs(bend[i] - before[i])
        way = max(abs(unit[i]), abs(tangent[i]))
        if way > 0.0 or bend[i] != 0.0 or before[i] != 0.0:
            arc = own_bow(limits, state, i, bow)
            push = v * (step / blend + v * arc)
            asks = v * (step / blend + v * change) / blend + arc * max(arc, state.run.rate) * v * v * v
            slow = min(slow, (LONE - LONE_ALONG) * j / max(asks, 1e-300), ARC_ACROSS * a / max(push, 1e-300))
            along = LONE_ALONG * j / (2.0 * way / ramp + step / blend + 3.0 * v * arc)
            state.joint.pull = min(state.joint.pull, along, (1.0 - ARC_ACROSS) * a / max(way, 1e-3))
    return v * slow


def row_hold2(
    contexts: Floats,
    record: int,
    n: int,
    limits: Limits,
    state: State,
    length: float,
    cap2: float,
    arc: float,
    curved: bool,
) -> float:
    """Largest x up to `cap2` at a joint in a row of joints; lowers the joint's pull, the acceleration around it.

    Short lines make the axes accelerate like a curve, by the change of direction over the mean length, `bow`. What
    of that is as it was at the joint before needs no jerk: `JERK_LINES` is for what changes. `arc` is the curvature of
    arcs beside it, `curved` that one of the rows is a curve.
    """
    unit, tangent, bow, bowed = state.unit, state.tangent, state.bow, state.bowed
    blend = contexts[record + ContextRecord.BLEND_S]
    tolerance = left_tolerance(contexts, record, max(state.run.off, state.row.off))
    x2 = cap2 if not curved else min(cap2, curve_joint2(blend, tolerance, n, limits, state, arc))
    shorter, mean, turn, changes = min(length, state.run.length), 0.5 * (length + state.run.length), 0.0, 0.0
    a_mm = 1.0 / mean  # a division takes as long as ten products
    for i in range(n):
        step = unit[i] - tangent[i]
        bowed[i] = step * a_mm
        if limits.rotary[i] == 0.0:
            turn, changes = turn + step * step, changes + square(bowed[i] - bow[i])
    turn, changes, one2 = sqrt(turn), sqrt(changes), shorter * shorter / (blend * blend)
    for i in range(n):
        a, j = state.joint.ease * limits.acceleration[i], state.joint.ease * limits.jerk[i]
        part = ROW if (unit[i] - tangent[i]) * bow[i] < 0.0 else JERK_CORNER
        change = abs(bowed[i] - bow[i]) if limits.rotary[i] != 0.0 else changes
        x2 = lines_hold2(j, blend, most_bow(state, i), change, one2, mean, x2)
        x2 = step_hold2(a, part * j, blend, row_step(state, i, mean), shorter, x2)
    if turn > NO_TURN:
        rounding = contexts[record + ContextRecord.ROUNDING] / blend
        part = DEVIATION_CORNER if curved else ARC_DEVIATION
        x2 = min(x2, row_deviation2(part * tolerance / turn, shorter, blend), rounding * rounding)
    v, slow = sqrt(x2), 1.0
    ask_jerk(n, state, shorter, mean, blend, v)
    for i in range(n):
        slow = lowered(slow, ROW * state.joint.ease * limits.jerk[i], max(state.asked[i], 1e-300))
    if slow < 1.0:
        v *= slow
        ask_jerk(n, state, shorter, mean, blend, v)
    row_pull(contexts, record, n, limits, state, shorter, mean, v, arc, curved)
    for i in range(n):
        bow[i] = bowed[i]
    return v * v


def lines_hold2(
    j: float, blend: float, most: float, change: float, one2: float, mean: float, x2: float
) -> float:
    """Largest x up to `x2` by the q'' of an axis that a row of short lines makes; `change` is what changes of it.

    Up to `one2` the average sees one joint at a time.
    """
    part = JERK_LINES * j * blend
    if most * mean <= NO_TURN or one2 >= x2 or part > SURELY * x2 * most:
        return x2
    most2, cube = max(part / most, one2), JERK_CURVE * j * mean
    # What changes allows more only if it is less than all.
    if part > most2 * change and cube * cube > most2 * most2 * most2 * change * change:
        most2 = max(most2, step_top2(j, blend, change, mean, JERK_LINES, x2))
    return min(x2, most2)


def step_hold2(a: float, j: float, blend: float, step: float, shorter: float, x2: float) -> float:
    """Largest x up to `x2` by what an axis's q' changes by at a joint of a row; `j` is the jerk for that."""
    if step <= NO_TURN:
        return x2
    jump, near, asked = j * blend * blend, ROW_ACROSS * a * blend * blend, SURELY * x2 * step
    holds = jump * jump > asked * step and near * near > asked * step * blend * blend
    if holds and near * shorter > MOST_TENTS * asked * blend * blend:
        return x2
    jump, near = jump / step, near / step
    return min(x2, jump * jump, near * min(near, shorter / MOST_TENTS) / (blend * blend))


def curve_joint2(blend: float, tolerance: float, n: int, limits: Limits, state: State, arc: float) -> float:
    """Largest x at a joint in a row beside a spline or arcs of a curvature `arc`: by that, and by what it changes by.

    Lines before an arc may have its curvature already. Whether lines behind one go on with it is not known yet.
    """
    unit, bend, before, bow = state.unit, state.bend, state.bent_before, state.bow
    x2, begins = inf, 0.0
    if arc > NO_TURN:
        x2 = 12.0 * DEVIATION_CURVE * tolerance / (blend * blend * arc)
    for i in range(n):
        begins += abs(bend[i])
    for i in range(n):
        a, j = state.joint.ease * limits.acceleration[i], state.joint.ease * limits.jerk[i]
        change = abs(before[i])
        if begins > 0.0:
            change = abs(bend[i] - before[i] - bow[i])
            bow[i] = 0.0
        if change > NO_TURN:
            x2 = min(x2, JERK_ENTRY * j * blend / change)
        own = own_bow(limits, state, i, arc)
        if own > NO_TURN and (unit[i] != 0.0 or bend[i] != 0.0 or before[i] != 0.0):
            x2 = min(x2, ACROSS * a / own, (JERK_CURVE * j / (own * max(own, state.run.rate))) ** (2.0 / 3.0))
    return x2


def own_bow(limits: Limits, state: State, i: int, arc: float) -> float:
    """The curvature of arcs at the joint at hand that counts for an axis: for a rotary one that of its own way."""
    if limits.rotary[i] == 0.0:
        return arc
    return max(abs(state.bend[i]), abs(state.bent_before[i]))


def row_step(state: State, i: int, mean: float) -> float:
    """What an axis's q' changes by at the joint at hand: where it turns to the other side, with what it did before."""
    step, before = state.unit[i] - state.tangent[i], state.bow[i] * mean
    return abs(step - before) if step * before < 0.0 else abs(step)


def most_bow(state: State, i: int) -> float:
    """The largest q'' of an axis that the lines around the joint at hand make, or change of it."""
    bowed, bow = state.bowed[i], state.bow[i]
    return max(abs(bowed), abs(bow), abs(bowed - bow))


def ask_jerk(n: int, state: State, shorter: float, mean: float, blend: float, v: float) -> None:
    """Set `asked`, the jerk of each axis at a joint in a row passed at v: by the turn itself, by what changes of q''.

    Where the average sees no more than one joint before and one behind a place, those are all. Elsewhere it may see one
    more on the side of the shorter line.
    """
    is_one, more, seen, of_turn, of_bow = v * blend <= shorter, 0.0, 0.0, v / (blend * blend), 0.0
    if not is_one:
        of_bow = v * v / blend
        more = min(1.0, UNEVEN * v * blend * (1.0 / shorter - 1.0 / (2.0 * mean - shorter)))
        seen = tents(v, blend, mean)
    for i in range(n):
        turns = of_turn * row_step(state, i, mean)
        if not is_one:
            begins = of_bow * most_bow(state, i)
            turns = turns * (1.0 + more) + min(begins, v * v * abs(state.bowed[i] - state.bow[i]) * seen)
        state.asked[i] = turns


def row_deviation2(part: float, shorter: float, blend: float) -> float:
    """Largest x in a row of corners that leave the path by no more than `part` mm a unit of their turn.

    A corner leaves it by `Δq'·v·τ/6`, and less and less up to `v·τ` around it. Of corners that are `shorter` apart
    there are so many that together they leave it by `Δq'·(v²·τ²/shorter + shorter)/12` at most.
    """
    way, tau2 = 6.0 * part, blend * blend
    return way * way / tau2 if way <= shorter else (2.0 * way - shorter) * shorter / tau2


def row_pull(
    contexts: Floats,
    record: int,
    n: int,
    limits: Limits,
    state: State,
    shorter: float,
    mean: float,
    v: float,
    arc: float,
    curved: bool,
) -> None:
    """Lower the joint's pull in a row of joints that is passed at v: to what its own demands leave of each axis.

    Beside a curve, where all of the row turns to one side, to the parts that are left whatever a joint needs.
    """
    ramp, blend = contexts[record + ContextRecord.RAMP_S], contexts[record + ContextRecord.BLEND_S]
    parts, left, turns, seen = inf, state.joint.pull, False, tents(v, blend, shorter)
    of_way = 2.0 / ramp
    for i in range(n):
        a, j = state.joint.ease * limits.acceleration[i], state.joint.ease * limits.jerk[i]
        step, bow, bowed = row_step(state, i, mean), most_bow(state, i), state.bowed[i]
        way = max(abs(state.unit[i]), abs(state.tangent[i]))
        turns = turns or bowed * state.bow[i] < 0.0
        if way == 0.0 and bow == 0.0 and state.bend[i] == 0.0 and state.bent_before[i] == 0.0:
            continue  # an axis that stands needs nothing
        if curved:
            parts = min(parts, ALONG * state.joint.ease * axis_pull(ramp, limits, i))
            if step > NO_TURN:
                parts = min(parts, JERK_TURN * j * blend / step)
                if step_jerk(v, blend, abs(bowed - state.bow[i]), mean) < v * v * bow / blend:
                    parts = min(parts, JERK_BOTH * j / max(3.0 * v * bow, 1e-300))
            curvature = own_bow(limits, state, i, arc)
            if curvature > NO_TURN:
                parts = min(parts, JERK_BOTH * j / max(3.0 * v * curvature, 1e-300))
        if way > 0.0:
            asked = of_way * way + step * seen + 2.0 * bow * v
            left = lowered(left, LONE * j - state.asked[i], asked)
            left = lowered(left, a - v * step * seen, way)
    state.joint.pull = min(state.joint.pull, left if turns or not curved else parts)


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


def tents(v: float, blend: float, spacing: float) -> float:
    """Largest sum of the average's weights, 1/s, at places that are `spacing` mm apart and passed at a speed."""
    if v * blend <= spacing:
        return 1.0 / blend
    h = spacing / (v * blend)
    return min(MOST_TENTS, 1.0 + h * h / TENTS) * v / spacing


def step_jerk(v: float, blend: float, step: float, spacing: float) -> float:
    """Jerk by such steps at a speed: of one, or of as many as the average sees."""
    return v * v * step * tents(v, blend, spacing)


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


def bow_jerk(v: float, blend: float, bow: float, length: float) -> float:
    """Jerk by such a change at a speed."""
    long: float = v * bow * length / (blend * blend)
    return min(long, 2.0 * v * v * bow * (v / length + 1.0 / blend))


def arc_hold(
    contexts: Floats, record: int, limits: Limits, state: State, curvature: float, speed: float, rate: float
) -> tuple[float, float]:
    """Largest x and acceleration along an arc of a curvature κ (1/mm) that is asked to run at a speed.

    Across the path the axes accelerate by `κ·v²`, along it by u; their jerk is `2·u/T + κ·ω·v³` along the arc and
    `3·κ·v·u` across it, ω being the angle by the way (`rate`, κ but on a helix). A spiral of the growth g by a radian
    adds `g/r` of `κ·ω·v³` in any direction, and no more than half of it; where it rises too, three times as much.
    """
    ramp, blend = contexts[record + ContextRecord.RAMP_S], contexts[record + ContextRecord.BLEND_S]
    a, j, pull, twist = inf, inf, inf, curvature * max(curvature, rate)
    for k in range(3):
        i = limits.geometry[k]
        if i >= 0:
            turns = state.basis[k] != 0.0 or state.basis[3 + k] != 0.0
            if turns or (state.arc.rise != 0.0 and state.basis[6 + k] != 0.0):
                pull = min(pull, state.row.ease * axis_pull(ramp, limits, i))
            if turns:
                a, j = min(a, limits.acceleration[i]), min(j, limits.jerk[i])
    cap2 = min(
        speed * speed,
        ARC_ACROSS * a / curvature,
        12.0 * ARC_DEVIATION * contexts[record + ContextRecord.TOLERANCE] / (blend * blend * curvature),
    )
    cap2 = min(cap2, (ARC_JERK * j / twist) ** (2.0 / 3.0))
    radius = max(min(state.arc.radius, state.arc.radius + state.arc.growth), NO_TURN)
    grows = abs(state.arc.growth / state.arc.sweep) / radius
    grows = min(grows, 0.5) if state.arc.rise == 0.0 else min(3.0 * grows, 1.8)
    turning = twist * cap2 * sqrt(cap2) / j
    left = LONE - grows * turning
    along, both = 2.0 / (ramp * j), 3.0 * curvature * sqrt(cap2) / j
    both2 = along * along + both * both
    least = along * turning
    own = (sqrt(least * least + both2 * (left * left - turning * turning)) - least) / both2
    across = curvature * cap2
    return cap2, min(pull, state.row.ease * own, state.row.ease * sqrt(a * a - across * across))
