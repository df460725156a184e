"""Detours round an interference (FANUC 0i-TF Plus 5.4.6.3): what they are, and whether they keep off the work.

A detour replaces the vectors between the first step of the window and a later one, and often the steps between. Its
candidates are: vectors that have changed places are left out; one path meets an arc about a corner that leads to the
other; the path by the *gap vector*, or, where that crosses itself, the intersection of the two paths. Which of them is
taken is decided by what they would do: the tool must keep its radius from every block that is known, and the step
behind must not run backwards.
"""

from __future__ import annotations

from math import hypot

from polycnc.compensation.ends import blind_end
from polycnc.compensation.policy import Violation
from polycnc.compensation.step import Role
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, distance, offset
from polycnc.geometry.offset import Corner, Joint
from polycnc.geometry.tolerances import NO_WAY
from polycnc.toolpath.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from polycnc.compensation.step import Step
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge

#: What a detour may do, the best first. One that interferes again may be mended by a detour from the next step.
_HARMS = (None, Violation.AVOIDANCE_INTERFERES, Violation.AVOIDANCE_DANGEROUS)
#: What may end or begin a detour by intersection.
PATHS = (Role.CONTOUR, Role.GAP)
#: The tool counts as cutting the work only beyond this (mm): far below any control's increment.
_SPARE_MM = 1e-5


@dataclass(slots=True)
class Detour:
    """Another way from a step to a later one; its steps are changed copies.

    Attributes:
        first: The step in front.
        between: What stands for the last of the steps between: none or one step.
        following: The step behind.
        replaced: The steps between as they were.
        is_outer: The step in front and the one behind make an outer corner: the bottom is wider than the mouth.
    """

    first: Step
    between: list[Step]
    following: Step
    replaced: Sequence[Step]
    is_outer: bool = False

    @property
    def left_out(self) -> Sequence[Step]:
        """The steps that go without anything in their place."""
        return self.replaced[: len(self.replaced) - len(self.between)]

    def harm(self, known: Sequence[Step]) -> Violation | None:
        """What the detour would do.

        Args:
            known: The steps read, and those passed on last.
        """
        if self.is_outer or self.first.runs_back or self.first.leaves_its_circle:
            return Violation.AVOIDANCE_DANGEROUS
        if any(cuts(step, known) for step in (self.first, *self.between)):
            return Violation.AVOIDANCE_DANGEROUS
        following = self.following
        if following.corner is None:
            following = replace(following, corner=blind_end(following))
        if following.role is Role.CONTOUR and (
            following.runs_back or cuts(following, known, following.way()[:1])
        ):
            return Violation.AVOIDANCE_INTERFERES
        return None


def least_harmful(detours: Iterable[Detour], known: Sequence[Step]) -> tuple[Detour, Violation | None] | None:
    """The first detour that does no harm, else the first of those that do the least; None without any."""
    judged: list[tuple[Detour, Violation | None]] = []
    for detour in detours:
        judged.append((detour, detour.harm(known)))
        if judged[-1][1] is None:
            break
    return min(judged, key=lambda pair: _HARMS.index(pair[1]), default=None)


def cuts(step: Step, known: Iterable[Step], way: Sequence[Edge] | None = None) -> bool:
    """Whether the tool comes nearer to a contour than its radius, of two radii than the smaller one.

    Args:
        step: A step with its vectors.
        known: The steps whose contours count.
        way: The part of its way that is looked at; all of it by default.
    """
    rows = step.way() if way is None else way
    return any(
        distance.between(row, other.contour)
        < min(abs(step.distance), abs(other.distance)) - max(_SPARE_MM, other.policy.least_move_mm)
        and not _crosses_itself(step.contour, other.contour)
        for other in known
        if other.role is Role.CONTOUR
        for row in rows
    )


def _crosses_itself(one: Edge, two: Edge) -> bool:
    """Whether blocks that do not follow each other meet, as the ways into and out of a contour do."""
    follow = min(arcs.radius_of(one.end, two.start), arcs.radius_of(two.end, one.start)) <= NO_WAY
    return not follow and one is not two and distance.between(one, two) <= NO_WAY


def leave_out_crossing_vectors(previous: Step, step: Step) -> bool:
    """Of several vectors leave out those that cross, in pairs, the inmost first (5.4.6.2).

    False where the last pair crosses as well.
    """
    if previous.corner is None or step.corner is None:
        return True
    starts, ends = previous.corner.vectors, step.corner.vectors
    while step.runs_back:
        if len(starts) == len(ends) == 1:
            return False
        if len(starts) > 1:
            starts.pop()
        if len(ends) > 1:
            ends.pop(0)
        previous.lead_to(step)
        step.straight = True
    return True


def _meets_arc_behind(previous: Step, step: Step) -> bool:
    """Let the move in front run on to the arc about the corner behind a step too short for the tool."""
    joint = step.joint_arc
    if joint is None or step.corner is None:
        return False
    point = _on(joint, offset.meet(previous.edge, joint, step.distance, 0.0))
    if point is None:
        return False
    previous.corner = Corner([arcs.minus(point, previous.edge.end)])
    previous.lead_to(step)
    step.corner.vectors[0] = arcs.minus(point, step.edge.end)
    return True


def detours(window: Sequence[Step], number: int) -> Iterator[Detour]:
    """The detours from the first step of a window past the step `number`."""
    first, last, following = window[0], window[number], window[number + 1]
    between = window[1 : number + 1]
    if number == 1:
        before, after = _altered(first), _altered(last)
        if leave_out_crossing_vectors(before, after):
            yield Detour(before, [after], replace(following), between)
    for lead_over in (_meets_arc_behind, _by_two_arcs):
        before, after = _altered(first), _altered(last)
        if lead_over(before, after):
            yield Detour(before, [after], replace(following), between)
    if first.distance * following.distance <= 0.0:
        return
    yield from _by_arc_in_front(first, following, between)
    if first.role in PATHS and following.role in PATHS:
        yield from _by_gap_vector(first, following, between)
        yield from _by_intersection(first, following, between)


def _by_arc_in_front(first: Step, following: Step, between: Sequence[Step]) -> Iterator[Detour]:
    """The arc about the corner behind the first step ends where it meets the path of the step behind."""
    joint = first.joint_arc
    if joint is None or first.corner is None:
        return
    point = _on(joint, offset.meet(joint, following.edge, 0.0, following.distance))
    if point is not None:
        before, after = _altered(first), _altered(following)
        vectors = [first.corner.vectors[0], arcs.minus(point, first.edge.end)]
        before.corner = Corner(vectors, Joint.ARC)
        before.lead_to(after)
        yield Detour(before, [], after, between)


def _by_gap_vector(first: Step, following: Step, between: Sequence[Step]) -> Iterator[Detour]:
    """The straight gap stands for the blocks between, unless its own vectors have changed places too."""
    last, side = between[-1], between[-1].distance
    gap = offset.line(first.edge.end, last.edge.end)
    one = offset.meet(first.edge, gap, side, side) if gap.length else None
    two = offset.meet(gap, following.edge, side, side) if gap.length else None
    if one is None or two is None:
        return
    before, after = _altered(first), _altered(following)
    before.corner = Corner([arcs.minus(one, gap.start)])
    move = replace(last.move, kind=Kind.FEED, center=None, turns=0.0, parameters=())
    straight = replace(_altered(last), move=move, edge=gap, role=Role.GAP)
    straight.corner = Corner([arcs.minus(two, gap.end)])
    before.lead_to(straight)
    straight.lead_to(after)
    if not straight.runs_back:
        yield Detour(before, [straight], after, between)


def _by_intersection(first: Step, following: Step, between: Sequence[Step]) -> Iterator[Detour]:
    """The two paths meet each other."""
    side = between[-1].distance
    point = offset.meet(first.edge, following.edge, side, side)
    if point is not None:
        before, after = _altered(first), _altered(following)
        before.corner = Corner([arcs.minus(point, first.edge.end)])
        before.lead_to(after)
        yield Detour(before, [], after, between, offset.is_outer(first.edge, following.edge, side))


def _altered(step: Step) -> Step:
    """A copy of a step for a detour, with vectors of its own."""
    corner = step.corner and Corner(list(step.corner.vectors), step.corner.joint)
    return replace(step, corner=corner, altered=True)


def _by_two_arcs(previous: Step, step: Step) -> bool:
    """Let the arc about the corner in front of a step too short for the tool lead to the one behind it."""
    one, two = previous.joint_arc, step.joint_arc
    if one is None or two is None or previous.corner is None or step.corner is None:
        return False
    point = _on(two, _on(one, offset.meet(one, two, 0.0, 0.0)))
    if point is None:
        return False
    previous.corner = Corner([previous.corner.vectors[0], arcs.minus(point, previous.edge.end)], Joint.ARC)
    previous.lead_to(step)
    step.corner.vectors[0] = arcs.minus(point, step.edge.end)
    return True


def _on(arc: Edge, point: Point | None) -> Point | None:
    """A point of a circle, where it lies on the arc."""
    if point is None or arc.center is None:
        return None
    inside = arcs.contains_direction(arc.start, arc.end, arc.center, arc.ccw, point)
    return point if inside else None


def crosses(one: Edge, vector: Point, two: Edge, other: Point) -> bool:
    """Whether the tool goes from the end of one block to that of another against the programmed direction."""
    du, dv = arcs.minus(two.end, one.end)
    along = du * (du + other[0] - vector[0]) + dv * (dv + other[1] - vector[1])
    return along < -offset.BACKWARDS_MM * hypot(du, dv)
