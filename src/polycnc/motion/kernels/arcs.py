"""Arcs, helices and spirals become pieces."""

from __future__ import annotations

from math import atan2, ceil, cos, inf, pi, sin, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.alone import settle_alone
from polycnc.motion.kernels.chords import end_chord
from polycnc.motion.kernels.columns import (
    CCW,
    HELIX_CCW,
    PIECES_PER_TURN,
    PLACES,
    SAME_POINT_MM,
    THREAD,
    ContextRecord,
    Form,
    Limits,
    PieceRecord,
    State,
    square,
)
from polycnc.motion.kernels.corners import join
from polycnc.motion.kernels.feeds import (
    asked_speed,
    block_top,
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
from polycnc.motion.kernels.jerk import ARC_ACROSS, ARC_JERK, LONE, arc_hold

SAME2 = SAME_POINT_MM * SAME_POINT_MM
#: A radius that grows by less of itself is one.
SAME_RADIUS = 1e-6
#: Parts of an arc are not shorter than this, radians.
NO_PART = 1e-12


def find_arc(curves: Floats, contexts: Floats, record: int, limits: Limits, state: State) -> bool:
    """Set the state's `basis` and `arc` for the row at hand, in machine coordinates.

    False where the start lies in the centre, and for a straight thread.
    """
    is_thread = state.row.kind == THREAD
    c, basis = state.row.curve + (2 if is_thread else 0), state.basis
    to_start, to_end, normal = 0, 3, 6
    size2 = 0.0
    for j in range(3):
        across, center = curves[c + 3 + j], curves[c + j]
        if contexts[record + ContextRecord.HAS_FRAME] != 0.0:
            across, center = 0.0, contexts[record + ContextRecord.FRAME + 9 + j]
            for k in range(3):
                across += contexts[record + ContextRecord.FRAME + 3 * j + k] * curves[c + 3 + k]
                center += contexts[record + ContextRecord.FRAME + 3 * j + k] * curves[c + k]
        size2 += across * across
        basis[normal + j] = across
        basis[to_start + j] = basis[to_end + j] = 0.0
        axis = limits.geometry[j]
        if axis >= 0:
            center += contexts[record + ContextRecord.OFFSETS + axis]
            basis[to_start + j] = state.position[axis] - center
            basis[to_end + j] = state.target[axis] - center
    if size2 == 0.0:
        return False
    start_along, end_along = 0.0, 0.0
    for j in range(3):
        basis[normal + j] /= sqrt(size2)
        start_along += basis[to_start + j] * basis[normal + j]
        end_along += basis[to_end + j] * basis[normal + j]
    start2, end2, apart2 = 0.0, 0.0, 0.0
    for j in range(3):
        basis[to_start + j] -= start_along * basis[normal + j]
        basis[to_end + j] -= end_along * basis[normal + j]
        start2 += basis[to_start + j] * basis[to_start + j]
        end2 += basis[to_end + j] * basis[to_end + j]
        apart2 += (basis[to_start + j] - basis[to_end + j]) * (basis[to_start + j] - basis[to_end + j])
    if start2 <= SAME2:
        return False
    state.arc.radius, state.arc.rise = sqrt(start2), end_along - start_along
    state.arc.growth = sqrt(end2) - state.arc.radius
    ccw = is_thread or state.row.kind == CCW or state.row.kind == HELIX_CCW
    sense = contexts[record + ContextRecord.MIRROR] * (1.0 if ccw else -1.0)
    state.arc.sweep = first_turn(state, sense, apart2)
    if not is_thread:
        state.arc.sweep += 2.0 * pi * curves[c + 6]
    return True


def first_turn(state: State, sense: float, apart2: float) -> float:
    """Make `basis` unit vectors (to the start, along the way there, normal); the angle of the first turn."""
    end_x, end_y, end_z = state.basis[3], state.basis[4], state.basis[5]
    for j in range(3):
        state.basis[j] /= state.arc.radius
    x, y, z = state.basis[0], state.basis[1], state.basis[2]
    nx, ny, nz = state.basis[6], state.basis[7], state.basis[8]
    forth_x, forth_y, forth_z = (
        sense * (ny * z - nz * y),
        sense * (nz * x - nx * z),
        sense * (nx * y - ny * x),
    )
    state.basis[3], state.basis[4], state.basis[5] = forth_x, forth_y, forth_z
    if apart2 <= SAME2:
        return 2.0 * pi
    angle = atan2(end_x * forth_x + end_y * forth_y + end_z * forth_z, end_x * x + end_y * y + end_z * z)
    return angle if angle > 0.0 else angle + 2.0 * pi


def arc_point(angle: float, n: int, limits: Limits, weight: float, state: State) -> float:
    """Set `unit` to q' and `bend` to q'' at an angle of the arc; the way per radian.

    The curve is `r(φ)·e(φ) + h·φ·N` with a radius that grows in proportion; other axes move evenly with the
    angle.
    """
    unit, bend = state.unit, state.bend
    sweep = state.arc.sweep
    growth = state.arc.growth / sweep
    radius = state.arc.radius + growth * angle
    c, s = cos(angle), sin(angle)
    for i in range(n):
        unit[i] = state.delta[i] / sweep
        bend[i] = 0.0
    for j in range(3):
        i = limits.geometry[j]
        if i >= 0:
            outward = c * state.basis[j] + s * state.basis[3 + j]
            forth = c * state.basis[3 + j] - s * state.basis[j]
            unit[i] = growth * outward + radius * forth + state.arc.rise / sweep * state.basis[6 + j]
            bend[i] = 2.0 * growth * forth - radius * outward
    way = norm(unit, n, limits, weight)
    along = 0.0
    for i in range(n):
        w = weight if limits.rotary[i] != 0.0 else 1.0
        unit[i] /= way
        along += w * w * unit[i] * bend[i]
    for i in range(n):
        bend[i] = (bend[i] - unit[i] * along) / (way * way)
    return way


def leads_tip(limits: Limits, state: State) -> bool:
    """Whether shares of the row at hand hold the velocities of the axes that lead a tip: its columns have none then."""
    return state.row.shares > 1.0 and len(limits.linkage) > 0


def point_cap2(n: int, limits: Limits, state: State, margin: float) -> float:
    """Largest x at a point of a curve at which every axis keeps its velocity and can hold the speed."""
    unit, bend = state.unit, state.bend
    cap2, leads = inf, leads_tip(limits, state)
    for i in range(n):
        share, curvature = abs(unit[i]) * margin, abs(bend[i]) * margin
        if share > 0.0 and not leads:
            speed = limits.top_feed[i] / share
            cap2 = min(cap2, speed * speed)
        if curvature > 0.0:
            cap2 = min(cap2, state.arc.ease * limits.acceleration[i] / curvature)
    return cap2


def asked_on_arc(
    curves: Floats,
    contexts: Floats,
    record: int,
    limits: Limits,
    state: State,
    length: float,
    share: float,
) -> float:
    """Path speed that the program asks for at a share of the arc at hand, of a length.

    It may follow the turning radius there. F may be the speed along the arc alone.
    """
    radius_mm = facing_radius(share * state.arc.sweep, limits, state)
    if state.row.kind == THREAD:
        return asked_speed(curves, contexts, record, state, length, radius_mm)
    counted = state.arc.radius if limits.path.arc_by_radius != 0.0 else length
    asked = asked_speed(curves, contexts, record, state, counted, radius_mm)
    along = (state.arc.radius + 0.5 * state.arc.growth) * state.arc.sweep
    if limits.path.feed_along_arc != 0.0 and along > 0.0 and length > along * (1.0 + SAME_RADIUS):
        asked *= length / along
    return asked


def lay_arc(
    curves: Floats, contexts: Floats, record: int, n: int, limits: Limits, pieces: Floats, state: State
) -> bool:
    """An arc, helix or spiral in pieces of equal angle; false when the room ends.

    Where the same limits hold all along it, nobody sees a difference if all but the first and the last are one piece.

    Over a piece of angle d the acceleration of an axis, `f(φ)`, has `|f''| <= 5·a`, so that it exceeds the
    larger of its end values by at most `5·d²/8` of the limit; tangents and curvature are stored larger by
    that much. A spiral turns its direction by more than its angle.
    """
    sweep, gentle = state.arc.sweep, contexts[record + ContextRecord.RAMP_S] > 0.0
    turning = sweep * turns_faster(state)
    parts = max(ceil(turning * PIECES_PER_TURN / (2.0 * pi) - 1e-9), 1)
    if not has_room(pieces, contexts, record, state, parts + state.row.shares, n):
        return False
    end_chord(pieces, n, limits, state)
    step = sweep / parts
    margin, weight = 1.0 + 0.625 * square(turning / parts), contexts[record + ContextRecord.ROTARY_WEIGHT]
    state.arc.ease = shared_ease(gentle, state)
    end_way = arc_point(sweep, n, limits, weight, state)
    way = arc_point(0.0, n, limits, weight, state)
    length = 0.5 * (way + end_way) * sweep
    follows, middle = follows_radius(contexts, record, state), 0.5 / parts
    highest = min(limits.path.path_feed, state.row.top, block_top(length, limits, state))
    highest = min(highest, arc_top(contexts, record, way, end_way, limits, state))
    asked = asked_on_arc(curves, contexts, record, limits, state, length, middle)
    speed = min(bounded(asked, state), highest)
    entry2, pull = point_cap2(n, limits, state, margin), inf
    if gentle:
        bend = curvature(n, limits, weight, state)
        cap2, pull = arc_hold(contexts, record, limits, state, bend, speed, 1.0 / way)
        entry2 = min(entry2, cap2)
    state.run.rate = max(state.run.rate, 1.0 / way)
    entry2 = join(contexts, record, n, limits, state, length, weight, min(entry2, speed * speed), 0.0)
    if state.joint.rest > 0.0 or state.run.window == 0.0:
        settle_alone(pieces, n, limits, state)
    state.run.alone = 0.0
    state.joint.pull = min(state.joint.pull, pull)
    even = parts > 2 and is_even(contexts, record, n, limits, state, speed * margin)
    part, last = 0, 0.0
    while part < parts:
        goal = parts - 1 if even and part == 1 else part + 1
        is_first, first, last = last == 0.0, last, edge_of_arc(last, goal * step, state)
        part = goal if last == goal * step else part
        own = share_of_arc(0.5 * (first + last) / sweep, state)
        if follows:
            middle = 0.5 * (first + last) / sweep
            asked = asked_on_arc(curves, contexts, record, limits, state, length, middle)
            speed = min(bound(asked, state), highest)
        at = next_piece(pieces, state, Form.BENT if gentle else Form.CURVED, 0.0, n)
        if is_first:
            open_joint(pieces, at, state, entry2)
        pieces[at + PieceRecord.MARGIN] = margin / state.arc.ease
        pieces[at + PieceRecord.ASKED] = asked / state.run.override
        place_arc(pieces, at, first, last, n, limits, state)
        bend = curvature(n, limits, weight, state)
        store_point(pieces, at + PieceRecord.VECTORS, n, state, margin)
        middle_way = way
        if state.arc.growth != 0.0:
            middle_way = arc_point(0.5 * (first + last), n, limits, weight, state)
        next_way = arc_point(last, n, limits, weight, state)
        store_point(pieces, at + PieceRecord.VECTORS + n, n, state, margin)
        # On a spiral the way grows unevenly (Simpson's rule): a length that is off would bend the cubic along itself.
        pieces[at + PieceRecord.LENGTH] = (way + 4.0 * middle_way + next_way) / 6.0 * (last - first)
        bound_curve(pieces, at, n, limits, state, min(speed, own))
        if contexts[record + ContextRecord.DRIVE_SPEED] < 1.0 or state.row.ease < 1.0:
            slow_down(contexts, record, pieces, at, n, limits, state)
        if gentle:
            bend = max(bend, curvature(n, limits, weight, state))
            before = pull
            rate = 1.0 / min(way, next_way)
            cap2, pull = arc_hold(contexts, record, limits, state, bend, min(speed, own), rate)
            pieces[at + PieceRecord.CAP2], pieces[at + PieceRecord.PULL] = (
                min(cap2, pieces[at + PieceRecord.CAP2]),
                pull,
            )
            pull = hold_others(contexts, record, pieces, at, n, limits, state)
            pieces[at + PieceRecord.HOLD2] = min(entry2, pieces[at + PieceRecord.CAP2])
            pieces[at + PieceRecord.HOLD_PULL] = min(state.joint.pull if is_first else before, pull)
        pieces[at + PieceRecord.ENTRY2] = min(entry2, pieces[at + PieceRecord.CAP2])
        entry2 = min(pieces[at + PieceRecord.CAP2], point_cap2(n, limits, state, margin))
        way = next_way
    for i in range(n):
        state.tangent[i] = state.unit[i]
        state.bent_before[i] = state.bend[i]
        state.bow[i] = 0.0
    state.run.exit_pull, state.run.rate = pull, 1.0 / end_way
    state.run.exit2, state.run.length, state.run.metric, state.run.smooth = entry2, length, weight, 0.0
    return True


def shared_ease(gentle: bool, state: State) -> float:
    """Part of their accelerations that the axes have for the bend of the arc at hand and for changes of speed together.

    It is stored as a larger MARGIN. Under a transformation every share has its own speed, which leaves enough for the
    bend, and `row.ease` is for changes of speed alone; so it is with limited jerk.
    """
    ease = state.row.ease
    if gentle or state.row.shares > 1.0 or ease >= 1.0:
        return 1.0
    state.row.ease = 1.0
    return ease


def arc_top(contexts: Floats, record: int, way: float, end_way: float, limits: Limits, state: State) -> float:
    """Highest speed on the arc at hand by what parameters allow axes and path to accelerate on arcs.

    `way` and `end_way` are its ways by radian at start and end, where the radius may be another one. No thread has such
    a bound, for its speed is the spindle's.
    """
    if contexts[record + ContextRecord.AHEAD] == 0.0 or state.row.kind == THREAD:
        return inf
    last = max(state.arc.radius + state.arc.growth, SAME_POINT_MM)
    room, pull = min(square(way) / state.arc.radius, square(end_way) / last), limits.path.arc_pull
    for j in range(3):
        i = limits.geometry[j]
        share = sqrt(square(state.basis[j]) + square(state.basis[3 + j]))
        if i >= 0 and share > SAME_RADIUS:
            pull = min(pull, limits.arc[i] / share)
    return max(sqrt(pull * room), limits.path.arc_least)


def is_even(contexts: Floats, record: int, n: int, limits: Limits, state: State, speed: float) -> bool:
    """Whether one speed and one acceleration along the path hold all along the arc at hand, and its places are unseen.

    That is so with limited jerk, where an arc has those that hold in its worst direction, unless an axis has to go
    slower than `speed`, or something changes along the arc.
    """
    if state.run.unseen == 0.0 or state.row.shares > 0 or state.row.ease < 1.0:
        return False
    if contexts[record + ContextRecord.RAMP_S] == 0.0 or contexts[record + ContextRecord.DRIVE_SPEED] < 1.0:
        return False
    if abs(state.arc.growth) > SAME_RADIUS * state.arc.radius:
        return False
    for i in range(n):
        along = i in (limits.geometry[0], limits.geometry[1], limits.geometry[2])
        if limits.top_feed[i] < speed if along else state.delta[i] != 0.0:
            return False
    return not follows_radius(contexts, record, state)


def turns_faster(state: State) -> float:
    """How many times as far as its angle a spiral turns its direction, where it does most: 1 for an arc, 2 at most.

    The direction is off the circle's by the angle whose tangent is `r'/r`, and that changes by `r'²/(r² + r'²)`.
    """
    growth, radius = state.arc.growth, min(state.arc.radius, state.arc.radius + state.arc.growth)
    if growth == 0.0:
        return 1.0
    around = radius * state.arc.sweep
    return 1.0 + growth * growth / (around * around + growth * growth)


def edge_of_arc(first: float, last: float, state: State) -> float:
    """Where a part of an arc ends that begins at an angle: at `last`, or before it at the end of a share."""
    if state.row.shares > 1.0:
        for k in range(state.row.shares):
            end = state.share_end[k] * state.arc.sweep
            if first + NO_PART < end < last - NO_PART:
                return end
    return last


def share_of_arc(middle: float, state: State) -> float:
    """Highest speed around a place (0 to 1) of an arc under a transformation; sets `ease` to what holds there."""
    count, k = state.row.shares, 0
    if count <= 1:
        return inf
    while k + 1 < count and state.share_end[k] < middle:
        k += 1
    state.row.ease = state.share_ease[k]
    return state.share_top[k]


def slow_down(
    contexts: Floats, record: int, pieces: Floats, at: int, n: int, limits: Limits, state: State
) -> None:
    """Set PATH_PULL of a curved piece: under DRIVE, and where real axes behind the path need it."""
    fastest, factor = state.arc.ease * sqrt(pieces[at + PieceRecord.CAP2]), state.row.ease
    for end in range(2):
        first = at + PieceRecord.VECTORS + end * n
        factor = min(
            factor,
            state.row.ease * drive_factor(contexts, record, n, limits, state, pieces, first, fastest),
        )
    pieces[at + PieceRecord.PATH_PULL] = factor * pieces[at + PieceRecord.PULL]


def curvature(n: int, limits: Limits, weight: float, state: State) -> float:
    """Length of q'' at the point that `arc_point` has set, 1/mm."""
    return max(norm(state.bend, n, limits, weight), 1e-12)


def place_arc(
    pieces: Floats, at: int, first: float, last: float, n: int, limits: Limits, state: State
) -> None:
    """Give a piece its ends: those of the arc at two angles."""
    sweep = state.arc.sweep
    place(pieces, at, n, state, first / sweep, last / sweep)
    here = at + PieceRecord.VECTORS + PLACES * n
    for j in range(3):
        i = limits.geometry[j]
        if i >= 0:
            for end in range(2):
                angle = last if end == 1 else first
                radius = state.arc.radius + state.arc.growth / sweep * angle
                c, s = radius * cos(angle) - state.arc.radius, radius * sin(angle)
                pieces[here + end * n + i] = state.position[i] + (
                    c * state.basis[j]
                    + s * state.basis[3 + j]
                    + state.arc.rise * angle / sweep * state.basis[6 + j]
                )


def hold_others(
    contexts: Floats, record: int, pieces: Floats, at: int, n: int, limits: Limits, state: State
) -> float:
    """Lower CAP2 and PULL of a piece, with limited jerk, to what the axes allow that only move along with the arc.

    Their q'' is that by which the way per radian of a spiral changes; it hardly changes along a piece. PULL as it is
    then.
    """
    here, ramp = at + PieceRecord.VECTORS, contexts[record + ContextRecord.RAMP_S]
    for i in range(n):
        share = max(abs(pieces[here + i]), abs(pieces[here + n + i]))
        if share == 0.0 or i in (limits.geometry[0], limits.geometry[1], limits.geometry[2]):
            continue
        a, j = state.row.ease * limits.acceleration[i], state.row.ease * limits.jerk[i]
        bend = max(abs(pieces[here + 2 * n + i]), abs(pieces[here + 3 * n + i]))
        if bend > 0.0:
            twist = abs(pieces[here + 3 * n + i] - pieces[here + 2 * n + i]) / pieces[at + PieceRecord.LENGTH]
            cap2 = ARC_ACROSS * a / bend
            if twist > 0.0:
                cap2 = min(cap2, (ARC_JERK * j / twist) ** (2.0 / 3.0))
            pieces[at + PieceRecord.CAP2] = min(pieces[at + PieceRecord.CAP2], cap2)
        v = sqrt(pieces[at + PieceRecord.CAP2])
        along = (LONE - ARC_JERK) * j / (2.0 * share / ramp + 3.0 * bend * v)
        along = min(along, (a - bend * v * v) / share)
        pieces[at + PieceRecord.PULL] = min(pieces[at + PieceRecord.PULL], along)
    pull: float = pieces[at + PieceRecord.PULL]
    return pull


def facing_radius(angle: float, limits: Limits, state: State) -> float:
    """Turning radius (work X) at an angle of the arc, helix or spiral."""
    facing = limits.geometry[0]
    if facing < 0:
        return 0.0
    start, share = state.row.facing - state.delta[facing], angle / state.arc.sweep
    radius = state.arc.radius + share * state.arc.growth
    outward = (radius * cos(angle) - state.arc.radius) * state.basis[0]
    return start + outward + radius * sin(angle) * state.basis[3] + share * state.arc.rise * state.basis[6]


def store_point(pieces: Floats, at: int, n: int, state: State, margin: float) -> None:
    """Store q' and q'' of a point, the curvature two blocks behind the tangent."""
    margin /= state.arc.ease
    for i in range(n):
        pieces[at + i] = state.unit[i] * margin
        pieces[at + 2 * n + i] = state.bend[i] * margin


def bound_curve(pieces: Floats, at: int, n: int, limits: Limits, state: State, speed: float) -> None:
    """Set CAP2 and PULL of a curved piece from the tangents at its ends."""
    cap2, pull, leads = speed * speed, inf, leads_tip(limits, state)
    for i in range(n):
        share = max(abs(pieces[at + PieceRecord.VECTORS + i]), abs(pieces[at + PieceRecord.VECTORS + n + i]))
        if share > 0.0:
            top = inf if leads else limits.top_feed[i] / (state.arc.ease * share)
            cap2 = min(cap2, top * top)
            pull = min(pull, limits.acceleration[i] / share)
    pieces[at + PieceRecord.CAP2], pieces[at + PieceRecord.PULL] = cap2, pull
