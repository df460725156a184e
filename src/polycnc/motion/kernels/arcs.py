"""Arcs, helices and spirals become pieces."""

from __future__ import annotations

from math import atan2, ceil, cos, inf, pi, sin, sqrt

from polycnc.motion.kernels.columns import (
    CCW,
    CURVED,
    CURVE_WIDTH,
    EXIT2,
    FRAME,
    Floats,
    HAS_FRAME,
    HELIX_CCW,
    Limits,
    METRIC,
    MIRROR,
    OFFSETS,
    PER_REVOLUTION,
    PIECES,
    PIECES_PER_TURN,
    Pieces,
    ROTARY_WEIGHT,
    ROW_LENGTH,
    Rows,
    SAME_POINT_MM,
    SMOOTH,
    SURFACE_MM_S,
    State,
)
from polycnc.motion.kernels.corners import join
from polycnc.motion.kernels.feeds import add_piece, capped_speed, norm, programmed_speed


def arc_basis(rows: Rows, row: int, contexts: Floats, base: int, limits: Limits, state: State) -> bool:
    """Set `basis` to the arc's directions in machine coordinates, `turn` to its sweep, radius, growth and rise.

    `basis` is the unit vector from the centre to the start, the direction of travel there, the normal. False where the start
    lies in the centre or the geometry is not complete enough to turn in.
    """
    c = rows.curve[row] * CURVE_WIDTH
    basis, turn = state.basis, state.turn
    sign = 1.0 if rows.kind[row] == CCW or rows.kind[row] == HELIX_CCW else -1.0
    size2 = 0.0
    for j in range(3):
        normal = rows.curves[c + 3 + j]
        center = rows.curves[c + j]
        if contexts[base + HAS_FRAME] != 0.0:
            normal, center = 0.0, contexts[base + FRAME + 9 + j]
            for k in range(3):
                normal += contexts[base + FRAME + 3 * j + k] * rows.curves[c + 3 + k]
                center += contexts[base + FRAME + 3 * j + k] * rows.curves[c + k]
        size2 += normal * normal
        basis[6 + j] = normal
        axis = limits.geometry[j]
        if axis >= 0:
            center += contexts[base + OFFSETS + axis]
            basis[j] = state.position[axis] - center
            basis[3 + j] = state.target[axis] - center
        else:
            basis[j] = basis[3 + j] = 0.0
    if size2 == 0.0:
        return False
    sign *= contexts[base + MIRROR]
    from_start, from_end = 0.0, 0.0
    for j in range(3):
        basis[6 + j] /= sqrt(size2)
        from_start += basis[j] * basis[6 + j]
        from_end += basis[3 + j] * basis[6 + j]
    start2, end2, apart2 = 0.0, 0.0, 0.0
    for j in range(3):
        basis[j] -= from_start * basis[6 + j]
        basis[3 + j] -= from_end * basis[6 + j]
        start2 += basis[j] * basis[j]
        end2 += basis[3 + j] * basis[3 + j]
        apart2 += (basis[j] - basis[3 + j]) * (basis[j] - basis[3 + j])
    if start2 <= SAME_POINT_MM * SAME_POINT_MM:
        return False
    radius = sqrt(start2)
    turn[1], turn[2], turn[3] = radius, sqrt(end2) - radius, from_end - from_start
    turn[0] = arc_sweep(basis, sign, radius, apart2) + 2.0 * pi * rows.curves[c + 6]
    return True


def arc_sweep(basis: Floats, sign: float, radius: float, apart2: float) -> float:
    """Finish the basis (start direction, direction of travel, normal) and give the angle of the first turn."""
    along, across = 0.0, 0.0
    for j in range(3):
        basis[j] /= radius
    end0, end1, end2 = basis[3], basis[4], basis[5]
    basis[3] = sign * (basis[7] * basis[2] - basis[8] * basis[1])
    basis[4] = sign * (basis[8] * basis[0] - basis[6] * basis[2])
    basis[5] = sign * (basis[6] * basis[1] - basis[7] * basis[0])
    along = end0 * basis[0] + end1 * basis[1] + end2 * basis[2]
    across = end0 * basis[3] + end1 * basis[4] + end2 * basis[5]
    if apart2 <= SAME_POINT_MM * SAME_POINT_MM:
        return 2.0 * pi
    angle = atan2(across, along)
    return angle if angle > 0.0 else angle + 2.0 * pi


def arc_node(angle: float, limits: Limits, weight: float, state: State) -> float:
    """Set `unit` to q' and `bend` to q'' at an angle of the arc; the way per radian.

    The curve is `r(φ)·e(φ) + h·φ·N`, with a radius that grows in proportion; other axes move evenly with the angle.
    """
    basis, turn, unit, bend = state.basis, state.turn, state.unit, state.bend
    sweep = turn[0]
    growth = turn[2] / sweep
    radius = turn[1] + growth * angle
    c, s = cos(angle), sin(angle)
    for i in range(len(unit)):
        unit[i] = state.delta[i] / sweep
        bend[i] = 0.0
    for j in range(3):
        i = limits.geometry[j]
        if i >= 0:
            outward = c * basis[j] + s * basis[3 + j]
            forth = c * basis[3 + j] - s * basis[j]
            unit[i] = growth * outward + radius * forth + turn[3] / sweep * basis[6 + j]
            bend[i] = 2.0 * growth * forth - radius * outward
    way = norm(unit, limits, weight)
    along = 0.0
    for i in range(len(unit)):
        w = weight if limits.rotary[i] != 0 else 1.0
        unit[i] /= way
        along += w * w * unit[i] * bend[i]
    for i in range(len(unit)):
        bend[i] = (bend[i] - unit[i] * along) / (way * way)
    return way


def arc_caps(limits: Limits, state: State, margin: float) -> float:
    """Largest x at a point of a curve at which every axis keeps its velocity, and can hold the speed."""
    cap2 = inf
    for i in range(len(state.unit)):
        share, curvature = abs(state.unit[i]), abs(state.bend[i])
        if share > 0.0:
            speed = limits.max_feed[i] / share
            cap2 = min(cap2, speed * speed)
        if curvature > 0.0:
            cap2 = min(cap2, limits.acceleration[i] / (curvature * margin))
    return cap2


def lay_arc(
    rows: Rows, row: int, number: int, contexts: Floats, base: int, limits: Limits, pieces: Pieces, state: State
) -> bool:
    """An arc, helix or spiral in pieces of equal angle.

    Over a piece of angle d the acceleration of an axis, `f(φ)`, has `|f''| <= 5·a`, so that it exceeds the larger of its end
    values by at most `5·d²/8` of the limit; tangents and curvature are stored larger by that much.
    """
    n, sweep = len(state.unit), state.turn[0]
    parts = int(ceil(sweep * PIECES_PER_TURN / (2.0 * pi) - 1e-9))
    if state.count[PIECES] + parts > len(pieces.length):
        return False
    step = sweep / parts
    margin = 1.0 + 0.625 * step * step
    weight = contexts[base + ROTARY_WEIGHT]
    end_way = arc_node(sweep, limits, weight, state)
    way = arc_node(0.0, limits, weight, state)
    length = 0.5 * (way + end_way) * sweep
    facing = limits.geometry[0]
    shift = state.target[facing] - rows.end[row * n + facing] if facing >= 0 else 0.0
    speed = capped_speed(programmed_speed(rows, row, contexts, base, length, 0.0, state), state)
    follows_radius = contexts[base + SURFACE_MM_S] != 0.0 and contexts[base + PER_REVOLUTION] != 0.0
    node2 = arc_caps(limits, state, margin)
    entry2 = join(rows.kind[row], contexts, base, limits, state, length, weight, min(node2, speed * speed))
    at = state.count[PIECES] * 4 * n
    for part in range(parts):
        if follows_radius and facing >= 0:
            c, s, r = cos((part + 0.5) * step), sin((part + 0.5) * step), state.turn[1]
            start_x = state.position[facing] - shift
            radius = start_x + r * ((c - 1.0) * state.basis[0] + s * state.basis[3])
            speed = programmed_speed(rows, row, contexts, base, length, radius, state)
            speed = speed if speed > 0.0 else inf
        for i in range(n):
            pieces.vectors[at + i] = state.unit[i] * margin
            pieces.vectors[at + 2 * n + i] = state.bend[i] * margin
        next_way = arc_node((part + 1) * step, limits, weight, state)
        next2 = arc_caps(limits, state, margin)
        pull, cap2 = inf, speed * speed
        for i in range(n):
            pieces.vectors[at + n + i] = state.unit[i] * margin
            pieces.vectors[at + 3 * n + i] = state.bend[i] * margin
            share = max(abs(pieces.vectors[at + i]), abs(pieces.vectors[at + n + i]))
            if share > 0.0:
                top = limits.max_feed[i] / share
                cap2 = min(cap2, top * top)
                pull = min(pull, limits.acceleration[i] / share)
        p_entry2 = min(entry2, cap2)
        add_piece(
            pieces, state, 0.5 * (way + next_way) * step, cap2, p_entry2, pull, CURVED, number, rows.context[row] * 2 + 1
        )
        way, entry2, at = next_way, min(cap2, next2), at + 4 * n
    for i in range(n):
        state.tangent[i] = state.unit[i]
    state.now[EXIT2] = entry2
    state.now[ROW_LENGTH], state.now[METRIC], state.now[SMOOTH] = length, weight, 0.0
    return True
