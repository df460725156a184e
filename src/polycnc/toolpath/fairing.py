"""Kernel: the ends of short cuts become points of a smoother path, none of them farther off than it may be.

A block that a CAM system has written ends beside the surface by what its tolerance and its decimals leave. Where the
path really goes is told by the ends around: at each end a parabola is fitted to some of them on either side, by the way
along the lines, the nearer ones with more weight (local regression; Savitzky and Golay, Cleveland). It keeps lines, and
curves as far as they bend evenly: points of a circle stay on it. What it misses the end by is the `fit`. Rotary axes
with a tolerance of their own are columns of the same points.

Of each tolerance comes first what the parabola's own bend asks for, so that its corners can be rounded from line to
line (`BEND`); an end may be moved by what is `left`, and by no more than `PART` of the tolerance. Where the fit is more
than that, the ends around are no noise but a corner, and stay: `free` falls from 1 there to 0 at twice as much. Wider
parabolas, up to `reach`, count as far as they agree with the narrow one, and never reach into a corner.

No end is moved beyond a wall, which bounds a sum of its coordinates, nor farther than there is `room` beside its lines:
`allowed` is `free` with that. An end is moved by its fit times the mean, over `FADE` ends to either side, of the least
`allowed` within twice as many of each: so the path fades into corners and to walls without kinks of its own. The mean
is not above the end's own `allowed`, which times the fit is never above what the end may be moved by. Between two ends
the lines are off by no more than at these, and so they pass no wall.

The parabola shrinks towards the first and the last end of a run, which stay. Every end depends on those within `reach`
and a few more alone: it does not matter in what parts a run comes.
"""

from __future__ import annotations

from ctypes import Structure
from math import inf, sqrt

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import Annotated
from polycnc.kernels.layout import Floats, Ints, Ints32, record
from polycnc.toolpath.kinds import CURVE_WIDTH, NO_CURVE

#: Part of the tolerance by which an end is moved at most; `LEAST_LEFT` of `motion/kernels/feeds.py` is for rounding.
PART = 0.8
#: Rounding the corners of chords of a curve from line to line takes it off them by their height (an eighth of the turn
#: times the length), where its curvature is even by a third more.
BEND = 1.5
#: The path fades into a corner over so many ends, which lie as many off it.
FADE = 4
#: Reach of the narrow parabola; where wider ones are off it by this part of what an end may be moved by, their weight
#: begins to fall from 1, to 0 at twice as much. There the path bends less evenly than they. Two of them make no corner:
#: the fit stays below twice what is left.
NARROW, AGREES = 4, 0.2
#: Largest reach of any.
WIDEST = 16
#: An end that would be moved by less stays, mm or degrees.
LEAST_SHIFT = 1e-6
#: So little of its scale is a determinant that tells no parabola.
_FLAT = 1e-9
#: Numbers of a point: X, Y and Z, and as many rotary axes at most.
SPACE, TURNS = 3, 3
POINT = SPACE + TURNS
#: Tolerances that a point has: that of X, Y and Z, and those of the rotary axes.
BOUNDS = 1 + TURNS
#: Numbers of a wall: what each coordinate counts, and the largest sum.
WALL = POINT + 1


@record
class FairedRun(Structure):
    """A run on its way through the kernel; its arrays hold the points that are still needed.

    Attributes:
        points: How many they hold.
        before: How many of the run have been forgotten.
        measured: Points whose way is known; `fitted`: those with a narrow parabola; `widened`: those with wider ones;
            `lessened`: those with a least `allowed`; `settled`: those whose shift is known.
        reach: As `Fairing` says.
        ended: No more points come.
        turns: How many rotary axes are looked at.
        tolerance: How far the path may leave the lines, mm, and each rotary axis its way, degrees (0: it stays on it).
        scale: Of the parabola at hand: by what its bend is multiplied to give its height over the lines beside it.
        value: What each point counts in its value, from the first one on, and `bend` in its second coefficient.
    """

    points: int
    before: int
    measured: int
    fitted: int
    widened: int
    lessened: int
    settled: int
    reach: int
    ended: int
    turns: int
    tolerance: Annotated[Floats, BOUNDS]
    scale: float
    value: Annotated[Floats, 2 * WIDEST + 1]
    bend: Annotated[Floats, 2 * WIDEST + 1]


class Points(NamedTuple):
    """What is known of every point of a run.

    Attributes:
        place: Where it is, mm and degrees, `POINT` numbers; `fit`: what the parabola misses it by; `shift`: how far it
            is moved.
        way: Up to it, mm.
        left: What it may be moved by, `BOUNDS` numbers.
        free: The part of the fit that its tolerances let it move by, and `allowed` that with walls and room; `least`:
            the least part around.
        room: How far it may be moved by what is beside its lines, mm.
    """

    place: Floats
    fit: Floats
    shift: Floats
    way: Floats
    left: Floats
    free: Floats
    allowed: Floats
    least: Floats
    room: Floats


def fair(run: FairedRun, points: Points, walls: Floats) -> int:
    """Work off what is known of a run; gives how many points are settled.

    Args:
        run: The run.
        points: Its points: `place` and `room` of all, and room for the rest.
        walls: What they keep to, `WALL` numbers each.
    """
    count, ended, allowed = run.points, run.ended != 0, points.allowed
    while run.measured < count:
        measure(run, points)
    while run.fitted < count and (ended or run.fitted + NARROW < count):
        fit_point(run, points)
    while run.widened < run.fitted and (ended or run.widened + run.reach < run.fitted):
        widen_fit(run, points)
        allowed[run.widened] = part_of(
            min(share_left(run, run.widened, points), share_kept(run, points, walls))
        )
        run.widened += 1
    while run.lessened < run.widened and (ended or run.lessened + 2 * FADE < run.widened):
        i, part = run.lessened, 1.0
        for j in range(max(i - 2 * FADE, 0), min(i + 2 * FADE + 1, run.widened)):
            part = min(part, allowed[j])
        points.least[i] = part
        run.lessened += 1
    while run.settled < run.lessened and (ended or run.settled + FADE < run.lessened):
        settle(run, points)
    return run.settled


def settle(run: FairedRun, points: Points) -> None:
    """Say how far the next point is moved."""
    i, total, most = run.settled, 0.0, 0.0
    first, end = max(i - FADE, 0), min(i + FADE + 1, run.lessened)
    for j in range(first, end):
        total += points.least[j]
    part = min(total / (end - first), points.allowed[i])
    for bound in range(1 + run.turns):
        most = max(most, extent(points.fit, i, bound))
    if part * most < LEAST_SHIFT:
        part = 0.0
    for k in range(POINT):
        points.shift[POINT * i + k] = part * points.fit[POINT * i + k]
    run.settled += 1


def measure(run: FairedRun, points: Points) -> None:
    """Add the line to the next point to the way."""
    i, line2, place = run.measured, 0.0, points.place
    if i == 0:
        points.way[0] = 0.0
    else:
        for k in range(SPACE):
            step = place[POINT * i + k] - place[POINT * (i - 1) + k]
            line2 += step * step
        points.way[i] = points.way[i - 1] + sqrt(line2)
    run.measured += 1


def fit_point(run: FairedRun, points: Points) -> None:
    """Fit a narrow parabola around the next point."""
    i, side, fit = run.fitted, min(NARROW, run.before + run.fitted), points.fit
    if run.ended != 0:
        side = min(side, run.points - 1 - i)
    known = side > 1 and weigh(run, i, side, points.way)
    for k in range(POINT):
        fit[POINT * i + k] = 0.0
    for bound in range(1 + run.turns):
        tolerance, bend2 = run.tolerance[bound], 0.0
        for k in range(first_of(bound), end_of(bound) if known and tolerance > 0.0 else 0):
            fit[POINT * i + k] = summed(run.value, i, side, points.place, k)
            bend = summed(run.bend, i, side, points.place, k)
            bend2 += bend * bend
        height = sqrt(bend2) * run.scale if bend2 > 0.0 else 0.0
        points.left[BOUNDS * i + bound] = max(min(PART * tolerance, tolerance - BEND * height), 0.0)
    points.free[i] = part_of(share_left(run, i, points))
    run.fitted += 1


def first_of(bound: int) -> int:
    """The first coordinate that a tolerance is for: X, or a rotary axis."""
    return SPACE + bound - 1 if bound > 0 else 0


def end_of(bound: int) -> int:
    """The coordinate behind the last one that it is for."""
    return SPACE + bound


def extent(numbers: Floats, i: int, bound: int) -> float:
    """The part of what is noted of point i that a tolerance is for: a length in space, or an angle."""
    total = 0.0
    for k in range(first_of(bound), end_of(bound)):
        total += numbers[POINT * i + k] * numbers[POINT * i + k]
    return sqrt(total)


def share_left(run: FairedRun, i: int, points: Points) -> float:
    """The part of its fit that tolerances leave point i, which may be more than 1."""
    share = inf
    for bound in range(1 + run.turns):
        share = min(share, share_of(points.left[BOUNDS * i + bound], extent(points.fit, i, bound)))
    return share


def share_kept(run: FairedRun, points: Points, walls: Floats) -> float:
    """The part of its fit that walls, and what is beside its lines, leave the point that has been widened last."""
    i, place, fit = run.widened, points.place, points.fit
    share = share_of(points.room[i], extent(fit, i, 0))
    for w in range(0, len(walls), WALL):
        gap, towards = walls[w + POINT], 0.0
        for k in range(POINT):
            gap -= walls[w + k] * place[POINT * i + k]
            towards += walls[w + k] * fit[POINT * i + k]
        share = min(share, share_of(max(gap, 0.0), max(towards, 0.0)))
    return share


def share_of(bound: float, way: float) -> float:
    """Which part of a way a bound leaves; any part of none."""
    return bound / way if way > 0.0 else inf


def part_of(share: float) -> float:
    """1 where there is a share of 1 at least, from there down to 0 at a half; never more than the share."""
    if share >= 1.0:
        return 1.0
    return max(2.0 - 1.0 / share, 0.0) if share > 0.0 else 0.0


def widen_fit(run: FairedRun, points: Points) -> None:
    """Let wider parabolas around the next point count, where it is not beside a corner."""
    i, most = run.widened, min(run.reach, run.before + run.widened)
    fit, free, left = points.fit, points.free, points.left
    if run.ended != 0:
        most = min(most, run.points - 1 - i)
    if free[i] < 1.0 or left[BOUNDS * i] == 0.0:
        return
    for k in range(1, most + 1):
        if free[i - k] == 0.0 or free[i + k] == 0.0:
            most = k - 1
            break
    side, part = NARROW, 1.0
    while side < most and part > 0.0:
        side = min(2 * side, most)
        if not weigh(run, i, side, points.way):
            break
        part = min(part, agreement(run, i, side, points))
        for bound in range(1 + run.turns):
            for k in range(first_of(bound), end_of(bound) if run.tolerance[bound] > 0.0 else 0):
                at = POINT * i + k
                fit[at] += part * (summed(run.value, i, side, points.place, k) - fit[at])
    free[i] = part_of(share_left(run, i, points))


def agreement(run: FairedRun, i: int, side: int, points: Points) -> float:
    """How far the parabola at hand counts at point i: as far as it agrees with the fit."""
    share = inf
    for bound in range(1 + run.turns):
        off2 = 0.0
        for k in range(first_of(bound), end_of(bound) if run.tolerance[bound] > 0.0 else 0):
            off = summed(run.value, i, side, points.place, k) - points.fit[POINT * i + k]
            off2 += off * off
        share = min(share, share_of(AGREES * points.left[BOUNDS * i + bound], sqrt(off2)))
    return part_of(share)


def weigh(run: FairedRun, i: int, side: int, way: Floats) -> bool:
    """Work out what the points around point i count in a parabola; false where they tell none.

    It is fitted to so many points on either side, as far as the way goes on the shorter one.
    """
    half = min(way[i] - way[i - side], way[i + side] - way[i]) * (side + 1.0) / side
    m0, m1, m2, m3, m4 = 0.0, 0.0, 0.0, 0.0, 0.0
    value, bend = run.value, run.bend
    for k in range(2 * side + 1):
        t = (way[i - side + k] - way[i]) / half
        near = max(1.0 - t * t, 0.0)
        weight = near * near * near
        first, second = weight * t, weight * t * t
        m0, m1, m2, m3, m4 = m0 + weight, m1 + first, m2 + second, m3 + second * t, m4 + second * t * t
        value[k], bend[k] = weight, t
    a, b, c = m2 * m4 - m3 * m3, m1 * m4 - m2 * m3, m1 * m3 - m2 * m2
    d, e = m0 * m3 - m1 * m2, m0 * m2 - m1 * m1
    determinant = m0 * a - m1 * b + m2 * c
    if determinant <= _FLAT * m0 * m2 * m4:
        return False
    for k in range(2 * side + 1):
        weight, t = value[k] / determinant, bend[k]
        value[k] = weight * (a - b * t + c * t * t)
        bend[k] = weight * (c - d * t + e * t * t)
    line = max(way[i] - way[i - 1], way[i + 1] - way[i]) / half
    run.scale = line * line / 4.0
    return True


def summed(counts: Floats, i: int, side: int, place: Floats, column: int) -> float:
    """The sum of a coordinate of the points around point i, from it on, by what each counts."""
    total, own = 0.0, place[POINT * i + column]
    for k in range(2 * side + 1):
        total += counts[k] * (place[POINT * (i - side + k) + column] - own)
    return total


def add_points(
    ends: Floats,
    n: int,
    columns: Ints,
    frame: Floats,
    longest: float,
    run: FairedRun,
    place: Floats,
) -> int:
    """Add where rows end to the points of a run, up to a row that is too long or has no way; gives how many.

    Args:
        ends: Ends of rows, n numbers each.
        n: Number of axes.
        columns: Columns of X, Y and Z and of the rotary axes, -1 for a missing one.
        frame: Where X, Y and Z of the ends lead, nine numbers by rows.
        longest: Longest row, mm.
        run: The run, which has a point at least.
        place: Its points, with room for all.
    """
    for row in range(len(ends) // n):
        at, line2 = POINT * run.points, 0.0
        for j in range(SPACE):
            value = 0.0
            for k in range(SPACE):
                if columns[k] >= 0:
                    value += frame[SPACE * j + k] * ends[row * n + columns[k]]
            step = value - place[at - POINT + j]
            place[at + j] = value
            line2 += step * step
        for j in range(SPACE, POINT):
            place[at + j] = ends[row * n + columns[j]] if columns[j] >= 0 else 0.0
        if not 0.0 < line2 <= longest * longest:
            return row
        run.points += 1
    return len(ends) // n


def note_shifts(
    run: FairedRun, shift: Floats, first: int, count: int, curves: Floats, numbers: Ints32
) -> int:
    """Write the curve parameters of rows (`CURVE_WIDTH`); gives how many have any.

    Args:
        run: The run.
        shift: How far points are moved.
        first: The point at which the first row ends; the one in front is its start.
        count: Of the rows.
        curves: Room for their parameters.
        numbers: Gets the number of each row's parameters, `NO_CURVE` for one that is led as it is programmed.
    """
    found, before, swung = 0, extent(shift, first - 1, 0), swing(run, shift, first - 1)
    for row in range(count):
        i, at = first + row, CURVE_WIDTH * found
        own, own_swing = extent(shift, i, 0), swing(run, shift, i)
        numbers[row] = NO_CURVE
        if max(before, own, swung, own_swing) > 0.0:
            for k in range(SPACE):
                curves[at + k] = shift[POINT * i + k]
            curves[at + SPACE] = max(before, own)
            for k in range(TURNS):
                curves[at + SPACE + 1 + k] = shift[POINT * i + SPACE + k]
            curves[at + SPACE + 1 + TURNS] = max(swung, own_swing)
            numbers[row] = found
            found += 1
        before, swung = own, own_swing
    return found


def swing(run: FairedRun, shift: Floats, i: int) -> float:
    """The largest part of its tolerance by which a rotary axis is moved at point i."""
    part = 0.0
    for bound in range(1, 1 + run.turns):
        tolerance = run.tolerance[bound]
        if tolerance > 0.0:
            part = max(part, extent(shift, i, bound) / tolerance)
    return part
