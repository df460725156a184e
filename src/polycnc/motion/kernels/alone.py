"""Limited jerk: a line from rest to rest has averages of its own, and corners at which it pays to rest.

Averaged over T, a line from rest to rest may accelerate by `u = j·T` if its level part lasts T at least: then the
average sees no more than one of its two steps of acceleration at a time. With `T = a/j`, and a speed v at which the
level part still lasts so long, that is the quickest motion within speed, acceleration and jerk, `L/v + v/a + a/j`. If
the way or the speed is too small to reach the acceleration a, `T = ∛(L/2j)` or `T = √(v/j)` is, with `v = j·T²`:
4·∛(L/2j) on a short way. Positions need no average, for there is no corner; they have that of a time constant behind
the interpolation, where there is one. Lines that go on in one direction at one
speed are one line.

A corner that is passed at c holds both lines at c on `c·W/2` around it (`hold.py`): it costs W at least. A rest there
often costs less, because T is then chosen for each line.
"""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.columns import PLACES, SURELY, Limits, PieceRecord, State, piece_width

#: Turns smaller than this count as none; most pieces of a straight run, for they wait in the buffer for its end.
NO_TURN, LONGEST_RUN = 1e-9, 4096
#: Part by which speeds that count as one may differ.
SAME_SPEED = 1e-9
#: Part of the acceleration that is reckoned with on a line that is not alone.
SHARED = 0.5
#: What a corner slower than its lines costs beside what is reckoned here: this part, all of it where it is slower by
#: a third.
SLOWED, BY_THIRDS = 0.06, 3.0


def best_ramp(length: float, top: float, pull: float, jerk: float) -> float:
    """Seconds to average a line from rest to rest over, so that it takes the least time."""
    ramp: float = min(pull / jerk, (0.5 * length / jerk) ** (1.0 / 3.0))
    return min(ramp, sqrt(top / jerk)) if top < inf else ramp


def alone_pull(ramp: float, pull: float, jerk: float) -> float:
    """Acceleration of a line from rest to rest that is averaged over `ramp` seconds (0: the jerk has no limit)."""
    return min(pull, jerk * ramp) if ramp > 0.0 else pull


def level_peak(start2: float, end2: float, length: float, pull: float, level: float) -> float:
    """Highest speed on a way at whose peak the speed stays for `level` seconds at least."""
    slow = pull * level
    return 0.5 * (sqrt(slow * slow + 4.0 * pull * length + 2.0 * (start2 + end2)) - slow)


def alone_top(length: float, top: float, pull: float, ramp: float) -> float:
    """Highest speed of a line from rest to rest that is averaged over `ramp` seconds."""
    return min(top, level_peak(0.0, 0.0, length, pull, ramp)) if ramp > 0.0 else top


def goes_straight_on(n: int, state: State, wanted: float) -> bool:
    """Whether the line at hand goes on with a straight run from rest, in its direction and at its speed.

    In a dry run pieces are run before the end of the run is known.
    """
    if state.run.alone != 2.0 or state.run.stop != 0.0 or state.run.free > 0.0 or state.row.shares > 0.0:
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
    pull = alone_pull(ramp, pull, jerk)
    top = alone_top(run, top, pull, ramp)
    if state.run.free != 0.0:
        # Overrides act on a line that has begun, and the main run keeps its level part (`motion/phases/speed.py`).
        top = overridden_top(pieces, at, n, limits, state)
    for p in range(first, count):
        at = p * width
        pieces[at + PieceRecord.PULL] = pull
        pieces[at + PieceRecord.CAP2] = top * top
        if p > first:
            pieces[at + PieceRecord.ENTRY2] = top * top
        pieces[at + PieceRecord.RAMP], pieces[at + PieceRecord.BLEND] = ramp, state.run.behind
        pieces[at + PieceRecord.ALONE] = 1.0
    pieces[first * width + PieceRecord.PAUSE] = ramp + 2.0 * state.run.behind


def overridden_top(pieces: Floats, at: int, n: int, limits: Limits, state: State) -> float:
    """Highest speed of a line at the largest override: that of its axes; a rapid has no override above 100 %."""
    own = sqrt(pieces[at + PieceRecord.CAP2])
    if int(pieces[at + PieceRecord.SLOT]) % 2 == 0 or state.run.line_top < inf:
        return own
    here, top = at + PieceRecord.VECTORS + PLACES * n, limits.path.path_feed
    if limits.path.block_s > 0.0:
        top = min(top, pieces[at + PieceRecord.LENGTH] / limits.path.block_s)
    for i in range(n):
        way = abs(pieces[here + n + i] - pieces[here + i])
        if way > 0.0:
            top = min(top, limits.top_feed[i] * pieces[at + PieceRecord.LENGTH] / way)
    return max(top, own)


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
    top, corner = min(wanted, state.run.wanted), sqrt(corner2)
    if corner >= top:
        return False  # nobody is slower for the corner
    if (
        corner * window >= max(state.run.length, length)
        and is_slower_alone(n, limits, state.tangent, state.run.length, corner)
        and is_slower_alone(n, limits, state.unit, length, corner)
    ):
        return False
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
        own = alone_pull(ramp, pull, jerk)
        resting += ramp + 2.0 * state.run.behind + rest_to_rest(way, 0.0, alone_top(way, top, own, ramp), own)
        held = corner * window
        if held >= way:
            passing += way / corner
        else:
            passing += window + rest_to_rest(way - held, corner, top, SHARED * pull)
    return resting < passing * (1.0 + SLOWED * min(1.0, BY_THIRDS * (1.0 - corner / top)))


def is_slower_alone(n: int, limits: Limits, direction: Floats, way: float, corner: float) -> bool:
    """Whether a line of which a corner holds all would be slower from rest to rest for certain.

    Averaged over T, with no more acceleration than j·T, it takes `T + 2·√(L/jT)` at least, which is never less than
    3·∛(L/j). With the jerk of one axis alone it would take less time still.
    """
    passing, slower = (1.0 + SLOWED) * way, False
    cube, least = SURELY * passing * passing * passing, 27.0 * way * corner * corner * corner
    for i in range(n):
        slower = slower or cube * limits.jerk[i] < least * abs(direction[i])
    return slower


def rest_to_rest(way: float, slow: float, top: float, pull: float) -> float:
    """Seconds of a way that begins and ends at a speed, under constant acceleration."""
    peak2 = slow * slow + pull * way
    if peak2 <= top * top:
        return 2.0 * (sqrt(peak2) - slow) / pull
    return 2.0 * (top - slow) / pull + (way - (top * top - slow * slow) / pull) / top
