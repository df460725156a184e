"""The law of a path: nodes, Newton's method, phases, proof; where a limit is not kept, again with less room there."""

from __future__ import annotations

from math import sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.third_order.laws.courses import Axes, Course, Ends, Known, Nodes, Phase, Work
from polycnc.motion.third_order.laws.grid import cut, estimate, gather, spread
from polycnc.motion.third_order.laws.newton import begin, improve
from polycnc.motion.third_order.laws.phases import PAIR, examine, lay_phases, leads_on
from polycnc.motion.third_order.laws.stencils import lay_stencils

#: Weights of the barriers in each pass, and in those of repairs, which shall not use up what is left.
WEIGHTS, REPAIRING = (0.1, 0.06, 0.04, 0.04), 0.06
#: A law at fewer nodes than this, as that of a single row, costs little: weights of further passes, and of repairs.
FEW, FINE, FINEST = 64, (0.03, 0.03, 0.02, 0.02), 0.02
#: The part of the estimate that the first pass begins with: jerk leaves less of it than acceleration.
SHARE = 0.4
#: Rounds of repairs at most, passes in each, and nodes around a place that go along; so many rounds later one pass more
#: and once more as many nodes.
ROUNDS, PASSES, AROUND, LATER = 30, 1, 5, 3
#: By what part the excess counts more in every round.
RISING = 0.001
#: What counts as kept; beyond `FAR` x is not found yet, so the first `TRUST` rounds take no room away there.
KEPT, FAR, TRUST = 1.0 + 4e-7, 1.2, 6
#: By how many times the excess room is taken away, and how much more of it: few large steps; the same where there are
#: few nodes; how much at most.
STRONGER, MORE = 2.0, 0.02
AS_STRONG, LITTLE = 1.0, 0.003
MOST = 1.5


def place_nodes(
    course: Course,
    axes: Axes,
    ends: Floats,
    places: Floats,
    squares: Floats,
    gaps: Floats,
    seconds: Floats,
    nodes: Floats,
) -> int:
    """Estimate a law and spread nodes over the path; see `cut` and `spread`. Gives their number; minus it without room.

    Args:
        course: The path; its estimate is made.
        axes: Limits.
        ends: Speed and acceleration at both ends, see `Ends`.
        places: For 3·m + 2 numbers: the way at places of the estimate; the last number is their count.
        squares: For as many: the square of the speed there.
        gaps: For as many: the distance of nodes there.
        seconds: For as many: the time from there to the next one.
        nodes: For the way at the nodes.
    """
    estimate(course, axes, ends, len(course.cap2))
    count = cut(course, axes, places, squares, gaps)
    places[len(places) - 1] = float(count)
    return spread(axes, count, places, squares, gaps, seconds, nodes)


def find_law(
    course: Course,
    axes: Axes,
    ends: Floats,
    places: Floats,
    squares: Floats,
    nodes: Nodes,
    known: Known,
    work: Work,
    phases: Floats,
    most: Floats,
) -> int:
    """Find the quickest law at nodes, as phases of constant jerk; gives the rounds of repairs that it took.

    Where after all rounds a limit is exceeded still, a law from rest to rest is stretched in time as a whole, which
    keeps it for sure; from or to a motion there is none, and -1 is given. So it is where no phases lead from that
    motion to the node behind it, or to the other one from the node before it.

    Args:
        course: The path, as `place_nodes` left it.
        axes: Limits.
        ends: Speed and acceleration at both ends, see `Ends`.
        places: As there.
        squares: As there.
        nodes: k nodes with their ways.
        known: The first of them, where another law leads so far, or none.
        work: Room.
        phases: The law: `PAIR` phases between two nodes.
        most: For three numbers a phase, see `examine`.
    """
    last = len(nodes.way) - 1
    gather(course, axes, nodes, work.moves)
    begin(places, squares, int(places[len(places) - 1]), nodes, axes, ends, SHARE)
    for k in range(1, len(known.way)):
        nodes.x[k], nodes.cap2[k], nodes.room[k] = known.x[k], known.cap2[k], known.room[k]
    lay_stencils(nodes, ends)
    for weight in WEIGHTS:
        improve(nodes, axes, work, weight, 0, last)
    few = last < FEW
    if few:
        for weight in FINE:
            improve(nodes, axes, work, weight, 0, last)
    lay_phases(nodes, phases, 0, last)
    examine(course, axes, nodes, phases, most, 0, last)
    rounds = 0
    while rounds < ROUNDS and _repair(course, axes, nodes, work, phases, most, rounds, few):
        rounds += 1
    if rounds == ROUNDS and _worst(most, PAIR * last) > KEPT:
        if ends[Ends.START_SPEED] > 0.0 or ends[Ends.END_SPEED] > 0.0:
            return -1
        _stretch(phases, most)
    if not (leads_on(nodes, phases, 0) and leads_on(nodes, phases, last - 1)):
        return -1
    return rounds


def _worst(most: Floats, count: int) -> float:
    """The largest part of any limit that is used on so many phases."""
    high = 0.0
    for k in range(3 * count):
        high = max(high, most[k])
    return high


def _over(most: Floats, k: int) -> float:
    """The largest part of any limit that is used between two nodes."""
    high = 0.0
    for i in range(3 * PAIR * k, 3 * PAIR * (k + 1)):
        high = max(high, most[i])
    return high


def _repair(
    course: Course,
    axes: Axes,
    nodes: Nodes,
    work: Work,
    phases: Floats,
    most: Floats,
    rounds: int,
    few: bool,
) -> bool:
    """Take room away around every place where a limit is exceeded, look for x anew there; says whether one was."""
    last, k, any_ = len(nodes.way) - 1, 0, False
    around = AROUND * (1 + rounds // LATER)
    while k < last:
        over = _over(most, k)
        if over <= KEPT:
            k += 1
            continue
        any_, first, end = True, max(k - around, 0), k
        while k < min(end + 2 * around, last):
            over = _over(most, k)
            if over > KEPT:
                end = k
                if rounds >= TRUST or over < FAR:
                    _lower(nodes, most, k, over * (1.0 + RISING * rounds), few)
            k += 1
        k = end = min(end + 1 + around, last)
        for _ in range(PASSES + rounds // LATER):
            improve(nodes, axes, work, FINEST if few else REPAIRING, first, end)
        # the acceleration of a node depends on two on either side
        first, end = max(first - 2, 0), min(end + 2, last)
        lay_phases(nodes, phases, first, end)
        examine(course, axes, nodes, phases, most, first, end)
    return any_


def _lower(nodes: Nodes, most: Floats, k: int, over: float, few: bool) -> None:
    """Take room away at the nodes on both sides of phases that exceed a limit."""
    speed = 0.0
    for i in range(PAIR):
        speed = max(speed, most[3 * (PAIR * k + i)])
    less = 1.0 + (AS_STRONG * (over - 1.0) + LITTLE if few else STRONGER * (over - 1.0) + MORE)
    less = min(less, MOST)
    for q in (k, k + 1):
        if speed > KEPT:
            nodes.cap2[q] /= min(speed + LITTLE, MOST)
        elif nodes.x[k] == 0.0 or nodes.x[k + 1] == 0.0:
            nodes.cap2[q] /= less ** (2.0 / 3.0)
        else:
            nodes.room[q] /= less


def _stretch(phases: Floats, most: Floats) -> None:
    """Make a law so much slower as a whole that all limits are kept."""
    slower = 1.0
    for k in range(len(phases) // Phase.SIZE):
        slower = max(slower, sqrt(max(most[3 * k], most[3 * k + 1])), most[3 * k + 2] ** (1.0 / 3.0))
    if slower <= 1.0:
        return
    square = slower * slower
    for k in range(len(phases) // Phase.SIZE):
        phases[k * Phase.SIZE + Phase.TIME] *= slower
        phases[k * Phase.SIZE + Phase.SPEED] /= slower
        phases[k * Phase.SIZE + Phase.PULL] /= square
        phases[k * Phase.SIZE + Phase.JERK] /= square * slower
    for k in range(len(phases) // Phase.SIZE):
        most[3 * k] /= square
        most[3 * k + 1] /= square
        most[3 * k + 2] /= square * slower
