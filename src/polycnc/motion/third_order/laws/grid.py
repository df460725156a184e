"""Where the speed along a path is looked for: nodes, close together in time where the acceleration changes.

An estimate of second order (limits of acceleration, jerk only by what q''' needs at a steady speed) says when a place
is passed and how much the acceleration changes there. From each place the distance of nodes may grow by a part of the
time that lies between: so nodes are sparse where the speed is steady.
"""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.third_order.laws.courses import Axes, Course, Ends, Nodes, Shape

#: Distance of nodes where the acceleration changes, in parts of the time that an axis takes to build it up.
CLOSE = 0.1
#: What the distance grows by with time, less where a short law has closer nodes; the part of the acceleration whose
#: change wants the closest nodes; what q' may change by from node to node.
GROWTH, CHANGE, TURN = 0.12, 0.15, 0.25
#: A node moves to a knot that lies within this part of the distance: there q''' steps.
SNAP = 0.45
#: Behind nodes that are known the first other one is apart by this part of the last distance at least.
APART = 0.7
#: Nodes at least.
FEWEST = 32
#: Parts of a piece of no account, in parts of the ways on which the speed changes: nanometres at a slow feed.
LITTLE = 1e-3
#: Pull along the path that is taken to be left at least, as a part of the smallest acceleration.
LEFT = 0.02


def estimate(course: Course, axes: Axes, ends: Floats, m: int) -> None:
    """Caps of the first m pieces, and the estimate of second order at their knots."""
    for k in range(m):
        course.low2[k] = own_cap(course, axes, k)
    course.x[0] = ends[Ends.START_SPEED] * ends[Ends.START_SPEED]
    course.x[m] = ends[Ends.END_SPEED] * ends[Ends.END_SPEED]
    for k in range(1, m):
        course.x[k] = min(course.low2[k - 1], course.low2[k])
    for k in range(m - 1, 0, -1):
        most = course.x[k + 1] + 2.0 * (course.way[k + 1] - course.way[k]) * pull_at(
            course, axes, k + 1, -1.0
        )
        course.x[k] = min(course.x[k], most)
    for k in range(1, m):
        most = course.x[k - 1] + 2.0 * (course.way[k] - course.way[k - 1]) * pull_at(course, axes, k - 1, 1.0)
        course.x[k] = min(course.x[k], most)


def own_cap(course: Course, axes: Axes, k: int) -> float:
    """Bound a piece by the highest speeds of its axes; gives what q'' and q''' bound it by, too."""
    n, step = len(axes.jerk), course.way[k + 1] - course.way[k]
    speed = bend = twist = 0.0
    for i in range(n):
        here, there = course.second[k * n + i], course.second[k * n + n + i]
        own = (there - here) / step
        third = abs(own)
        course.third[k * n + i] = own
        first = (
            max(abs(course.first[k * n + i]), abs(course.first[k * n + n + i])) + 0.125 * third * step * step
        )
        speed = max(speed, first / axes.speed[i])
        bend = max(bend, max(abs(here), abs(there)) / (course.ease[k] * axes.pull[i]))
        twist = max(twist, third / (course.ease[k] * axes.jerk[i]))
    cap = course.cap2[k]
    if cap * speed * speed > 1.0:
        cap = course.cap2[k] = 1.0 / (speed * speed)
    if cap * bend > 1.0:
        cap = 1.0 / bend
    if twist * twist * cap * cap * cap > 1.0:
        cap = (1.0 / twist) ** (2.0 / 3.0)
    return cap


def pull_at(course: Course, axes: Axes, k: int, sign: float) -> float:
    """Acceleration along the path in one direction that the axes have left at a knot, at the speed there."""
    n, x, last = len(axes.pull), course.x[k], len(course.ease) - 1
    left, least, ease = inf, inf, min(course.ease[max(k - 1, 0)], course.ease[min(k, last)])
    for i in range(n):
        first, used = sign * course.first[k * n + i], course.second[k * n + i] * x
        if first < 0.0:
            first, used = -first, -used
        if first > 1e-9:
            left = min(left, (ease * axes.pull[i] - used) / first)
            least = min(least, ease * axes.pull[i] / first)
    return max(left, LEFT * least)


def cut(course: Course, axes: Axes, places: Floats, squares: Floats, gaps: Floats) -> int:
    """Cut every piece where the estimate begins or ends to accelerate; gives the number of places found.

    Args:
        course: The path with its estimate.
        axes: Their limits.
        places: The way at the places, for 3·m + 1 of them.
        squares: The square of the speed there.
        gaps: Largest distance of nodes there by the turn of the path, s.
    """
    n, m = len(axes.pull), len(course.cap2)
    places[0], squares[0], gaps[0] = course.way[0], course.x[0], inf
    count = 1
    for k in range(m):
        begin, end, bend = course.way[k], course.way[k + 1], 1e-9
        for i in range(n):
            bend = max(bend, abs(course.second[k * n + i]), abs(course.second[k * n + n + i]))
        here, there, cap = course.x[k], course.x[k + 1], course.low2[k]
        if cap > min(here, there):
            up, down = 2.0 * pull_at(course, axes, k, 1.0), 2.0 * pull_at(course, axes, k + 1, -1.0)
            rise, fall = (cap - here) / up, (cap - there) / down
            if rise + fall > end - begin:  # it gets not so fast
                rise = max(0.0, (there - here + down * (end - begin)) / (up + down))
                fall = end - begin - rise
                cap = here + up * rise
            least = LITTLE * (rise + fall)
            for place in (begin + rise, end - fall):
                if places[count - 1] + least < place < end - least:
                    places[count], squares[count], gaps[count] = place, cap, TURN / bend / sqrt(cap)
                    count += 1
        places[count], squares[count], gaps[count] = end, there, TURN / bend / max(sqrt(there), 1e-9)
        count += 1
    return count


def spread(
    axes: Axes, count: int, places: Floats, squares: Floats, gaps: Floats, seconds: Floats, nodes: Floats
) -> int:
    """Spread nodes over a path; gives their number.

    Args:
        axes: Limits.
        count: Number of places that `cut` found.
        places: The way at them.
        squares: The square of the speed there.
        gaps: Their distances by the turn of the path; become the distances of nodes there.
        seconds: Set to the time from each to the next one.
        nodes: The way at the nodes, if there is room; the number is right in any case.
    """
    build = pull = 0.0
    for i in range(len(axes.jerk)):
        build = max(build, axes.pull[i] / axes.jerk[i])
        pull = max(pull, axes.pull[i])
    whole = 0.0
    for k in range(count - 1):
        seconds[k] = _seconds(places, squares, k)
        whole += seconds[k]
    close = min(CLOSE * build, whole / FEWEST)
    growth = GROWTH * close / (CLOSE * build)
    before, gap = 0.0, inf
    for k in range(count):
        behind = 0.5 * (squares[k + 1] - squares[k]) / (places[k + 1] - places[k]) if k < count - 1 else 0.0
        change = abs(behind - before) / (CHANGE * pull)
        own = min(gaps[k], close / min(1.0, max(change, 1e-3)))
        if k > 0:
            gap += growth * seconds[k - 1]
        gap = min(own, gap)
        gaps[k] = gap
        before = behind
    for k in range(count - 2, -1, -1):
        gaps[k] = min(gaps[k], gaps[k + 1] + growth * seconds[k])
    return _walk(count, growth, places, squares, gaps, seconds, nodes)


def _walk(
    count: int,
    growth: float,
    places: Floats,
    squares: Floats,
    gaps: Floats,
    seconds: Floats,
    nodes: Floats,
) -> int:
    """Set nodes one after another, each as far from the one before as the gap there says."""
    nodes[0] = places[0]
    number, passed, gap = 1, 0.0, gaps[0]  # `passed` since the last node
    for k in range(count - 1):
        time, at = seconds[k], 0.0
        speed = sqrt(squares[k])
        pull = 0.5 * (squares[k + 1] - squares[k]) / (places[k + 1] - places[k])
        while passed + time - at >= gap * (1.0 + SNAP):
            at += gap - passed
            passed = 0.0
            if number < len(nodes):
                nodes[number] = min(max(places[k] + at * (speed + 0.5 * at * pull), places[k]), places[k + 1])
            number += 1
            gap = min(gaps[k] + growth * at, gaps[k + 1] + growth * (time - at))
        passed += time - at
        # to a knot that the next node would lie near, where knots are no closer than nodes
        if k < count - 2 and passed >= (1.0 - SNAP) * gap and 2.0 * time > gap:
            if number < len(nodes):
                nodes[number] = places[k + 1]
            number += 1
            passed, gap = 0.0, gaps[k + 1]
    if passed < 0.5 * gap and number > 2:
        number -= 1
    if number < len(nodes):
        nodes[number] = places[count - 1]
    return number + 1


def merge(known: Floats, spread_: Floats, count: int, nodes: Floats) -> int:
    """Put nodes that are known before those of a path that lie behind them; gives their number."""
    number = len(known)
    for k in range(number):
        nodes[k] = known[k]
    k, last = 0, known[number - 1]
    gap = APART * (last - known[number - 2])
    while k < count - 1 and spread_[k] < last + gap:
        k += 1
    for j in range(k, count):
        nodes[number] = spread_[j]
        number += 1
    return number


def _seconds(places: Floats, squares: Floats, k: int) -> float:
    """Time from one place to the next under constant acceleration."""
    return 2.0 * (places[k + 1] - places[k]) / max(sqrt(squares[k]) + sqrt(squares[k + 1]), 1e-6)


def gather(course: Course, axes: Axes, nodes: Nodes, moves: Floats) -> None:
    """What every node knows of the pieces on its cell; sets which axes move anywhere."""
    n, m, count = len(axes.jerk), len(course.cap2), len(nodes.way)
    for i in range(n):
        moves[i] = 1.0 if _moves(course, n, i) else 0.0
        for at in range(i * Shape.SIZE * count, (i + 1) * Shape.SIZE * count if moves[i] == 0.0 else 0):
            nodes.shape[at] = 0.0
    low = at = 0
    begin = nodes.way[0]
    for k in range(count):
        way = nodes.way[k]
        end = 0.5 * (way + nodes.way[min(k + 1, count - 1)])
        while low < m - 1 and course.way[low + 1] <= begin:
            low += 1
        at = max(at, low)
        while at < m - 1 and course.way[at + 1] <= way:
            at += 1
        high, cap, ease = low, course.cap2[low], course.ease[low]
        while high < m - 1 and course.way[high + 1] < end:
            high += 1
            cap, ease = min(cap, course.cap2[high]), min(ease, course.ease[high])
        nodes.cap2[k], nodes.room[k] = cap, 1.0
        for i in range(n):
            if moves[i] > 0.0:
                part, to = 0.5 / (ease * axes.jerk[i]), i * Shape.SIZE * count + k
                _gather_axis(course, nodes, n, i, low, high, at, begin, way, end, part, to)
        begin = end


def _moves(course: Course, n: int, i: int) -> bool:
    """Whether an axis moves anywhere."""
    for at in range(i, len(course.first), n):  # noqa: SIM110 - kernels have no generators
        if course.first[at] != 0.0 or course.second[at] != 0.0:
            return True
    return False


def _gather_axis(
    course: Course,
    nodes: Nodes,
    n: int,
    i: int,
    low: int,
    high: int,
    at: int,
    begin: float,
    way: float,
    end: float,
    part: float,
    to: int,
) -> None:
    """What a node on the piece `at` knows of an axis on its cell, from the piece `low` to `high`."""
    step = way - course.way[at]
    at = at * n + i
    first = course.first[at] + step * (course.second[at] + 0.5 * step * course.third[at])
    bend_low = third_low = inf
    bend_high = third_high = -inf
    for p in range(low, high + 1):
        here, third, start = course.second[p * n + i], course.third[p * n + i], course.way[p]
        left = here + third * max(begin - start, 0.0)
        right = here + third * (min(end, course.way[p + 1]) - start)
        third_low, third_high = min(third_low, third), max(third_high, third)
        bend_low, bend_high = min(bend_low, left, right), max(bend_high, left, right)
    s, count = nodes.shape, len(nodes.way)
    s[to + Shape.FIRST * count] = first * part
    s[to + Shape.SECOND * count] = 1.5 * (bend_high + bend_low) * part
    s[to + Shape.SECOND_RANGE * count] = 1.5 * (bend_high - bend_low) * part
    s[to + Shape.THIRD * count] = (third_high + third_low) * part
    s[to + Shape.THIRD_RANGE * count] = (third_high - third_low) * part
    moves = first != 0.0 or bend_low != 0.0 or bend_high != 0.0 or third_high > third_low
    s[to + Shape.MOVES * count] = 1.0 if moves else 0.0
