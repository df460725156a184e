"""Cutting data of a tool that an orientable carrier has turned: edge position, cutting direction and angles (CUTMOD).

Two edges bound a turning tool: the holder angle leads from the cutting direction to one of them, the clearance angle
from the opposite direction to the other one. A position from 1 to 4 has both in one quadrant of the plane, one from 5
to 8 an axis between them, and to each position belong two of the four cutting directions. When the tool turns, these
edges tell its new position, and the angles count from the cutting direction that is nearest then. Where an angle is
missing, or contradicts the position, the edges lie 22.5 degrees on both sides of its middle: the position follows the
turn in eighths. Other tools have no such edges: their position follows the turn in quarters.

Source: job planning 7.11; Function Manual W1 (cutting data modification), description of MD20360 bit 20.
"""

from __future__ import annotations

from math import atan2, ceil, copysign, degrees, floor

from polycnc.compensation.tips import tip_direction
from polycnc.control.sinumerik.tools.edges import DP_CLEARANCE, DP_DIRECTION, DP_HOLDER_ANGLE, DP_TIP
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import cos_sin_deg
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
EIGHTH, QUARTER, HALF = 45.0, 90.0, 180.0
#: Half of the angle between two edges that no data tell.
ASIDE = 0.5 * EIGHTH
#: An edge nearer to an axis of the plane than this, degrees, lies on it.
ON_AXIS = 1e-6
#: A tool whose plane stands square on the active one, or nearly so (cosine of 89 degrees), has no edges in that.
UPRIGHT = 0.01745


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


def is_seen(plane: str, carrier: Frame) -> bool:
    """Whether a plane shows edges that a carrier has turned; where it stands square on the plane none is."""
    return abs(_facing(plane, carrier)) >= UPRIGHT


def turned(edge: Edge, plane: str, carrier: Frame) -> CuttingData:
    """The data of an edge that a carrier has turned, as a plane shows it (`is_seen`)."""
    before = unchanged(edge)
    tip = tip_direction(int(before.position))
    first = tip if any(tip) else (1.0, 0.0)
    angle = _between(first, in_plane(carrier, plane, first))
    if not any(tip):
        return before._replace(angle_deg=angle)
    turned_on = before._replace(angle_deg=angle, is_inverted=_facing(plane, carrier) < 0.0)
    if not edge.is_turning:
        quarters = ceil((abs(angle) - EIGHTH - ON_AXIS) / QUARTER)
        place = ROUND.index(int(before.position)) + round(copysign(2 * max(quarters, 0), angle))
        return turned_on._replace(position=ROUND[place % len(ROUND)])
    edges, is_told = _edges(before, tip)
    main, other = (_turned_angle(carrier, plane, each) for each in edges)
    position = _position(main, other)
    if not is_told:
        return turned_on._replace(position=position, direction=_direction(before, position, plane, carrier))
    direction = _direction(before, position, plane, carrier)
    along = QUARTER * DIRECTIONS.index(int(direction))
    # From the cutting direction the edges open to the side on which the body of the tool is.
    side = copysign(1.0, _signed(HALF + EIGHTH * ROUND.index(position) - along))
    return turned_on._replace(
        position=position,
        direction=direction,
        holder_deg=_signed(side * (main - along)) if before.holder_deg else 0.0,
        clearance_deg=_signed(side * (along + HALF - other)) if before.clearance_deg else 0.0,
    )


def _facing(plane: str, carrier: Frame) -> float:
    """Cosine between the plane and what a carrier makes of it: 1 as it was, -1 seen from behind."""
    normal = axis_vector(PLANES[plane][2])
    return dot(normal, carrier.direct(*normal))


def _edges(data: CuttingData, tip: Point) -> tuple[tuple[float, float], bool]:
    """Angles of the edge that the holder angle tells and of the other one; whether the data tell them."""
    body, half = degrees(atan2(-tip[1], -tip[0])), data.position > 4
    if data.direction in DIRECTIONS:
        along = QUARTER * DIRECTIONS.index(int(data.direction))
        side = copysign(1.0, _signed(body - along))
        holder = data.holder_deg or (QUARTER - ASIDE if half else QUARTER + ASIDE)
        clearance = data.clearance_deg or (QUARTER - ASIDE if half else ASIDE)
        found = along + side * holder, along + HALF - side * clearance
        if _position(*found) == data.position and data.direction in _directions(data.position):
            return found, True
    return (body + ASIDE, body - ASIDE), False


def _position(main: float, other: float) -> int:
    """The edge position of two edges: the tip is opposite to the quadrant, or to the axis, that has both of them."""
    start, width = (
        (main, _signed(other - main)) if _signed(other - main) >= 0.0 else (other, _signed(main - other))
    )
    first = floor((start + ON_AXIS) / QUARTER)
    for quadrants in (1, 2):
        if start + width <= QUARTER * (first + quadrants) + ON_AXIS:
            return _nearest(ROUND, QUARTER * first + EIGHTH * quadrants + HALF, EIGHTH)
    return _nearest(ROUND, start + 0.5 * width + HALF, EIGHTH)


def _directions(position: float) -> tuple[int, ...]:
    """Cutting directions of an edge position: those beside its tip."""
    place = ROUND.index(int(position))
    both = (place - 1, place + 1) if place % 2 else (place - 2, place + 2)
    return tuple(DIRECTIONS[each // 2 % len(DIRECTIONS)] for each in both)


def _direction(data: CuttingData, position: int, plane: str, carrier: Frame) -> float:
    """The cutting direction of a position that is nearest to that which the carrier has turned."""
    if data.direction not in DIRECTIONS:
        return data.direction
    along = _turned_angle(carrier, plane, QUARTER * DIRECTIONS.index(int(data.direction)))
    return min(_directions(position), key=lambda each: abs(_signed(QUARTER * DIRECTIONS.index(each) - along)))


def _turned_angle(carrier: Frame, plane: str, angle: float) -> float:
    """The angle that a plane shows of a direction in it when a carrier has turned it."""
    x, y = in_plane(carrier, plane, cos_sin_deg(angle))
    return degrees(atan2(y, x))


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
    return (angle + HALF) % (2.0 * HALF) - HALF


def _nearest(ring: tuple[int, ...], angle: float, step: float) -> int:
    return ring[round(angle / step) % len(ring)]
