"""Kernel: the ends of short cuts become points of a smoother path, none of them farther off than it may be.

A block that a CAM system has written ends beside the surface by what its tolerance and its decimals leave. Where the
path really goes is told by the ends around: at each end a parabola is fitted to some of them on either side, by the way
along the lines, the nearer ones with more weight (local regression; Savitzky and Golay, Cleveland). It keeps lines, and
curves as far as they bend evenly: points of a circle stay on it. What it misses the end by is the `fit`.

Of the tolerance comes first what the parabola's own bend asks for, so that its corners can be rounded from line to line
(`BEND`); an end may be moved by what is `left`, and by no more than `PART` of the tolerance. Where the fit is more than
that, the ends around are no noise but a corner, and stay: `free` falls from 1 there to 0 at twice as much. Wider
parabolas, up to `reach`, count as far as they agree with the narrow one, and never reach into a corner.

An end is moved by its fit times the mean, over `FADE` ends to either side, of the least `free` within twice as many of
each: so the path fades into corners without kinks of its own. The mean is not above the end's own `free`, which times
the fit is never above what the end may be moved by. Between two ends the lines are off by no more than at these.

The parabola shrinks towards the first and the last end of a run, which stay. Every end depends on those within `reach`
and a few more alone: it does not matter in what parts a run comes.
"""

from __future__ import annotations

from ctypes import Structure
from math import sqrt

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
#: An end that would be moved by less stays, mm.
LEAST_SHIFT = 1e-6
#: So little of its scale is a determinant that tells no parabola.
_FLAT = 1e-9
#: Numbers of a point.
POINT = 3


@record
class FairedRun(Structure):
    """A run on its way through the kernel; its arrays hold the points that are still needed.

    Attributes:
        points: How many they hold.
        before: How many of the run have been forgotten.
        measured: Points whose way is known; `fitted`: those with a narrow parabola; `widened`: those with wider ones;
            `lessened`: those with a least `free`; `settled`: those whose shift is known.
        reach: As `Fairing` says.
        ended: No more points come.
        tolerance: How far the path may leave the lines, mm.
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
    tolerance: float


def fair(
    run: FairedRun,
    place: Floats,
    way: Floats,
    fit: Floats,
    left: Floats,
    free: Floats,
    least: Floats,
    shift: Floats,
) -> int:
    """Work off what is known of a run; gives how many points are settled.

    Args:
        run: The run.
        place: Where its points are, mm, `POINT` numbers each.
        way: Room for the way up to each point, mm.
        fit: Room for what the parabola at each point misses it by, mm, `POINT` numbers each.
        left: Room for what each point may be moved by, mm.
        free: Room for the part of the fit that one point allows.
        least: Room for the least part around.
        shift: Room for how far each point is moved, mm, `POINT` numbers each.
    """
    count, ended = run.points, run.ended != 0
    while run.measured < count:
        measure(run, place, way)
    while run.fitted < count and (ended or run.fitted + NARROW < count):
        fit_point(run, place, way, fit, left, free)
    while run.widened < run.fitted and (ended or run.widened + run.reach < run.fitted):
        widen_fit(run, place, way, fit, left, free)
    while run.lessened < run.widened and (ended or run.lessened + 2 * FADE < run.widened):
        i, part = run.lessened, 1.0
        for j in range(max(i - 2 * FADE, 0), min(i + 2 * FADE + 1, run.widened)):
            part = min(part, free[j])
        least[i] = part
        run.lessened += 1
    while run.settled < run.lessened and (ended or run.settled + FADE < run.lessened):
        settle(run, fit, free, least, shift)
    return run.settled


def settle(run: FairedRun, fit: Floats, free: Floats, least: Floats, shift: Floats) -> None:
    """Say how far the next point is moved."""
    i, total = run.settled, 0.0
    first, end = max(i - FADE, 0), min(i + FADE + 1, run.lessened)
    for j in range(first, end):
        total += least[j]
    part = min(total / (end - first), free[i])
    if part * size(fit, i) < LEAST_SHIFT:
        part = 0.0
    for k in range(POINT):
        shift[POINT * i + k] = part * fit[POINT * i + k]
    run.settled += 1


def measure(run: FairedRun, place: Floats, way: Floats) -> None:
    """Add the line to the next point to the way."""
    i, line2 = run.measured, 0.0
    if i == 0:
        way[0] = 0.0
    else:
        for k in range(POINT):
            step = place[POINT * i + k] - place[POINT * (i - 1) + k]
            line2 += step * step
        way[i] = way[i - 1] + sqrt(line2)
    run.measured += 1


def fit_point(run: FairedRun, place: Floats, way: Floats, fit: Floats, left: Floats, free: Floats) -> None:
    """Fit a narrow parabola around the next point."""
    i, side = run.fitted, min(NARROW, run.before + run.fitted)
    if run.ended != 0:
        side = min(side, run.points - 1 - i)
    x, y, z, height = 0.0, 0.0, 0.0, 0.0
    if side > 1:
        x, y, z, height = missed(i, side, place, way)
    fit[POINT * i], fit[POINT * i + 1], fit[POINT * i + 2] = x, y, z
    left[i] = max(min(PART * run.tolerance, run.tolerance - BEND * height), 0.0)
    free[i] = part_of(length(x, y, z), left[i])
    run.fitted += 1


def part_of(off: float, bound: float) -> float:
    """1 up to a bound, from there down to 0 at twice as much."""
    if off <= bound:
        return 1.0
    return max(2.0 - off / bound, 0.0) if bound > 0.0 else 0.0


def widen_fit(run: FairedRun, place: Floats, way: Floats, fit: Floats, left: Floats, free: Floats) -> None:
    """Let wider parabolas around the next point count, where it is not beside a corner."""
    i, most = run.widened, min(run.reach, run.before + run.widened)
    if run.ended != 0:
        most = min(most, run.points - 1 - i)
    run.widened += 1
    if free[i] < 1.0 or left[i] == 0.0:
        return
    for k in range(1, most + 1):
        if free[i - k] == 0.0 or free[i + k] == 0.0:
            most = k - 1
            break
    side, part = NARROW, 1.0
    x, y, z = fit[POINT * i], fit[POINT * i + 1], fit[POINT * i + 2]
    while side < most and part > 0.0:
        side = min(2 * side, most)
        wide_x, wide_y, wide_z, _ = missed(i, side, place, way)
        part = part_of(length(wide_x - x, wide_y - y, wide_z - z), AGREES * left[i])
        x, y, z = x + part * (wide_x - x), y + part * (wide_y - y), z + part * (wide_z - z)
    fit[POINT * i], fit[POINT * i + 1], fit[POINT * i + 2] = x, y, z
    free[i] = part_of(length(x, y, z), left[i])


def missed(i: int, side: int, place: Floats, way: Floats) -> tuple[float, float, float, float]:
    """By how much a parabola misses point i, as a vector, and its height over the lines beside the point, mm.

    It is fitted to so many points on either side, as far as the way goes on the shorter one.
    """
    half = min(way[i] - way[i - side], way[i + side] - way[i]) * (side + 1.0) / side
    m0, m1, m2, m3, m4 = 0.0, 0.0, 0.0, 0.0, 0.0
    x0, x1, x2, y0, y1, y2, z0, z1, z2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(i - side, i + side + 1):
        t = (way[j] - way[i]) / half
        near = 1.0 - t * t
        if near > 0.0:
            weight = near * near * near
            first, second = weight * t, weight * t * t
            m0, m1, m2, m3, m4 = m0 + weight, m1 + first, m2 + second, m3 + second * t, m4 + second * t * t
            x = place[POINT * j] - place[POINT * i]
            y = place[POINT * j + 1] - place[POINT * i + 1]
            z = place[POINT * j + 2] - place[POINT * i + 2]
            x0, x1, x2 = x0 + weight * x, x1 + first * x, x2 + second * x
            y0, y1, y2 = y0 + weight * y, y1 + first * y, y2 + second * y
            z0, z1, z2 = z0 + weight * z, z1 + first * z, z2 + second * z
    a, b, c = m2 * m4 - m3 * m3, m1 * m4 - m2 * m3, m1 * m3 - m2 * m2
    determinant = m0 * a - m1 * b + m2 * c
    if determinant <= _FLAT * m0 * m2 * m4:
        return 0.0, 0.0, 0.0, 0.0
    d, e = m0 * m3 - m1 * m2, m0 * m2 - m1 * m1
    x = x0 * c - x1 * d + x2 * e
    y = y0 * c - y1 * d + y2 * e
    z = z0 * c - z1 * d + z2 * e
    line = max(way[i] - way[i - 1], way[i + 1] - way[i]) / half
    height = length(x, y, z) / determinant * line * line / 4.0
    return (
        (x0 * a - x1 * b + x2 * c) / determinant,
        (y0 * a - y1 * b + y2 * c) / determinant,
        (z0 * a - z1 * b + z2 * c) / determinant,
        height,
    )


def add_points(
    ends: Floats, n: int, geometry: Ints, frame: Floats, longest: float, run: FairedRun, place: Floats
) -> int:
    """Add where rows end to the points of a run, up to a row that is too long or has no way; gives how many.

    Args:
        ends: Ends of rows, n numbers each.
        n: Number of axes.
        geometry: Columns of X, Y and Z, -1 for a missing one.
        frame: Where X, Y and Z of the ends lead, nine numbers by rows.
        longest: Longest row, mm.
        run: The run, which has a point at least.
        place: Its points, with room for all.
    """
    for row in range(len(ends) // n):
        at, line2 = POINT * run.points, 0.0
        for j in range(POINT):
            value = 0.0
            for k in range(POINT):
                if geometry[k] >= 0:
                    value += frame[POINT * j + k] * ends[row * n + geometry[k]]
            step = value - place[at - POINT + j]
            place[at + j] = value
            line2 += step * step
        if not 0.0 < line2 <= longest * longest:
            return row
        run.points += 1
    return len(ends) // n


def note_shifts(shift: Floats, first: int, count: int, curves: Floats, numbers: Ints32) -> int:
    """Write the curve parameters of rows (`CURVE_WIDTH`); gives how many have any.

    Args:
        shift: How far points are moved.
        first: The point at which the first row ends; the one in front is its start.
        count: Of the rows.
        curves: Room for their parameters.
        numbers: Gets the number of each row's parameters, `NO_CURVE` for one that is led as it is programmed.
    """
    found, before = 0, size(shift, first - 1)
    for row in range(count):
        own, at = size(shift, first + row), CURVE_WIDTH * found
        numbers[row] = NO_CURVE
        if before > 0.0 or own > 0.0:
            for k in range(POINT):
                curves[at + k] = shift[POINT * (first + row) + k]
            curves[at + POINT] = max(before, own)
            numbers[row] = found
            found += 1
        before = own
    return found


def size(shift: Floats, i: int) -> float:
    """How far point i is moved, mm."""
    return length(shift[POINT * i], shift[POINT * i + 1], shift[POINT * i + 2])


def length(x: float, y: float, z: float) -> float:
    """Length of a vector."""
    return sqrt(x * x + y * y + z * z)
