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
from polycnc.motion.kernels.columns import (
    AHEAD,
    BENT,
    CAP2,
    ENTRY2,
    FORM,
    HOLD2,
    HOLD_PULL,
    HOLD_WAY,
    KIND,
    LENGTH,
    LOW2,
    LOW_PULL,
    MARGIN,
    PAUSE,
    PIECES,
    PLACES,
    PULL,
    SPLINE,
    TIMED,
    TOP2,
    TOP_PULL,
    VECTORS,
    WINDOW,
    piece_width,
)

#: A line is cut if what is left of it is at least this part of it.
WORTH_CUTTING = 0.1
#: Ways shorter than this (mm) count as none.
SLIVER_MM = 1e-6


def hold(pieces: Floats, first: int, n: int, state: Floats) -> None:
    """Spread the bounds of joints over the pieces from `first` on, and over those before."""
    p, width = first, piece_width(n)
    while p < int(state[PIECES]):
        at = p * width
        pieces[at + HOLD_WAY] = (
            0.5 * sqrt(pieces[at + HOLD2]) * state[WINDOW] if pieces[at + HOLD2] < inf else 0.0
        )
        if pieces[at + PAUSE] > 0.0:
            state[TOP2] = state[TOP_PULL] = state[AHEAD] = 0.0
            state[LOW2] = state[LOW_PULL] = inf
        elif pieces[at + HOLD2] < state[TOP2] or pieces[at + HOLD_PULL] < state[TOP_PULL]:
            p += hold_behind(pieces, p, n, state)
            at = p * width
        if pieces[at + FORM] == TIMED:
            p += 1
            continue
        state[TOP2] = max(state[TOP2], pieces[at + CAP2])
        state[TOP_PULL] = max(state[TOP_PULL], pieces[at + PULL])
        if pieces[at + PAUSE] == 0.0 and pieces[at + HOLD2] < inf:
            state[AHEAD] = max(state[AHEAD], pieces[at + HOLD_WAY])
            state[LOW2] = min(state[LOW2], pieces[at + HOLD2])
            state[LOW_PULL] = min(state[LOW_PULL], pieces[at + HOLD_PULL])
        if state[AHEAD] > 0.0:
            if pieces[at + CAP2] > state[LOW2] or pieces[at + PULL] > state[LOW_PULL]:
                hold_ahead(pieces, p, n, state)
            state[AHEAD] -= pieces[at + LENGTH]
        pieces[at + ENTRY2] = min(pieces[at + ENTRY2], pieces[at + CAP2])
        if p > 0 and pieces[at - width + FORM] != TIMED:
            pieces[at + ENTRY2] = min(pieces[at + ENTRY2], pieces[at - width + CAP2])
        p += 1


def hold_behind(pieces: Floats, p: int, n: int, state: Floats) -> int:
    """Spread the bounds of the joint before piece p backwards; the number of cuts made there."""
    width, cuts, joint = piece_width(n), 0, p * piece_width(n)
    left, cap2, pull = pieces[joint + HOLD_WAY], pieces[joint + HOLD2], pieces[joint + HOLD_PULL]
    q = p - 1
    while q >= 0 and left > SLIVER_MM and pieces[q * width + FORM] != TIMED:
        at = q * width
        length = pieces[at + LENGTH]
        if worth_cutting(pieces, at, left) and cut(pieces, q, n, state, length - left):
            cuts += 1
            q += 1
            continue
        pieces[at + CAP2] = min(pieces[at + CAP2], cap2)
        pieces[at + PULL] = min(pieces[at + PULL], pull)
        pieces[at + ENTRY2] = min(pieces[at + ENTRY2], cap2)
        if pieces[at + PAUSE] > 0.0:
            break
        left -= length
        q -= 1
    return cuts


def hold_ahead(pieces: Floats, p: int, n: int, state: Floats) -> None:
    """Give piece p the bounds of the joints before it that reach so far, and cut it where the next one ends."""
    width, at, way, edge = piece_width(n), p * piece_width(n), 0.0, inf
    cap2, pull = pieces[at + CAP2], pieces[at + PULL]
    low2, low_pull = inf, inf
    longest = 0.5 * sqrt(state[TOP2]) * state[WINDOW]
    for q in range(p, -1, -1):
        joint = q * width
        if way > longest or pieces[joint + PAUSE] > 0.0 or pieces[joint + FORM] == TIMED:
            break
        left = pieces[joint + HOLD_WAY] - way
        if left > SLIVER_MM:
            low2, low_pull = min(low2, pieces[joint + HOLD2]), min(low_pull, pieces[joint + HOLD_PULL])
            edge = min(edge, left)
        if q > 0:
            way += pieces[joint - width + LENGTH]
    # The next point of a spline still turns the end of its last chord.
    if state[KIND] != SPLINE and worth_cutting(pieces, at, edge):
        cut(pieces, p, n, state, edge)
    pieces[at + CAP2], pieces[at + PULL] = min(cap2, low2), min(pull, low_pull)
    state[LOW2], state[LOW_PULL] = low2, low_pull


def worth_cutting(pieces: Floats, at: int, edge: float) -> bool:
    """Whether a bound that holds over `edge` mm of a piece leaves much of it free."""
    length = pieces[at + LENGTH]
    return pieces[at + FORM] <= BENT and edge < (1.0 - WORTH_CUTTING) * length


def cut(pieces: Floats, p: int, n: int, state: Floats, first: float) -> bool:
    """Cut a piece behind its first `first` mm; false where there is no room for one more.

    A part of a curve is the cubic through its ends with their tangents (`run.py`); both parts lie on it.
    """
    width, count = piece_width(n), int(state[PIECES])
    if (count + 1) * width > len(pieces):
        return False
    for k in range(count * width - 1, (p + 1) * width - 1, -1):
        pieces[k + width] = pieces[k]
    at = p * width
    for k in range(at, at + width):
        pieces[k + width] = pieces[k]
    state[PIECES] += 1.0
    share = first / pieces[at + LENGTH]
    rest = at + width
    pieces[rest + LENGTH] = pieces[at + LENGTH] - first
    pieces[at + LENGTH] = first
    bent = pieces[at + FORM] == BENT
    scale = (first + pieces[rest + LENGTH]) / pieces[at + MARGIN]
    for i in range(VECTORS, VECTORS + n):
        place = i + PLACES * n
        chord = pieces[at + place + n] - pieces[at + place]
        here, there = pieces[at + place] + share * chord, chord / scale
        if bent:
            leave, arrive = pieces[at + i] * scale - chord, pieces[at + i + n] * scale - chord
            here += share * (1.0 - share) * ((1.0 - share) * leave - share * arrive)
            slope = (1.0 - share) * (1.0 - 3.0 * share) * leave + share * (3.0 * share - 2.0) * arrive
            there = (chord + slope) / scale
            bend = pieces[at + i + 2 * n]
            bend += share * (pieces[at + i + 3 * n] - bend)
            pieces[at + i + 3 * n] = pieces[rest + i + 2 * n] = bend
        pieces[at + place + n] = pieces[rest + place] = here
        pieces[at + i + n] = pieces[rest + i] = there
    pieces[rest + PAUSE], pieces[rest + HOLD_WAY] = 0.0, 0.0
    pieces[rest + HOLD2] = pieces[rest + HOLD_PULL] = inf
    pieces[rest + ENTRY2] = pieces[at + CAP2]
    return True
