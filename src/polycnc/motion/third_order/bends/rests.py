"""Where the axes must rest on a path: it turns back, or a corner may not be left."""

from __future__ import annotations

from math import sqrt

from polycnc.motion.third_order.bends.stretches import CHORD, SPLINE_TURN, Stretches

#: A path turns back where the cosine of its turn is below this (170°).
BACK = -0.985
#: A smaller tolerance is none (mm, degrees); a smaller step of q' no corner.
NO_TOLERANCE, NO_CORNER = 1e-6, 1e-7
#: A rotary axis whose degrees a mm of the way change by more turns at a place of the path: between such rows axes rest.
MOST_TURN = 100.0
#: A row that is slower, mm/s, takes little longer from rest to rest; the square of the speed of another one is so many
#: times that of a row.
CREEPS, OTHER = 1.0 / 30.0, 1.5


def next_rest(path: Stretches, first: int) -> int:
    """The next end of a stretch at which the axes must rest, behind the start of stretch `first`."""
    n, e = len(path.rotary), first + 1
    while e < len(path.form) and not (must_rest(path, e, n) or creeps(path, e)):
        e += 1
    return e


def creeps(path: Stretches, e: int) -> bool:
    """Whether a row that creeps meets a faster one at end e: there the axes may as well rest."""
    low, high = min(path.cap2[e - 1], path.cap2[e]), max(path.cap2[e - 1], path.cap2[e])
    return path.row[e - 1] != path.row[e] and low < CREEPS * CREEPS and high > OTHER * low


def must_rest(path: Stretches, e: int, n: int) -> bool:
    """Whether the axes must rest between the stretches before and behind end e."""
    along, before2, behind2, line2, turn = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(n):
        arrive, leave = path.arrive[e * n - n + i], path.leave[e * n + i]
        if path.rotary[i] != 0.0:
            turn = max(turn, abs(leave - arrive))
        else:
            along, before2, behind2 = (
                along + arrive * leave,
                before2 + arrive * arrive,
                behind2 + leave * leave,
            )
            line2 += (leave - arrive) * (leave - arrive)
    if along < BACK * sqrt(before2 * behind2) or turn > MOST_TURN:
        return True
    smooth = path.form[e - 1] == CHORD and path.form[e] == CHORD and line2 <= SPLINE_TURN * SPLINE_TURN
    if smooth:
        return False
    least = min(path.tolerance[e - 1], path.tolerance[e])
    least_turn = min(path.turn_tolerance[e - 1], path.turn_tolerance[e])
    return (line2 > NO_CORNER * NO_CORNER and least < NO_TOLERANCE) or (
        turn > NO_CORNER and least_turn < NO_TOLERANCE
    )
