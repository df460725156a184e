"""Chuck and tailstock barrier: forbidden zones about the spindle, in work coordinates (0i-TF Plus III.2.2).

The drawings of the manual are the only place where it says to which corner of a jaw the position CX, CZ belongs. Here
it is the front end of the gripping surface.
"""

from __future__ import annotations

from itertools import pairwise

from polycnc.channel.moves.travel import Untold
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.channel.moves.travel import Travel
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.fanuc.lathe.parameters import LatheParameters
    from polycnc.geometry.arcs import Point

#: Corners of a convex polygon in (Z, X as radius), counter-clockwise.
Polygon = tuple["Point", ...]


def barrier(channel: LatheChannel) -> Barrier | None:
    """The barrier that the parameters describe; None where there is none (8134#1, or all dimensions zero)."""
    chuck, tailstock = _described(channel)
    if tailstock and channel.memory.signals.get("*TSB"):
        tailstock = ()
    bodies = (*chuck, *tailstock)
    return Barrier(channel.axis_index["Z"], channel.axis_index["X"], bodies) if bodies else None


def is_described(channel: LatheChannel) -> bool:
    """Whether the parameters describe a barrier, whatever the machine's signals say of it now."""
    return any(_described(channel))


def _described(channel: LatheChannel) -> tuple[tuple[Polygon, ...], tuple[Polygon, ...]]:
    parameters = channel.memory.parameters
    if not parameters.BAR or not {"X", "Z"} <= set(channel.axes):
        return (), ()
    return _chuck(channel, parameters), _tailstock(parameters)


def _chuck(channel: LatheChannel, parameters: LatheParameters) -> tuple[Polygon, ...]:
    length, width, z = parameters.jaw_length, parameters.jaw_size, parameters.chuck_z
    grip_length, step = parameters.grip_length, parameters.grip_step
    if length <= grip_length or width <= step:
        return ()
    surface = channel.control.from_display(channel, channel.axis_index["X"], parameters.chuck_x)
    back = -1.0 if z <= parameters.tailstock_z else 1.0
    outwards = 1.0 if parameters.jaw_kind else -1.0
    edge = surface + outwards * (width - step)
    jaw = _box(z, z + back * grip_length, surface, edge)
    base = _box(z + back * grip_length, z + back * length, surface - outwards * step, edge)
    return tuple(body for body in (jaw, base) if body)


def _tailstock(parameters: LatheParameters) -> tuple[Polygon, ...]:
    z, d2, d3 = parameters.tailstock_z, parameters.tailstock_diameter_2, parameters.tailstock_hole
    if d2 <= d3 or not parameters.tailstock_length:
        return ()
    back = 1.0 if parameters.chuck_z < z else -1.0
    # The point is taken as one of 90 degrees: as long as its radius grows.
    point = 0.5 * (d2 - d3)
    tip = _ordered(((z, 0.0), (z, 0.5 * d3), (z + back * point, 0.5 * d2), (z + back * point, 0.0)))
    bodies = [
        _box(z + back * begin, z + back * end, 0.0, 0.5 * diameter)
        for begin, end, diameter in (
            (point, parameters.tailstock_length_2, d2),
            (parameters.tailstock_length_2, parameters.tailstock_length_1, parameters.tailstock_diameter_1),
            (parameters.tailstock_length_1, parameters.tailstock_length, parameters.tailstock_diameter),
        )
        if end > begin and diameter > 0.0
    ]
    return (tip, *(body for body in bodies if body))


def _box(z0: float, z1: float, r0: float, r1: float) -> Polygon:
    if z0 == z1 or r0 == r1:
        return ()
    (z0, z1), (r0, r1) = sorted((z0, z1)), sorted((max(r0, 0.0), max(r1, 0.0)))
    return ((z0, r0), (z1, r0), (z1, r1), (z0, r1))


def _ordered(points: Polygon) -> Polygon:
    """The corners counter-clockwise."""
    doubled = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(points, (*points[1:], points[0]), strict=True))
    return points if doubled > 0.0 else tuple(reversed(points))


@dataclass(frozen=True, slots=True)
class Barrier(Untold):
    """Bodies that turn about the Z axis: no way of the tool may lead through them."""

    z: int
    x: int
    bodies: tuple[Polygon, ...]

    def check(self, channel: LatheChannel, travel: Travel) -> None:
        """The control's alarm for a way into a body."""
        for start, end in pairwise(travel.positions()):
            for body in self.bodies:
                for side in (1.0, -1.0):
                    begin, last = (start[self.z], side * start[self.x]), (end[self.z], side * end[self.x])
                    if _enters(begin, last, body):
                        axis = self.x if end[self.x] != start[self.x] else self.z
                        direction = 1 if end[axis] >= start[axis] else -1
                        raise channel.control.forbidden_zone(channel.axes[axis], direction)


def _enters(start: Point, end: Point, polygon: Polygon) -> bool:
    """Whether a straight way has a part inside a convex polygon: it is cut off edge by edge (touching is no entry)."""
    first, last = 0.0, 1.0
    way = (end[0] - start[0], end[1] - start[1])
    for a, b in zip(polygon, (*polygon[1:], polygon[0]), strict=True):
        inward = (a[1] - b[1], b[0] - a[0])
        distance = (start[0] - a[0]) * inward[0] + (start[1] - a[1]) * inward[1]
        speed = way[0] * inward[0] + way[1] * inward[1]
        if abs(speed) < 1e-12:
            if distance <= 1e-9:
                return False
            continue
        part = -distance / speed
        if speed > 0.0:
            first = max(first, part)
        else:
            last = min(last, part)
    return last - first > 1e-9 or (way == (0.0, 0.0) and last >= first)
