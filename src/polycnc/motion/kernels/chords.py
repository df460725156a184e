"""Chords between the points of a spline: each is the cubic through its ends with the tangents there (`run.py`).

The tangent at the end of a chord is known when the next row comes. Until then the chord is open, and with limited jerk
nothing is bounded by it; it is closed when the next chord goes on with it, or when something else follows.

Without limited jerk a chord whose curve is known is parted: along it q'' changes, and an axis that keeps its
acceleration at both ends of a part keeps it between them too, if the part is short enough (`part_chord`).
"""

from __future__ import annotations

from math import ceil, inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.alone import settle_alone
from polycnc.motion.kernels.columns import (
    AT_END,
    AT_START,
    CHORD_PARTS,
    CLOSED,
    OPEN,
    PLACES,
    ContextRecord,
    Form,
    Limits,
    PieceRecord,
    State,
    piece_width,
    square,
)
from polycnc.motion.kernels.feeds import norm
from polycnc.motion.kernels.hold import cut, hold
from polycnc.motion.kernels.jerk import (
    ARC_ACROSS,
    ARC_DEVIATION,
    JERK_ENTRY,
    LONE,
    bow_jerk,
    bow_top2,
    forget_bow,
    step_jerk,
    step_top2,
)

#: A q'' smaller than this (1/mm) counts as none.
NO_BEND = 1e-12
#: Largest MARGIN of the parts of a chord beyond 1, if no more than CHORD_PARTS are needed for it.
PART_MARGIN = 0.01


def lay_chord(
    contexts: Floats,
    record: int,
    pieces: Floats,
    at: int,
    n: int,
    limits: Limits,
    state: State,
    length: float,
    weight: float,
) -> None:
    """Give a spline's chord the tangents and the curvature of the curve through its points.

    At a point between two chords the tangent is their mean direction, the shorter one counting more: the derivative of
    the parabola through the three points; with limited jerk that of the cubic through one more (`follow_change`), and
    at an end in rest the curve bends evenly (`mirror`). `unit` is the chord, `tangent` the one before.
    """
    unit, here = state.unit, at + PieceRecord.VECTORS
    soft = contexts[record + ContextRecord.RAMP_S] > 0.0
    pieces[at + PieceRecord.FORM] = Form.BENT if soft else Form.CURVED
    if contexts[record + ContextRecord.DRIVE_SPEED] < 1.0 or state.row.ease < 1.0:
        pieces[at + PieceRecord.PATH_PULL] = pieces[at + PieceRecord.PULL]
    for i in range(n):
        pieces[here + i] = pieces[here + n + i] = unit[i]
        pieces[here + 2 * n + i] = pieces[here + 3 * n + i] = 0.0
    if state.run.smooth == 2.0:
        left = contexts[record + ContextRecord.SPEED_LEFT]
        cap2 = meet_chord(pieces, at, n, limits, state, length, weight, left, soft)
        if soft:
            close_chord(pieces, at - piece_width(n), n, limits, state)
            cap2 = min(cap2, state.run.exit2)
            pieces[at + PieceRecord.HOLD_PULL] = min(pieces[at + PieceRecord.HOLD_PULL], state.run.exit_pull)
        pieces[at + PieceRecord.ENTRY2] = min(
            cap2, pieces[at + PieceRecord.CAP2], pieces[at - piece_width(n) + PieceRecord.CAP2]
        )
        if soft:
            pieces[at + PieceRecord.HOLD2] = min(
                pieces[at + PieceRecord.HOLD2], pieces[at + PieceRecord.ENTRY2]
            )
        state.run.exit2 = pieces[at + PieceRecord.CAP2]
    if state.run.smooth != 2.0:
        forget_bow(n, state)
    if not soft:
        state.run.chord_mm = state.run.length if state.run.smooth == 2.0 else 0.0
        # Until the next chord comes it ends straight, for which it bends twice as much at its start.
        bend_chord(pieces, at, n)
        state.run.chord_entry2 = pieces[at + PieceRecord.ENTRY2]
        pieces[at + PieceRecord.ENTRY2] = min(state.run.chord_entry2, bend2(pieces, here, n, limits))
    state.run.chord_ease = min(state.row.ease, state.share_ease[AT_START], state.share_ease[AT_END])
    if soft:
        state.run.chord, state.run.tolerance = OPEN, contexts[record + ContextRecord.TOLERANCE]


def meet_chord(
    pieces: Floats,
    at: int,
    n: int,
    limits: Limits,
    state: State,
    length: float,
    weight: float,
    left: float,
    soft: bool,
) -> float:
    """Let a chord go on smoothly with the one before: one tangent for both. Largest x where they meet.

    Without limited jerk the curvature there bounds it, the change of direction over the mean length, and q'' of both.
    A chord before it that is parted already, for the one at hand is laid again, stays as it is.
    """
    unit, tangent, bend = state.unit, state.tangent, state.bend
    here, before = at + PieceRecord.VECTORS, at + PieceRecord.VECTORS - piece_width(n)
    follow_change(n, state, length)
    for i in range(n):
        bend[i] += unit[i] * state.run.length + tangent[i] * length
    size, mean = norm(bend, n, limits, weight), 0.5 * (length + state.run.length)
    known = not soft and state.run.is_bent != 0.0
    cap2, turn2 = pieces[at + PieceRecord.ENTRY2], 0.0
    for i in range(n):
        turn = (unit[i] - tangent[i]) * (weight if limits.rotary[i] != 0.0 else 1.0)
        turn2 += turn * turn
        direction, curvature = bend[i] / size, (unit[i] - tangent[i]) / mean
        pieces[here + i] = direction
        if not known:
            pieces[before + n + i] = direction
        if curvature != 0.0 and not soft:
            cap2 = min(cap2, limits.acceleration[i] / abs(curvature))
        bend[i] = 0.0
    if not soft:
        chord = at - piece_width(n)
        if not known:
            bend_chord(pieces, chord, n)
            pieces[chord + PieceRecord.ENTRY2] = min(state.run.chord_entry2, bend2(pieces, before, n, limits))
        cap2 = min(cap2, bend2(pieces, before + n, n, limits))
    if soft and pieces[at - piece_width(n) + PieceRecord.PAUSE] > 0.0:
        mirror(pieces, before, before + n, n, limits, tangent, weight)
    # In the middle of its chord the curve is longer than the chord by `turn²/16` at most (a cubic, `run.py`).
    for k in range(1 if known else 0, 2):
        chord = at - (1 - k) * piece_width(n)
        if k == 0:
            top2 = chord_top2(pieces, chord, n, limits, state.run.row_top, state.run.speed_left)
        else:
            top2 = chord_top2(pieces, chord, n, limits, state.row.top, left)
        longer = 1.0 - 0.125 * min(turn2, 4.0)
        pieces[chord + PieceRecord.CAP2] = min(pieces[chord + PieceRecord.CAP2] * longer, top2)
        pieces[chord + PieceRecord.ENTRY2] = min(
            pieces[chord + PieceRecord.ENTRY2], pieces[chord + PieceRecord.CAP2]
        )
    return cap2


def follow_change(n: int, state: State, length: float) -> None:
    """Set `bend` to what makes the tangent between two chords that of the cubic through one point more before them.

    By the parabola's tangents alone q'' would change along each chord three times as fast as that of the curve, and
    step back between them. Only where it changes by less than half: else the points are none of a smooth curve.
    """
    mean, before = 0.5 * (length + state.run.length), state.run.chord_mm
    part = (
        0.5 * length * state.run.length / (before + length + state.run.length) * (length + state.run.length)
    )
    for i in range(n):
        bowed, bow = (state.unit[i] - state.tangent[i]) / mean, state.bow[i]
        is_smooth = before > 0.0 and abs(bowed - bow) < 0.5 * max(abs(bowed), abs(bow))
        state.bend[i] = (bow - bowed) * part if is_smooth else 0.0
        state.bow[i] = bowed


def mirror(
    pieces: Floats, free: int, known: int, n: int, limits: Limits, unit: Floats, weight: float
) -> None:
    """Give an end of a chord at which the axes rest the tangent with which it bends evenly: the other one's, mirrored.

    `free` and `known` are the places of both tangents, `unit` is the direction of the chord.
    """
    along = 0.0
    for i in range(n):
        w = weight if limits.rotary[i] != 0.0 else 1.0
        along += w * w * unit[i] * pieces[known + i]
    for i in range(n):
        pieces[free + i] = 2.0 * along * unit[i] - pieces[known + i]


def close_chord(pieces: Floats, at: int, n: int, limits: Limits, state: State) -> None:
    """With limited jerk: bound an open chord, whose cubic is known now, and the joint before it, by its q''.

    `bent_before` is the mean of q'' over the chord before, and becomes that over this one.
    """
    if state.run.chord != OPEN:
        return
    state.run.chord = CLOSED
    bend_chord(pieces, at, n)
    here, length, blend = (
        at + PieceRecord.VECTORS,
        pieces[at + PieceRecord.LENGTH],
        pieces[at + PieceRecord.BLEND],
    )
    cap2, joint2 = pieces[at + PieceRecord.CAP2], inf
    first2, last2 = 0.0, 0.0
    spacing = 0.5 * (length + state.run.chord_mm) if state.run.chord_mm > 0.0 else inf
    for i in range(n):
        a, j = state.run.chord_ease * limits.acceleration[i], state.run.chord_ease * limits.jerk[i]
        first, last = pieces[here + 2 * n + i], pieces[here + 3 * n + i]
        if limits.rotary[i] == 0.0:
            first2, last2 = first2 + first * first, last2 + last * last
        step, most = abs(0.5 * (first + last) - state.bent_before[i]), max(abs(first), abs(last))
        joint2 = min(joint2, step_top2(j, blend, step, spacing, JERK_ENTRY, joint2))
        if most > NO_BEND:
            cap2 = min(cap2, ARC_ACROSS * a / most, bow_top2(j, blend, 0.5 * abs(last - first), length))
    if first2 > 0.0 or last2 > 0.0:
        cap2 = min(
            cap2, 12.0 * ARC_DEVIATION * state.run.tolerance / (blend * blend * sqrt(max(first2, last2)))
        )
    pull = chord_pull(pieces, at, n, limits, state, sqrt(cap2), sqrt(min(cap2, joint2)), spacing)
    for i in range(n):
        state.bent_before[i] = 0.5 * (pieces[here + 2 * n + i] + pieces[here + 3 * n + i])
    pieces[at + PieceRecord.CAP2], pieces[at + PieceRecord.PULL] = cap2, pull
    pieces[at + PieceRecord.ENTRY2] = min(pieces[at + PieceRecord.ENTRY2], cap2)
    pieces[at + PieceRecord.HOLD2] = min(pieces[at + PieceRecord.HOLD2], cap2, joint2)
    pieces[at + PieceRecord.HOLD_PULL] = min(pieces[at + PieceRecord.HOLD_PULL], pull)
    state.run.chord_mm, state.run.exit2, state.run.exit_pull = length, cap2, pull


def chord_pull(
    pieces: Floats, at: int, n: int, limits: Limits, state: State, v: float, joint: float, spacing: float
) -> float:
    """Acceleration along a chord at speeds up to `v`, up to `joint` at its start: what its q'' leaves of each axis."""
    here, pull, ramp = at + PieceRecord.VECTORS, pieces[at + PieceRecord.PULL], pieces[at + PieceRecord.RAMP]
    length, blend = pieces[at + PieceRecord.LENGTH], pieces[at + PieceRecord.BLEND]
    for i in range(n):
        a, j = state.run.chord_ease * limits.acceleration[i], state.run.chord_ease * limits.jerk[i]
        first, last = pieces[here + 2 * n + i], pieces[here + 3 * n + i]
        way = pieces[here + PLACES * n + n + i] - pieces[here + PLACES * n + i]
        share = max(abs(pieces[here + i]), abs(pieces[here + n + i]), 1.5 * abs(way) / length)
        most = max(abs(first), abs(last))
        if most > NO_BEND and share > 0.0:
            step = abs(0.5 * (first + last) - state.bent_before[i])
            left = LONE * j - step_jerk(joint, blend, step, spacing)
            left -= bow_jerk(v, blend, 0.5 * abs(last - first), length)
            pull = min(pull, left / (2.0 * share / ramp + 3.0 * most * v), (a - most * v * v) / share)
    return pull


def end_chord(pieces: Floats, n: int, limits: Limits, state: State) -> None:
    """Close the last chord: the row at hand does not go on with it; perhaps the axes rest before that."""
    if state.run.chord == OPEN:
        at = (state.run.pieces - 1) * piece_width(n)
        here = at + PieceRecord.VECTORS
        if state.run.stop != 0.0 and pieces[at + PieceRecord.PAUSE] == 0.0:
            mirror(pieces, here + n, here, n, limits, state.tangent, state.run.metric)
            top2, turn2 = chord_top2(pieces, at, n, limits, state.run.row_top, state.run.speed_left), 0.0
            for i in range(n):
                w = state.run.metric if limits.rotary[i] != 0.0 else 1.0
                turn2 += square(w * (pieces[here + n + i] - pieces[here + i]))
            longer = 1.0 - 0.125 * min(turn2, 4.0)
            pieces[at + PieceRecord.CAP2] = min(pieces[at + PieceRecord.CAP2] * longer, top2)
        close_chord(pieces, at, n, limits, state)
        forget_bow(n, state)
    state.run.chord_mm = 0.0


def settle(pieces: Floats, n: int, limits: Limits, state: State) -> None:
    """The axes come to rest behind the last row: nothing goes on with its chord or its line any more."""
    if state.run.chord != 0.0 and state.run.pieces > 0:
        last, state.run.stop = state.run.pieces - 1, 1.0
        end_chord(pieces, n, limits, state)
        hold(pieces, last, n, state)
    elif state.run.smooth != 0.0 and state.run.window == 0.0:
        part_chord(pieces, state.run.pieces - 1, n, limits, state, state.run.chord_ease)
    settle_alone(pieces, n, limits, state)


def bend_chord(pieces: Floats, at: int, n: int) -> None:
    """Give a chord the q'' of its cubic (`run.py`).

    In the words of `chord_top2` it is `-(4·l + 2·a)` at the start, `2·l + 4·a` at the end, over the chord's length.
    """
    here, length = at + PieceRecord.VECTORS, pieces[at + PieceRecord.LENGTH]
    for i in range(n):
        place = here + PLACES * n + i
        unit = (pieces[place + n] - pieces[place]) / length
        leave, arrive = pieces[here + i] - unit, pieces[here + n + i] - unit
        first, last = -(4.0 * leave + 2.0 * arrive) / length, (2.0 * leave + 4.0 * arrive) / length
        pieces[here + 2 * n + i], pieces[here + 3 * n + i] = first, last


def part_chord(pieces: Floats, p: int, n: int, limits: Limits, state: State, ease: float) -> int:
    """Without limited jerk: part the chord of a spline that is piece p; how many pieces more it has then.

    Along a part of the length ℓ q'' changes by c, x and q' with it: between its ends an axis has up to `5/8·u·ℓ·c` more
    than at them, u being the acceleration along the path. MARGIN leaves so much, and u has a bound. `ease` is the part
    of the limits that a transformation leaves the columns.
    """
    width, at = piece_width(n), p * piece_width(n)
    if p < 0 or pieces[at + PieceRecord.FORM] != Form.CURVED:
        return 0
    here, most = at + PieceRecord.VECTORS, between_ends(pieces, at, n, limits)
    parts = min(max(ceil(sqrt(most / PART_MARGIN) - NO_BEND), 1), CHORD_PARTS)
    margin = (1.0 + most / (parts * parts)) / ease
    if margin <= pieces[at + PieceRecord.MARGIN]:
        return 0  # it is parted already
    factor, pull = margin / pieces[at + PieceRecord.MARGIN], pieces[at + PieceRecord.PATH_PULL]
    for i in range(n):
        change = abs(pieces[here + 3 * n + i] - pieces[here + 2 * n + i]) / pieces[at + PieceRecord.MARGIN]
        asked = 0.625 * pieces[at + PieceRecord.LENGTH] * change / (parts * parts)
        if asked > NO_BEND:
            pull = min(pull, (ease - 1.0 / margin) * limits.acceleration[i] / asked)
    for k in range(here, here + PLACES * n):
        pieces[k] *= factor
    pieces[at + PieceRecord.MARGIN], pieces[at + PieceRecord.PATH_PULL] = margin, pull
    entry2, last = min(pieces[at + PieceRecord.ENTRY2], bend2(pieces, here, n, limits)), p
    pieces[at + PieceRecord.ENTRY2] = entry2
    for part in range(parts, 1, -1):
        if not cut(pieces, last, n, state, pieces[last * width + PieceRecord.LENGTH] / part):
            break
        last += 1
        rest = last * width + PieceRecord.VECTORS
        cap2 = min(pieces[last * width + PieceRecord.CAP2], bend2(pieces, rest, n, limits))
        pieces[last * width + PieceRecord.ENTRY2] = cap2
    if last + 1 < state.run.pieces:
        exit2 = bend2(pieces, last * width + PieceRecord.VECTORS + n, n, limits)
        behind = (last + 1) * width + PieceRecord.ENTRY2
        pieces[behind], state.run.chord_entry2 = (
            min(pieces[behind], exit2),
            min(state.run.chord_entry2, exit2),
        )
    return last - p


def between_ends(pieces: Floats, at: int, n: int, limits: Limits) -> float:
    """Part of its acceleration that an axis may have more between the ends of a chord than at them."""
    here, length, margin = (
        at + PieceRecord.VECTORS,
        pieces[at + PieceRecord.LENGTH],
        pieces[at + PieceRecord.MARGIN],
    )
    pull, most = pieces[at + PieceRecord.PATH_PULL], 0.0
    for i in range(n):
        share = max(abs(pieces[here + i]), abs(pieces[here + n + i])) / margin
        if share > 0.0:
            pull = min(pull, limits.acceleration[i] / share)
    for i in range(n):
        change = abs(pieces[here + 3 * n + i] - pieces[here + 2 * n + i]) / margin
        if length * change > NO_BEND:
            most = max(most, 0.625 * pull * length * change / limits.acceleration[i])
    return most


def bend2(pieces: Floats, tangents: int, n: int, limits: Limits) -> float:
    """Largest x at an end of a curved piece at which every axis can hold it; `tangents` is the place of its q'."""
    x2 = inf
    for i in range(n):
        bend = abs(pieces[tangents + 2 * n + i])
        if bend > 0.0:
            x2 = min(x2, limits.acceleration[i] / bend)
    return x2


def chord_top2(pieces: Floats, at: int, n: int, limits: Limits, row_top: float, left: float) -> float:
    """Largest x at which every axis keeps its velocity all along the cubic over a spline's chord (`run.py`).

    Of what the program leaves of velocities it is known that the chord itself may be passed at `row_top`, and that
    every axis has the part `left`: so fast each may be where the cubic moves it faster than the chord does.

    Its derivative by the share f of the chord, over the chord's length, is
    `u + l·(1 - f)·(1 - 3·f) + a·f·(3·f - 2)`, where u is the chord's direction, and l and a are what the tangents at
    its start and its end differ by: a parabola, largest at an end or at its crest.
    """
    here, top2 = at + PieceRecord.VECTORS, inf
    for i in range(n):
        leave, arrive = pieces[here + i], pieces[here + n + i]
        place = here + PLACES * n + i
        unit = (pieces[place + n] - pieces[place]) / pieces[at + PieceRecord.LENGTH]
        most, bow = max(abs(leave), abs(arrive)), leave + arrive - 2.0 * unit
        if bow != 0.0:
            f = (2.0 * leave + arrive - 3.0 * unit) / (3.0 * bow)
            if 0.0 < f < 1.0:
                most = max(most, abs(leave - 3.0 * bow * f * f))
        if most > 0.0:
            speed = limits.top_feed[i]
            if left < 1.0 and row_top < inf:
                speed = min(speed, max(row_top * abs(unit), left * speed))
            top2 = min(top2, square(speed / most))
    return top2
