"""A law in parts: a stretch of it cut out at ways, and how far ahead of a place it must look."""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.third_order.laws.courses import Axes, Course, Ends, Phase
from polycnc.motion.third_order.laws.grid import estimate, own_cap
from polycnc.motion.third_order.laws.phases import gone, reached

#: Pieces that are looked at first, for few are enough as a rule; by how many times more then.
NEAR, FURTHER = 64, 4


def look_ahead(course: Course, axes: Axes, ends: Floats, seconds: float, told: Floats) -> int:
    """The pieces of a path that take so many seconds by the estimate, as quickly as it can be entered and left.

    Args:
        course: The path; its estimate is made as far as is looked.
        axes: Limits.
        ends: Room for `Ends`.
        seconds: How long it shall take.
        told: Set to the seconds that are left behind the whole path.

    Returns:
        Their number, -1 where all of them take less.
    """
    last, reach = len(course.cap2) - 1, min(NEAR, len(course.cap2))
    ends[Ends.START_PULL] = ends[Ends.END_PULL] = 0.0
    ends[Ends.START_SPEED] = sqrt(own_cap(course, axes, 0))
    while True:
        ends[Ends.END_SPEED] = sqrt(own_cap(course, axes, reach - 1))
        estimate(course, axes, ends, reach)
        told[0] = seconds
        for k in range(reach):
            told[0] -= 2.0 * (course.way[k + 1] - course.way[k]) / (sqrt(course.x[k]) + sqrt(course.x[k + 1]))
            if told[0] <= 0.0:
                return k + 1
        if reach > last:
            return -1
        reach = min(FURTHER * reach, last + 1)


def cut_law(phases: Floats, begin: float, end: float, origin: float, out: Floats, found: int) -> int:
    """Cut phases out of a law, exactly.

    Args:
        phases: The law.
        begin: The way from which on.
        end: The way up to which; endless up to its end.
        origin: The way from which those of the phases cut out are counted.
        out: For as many phases more.
        found: Phases that it has already.

    Returns:
        Number of all its phases.
    """
    count = len(phases) // Phase.SIZE
    for k in range(count):
        at, to = k * Phase.SIZE, found * Phase.SIZE
        way, until, first = phases[at + Phase.WAY], phases[at + Phase.TIME], 0.0
        behind = phases[at + Phase.SIZE + Phase.WAY] if k + 1 < count else inf
        if until <= 0.0 or way >= end or behind <= begin:
            continue
        if begin <= way and behind <= end:  # whole, as nearly all are
            out[to + Phase.TIME], out[to + Phase.WAY] = until, way - origin
            for i in range(Phase.SPEED, Phase.SIZE):
                out[to + i] = phases[at + i]
            found += 1
            continue
        if way < begin:
            first = reached(phases, at, 0.0, begin)
        if behind > end:
            until = reached(phases, at, 0.0, end)
        if until <= first:
            continue
        speed, pull, jerk = phases[at + Phase.SPEED], phases[at + Phase.PULL], phases[at + Phase.JERK]
        out[to + Phase.TIME] = until - first
        out[to + Phase.WAY] = way + gone(phases, at, first) - origin
        out[to + Phase.SPEED] = speed + first * (pull + 0.5 * first * jerk)
        out[to + Phase.PULL] = pull + first * jerk
        out[to + Phase.JERK] = jerk
        found += 1
    return found
