"""What bounds a row, by the functions with which the planner lays it out."""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.explain.kernels.held import SAME, WHOLE, Held, Note
from polycnc.motion.kernels.arcs import arc_point, arc_top, asked_on_arc, facing_radius, find_arc
from polycnc.motion.kernels.columns import (
    AT_END,
    CW,
    DWELL,
    EVENT,
    HELIX_CCW,
    SKIP,
    SPLINE,
    TAP,
    THREAD,
    ContextRecord,
    Limits,
    Rows,
    State,
    square,
)
from polycnc.motion.kernels.corners import SAME_DIRECTION, jump2, rounded2, turned2
from polycnc.motion.kernels.feeds import (
    axes_of,
    block_top,
    counted_length,
    follows_radius,
    is_rapid,
    lead_of,
    radius_on_line,
    straight_speed,
)
from polycnc.motion.kernels.jerk import ARC_DEVIATION, MOST_TENTS, NO_TURN, ROW_ACROSS, row_deviation2
from polycnc.motion.kernels.lay import take_row


def note_rows(
    rows: Rows,
    first: int,
    curves: Floats,
    number: int,
    contexts: Floats,
    limits: Limits,
    state: State,
    known: int,
    after: int,
    notes: Floats,
    origin: int,
) -> None:
    """Note what bounds rows from row `first` on.

    Args:
        rows: The rows as the planner lays them out.
        first: Row to begin with.
        curves: Their curve parameters.
        number: Number of the first of `rows` in the toolpath.
        contexts: Table of contexts.
        limits: The machine.
        state: Of these kernels alone: where the path is, and its direction there.
        known: Number of the limits in the account's table.
        after: The rows are accelerated after the interpolation (1).
        notes: `Note` by `Note`.
        origin: Row whose note is the first.
    """
    for row in range(first, len(rows.kind)):
        if rows.kind[row] == EVENT or rows.kind[row] == DWELL:
            if rows.kind[row] == DWELL or rows.stops[rows.curve[row]] != 0:
                state.run.stop = 1.0
            continue
        at = (number + row - origin) * Note.SIZE
        record = take_row(rows, row, curves, number, contexts, limits, state)
        notes[at + Note.RECORD], notes[at + Note.KIND] = record, state.row.kind
        notes[at + Note.LIMITS], notes[at + Note.AFTER] = known, after
        notes[at + Note.EASE], notes[at + Note.TOP] = state.row.ease, state.row.top
        notes[at + Note.SHARED] = 0.0
        if state.row.shares > 1.0:
            notes[at + Note.TOP], notes[at + Note.SHARED] = state.share_top[0], 1.0
        moves = note_row(curves, contexts, record, limits, state, notes, at)
        note_stops(contexts, record, limits, state, moves, notes, at)
        if is_rapid(state):
            notes[at + Note.PATH], notes[at + Note.RAPID], notes[at + Note.AFTER] = inf, 1.0, 0.0
        for i in range(axes_of(state)):
            state.position[i] = state.target[i]
        if moves:
            state.run.ease = state.share_ease[max(state.row.shares - 1, 0)]
            state.run.corner_ease = state.share_ease[AT_END]


def note_stops(
    contexts: Floats, record: int, limits: Limits, state: State, moves: bool, notes: Floats, at: int
) -> None:
    """Note whether the axes rest before the row at hand, and whether behind it; a row of no way changes nothing."""
    kind, rapid = state.row.kind, is_rapid(state)
    stands = kind in (TAP, SKIP) or (rapid and limits.path.rapid_stops != 0.0)
    by_axis = rapid and contexts[record + ContextRecord.RAPID_BY_AXIS] != 0.0
    changes = contexts[record + ContextRecord.STATION] != state.run.station
    notes[at + Note.STOP] = 1.0 if stands or by_axis or changes else state.run.stop
    stands = stands or by_axis or contexts[record + ContextRecord.EXACT_STOP] != 0.0
    state.run.station = contexts[record + ContextRecord.STATION]
    if moves or stands:
        state.run.stop = 1.0 if stands else 0.0
    elif changes:
        state.run.stop = 1.0


def note_row(
    curves: Floats, contexts: Floats, record: int, limits: Limits, state: State, notes: Floats, at: int
) -> bool:
    """Note the speeds that bound the row at hand, and those of its joint; whether it moves."""
    n, kind, weight = axes_of(state), state.row.kind, contexts[record + ContextRecord.ROTARY_WEIGHT]
    follows, radius, length, end_way = follows_radius(contexts, record, state), 0.0, 0.0, 0.0
    notes[at + Note.PATH], notes[at + Note.ARC], notes[at + Note.RAPID] = limits.path.path_feed, inf, 0.0
    notes[at + Note.PLANAR] = 0.0
    arc = (CW <= kind <= HELIX_CCW or kind == THREAD) and state.row.curve >= 0.0
    if arc and find_arc(curves, contexts, record, limits, state):
        end_way = arc_point(state.arc.sweep, n, limits, weight, state)
        way = arc_point(0.0, n, limits, weight, state)
        length, radius = (
            0.5 * (way + end_way) * state.arc.sweep,
            facing_radius(0.5 * state.arc.sweep, limits, state),
        )
        asked = asked_on_arc(curves, contexts, record, limits, state, length, 0.5)
        notes[at + Note.ARC] = arc_top(contexts, record, way, end_way, limits, state)
        notes[at + Note.PLANAR] = (state.arc.radius + 0.5 * state.arc.growth) * state.arc.sweep / length
    else:
        length, weight = counted_length(contexts, record, n, limits, state)
        radius = radius_on_line(contexts, record, limits, state, 0.5)
        asked = straight_speed(curves, contexts, record, state, length, radius, weight)
        for i in range(n):
            state.unit[i], state.bend[i] = state.delta[i] / length if length > 0.0 else 0.0, 0.0
        turns = weight != contexts[record + ContextRecord.ROTARY_WEIGHT]
        if (
            turns
            and contexts[record + ContextRecord.TURN_SPEED] > 0.0
            and not is_rapid(state)
            and contexts[record + ContextRecord.INVERSE_TIME] == 0.0
        ):
            notes[at + Note.PATH], asked = asked, inf
    notes[at + Note.ASKED], notes[at + Note.BLOCK] = asked, block_top(length, limits, state)
    follows = follows and limits.geometry[0] >= 0
    notes[at + Note.RADIUS] = max(abs(radius), SAME) if follows else 0.0
    if follows:
        notes[at + Note.COLUMN] = limits.geometry[0]
        notes[at + Note.FACING] = state.row.facing - state.target[limits.geometry[0]]
    notes[at + Note.TAP_PULL] = 0.0
    if kind == TAP:
        lead = lead_of(curves, state)
        notes[at + Note.TAP_PULL] = lead * contexts[record + ContextRecord.SPINDLE_REV_S2]
    if length > 0.0:
        state.run.stop = 1.0 if state.run.metric != weight else state.run.stop
        state.run.metric = weight
        note_joint(contexts, record, n, limits, state, length, notes, at)
        if end_way > 0.0:
            arc_point(state.arc.sweep, n, limits, weight, state)
        for i in range(n):
            state.tangent[i] = state.unit[i]
        state.run.length = length
    return length > 0.0


def note_joint(
    contexts: Floats, record: int, n: int, limits: Limits, state: State, length: float, notes: Floats, at: int
) -> None:
    """Note what bounds the joint between the row before and the row at hand, which starts along `unit`."""
    shorter, x2, cause, axis = min(length, state.run.length), inf, int(Held.CORNERS), WHOLE
    if contexts[record + ContextRecord.AHEAD] != 0.0 and not is_rapid(state):
        least2 = square(limits.path.bend_least)
        for i in range(n):
            step = abs(state.unit[i] - state.tangent[i])
            if step > SAME_DIRECTION:
                step2, pull2 = square(limits.step[i] / step), max(limits.bend[i] * shorter / step, least2)
                if step2 < x2:
                    x2, cause, axis = step2, int(Held.CORNER_STEP), i
                if pull2 < x2:
                    x2, cause, axis = pull2, int(Held.LINE_PULL), i
    notes[at + Note.STEP2], notes[at + Note.JOINT], notes[at + Note.JOINT_AXIS] = x2, cause, axis
    notes[at + Note.CORNER2] = notes[at + Note.PULL2] = 0.0
    soft = contexts[record + ContextRecord.RAMP_S] > 0.0
    if soft:
        notes[at + Note.CORNER2] = by_tolerance2(contexts, record, n, limits, state, shorter)
    if soft or state.row.kind == SPLINE:
        note_axes(contexts, record, n, limits, state, shorter, notes, at)


def by_tolerance2(
    contexts: Floats, record: int, n: int, limits: Limits, state: State, shorter: float
) -> float:
    """Largest x at the joint at hand by what the averages may deviate, and by the corner itself."""
    tolerance, rounding, blend = (
        contexts[record + ContextRecord.TOLERANCE],
        contexts[record + ContextRecord.ROUNDING],
        contexts[record + ContextRecord.BLEND_S],
    )
    angle, distance = (
        contexts[record + ContextRecord.TURN_TOLERANCE],
        contexts[record + ContextRecord.TURN_DISTANCE],
    )
    turns, turn2 = not (angle > 0.0 or distance > 0.0), 0.0
    for i in range(n):
        if limits.rotary[i] == 0.0:
            turn2 += square(state.unit[i] - state.tangent[i])
    if tolerance > 0.0:
        x2 = rounded2(tolerance, rounding, turns, n, limits, state, shorter, inf)
    else:
        x2 = jump2(turns, n, limits, state, shorter)
    if not turns:
        x2 = min(x2, turned2(angle, distance, n, limits, state, shorter))
    if turn2 > square(NO_TURN) and blend > 0.0:
        part = ARC_DEVIATION * tolerance / sqrt(turn2)
        x2 = min(x2, row_deviation2(part, shorter, blend), square(rounding / blend))
    return x2


def note_axes(
    contexts: Floats,
    record: int,
    n: int,
    limits: Limits,
    state: State,
    shorter: float,
    notes: Floats,
    at: int,
) -> None:
    """Note which axis needs most of its acceleration at the joint at hand, and which of its jerk.

    At a corner the averages have the acceleration (`step_hold2`); along a spline it is that of its curve.
    """
    blend2, x2, most = square(contexts[record + ContextRecord.BLEND_S]), inf, 0.0
    notes[at + Note.PULL_AXIS] = notes[at + Note.JERK_AXIS] = WHOLE
    for i in range(n):
        step, pull = abs(state.unit[i] - state.tangent[i]), state.joint.ease * limits.acceleration[i]
        if step > NO_TURN:
            own2 = pull * shorter / step
            if state.row.kind != SPLINE:
                near = ROW_ACROSS * pull * blend2 / step
                own2 = near * min(near, shorter / MOST_TENTS) / blend2 if blend2 > 0.0 else inf
            if own2 < x2:
                x2, notes[at + Note.PULL_AXIS] = own2, i
            if step > most * limits.jerk[i]:
                most, notes[at + Note.JERK_AXIS] = step / limits.jerk[i], i
    notes[at + Note.PULL2] = x2
