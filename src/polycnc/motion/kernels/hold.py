"""Limited jerk: what bounds the speed at one place must hold as far around it as the average reaches.

The speed along the path is averaged over a time T. Let `v(t)` be planned and `w(t)` its average, the speed that
the axes run. If `v <= c` on the way `c·T/2` before and behind a place, then `w <= c` when the axes are there:
leaving that way takes at least T/2, so that a window that has left it at one end has an average on that side of the
place. Therefore, too, the window sees no other acceleration than that on this way. T is here RAMP_S and twice
BLEND_S.

The pieces within that way of a joint get its bounds. A long line is cut where the way ends.
"""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.columns import CLOSED, OPEN, PLACES, Form, PieceRecord, State, piece_width

#: A line is cut if what is left of it is at least this part of it; a part of a curve if that is so many mm, so that it
#: makes no difference in how many parts it was laid.
WORTH_CUTTING, WORTH_CUTTING_MM = 0.1, 1e-5
#: Ways shorter than this (mm) count as none.
SLIVER_MM = 1e-6
#: Bounds that are alike but for rounding, such as those of all parts of an arc, are one; a line is not cut for such.
ALIKE = 1.0 - 1e-9


def hold(pieces: Floats, first: int, n: int, state: State) -> None:
    """Spread the bounds of joints over the pieces from `first` on, and over those before; but over no open chord."""
    p, width, left = first, piece_width(n), 1 if state.run.chord == OPEN else 0
    while p < state.run.pieces - left:
        at = p * width
        pieces[at + PieceRecord.HOLD_WAY] = (
            0.5 * sqrt(pieces[at + PieceRecord.HOLD2]) * state.run.window
            if pieces[at + PieceRecord.HOLD2] < inf
            else 0.0
        )
        if pieces[at + PieceRecord.PAUSE] > 0.0:
            state.run.top2 = state.run.top_pull = 0.0
            state.run.ahead = state.run.low2_way = state.run.low_pull_way = 0.0
            state.run.low2 = state.run.low_pull = inf
        elif (
            pieces[at + PieceRecord.HOLD2] < state.run.top2
            or pieces[at + PieceRecord.HOLD_PULL] < state.run.top_pull
        ):
            p += hold_behind(pieces, p, n, state)
            at = p * width
        if pieces[at + PieceRecord.FORM] == Form.TIMED:
            p += 1
            continue
        high2 = top_cap2(pieces, at)
        state.run.top2 = max(state.run.top2, high2)
        state.run.top_pull = max(state.run.top_pull, pieces[at + PieceRecord.PULL])
        if pieces[at + PieceRecord.PAUSE] == 0.0 and pieces[at + PieceRecord.HOLD_WAY] > SLIVER_MM:
            meet_hold(pieces, at, state)
        if state.run.ahead > 0.0:
            if high2 > state.run.low2 or pieces[at + PieceRecord.PULL] > state.run.low_pull:
                hold_ahead(pieces, p, n, state)
            length = pieces[at + PieceRecord.LENGTH]
            state.run.ahead -= length
            state.run.low2_way -= length
            state.run.low_pull_way -= length
        pieces[at + PieceRecord.ENTRY2] = min(pieces[at + PieceRecord.ENTRY2], pieces[at + PieceRecord.CAP2])
        if p > 0 and pieces[at - width + PieceRecord.FORM] != Form.TIMED:
            pieces[at + PieceRecord.ENTRY2] = min(
                pieces[at + PieceRecord.ENTRY2], end_cap2(pieces, at - width)
            )
        p += 1
    if state.run.chord == CLOSED:
        state.run.chord = 0.0


def hold_behind(pieces: Floats, p: int, n: int, state: State) -> int:
    """Spread the bounds of the joint before piece p backwards; the number of cuts made there.

    Pieces that are slower than the joint take more of the half window than their length says: so no joint reaches
    farther than `run.top2` over rows before it says, however fast it is, and those that lie farther are final. Behind a
    joint whose own bounds are as low all is as low already: this one is left with less of its half window there.
    """
    width, cuts, joint = piece_width(n), 0, p * piece_width(n)
    left, cap2, pull = (
        pieces[joint + PieceRecord.HOLD_WAY],
        pieces[joint + PieceRecord.HOLD2],
        pieces[joint + PieceRecord.HOLD_PULL],
    )
    q, pace2 = p - 1, cap2
    while q >= 0 and left > SLIVER_MM and pieces[q * width + PieceRecord.FORM] != Form.TIMED:
        at = q * width
        length, high2 = pieces[at + PieceRecord.LENGTH], top_cap2(pieces, at)
        own2 = min(cap2, high2)
        if own2 != pace2:
            left *= sqrt(own2 / pace2)
            pace2 = own2
            if left <= SLIVER_MM:
                break
        bounds = cap2 < ALIKE * high2 or pull < ALIKE * pieces[at + PieceRecord.PULL]
        if bounds and worth_cutting(pieces, at, left) and cut(pieces, q, n, state, length - left):
            cuts += 1
            q += 1
            continue
        lower_cap(pieces, at, cap2)
        pieces[at + PieceRecord.PULL] = min(pieces[at + PieceRecord.PULL], pull)
        pieces[at + PieceRecord.ENTRY2] = min(pieces[at + PieceRecord.ENTRY2], cap2)
        if pieces[at + PieceRecord.PAUSE] > 0.0:
            break
        if pieces[at + PieceRecord.HOLD2] <= cap2 and pieces[at + PieceRecord.HOLD_PULL] <= pull:
            break
        left -= length
        q -= 1
    return cuts


def meet_hold(pieces: Floats, at: int, state: State) -> None:
    """Take in the joint before a piece: how far its bounds reach ahead, and the lowest of all."""
    run, way = state.run, pieces[at + PieceRecord.HOLD_WAY]
    run.ahead = max(run.ahead, way)
    run.low2, run.low2_way = lower_hold(run.low2, run.low2_way, pieces[at + PieceRecord.HOLD2], way)
    run.low_pull, run.low_pull_way = lower_hold(
        run.low_pull, run.low_pull_way, pieces[at + PieceRecord.HOLD_PULL], way
    )


def lower_hold(low: float, low_way: float, bound: float, way: float) -> tuple[float, float]:
    """The lower of two bounds, and how far it reaches; the farther way where they are alike."""
    if bound < ALIKE * low:
        return bound, way
    if bound * ALIKE <= low:
        return min(low, bound), max(low_way, way)
    return low, low_way


def hold_ahead(pieces: Floats, p: int, n: int, state: State) -> None:
    """Give piece p the bounds of the joints before it that reach so far, and cut it where the lowest one ends."""
    run, at = state.run, p * piece_width(n)
    if min(run.low2_way, run.low_pull_way) <= SLIVER_MM:
        look_back(pieces, p, n, state)
    cap2, pull = top_cap2(pieces, at), pieces[at + PieceRecord.PULL]
    edge = min(
        run.low2_way if run.low2 < ALIKE * cap2 else inf,
        run.low_pull_way if run.low_pull < ALIKE * pull else inf,
    )
    if worth_cutting(pieces, at, edge):
        cut(pieces, p, n, state, edge)
    lower_cap(pieces, at, run.low2)
    pieces[at + PieceRecord.PULL] = min(pull, run.low_pull)


def look_back(pieces: Floats, p: int, n: int, state: State) -> None:
    """Find the lowest bounds of the joints before piece p that reach so far: one of the last lowest has ended."""
    width, way, low2, low_pull, low2_way, low_pull_way = piece_width(n), 0.0, inf, inf, inf, inf
    longest = 0.5 * sqrt(state.run.top2) * state.run.window
    for q in range(p, -1, -1):
        joint = q * width
        if (
            way > longest
            or pieces[joint + PieceRecord.PAUSE] > 0.0
            or pieces[joint + PieceRecord.FORM] == Form.TIMED
        ):
            break
        left = pieces[joint + PieceRecord.HOLD_WAY] - way
        if left > SLIVER_MM:
            low2, low2_way = lower_hold(low2, low2_way, pieces[joint + PieceRecord.HOLD2], left)
            low_pull, low_pull_way = lower_hold(
                low_pull, low_pull_way, pieces[joint + PieceRecord.HOLD_PULL], left
            )
        if q > 0:
            way += pieces[joint - width + PieceRecord.LENGTH]
    state.run.low2, state.run.low2_way = low2, low2_way
    state.run.low_pull, state.run.low_pull_way = low_pull, low_pull_way


def end_cap2(pieces: Floats, at: int) -> float:
    """What bounds x inside a piece at its end."""
    cap2: float = pieces[at + PieceRecord.CAP2]
    if pieces[at + PieceRecord.RISE] != 0.0:
        cap2 += pieces[at + PieceRecord.RISE] * pieces[at + PieceRecord.LENGTH]
    return cap2


def top_cap2(pieces: Floats, at: int) -> float:
    """The highest bound of x inside a piece."""
    cap2: float = pieces[at + PieceRecord.CAP2]
    return end_cap2(pieces, at) if pieces[at + PieceRecord.RISE] > 0.0 else cap2


def lower_cap(pieces: Floats, at: int, cap2: float) -> None:
    """No more than an x inside a piece; of a cap that rises the lower end is kept then, all along the piece."""
    if pieces[at + PieceRecord.RISE] != 0.0:
        if cap2 >= top_cap2(pieces, at):
            return
        cap2 = min(cap2, end_cap2(pieces, at))
        pieces[at + PieceRecord.RISE] = 0.0
    pieces[at + PieceRecord.CAP2] = min(pieces[at + PieceRecord.CAP2], cap2)


def worth_cutting(pieces: Floats, at: int, edge: float) -> bool:
    """Whether a bound that holds over `edge` mm of a piece leaves much of it free."""
    length = pieces[at + PieceRecord.LENGTH]
    if pieces[at + PieceRecord.FORM] == Form.BENT:
        return edge < length - min(WORTH_CUTTING * length, WORTH_CUTTING_MM)
    return pieces[at + PieceRecord.FORM] == Form.STRAIGHT and edge < (1.0 - WORTH_CUTTING) * length


def cut(pieces: Floats, p: int, n: int, state: State, first: float) -> bool:
    """Cut a piece behind its first `first` mm; false where there is no room for one more.

    A part of a curve is the cubic through its ends with their tangents (`run.py`); both parts lie on it.
    """
    width, count = piece_width(n), state.run.pieces
    if (count + 1) * width > len(pieces):
        return False
    for q in range(count - 1, p - 1, -1):
        at = q * width
        for k in range(width):
            pieces[at + width + k] = pieces[at + k]
    at = p * width
    state.run.pieces += 1
    share = first / pieces[at + PieceRecord.LENGTH]
    rest = at + width
    pieces[rest + PieceRecord.LENGTH] = pieces[at + PieceRecord.LENGTH] - first
    pieces[at + PieceRecord.LENGTH] = first
    pieces[rest + PieceRecord.CAP2] = end_cap2(pieces, at)
    led = pieces[at + PieceRecord.FORM] == Form.LED
    bent = pieces[at + PieceRecord.FORM] != Form.STRAIGHT and not led
    scale = (first + pieces[rest + PieceRecord.LENGTH]) / pieces[at + PieceRecord.MARGIN]
    for i in range(PieceRecord.VECTORS, PieceRecord.VECTORS + n):
        place = i + PLACES * n
        chord = pieces[at + place + n] - pieces[at + place]
        here, there = pieces[at + place] + share * chord, chord / scale
        if led:
            there = pieces[at + i] + share * (pieces[at + i + n] - pieces[at + i])
        if bent:
            leave, arrive = pieces[at + i] * scale - chord, pieces[at + i + n] * scale - chord
            here += share * (1.0 - share) * ((1.0 - share) * leave - share * arrive)
            slope = (1.0 - share) * (1.0 - 3.0 * share) * leave + share * (3.0 * share - 2.0) * arrive
            there = (chord + slope) / scale
        if bent or led:
            bend = pieces[at + i + 2 * n]
            bend += share * (pieces[at + i + 3 * n] - bend)
            pieces[at + i + 3 * n] = pieces[rest + i + 2 * n] = bend
        pieces[at + place + n] = pieces[rest + place] = here
        pieces[at + i + n] = pieces[rest + i] = there
    pieces[rest + PieceRecord.PAUSE], pieces[rest + PieceRecord.HOLD_WAY] = 0.0, 0.0
    pieces[rest + PieceRecord.HOLD2] = pieces[rest + PieceRecord.HOLD_PULL] = inf
    pieces[rest + PieceRecord.ENTRY2] = pieces[rest + PieceRecord.CAP2]
    return True
