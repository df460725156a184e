"""Cutting data of a tool that an orientable carrier has turned: edge position, cutting direction and angles (CUTMOD).

The edge turns with the tool, but its positions are 45 degrees apart and the cutting directions 90: both go to the
nearest one, and the angles that are measured from the cutting direction take up the rest.

Source: job planning 7.11.
"""

from __future__ import annotations

from math import atan2, degrees, hypot
from typing import TYPE_CHECKING

from polycnc.compensation.tips import tip_direction
from polycnc.control.sinumerik.tools.edges import DP_CLEARANCE, DP_DIRECTION, DP_HOLDER_ANGLE, DP_TIP
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.geometry.planes import PLANES
from polycnc.geometry.vectors import axis_vector, dot

if TYPE_CHECKING:
    from polycnc.control.sinumerik.tools.edges import Edge
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.frames import Frame, Vector

#: Edge positions round the nose centre in steps of 45 degrees from the first axis of the plane to the second one.
ROUND = (5, 1, 6, 2, 7, 3, 8, 4)
#: Cutting directions round in steps of 90 degrees: along the first axis of the plane 4 and 3, along the second 2 and 1.
DIRECTIONS = (4, 2, 3, 1)
EIGHTH, QUARTER = 45.0, 90.0
#: What lies nearer to the normal of the plane (sine) has no direction in it.
UPRIGHT = 1e-6


class CuttingData(NamedTuple):
    """Data of an edge as the tool stands now.

    Attributes:
        position: Edge position, `$P_AD[2]`.
        holder_deg: Holder angle, `$P_AD[10]`.
        direction: Cutting direction, `$P_AD[11]`.
        clearance_deg: Clearance angle, `$P_AD[24]`.
        angle_deg: How far the edge has turned in the plane, -180 to 180.
        is_inverted: The edge is seen from behind: the spindle must turn the other way.
    """

    position: float
    holder_deg: float
    direction: float
    clearance_deg: float
    angle_deg: float = 0.0
    is_inverted: bool = False


def plane_of(constant: int, plane: str) -> str:
    """Plane in which edges are looked at: that of SD42940, else the active one."""
    named = f"G{abs(constant)}"
    return named if named in PLANES else plane


def unchanged(edge: Edge) -> CuttingData:
    """The data as they are stored."""
    numbers = (DP_TIP, DP_HOLDER_ANGLE, DP_DIRECTION, DP_CLEARANCE)
    position, holder, direction, clearance = (edge.values[n] for n in numbers)
    return CuttingData(position, holder, direction, clearance)


def turned(edge: Edge, plane: str, carrier: Frame) -> CuttingData:
    """The data of an edge that a carrier has turned."""
    before = unchanged(edge)
    tip = tip_direction(int(before.position))
    image = in_plane(carrier, plane, tip if any(tip) else (1.0, 0.0))
    if hypot(*image) < UPRIGHT:
        return before
    angle = _between(tip if any(tip) else (1.0, 0.0), image)
    w = PLANES[plane][2]
    normal = axis_vector(w)
    inverted = any(tip) and dot(normal, carrier.direct(*normal)) < -UPRIGHT
    position = _nearest(ROUND, degrees(atan2(image[1], image[0])), EIGHTH) if any(tip) else before.position
    if before.direction not in DIRECTIONS:
        return before._replace(position=position, angle_deg=angle, is_inverted=inverted)
    along = QUARTER * DIRECTIONS.index(int(before.direction))
    after = _nearest(DIRECTIONS, along + angle, QUARTER)
    rest = _signed(along + angle - QUARTER * DIRECTIONS.index(after))
    # The holder angle opens from the cutting direction towards the body of the tool.
    body = _signed(degrees(atan2(-tip[1], -tip[0])) - along)
    opening = rest if body > 0.0 else -rest
    return CuttingData(
        position, before.holder_deg + opening, after, before.clearance_deg - opening, angle, inverted
    )


def in_plane(carrier: Frame, plane: str, direction: Point) -> Point:
    """What a plane shows of one of its directions when a carrier has turned it."""
    u, v, _ = PLANES[plane]
    image = carrier.direct(*in_space(plane, direction))
    return (image[u], image[v])


def in_space(plane: str, direction: Point) -> Vector:
    """A direction in a plane along X, Y, Z."""
    u, v, w = PLANES[plane]
    found = {u: direction[0], v: direction[1], w: 0.0}
    return (found[0], found[1], found[2])


def _between(a: Point, b: Point) -> float:
    return degrees(atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]))


def _signed(angle: float) -> float:
    return (angle + 180.0) % 360.0 - 180.0


def _nearest(ring: tuple[int, ...], angle: float, step: float) -> int:
    return ring[round(angle / step) % len(ring)]
