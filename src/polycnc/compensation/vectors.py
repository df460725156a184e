"""Where the tool stands at the end of a block: the corner rules of radius compensation.

All functions take edges of the programmed contour and signed offsets (left of the direction of travel
positive) and give a `Corner`: vectors from the programmed corner. They are the cases of FANUC 0i-TF Plus
5.4.2 (start-up), 5.4.3 (offset mode) and 5.4.4 (cancel); SINUMERIK's NORM, KONT, G450 and G451 are the same
cases with other data.
"""

from __future__ import annotations

from math import asin, atan2, cos, hypot, pi, sin

from polycnc.compensation.policy import BENDS, Approach
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset
from polycnc.geometry.offset import Corner, Edge, Joint

if TYPE_CHECKING:
    from polycnc.compensation.policy import Policy
    from polycnc.geometry.arcs import Point


#: Rules by which the tool stands square on the contour whichever way it comes.
_SQUARE = (Approach.SQUARE, *BENDS)


def square(direction: Point, distance: float) -> Corner:
    """One vector, square on a direction."""
    return Corner([offset.square(direction, distance)])


def approach(startup: Edge, contour: Edge, distance: float, policy: Policy) -> Corner:
    """The end of the start-up block, before the first block of the contour."""
    rule = policy.approach
    if rule in _SQUARE or not startup.length or not offset.is_outer(startup, contour, distance):
        return square(contour.departing, distance)
    if rule is Approach.TANGENT:
        touching = _touching(startup.start, contour.start, distance, leaving=False)
        if touching is None:
            return square(contour.departing, distance)
        startup = touching
    return offset.outer_corner(startup, contour, distance, policy.outer)


def leave(contour: Edge, cancel: Edge, distance: float, policy: Policy, wall: Point | None) -> Corner:
    """The end of the last block of the contour, before the cancel block.

    Args:
        contour: The last compensated edge.
        cancel: The edge of the cancel block; without length where it has no motion.
        distance: Signed offset.
        policy: The control's behaviour.
        wall: Direction in which the workpiece goes on (`G40 I J K`); the intersection with it is taken at
            inner and outer corners alike, and the square vector where there is none.
    """
    if wall is not None:
        point = offset.meet(contour, offset.ray(contour.end, wall), distance, distance)
        if point is not None:
            return Corner([(point[0] - contour.end[0], point[1] - contour.end[1])])
    rule = policy.approach
    if (
        wall is not None
        or rule in _SQUARE
        or not cancel.length
        or not offset.is_outer(contour, cancel, distance)
    ):
        return square(contour.arriving, distance)
    if rule is Approach.TANGENT:
        touching = _touching(cancel.end, contour.end, distance, leaving=True)
        if touching is None:
            return square(contour.arriving, distance)
        cancel = touching
    return offset.outer_corner(contour, cancel, distance, policy.outer)


def _touching(far: Point, corner: Point, distance: float, *, leaving: bool) -> Edge | None:
    """An edge whose parallel passes through `far`: parallel to the tangent from there to the tool circle.

    With D and b length and angle of the way from `far` to the corner, the tangent point `o·n(d)` lies on
    the line of direction d through `far` when `D·sin(angle(d) - b) = o`; away from the corner the sine
    changes its sign. None where `far` lies inside the circle.
    """
    du, dv = (far[0] - corner[0], far[1] - corner[1]) if leaving else (corner[0] - far[0], corner[1] - far[1])
    length = hypot(du, dv)
    if length <= abs(distance):
        return None
    angle = atan2(dv, du) + (-1.0 if leaving else 1.0) * asin(distance / length)
    direction = (cos(angle), sin(angle))
    if leaving:
        return offset.ray(corner, direction)
    return Edge((corner[0] - direction[0], corner[1] - direction[1]), corner, direction, direction)


def change_of_side(a: Edge, b: Edge, offset_a: float, offset_b: float) -> Corner:
    """The tool changes to the other side of the contour (FANUC 0i-TF Plus 5.4.3).

    The vector leads to the intersection of both offset paths; where they have none, it is square on the
    start of the new block. A path has an end: an intersection beyond the far end of both blocks is none.
    """
    point = offset.meet(a, b, offset_a, offset_b)
    if point is not None:
        vector = (point[0] - a.end[0], point[1] - a.end[1])
        back = -(vector[0] * a.arriving[0] + vector[1] * a.arriving[1])
        ahead = vector[0] * b.departing[0] + vector[1] * b.departing[1]
        if 0.0 <= back <= a.length or 0.0 <= ahead <= b.length:
            return Corner([vector])
    return square(b.departing, offset_b)


def without_small_moves(corner: Corner, following: Edge | None, least_mm: float) -> Corner:
    """Drop vectors that nearly equal the one before (FANUC 0i-TF Plus 5.4.3, "corner motion").

    The first vector, where single block stops, is the one that stays. Before an arc of a semicircle or more
    all stay: without the last one the arc could shrink to nothing.
    """
    if len(corner.vectors) == 1:
        return corner
    if corner.joint is Joint.LINE and following is not None and following.sweep >= pi:
        return corner
    kept = corner.vectors[:1]
    for vector in corner.vectors[1:]:
        if hypot(vector[0] - kept[-1][0], vector[1] - kept[-1][1]) > least_mm:
            kept.append(vector)
    return Corner(kept, corner.joint)
