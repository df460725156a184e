"""Corners as the axes pass them where the jerk has no limit: a part of the path before and behind them is bent.

On a way t before and behind the corner the direction changes evenly from the one to the other: with Δ the change of
q' at the corner and r the way from where the bend begins or ends, `Δ·r²/(4·t)` is added to the path, whose q''
grows by `Δ/(2·t)`. Two lines become a parabola that leaves the corner by `Δ·t/4`. The path's parameter stays as long as
before, so that rows keep their lengths; the way of the axes on the bend is a little shorter.
"""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.columns import (
    FROM_CORNER,
    PLACES,
    TO_CORNER,
    ContextRecord,
    Form,
    Limits,
    PieceRecord,
    State,
    piece_width,
    square,
)
from polycnc.motion.kernels.feeds import left_angle, left_swing, left_tolerance
from polycnc.motion.kernels.hold import cut, end_cap2, lower_cap

#: Directions that differ by less count as one; ways shorter than this (mm) are not bent.
SAME_DIRECTION, NO_BEND_MM = 1e-9, 1e-9
#: Which axes a bend is of.
ALL, LINEAR, TURNING = 0.0, 1.0, 2.0
#: Of what corners leave the columns under a tip's row: the part for the bend; the rest is for acceleration along it.
BENDS = 0.7
#: Least MARGIN of a part of a curve that is bent.
CHORD_MARGIN = 1.005


def bend_corner(contexts: Floats, record: int, n: int, limits: Limits, state: State, reach: float) -> float:
    """Largest x at the corner before the row at hand; sets `joint.bend_way`, `joint.turn_way` and `turn`.

    No more of both rows is bent than `reach`, half of the shorter one at most. Within a tolerance the path leaves the
    corner by no more than that, a rotary axis by as many degrees, and the bend reaches no farther than ROUNDING.
    Without one it takes as long as an axis needs for the step of velocity that is allowed at a corner. Rotary axes
    with a tolerance or a distance of their own bend their way by that alone.
    """
    unit, tangent, turn = state.unit, state.tangent, state.turn
    off = max(state.run.off, state.row.off)
    tolerance = left_tolerance(contexts, record, off)
    swing = left_swing(contexts, record, off, max(state.run.swung, state.row.swung))
    angle, distance = (
        contexts[record + ContextRecord.TURN_TOLERANCE],
        contexts[record + ContextRecord.TURN_DISTANCE],
    )
    turned, swung, most = 0.0, 0.0, 0.0
    way, x2 = reach, inf
    for i in range(n):
        turn[i] = unit[i] - tangent[i]
        if limits.rotary[i] == 0.0:
            turned += turn[i] * turn[i]
            most = max(most, abs(turn[i]))
        else:
            swung = max(swung, abs(turn[i]))
    if (angle > 0.0 or distance > 0.0) and swung > SAME_DIRECTION:
        x2, swung = turn_apart(angle, distance, swung, reach, n, limits, state), 0.0
    most = max(most, swung)
    if most <= SAME_DIRECTION:
        return x2
    if tolerance > 0.0:
        way = min(way, contexts[record + ContextRecord.ROUNDING])
        if turned > SAME_DIRECTION * SAME_DIRECTION:
            way = min(way, 4.0 * tolerance / sqrt(turned))
        if swung > SAME_DIRECTION:
            way = min(way, 4.0 * swing / swung)
    else:
        for i in range(n):
            step = abs(turn[i])
            if step > SAME_DIRECTION and (swung > 0.0 or limits.rotary[i] == 0.0):
                jump = limits.jump[i]
                way = min(way, 0.5 * state.joint.ease * jump * jump / (limits.acceleration[i] * step))
    for i in range(n):
        step = abs(turn[i])
        if step > SAME_DIRECTION and (swung > 0.0 or limits.rotary[i] == 0.0):
            x2 = min(x2, state.joint.ease * limits.acceleration[i] * 2.0 * way / step)
    state.joint.bend_way = way
    return x2


def turn_apart(
    angle: float, distance: float, swung: float, reach: float, n: int, limits: Limits, state: State
) -> float:
    """Largest x at a corner at which rotary axes leave their way by an angle, or within a distance; sets `turn_way`.

    `swung` is the largest step of their q'.
    """
    way, x2 = reach, inf
    if angle > 0.0:
        way = min(way, 4.0 * left_angle(angle, state) / swung)
    if distance > 0.0:
        way = min(way, distance)
    for i in range(n):
        step = abs(state.turn[i])
        if limits.rotary[i] != 0.0 and step > SAME_DIRECTION:
            x2 = min(x2, state.joint.ease * limits.acceleration[i] * 2.0 * way / step)
    state.joint.turn_way = way
    return x2


def round_joint(pieces: Floats, first: int, n: int, limits: Limits, state: State) -> None:
    """Bend the path before and behind the joint at piece `first`, where the row at hand begins."""
    way, state.joint.bend_way = state.joint.bend_way, 0.0
    turn_way, state.joint.turn_way = state.joint.turn_way, 0.0
    behind, state.run.is_bent = state.run.is_bent == 0.0, 0.0
    if first >= state.run.pieces:
        return
    if turn_way > NO_BEND_MM:
        first = bend_around(pieces, first, n, limits, state, turn_way, behind, TURNING)
    if way > NO_BEND_MM:
        bend_around(pieces, first, n, limits, state, way, behind, LINEAR if turn_way > 0.0 else ALL)


def bend_around(
    pieces: Floats, first: int, n: int, limits: Limits, state: State, way: float, behind: bool, which: float
) -> int:
    """Bend some axes on a way before a joint, unless they are bent there already, and behind it; its piece then."""
    width, p, left = piece_width(n), first - 1, way
    while behind and p >= 0 and left > NO_BEND_MM and pieces[p * width + PieceRecord.FORM] != Form.TIMED:
        length = pieces[p * width + PieceRecord.LENGTH]
        if length > left + NO_BEND_MM and cut(pieces, p, n, state, length - left):
            p, first = p + 1, first + 1
            keep_at_cut(pieces, p, n, limits, state)
            length = pieces[p * width + PieceRecord.LENGTH]
        add_bend(pieces, p, n, limits, state, way, left - length, left, which)
        left -= length
        p -= 1
    p, left = first, way
    while p < state.run.pieces and left > NO_BEND_MM:
        if pieces[p * width + PieceRecord.LENGTH] > left + NO_BEND_MM and cut(pieces, p, n, state, left):
            keep_at_cut(pieces, p + 1, n, limits, state)
        length = pieces[p * width + PieceRecord.LENGTH]
        add_bend(pieces, p, n, limits, state, way, left, left - length, which)
        left -= length
        p += 1
    return first


def add_bend(
    pieces: Floats,
    p: int,
    n: int,
    limits: Limits,
    state: State,
    way: float,
    start: float,
    end: float,
    which: float,
) -> None:
    """Bend some axes on piece p, whose start and end are so far from where the bend of a corner begins or ends."""
    at, width = p * piece_width(n), piece_width(n)
    length, tops = pieces[at + PieceRecord.LENGTH], limits.top_feed
    here, sense = at + PieceRecord.VECTORS, 1.0 if end > start else -1.0
    if int(pieces[at + PieceRecord.SLOT]) % 2 == 0:
        tops = limits.top_rapid
    ease = min(state.joint.ease, 1.0)
    if pieces[at + PieceRecord.FORM] == Form.LED:
        lead_bend(pieces, at, n, limits, state)
        ease = 1.0  # it has a part of its own for the bend
    if pieces[at + PieceRecord.FORM] == Form.STRAIGHT:
        if pieces[at + PieceRecord.RISE] != 0.0:
            lower_cap(pieces, at, min(pieces[at + PieceRecord.CAP2], end_cap2(pieces, at)))
        pieces[at + PieceRecord.FORM], pieces[at + PieceRecord.PATH_PULL] = (
            Form.CURVED,
            pieces[at + PieceRecord.PULL],
        )
        for i in range(n):
            place = here + PLACES * n + i
            pieces[here + i] = pieces[here + n + i] = (pieces[place + n] - pieces[place]) / length
            pieces[here + 2 * n + i] = pieces[here + 3 * n + i] = 0.0
    spare(pieces, at, n, ease)
    # Between the directions of both rows no axis moves faster than in one of them.
    left = min(state.run.row_top, state.share_top[0] if state.row.shares > 1 else state.row.top)
    cap2, margin = min(pieces[at + PieceRecord.CAP2], left * left), pieces[at + PieceRecord.MARGIN]
    for k in range(2):
        far = end if k == 1 else start
        far = far if far > NO_BEND_MM else 0.0
        for i in range(n):
            bend, q = 0.5 * state.turn[i] / way, here + k * n + i
            if which != ALL and (which == TURNING) != (limits.rotary[i] != 0.0):
                bend = 0.0
            pieces[q + PLACES * n] += 0.5 * bend * far * far
            pieces[q] += margin * sense * bend * far
            pieces[q + 2 * n] += margin * bend
            share, curvature = ease * abs(pieces[q]), ease * abs(pieces[q + 2 * n])
            if share > SAME_DIRECTION:
                cap2 = min(cap2, square(tops[i] / share))
            if curvature > SAME_DIRECTION:
                cap2 = min(cap2, state.joint.ease * limits.acceleration[i] / curvature)
    keep_between(pieces, at, n, limits, ease)
    pieces[at + PieceRecord.CAP2], pieces[at + PieceRecord.ZONE] = (
        cap2,
        TO_CORNER if sense > 0.0 else FROM_CORNER,
    )
    pieces[at + PieceRecord.ENTRY2] = min(pieces[at + PieceRecord.ENTRY2], cap2)
    if p + 1 < state.run.pieces:
        pieces[at + width + PieceRecord.ENTRY2] = min(pieces[at + width + PieceRecord.ENTRY2], cap2)


def lead_bend(pieces: Floats, at: int, n: int, limits: Limits, state: State) -> None:
    """Make a piece one that can be bent: its q' and q'' become those of the tip.

    Along it the columns accelerate by the rest of what the bend leaves them.
    """
    here, length, pull = at + PieceRecord.VECTORS, pieces[at + PieceRecord.LENGTH], inf
    for i in range(n):
        place_of = here + PLACES * n + i
        share = (pieces[place_of + n] - pieces[place_of]) / length
        pieces[here + i] = pieces[here + n + i] = share
        pieces[here + 2 * n + i] = pieces[here + 3 * n + i] = 0.0
        if share != 0.0:
            pull = min(pull, limits.acceleration[i] / abs(share))
    pieces[at + PieceRecord.FORM], pieces[at + PieceRecord.MARGIN] = Form.CURVED, 1.0
    pull *= state.joint.ease * (1.0 - BENDS) / BENDS
    pieces[at + PieceRecord.PULL] = pieces[at + PieceRecord.PATH_PULL] = pull
    pieces[at + PieceRecord.CAP2] = min(pieces[at + PieceRecord.CAP2], state.joint.top2)


def keep_at_cut(pieces: Floats, p: int, n: int, limits: Limits, state: State) -> None:
    """Bound x at the start of piece p, the rest of an arc's part, by what it curves there without the bend.

    A bend that turns the other way curves less: what it allows is no bound for the arc beside it.
    """
    at = p * piece_width(n)
    if pieces[at + PieceRecord.FORM] == Form.STRAIGHT or pieces[at + PieceRecord.FORM] == Form.LED:
        return
    ease = min(state.joint.ease * pieces[at + PieceRecord.MARGIN], 1.0)  # which may have it in it
    for i in range(n):
        curvature = abs(pieces[at + PieceRecord.VECTORS + 2 * n + i])
        if curvature > SAME_DIRECTION:
            cap2 = ease * limits.acceleration[i] / curvature
            pieces[at + PieceRecord.ENTRY2] = min(pieces[at + PieceRecord.ENTRY2], cap2)


def spare(pieces: Floats, at: int, n: int, ease: float) -> None:
    """Give a piece that is to be bent the MARGIN that leaves its axes `ease` of their acceleration, for bend and speed.

    A chord of a spline has some more of it, for its q'' changes like that of an arc's part.
    """
    here, length = at + PieceRecord.VECTORS, pieces[at + PieceRecord.LENGTH]
    margin = pieces[at + PieceRecord.MARGIN]
    uneven = False
    for i in range(n):
        change = abs(pieces[here + 3 * n + i] - pieces[here + 2 * n + i])
        uneven = uneven or change * length > SAME_DIRECTION
    wanted = (CHORD_MARGIN if uneven else 1.0) / ease
    if wanted > margin:
        factor = wanted / margin
        for k in range(here, here + PLACES * n):
            pieces[k] *= factor
        pieces[at + PieceRecord.MARGIN] = wanted


def keep_between(pieces: Floats, at: int, n: int, limits: Limits, ease: float) -> None:
    """Bound the acceleration u along a piece of an arc that is bent, so that its axes keep theirs between its ends too.

    Over the piece q'' changes by c, x and q' with it: between the ends an axis has up to `5/8·u·length·c` more than at
    them. MARGIN leaves so much where u is no more than the acceleration of the axes along the arc; on a bend, where q'
    is short, it could be more.
    """
    here, margin = at + PieceRecord.VECTORS, pieces[at + PieceRecord.MARGIN]
    pull, length = pieces[at + PieceRecord.PATH_PULL], pieces[at + PieceRecord.LENGTH]
    for i in range(n):
        change = abs(pieces[here + 3 * n + i] - pieces[here + 2 * n + i]) / margin
        if change * length > SAME_DIRECTION:
            left = (ease - 1.0 / margin) * limits.acceleration[i]
            pull = min(pull, left / (0.625 * length * change))
    pieces[at + PieceRecord.PATH_PULL] = pull
