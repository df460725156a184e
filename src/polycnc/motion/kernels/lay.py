"""Rows of a toolpath become pieces; straight ones here, arcs in `arcs.py`."""

from __future__ import annotations

from math import inf

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.alone import best_ramp, goes_straight_on, settle_alone
from polycnc.motion.kernels.arcs import find_arc, lay_arc
from polycnc.motion.kernels.columns import (
    ACCELERATION,
    ALONE,
    AT_END,
    AT_START,
    AT_STATION,
    BEND,
    BENT,
    BENT_BEFORE,
    BLEND,
    CAP2,
    CORNER_EASE,
    CURVE,
    CURVE_WIDTH,
    CURVED,
    CW,
    DELTA,
    DRIVE_SPEED,
    DWELL,
    EARLY,
    EASE,
    ENTRY2,
    EVENT,
    EXACT_STOP,
    EXIT2,
    EXIT_PULL,
    FACING,
    FACING_PIECES,
    FEED,
    FORM,
    FRAME,
    GEOMETRY,
    HAS_FRAME,
    HELIX_CCW,
    HOLD2,
    HOLD_PULL,
    JERK,
    JOINT_PULL,
    KIND,
    LAG_S,
    LAST_CORNER,
    LAST_EASE,
    LENGTH,
    LIMIT_BLOCKS,
    METRIC,
    NUMBER,
    OFFSETS,
    OVERLAP,
    OVERLAP_BEFORE,
    OVERLAPS,
    PATH_FEED,
    PATH_PULL,
    PAUSE,
    PIECES,
    PLACES,
    POSITION,
    PULL,
    RAMP,
    RAMP_S,
    RAPID_BY_AXIS,
    RAPID_SHARE,
    RAPID_SPEED,
    RAPID_STOPS,
    REST,
    ROTARY_WEIGHT,
    ROW_LENGTH,
    ROW_SLOT,
    ROW_TOP,
    SHARE_COUNT,
    SHARE_EASE,
    SHARE_END,
    SHARE_TOP,
    SHARES,
    SKIP,
    SMOOTH,
    SPINDLE_REV_S2,
    SPLINE,
    STATE_BLOCKS,
    STATION,
    STOP,
    STRAIGHT,
    STRAIGHT_RUN,
    TANGENT,
    TAP,
    TARGET,
    THREAD,
    TIMED,
    TOP_FEED,
    TOP_RAPID,
    UNIT,
    VECTORS,
    WANTED,
    Rows,
    piece_width,
)
from polycnc.motion.kernels.corners import join
from polycnc.motion.kernels.feeds import (
    asked_speed,
    axes_of,
    bound,
    bounded,
    drive_factor,
    follows_radius,
    has_room,
    is_rapid,
    lagging_pull,
    lead_of,
    next_piece,
    norm,
    open_joint,
    place,
)
from polycnc.motion.kernels.hold import hold
from polycnc.motion.kernels.jerk import axis_pull, line_pull
from polycnc.motion.kernels.speeds import straight_time


def lay(
    rows: Rows,
    first: int,
    curves: Floats,
    number: int,
    contexts: Floats,
    limits: Floats,
    pieces: Floats,
    state: Floats,
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
    n = axes_of(state)
    for row in range(first, len(rows.kind)):
        kind = rows.kind[row]
        if kind == EVENT:
            if rows.stops[rows.curve[row]] != 0:
                state[STOP], state[OVERLAP_BEFORE] = 1.0, 0.0
        elif kind == DWELL:
            state[STOP], state[OVERLAP_BEFORE] = 1.0, 0.0
        else:
            record = rows.context[row] * (OFFSETS + n)
            if kind == THREAD and state[KIND] != THREAD:
                state[STOP] = 1.0  # the axes wait for the spindle's zero mark
            state[KIND], state[NUMBER], state[FEED] = kind, number + row, rows.feed[row]
            state[CURVE] = rows.curve[row] * CURVE_WIDTH
            take_shares(rows, row, state)
            state[ROW_SLOT] = 2 * rows.context[row] + (0 if is_rapid(state) else 1)
            aim(rows.end, row * n, contexts, record, n, limits, state)
            if not lay_move(curves, contexts, record, n, limits, pieces, state):
                return row
            state[LAST_EASE] = state[SHARE_EASE + max(int(state[SHARE_COUNT]) - 1, 0)]
            state[LAST_CORNER] = state[SHARE_EASE + AT_END]
    return len(rows.kind)


def take_shares(rows: Rows, row: int, state: Floats) -> None:
    """Set ROW_TOP, EASE, CORNER_EASE and the shares of the row at hand."""
    state[SHARE_COUNT], state[ROW_TOP], state[SHARE_EASE] = 0.0, inf, 1.0
    state[SHARE_EASE + AT_START] = state[SHARE_EASE + AT_END] = 1.0
    if len(rows.share) > 0:
        first, count = row * SHARES, 1
        while rows.share[first + count - 1] < 1.0:
            count += 1
        for k in range(count):
            state[SHARE_END + k] = rows.share[first + k]
            state[SHARE_TOP + k] = rows.top[first + k]
            state[SHARE_EASE + k] = rows.ease[first + k]
        state[SHARE_COUNT] = count
        state[SHARE_EASE + AT_START] = rows.ease[first + AT_START]
        state[SHARE_EASE + AT_END] = rows.ease[first + AT_END]
        state[ROW_TOP] = state[SHARE_TOP] if count == 1 else inf
    own, before = state[SHARE_EASE + AT_START], state[LAST_CORNER]
    state[EASE], state[CORNER_EASE] = state[SHARE_EASE], min(own, before) if before > 0.0 else own


def aim(end: Floats, at: int, contexts: Floats, record: int, n: int, limits: Floats, state: Floats) -> None:
    """Set TARGET to the machine position of a row's end, DELTA to the way there, FACING to its X."""
    target, geometry = STATE_BLOCKS + TARGET * n, LIMIT_BLOCKS * n + GEOMETRY
    for i in range(n):
        state[target + i] = end[at + i]
    if contexts[record + HAS_FRAME] != 0.0:
        for j in range(3):
            axis = int(limits[geometry + j])
            if axis >= 0:
                value = contexts[record + FRAME + 9 + j]
                for k in range(3):
                    other = int(limits[geometry + k])
                    if other >= 0:
                        value += contexts[record + FRAME + 3 * j + k] * end[at + other]
                state[target + axis] = value
    for i in range(n):
        state[target + i] += contexts[record + OFFSETS + i]
        state[STATE_BLOCKS + DELTA * n + i] = state[target + i] - state[STATE_BLOCKS + POSITION * n + i]
    facing = int(limits[geometry])
    state[FACING] = end[at + facing] if facing >= 0 else 0.0


def lay_move(
    curves: Floats, contexts: Floats, record: int, n: int, limits: Floats, pieces: Floats, state: Floats
) -> bool:
    """Lay the row at hand out; false when the room ends: it can then be tried again."""
    kind, rules, first = int(state[KIND]), LIMIT_BLOCKS * n, int(state[PIECES])
    rapid = is_rapid(state)
    stands = kind in (TAP, SKIP) or (rapid and limits[rules + RAPID_STOPS] != 0.0)
    if stands or contexts[record + STATION] != state[AT_STATION]:
        state[STOP] = 1.0
    arc = (CW <= kind <= HELIX_CCW or kind == THREAD) and state[CURVE] >= 0.0
    if arc and find_arc(curves, contexts, record, n, limits, state):
        done = lay_arc(curves, contexts, record, n, limits, pieces, state)
    elif rapid and contexts[record + RAPID_BY_AXIS] != 0.0:
        done = lay_rapid_by_axis(contexts, record, n, limits, pieces, state)
    else:
        done = lay_straight(curves, contexts, record, n, limits, pieces, state)
    if not done:
        return False
    if int(state[PIECES]) > first:
        overlap(contexts, record, pieces, first, n, state)
    if contexts[record + RAMP_S] > 0.0:
        hold(pieces, first, n, state)
    for i in range(n):
        state[STATE_BLOCKS + POSITION * n + i] = state[STATE_BLOCKS + TARGET * n + i]
    state[AT_STATION] = contexts[record + STATION]
    if stands or contexts[record + EXACT_STOP] != 0.0:
        state[STOP] = 1.0
    return True


def overlap(contexts: Floats, record: int, pieces: Floats, first: int, n: int, state: Floats) -> None:
    """A stroke of a drilling cycle may begin while the averages of the one before come to rest (FANUC 1681).

    The axes' accelerations add up to no more than either stroke's: the sum is the average of what both ask for. The
    row's pieces begin at `first`.
    """
    width = piece_width(n)
    meets = state[OVERLAP_BEFORE] == OVERLAPS and contexts[record + OVERLAP] != 0.0
    if meets and first > 0 and contexts[record + STATION] == state[AT_STATION]:
        before = (first - 1) * width
        pieces[first * width + EARLY] = pieces[before + RAMP] + 2.0 * pieces[before + BLEND]
    state[OVERLAP_BEFORE] = contexts[record + OVERLAP]


def lay_rapid_by_axis(
    contexts: Floats, record: int, n: int, limits: Floats, pieces: Floats, state: Floats
) -> bool:
    """A rapid on which every axis runs alone, from rest to rest: as long as the slowest axis takes."""
    delta = STATE_BLOCKS + DELTA * n
    if not has_room(pieces, contexts, record, state, 1, n):
        return False
    settle_alone(pieces, n, limits, state)
    state[ALONE] = 0.0
    seconds, ramp, own = 0.0, 0.0, contexts[record + RAPID_SPEED]
    own, faster = own if own > 0.0 else inf, contexts[record + RAPID_SHARE]
    for i in range(n):
        way = abs(state[delta + i])
        if way > 0.0 and contexts[record + RAMP_S] > 0.0:
            top, jerk = min(faster * limits[TOP_RAPID * n + i], own), limits[JERK * n + i]
            ramp = max(ramp, best_ramp(way, top, limits[ACCELERATION * n + i], jerk))
    for i in range(n):
        way, top = abs(state[delta + i]), min(faster * limits[TOP_RAPID * n + i], own)
        if way > 0.0:
            pull = axis_pull(ramp, n, limits, i)
            seconds = max(seconds, straight_time(0.0, 0.0, top * top, pull, way))
    if seconds > 0.0:
        at = next_piece(pieces, state, TIMED, 0.0, n)
        place(pieces, at, n, state, 0.0, 1.0)
        pieces[at + LENGTH] = norm(state, delta, n, limits, 1.0)
        pieces[at + CAP2] = pieces[at + ENTRY2] = 0.0
        pieces[at + PULL] = seconds
        pieces[at + PAUSE] = pieces[at + RAMP] = ramp
        pieces[at + BLEND] = 0.0
        state[STOP] = 1.0
    return True


def lay_straight(
    curves: Floats, contexts: Floats, record: int, n: int, limits: Floats, pieces: Floats, state: Floats
) -> bool:
    """A line, or a chord of a spline; in parts where the spindle's speed follows the radius."""
    delta, unit = STATE_BLOCKS + DELTA * n, STATE_BLOCKS + UNIT * n
    weight = contexts[record + ROTARY_WEIGHT]
    length = norm(state, delta, n, limits, weight)
    if length == 0.0:
        weight = 1.0
        length = norm(state, delta, n, limits, weight)
    if length == 0.0:
        return True
    parts, start_x = parts_of_line(contexts, record, n, limits, state)
    end_x, shared = state[FACING], state[SHARE_COUNT] > 1.0
    if not has_room(pieces, contexts, record, state, parts, n):
        return False
    top, pull = line_limits(curves, contexts, record, n, limits, state, length, start_x)
    entry2, first, last, whole_pull, before = 0.0, 0.0, 0.0, pull / state[EASE], pull
    for part in range(parts):
        first, last = last, state[SHARE_END + part] if shared else (part + 1) / parts
        own = state[SHARE_TOP + part] if shared else inf
        if shared and part > 0:
            pull = whole_pull * state[SHARE_EASE + part]
        radius = start_x + (end_x - start_x) * 0.5 * (first + last)
        asked = asked_speed(curves, contexts, record, state, length, radius)
        if part == 0:
            speed = min(top, own, bounded(asked, state))
            wanted = min(top, asked) if asked > 0.0 else top
            is_line = (
                parts == 1 and contexts[record + LAG_S] == 0.0 and state[KIND] not in (SPLINE, THREAD, TAP)
            )
            wanted = wanted if is_line else 0.0
            goes_on = is_line and goes_straight_on(n, state, wanted)
            if goes_on:
                speed, wanted, pull = state[WANTED], state[WANTED], state[EXIT_PULL]
            entry2 = join(contexts, record, n, limits, state, length, weight, speed * speed, wanted)
            state[JOINT_PULL] = min(state[JOINT_PULL], pull)
            if state[REST] > 0.0:
                settle_alone(pieces, n, limits, state)
            goes_on = goes_on and state[REST] == 0.0
            state[STRAIGHT_RUN] = state[STRAIGHT_RUN] + 1.0 if goes_on else 1.0
            state[ALONE] = (2.0 if goes_on or state[REST] > 0.0 else 1.0) if is_line else 0.0
            state[WANTED] = wanted
        else:
            speed = min(top, own, bound(asked, state))
            entry2 = min(state[EXIT2], speed * speed)
        at = next_piece(pieces, state, STRAIGHT, speed * speed, n)
        place(pieces, at, n, state, first, last)
        if part == 0:
            open_joint(pieces, at, state, entry2)
        elif shared:
            pieces[at + HOLD2], pieces[at + HOLD_PULL] = entry2, min(pull, before)
        before = pull
        pieces[at + LENGTH], pieces[at + CAP2] = (last - first) * length, speed * speed
        pieces[at + PULL] = pull
        pieces[at + ENTRY2] = entry2
        if state[KIND] == SPLINE:
            lay_chord(contexts, record, pieces, at, n, limits, state, length, weight)
    for i in range(n):
        state[STATE_BLOCKS + TANGENT * n + i] = state[unit + i]
        state[STATE_BLOCKS + BENT_BEFORE * n + i] = state[STATE_BLOCKS + BEND * n + i]
    state[EXIT_PULL] = pull
    state[ROW_LENGTH], state[METRIC], state[SMOOTH] = length, weight, 1.0 if state[KIND] == SPLINE else 0.0
    return True


def parts_of_line(contexts: Floats, record: int, n: int, limits: Floats, state: Floats) -> tuple[int, float]:
    """Number of pieces that the line at hand is laid in, and the turning radius at its start."""
    end_x, start_x, facing = state[FACING], state[FACING], int(limits[LIMIT_BLOCKS * n + GEOMETRY])
    if state[SHARE_COUNT] > 1.0:
        return int(state[SHARE_COUNT]), start_x
    if facing >= 0 and follows_radius(contexts, record):
        start_x -= state[STATE_BLOCKS + DELTA * n + facing]
        if abs(end_x - start_x) > 0.02 * max(abs(end_x), abs(start_x)):
            return FACING_PIECES, start_x
    return 1, start_x


def line_limits(
    curves: Floats,
    contexts: Floats,
    record: int,
    n: int,
    limits: Floats,
    state: Floats,
    length: float,
    radius: float,
) -> tuple[float, float]:
    """Speed and acceleration along the row at hand that its axes allow; sets UNIT to its direction."""
    delta, unit = STATE_BLOCKS + DELTA * n, STATE_BLOCKS + UNIT * n
    top_block = (TOP_RAPID if is_rapid(state) else TOP_FEED) * n
    faster = contexts[record + RAPID_SHARE] if is_rapid(state) else 1.0
    top = state[ROW_TOP] if is_rapid(state) else min(limits[LIMIT_BLOCKS * n + PATH_FEED], state[ROW_TOP])
    pull = inf
    for i in range(n):
        state[unit + i] = state[delta + i] / length
        state[STATE_BLOCKS + BEND * n + i] = 0.0
        share = abs(state[unit + i])
        if share > 0.0:
            top = min(top, faster * limits[top_block + i] / share)
            pull = min(pull, limits[ACCELERATION * n + i] / share)
    if contexts[record + RAMP_S] > 0.0:
        alone = is_rapid(state) and limits[LIMIT_BLOCKS * n + RAPID_STOPS] != 0.0
        pull = line_pull(contexts, record, n, limits, state, alone or state[KIND] == TAP)
    elif contexts[record + DRIVE_SPEED] < 1.0:
        asked = bound(asked_speed(curves, contexts, record, state, length, radius), state)
        pull *= drive_factor(contexts, record, n, limits, state, state, unit, min(top, asked))
    lead = lead_of(curves, state)
    if state[KIND] == TAP and lead > 0.0:
        pull = min(pull, lead * contexts[record + SPINDLE_REV_S2])
    if contexts[record + LAG_S] > 0.0:
        asked = asked_speed(curves, contexts, record, state, length, state[FACING])
        pull = min(pull, lagging_pull(contexts, record, min(top, asked)))
    return top, state[EASE] * pull


def lay_chord(
    contexts: Floats,
    record: int,
    pieces: Floats,
    at: int,
    n: int,
    limits: Floats,
    state: Floats,
    length: float,
    weight: float,
) -> None:
    """Give a spline's chord the tangents and the curvature of the curve through its points.

    At a point between two chords the tangent is their mean direction, the shorter one counting more, the
    curvature the change of direction over the mean length: the derivatives of the parabola through the three
    points. UNIT is the chord, TANGENT the one before.
    """
    unit, tangent, bend = STATE_BLOCKS + UNIT * n, STATE_BLOCKS + TANGENT * n, STATE_BLOCKS + BEND * n
    here = at + VECTORS
    before = here - piece_width(n)
    pieces[at + FORM] = CURVED if contexts[record + RAMP_S] == 0.0 else BENT
    if contexts[record + DRIVE_SPEED] < 1.0 or state[EASE] < 1.0:
        pieces[at + PATH_PULL] = pieces[at + PULL]
    for i in range(n):
        pieces[here + i] = pieces[here + n + i] = state[unit + i]
        pieces[here + 2 * n + i] = pieces[here + 3 * n + i] = 0.0
    if state[SMOOTH] != 2.0:
        return
    for i in range(n):
        state[bend + i] = state[unit + i] * state[ROW_LENGTH] + state[tangent + i] * length
    size, mean = norm(state, bend, n, limits, weight), 0.5 * (length + state[ROW_LENGTH])
    cap2, turn2 = pieces[at + ENTRY2], 0.0
    for i in range(n):
        turn2 += (state[unit + i] - state[tangent + i]) ** 2
        direction, curvature = state[bend + i] / size, (state[unit + i] - state[tangent + i]) / mean
        pieces[before + n + i] = pieces[here + i] = direction
        pieces[before + 3 * n + i] = pieces[here + 2 * n + i] = curvature
        if curvature != 0.0:
            cap2 = min(cap2, limits[ACCELERATION * n + i] / abs(curvature))
    # In the middle of its chord the curve is longer than the chord by `turn²/16` at most (a cubic, `run.py`).
    for chord in (at - piece_width(n), at):
        top2 = chord_top2(pieces, chord, n, limits)
        pieces[chord + CAP2] = min(pieces[chord + CAP2] * (1.0 - 0.125 * turn2), top2)
        pieces[chord + ENTRY2] = min(pieces[chord + ENTRY2], pieces[chord + CAP2])
    pieces[at + ENTRY2] = min(cap2, pieces[at + CAP2], pieces[at - piece_width(n) + CAP2])
    state[EXIT2] = pieces[at + CAP2]


def chord_top2(pieces: Floats, at: int, n: int, limits: Floats) -> float:
    """Largest x at which every axis keeps its velocity all along the cubic over a spline's chord (`run.py`).

    Its derivative by the share f of the chord, over the chord's length, is
    `u + l·(1 - f)·(1 - 3·f) + a·f·(3·f - 2)`, where u is the chord's direction, and l and a are what the tangents at
    its start and its end differ by: a parabola, largest at an end or at its crest.
    """
    here, top2 = at + VECTORS, inf
    for i in range(n):
        leave, arrive = pieces[here + i], pieces[here + n + i]
        place = here + PLACES * n + i
        unit = (pieces[place + n] - pieces[place]) / pieces[at + LENGTH]
        most, bow = max(abs(leave), abs(arrive)), leave + arrive - 2.0 * unit
        if bow != 0.0:
            f = (2.0 * leave + arrive - 3.0 * unit) / (3.0 * bow)
            if 0.0 < f < 1.0:
                most = max(most, abs(leave - 3.0 * bow * f * f))
        if most > 0.0:
            top = limits[TOP_FEED * n + i] / most
            top2 = min(top2, top * top)
    return top2
