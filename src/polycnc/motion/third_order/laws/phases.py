"""From the speed at nodes to phases of constant jerk, and the sure proof that every axis keeps its limits on them.

Between two nodes lie two phases of equal time t. They bring the way Δs, the change of speed Δv and the change of
acceleration Δu exactly: `Δu/3·t² - (v + v')·t + Δs = 0`. There is such a t if Δu is at most `3/4·(v + v')²/Δs`:
so no node may have more than half of it. Where a law begins or ends in motion, the acceleration is given, and there
may be none. Beside rest one phase is enough: the way grows with the third power of time.

On a phase and a piece acceleration and jerk of an axis are polynomials in time. Linear between both ends they are wrong
by at most an eighth of their largest second derivative by time times the square of the time between; where this is
too coarse, the time is halved.
"""

from __future__ import annotations

from math import sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.third_order.laws.courses import Axes, Course, Nodes, Phase, Shape
from polycnc.motion.third_order.laws.stencils import value

#: Phases between two nodes.
PAIR = 2
#: How much acceleration a node may have, see above; part of the way to a node by which phases may miss it: rounding.
MEETS, APART = 0.375, 1e-6
#: How often the time is halved at most; what counts as kept without looking closer; how far above the values at both
#: ends a bound may be.
HALVINGS, KEPT, CLOSE_BY = 6, 1.0 + 1e-7, 0.002


def lay_phases(nodes: Nodes, phases: Floats, first: int, last: int) -> None:
    """Phases between two nodes, `PAIR` from each one to the next; one of them may last no time."""
    count = len(nodes.x)
    before = 0.0
    if first > 0:
        before, _ = _motion(nodes, first - 1)
    speed, pull = _motion(nodes, first)
    there, ahead = _motion(nodes, first + 1)
    if first > 0:
        pull = _within(nodes, first, before, speed, there, pull)
    for k in range(first, last):
        behind, slope, new = 0.0, 0.0, ahead
        if k + 2 < count:
            behind, slope = _motion(nodes, k + 2)
            new = _within(nodes, k + 1, speed, there, behind, ahead)
        _pair(nodes, k, speed, pull, there, new, phases)
        speed, pull, there, ahead = there, new, behind, slope


def leads_on(nodes: Nodes, phases: Floats, k: int) -> bool:
    """Whether the phases behind a node lead to the next one: from a motion beside a rest there may be none that do."""
    way = nodes.way[k]
    for at in range(PAIR * k * Phase.SIZE, PAIR * (k + 1) * Phase.SIZE, Phase.SIZE):
        way += gone(phases, at, phases[at + Phase.TIME])
    return abs(way - nodes.way[k + 1]) <= APART * (nodes.way[k + 1] - nodes.way[k])


def _motion(nodes: Nodes, k: int) -> tuple[float, float]:
    """Speed and acceleration of the spline at a node."""
    if nodes.x[k] <= 0.0:
        return 0.0, 0.0
    x, slope, _ = value(nodes, k)
    return sqrt(max(x, 1e-18)), 0.5 * slope


def _within(nodes: Nodes, k: int, before: float, speed: float, behind: float, pull: float) -> float:
    """An acceleration; no more than with which phases lead from the node before to this one and to the next."""
    if speed <= 0.0:
        return 0.0
    if before > 0.0:
        both = before + speed
        pull = min(pull, MEETS * both * both / (nodes.way[k] - nodes.way[k - 1]))
    if behind > 0.0:
        both = speed + behind
        pull = max(pull, -MEETS * both * both / (nodes.way[k + 1] - nodes.way[k]))
    return pull


def _pair(nodes: Nodes, k: int, speed: float, pull: float, there: float, new: float, phases: Floats) -> None:
    """The phases between a node and the next one."""
    way, step, at = nodes.way[k], nodes.way[k + 1] - nodes.way[k], PAIR * Phase.SIZE * k
    if speed == 0.0:
        time = 3.0 * step / there
        _set(phases, at, time, way, 0.0, 0.0, 2.0 * there / (time * time))
        _set(phases, at + Phase.SIZE, 0.0, nodes.way[k + 1], there, 2.0 * there / time, 0.0)
        return
    if there == 0.0:
        time = 3.0 * step / speed
        _set(phases, at, time, way, speed, -2.0 * speed / time, 2.0 * speed / (time * time))
        _set(phases, at + Phase.SIZE, 0.0, nodes.way[k + 1], 0.0, 0.0, 0.0)
        return
    both, more = speed + there, new - pull
    root = sqrt(max(both * both - 4.0 / 3.0 * more * step, 0.0))
    time = 2.0 * step / (both + root)
    middle = (2.0 * (there - speed) / time - pull - new) * 0.5
    first, second = (middle - pull) / time, (new - middle) / time
    _set(phases, at, time, way, speed, pull, first)
    gone = time * (speed + time * (0.5 * pull + time * first / 6.0))
    fast = speed + time * (pull + 0.5 * time * first)
    _set(phases, at + Phase.SIZE, time, way + gone, fast, middle, second)


def _set(phases: Floats, at: int, time: float, way: float, speed: float, pull: float, jerk: float) -> None:
    phases[at + Phase.TIME] = time
    phases[at + Phase.WAY] = way
    phases[at + Phase.SPEED] = speed
    phases[at + Phase.PULL] = pull
    phases[at + Phase.JERK] = jerk


def examine(
    course: Course, axes: Axes, nodes: Nodes, phases: Floats, most: Floats, first: int, last: int
) -> None:
    """The largest parts of speed, acceleration and jerk that are used on every phase.

    Args:
        course: The path.
        axes: Limits.
        nodes: With what they know of the path.
        phases: The law.
        most: For three numbers a phase: bounds of the parts used of the square of the speed, of acceleration and jerk;
            zero where it is plain that there are less than the limits.
        first: The node behind which to look.
        last: The node up to which.
    """
    p, high = 0, len(course.cap2)
    while high - p > 1:  # the piece of the first node
        middle = (p + high) // 2
        p, high = (middle, high) if course.way[middle] <= nodes.way[first] else (p, middle)
    for k in range(first, last):
        for i in range(3 * PAIR * k, 3 * PAIR * (k + 1)):
            most[i] = 0.0
        if not _plainly(axes, nodes, phases, k):
            for at in range(PAIR * k, PAIR * (k + 1)):
                p = _phase(course, axes, phases, at, most, p)


def _plainly(axes: Axes, nodes: Nodes, phases: Floats, k: int) -> bool:
    """Whether limits are kept from a node to the next even if the highest speed, acceleration and jerk come together.

    q'' and q''' are no larger than on the cells of both nodes.
    """
    at, n, count, s = PAIR * k * Phase.SIZE, len(axes.jerk), len(nodes.way), nodes.shape
    behind = at + Phase.SIZE
    time = max(phases[at + Phase.TIME], phases[behind + Phase.TIME])
    pull, pull2 = phases[at + Phase.PULL], phases[behind + Phase.PULL]
    jerk2, time2, speed2 = (
        phases[behind + Phase.JERK],
        phases[behind + Phase.TIME],
        phases[behind + Phase.SPEED],
    )
    jerk = max(abs(phases[at + Phase.JERK]), abs(jerk2))
    fast = max(phases[at + Phase.SPEED], speed2, speed2 + time2 * (pull2 + 0.5 * time2 * jerk2))
    fast += 0.125 * time * time * jerk
    hard = max(abs(pull), abs(pull2), abs(pull2 + time2 * jerk2))
    square, step = fast * fast, nodes.way[k + 1] - nodes.way[k]
    if square > min(nodes.cap2[k], nodes.cap2[k + 1]):
        return False
    for i in range(n):
        here = i * Shape.SIZE * count + k
        there = here + 1
        if s[here + Shape.MOVES * count] + s[there + Shape.MOVES * count] == 0.0:
            continue
        third = max(
            abs(s[here + Shape.THIRD * count]) + s[here + Shape.THIRD_RANGE * count],
            abs(s[there + Shape.THIRD * count]) + s[there + Shape.THIRD_RANGE * count],
        )
        bend = max(
            abs(s[here + Shape.SECOND * count]) + s[here + Shape.SECOND_RANGE * count],
            abs(s[there + Shape.SECOND * count]) + s[there + Shape.SECOND_RANGE * count],
        )  # half more than q''
        turn = max(abs(s[here + Shape.FIRST * count]), abs(s[there + Shape.FIRST * count]))
        turn = 2.0 * turn + 0.125 * step * step * third
        if turn * jerk + fast * (2.0 * bend * hard + third * square) > 1.0:
            return False
        if (turn * hard + 2.0 / 3.0 * bend * square) * axes.jerk[i] > axes.pull[i]:
            return False
    return True


def _phase(course: Course, axes: Axes, phases: Floats, k: int, most: Floats, p: int) -> int:
    """The parts that are used on a phase, which begins on the piece p or behind it; gives the piece of its end."""
    m, at = len(course.cap2), k * Phase.SIZE
    time, way = phases[at + Phase.TIME], phases[at + Phase.WAY]
    if time <= 0.0:
        return p
    there, now = way + gone(phases, at, time), 0.0
    while p < m - 1 and course.way[p + 1] <= way:
        p += 1
    while True:
        last = p >= m - 1 or course.way[p + 1] >= there
        until = time if last else reached(phases, at, now, course.way[p + 1])
        if not _keeps(course, axes, phases, at, p, now, until):
            _piece(course, axes, phases, at, p, now, until, most, 3 * k)
        if last:
            return p
        p, now = p + 1, until


def gone(phases: Floats, at: int, time: float) -> float:
    """The way gone in a phase after a time."""
    return time * (
        phases[at + Phase.SPEED]
        + time * (0.5 * phases[at + Phase.PULL] + time * phases[at + Phase.JERK] / 6.0)
    )


def reached(phases: Floats, at: int, now: float, way: float) -> float:
    """The time in a phase, after `now`, at which a place is reached."""
    low, high = now, phases[at + Phase.TIME]
    goal = way - phases[at + Phase.WAY]
    speed, pull, jerk = phases[at + Phase.SPEED], phases[at + Phase.PULL], phases[at + Phase.JERK]
    time = now
    for _ in range(40):
        off = time * (speed + time * (0.5 * pull + time * jerk / 6.0)) - goal
        if off > 0.0:
            high = time
        else:
            low = time
        fast = speed + time * (pull + 0.5 * time * jerk)
        step = off / fast if fast > 0.0 else 0.0
        new = time - step
        if not low < new < high or fast <= 0.0:
            new = 0.5 * (low + high)
        if abs(new - time) <= 1e-13 * high:
            return new
        time = new
    return time


def _piece(
    course: Course,
    axes: Axes,
    phases: Floats,
    at: int,
    p: int,
    now: float,
    until: float,
    most: Floats,
    to: int,
) -> None:
    """Raise the bounds by what a piece needs in a part of a phase."""
    whole = 1 << HALVINGS
    done, parts = 0, whole  # small parts of the time
    while done < whole:
        begin, end = now + (until - now) * (done / whole), now + (until - now) * ((done + parts) / whole)
        used = _used(course, axes, phases, at, p, begin, end)
        above = max(used[0] - used[3], used[1] - used[4], used[2] - used[5])
        if parts > 1 and above > CLOSE_BY and max(used[0], used[1], used[2]) > KEPT:
            parts //= 2
            continue
        most[to] = max(most[to], used[0])
        most[to + 1] = max(most[to + 1], used[1])
        most[to + 2] = max(most[to + 2], used[2])
        done += parts
        while parts < whole and done % (2 * parts) == 0:
            parts *= 2


def _keeps(course: Course, axes: Axes, phases: Floats, at: int, p: int, begin: float, end: float) -> bool:
    """Whether the bounds that `_used` finds are no higher than the limits."""
    n, time, ease = len(axes.jerk), end - begin, course.ease[p]
    start, jerk = phases[at + Phase.PULL], phases[at + Phase.JERK]
    pull, speed = start + begin * jerk, phases[at + Phase.SPEED] + begin * (start + 0.5 * begin * jerk)
    way = phases[at + Phase.WAY] + gone(phases, at, begin) - course.way[p]
    pull2, speed2 = pull + time * jerk, speed + time * (pull + 0.5 * time * jerk)
    way2 = way + time * (speed + time * (0.5 * pull + time * jerk / 6.0))
    hard, hardest, eighth = abs(jerk), max(abs(pull), abs(pull2)), 0.125 * time * time
    fast = max(speed, speed2) + eighth * hard
    if fast * fast > course.cap2[p]:
        return False
    square, square2, pulls = speed * speed, speed2 * speed2, hardest * hardest
    # what the largest q'' and q''' count for between the ends
    bent_a, twist_a = eighth * (4.0 * fast * hard + 3.0 * pulls), eighth * 6.0 * fast * fast * hardest
    bent_j, twist_j = eighth * 10.0 * hardest * hard, eighth * fast * (10.0 * fast * hard + 15.0 * pulls)
    for i in range(n):
        first, second, third = course.first[p * n + i], course.second[p * n + i], course.third[p * n + i]
        if first == 0.0 and second == 0.0 and third == 0.0:
            continue  # it stands still
        half = 0.5 * third
        bend, bend2 = second + third * way, second + third * way2
        turn, turn2 = first + way * (second + half * way), first + way2 * (second + half * way2)
        bent, twist = max(abs(bend), abs(bend2)), abs(third)
        used = max(abs(turn * pull + bend * square), abs(turn2 * pull2 + bend2 * square2))
        if used + bent_a * bent + twist_a * twist > ease * axes.pull[i]:
            return False
        used = max(
            abs(turn * jerk + speed * (3.0 * bend * pull + third * square)),
            abs(turn2 * jerk + speed2 * (3.0 * bend2 * pull2 + third * square2)),
        )
        if used + bent_j * bent + twist_j * twist > ease * axes.jerk[i]:
            return False
    return True


def _used(
    course: Course, axes: Axes, phases: Floats, at: int, p: int, begin: float, end: float
) -> tuple[float, float, float, float, float, float]:
    """Bounds of the parts used of x, acceleration and jerk, and how much of them is used at the ends."""
    n, time, top = len(axes.jerk), end - begin, 1.0 / course.cap2[p]
    jerk = phases[at + Phase.JERK]
    pull = phases[at + Phase.PULL] + begin * jerk
    speed = phases[at + Phase.SPEED] + begin * (phases[at + Phase.PULL] + 0.5 * begin * jerk)
    way = phases[at + Phase.WAY] + gone(phases, at, begin) - course.way[p]
    pull2, speed2 = pull + time * jerk, speed + time * (pull + 0.5 * time * jerk)
    way2 = way + time * (speed + time * (0.5 * pull + time * jerk / 6.0))
    hard = abs(jerk)
    most_pull, eighth = max(abs(pull), abs(pull2)), 0.125 * time * time
    fast, pulls = max(speed, speed2) + eighth * hard, most_pull * most_pull
    high, high_a = max(speed * speed, speed2 * speed2) * top, 0.0
    ease, high_j, bound_a, bound_j = course.ease[p], 0.0, 0.0, 0.0
    for i in range(n):
        first, second, third = course.first[p * n + i], course.second[p * n + i], course.third[p * n + i]
        if first == 0.0 and second == 0.0 and third == 0.0:
            continue  # it stands still
        bend, bend2 = second + third * way, second + third * way2
        turn, turn2 = first + way * (second + 0.5 * third * way), first + way2 * (second + 0.5 * third * way2)
        used = max(abs(turn * pull + bend * speed * speed), abs(turn2 * pull2 + bend2 * speed2 * speed2))
        bent, twist = max(abs(bend), abs(bend2)), abs(third)
        more = eighth * (
            4.0 * bent * fast * hard + 3.0 * bent * pulls + 6.0 * twist * fast * fast * most_pull
        )
        part = 1.0 / (ease * axes.pull[i])
        high_a, bound_a = max(high_a, used * part), max(bound_a, (used + more) * part)
        used = max(
            abs(turn * jerk + speed * (3.0 * bend * pull + third * speed * speed)),
            abs(turn2 * jerk + speed2 * (3.0 * bend2 * pull2 + third * speed2 * speed2)),
        )
        more = eighth * (twist * fast * (10.0 * fast * hard + 15.0 * pulls) + 10.0 * bent * most_pull * hard)
        part = 1.0 / (ease * axes.jerk[i])
        high_j, bound_j = max(high_j, used * part), max(bound_j, (used + more) * part)
    return fast * fast * top, bound_a, bound_j, high, high_a, high_j
