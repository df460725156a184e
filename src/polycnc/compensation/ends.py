"""How a step of the window ends: by the step that follows, or blind, without one."""

from __future__ import annotations

from polycnc.compensation import vectors
from polycnc.compensation.step import Role
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset
from polycnc.geometry.offset import Corner, Joint

if TYPE_CHECKING:
    from polycnc.compensation.step import Step
    from polycnc.geometry.arcs import Point


def end_before(step: Step, following: Step, wall: Point | None) -> Corner | None:
    """The vectors between two steps; None where their offset paths do not meet.

    Args:
        step: The step in front.
        following: The next plane move.
        wall: Direction in which the workpiece goes on behind a contour that is cancelled (`G40 I J K`).
    """
    edge, distance, policy = step.edge, step.distance, step.policy
    if step.forced is not None:
        return _forced_end(step, step.forced)
    if step.holds:
        resumes = step.suspended and following.role is Role.CONTOUR and not following.holds
        own = [vectors.square(following.edge.departing, following.distance).vectors[0]] if resumes else []
        return Corner([step.first, *own])
    if step.corner_arc is not None:
        direction = step.corner_arc[1]
        end = following.edge.departing if direction is None else offset.ray(edge.end, direction).arriving
        return _arc_end(step, end)
    if following.is_bare and wall is None:
        return vectors.square(edge.arriving, distance)
    if following.role is not Role.CONTOUR:
        return vectors.leave(edge, following.edge, distance, following.policy, wall)
    if step.role is Role.START:
        return vectors.approach(edge, following.edge, distance, policy)
    if following.holds or following.starts_square:
        return vectors.square(edge.arriving, distance)
    if following.distance * distance < 0.0 and _changes_side(step, following):
        if following.policy.side_change_is_square:
            return _across(step, following)
        return vectors.change_of_side(edge, following.edge, distance, following.distance)
    return offset.corner(edge, following.edge, distance, policy.outer)


def blind_end(step: Step) -> Corner:
    """The vectors at the end of a contour step that must go before the next plane move is known."""
    if step.forced is not None:
        return _forced_end(step, step.forced)
    if step.holds:
        return Corner([step.first])
    if step.corner_arc is not None and step.corner_arc[1] is not None:
        return _arc_end(step, offset.ray(step.edge.end, step.corner_arc[1]).arriving)
    return vectors.square(step.edge.arriving, step.distance)


def starts_blind(step: Step) -> bool:
    """Whether a start-up that must go before the next plane move is known makes no vector."""
    no_length = step.edge.length <= 0.0
    blind = no_length or not step.policy.blind_start_is_square
    return step.forced is None and step.role is Role.START and blind


def square_ends(step: Step, following: Step) -> Corner:
    """Square on both steps: the way where no intersection leads from one to the other."""
    directions = (step.edge.arriving, following.edge.departing)
    return Corner([offset.square(direction, step.distance) for direction in directions])


def _changes_side(step: Step, following: Step) -> bool:
    """Whether an offset of the other sign is another side from the start of the following step on."""
    again = following.is_engaged and following.policy.side_change_is_square
    return step.policy.sign_is_side or following.side != step.side or again


def _across(step: Step, following: Step) -> Corner:
    """Square on a step, on its side, and square on the next one, on that one's side."""
    old = offset.square(step.edge.arriving, step.distance)
    return Corner([old, offset.square(following.edge.departing, following.distance)])


def _forced_end(step: Step, direction: Point) -> Corner:
    return vectors.square(offset.ray(step.edge.end, direction).arriving, step.distance)


def _arc_end(step: Step, direction: Point) -> Corner:
    """An arc about the corner, from square on the step to square on a direction (G39)."""
    ends = (step.edge.arriving, direction)
    return Corner([offset.square(end, step.distance) for end in ends], Joint.ARC)
