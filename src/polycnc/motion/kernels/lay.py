"""Rows of a toolpath become pieces; straight ones here, arcs in `arcs.py`."""

from __future__ import annotations

from math import inf

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.alone import alone_pull, alone_top, best_ramp, goes_straight_on, settle_alone
from polycnc.motion.kernels.arcs import find_arc, lay_arc
from polycnc.motion.kernels.chords import end_chord, lay_chord, part_chord
from polycnc.motion.kernels.columns import (
    AT_END,
    AT_START,
    CURVE_WIDTH,
    CW,
    DWELL,
    EVENT,
    FACING_PIECES,
    FEED,
    HELIX_CCW,
    MOST_OFF,
    MOST_SWUNG,
    OPEN,
    PLACES,
    SHARES,
    SKIP,
    SPLINE,
    SWUNG,
    TAP,
    THREAD,
    ContextRecord,
    Form,
    Limits,
    PieceRecord,
    Rows,
    State,
    lowered,
    piece_width,
)
from polycnc.motion.kernels.corners import goes_on_smoothly, join
from polycnc.motion.kernels.feeds import (
    asked_speed,
    axes_of,
    block_top,
    bound,
    bounded,
    counted_length,
    drive_factor,
    has_room,
    is_rapid,
    lagging_pull,
    lead_of,
    next_piece,
    norm,
    open_joint,
    place,
    radius_on_line,
    straight_speed,
)
from polycnc.motion.kernels.hold import hold
from polycnc.motion.kernels.jerk import line_pull, window_s
from polycnc.motion.kernels.leads import follow_leads
from polycnc.motion.kernels.led import is_led, lay_led
from polycnc.motion.kernels.rounding import round_joint
from polycnc.motion.kernels.speeds import straight_time


def lay(
    rows: Rows,
    first: int,
    curves: Floats,
    number: int,
    contexts: Floats,
    limits: Limits,
    pieces: Floats,
    state: State,
) -> int:
    """Lay rows out as pieces from row `first` on.

    Args:
        rows: The chunk's columns.
        first: Row to begin with.
        curves: The chunk's curve parameters.
        number: Number of the chunk's first row in the toolpath.
        contexts: Table of contexts.
        limits: The machine.
        pieces: Room for pieces.
        state: Carried from call to call.

    Returns:
        The next row to lay: behind the last, or one for which there was no room.
    """
    for row in range(first, len(rows.kind)):
        if not lay_row(rows, row, curves, number, contexts, limits, pieces, state):
            return row
    return len(rows.kind)


def lay_row(
    rows: Rows,
    row: int,
    curves: Floats,
    number: int,
    contexts: Floats,
    limits: Limits,
    pieces: Floats,
    state: State,
) -> bool:
    """Lay one row out, as `lay` does; false when there is no room: it can then be tried again."""
    kind = rows.kind[row]
    if kind == EVENT:
        if rows.stops[rows.curve[row]] != 0:
            rest(state)
        return True
    if kind == DWELL:
        rest(state)
        return True
    n, record = axes_of(state), take_row(rows, row, curves, number, contexts, limits, state)
    state.joint.top2, led, before = inf, is_led(contexts, record, limits, state), state.run.pieces
    if not led and state.run.corner_top2 > 0.0:
        state.joint.top2 = state.run.corner_top2
        state.run.exit2 = min(state.run.exit2, state.run.corner_top2)
    if not lay_move(curves, contexts, record, n, limits, pieces, state):
        return False
    if state.run.pieces > before:
        state.run.ease = state.share_ease[max(state.row.shares - 1, 0)]
        state.run.corner_ease = state.share_ease[AT_END]
        state.run.corner_reach = state.share_end[AT_END] * state.run.length
        state.run.corner_top2 = state.run.corner_top2 if led else 0.0
    return True


def take_row(
    rows: Rows, row: int, curves: Floats, number: int, contexts: Floats, limits: Limits, state: State
) -> int:
    """Make a move the row at hand, and set where it leads; where the record of its context begins."""
    n, kind = axes_of(state), int(rows.kind[row])
    record: int = rows.context[row] * (ContextRecord.OFFSETS + n)
    if kind == THREAD and state.row.kind != THREAD:
        state.run.stop = 1.0  # the axes wait for the spindle's zero mark
    if kind == FEED and contexts[record + ContextRecord.CHORDS] != 0.0:
        kind = SPLINE
    state.row.kind, state.row.number, state.row.feed = kind, number + row, rows.feed[row]
    state.row.curve = rows.curve[row] * CURVE_WIDTH
    take_shares(rows, row, state)
    state.row.slot = 2 * rows.context[row] + (0 if is_rapid(state) else 1)
    aim(rows.end, row * n, contexts, record, n, limits, state)
    state.row.off = state.row.swung = 0.0
    if kind == FEED and rows.curve[row] >= 0:
        lead_beside(curves, limits, state)
    return record


def lead_beside(curves: Floats, limits: Limits, state: State) -> None:
    """Move the end of the row at hand by what its curve parameters say (`toolpath/fairing.py`)."""
    at = state.row.curve
    for j in range(3):
        axis = limits.geometry[j]
        if axis >= 0:
            state.target[axis] += curves[at + j]
            state.delta[axis] += curves[at + j]
    k, end = at + SWUNG, at + MOST_SWUNG
    for i in range(axes_of(state)):
        if limits.rotary[i] != 0.0 and k < end:
            state.target[i] += curves[k]
            state.delta[i] += curves[k]
            k += 1
    state.row.off, state.row.swung = curves[at + MOST_OFF], curves[end]


def rest(state: State) -> None:
    """The axes stand before the next row, which overlaps with nothing."""
    state.run.stop, state.run.overlap, state.run.rapid_overlap = 1.0, 0.0, 0.0


def take_shares(rows: Rows, row: int, state: State) -> None:
    """Set speed, factors and shares of the row at hand."""
    state.row.shares, state.row.top, state.share_ease[0] = 0, inf, 1.0
    state.share_ease[AT_START] = state.share_ease[AT_END] = 1.0
    state.share_end[AT_START] = state.share_end[AT_END] = 1.0
    if len(rows.share) > 0:
        first, count = row * SHARES, 1
        while rows.share[first + count - 1] < 1.0:
            count += 1
        for k in range(count):
            state.share_end[k] = rows.share[first + k]
            state.share_top[k] = rows.top[first + k]
            state.share_ease[k] = rows.ease[first + k]
        state.row.shares = count
        for k in range(AT_START, AT_END + 1):
            state.share_ease[k], state.share_end[k] = rows.ease[first + k], rows.share[first + k]
        state.row.top = state.share_top[0] if count == 1 else inf
        eased = min(state.share_ease[0], state.share_ease[AT_START], state.share_ease[AT_END]) < 1.0
        if count == 1 and state.row.top == inf and not eased:
            state.row.shares = 0  # nothing bounds it: it only stands beside rows that something does
    own, before = state.share_ease[AT_START], state.run.corner_ease
    state.row.ease, state.joint.ease = state.share_ease[0], min(own, before) if before > 0.0 else own


def aim(end: Floats, at: int, contexts: Floats, record: int, n: int, limits: Limits, state: State) -> None:
    """Set `target` to the machine position of a row's end, `delta` to the way there, `facing` to its X."""
    target = state.target
    for i in range(n):
        target[i] = end[at + i]
    if contexts[record + ContextRecord.HAS_FRAME] != 0.0:
        for j in range(3):
            axis = limits.geometry[j]
            if axis >= 0:
                value = contexts[record + ContextRecord.FRAME + 9 + j]
                for k in range(3):
                    other = limits.geometry[k]
                    if other >= 0:
                        value += contexts[record + ContextRecord.FRAME + 3 * j + k] * end[at + other]
                target[axis] = value
    for i in range(n):
        target[i] += contexts[record + ContextRecord.OFFSETS + i]
        state.delta[i] = target[i] - state.position[i]
    facing = limits.geometry[0]
    state.row.facing = end[at + facing] if facing >= 0 else 0.0


def lay_move(
    curves: Floats, contexts: Floats, record: int, n: int, limits: Limits, pieces: Floats, state: State
) -> bool:
    """Lay the row at hand out; false when the room ends: it can then be tried again."""
    kind, first, state.joint.bend_way = state.row.kind, state.run.pieces, 0.0
    exit2 = state.run.exit2
    state.joint.turn_way = 0.0
    if first == 0:
        state.run.chord = 0.0
    not_held = first - (1 if state.run.chord != 0.0 else 0)
    is_whole, ease = state.run.smooth != 0.0 and state.run.window == 0.0, state.run.chord_ease
    rapid = is_rapid(state)
    stands = kind in (TAP, SKIP) or (rapid and limits.path.rapid_stops != 0.0)
    if stands or contexts[record + ContextRecord.STATION] != state.run.station:
        state.run.stop = 1.0
    arc = (CW <= kind <= HELIX_CCW or kind == THREAD) and state.row.curve >= 0.0
    if arc and find_arc(curves, contexts, record, limits, state):
        done = lay_arc(curves, contexts, record, n, limits, pieces, state)
    elif rapid and contexts[record + ContextRecord.RAPID_BY_AXIS] != 0.0:
        done = lay_rapid_by_axis(contexts, record, n, limits, pieces, state)
    elif is_led(contexts, record, limits, state):
        done = lay_led(curves, contexts, record, n, limits, pieces, state)
    else:
        done = lay_straight(curves, contexts, record, n, limits, pieces, state)
    if not done:
        return False
    if state.run.pieces > first:
        if kind == THREAD:
            first += follow_leads(curves, contexts, record, exit2, first, limits, pieces, state)
        overlap(contexts, record, pieces, first, n, limits, state)
    stands = stands or contexts[record + ContextRecord.EXACT_STOP] != 0.0
    if stands and state.run.pieces > first:
        state.run.stop = 1.0
        end_chord(pieces, n, limits, state)
    if contexts[record + ContextRecord.RAMP_S] > 0.0:
        hold(pieces, not_held, n, state)
    else:
        if is_whole and state.run.pieces > first:
            first += part_chord(pieces, first - 1, n, limits, state, ease)
        round_joint(pieces, first, n, limits, state)
    for i in range(n):
        state.position[i] = state.target[i]
    state.run.station = contexts[record + ContextRecord.STATION]
    state.run.off, state.run.swung = state.row.off, state.row.swung
    state.run.row_top, state.run.speed_left = state.row.top, contexts[record + ContextRecord.SPEED_LEFT]
    if state.row.shares > 1:
        state.run.row_top = state.share_top[state.row.shares - 1]
    if stands:
        state.run.stop = 1.0
    return True


def overlap(
    contexts: Floats, record: int, pieces: Floats, first: int, n: int, limits: Limits, state: State
) -> None:
    """A stroke of a cycle, or a rapid, may begin while the averages of the one before come to rest (FANUC 1681).

    The axes' accelerations add up to no more than either stroke's: the sum is the average of what both ask for. So
    does their jerk where an axis turns round; on one that goes on in its sense the jerk of both adds up, as behind the
    filters of a control. The row's pieces begin at `first`.
    """
    width, kind, rapid = piece_width(n), contexts[record + ContextRecord.OVERLAP], is_rapid(state)
    way = state.run.overlap
    if kind < 0.0:
        way = state.run.rapid_overlap if rapid else 0.0
    if way > 0.0 and first > 0 and contexts[record + ContextRecord.STATION] == state.run.station:
        pieces[first * width + PieceRecord.EARLY] = rest_of_way_s(way, pieces, (first - 1) * width, n, limits)
    state.run.overlap = kind
    state.run.rapid_overlap = contexts[record + ContextRecord.RAPID_OVERLAP] if rapid else 0.0


def rest_of_way_s(way: float, pieces: Floats, at: int, n: int, limits: Limits) -> float:
    """Seconds that a piece that ends in rest takes for the last bit of its way, while its averages come to rest.

    The speed along the path falls with its jerk there, of a rapid of every axis by itself with the largest of its axes.
    """
    ramp: float = pieces[at + PieceRecord.RAMP]
    window: float = window_s(ramp, pieces[at + PieceRecord.BLEND])
    if way == inf or ramp <= 0.0:
        return window
    jerk: float = pieces[at + PieceRecord.PULL] / ramp
    if pieces[at + PieceRecord.FORM] == Form.TIMED:
        jerk, here = 0.0, at + PieceRecord.VECTORS + PLACES * n
        for i in range(n):
            if pieces[here + i] != pieces[here + n + i]:
                jerk = max(jerk, limits.jerk[i])
    last: float = (6.0 * way / jerk) ** (1.0 / 3.0)
    return min(window, last)


def lay_rapid_by_axis(
    contexts: Floats, record: int, n: int, limits: Limits, pieces: Floats, state: State
) -> bool:
    """A rapid on which every axis runs alone, from rest to rest; the average of the slowest one counts."""
    delta = state.delta
    if not has_room(pieces, contexts, record, state, 1, n):
        return False
    end_chord(pieces, n, limits, state)
    settle_alone(pieces, n, limits, state)
    state.run.alone = 0.0
    gentle, longest, ramp = contexts[record + ContextRecord.RAMP_S] > 0.0, 0.0, 0.0
    for i in range(n):
        way, top = abs(delta[i]), rapid_top(contexts, record, limits, i)
        if way > 0.0:
            own = best_ramp(way, top, limits.acceleration[i], limits.jerk[i]) if gentle else 0.0
            pull = alone_pull(own, limits.acceleration[i], limits.jerk[i])
            top = alone_top(way, top, pull, own)
            seconds = own + straight_time(0.0, 0.0, top * top, pull, way)
            if seconds > longest:
                longest, ramp = seconds, own
    if longest > 0.0:
        at = next_piece(pieces, state, Form.TIMED, 0.0, n)
        place(pieces, at, n, state, 0.0, 1.0)
        pieces[at + PieceRecord.LENGTH] = norm(delta, n, limits, 1.0)
        pieces[at + PieceRecord.CAP2] = pieces[at + PieceRecord.ENTRY2] = 0.0
        pieces[at + PieceRecord.PULL] = longest - ramp
        pieces[at + PieceRecord.PAUSE] = pieces[at + PieceRecord.RAMP] = ramp
        pieces[at + PieceRecord.BLEND] = 0.0
        state.run.stop = 1.0
    return True


def rapid_top(contexts: Floats, record: int, limits: Limits, i: int) -> float:
    """Highest speed of an axis that runs a rapid alone; one of the program's own counts degrees of a rotary axis."""
    own: float = contexts[record + ContextRecord.RAPID_SPEED]
    if limits.rotary[i] != 0.0:
        own = own / contexts[record + ContextRecord.TURN_WEIGHT]
    top: float = contexts[record + ContextRecord.RAPID_SHARE] * limits.top_rapid[i]
    return min(top, own) if own > 0.0 else top


def lay_straight(
    curves: Floats, contexts: Floats, record: int, n: int, limits: Limits, pieces: Floats, state: State
) -> bool:
    """A line, or a chord of a spline; in parts where the spindle's speed follows the radius."""
    unit = state.unit
    length, weight = counted_length(contexts, record, n, limits, state)
    if length == 0.0:
        return True
    parts, shared = parts_of_line(contexts, record, limits, state), state.row.shares > 1.0
    if not has_room(pieces, contexts, record, state, parts, n):
        return False
    top, pull = line_limits(curves, contexts, record, n, limits, state, length, weight)
    if not goes_on_smoothly(n, limits, state, weight):
        end_chord(pieces, n, limits, state)
    entry2, first, last, whole_pull, before = 0.0, 0.0, 0.0, pull / state.row.ease, pull
    for part in range(parts):
        first, last = last, state.share_end[part] if shared else (part + 1) / parts
        own = state.share_top[part] if shared else inf
        if shared and part > 0:
            pull = whole_pull * state.share_ease[part]
        radius = radius_on_line(contexts, record, limits, state, 0.5 * (first + last))
        asked = straight_speed(curves, contexts, record, state, length, radius, weight)
        if part == 0:
            speed = min(top, own, bounded(asked, state))
            wanted = min(top, asked) if asked > 0.0 else top
            is_line = (
                parts == 1
                and contexts[record + ContextRecord.LAG_S] == 0.0
                and state.row.kind not in (SPLINE, THREAD, TAP)
            )
            wanted = wanted if is_line else 0.0
            goes_on = is_line and goes_straight_on(n, state, wanted)
            if goes_on:
                speed, wanted, pull = state.run.wanted, state.run.wanted, state.run.exit_pull
            entry2 = join(contexts, record, n, limits, state, length, weight, speed * speed, wanted)
            state.joint.pull = min(state.joint.pull, pull)
            # Under BRISK no line goes on with one under SOFT.
            if state.joint.rest > 0.0 or state.run.window == 0.0:
                settle_alone(pieces, n, limits, state)
            goes_on = goes_on and state.joint.rest == 0.0
            state.run.straight_pieces = state.run.straight_pieces + 1 if goes_on else 1
            state.run.alone = (2.0 if goes_on or state.joint.rest > 0.0 else 1.0) if is_line else 0.0
            state.run.wanted, state.run.line_top = wanted, state.row.top
            state.run.behind = 0.0 if is_rapid(state) else contexts[record + ContextRecord.BEHIND_S]
        else:
            speed = min(top, own, bound(asked, state))
            entry2 = min(state.run.exit2, speed * speed)
        at = next_piece(pieces, state, Form.STRAIGHT, speed * speed, n)
        place(pieces, at, n, state, first, last)
        if part == 0:
            open_joint(pieces, at, state, entry2)
        elif shared:
            pieces[at + PieceRecord.HOLD2], pieces[at + PieceRecord.HOLD_PULL] = entry2, min(pull, before)
        before = pull
        pieces[at + PieceRecord.LENGTH], pieces[at + PieceRecord.CAP2] = (
            (last - first) * length,
            speed * speed,
        )
        pieces[at + PieceRecord.PULL] = pull
        pieces[at + PieceRecord.ENTRY2] = entry2
        pieces[at + PieceRecord.ASKED] = asked / state.run.override
        if state.row.kind == SPLINE:
            lay_chord(contexts, record, pieces, at, n, limits, state, length, weight)
    for i in range(n):
        state.tangent[i] = unit[i]
        if state.run.chord != OPEN:
            state.bent_before[i] = state.bend[i]
    state.run.exit_pull, state.run.rate = pull, 0.0
    state.run.length, state.run.metric, state.run.smooth = (
        length,
        weight,
        1.0 if state.row.kind == SPLINE else 0.0,
    )
    return True


def parts_of_line(contexts: Floats, record: int, limits: Limits, state: State) -> int:
    """Number of pieces that the line at hand is laid in."""
    if state.row.shares > 1.0:
        return state.row.shares
    end_x = state.row.facing
    start_x = radius_on_line(contexts, record, limits, state, 0.0)
    return FACING_PIECES if abs(end_x - start_x) > 0.02 * max(abs(end_x), abs(start_x)) else 1


def line_limits(
    curves: Floats,
    contexts: Floats,
    record: int,
    n: int,
    limits: Limits,
    state: State,
    length: float,
    weight: float,
) -> tuple[float, float]:
    """Speed and acceleration along the row at hand that its axes allow; sets `unit` to its direction."""
    unit, pull, soft = state.unit, inf, contexts[record + ContextRecord.RAMP_S] > 0.0
    top = line_top(contexts, record, n, limits, state, length)
    for i in range(n):
        state.bend[i] = 0.0
        share = abs(unit[i])
        if share > 0.0 and not soft:
            pull = lowered(pull, limits.acceleration[i], share)
    if soft:
        alone = is_rapid(state) and limits.path.rapid_stops != 0.0
        pull = line_pull(contexts, record, n, limits, state, alone or state.row.kind == TAP)
    elif contexts[record + ContextRecord.DRIVE_SPEED] < 1.0:
        radius = radius_on_line(contexts, record, limits, state, 0.0)
        asked = bound(straight_speed(curves, contexts, record, state, length, radius, weight), state)
        pull *= drive_factor(contexts, record, n, limits, state, unit, 0, min(top, asked))
    lead = lead_of(curves, state)
    if state.row.kind == TAP and lead > 0.0:
        pull = min(pull, lead * contexts[record + ContextRecord.SPINDLE_REV_S2])
    if contexts[record + ContextRecord.LAG_S] > 0.0:
        asked = asked_speed(curves, contexts, record, state, length, state.row.facing)
        pull = min(pull, lagging_pull(contexts, record, min(top, asked)))
    return top, state.row.ease * pull


def line_top(contexts: Floats, record: int, n: int, limits: Limits, state: State, length: float) -> float:
    """Speed along the row at hand that its axes and the control allow; sets `unit` to its direction."""
    unit, rapid = state.unit, is_rapid(state)
    tops = limits.top_rapid if rapid else limits.top_feed
    faster = contexts[record + ContextRecord.RAPID_SHARE] if rapid else 1.0
    top = state.row.top if rapid else min(limits.path.path_feed, state.row.top)
    top = min(top, block_top(length, limits, state))
    for i in range(n):
        unit[i] = state.delta[i] / length
        share = abs(unit[i])
        if share > 0.0:
            top = lowered(top, faster * tops[i], share)
    return top
