"""The programmed path as stretches: lines, chords of splines, parts of arcs, each a cubic by its way.

A stretch leads from one place to the next with a tangent at each end (Hermite). Where short lines are points of a
smooth curve they get the tangents of that curve, as chords of a spline do: the path would else turn by jerks that
nobody has programmed.
"""

from __future__ import annotations

from math import sqrt

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.layout import Floats, Ints

#: Forms of a stretch.
LINE, CHORD, ARC = 0, 1, 2
#: A smaller tolerance counts as this one, mm or degrees.
LEAST = 1e-4
#: A spline whose chords turn by more has a corner there (35°); lines that turn by more are none of a smooth curve.
SPLINE_TURN, LINE_TURN = 0.6, 0.35
#: Of the tolerance: how far a curve may bulge from lines that are taken for its chords; how far it may without a look
#: at the curvature before and behind.
BULGE, LITTLE_BULGE = 0.25, 0.02
#: Of the larger of two neighbouring curvatures: by how much those of one curve differ at most.
EVEN = 0.5


class Stretches(NamedTuple):
    """A programmed path of m stretches and n axes.

    Attributes:
        way: At their ends, mm, m + 1 numbers from 0 on: what the feed counts.
        place: Positions of the axes there, (m + 1)·n.
        leave: The derivative by the way at the start of each, m·n.
        arrive: At its end, m·n.
        form: LINE, CHORD or ARC, m.
        tolerance: How far the linear axes may leave it, mm, m.
        turn_tolerance: How far the rotary axes may, degrees, m.
        cap2: Largest square of the speed, m.
        step2: That at the corner where it begins, by how much velocities may change there, m; infinite for none.
        spread2: That by how much they may while the shorter one of the two rows lasts, m.
        left2: That by the limits of axes that the program sets, m; infinite for none.
        ease: Part of acceleration and jerk that the program lets the axes use, m.
        row: Numbers of their rows, m.
        rotary: 1 for a rotary axis, n.
        top: Highest speed of each axis, n.
    """

    way: Floats
    place: Floats
    leave: Floats
    arrive: Floats
    form: Ints
    tolerance: Floats
    turn_tolerance: Floats
    cap2: Floats
    step2: Floats
    spread2: Floats
    left2: Floats
    ease: Floats
    row: Ints
    rotary: Floats
    top: Floats


def length_of(path: Stretches, e: int) -> float:
    """Way of stretch e."""
    length: float = path.way[e + 1] - path.way[e]
    return length


def tolerance_of(path: Stretches, e: int) -> float:
    """Tolerance of the linear axes on stretch e, mm; a curve cannot be met without any."""
    return max(path.tolerance[e], LEAST)


def turn_tolerance_of(path: Stretches, e: int) -> float:
    """The same of the rotary axes, degrees."""
    return max(path.turn_tolerance[e], LEAST)


def put_place(path: Stretches, e: int, way: float, n: int, out: Floats, at: int) -> None:
    """Write the place of the curve at a way on stretch e into n numbers of `out` from `at` on."""
    length = path.way[e + 1] - path.way[e]
    f = (way - path.way[e]) / length
    for i in range(n):
        start = path.place[e * n + i]
        chord = path.place[e * n + n + i] - start
        leave, arrive = path.leave[e * n + i] * length - chord, path.arrive[e * n + i] * length - chord
        out[at + i] = start + f * (chord + (1.0 - f) * ((1.0 - f) * leave - f * arrive))


def between(path: Stretches, e: int, other: int, n: int, at_start: bool) -> float:
    """How much q' differs between the end of stretch e and the start of another, by the tolerance of both.

    With `at_start` and e == other: between the start of the stretch and its own end, through its chord.
    """
    line2, turn2 = 0.0, 0.0
    length = path.way[e + 1] - path.way[e]
    for i in range(n):
        if at_start:
            unit = (path.place[e * n + n + i] - path.place[e * n + i]) / length
            change = max(abs(path.leave[e * n + i] - unit), abs(path.arrive[e * n + i] - unit))
            change = max(2.0 * change, abs(path.arrive[e * n + i] - path.leave[e * n + i]))
        else:
            change = path.leave[other * n + i] - path.arrive[e * n + i]
        if path.rotary[i] != 0.0:
            turn2 += change * change
        else:
            line2 += change * change
    least = min(tolerance_of(path, e), tolerance_of(path, other))
    least_turn = min(turn_tolerance_of(path, e), turn_tolerance_of(path, other))
    return max(
        sqrt(line2) / least if line2 > 0.0 else 0.0,
        sqrt(turn2) / least_turn if turn2 > 0.0 else 0.0,
    )


def curve_lines(path: Stretches, n: int, smooth: Ints) -> None:
    """Give lines and chords that are of a smooth curve its tangents.

    At a point between two of them it is the derivative of the parabola through the three points; at the end of such a
    curve that with which it bends evenly. Sets `leave` and `arrive`, and `smooth` of the m + 1 ends to 1.
    """
    count = len(path.form)
    for e in range(count):
        for i in range(n):
            if path.form[e] != ARC:
                unit = (path.place[e * n + n + i] - path.place[e * n + i]) / length_of(path, e)
                path.leave[e * n + i] = path.arrive[e * n + i] = unit
    smooth[0] = smooth[count] = 0
    for e in range(1, count):
        smooth[e] = 1 if is_smooth(path, e, n) else 0
    for e in range(1, count):
        if smooth[e] != 0:
            before, behind = length_of(path, e - 1), length_of(path, e)
            for i in range(n):
                first = (path.place[e * n + i] - path.place[e * n - n + i]) / before
                last = (path.place[e * n + n + i] - path.place[e * n + i]) / behind
                mean = (first * behind + last * before) / (before + behind)
                path.arrive[e * n - n + i] = path.leave[e * n + i] = mean
    for e in range(count):
        if path.form[e] != ARC and smooth[e] != smooth[e + 1]:
            for i in range(n):
                unit = (path.place[e * n + n + i] - path.place[e * n + i]) / length_of(path, e)
                if smooth[e] == 0:
                    path.leave[e * n + i] = 2.0 * unit - path.arrive[e * n + i]
                else:
                    path.arrive[e * n + i] = 2.0 * unit - path.leave[e * n + i]


def is_smooth(path: Stretches, e: int, n: int) -> bool:
    """Whether the stretches before and behind end e are chords of one smooth curve."""
    if path.form[e - 1] == ARC or path.form[e] == ARC or path.form[e - 1] != path.form[e]:
        return False
    line2, turn = 0.0, 0.0
    before, behind = length_of(path, e - 1), length_of(path, e)
    for i in range(n):
        change = turn_at(path, e, n, i)
        if path.rotary[i] == 0.0:
            line2 += change * change
        else:
            turn = max(turn, abs(change))
    angle, longer = sqrt(line2), max(before, behind)
    if path.form[e] == CHORD:
        return angle <= SPLINE_TURN
    bulge = (
        0.125
        * longer
        * max(
            angle / min(tolerance_of(path, e - 1), tolerance_of(path, e)),
            turn / min(turn_tolerance_of(path, e - 1), turn_tolerance_of(path, e)),
        )
    )
    if angle > LINE_TURN or bulge > BULGE:
        return False
    return bulge <= LITTLE_BULGE or bends_evenly(path, e, e - 1, n) or bends_evenly(path, e, e + 1, n)


def turn_at(path: Stretches, e: int, n: int, i: int) -> float:
    """What the direction of axis i changes by at end e, from chord to chord."""
    before, behind = length_of(path, e - 1), length_of(path, e)
    first = (path.place[e * n + i] - path.place[e * n - n + i]) / before
    last = (path.place[e * n + n + i] - path.place[e * n + i]) / behind
    return last - first


def bends_evenly(path: Stretches, e: int, other: int, n: int) -> bool:
    """Whether the curvature at end e is like that at another one beside it."""
    if other < 1 or other >= len(path.form):
        return False
    apart2, own2, others2 = 0.0, 0.0, 0.0
    for i in range(n):
        own = turn_at(path, e, n, i) / (length_of(path, e - 1) + length_of(path, e))
        its = turn_at(path, other, n, i) / (length_of(path, other - 1) + length_of(path, other))
        apart2, own2, others2 = apart2 + (own - its) * (own - its), own2 + own * own, others2 + its * its
    return apart2 <= EVEN * EVEN * max(own2, others2)
