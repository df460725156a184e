"""Arcs, helices and spirals become pieces."""

from __future__ import annotations

from math import atan2, ceil, cos, inf, pi, sin, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.alone import settle_alone
from polycnc.motion.kernels.columns import (
    ACCELERATION,
    ALONE,
    BASIS,
    BEND,
    BENT,
    BENT_BEFORE,
    CAP2,
    CCW,
    CURVE,
    CURVED,
    DELTA,
    DRIVE_SPEED,
    EASE,
    ENTRY2,
    EXIT2,
    EXIT_PULL,
    FACING,
    FRAME,
    GEOMETRY,
    GROWTH,
    HAS_FRAME,
    HELIX_CCW,
    HOLD2,
    HOLD_PULL,
    JOINT_PULL,
    KIND,
    LENGTH,
    LIMIT_BLOCKS,
    MARGIN,
    METRIC,
    MIRROR,
    OFFSETS,
    PATH_FEED,
    PATH_PULL,
    PIECES_PER_TURN,
    PLACES,
    POSITION,
    PULL,
    RADIUS,
    RAMP_S,
    REST,
    RISE,
    ROTARY,
    ROTARY_WEIGHT,
    ROW_LENGTH,
    ROW_TOP,
    SAME_POINT_MM,
    SHARE_COUNT,
    SHARE_EASE,
    SHARE_END,
    SHARE_TOP,
    SMOOTH,
    STATE_BLOCKS,
    SWEEP,
    TANGENT,
    TARGET,
    THREAD,
    TOP_FEED,
    UNIT,
    VECTORS,
)
from polycnc.motion.kernels.corners import join
from polycnc.motion.kernels.feeds import (
    asked_speed,
    bound,
    bounded,
    drive_factor,
    follows_radius,
    has_room,
    next_piece,
    norm,
    open_joint,
    place,
)
from polycnc.motion.kernels.jerk import arc_hold

SAME2 = SAME_POINT_MM * SAME_POINT_MM
#: Parts of an arc are not shorter than this, radians.
NO_PART = 1e-12


def find_arc(curves: Floats, contexts: Floats, record: int, n: int, limits: Floats, state: Floats) -> bool:
    """Set the state's BASIS, SWEEP, RADIUS, GROWTH and RISE for the row at hand, in machine coordinates.

    False where the start lies in the centre, and for a straight thread.
    """
    is_thread = state[KIND] == THREAD
    c, geometry = int(state[CURVE]) + (2 if is_thread else 0), LIMIT_BLOCKS * n + GEOMETRY
    to_start, to_end, normal = BASIS, BASIS + 3, BASIS + 6
    size2 = 0.0
    for j in range(3):
        across, center = curves[c + 3 + j], curves[c + j]
        if contexts[record + HAS_FRAME] != 0.0:
            across, center = 0.0, contexts[record + FRAME + 9 + j]
            for k in range(3):
                across += contexts[record + FRAME + 3 * j + k] * curves[c + 3 + k]
                center += contexts[record + FRAME + 3 * j + k] * curves[c + k]
        size2 += across * across
        state[normal + j] = across
        state[to_start + j] = state[to_end + j] = 0.0
        axis = int(limits[geometry + j])
        if axis >= 0:
            center += contexts[record + OFFSETS + axis]
            state[to_start + j] = state[STATE_BLOCKS + POSITION * n + axis] - center
            state[to_end + j] = state[STATE_BLOCKS + TARGET * n + axis] - center
    if size2 == 0.0:
        return False
    start_along, end_along = 0.0, 0.0
    for j in range(3):
        state[normal + j] /= sqrt(size2)
        start_along += state[to_start + j] * state[normal + j]
        end_along += state[to_end + j] * state[normal + j]
    start2, end2, apart2 = 0.0, 0.0, 0.0
    for j in range(3):
        state[to_start + j] -= start_along * state[normal + j]
        state[to_end + j] -= end_along * state[normal + j]
        start2 += state[to_start + j] * state[to_start + j]
        end2 += state[to_end + j] * state[to_end + j]
        apart2 += (state[to_start + j] - state[to_end + j]) * (state[to_start + j] - state[to_end + j])
    if start2 <= SAME2:
        return False
    state[RADIUS], state[RISE] = sqrt(start2), end_along - start_along
    state[GROWTH] = sqrt(end2) - state[RADIUS]
    ccw = is_thread or state[KIND] == CCW or state[KIND] == HELIX_CCW
    sense = contexts[record + MIRROR] * (1.0 if ccw else -1.0)
    state[SWEEP] = first_turn(state, sense, apart2)
    if not is_thread:
        state[SWEEP] += 2.0 * pi * curves[c + 6]
    return True


def first_turn(state: Floats, sense: float, apart2: float) -> float:
    """Make BASIS unit vectors (to the start, along the way there, normal); the angle of the first turn."""
    end_x, end_y, end_z = state[BASIS + 3], state[BASIS + 4], state[BASIS + 5]
    for j in range(BASIS, BASIS + 3):
        state[j] /= state[RADIUS]
    x, y, z = state[BASIS], state[BASIS + 1], state[BASIS + 2]
    nx, ny, nz = state[BASIS + 6], state[BASIS + 7], state[BASIS + 8]
    forth_x, forth_y, forth_z = (
        sense * (ny * z - nz * y),
        sense * (nz * x - nx * z),
        sense * (nx * y - ny * x),
    )
    state[BASIS + 3], state[BASIS + 4], state[BASIS + 5] = forth_x, forth_y, forth_z
    if apart2 <= SAME2:
        return 2.0 * pi
    angle = atan2(end_x * forth_x + end_y * forth_y + end_z * forth_z, end_x * x + end_y * y + end_z * z)
    return angle if angle > 0.0 else angle + 2.0 * pi


def arc_point(angle: float, n: int, limits: Floats, weight: float, state: Floats) -> float:
    """Set UNIT to q' and BEND to q'' at an angle of the arc; the way per radian.

    The curve is `r(φ)·e(φ) + h·φ·N` with a radius that grows in proportion; other axes move evenly with the
    angle.
    """
    unit, bend, geometry = STATE_BLOCKS + UNIT * n, STATE_BLOCKS + BEND * n, LIMIT_BLOCKS * n + GEOMETRY
    sweep = state[SWEEP]
    growth = state[GROWTH] / sweep
    radius = state[RADIUS] + growth * angle
    c, s = cos(angle), sin(angle)
    for i in range(n):
        state[unit + i] = state[STATE_BLOCKS + DELTA * n + i] / sweep
        state[bend + i] = 0.0
    for j in range(3):
        i = int(limits[geometry + j])
        if i >= 0:
            outward = c * state[BASIS + j] + s * state[BASIS + 3 + j]
            forth = c * state[BASIS + 3 + j] - s * state[BASIS + j]
            state[unit + i] = growth * outward + radius * forth + state[RISE] / sweep * state[BASIS + 6 + j]
            state[bend + i] = 2.0 * growth * forth - radius * outward
    way = norm(state, unit, n, limits, weight)
    along = 0.0
    for i in range(n):
        w = weight if limits[ROTARY * n + i] != 0.0 else 1.0
        state[unit + i] /= way
        along += w * w * state[unit + i] * state[bend + i]
    for i in range(n):
        state[bend + i] = (state[bend + i] - state[unit + i] * along) / (way * way)
    return way


def point_cap2(n: int, limits: Floats, state: Floats, margin: float) -> float:
    """Largest x at a point of a curve at which every axis keeps its velocity and can hold the speed."""
    unit, bend = STATE_BLOCKS + UNIT * n, STATE_BLOCKS + BEND * n
    cap2 = inf
    for i in range(n):
        share, curvature = abs(state[unit + i]) * margin, abs(state[bend + i]) * margin
        if share > 0.0:
            speed = limits[TOP_FEED * n + i] / share
            cap2 = min(cap2, speed * speed)
        if curvature > 0.0:
            cap2 = min(cap2, limits[ACCELERATION * n + i] / curvature)
    return cap2


def lay_arc(
    curves: Floats, contexts: Floats, record: int, n: int, limits: Floats, pieces: Floats, state: Floats
) -> bool:
    """An arc, helix or spiral in pieces of equal angle; false when the room ends.

    Over a piece of angle d the acceleration of an axis, `f(φ)`, has `|f''| <= 5·a`, so that it exceeds the
    larger of its end values by at most `5·d²/8` of the limit; tangents and curvature are stored larger by
    that much.
    """
    sweep, gentle = state[SWEEP], contexts[record + RAMP_S] > 0.0
    parts = ceil(sweep * PIECES_PER_TURN / (2.0 * pi) - 1e-9)
    if not has_room(pieces, contexts, record, state, parts + int(state[SHARE_COUNT]), n):
        return False
    step = sweep / parts
    margin, weight = 1.0 + 0.625 * step * step, contexts[record + ROTARY_WEIGHT]
    end_way = arc_point(sweep, n, limits, weight, state)
    way = arc_point(0.0, n, limits, weight, state)
    length = 0.5 * (way + end_way) * sweep
    radius, highest = facing_radius(0.0, n, limits, state), limits[LIMIT_BLOCKS * n + PATH_FEED]
    highest = min(highest, state[ROW_TOP])
    speed = min(bounded(asked_speed(curves, contexts, record, state, length, radius), state), highest)
    entry2, pull = point_cap2(n, limits, state, margin), inf
    if gentle:
        cap2, pull = arc_hold(contexts, record, n, limits, state, curvature(n, limits, weight, state), speed)
        entry2 = min(entry2, cap2)
    entry2 = join(contexts, record, n, limits, state, length, weight, min(entry2, speed * speed), 0.0)
    if state[REST] > 0.0:
        settle_alone(pieces, n, limits, state)
    state[ALONE] = 0.0
    state[JOINT_PULL] = min(state[JOINT_PULL], pull)
    part, last = 0, 0.0
    while part < parts:
        is_first, first, last = last == 0.0, last, edge_of_arc(last, (part + 1) * step, state)
        part += 1 if last == (part + 1) * step else 0
        own = share_of_arc(0.5 * (first + last) / sweep, state)
        if follows_radius(contexts, record):
            radius = facing_radius(0.5 * (first + last), n, limits, state)
            speed = min(bound(asked_speed(curves, contexts, record, state, length, radius), state), highest)
        at = next_piece(pieces, state, BENT if gentle else CURVED, 0.0, n)
        if is_first:
            open_joint(pieces, at, state, entry2)
        pieces[at + MARGIN] = margin
        place_arc(pieces, at, first, last, n, limits, state)
        bend = curvature(n, limits, weight, state)
        store_point(pieces, at + VECTORS, n, state, margin)
        next_way = arc_point(last, n, limits, weight, state)
        store_point(pieces, at + VECTORS + n, n, state, margin)
        bound_curve(pieces, at, n, limits, min(speed, own))
        if contexts[record + DRIVE_SPEED] < 1.0 or state[EASE] < 1.0:
            slow_down(contexts, record, pieces, at, n, limits, state)
        if gentle:
            bend = max(bend, curvature(n, limits, weight, state))
            before = pull
            cap2, pull = arc_hold(contexts, record, n, limits, state, bend, min(speed, own))
            pieces[at + CAP2], pieces[at + PULL] = min(cap2, pieces[at + CAP2]), pull
            pieces[at + HOLD2] = min(entry2, pieces[at + CAP2])
            pieces[at + HOLD_PULL] = min(state[JOINT_PULL] if is_first else before, pull)
        pieces[at + LENGTH] = 0.5 * (way + next_way) * (last - first)
        pieces[at + ENTRY2] = min(entry2, pieces[at + CAP2])
        entry2 = min(pieces[at + CAP2], point_cap2(n, limits, state, margin))
        way = next_way
    for i in range(n):
        state[STATE_BLOCKS + TANGENT * n + i] = state[STATE_BLOCKS + UNIT * n + i]
        state[STATE_BLOCKS + BENT_BEFORE * n + i] = state[STATE_BLOCKS + BEND * n + i]
    state[EXIT_PULL] = pull
    state[EXIT2], state[ROW_LENGTH], state[METRIC], state[SMOOTH] = entry2, length, weight, 0.0
    return True


def edge_of_arc(first: float, last: float, state: Floats) -> float:
    """Where a part of an arc ends that begins at an angle: at `last`, or before it at the end of a share."""
    if state[SHARE_COUNT] > 1.0:
        for k in range(int(state[SHARE_COUNT])):
            end = state[SHARE_END + k] * state[SWEEP]
            if first + NO_PART < end < last - NO_PART:
                return end
    return last


def share_of_arc(middle: float, state: Floats) -> float:
    """Highest speed around a place (0 to 1) of an arc under a transformation; sets EASE to what holds there."""
    count, k = int(state[SHARE_COUNT]), 0
    if count <= 1:
        return inf
    while k + 1 < count and state[SHARE_END + k] < middle:
        k += 1
    state[EASE] = state[SHARE_EASE + k]
    return state[SHARE_TOP + k]


def slow_down(
    contexts: Floats, record: int, pieces: Floats, at: int, n: int, limits: Floats, state: Floats
) -> None:
    """Set PATH_PULL of a curved piece: under DRIVE, and where real axes behind the path need it."""
    fastest, factor = sqrt(pieces[at + CAP2]), state[EASE]
    for end in range(2):
        first = at + VECTORS + end * n
        factor = min(
            factor,
            state[EASE] * drive_factor(contexts, record, n, limits, state, pieces, first, fastest),
        )
    pieces[at + PATH_PULL] = factor * pieces[at + PULL]


def curvature(n: int, limits: Floats, weight: float, state: Floats) -> float:
    """Length of q'' at the point that `arc_point` has set, 1/mm."""
    return max(norm(state, STATE_BLOCKS + BEND * n, n, limits, weight), 1e-12)


def place_arc(
    pieces: Floats, at: int, first: float, last: float, n: int, limits: Floats, state: Floats
) -> None:
    """Give a piece its ends: those of the arc at two angles."""
    geometry, sweep = LIMIT_BLOCKS * n + GEOMETRY, state[SWEEP]
    place(pieces, at, n, state, first / sweep, last / sweep)
    here = at + VECTORS + PLACES * n
    for j in range(3):
        i = int(limits[geometry + j])
        if i >= 0:
            for end in range(2):
                angle = last if end == 1 else first
                radius = state[RADIUS] + state[GROWTH] / sweep * angle
                c, s = radius * cos(angle) - state[RADIUS], radius * sin(angle)
                pieces[here + end * n + i] = state[STATE_BLOCKS + POSITION * n + i] + (
                    c * state[BASIS + j]
                    + s * state[BASIS + 3 + j]
                    + state[RISE] * angle / sweep * state[BASIS + 6 + j]
                )


def facing_radius(angle: float, n: int, limits: Floats, state: Floats) -> float:
    """Turning radius (work X) at an angle of the arc."""
    facing = int(limits[LIMIT_BLOCKS * n + GEOMETRY])
    if facing < 0:
        return 0.0
    start = state[FACING] - state[STATE_BLOCKS + DELTA * n + facing]
    return start + state[RADIUS] * ((cos(angle) - 1.0) * state[BASIS] + sin(angle) * state[BASIS + 3])


def store_point(pieces: Floats, at: int, n: int, state: Floats, margin: float) -> None:
    """Store q' and q'' of a point, the curvature two blocks behind the tangent."""
    for i in range(n):
        pieces[at + i] = state[STATE_BLOCKS + UNIT * n + i] * margin
        pieces[at + 2 * n + i] = state[STATE_BLOCKS + BEND * n + i] * margin


def bound_curve(pieces: Floats, at: int, n: int, limits: Floats, speed: float) -> None:
    """Set CAP2 and PULL of a curved piece from the tangents at its ends."""
    cap2, pull = speed * speed, inf
    for i in range(n):
        share = max(abs(pieces[at + VECTORS + i]), abs(pieces[at + VECTORS + n + i]))
        if share > 0.0:
            top = limits[TOP_FEED * n + i] / share
            cap2 = min(cap2, top * top)
            pull = min(pull, limits[ACCELERATION * n + i] / share)
    pieces[at + CAP2], pieces[at + PULL] = cap2, pull
