"""Corners between lines so short that knots lie nearer than the tolerance needs: what is left of it levels them.

The control point of such a corner moves towards its inside, by a part of the bow `V·q''` by which the spline leaves it
(`controls.py`), until the tolerance is used up; back by some where its neighbours, which move too, take it too far. A
zigzag becomes flatter, and what turns in one sense more even.
"""

from __future__ import annotations

from math import sqrt

from polycnc.motion.third_order.bends.controls import Spline, knot, shape_knot
from polycnc.motion.third_order.bends.stretches import Stretches, tolerance_of, turn_tolerance_of

#: Part of the tolerance that is used; largest part of the bow; times that control points are moved.
USED, MOST, TIMES = 0.98, 1.5, 5
#: Knots that have more of their room have it.
HAS_ROOM = 0.93


def level(path: Stretches, n: int, spline: Spline, pieces: int) -> None:
    """Move control points, and shape the spline anew."""
    count = choose(spline, pieces)
    for _ in range(TIMES if count > 0 else 0):
        e, last, shaped = 0, len(path.form) - 1, 0
        for j in range(count):
            k = spline.moving[j]
            while e < last and path.way[e + 1] <= spline.way[k]:
                e += 1
            move_on(path, n, spline, pieces, e, k)
        for j in range(count):
            first, end = max(spline.moving[j] - 1, shaped), spline.moving[j] + 2
            for k in range(first, end):
                shape_knot(spline, n, pieces, k)
            shaped = end


def choose(spline: Spline, pieces: int) -> int:
    """Write the corners into `moving` that lie nearer to their neighbours than they need to; their number."""
    found = 0
    for k in range(1, pieces):
        nearest = min(spline.way[k] - spline.way[k - 1], spline.way[k + 1] - spline.way[k])
        if spline.kept[k] == 0 and nearest < HAS_ROOM * spline.room[k]:
            spline.moving[found], spline.moved[k] = k, 0.0
            found += 1
    return found


def move_on(path: Stretches, n: int, spline: Spline, pieces: int, e: int, k: int) -> None:
    """Move the control point of knot k on, which lies at the corner before stretch e."""
    line2, turn = 0.0, 0.0
    for i in range(n):
        apart = spline.place[k * n + i] - path.place[e * n + i]
        if path.rotary[i] != 0.0:
            turn = max(turn, abs(apart))
        else:
            line2 += apart * apart
    before = max(e - 1, 0)
    used = max(
        sqrt(line2) / min(tolerance_of(path, e), tolerance_of(path, before)),
        turn / min(turn_tolerance_of(path, e), turn_tolerance_of(path, before)),
    )
    part = min(max(USED / max(used, 1e-9) - 1.0, -spline.moved[k]), MOST - spline.moved[k])
    spline.moved[k] += part
    low, high = spline.way[k] - knot(spline, pieces, k - 1), knot(spline, pieces, k + 1) - spline.way[k]
    bow = part * (low * low + high * high + (low + high) * (low + high)) / 36.0
    for i in range(n):
        spline.control[(k + 1) * n + i] += bow * spline.second[k * n + i]
