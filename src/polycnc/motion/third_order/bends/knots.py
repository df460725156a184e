"""Where the knots of the spline lie: as far apart as the tolerance allows.

Samples of the path say how far apart knots may be around them (`turning.reach`): at every corner that counts, where a
curve begins or ends behind a straight line, and along curves about as close as the knots themselves. Those of the first
two kinds are fixed: a knot lies there, for a corner is rounded least around a knot. Between two fixed ones

- along a straight line nothing turns: one knot behind the first and one before the second are enough, or one that the
  two share, or none;
- elsewhere knots follow each other at distances that change slowly.
"""

from __future__ import annotations

from math import ceil, exp, log

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.layout import Floats, Ints
from polycnc.motion.third_order.bends.controls import Spline
from polycnc.motion.third_order.bends.seams import (
    Seams,
    free_from,
    free_to,
    put_head,
    put_tail,
    stretch_before,
    stretch_behind,
)
from polycnc.motion.third_order.bends.stretches import Stretches
from polycnc.motion.third_order.bends.turning import FULL, SHARE, Turning, reach

#: Samples along curves: their distance in that of the knots there.
APART = 0.7
#: By how much of the way between them the distances of knots may differ.
GROWTH = 0.3
#: A corner is fixed if the next ones are so far from it, in the distance of knots that it allows.
LONE, CLOSE = 0.33, 0.5
#: Knots are not nearer to each other than this part of their distances; so little more of an interval makes no second.
LITTLE, SPARE = 0.02, 0.03


class Samples(NamedTuple):
    """Places of the path: their way, how far apart knots may be around them, the stretch behind, and what they are.

    `fixed` is 1 where a knot must lie; `straight` where the path does not turn up to the next sample.
    """

    way: Floats
    apart: Floats
    stretch: Ints
    fixed: Ints
    straight: Ints


def take_samples(path: Stretches, turning: Turning, seams: Floats, samples: Samples) -> int:
    """Sample a path between its seams; the number of samples, -1 where there is no room for them."""
    most, count = path.way[len(path.form)] - path.way[0], 1
    start, end = free_from(path, seams), free_to(path, seams)
    e, last = stretch_behind(path, start), stretch_before(path, end) + 1
    put_sample(samples, 0, start, seams[Seams.HEAD_APART], e, 1)
    if seams[Seams.HEAD_APART] <= 0.0:
        samples.apart[0] = reach(path, turning, e, start, most, most)
    lone = start
    while samples.way[count - 1] < end:
        if count + 1 >= len(samples.way):
            return -1
        here, apart = samples.way[count - 1], samples.apart[count - 1]
        e, straight = samples.stretch[count - 1], True
        goal, k, fixed, still, h = here + APART * apart, e + 1, False, here, 0.0
        while k < last:
            straight = straight and is_straight(turning, e, k)
            if turning.before[k] > turning.behind[k - 1]:
                still = path.way[k]
            if not straight and path.way[k] > goal:
                break
            if is_corner(path, turning, k, apart, still):
                h = reach(path, turning, k, path.way[k], apart, most)
                if is_fixed(path, turning, k, h, still, lone, end):
                    fixed = True
                    break
            k += 1
        if k == last:
            straight = straight and is_straight(turning, e, k)
        samples.straight[count - 1] = 1 if straight else 0
        if fixed:
            put_sample(samples, count, path.way[k], h, k, 1)
            lone = path.way[k]
        elif straight or goal >= end - LITTLE * apart:
            put_sample(samples, count, end, seams[Seams.TAIL_APART], last - 1, 1)
            if seams[Seams.TAIL_APART] <= 0.0:
                samples.apart[count] = reach(path, turning, last - 1, end, apart, most)
        else:
            while path.way[e + 1] <= goal:
                e += 1
            put_sample(samples, count, goal, reach(path, turning, e, goal, apart, most), e, 0)
        count += 1
    return count


def is_straight(turning: Turning, e: int, k: int) -> bool:
    """Whether a path does not turn from stretch e up to end k."""
    return turning.before[k] <= turning.behind[e] and turning.before[e + 1] <= turning.behind[e]


def put_sample(samples: Samples, k: int, way: float, apart: float, e: int, fixed: int) -> None:
    """Write a sample."""
    samples.way[k], samples.apart[k], samples.stretch[k] = way, apart, e
    samples.fixed[k], samples.straight[k] = fixed, 0


def is_corner(path: Stretches, turning: Turning, k: int, apart: float, still: float) -> bool:
    """Whether end k of a stretch may need a knot: it is a corner, or a straight line that is not short ends there."""
    turn = turning.behind[k] - turning.before[k]
    ahead = turning.before[k + 1] <= turning.behind[k]
    before = turning.before[k] <= turning.behind[k - 1]
    length, behind = path.way[k] - min(still, path.way[k - 1]), path.way[k + 1] - path.way[k]
    if turn > 0.0 and FULL * SHARE / turn * LONE < max(length, behind):
        return True
    if turn <= 0.0 and ahead == before:
        return False
    return (before and length > LONE * LONE * apart) or (ahead and behind > LONE * LONE * apart)


def is_fixed(
    path: Stretches, turning: Turning, k: int, h: float, still: float, lone: float, end: float
) -> bool:
    """Whether a knot must lie at end k, around which knots may be h apart.

    `lone` is the way of the last fixed one, `end` that of the last one of all.
    """
    if path.way[k] - lone < CLOSE * h or end - path.way[k] < LITTLE * h:
        return False
    turn = turning.behind[k] - turning.before[k]
    length, behind = path.way[k] - min(still, path.way[k - 1]), path.way[k + 1] - path.way[k]
    if turn > 0.0 and FULL * SHARE / turn * LONE < max(length, behind):
        return True
    ahead = turning.before[k + 1] <= turning.behind[k]
    before = turning.before[k] <= turning.behind[k - 1]
    return (before and length > LONE * h) or (ahead and behind > LONE * h)


def even_out(samples: Samples, count: int) -> None:
    """Let the distances of knots change slowly from sample to sample, but along straight lines between fixed ones."""
    for k in range(1, count):
        limit(samples, k, k - 1, k - 1)
    for k in range(count - 2, -1, -1):
        limit(samples, k, k + 1, k)


def limit(samples: Samples, k: int, other: int, first: int) -> None:
    """Bound the distance at sample k by that at the one beside it; `first` is the lower of both numbers."""
    if samples.straight[first] != 0 and samples.fixed[first] != 0 and samples.fixed[first + 1] != 0:
        return
    most = samples.apart[other] + GROWTH * (samples.way[first + 1] - samples.way[first])
    samples.apart[k] = min(samples.apart[k], most)


def place_knots(samples: Samples, count: int, seams: Floats, spline: Spline) -> int:
    """Write the ways of the knots, in order, and which of them are corners between lines.

    A corner from which two others lie on either line, the nearer ones as far away as it allows, is alone: control
    points around lie on both lines and at the corner itself, from which the spline is farther than from any other
    place: by what it was placed for. Between two such ones it is the line.

    Returns:
        Their number, -1 where there is no room.
    """
    knots, room = spline.way, spline.room
    made, first, on_line, two = put_head(seams, knots) + 1, 0, False, False
    knots[made - 1] = samples.way[0]
    set_apart(spline, 0, made)
    while first < count - 1:
        last = first + 1
        while samples.fixed[last] == 0:
            last += 1
        was_line, on_line, before = on_line, last == first + 1 and samples.straight[first] != 0, made - 1
        room[before] = samples.apart[first] if was_line and on_line else 0.0
        if on_line:
            if made + 4 > len(knots):
                return -1
            made = knots_on_line(samples, first, count, seams, knots, made)
        else:
            made = knots_on_curve(samples, first, last, knots, made)
            if made < 0:
                return -1
        had_two, two = two, on_line and made == before + 3
        spline.alone[before] = 1 if had_two and two else 0
        knots[made] = samples.way[last]
        set_apart(spline, before + 1, made + 1)
        made, first = made + 1, last
    first, made = made, put_tail(seams, knots, made)
    set_apart(spline, first, made)
    return made


def set_apart(spline: Spline, first: int, end: int) -> None:
    """Let knots from one to before another be no corners between lines."""
    for k in range(first, end):
        spline.room[k], spline.alone[k] = 0.0, 0


def knots_on_line(samples: Samples, k: int, count: int, seams: Floats, knots: Floats, made: int) -> int:
    """Write the knots between two fixed samples with a straight line between them."""
    start, end, h, g = samples.way[k], samples.way[k + 1], samples.apart[k], samples.apart[k + 1]
    length = end - start
    rests = k == 0 and seams[Seams.HEAD_APART] <= 0.0
    stops = k + 2 == count and seams[Seams.TAIL_APART] <= 0.0
    if rests or stops:  # there nothing turns
        if rests != stops and (g if rests else h) < (1.0 - SPARE) * length:
            knots[made] = end - g if rests else start + h
            return made + 1
        return made
    if min(h, g) >= (1.0 - SPARE) * length:
        return made
    if h + g < (1.0 - LITTLE) * length:
        knots[made], knots[made + 1] = start + h, end - g
        return made + 2
    # The closer one keeps its distance, if it does not take more than half of the line.
    if h <= g:
        knots[made] = start + min(h, max(0.5 * length, length - g))
    else:
        knots[made] = end - min(g, max(0.5 * length, length - h))
    return made + 1


def knots_on_curve(samples: Samples, first: int, last: int, knots: Floats, made: int) -> int:
    """Write the knots between two fixed samples along a curve; -1 where there is no room."""
    total = 0.0
    for k in range(first, last):
        total += intervals(samples, k)
    count = max(ceil(total - SPARE), 1)
    if made + count + 2 > len(knots):
        return -1
    done, k, j = 0.0, first, 1
    own = intervals(samples, first)
    while j < count:
        goal = total * j / count
        while done + own < goal and k < last - 1:
            done += own
            k += 1
            own = intervals(samples, k)
        knots[made] = way_after(samples, k, goal - done)
        made, j = made + 1, j + 1
    return made


def intervals(samples: Samples, k: int) -> float:
    """Number of intervals between a sample and the next, where their length changes evenly."""
    h, g, way = samples.apart[k], samples.apart[k + 1], samples.way[k + 1] - samples.way[k]
    if abs(g - h) <= 1e-3 * h:
        return 2.0 * way / (h + g)
    return way / (g - h) * log(g / h)


def way_after(samples: Samples, k: int, number: float) -> float:
    """The way at which a number of intervals behind a sample ends."""
    h, g, way = samples.apart[k], samples.apart[k + 1], samples.way[k + 1] - samples.way[k]
    start: float = samples.way[k]
    if abs(g - h) <= 1e-3 * h:
        return start + number * 0.5 * (h + g)
    rate = (g - h) / way
    return start + h * (exp(rate * number) - 1.0) / rate
