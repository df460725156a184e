"""Rows of a toolpath become pieces; straight ones here, arcs in `arcs.py`."""

from __future__ import annotations

from math import inf

from polycnc.motion.kernels.columns import (
    AT_STATION,
    CURVED,
    CURVE_WIDTH,
    CW,
    DWELL,
    EVENT,
    EXACT_STOP,
    EXIT2,
    FACING_PIECES,
    FRAME,
    Floats,
    HAS_FRAME,
    HELIX_CCW,
    Limits,
    METRIC,
    OFFSETS,
    PER_REVOLUTION,
    PIECES,
    Pieces,
    RAPID,
    REF,
    ROTARY_WEIGHT,
    ROW_LENGTH,
    Rows,
    SMOOTH,
    SPINDLE_REV_S2,
    SPLINE,
    STATION,
    STOP,
    STRAIGHT,
    SURFACE_MM_S,
    State,
    TAP,
    TIMED,
)
from polycnc.motion.kernels.arcs import arc_basis, lay_arc
from polycnc.motion.kernels.corners import join
from polycnc.motion.kernels.feeds import add_piece, capped_speed, norm, programmed_speed
from polycnc.motion.kernels.speeds import straight_time


def lay(rows: Rows, first: int, row_number: int, contexts: Floats, limits: Limits, pieces: Pieces, state: State) -> int:
    """Lay rows out as pieces from row `first` on; the next row to lay: behind the last, or one that found no room.

    `row_number` is the number of the chunk's first row.
    """
    for row in range(first, len(rows.kind)):
        kind = rows.kind[row]
        if kind == EVENT:
            if rows.stops[rows.curve[row]] != 0:
                state.now[STOP] = 1.0
        elif kind == DWELL:
            state.now[STOP] = 1.0
        elif not lay_move(rows, row, row_number + row, contexts, limits, pieces, state):
            return row
    return len(rows.kind)


def lay_move(
    rows: Rows, row: int, number: int, contexts: Floats, limits: Limits, pieces: Pieces, state: State
) -> bool:
    """Lay one move out; false when the room ends, with nothing changed."""
    n = len(state.position)
    kind, context = rows.kind[row], rows.context[row]
    base = context * (OFFSETS + n)
    aim(rows, row, contexts, base, limits, state)
    now = state.now
    if contexts[base + STATION] != now[AT_STATION] or kind == TAP:
        now[STOP] = 1.0
    rapid = kind == RAPID or kind == REF
    if rapid and limits.rules[1] != 0:
        now[STOP] = 1.0
    if CW <= kind <= HELIX_CCW and rows.curve[row] >= 0 and arc_basis(rows, row, contexts, base, limits, state):
        done = lay_arc(rows, row, number, contexts, base, limits, pieces, state)
    elif rapid and limits.rules[0] != 0:
        done = lay_rapid_by_axis(context * 2, number, limits, pieces, state)
    else:
        done = lay_straight(rows, row, number, contexts, base, limits, pieces, state)
    if not done:
        return False
    for i in range(n):
        state.position[i] = state.target[i]
    now[AT_STATION] = contexts[base + STATION]
    if contexts[base + EXACT_STOP] != 0.0 or kind == TAP or (rapid and limits.rules[1] != 0):
        now[STOP] = 1.0
    return True


def aim(rows: Rows, row: int, contexts: Floats, base: int, limits: Limits, state: State) -> None:
    """Set `target` to the machine position of the row's end and `delta` to the way there."""
    n = len(state.position)
    target, end = state.target, rows.end
    for i in range(n):
        target[i] = end[row * n + i]
    if contexts[base + HAS_FRAME] != 0.0:
        for j in range(3):
            axis = limits.geometry[j]
            if axis >= 0:
                value = contexts[base + FRAME + 9 + j]
                for k in range(3):
                    other = limits.geometry[k]
                    if other >= 0:
                        value += contexts[base + FRAME + 3 * j + k] * end[row * n + other]
                target[axis] = value
    for i in range(n):
        target[i] += contexts[base + OFFSETS + i]
        state.delta[i] = target[i] - state.position[i]


def lay_rapid_by_axis(slot: int, number: int, limits: Limits, pieces: Pieces, state: State) -> bool:
    """A rapid on which every axis runs alone, from rest to rest: as long as the slowest axis takes."""
    if state.count[PIECES] >= len(pieces.length):
        return False
    seconds = 0.0
    for i in range(len(state.delta)):
        way = abs(state.delta[i])
        if way > 0.0:
            speed = limits.rapid[i]
            seconds = max(seconds, straight_time(0.0, 0.0, speed * speed, limits.acceleration[i], way))
    if seconds > 0.0:
        add_piece(pieces, state, norm(state.delta, limits, 1.0), 0.0, 0.0, seconds, TIMED, number, slot)
        state.now[STOP] = 1.0
    return True


def lay_straight(
    rows: Rows, row: int, number: int, contexts: Floats, base: int, limits: Limits, pieces: Pieces, state: State
) -> bool:
    """A line, or a chord of a spline; in parts where the spindle's speed follows the radius."""
    weight = contexts[base + ROTARY_WEIGHT]
    length = norm(state.delta, limits, weight)
    if length == 0.0:
        weight = 1.0
        length = norm(state.delta, limits, weight)
        if length == 0.0:
            return True
    n, kind, facing = len(state.delta), rows.kind[row], limits.geometry[0]
    rapid = kind == RAPID or kind == REF
    end_radius, start_radius, parts = 0.0, 0.0, 1
    if contexts[base + SURFACE_MM_S] != 0.0 and contexts[base + PER_REVOLUTION] != 0.0 and not rapid and facing >= 0:
        end_radius = rows.end[row * n + facing]
        start_radius = end_radius - state.delta[facing]
        if abs(state.delta[facing]) > 0.02 * max(abs(end_radius), abs(start_radius)):
            parts = FACING_PIECES
    if state.count[PIECES] + parts > len(pieces.length):
        return False
    top, pull = inf, inf
    for i in range(n):
        state.unit[i] = state.delta[i] / length
        share = abs(state.unit[i])
        if share > 0.0:
            top = min(top, (limits.rapid[i] if rapid else limits.max_feed[i]) / share)
            pull = min(pull, limits.acceleration[i] / share)
    if kind == TAP and rows.curve[row] >= 0 and rows.curves[rows.curve[row] * CURVE_WIDTH] > 0.0:
        pull = min(pull, rows.curves[rows.curve[row] * CURVE_WIDTH] * contexts[base + SPINDLE_REV_S2])
    slot = rows.context[row] * 2 + (0 if rapid else 1)
    for part in range(parts):
        radius = start_radius + (end_radius - start_radius) * (part + 0.5) / parts
        programmed = programmed_speed(rows, row, contexts, base, length, radius, state)
        if part > 0:
            speed = min(top, programmed if programmed > 0.0 else inf)
            entry2 = min(state.now[EXIT2], speed * speed)
        else:
            speed = min(top, capped_speed(programmed, state))
            entry2 = join(kind, contexts, base, limits, state, length, weight, speed * speed)
        form = CURVED if kind == SPLINE else STRAIGHT
        p = add_piece(pieces, state, length / parts, speed * speed, entry2, pull, form, number, slot)
        if kind == SPLINE:
            lay_chord(pieces, p, limits, state, length, weight)
    for i in range(n):
        state.tangent[i] = state.unit[i]
    state.now[ROW_LENGTH], state.now[METRIC], state.now[SMOOTH] = length, weight, 1.0 if kind == SPLINE else 0.0
    return True


def lay_chord(pieces: Pieces, p: int, limits: Limits, state: State, length: float, weight: float) -> None:
    """Give a spline's chord the tangents and the curvature of the curve through its points.

    At a point between two chords the tangent is their mean direction, the curvature the change of direction over the
    mean length: central differences, the curve's own values to second order. `unit` is the chord, `tangent` the one before.
    """
    n, v = len(state.unit), pieces.vectors
    at = p * 4 * n
    for i in range(n):
        v[at + i] = v[at + n + i] = state.unit[i]
        v[at + 2 * n + i] = v[at + 3 * n + i] = 0.0
    if state.now[SMOOTH] != 2.0:
        return
    before = at - 4 * n
    mean = 0.5 * (length + state.now[ROW_LENGTH])
    for i in range(n):
        state.bend[i] = state.unit[i] + state.tangent[i]
    size = norm(state.bend, limits, weight)
    cap2 = pieces.entry2[p]
    for i in range(n):
        direction = state.bend[i] / size
        curvature = (state.unit[i] - state.tangent[i]) / mean
        v[before + n + i] = v[at + i] = direction
        v[before + 3 * n + i] = v[at + 2 * n + i] = v[at + 3 * n + i] = curvature
        if curvature != 0.0:
            cap2 = min(cap2, limits.acceleration[i] / abs(curvature))
    pieces.entry2[p] = cap2
    # The last chord of a spline bends at its end as at its start.
    state.now[EXIT2] = min(state.now[EXIT2], cap2)
