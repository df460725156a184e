"""Straight rows of a tool's tip, laid out under the limits of the axes behind it, where the jerk has no limit.

The tip goes straight; the axes that lead it do not. So a row is laid in pieces along which the joints turn by little,
and their q' and q'' are those of the real axes: `speeds.py` then holds their velocity and acceleration at both ends of
every piece. Where the tip goes on in another direction, rows are bent (`rounding.py`): there the columns accelerate in
any direction, and what the real axes have left for that is `corner_of`.
"""

from __future__ import annotations

from math import ceil, inf

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.columns import (
    AT_END,
    FEED,
    RAPID,
    ContextRecord,
    Form,
    Limits,
    PieceRecord,
    State,
    square,
)
from polycnc.motion.kernels.corners import SAME_DIRECTION, join
from polycnc.motion.kernels.demands import demand, within
from polycnc.motion.kernels.feeds import (
    block_top,
    bounded,
    counted_length,
    has_room,
    is_rapid,
    next_piece,
    open_joint,
    place,
    radius_on_line,
    straight_speed,
)
from polycnc.motion.kernels.rounding import BENDS
from polycnc.transformation.orientation.linkage import (
    RADIAN,
    Block,
    Room,
    ask,
    derive,
    set_turns,
    turned_by,
)

#: Degrees by which the joints turn along a piece; pieces of a row at most.
PIECE_DEG, MOST_PIECES = 2.0, 720
#: What derivatives are stored larger by, for each square of a radian that the joints turn along a piece.
MARGIN = 2.5


def is_led(contexts: Floats, record: int, limits: Limits, state: State) -> bool:
    """Whether the row at hand is laid out so."""
    straight = state.row.kind == FEED or state.row.kind == RAPID
    return straight and len(limits.linkage) > 0 and contexts[record + ContextRecord.LED] != 0.0


def lay_led(
    curves: Floats, contexts: Floats, record: int, n: int, limits: Limits, pieces: Floats, state: State
) -> bool:
    """Lay the row at hand out; false when the room ends."""
    delta, unit, room = state.delta, state.unit, state.room
    length, weight = counted_length(contexts, record, n, limits, state)
    if length == 0.0:
        return True
    turned = turned_by(limits.linkage, delta)
    parts = min(max(ceil(turned / PIECE_DEG), 1), MOST_PIECES)
    if not has_room(pieces, contexts, record, state, parts, n):
        return False
    margin = 1.0 + MARGIN * square(turned * RADIAN / parts)
    for i in range(n):
        unit[i], state.bend[i] = delta[i] / length, 0.0
        room[Room.BLOCKS + Block.ORIGIN * n + i] = (
            state.position[i] - contexts[record + ContextRecord.OFFSETS + i]
        )
    radius = radius_on_line(contexts, record, limits, state, 0.5)
    asked = straight_speed(curves, contexts, record, state, length, radius, weight)
    speed = min(bounded(asked, state), led_top(length, limits, state))
    faster = contexts[record + ContextRecord.RAPID_SHARE] if is_rapid(state) else 1.0
    entry2 = meet(contexts, record, n, limits, state, length, weight, speed * speed)
    look(n, limits, room, unit, 0.0)
    point2 = led_cap2(n, limits, room, margin)
    for part in range(parts):
        at = next_piece(pieces, state, Form.LED, speed * speed, n)
        place(pieces, at, n, state, part / parts, (part + 1) / parts)
        if part == 0:
            open_joint(pieces, at, state, entry2)
        store(pieces, at + PieceRecord.VECTORS, n, room, margin)
        look(n, limits, room, unit, length * (part + 1) / parts)
        store(pieces, at + PieceRecord.VECTORS + n, n, room, margin)
        pieces[at + PieceRecord.MARGIN], pieces[at + PieceRecord.LENGTH] = margin, length / parts
        pieces[at + PieceRecord.ASKED] = asked / state.run.override
        bound_led(pieces, at, n, limits, state, speed, faster)
        pieces[at + PieceRecord.ENTRY2] = min(entry2, point2, pieces[at + PieceRecord.CAP2])
        point2, entry2 = led_cap2(n, limits, room, margin), pieces[at + PieceRecord.CAP2]
    for i in range(n):
        state.tangent[i], state.bent_before[i] = unit[i], 0.0
    state.run.alone, state.run.exit_pull, state.run.exit2 = 0.0, inf, min(entry2, point2)
    state.run.length, state.run.metric, state.run.smooth = length, weight, 0.0
    state.run.corner_top2, state.share_ease[AT_END] = corner_of(n, limits, state, length)
    return True


def led_top(length: float, limits: Limits, state: State) -> float:
    """Highest speed of the row at hand that no single axis sets."""
    if is_rapid(state):
        return state.row.top
    return min(limits.path.path_feed, state.row.top, block_top(length, limits, state))


def meet(
    contexts: Floats,
    record: int,
    n: int,
    limits: Limits,
    state: State,
    length: float,
    weight: float,
    cap2: float,
) -> float:
    """Largest x at the joint between the row before and this one, a led one; sets what its bend may use."""
    top2, ease = corner_of(n, limits, state, 0.0)
    state.joint.ease = BENDS * min(state.joint.ease, ease)
    if state.run.corner_top2 > 0.0:
        top2 = min(top2, state.run.corner_top2)
    turns = False
    for i in range(n):
        turns = turns or abs(state.unit[i] - state.tangent[i]) > SAME_DIRECTION
    entry2 = join(contexts, record, n, limits, state, length, weight, cap2, 0.0)
    state.joint.top2 = top2
    return min(entry2, top2) if turns else entry2


def corner_of(n: int, limits: Limits, state: State, way: float) -> tuple[float, float]:
    """Largest x, and factor on the limits of the columns, at a corner at a way along the row at hand."""
    look(n, limits, state.room, state.unit, way)
    ask(limits.linkage, n, state.room, state.unit, way, limits.acceleration, limits.jerk)
    top, bend, pull, jerk, turn = demand(limits, n, state.room, is_rapid(state), False)
    top, ease = within(top, bend, pull, jerk, turn, 1.0, 0.0)
    return top * top, ease


def look(n: int, limits: Limits, room: Floats, unit: Floats, way: float) -> None:
    """Derive the real axes at a way along the row at hand."""
    set_turns(limits.linkage, n, room, unit, way)
    derive(limits.linkage, n, room, unit, way)


def led_cap2(n: int, limits: Limits, room: Floats, margin: float) -> float:
    """Largest x at a place at which every axis can hold the speed."""
    cap2 = inf
    for i in range(n):
        curvature = abs(room[Room.BLOCKS + Block.SECOND * n + i]) * margin
        if curvature > 0.0:
            cap2 = min(cap2, limits.acceleration[i] / curvature)
    return cap2


def store(pieces: Floats, at: int, n: int, room: Floats, margin: float) -> None:
    """Store q' and q'' of a place, the curvature two blocks behind the tangent."""
    for i in range(n):
        pieces[at + i] = room[Room.BLOCKS + Block.FIRST * n + i] * margin
        pieces[at + 2 * n + i] = room[Room.BLOCKS + Block.SECOND * n + i] * margin


def bound_led(
    pieces: Floats, at: int, n: int, limits: Limits, state: State, speed: float, faster: float
) -> None:
    """Set CAP2 and PULL of a piece from q' at its ends."""
    cap2, pull, here = speed * speed, inf, at + PieceRecord.VECTORS
    tops = limits.top_rapid if is_rapid(state) else limits.top_feed
    for i in range(n):
        share = max(abs(pieces[here + i]), abs(pieces[here + n + i]))
        if share > 0.0:
            top = faster * tops[i] / share
            cap2 = min(cap2, top * top)
            pull = min(pull, limits.acceleration[i] / share)
    pieces[at + PieceRecord.CAP2], pieces[at + PieceRecord.PULL] = cap2, pull
