"""What one round of bending leaves to the next: where no knot has moved, control points and shape stay.

A place that exceeds its tolerance sets knots closer around it. Everywhere else they lie as they did, and what is known
there need not be found again: control points, levelled ones too, and that the tolerance is kept.
"""

from __future__ import annotations

from polycnc.kernels.layout import Floats, Places, place
from polycnc.motion.third_order.bends.controls import Spline

#: Knots on either side of one that keeps its control point which lie as they did.
AROUND = 3
#: Ways that are nearer to each other are one, mm: sums of what a path turns by end in other digits.
NEAR = 1e-10
#: Vectors of a knot: its control point, place, q' and q''.
VECTORS = 4


class Kept(Places):
    """What is kept of a knot, before its vectors: way, `room`, and whether the tolerance is exceeded beside it."""

    WAY = place()
    ROOM = place()
    OVER = place()


def forget(spline: Spline, pieces: int) -> None:
    """Nothing is known from a round before."""
    for k in range(pieces + 1):
        spline.kept[k] = 0


def keep(spline: Spline, n: int, pieces: int, before: Floats) -> None:
    """Write what a round has found."""
    width = Kept.SIZE + VECTORS * n
    for k in range(pieces + 1):
        at, knot = k * width, k * n
        before[at + Kept.WAY], before[at + Kept.ROOM] = spline.way[k], spline.room[k]
        before[at + Kept.OVER] = 1.0 if spline.kept[k] < 0 else 0.0
        at += Kept.SIZE
        for i in range(n):
            before[at + i] = spline.control[knot + n + i]
            before[at + n + i] = spline.place[knot + i]
            before[at + 2 * n + i] = spline.first[knot + i]
            before[at + 3 * n + i] = spline.second[knot + i]


def take_over(spline: Spline, n: int, pieces: int, before: Floats, count: int) -> None:
    """Take over what is kept of the round before, which had `count` pieces, at knots around which none has moved."""
    forget(spline, pieces)
    width = Kept.SIZE + VECTORS * n
    k = j = 0
    while k <= pieces and j <= count:
        if not is_same(spline, k, before, j * width):
            # where the ways differ the nearer one has no counterpart
            ahead = spline.way[k] - before[j * width + Kept.WAY]
            k, j = k + (1 if ahead <= NEAR else 0), j + (1 if ahead >= -NEAR else 0)
            continue
        low = k if k == 0 and j == 0 else k + AROUND
        while k <= pieces and j <= count and is_same(spline, k, before, j * width):
            spline.way[k], spline.room[k] = before[j * width + Kept.WAY], before[j * width + Kept.ROOM]
            k, j = k + 1, j + 1
        end = k if k > pieces and j > count else k - AROUND
        for q in range(low, end):
            at = (j - k + q) * width
            if before[at + Kept.OVER] == 0.0:
                put_back(spline, n, q, before, at + Kept.SIZE)


def is_same(spline: Spline, k: int, before: Floats, at: int) -> bool:
    """Whether knot k lies where one did, and may have as much room."""
    return (
        abs(spline.way[k] - before[at + Kept.WAY]) <= NEAR
        and abs(spline.room[k] - before[at + Kept.ROOM]) <= NEAR
    )


def put_back(spline: Spline, n: int, k: int, before: Floats, at: int) -> None:
    """Give knot k the vectors that one had."""
    spline.kept[k] = 1
    for i in range(n):
        spline.control[(k + 1) * n + i] = before[at + i]
        spline.place[k * n + i] = before[at + n + i]
        spline.first[k * n + i] = before[at + 2 * n + i]
        spline.second[k * n + i] = before[at + 3 * n + i]
