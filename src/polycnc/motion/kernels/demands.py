"""What the real axes behind the tip of a tool allow along straight rows: one speed and one acceleration for each row.

`motion/transformed.py` says what is asked. Derivatives of the real axes are exact (`linkage`); a row along which the
demand changes much is left to what parts it.
"""

from __future__ import annotations

from math import ceil, cos, inf, sqrt

from polycnc.kernels.layout import Bytes, Floats
from polycnc.motion.kernels.columns import AT_END, AT_START, DWELL, FEED, RAPID, SHARES, Limits
from polycnc.motion.kernels.feeds import norm
from polycnc.transformation.orientation.linkage import (
    RADIAN,
    STANDS_MM,
    Block,
    Room,
    ask,
    derive,
    set_turns,
    turned_by,
)

#: Part of the acceleration that is for the bend of the real axes' way; the rest is for changes of speed.
BEND = 0.5
#: Parts of the jerk: for the third derivative of the way; for bend and acceleration together.
TWIST, TURN = 0.2, 0.3
#: Derivatives below this count as none.
NOTHING = 1e-9
#: Places at which a row is looked at first, fewer where it turns by less than so many degrees; a change of the demand
#: by more than UNEVEN is worth shares. Within so many degrees there is a place.
LOOKS, FEW_LOOKS, LITTLE_DEG, UNEVEN, LOOK_DEG = 4, 1, 0.5, 1.3, 15.0
#: A row of more than fifty turns has no more places than this. Being prime, it puts them at ever other angles.
MOST_LOOKS = 1201


def share_rows(
    kinds: Bytes,
    ends: Floats,
    first: int,
    last: int,
    start: Floats,
    weight: float,
    soft: int,
    linkage: Floats,
    limits: Limits,
    room: Floats,
    unit: Floats,
    top: Floats,
    ease: Floats,
    done: Bytes,
) -> None:
    """Set speed and `ease` of the straight rows from `first` to before `last` along which the demand hardly changes.

    Args:
        kinds: Of the rows of a chunk.
        ends: Their ends in work coordinates, n numbers each.
        first: The first row; all of them have one context.
        last: The row behind the last one.
        start: Where the first one begins, n numbers; afterwards where the last one ends.
        weight: Millimetres that a degree counts in the length of a row.
        soft: Whether the jerk is limited.
        linkage: How the axes follow the tip.
        limits: The machine.
        room: For what is worked out.
        unit: Likewise, n numbers.
        top: Highest speed of each share of each row.
        ease: The factor of each of them on the acceleration.
        done: Becomes 1 for each row that is set.
    """
    n = len(start)
    for row in range(first, last):
        kind = kinds[row]
        if kind >= DWELL:
            continue
        if kind in (RAPID, FEED):
            for i in range(n):
                unit[i] = ends[row * n + i] - start[i]
            length = norm(unit, n, limits, weight)
            if length >= STANDS_MM:  # others are looked at one by one
                turned = turned_by(linkage, unit)
                for i in range(n):
                    room[Room.BLOCKS + Block.ORIGIN * n + i] = start[i]
                    unit[i] /= length
                is_even, speed, factor = even_row(
                    linkage, limits, n, room, unit, length, turned, kind == RAPID, soft != 0
                )
                if is_even:
                    at = row * SHARES
                    top[at], ease[at], ease[at + AT_START], ease[at + AT_END] = speed, factor, factor, factor
                    done[row] = 1
        for i in range(n):
            start[i] = ends[row * n + i]


def even_row(
    linkage: Floats,
    limits: Limits,
    n: int,
    room: Floats,
    unit: Floats,
    length: float,
    turned: float,
    rapid: bool,
    soft: bool,
) -> tuple[bool, float, float]:
    """Whether a row that begins at ORIGIN asks for much the same all along, and its speed and `ease`.

    The joints turn by `turned` degrees, and with them the direction in which the real axes go: between two places one
    of them may be asked for more than at both, by 1/cos of half the turn from the one to the other at most.
    """
    top, bend, pull, jerk, turn = inf, 0.0, NOTHING, 0.0, 0.0
    least, most = inf, 0.0
    looks = FEW_LOOKS if turned < LITTLE_DEG else max(LOOKS, ceil(min(turned / LOOK_DEG, MOST_LOOKS)))
    for k in range(looks + 1):
        way = length * k / looks
        set_turns(linkage, n, room, unit, way)
        derive(linkage, n, room, unit, way)
        ask(linkage, n, room, unit, way, limits.acceleration, limits.jerk)
        own_top, own_bend, own_pull, own_jerk, own_turn = demand(limits, n, room, rapid, soft)
        size = max(own_pull, 1.0 / own_top)
        least, most = min(least, size), max(most, size)
        top, bend, pull = min(top, own_top), max(bend, own_bend), max(pull, own_pull)
        jerk, turn = max(jerk, own_jerk), max(turn, own_turn)
    nearer = cos(0.5 * min(turned / looks, LOOK_DEG) * RADIAN)
    top, bend, pull, jerk, turn = top * nearer, bend / nearer, pull / nearer, jerk / nearer, turn / nearer
    top, ease = within(top, bend, pull, jerk, turn, length, along_of(limits, n, unit))
    return not most >= UNEVEN * least, top, ease


def demand(
    limits: Limits, n: int, room: Floats, rapid: bool, soft: bool
) -> tuple[float, float, float, float, float]:
    """What the real axes allow at a place; see `motion.demand.Demand`."""
    top, bend, pull, jerk, turn = inf, 0.0, NOTHING, 0.0, 0.0
    tops = limits.top_rapid if rapid else limits.top_feed
    blocks = Room.BLOCKS
    for i in range(n):
        pulls, jerks = limits.acceleration[i], limits.jerk[i]
        share = abs(room[blocks + Block.FIRST * n + i])
        if share > 0.0:
            top = min(top, tops[i] / share)
        bend = max(bend, abs(room[blocks + Block.SECOND * n + i]) / pulls)
        pull = max(pull, room[blocks + Block.PULLS * n + i] / pulls)
        if soft:
            twist = abs(room[blocks + Block.THIRD * n + i])
            if twist > NOTHING:
                top = min(top, (TWIST * jerks / twist) ** (1.0 / 3.0))
            jerk = max(jerk, room[blocks + Block.JOLTS * n + i] / jerks)
            turn = max(turn, room[blocks + Block.CHANGES * n + i] / jerks)
    return top, bend, pull, jerk, turn


def along_of(limits: Limits, n: int, unit: Floats) -> float:
    """What the columns can accelerate along a path; 0 where none moves."""
    least = inf
    for i in range(n):
        if unit[i] != 0.0:
            least = min(least, limits.acceleration[i] / abs(unit[i]))
    return least if least < inf else 0.0


def within(
    top: float, bend: float, pull: float, jerk: float, turn: float, length: float, along: float
) -> tuple[float, float]:
    """Speed and `ease` that meet a demand along a length.

    Where bend and acceleration together need much of the jerk, the acceleration is no more than serves to get up to
    the speed that it leaves.
    """
    if bend > NOTHING:
        top = min(top, sqrt(BEND / bend))
    ease = min(1.0, (1.0 - (bend * top * top if top < inf else 0.0)) / pull)
    if jerk > 0.0:
        ease = min(ease, (1.0 - TWIST - TURN if turn > NOTHING else 1.0) / jerk)
    if turn > NOTHING:
        turning = TURN / (3.0 * turn)
        top = min(top, max(turning / ease, (turning * length * along) ** (1.0 / 3.0)))
        ease = min(ease, turning / top)
    return top, ease
