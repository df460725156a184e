"""Straight threads whose lead changes: at every place the speed is that of the lead there.

With K the change of the lead F each revolution, n turns lead over `F·n + K·n²/2` along the axis with the longest way.
Behind a way s the square of the lead is `F² + 2·K·s`: x rises evenly with the way, and at S turns a second the axis
accelerates by `S²·K`. So the cap on x of such a row is a line (RISE), which it runs along.

Averages over time put a way that is run under a steady acceleration c ahead by c·m/2, where m is the mean of the
squares of their times (`averaged_s2`). Hence the interpolator is as far behind in such a thread: its cap is higher by
c²·m. Where a thread goes on into one with another change of the lead, it loses or gains that way while it keeps the
speed of the joint for a little (`level_way`), on the side where the lead changes: behind the averages the axes are in
step on both sides.

A program may say how long the ways are on which a thread takes up its speed and brakes (SINUMERIK DITS, DITE): then it
does so evenly over them, whatever that asks of its axes.
"""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.columns import (
    PLACES,
    WAY_IN,
    WAY_OUT,
    ContextRecord,
    Form,
    Limits,
    PieceRecord,
    State,
    piece_width,
)
from polycnc.motion.kernels.feeds import (
    axes_of,
    bound,
    growth_of,
    is_straight_thread,
    lead_of,
    radius_on_line,
    turns_s,
)
from polycnc.motion.kernels.hold import cut, end_cap2
from polycnc.motion.kernels.jerk import averaged_s2

#: Relative difference of squared speeds that counts as none; of directions of two threads; of speeds where they meet.
SAME, NO_TURN, MEETS = 1e-9, 1e-9, 2e-3


def follow_leads(
    curves: Floats,
    contexts: Floats,
    record: int,
    before2: float,
    first: int,
    limits: Limits,
    pieces: Floats,
    state: State,
) -> int:
    """Give the pieces of the thread at hand, the last ones from `first` on, the speeds of its lead.

    Args:
        curves: Parameters of curves.
        contexts: Table of contexts.
        record: Where the context of the row begins in it.
        before2: x with which the row before may be left.
        first: Its first piece.
        limits: The machine.
        pieces: Records of pieces.
        state: That of the row.

    Returns:
        The pieces that the row before has more.
    """
    n, width = axes_of(state), piece_width(axes_of(state))
    mean2, at = 0.0, first * width
    if contexts[record + ContextRecord.RAMP_S] > 0.0:
        mean2 = averaged_s2(pieces[at + PieceRecord.RAMP], pieces[at + PieceRecord.BLEND])
    start2 = end2 = pieces[at + PieceRecord.CAP2]
    if growth_of(curves, state) != 0.0:
        start2, end2 = rise_with_lead(curves, contexts, record, first, limits, mean2, pieces, state)
    more, begins = 0, pieces[at + PieceRecord.PAUSE] > 0.0 or pieces[at + PieceRecord.ENTRY2] == 0.0
    if not begins and first > 0:
        run_on(pieces, first - 1, n)
        if goes_on(pieces, first, n) and pieces[at + PieceRecord.FORM] == Form.STRAIGHT:
            pieces[at + PieceRecord.HOLD2] = inf
            more = meet_thread(pieces, first, n, mean2, before2, start2, state)
    state.run.exit2 = end2
    if mean2 == 0.0 and is_straight_thread(curves, state):
        ramp_as_told(curves, first + more, begins, n, pieces, state)
    return more


def ramp_as_told(curves: Floats, first: int, begins: bool, n: int, pieces: Floats, state: State) -> None:
    """Let the thread at hand, the pieces from `first` on, take up its speed and brake over the ways that it names.

    Where another thread goes on behind it, `run_on` takes the latter back: PATH_PULL keeps what the axes allow.
    """
    width, length, longest = piece_width(n), 0.0, 0.0
    for i in range(n):
        longest = max(longest, abs(state.delta[i]))
    for p in range(first, state.run.pieces):
        length += pieces[p * width + PieceRecord.LENGTH]
    at = state.row.curve
    way_in, way_out = curves[at + WAY_IN] * length / longest, curves[at + WAY_OUT] * length / longest
    if begins and way_in > 0.0:
        p, left = first, min(way_in, length)
        while left > pieces[p * width + PieceRecord.LENGTH] and p + 1 < state.run.pieces:
            left -= pieces[p * width + PieceRecord.LENGTH]
            p += 1
        if left < pieces[p * width + PieceRecord.LENGTH]:
            cut(pieces, p, n, state, left)
        pull = 0.5 * end_cap2(pieces, p * width) / way_in
        for q in range(first, p + 1):
            pieces[q * width + PieceRecord.PULL] = pull
    if way_out > 0.0:
        p, left = state.run.pieces - 1, min(way_out, length)
        while left > pieces[p * width + PieceRecord.LENGTH] and p > first:
            left -= pieces[p * width + PieceRecord.LENGTH]
            p -= 1
        own = pieces[p * width + PieceRecord.LENGTH]
        if left < own and cut(pieces, p, n, state, own - left):
            p += 1
        pull = 0.5 * pieces[p * width + PieceRecord.CAP2] / way_out
        for q in range(p, state.run.pieces):
            of = q * width
            pieces[of + PieceRecord.PATH_PULL], pieces[of + PieceRecord.PULL] = (
                pieces[of + PieceRecord.PULL],
                pull,
            )


def run_on(pieces: Floats, p: int, n: int) -> None:
    """The thread that ends with piece p does not brake, for another one goes on."""
    width = piece_width(n)
    at = p * width
    while (
        p >= 0 and pieces[at + PieceRecord.FORM] == Form.STRAIGHT and pieces[at + PieceRecord.PATH_PULL] < inf
    ):
        pieces[at + PieceRecord.PULL], pieces[at + PieceRecord.PATH_PULL] = (
            pieces[at + PieceRecord.PATH_PULL],
            inf,
        )
        p -= 1
        at = p * width


def rise_with_lead(
    curves: Floats,
    contexts: Floats,
    record: int,
    first: int,
    limits: Limits,
    mean2: float,
    pieces: Floats,
    state: State,
) -> tuple[float, float]:
    """Let the caps of the pieces of the row at hand rise with its lead; x at its start and at its end.

    Where the axes do not allow the speed, or the acceleration, they do what they can.
    """
    n, width, length, longest = axes_of(state), piece_width(axes_of(state)), 0.0, 0.0
    for i in range(n):
        longest = max(longest, abs(state.delta[i]))
    for p in range(first, state.run.pieces):
        length += pieces[p * width + PieceRecord.LENGTH]
    lead, growth, ratio = lead_of(curves, state), growth_of(curves, state), length / longest
    start2, end2, way, p = 0.0, 0.0, 0.0, first
    while p < state.run.pieces:
        at = p * width
        own = pieces[at + PieceRecord.LENGTH]
        radius = radius_on_line(contexts, record, limits, state, (way + 0.5 * own) / length)
        speed = bound(turns_s(contexts, record, state, radius) * ratio, state)
        if speed == inf:
            return pieces[first * width + PieceRecord.CAP2], pieces[at + PieceRecord.CAP2]
        rise = 2.0 * speed * speed * growth / ratio
        from2 = max(speed * speed * lead * lead + rise * way, 0.0)
        to2 = max(from2 + rise * own, 0.0)
        way += own
        if p == first:
            start2 = min(from2, pieces[at + PieceRecord.CAP2])
            pieces[at + PieceRecord.ENTRY2] = min(pieces[at + PieceRecord.ENTRY2], from2)
            pieces[at + PieceRecord.HOLD2] = min(pieces[at + PieceRecord.HOLD2], from2)
        else:
            pieces[at + PieceRecord.ENTRY2] = min(pieces[at + PieceRecord.ENTRY2], from2, end2)
        end2 = min(to2, pieces[at + PieceRecord.CAP2])
        p += rise_piece(pieces, p, n, from2, to2, rise, mean2, state)
    return start2, end2


def rise_piece(
    pieces: Floats,
    p: int,
    n: int,
    from2: float,
    to2: float,
    rise: float,
    mean2: float,
    state: State,
) -> int:
    """Let the cap of a piece rise from one x to another, as far as the axes allow; how many pieces it is then."""
    at, width = p * piece_width(n), piece_width(n)
    top2, high2 = pieces[at + PieceRecord.CAP2], max(from2, to2)
    if 0.5 * abs(rise) >= pieces[at + PieceRecord.PULL]:
        pieces[at + PieceRecord.CAP2] = min(top2, high2)
        return 1
    raised = 0.25 * rise * rise * mean2
    if top2 >= (1.0 - SAME) * high2:
        pieces[at + PieceRecord.CAP2], pieces[at + PieceRecord.RISE] = from2 + raised, rise
        return 1
    if top2 <= min(from2, to2):
        return 1
    pieces[at + PieceRecord.CAP2], pieces[at + PieceRecord.RISE] = from2 + raised, rise
    if not cut(pieces, p, n, state, (top2 - from2) / rise):
        return 1
    level = at + width if rise > 0.0 else at
    pieces[level + PieceRecord.CAP2], pieces[level + PieceRecord.RISE] = top2, 0.0
    pieces[at + width + PieceRecord.ENTRY2] = top2
    return 2


def goes_on(pieces: Floats, p: int, n: int) -> bool:
    """Whether a line goes on in the direction of the piece before it, which is one too."""
    at = p * piece_width(n)
    before, here = at - piece_width(n), PieceRecord.VECTORS + PLACES * n
    if pieces[before + PieceRecord.FORM] != Form.STRAIGHT:
        return False
    for i in range(here, here + n):
        one = (pieces[before + i + n] - pieces[before + i]) / pieces[before + PieceRecord.LENGTH]
        other = (pieces[at + i + n] - pieces[at + i]) / pieces[at + PieceRecord.LENGTH]
        if abs(one - other) > NO_TURN:
            return False
    return True


def meet_thread(
    pieces: Floats, p: int, n: int, mean2: float, before2: float, start2: float, state: State
) -> int:
    """Two threads meet at the start of piece p in one direction; the pieces that the one before has more.

    `before2` and `start2` are the x of their leads there.
    """
    width, more = piece_width(n), 0
    at = p * width
    before, rise = pieces[at - width + PieceRecord.RISE], pieces[at + PieceRecord.RISE]
    if abs(before2 - start2) > MEETS * start2:
        return 0
    if abs(before - rise) <= SAME * abs(rise):
        pieces[at + PieceRecord.ENTRY2] = min(pieces[at + PieceRecord.CAP2], end_cap2(pieces, at - width))
        return 0
    if mean2 == 0.0:
        return 0
    if before != 0.0:
        more = level_before(pieces, p, n, mean2, before2, state)
    if rise != 0.0:
        level_behind(pieces, p + more, n, mean2, start2, state)
    return more


def level_before(pieces: Floats, p: int, n: int, mean2: float, joint2: float, state: State) -> int:
    """Let a thread whose lead has changed keep the speed of the joint in front of piece p; how many pieces more."""
    width = piece_width(n)
    at = (p - 1) * width
    length, rise = pieces[at + PieceRecord.LENGTH], pieces[at + PieceRecord.RISE]
    way = level_way(rise < 0.0, sqrt(joint2), 0.5 * abs(rise), pieces[at + PieceRecord.PULL], mean2)
    if way >= length or not cut(pieces, p - 1, n, state, length - way):
        return 0
    level_off(pieces, at + width, joint2)
    return 1


def level_behind(pieces: Floats, p: int, n: int, mean2: float, joint2: float, state: State) -> None:
    """Let a thread whose lead is to change keep the speed of the joint behind the start of piece p."""
    width = piece_width(n)
    at = p * width
    rise, entry2 = pieces[at + PieceRecord.RISE], pieces[at + PieceRecord.ENTRY2]
    way = level_way(rise > 0.0, sqrt(joint2), 0.5 * abs(rise), pieces[at + PieceRecord.PULL], mean2)
    if way >= pieces[at + PieceRecord.LENGTH] or not cut(pieces, p, n, state, way):
        return
    level_off(pieces, at, joint2)
    pieces[at + PieceRecord.ENTRY2] = entry2
    after = at + width + PieceRecord.ENTRY2
    pieces[after] = min(pieces[after], joint2)


def level_off(pieces: Floats, at: int, cap2: float) -> None:
    """One bound of x all along a piece."""
    pieces[at + PieceRecord.ENTRY2] = min(pieces[at + PieceRecord.ENTRY2], cap2)
    pieces[at + PieceRecord.CAP2], pieces[at + PieceRecord.RISE] = cap2, 0.0


def level_way(waits: bool, speed: float, change: float, pull: float, mean2: float) -> float:
    """Way of a thread at the speed of its joint, where its lead lets it accelerate by `change` beside that.

    It leaves the joint in step and meets the way that is `change·mean2/2` beside: at `pull`, behind the time t for
    which `t²·(1 - change/pull) = mean2`. If it waits for that, it keeps its speed first; else its change of speed is
    within the way too.
    """
    left = 1.0 - change / pull
    seconds = sqrt(mean2 / left)
    if waits:
        return speed * seconds * left
    return max(speed * seconds - 0.5 * change * (seconds * seconds - mean2), 0.0)
