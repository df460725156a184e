"""Whether the spline keeps to the tolerance, by a sure bound; where it does not, turning counts more.

On a part of a piece within a stretch the deviation is a cubic; it does not leave the hull of its four Bézier points.
"""

from __future__ import annotations

from math import sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.third_order.bends.controls import Spline, is_kept
from polycnc.motion.third_order.bends.seams import first_piece, pieces_behind
from polycnc.motion.third_order.bends.stretches import LINE, Stretches, tolerance_of, turn_tolerance_of
from polycnc.motion.third_order.bends.turning import Turning

#: Where the tolerance is exceeded turning counts more by this and so many times the excess, in every round more; and
#: more by this times the square of the round, for a little excess may be stubborn.
MORE, RATE, MOST, STUBBORN = 1.03, 1.2, 4.0, 0.03
#: Turning never counts more than this: what is not met then is not met because of the numbers' own steps.
HEAVIEST = 1e4


def weigh_excess(
    path: Stretches, n: int, spline: Spline, pieces: int, seams: Floats, turning: Turning, number: int
) -> int:
    """Let the turning count more around places where the path is left by more than its tolerance; their number.

    Only between the seams, and not where all is as in the round before. `number` is that of the round, from 0 on.
    """
    e, k, last, found = 0, first_piece(seams), len(path.form) - 1, 0
    raised, behind = -1, pieces - pieces_behind(seams)
    start = spline.way[k]
    while path.way[e + 1] <= start:
        e += 1
    while k < behind:
        if is_sure(spline, pieces, k) or is_kept(spline, pieces, k - 1, k + 2):
            k += 1
            start = spline.way[k]
            while e < last and path.way[e + 1] <= start:
                e += 1
            continue
        end = min(path.way[e + 1], spline.way[k + 1])
        if e == last and k == pieces - 1:
            end = path.way[e + 1]
        if end > start:
            used = part_used(path, n, spline, e, k, start, end)
            if used > 1.0:
                found += 1
                spline.kept[k] = spline.kept[k + 1] = -1
                factor = MORE + STUBBORN * number * number + RATE * (number + 1.0) * (used - 1.0)
                factor = min(factor, MOST)
                raised = raise_weights(path, spline, pieces, turning, e, k, factor, raised)
        start = end
        if e < last and path.way[e + 1] <= end:
            e += 1
        elif spline.way[k + 1] <= end:
            k += 1
        else:
            break
    return found


def is_sure(spline: Spline, pieces: int, k: int) -> bool:
    """Whether piece k keeps to the tolerance by how its knots lie: at a corner that is alone, or between two."""
    if spline.alone[k] != 0 or spline.alone[k + 1] != 0:
        return True
    return 0 < k < pieces - 1 and spline.alone[k - 1] != 0 and spline.alone[k + 2] != 0


def most_used(path: Stretches, n: int, spline: Spline, first: int, end: int) -> float:
    """The largest part of the tolerance that is used from one piece to before another."""
    e, most = 0, 0.0
    for k in range(first, end):
        start = spline.way[k]
        while start < spline.way[k + 1]:
            while path.way[e + 1] <= start:
                e += 1
            to = min(path.way[e + 1], spline.way[k + 1])
            most = max(most, part_used(path, n, spline, e, k, start, to))
            start = to
    return most


def part_used(path: Stretches, n: int, spline: Spline, e: int, k: int, start: float, end: float) -> float:
    """Which part of the tolerance is used at most from one way to another, both on stretch e and piece k."""
    third, per_mm = (end - start) / 3.0, 1.0 / (path.way[e + 1] - path.way[e])
    per_piece = 1.0 / (spline.way[k + 1] - spline.way[k])
    a, b, c, d = 0.0, 0.0, 0.0, 0.0
    turn = 0.0
    for i in range(n):
        first, rate = off(path, n, spline, e, k, start, i, per_mm, per_piece)
        last, end_rate = off(path, n, spline, e, k, end, i, per_mm, per_piece)
        second, fourth = first + third * rate, last - third * end_rate
        if path.rotary[i] != 0.0:
            turn = max(turn, abs(first), abs(second), abs(fourth), abs(last))
        else:
            a, b = a + first * first, b + second * second
            c, d = c + fourth * fourth, d + last * last
    return max(sqrt(max(a, b, c, d)) / tolerance_of(path, e), turn / turn_tolerance_of(path, e))


def off(
    path: Stretches,
    n: int,
    spline: Spline,
    e: int,
    k: int,
    way: float,
    i: int,
    per_mm: float,
    per_piece: float,
) -> tuple[float, float]:
    """Place of axis i on piece k less that on stretch e, at a way, and its derivative; a line counts as one.

    `per_mm` and `per_piece` are one over the length of the stretch and of the piece.
    """
    t, q = way - spline.way[k], k * n + i
    second, third = spline.second[q], (spline.second[q + n] - spline.second[q]) * per_piece
    place = spline.place[q] + t * (spline.first[q] + t * (0.5 * second + t * third / 6.0))
    first = spline.first[q] + t * (second + 0.5 * t * third)
    f, start = (way - path.way[e]) * per_mm, path.place[e * n + i]
    chord = path.place[e * n + n + i] - start
    there, rate = start + f * chord, chord
    if path.form[e] != LINE:
        length = path.way[e + 1] - path.way[e]
        leave, arrive = path.leave[e * n + i] * length - chord, path.arrive[e * n + i] * length - chord
        there += f * (1.0 - f) * ((1.0 - f) * leave - f * arrive)
        rate += (1.0 - f) * (1.0 - 3.0 * f) * leave + f * (3.0 * f - 2.0) * arrive
    return place - there, first - rate * per_mm


def raise_weights(
    path: Stretches, spline: Spline, pieces: int, turning: Turning, e: int, k: int, factor: float, raised: int
) -> int:
    """Let the turning of stretches around piece k count more, but for those up to `raised`; the last one that does."""
    start, end = spline.way[max(k - 1, 0)], spline.way[min(k + 2, pieces)]
    low, count = e, len(path.form)
    while low > 0 and path.way[low] >= start:
        low -= 1
    while low < count and path.way[low] <= end:
        if low > raised:
            turning.weight[low] = min(turning.weight[low] * factor, HEAVIEST)
            raised = low
        low += 1
    return raised
