"""From a way of the tool's direction to one of the rotary axes: knots between which they go evenly.

The solution that is nearest to the last one is followed step by step, so the axes never leap. Near a pole one of them
would have to turn ever faster; within a cone about it the axes go evenly from where the way enters it to where it
leaves it, and the direction is as near to the wanted one as the cone is narrow. Where axes are not quite square, no
position stands the tool along the directions next to the pole: the cone covers those as well. The tip is led by the
linear axes all the way: it does not notice.
"""

from __future__ import annotations

from itertools import pairwise
from math import ceil, dist, radians, sqrt
from operator import sub

from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.transformation.orientation.choice import nearest
from polycnc.transformation.orientation.directions import angle_between
from polycnc.transformation.orientation.solutions import pole_angle, solutions_for

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.machine.kinematics import Angles, Kinematics
    from polycnc.transformation.orientation.directions import Way

#: The direction is looked at after so much of a turn; nearer than NEAR to a pole more often, by down to CLOSEST.
STEP, NEAR_DEG, CLOSEST = radians(1.5), 8.0, 0.1
#: Between two knots the direction is as near as this to the wanted one.
TOLERANCE = radians(0.02)
#: Shares that differ by less are the same.
SAME_SHARE = 1e-9
#: Where a turn at both ends of a move is parted.
HALF = 0.5
#: From step to step of a smooth turn the pace changes by less than this part of the largest pace.
LEAP = 0.5
#: Places at which the length of a way is looked at; steps of the search for the edge of a pole's cone.
LOOKS, SEARCH = 16, 24


@dataclass(frozen=True, slots=True)
class Course:
    """On which part of a move the tool turns, where it does not turn all along.

    Attributes:
        degrees: How far it turns.
        rate: How far it turns along a millimetre of the way at most.
        both_ends: One half of it turns at the start of the move and the other one at its end; else all at the start.
    """

    degrees: float
    rate: float
    both_ends: bool


@dataclass(frozen=True, slots=True)
class Turning:
    """How rotary axes go along a move: evenly from knot to knot.

    Attributes:
        columns: Columns of the axes.
        shares: Share of the move at each knot, the last one 1.
        places: Positions of the axes at each knot.
        course: On which part of the move they turn; None for all of it.
    """

    columns: tuple[int, ...]
    shares: tuple[float, ...]
    places: tuple[tuple[float, ...], ...]
    course: Course | None = None

    def paced(self, start: Sequence[float], length_mm: float) -> Turning:
        """The same turn by its course, on a move of a length; `start` are the positions in front of it.

        A move too short for the rate turns the tool all along.
        """
        course = self.course
        part = 1.0 if course is None else course.degrees / (course.rate * length_mm)
        if course is None or part >= 1.0 - SAME_SHARE:
            return replace(self, course=None)
        if not course.both_ends:
            shares, places = tuple(part * share for share in self.shares), self.places
            return Turning(self.columns, (*shares, 1.0), (*places, places[-1]))
        middle = self.at(start, HALF)
        early = [(part * s, p) for s, p in zip(self.shares, self.places, strict=True) if s < HALF]
        late = [
            (1.0 - part * (1.0 - s), p) for s, p in zip(self.shares, self.places, strict=True) if s > HALF
        ]
        knots = [*early, (part * HALF, middle), (1.0 - part * HALF, middle), *late]
        return Turning(self.columns, tuple(share for share, _ in knots), tuple(place for _, place in knots))

    def at(self, start: Sequence[float], share: float) -> tuple[float, ...]:
        """Positions after a share of the turn; `start` are those in front of it."""
        before, places = 0.0, tuple(start)
        for after, ahead in zip(self.shares, self.places, strict=True):
            if share <= after:
                part = (share - before) / (after - before)
                return tuple(a + (b - a) * part for a, b in zip(places, ahead, strict=True))
            before, places = after, ahead
        return places

    def part(self, start: Sequence[float], first: float, last: float) -> Turning:
        """The turn on a part of the move, once it has no course; `start` are the positions in front of the move."""
        width = last - first
        inner = [(s, p) for s, p in zip(self.shares, self.places, strict=True) if first < s < last]
        shares = (*((share - first) / width for share, _ in inner), 1.0)
        return Turning(self.columns, shares, (*(places for _, places in inner), self.at(start, last)))

    def is_smooth(self, start: Sequence[float]) -> bool:
        """Whether the steps are chords of a smooth curve: the pace of no axis leaps, as it does at a pole and its cone.

        What has a course keeps its rate.
        """
        if self.course is not None or len(self.shares) == 1:
            return False
        widths = map(sub, self.shares, (0.0, *self.shares))
        paces = [
            [(b - a) / width for a, b in zip(before, after, strict=True)]
            for before, after, width in zip((start, *self.places), self.places, widths, strict=False)
        ]
        return all(
            max(map(abs, map(sub, two, one))) <= LEAP * max(map(abs, (*one, *two)))
            for one, two in pairwise(paces)
        )

    def finer(self, start: Sequence[float], most_deg: float) -> Turning:
        """The same knots on a smooth curve, and so many between them that no axis turns by more in one step."""
        if len(self.shares) == 1:
            return self
        shares, before, first = list[float](), tuple(start), 0.0
        for last, places in zip(self.shares, self.places, strict=True):
            turned = max(abs(b - a) for a, b in zip(before, places, strict=True))
            parts = max(ceil(turned / most_deg), 1)
            shares += (first + (last - first) * k / parts for k in range(1, parts))
            shares.append(last)
            before, first = places, last
        curve = self.smoothed(start)
        return Turning(self.columns, tuple(shares), tuple(curve.at(start, share) for share in shares))

    def smoothed(self, start: Sequence[float]) -> Turning:
        """The same knots on a smooth curve, for a move that becomes chords; `start` are the positions in front of it.

        What has a course keeps its rate.
        """
        if self.course is not None or len(self.shares) == 1:
            return self
        ways = zip(start, *self.places, strict=True)
        slopes = tuple(_slopes((0.0, *self.shares), way) for way in ways)
        return SmoothTurning(self.columns, self.shares, self.places, None, slopes)


@dataclass(frozen=True, slots=True)
class SmoothTurning(Turning):
    """A turn whose knots lie on a smooth curve that goes neither back nor beyond them.

    Between knots lie cubics with the slopes of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5, 1984).

    Attributes:
        slopes: Of each axis by the share of the move: at its start and at each knot.
    """

    slopes: tuple[tuple[float, ...], ...] = ()

    def at(self, start: Sequence[float], share: float) -> tuple[float, ...]:
        """Positions after a share of the turn; `start` are those in front of it."""
        k = next((k for k, knot in enumerate(self.shares) if share <= knot), len(self.shares) - 1)
        before, first = (self.places[k - 1], self.shares[k - 1]) if k else (start, 0.0)
        width = self.shares[k] - first
        t = (share - first) / width
        return tuple(
            (1.0 + 2.0 * t) * (1.0 - t) ** 2 * a
            + t * t * (3.0 - 2.0 * t) * b
            + t * (1.0 - t) * width * ((1.0 - t) * slopes[k] - t * slopes[k + 1])
            for a, b, slopes in zip(before, self.places[k], self.slopes, strict=True)
        )


def _slopes(shares: Sequence[float], places: Sequence[float]) -> tuple[float, ...]:
    """Slopes at places by their shares: between slopes of one sign their weighted harmonic mean, else none."""
    widths = [b - a for a, b in pairwise(shares)]
    rises = [(b - a) / width for (a, b), width in zip(pairwise(places), widths, strict=True)]
    inner = []
    for (p, q), (a, b) in zip(pairwise(widths), pairwise(rises), strict=True):
        one, two = p + 2.0 * q, 2.0 * p + q
        inner.append((one + two) / (two / a + one / b) if a * b > 0.0 else 0.0)
    return (
        _end_slope(widths[0], widths[1], rises[0], rises[1]),
        *inner,
        _end_slope(widths[-1], widths[-2], rises[-1], rises[-2]),
    )


def _end_slope(width: float, next_width: float, rise: float, next_rise: float) -> float:
    """The slope at an end of a curve: that of the parabola there, as far as it does not go back or beyond."""
    slope = ((2.0 * width + next_width) * rise - width * next_rise) / (width + next_width)
    if slope * rise <= 0.0:
        return 0.0
    return 3.0 * rise if rise * next_rise <= 0.0 and abs(slope) > 3.0 * abs(rise) else slope


@dataclass(frozen=True, slots=True)
class Knot:
    """Angles of the rotary axes after a share of a way."""

    share: float
    angles: dict[str, float]


def follow(
    kinematics: Kinematics, way: Way, start: Angles, reaches: Callable[[Angles], bool], cone_deg: float
) -> list[Knot] | None:
    """The knots of a way behind its start; None where the axes cannot follow it.

    Directions that no position reaches are passed over where the tool stays as near to them as it does within a cone.

    Args:
        kinematics: The rotary joints.
        way: Directions of the tool on the work.
        start: Angles at its start, degrees by axis.
        reaches: Whether the axes can stand at some angles.
        cone_deg: Half the opening of the cones about poles.
    """
    joints = kinematics.axes
    steps = [Knot(0.0, {axis: start.get(axis, 0.0) for axis in joints})]

    def solve(share: float) -> Knot | None:
        found = [s for s in solutions_for(kinematics, way(share), steps[-1].angles) if reaches(s)]
        angles = nearest(found, steps[-1].angles)
        return None if angles is None else Knot(share, angles)

    def is_inside(knot: Knot | None) -> bool:
        return knot is None or pole_angle(kinematics, knot.angles) < cone_deg

    length, bend, edges, passed = _length(way), _step_of_bend(way), [0], list[float]()
    share, inside = 0.0, is_inside(steps[0])
    while share < 1.0:
        near = pole_angle(kinematics, steps[-1].angles) / NEAR_DEG
        ahead = STEP * min(max(near, CLOSEST), 1.0) / length if length > STEP * CLOSEST else 1.0
        ahead = min(ahead, bend)
        share = min(1.0, share + ahead)
        share = 1.0 if share > 1.0 - 1e-9 else share
        knot = solve(share)
        was_inside, inside = inside, is_inside(knot)
        if inside != was_inside:
            edge = _edge((max(share - ahead, 0.0), share), solve, is_inside, leaves=was_inside)
            if edge is not None:
                edges.append(len(steps))
                steps.append(edge)
                knot = solve(share) or knot
        if knot is None:
            passed.append(share)
        elif not inside or share == 1.0:
            steps.append(knot)
    if steps[-1].share < 1.0:
        return None
    for share in passed:
        k = next(k for k, step in enumerate(steps) if step.share > share)
        if _off(kinematics, way, steps[k - 1], steps[k], Knot(share, {})) > 2.0 * radians(cone_deg):
            return None
    return _fewer(kinematics, way, steps, [*edges, len(steps) - 1])


def _length(way: Way) -> float:
    """How far the direction turns along a way, radians."""
    looks = [way(k / LOOKS) for k in range(LOOKS + 1)]
    return sum(angle_between(a, b) for a, b in pairwise(looks))


def _step_of_bend(way: Way) -> float:
    """Share of a way after which it has left an even turn by half of the tolerance: polynomials go to and fro."""
    looks = [way(k / LOOKS) for k in range(LOOKS + 1)]
    bend = 0.0
    for a, b, c in zip(looks, looks[1:], looks[2:], strict=False):
        even = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + b[0] * c[0] + b[1] * c[1] + b[2] * c[2]
        bend = max(bend, dist([x + z for x, z in zip(a, c, strict=True)], [even * y for y in b]))
    return sqrt(4.0 * TOLERANCE / bend) / LOOKS if bend > TOLERANCE * CLOSEST else 1.0


def _edge(
    between: tuple[float, float],
    solve: Callable[[float], Knot | None],
    is_inside: Callable[[Knot | None], bool],
    *,
    leaves: bool,
) -> Knot | None:
    """The knot just outside a cone, where the way enters or leaves it."""
    found: Knot | None = None
    low, high = between
    for _ in range(SEARCH):
        middle = 0.5 * (low + high)
        knot = solve(middle)
        if is_inside(knot) is leaves:
            low = middle
        else:
            high = middle
        if not is_inside(knot):
            found = knot
    return found


def _fewer(kinematics: Kinematics, way: Way, steps: Sequence[Knot], edges: Sequence[int]) -> list[Knot]:
    """As few of the steps as lead the tool along the way within the tolerance; the edges of cones stay."""
    kept: list[Knot] = []
    if all(_off(kinematics, way, steps[0], steps[-1], step) <= TOLERANCE for step in steps[1:-1]):
        return [steps[-1]]
    waiting = [pair for pair in pairwise(edges) if pair[0] != pair[1]][::-1]
    while waiting:
        first, last = waiting.pop()
        worst, at = TOLERANCE, 0
        for k in range(first + 1, last):
            off = _off(kinematics, way, steps[first], steps[last], steps[k])
            if off > worst:
                worst, at = off, k
        if at:
            waiting += [(at, last), (first, at)]
        else:
            kept.append(steps[last])
    return kept


def _off(kinematics: Kinematics, way: Way, first: Knot, last: Knot, knot: Knot) -> float:
    """How far the tool is from the wanted direction at a knot that is left out, radians."""
    part = (knot.share - first.share) / (last.share - first.share)
    angles = {axis: a + (last.angles[axis] - a) * part for axis, a in first.angles.items()}
    return angle_between(kinematics.tool_on_work(angles), way(knot.share))
