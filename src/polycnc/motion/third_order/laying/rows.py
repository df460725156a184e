"""Rows of a run with limited jerk become stretches of a path to bend; all others become pieces.

A run leads from one standstill to the next. Only when it is over is it known whether it is more than one straight row,
for such a row has averages of its own (`kernels/alone.py`): so the first row of a run waits for the next one.
"""

from __future__ import annotations

from math import ceil, cos, inf, pi, sin, sqrt

from polycnc.kernels.c_types import Structure
from polycnc.kernels.layout import Floats, Ints, record
from polycnc.motion.kernels.arcs import (
    arc_point,
    arc_top,
    asked_on_arc,
    find_arc,
    turns_faster,
)
from polycnc.motion.kernels.columns import (
    AT_END,
    CW,
    DWELL,
    EVENT,
    FEED,
    HELIX_CCW,
    RAPID,
    SPLINE,
    ContextRecord,
    Limits,
    Rows,
    State,
    square,
)
from polycnc.motion.kernels.corners import SAME_DIRECTION
from polycnc.motion.kernels.feeds import (
    axes_of,
    block_top,
    bound,
    bounded,
    counted_length,
    follows_radius,
    is_rapid,
    left_swing,
    left_tolerance,
    radius_on_line,
    straight_speed,
)
from polycnc.motion.kernels.lay import lay_row, line_top, parts_of_line, take_row
from polycnc.motion.third_order.bends.rests import must_rest
from polycnc.motion.third_order.bends.stretches import ARC, CHORD, LINE, SPLINE_TURN, Stretches
from polycnc.motion.third_order.laying.resting import is_sooner_with_rest

#: An arc's stretches turn by no more (7.5°), and leave it by no more than this part of the tolerance.
ARC_TURN, ARC_PART = pi / 24.0, 0.02
#: A cubic over an angle leaves a circle of radius 1 by so much of the angle's fourth power.
ARC_OFF = 1.0 / 384.0
#: On a stretch of an arc an axis moves by so much more of the way than at both ends at most.
ARC_MORE = 1.0022
#: A corner that is rounded from a distance on may at least be left by so much, mm.
LEAST_CORNER_MM = 1e-3
#: What the kernel stops for: every row is laid; a run is over; a run of one straight row is, which came with the chunk
#: before; stretches, or pieces, have no room.
DONE, RUN_ENDS, ROW_ENDS, NO_STRETCH, NO_PIECE = 0, 1, 2, 3, 4


@record
class RunLaid(Structure):
    """The run that is being laid.

    Attributes:
        stretches: How many it has.
        first_row: Number of its first row that moves; `rows`: how many such rows it has.
        why: What the kernel has stopped for.
        slots: How many changes of the slot are noted.
    """

    stretches: int
    first_row: int
    rows: int
    why: int
    slots: int


def lay_runs(
    rows: Rows,
    first: int,
    curves: Floats,
    number: int,
    contexts: Floats,
    limits: Limits,
    pieces: Floats,
    state: State,
    lead: State,
    path: Stretches,
    slots: Ints,
    laid: RunLaid,
) -> int:
    """Lay rows out from row `first` on, until something must be done with what is laid.

    Args:
        rows: The chunk's columns.
        first: Row to begin with.
        curves: The chunk's curve parameters.
        number: Number of the chunk's first row in the toolpath.
        contexts: Table of contexts.
        limits: The machine.
        pieces: Room for pieces of rows that are no such run.
        state: Carried from call to call, for pieces.
        lead: The same for stretches.
        path: Room for stretches; `way` and `place` begin with those of the run's start.
        slots: Room for pairs: from which row on times count in another slot, and in which.
        laid: The run.

    Returns:
        The next row to lay; `laid.why` says why it is not laid yet.
    """
    n = axes_of(lead)
    laid.why = DONE
    for row in range(first, len(rows.kind)):
        kind = rows.kind[row]
        if kind in (EVENT, DWELL):
            if kind == DWELL or rows.stops[rows.curve[row]] != 0:
                lead.run.stop = 1.0
            if not lay_row(rows, row, curves, number, contexts, limits, pieces, state):
                return row
            continue
        takes = goes_by_law(kind, rows.context[row] * (ContextRecord.OFFSETS + n), contexts, limits)
        if takes and laid.stretches > 0:
            if add_row(rows, row, curves, number, contexts, limits, lead, path, slots, laid):
                continue
            if laid.why == NO_STRETCH:
                return row
        if laid.stretches > 0 and not end_run(rows, curves, number, contexts, limits, pieces, state, laid):
            return row
        if takes:
            begin_run(n, path, state, lead, laid)
            if not add_row(rows, row, curves, number, contexts, limits, lead, path, slots, laid):
                return row
        elif not lay_row(rows, row, curves, number, contexts, limits, pieces, state):
            laid.why = NO_PIECE
            return row
    return len(rows.kind)


def goes_by_law(kind: int, record: int, contexts: Floats, limits: Limits) -> bool:
    """Whether a move is of a run whose path is bent by its way: all others have averages, or no limit of jerk.

    Those are threads, taps and skip moves, rapids that stand or on which each axis runs alone.
    """
    if contexts[record + ContextRecord.BY_WAY] == 0.0:
        return False
    if kind == RAPID:
        return contexts[record + ContextRecord.RAPID_BY_AXIS] == 0.0 and limits.path.rapid_stops == 0.0
    return FEED <= kind <= SPLINE


def begin_run(n: int, path: Stretches, state: State, lead: State, laid: RunLaid) -> None:
    """A run begins where the axes are."""
    laid.stretches = laid.rows = laid.slots = 0
    laid.first_row = -1
    lead.run.stop = lead.run.corner_ease = 0.0
    lead.run.without_feed = lead.run.standing_spindle = 0
    path.way[0] = 0.0
    for i in range(n):
        lead.position[i] = path.place[i] = state.position[i]


def end_run(
    rows: Rows,
    curves: Floats,
    number: int,
    contexts: Floats,
    limits: Limits,
    pieces: Floats,
    state: State,
    laid: RunLaid,
) -> bool:
    """The axes rest behind the last row. One straight row becomes a piece; else `laid.why` says what must be done."""
    if laid.rows > 1 or laid.stretches > 1:
        laid.why = RUN_ENDS
        return False
    if laid.first_row < number:
        laid.why = ROW_ENDS
        return False
    state.run.stop = 1.0
    if not lay_row(rows, laid.first_row - number, curves, number, contexts, limits, pieces, state):
        laid.why = NO_PIECE
        return False
    state.run.stop = 1.0
    laid.stretches = laid.rows = 0
    return True


def add_row(
    rows: Rows,
    row: int,
    curves: Floats,
    number: int,
    contexts: Floats,
    limits: Limits,
    lead: State,
    path: Stretches,
    slots: Ints,
    laid: RunLaid,
) -> bool:
    """Let a run go on along a row; false where the axes rest before it, or where there is no room."""
    n, record = axes_of(lead), take_row(rows, row, curves, number, contexts, limits, lead)
    length, weight = counted_length(contexts, record, n, limits, lead)
    kind, before = lead.row.kind, laid.stretches
    if 2 * laid.slots + 2 > len(slots):
        laid.why = NO_STRETCH
        return False
    if before > 0:
        other = lead.run.metric != weight and length > 0.0
        if lead.run.stop != 0.0 or other or contexts[record + ContextRecord.STATION] != lead.run.station:
            return False
    is_arc = CW <= kind <= HELIX_CCW and lead.row.curve >= 0.0
    if is_arc and find_arc(curves, contexts, record, limits, lead):
        added = add_arc(curves, contexts, record, n, limits, lead, path, laid)
    elif length == 0.0:
        return True
    else:
        added = add_line(curves, contexts, record, n, limits, lead, path, laid, length, weight)
    if not added:
        return False
    if laid.slots == 0 or slots[2 * laid.slots - 1] != lead.row.slot:
        slots[2 * laid.slots], slots[2 * laid.slots + 1] = lead.row.number, lead.row.slot
        laid.slots += 1
    if laid.rows == 0:
        laid.first_row = lead.row.number
    laid.rows += 1
    for i in range(n):
        lead.position[i] = lead.target[i]
    lead.run.station, lead.run.metric = contexts[record + ContextRecord.STATION], weight
    lead.run.stop = contexts[record + ContextRecord.EXACT_STOP]
    lead.run.corner_ease, lead.run.length = (
        lead.share_ease[AT_END],
        path.way[laid.stretches] - path.way[before],
    )
    return True


def add_line(
    curves: Floats,
    contexts: Floats,
    record: int,
    n: int,
    limits: Limits,
    lead: State,
    path: Stretches,
    laid: RunLaid,
    length: float,
    weight: float,
) -> bool:
    """A line, or a chord of a spline; in parts where the spindle's speed follows the radius."""
    parts = parts_of_line(contexts, record, limits, lead)
    if laid.stretches + parts > len(path.form):
        laid.why = NO_STRETCH
        return False
    top = line_top(contexts, record, n, limits, lead, length)
    form = CHORD if lead.row.kind == SPLINE else LINE
    speed = wanted = 0.0
    for part in range(parts):
        e = laid.stretches + part
        put_stretch(contexts, record, lead, path, e, form, length / parts)
        for i in range(n):
            path.leave[e * n + i] = path.arrive[e * n + i] = lead.unit[i]
            path.place[(e + 1) * n + i] = lead.position[i] + (part + 1) / parts * lead.delta[i]
        radius = radius_on_line(contexts, record, limits, lead, (part + 0.5) / parts)
        asked = straight_speed(curves, contexts, record, lead, length, radius, weight)
        if part == 0:
            if not meets(contexts, record, n, path, e):
                return False
            share_corner(lead, n, path, e)
            bound_corner(contexts, record, n, limits, lead, path, e, length)
            wanted = (min(top, asked) if asked > 0.0 else top) if form == LINE and parts == 1 else 0.0
            if e > 0 and wanted > 0.0 and is_sooner_with_rest(n, limits, lead, path, e, wanted):
                return False
        speed = min(top, bounded(asked, lead) if part == 0 else bound(asked, lead))
        path.cap2[e] = speed * speed
    end_stretches(n, lead, path, laid, parts, wanted)
    return True


def add_arc(
    curves: Floats,
    contexts: Floats,
    record: int,
    n: int,
    limits: Limits,
    lead: State,
    path: Stretches,
    laid: RunLaid,
) -> bool:
    """An arc, helix or spiral, in parts of equal angle."""
    sweep, weight = lead.arc.sweep, contexts[record + ContextRecord.ROTARY_WEIGHT]
    largest = max(lead.arc.radius, lead.arc.radius + lead.arc.growth)
    tolerance = contexts[record + ContextRecord.TOLERANCE]
    step = min(ARC_TURN / turns_faster(lead), sqrt(sqrt(ARC_PART * tolerance / (ARC_OFF * largest))))
    parts = max(ceil(sweep / step - 1e-9), 1)
    if laid.stretches + parts > len(path.form):
        laid.why = NO_STRETCH
        return False
    end_way = arc_point(sweep, n, limits, weight, lead)
    way = arc_point(0.0, n, limits, weight, lead)
    length = 0.5 * (way + end_way) * sweep
    top = min(limits.path.path_feed, lead.row.top, block_top(length, limits, lead))
    top = min(top, arc_top(contexts, record, way, end_way, limits, lead))
    speed, follows = 0.0, follows_radius(contexts, record, lead)
    for part in range(parts):
        e, first, last = laid.stretches + part, part * sweep / parts, (part + 1) * sweep / parts
        for i in range(n):
            path.leave[e * n + i] = lead.unit[i]
        middle_way = way
        if lead.arc.growth != 0.0:
            middle_way = arc_point(0.5 * (first + last), n, limits, weight, lead)
        next_way = arc_point(last, n, limits, weight, lead)
        put_stretch(
            contexts,
            record,
            lead,
            path,
            e,
            ARC,
            (way + 4.0 * middle_way + next_way) / 6.0 * (last - first),
        )
        for i in range(n):
            path.arrive[e * n + i] = lead.unit[i]
        put_arc_place(last, n, limits, lead, path.place, (e + 1) * n)
        if part == 0:
            if not meets(contexts, record, n, path, e):
                return False
            share_corner(lead, n, path, e)
            bound_corner(contexts, record, n, limits, lead, path, e, length)
        if part == 0 or follows:
            asked = asked_on_arc(curves, contexts, record, limits, lead, length, (part + 0.5) / parts)
            speed = bounded(asked, lead) if part == 0 else bound(asked, lead)
        own = min(speed, top, axes_top(n, limits, path, e))
        path.cap2[e] = own * own
        way = next_way
    end_stretches(n, lead, path, laid, parts, 0.0)
    return True


def end_stretches(n: int, lead: State, path: Stretches, laid: RunLaid, parts: int, wanted: float) -> None:
    """A row has become so many stretches; `wanted` is its speed if it is a straight one."""
    laid.stretches += parts
    lead.run.wanted = wanted
    for i in range(n):
        path.place[laid.stretches * n + i] = lead.target[i]


def axes_top(n: int, limits: Limits, path: Stretches, e: int) -> float:
    """Highest speed along a stretch of an arc by that of the axes in cuts."""
    top = inf
    for i in range(n):
        share = ARC_MORE * max(abs(path.leave[e * n + i]), abs(path.arrive[e * n + i]))
        if share > 0.0:
            top = min(top, limits.top_feed[i] / share)
    return top


def put_arc_place(angle: float, n: int, limits: Limits, lead: State, out: Floats, at: int) -> None:
    """Write the place of the arc at hand at an angle."""
    sweep = lead.arc.sweep
    for i in range(n):
        out[at + i] = lead.position[i] + angle / sweep * lead.delta[i]
    radius = lead.arc.radius + lead.arc.growth / sweep * angle
    c, s = radius * cos(angle) - lead.arc.radius, radius * sin(angle)
    for j in range(3):
        i = limits.geometry[j]
        if i >= 0:
            out[at + i] = lead.position[i] + (
                c * lead.basis[j] + s * lead.basis[3 + j] + lead.arc.rise * angle / sweep * lead.basis[6 + j]
            )


def put_stretch(
    contexts: Floats, record: int, lead: State, path: Stretches, e: int, form: int, length: float
) -> None:
    """Write what does not depend on where stretch e lies."""
    path.way[e + 1] = path.way[e] + length
    path.form[e], path.row[e] = form, lead.row.number
    tolerance, turns = (
        left_tolerance(contexts, record, lead.row.off),
        contexts[record + ContextRecord.TURN_TOLERANCE],
    )
    path.ease[e], path.step2[e], path.spread2[e] = lead.row.ease, inf, inf
    path.left2[e] = square(lead.row.top)
    if turns == 0.0:
        turns = left_swing(contexts, record, lead.row.off, lead.row.swung)
    path.tolerance[e], path.turn_tolerance[e] = tolerance, turns


def meets(contexts: Floats, record: int, n: int, path: Stretches, e: int) -> bool:
    """Whether the path goes on into stretch e without a rest; a corner may be rounded from a distance on alone."""
    if e == 0:
        return True
    rounding, turning = (
        contexts[record + ContextRecord.ROUNDING],
        contexts[record + ContextRecord.TURN_DISTANCE],
    )
    if rounding < inf or turning > 0.0:
        shorter = min(path.way[e] - path.way[e - 1], path.way[e + 1] - path.way[e])
        line2, turn = 0.0, 0.0
        for i in range(n):
            step = abs(path.leave[e * n + i] - path.arrive[(e - 1) * n + i])
            if path.rotary[i] != 0.0:
                turn = max(turn, step)
            else:
                line2 += step * step
        if rounding < inf:
            most = max(sqrt(line2) * min(rounding, 0.5 * shorter) / 6.0, LEAST_CORNER_MM)
            path.tolerance[e], path.tolerance[e - 1] = (
                min(path.tolerance[e], most),
                min(path.tolerance[e - 1], most),
            )
        if turning > 0.0 and turn > 0.0:
            most = max(turn * min(turning, 0.5 * shorter) / 6.0, LEAST_CORNER_MM)
            path.turn_tolerance[e] = min(path.turn_tolerance[e], most)
            path.turn_tolerance[e - 1] = min(path.turn_tolerance[e - 1], most)
    return not must_rest(path, e, n)


def share_corner(lead: State, n: int, path: Stretches, e: int) -> None:
    """Before stretch e the path turns: there axes move along both stretches that are limited in one of them alone."""
    turned = 0.0
    for i in range(n if e > 0 else 0):
        turned = max(turned, abs(path.leave[e * n + i] - path.arrive[(e - 1) * n + i]))
    if turned > SAME_DIRECTION:
        path.ease[e] = min(path.ease[e], lead.joint.ease)
        path.ease[e - 1] = min(path.ease[e - 1], lead.joint.ease)


def bound_corner(
    contexts: Floats,
    record: int,
    n: int,
    limits: Limits,
    lead: State,
    path: Stretches,
    e: int,
    length: float,
) -> None:
    """Bound the speed at the corner between two cuts, at which stretch e begins, a row of a length.

    The velocity of no axis changes by more than parameters allow; spread over the shorter of the two rows, the change
    is an acceleration, which they bound too (`corners.stepped2`). Chords of one spline have no corner.
    """
    if e == 0 or is_rapid(lead) or contexts[record + ContextRecord.AHEAD] == 0.0:
        return
    step2, spread2, turn2 = inf, inf, 0.0
    shorter = min(length, lead.run.length)
    for i in range(n):
        step = abs(path.leave[e * n + i] - path.arrive[(e - 1) * n + i])
        turn2 += 0.0 if limits.rotary[i] != 0.0 else step * step
        if step > SAME_DIRECTION:
            step2 = min(step2, square(limits.step[i] / step))
            spread2 = min(spread2, limits.bend[i] * shorter / step)
    if path.form[e] == CHORD and path.form[e - 1] == CHORD and turn2 <= square(SPLINE_TURN):
        return
    path.step2[e], path.spread2[e] = step2, max(spread2, square(limits.path.bend_least))
