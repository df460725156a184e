"""Limited jerk: a line from rest to rest has averages of its own, and corners at which it pays to rest.

Averaged over T, a line from rest to rest may accelerate by `u = j·T/2` (`jerk.py`): a long T delays its end, a short
one takes the acceleration. Without a level part the time `2·√(L/u) + T` is least for `T = ∛(2·L/j)`, with one
(`L/v + v/u + T`) for `T = √(2·v/j)`; the smaller of the two holds. That is 3·∛(2·L/j), a fifth more than any motion
within the jerk could do. Positions need no average, for there is no corner. Lines that go on in one direction at one
speed are one line.

A corner that is passed at c holds both lines at c on `c·W/2` around it (`hold.py`): it costs W at least. A rest there
often costs less, because T is then chosen for each line.
"""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.columns import PLACES, Limits, PieceRecord, State, piece_width

#: Turns smaller than this count as none; most pieces of a straight run, for they wait in the buffer for its end.
NO_TURN, LONGEST_RUN = 1e-9, 4096
#: Part by which speeds that count as one may differ.
SAME_SPEED = 1e-9
#: Part of the acceleration that is reckoned with on a line that is not alone.
SHARED = 0.35


def best_ramp(length: float, top: float, pull: float, jerk: float) -> float:
    """Seconds to average a line from rest to rest over, so that it takes the least time.

    More than it takes to allow the whole acceleration is of no use.
    """
    ramp: float = min(2.0 * pull / jerk, (2.0 * length / jerk) ** (1.0 / 3.0))
    return min(ramp, sqrt(2.0 * top / jerk)) if top < inf else ramp


def goes_straight_on(n: int, state: State, wanted: float) -> bool:
    """Whether the line at hand goes on with a straight run from rest, in its direction and at its speed.

    Where overrides will act, pieces are run before the end of the run is known.
    """
    if state.run.alone != 2.0 or state.run.stop != 0.0 or state.run.free != 0.0 or state.row.shares > 0.0:
        return False
    if abs(wanted - state.run.wanted) > SAME_SPEED * wanted:
        return False
    for i in range(n):
        if abs(state.unit[i] - state.tangent[i]) > NO_TURN:
            return False
    return state.run.straight_pieces < LONGEST_RUN


def settle_alone(pieces: Floats, n: int, limits: Limits, state: State) -> None:
    """The axes come to rest behind the last row: if it ends a straight run from rest, that gets averages of its own."""
    count = state.run.pieces
    if state.run.alone != 2.0 or count == 0:
        return
    state.run.alone = 0.0
    width, first = piece_width(n), count - state.run.straight_pieces
    at, run = (count - 1) * width, 0.0
    for p in range(first, count):
        run += pieces[p * width + PieceRecord.LENGTH]
    here, length = at + PieceRecord.VECTORS + PLACES * n, pieces[at + PieceRecord.LENGTH]
    pull, jerk, ease = inf, inf, state.run.ease
    for i in range(n):
        share = abs(pieces[here + n + i] - pieces[here + i]) / length
        if share > 0.0:
            pull = min(pull, ease * limits.acceleration[i] / share)
            jerk = min(jerk, ease * limits.jerk[i] / share)
    top = min(sqrt(pieces[at + PieceRecord.CAP2]), state.run.wanted)
    ramp = best_ramp(run, top, pull, jerk)
    for p in range(first, count):
        at = p * width
        pieces[at + PieceRecord.PULL] = min(pull, 0.5 * jerk * ramp)
        pieces[at + PieceRecord.RAMP], pieces[at + PieceRecord.BLEND] = ramp, 0.0
    pieces[first * width + PieceRecord.PAUSE] = ramp


def pays_to_rest(
    n: int,
    limits: Limits,
    state: State,
    length: float,
    corner2: float,
    wanted: float,
) -> bool:
    """Whether two lines take less time with a rest between them than if the corner is passed at `corner2`.

    `wanted` is the speed of the second line, `run.wanted` that of the first one.
    """
    if state.run.alone == 0.0:
        return False
    passing, resting, window = 0.0, 0.0, state.run.window
    top = min(wanted, state.run.wanted)
    corner = min(sqrt(corner2), top)
    for side in range(2):
        direction = state.tangent if side == 0 else state.unit
        way = state.run.length if side == 0 else length
        pull, jerk = inf, inf
        for i in range(n):
            share = abs(direction[i])
            if share > 0.0:
                pull = min(pull, limits.acceleration[i] / share)
                jerk = min(jerk, limits.jerk[i] / share)
        ramp = best_ramp(way, top, pull, jerk)
        resting += ramp + rest_to_rest(way, 0.0, top, min(pull, 0.5 * jerk * ramp))
        held = corner * window
        if held >= way:
            passing += way / corner
        else:
            passing += window + rest_to_rest(way - held, corner, top, SHARED * pull)
    return resting < passing


def rest_to_rest(way: float, slow: float, top: float, pull: float) -> float:
    """Seconds of a way that begins and ends at a speed, under constant acceleration."""
    peak2 = slow * slow + pull * way
    if peak2 <= top * top:
        return 2.0 * (sqrt(peak2) - slow) / pull
    return 2.0 * (top - slow) / pull + (way - (top * top - slow * slow) / pull) / top
