"""Work on contour tables: EXECTAB moves by an element, INTERSEC finds where two meet; CALCDAT makes a circle of points.

Source: job planning 15.4 to 15.6.
"""

from __future__ import annotations

from itertools import combinations

from polycnc.control.sinumerik.block.arguments import whole
from polycnc.control.sinumerik.block.single_block import RunningBlock
from polycnc.control.sinumerik.contours.elements import SAME_MM
from polycnc.control.sinumerik.contours.tables import element_of
from polycnc.control.sinumerik.motion import circles, moves
from polycnc.control.sinumerik.tables import length_factor
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry import arcs, offset
from polycnc.geometry.planes import PLANES
from polycnc.language.sinumerik.names.values import Type
from polycnc.language.sinumerik.names.variables import Array
from polycnc.language.sinumerik.statements.calls import call_modal
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge

#: Numbers of points that CALCDAT takes.
CIRCLE_POINTS = (3, 4)


def execute_element(channel: SinumerikChannel, args: Arguments) -> None:
    """EXECTAB(table[row]): from here to the end of the element, by its kind of motion.

    Raises:
        AlarmError: As `element_of`, 10931 for a plane with a missing axis, and what any such block raises: 10860
            without a feed, 14040 where the tool is not on the arc.
    """
    element = element_of(args[0], "EXECTAB")
    edge = element.edge
    axes = PLANES[channel.mode["plane"]]
    geometry = channel.coordinates.geometry
    columns = (geometry[axes[0]], geometry[axes[1]], geometry[axes[2]])
    u, v = columns[:2]
    if u < 0 or v < 0:
        raise AlarmError("10931", text=channel.mode["plane"])
    position = channel.coordinates.position
    end = position.copy()
    end[u], end[v] = edge.end
    if channel.coordinates.owes:
        channel.coordinates.pending[u] = channel.coordinates.pending[v] = 0.0
    if edge.center is not None:
        _check_start(channel, (position[u], position[v]), edge)
        circles.arc(channel, columns, axes, end, edge.center, moves.checked_feed(channel.feed), edge.ccw)
    elif element.is_rapid:
        moves.line(channel, Kind.RAPID, end, float("nan"))
    else:
        moves.line(channel, Kind.FEED, end, moves.checked_feed(channel.feed))
    # A block with path motion: single block halts behind it, and a modal subprogram follows.
    RunningBlock.of(channel).acted = channel.single_block
    call_modal(channel)


def _check_start(channel: SinumerikChannel, at: Point, edge: Edge) -> None:
    """14040 where the tool does not stand at the beginning of an arc (MD21000), or the ends do not fit the centre."""
    tolerance = channel.memory.data.number("$MC_CIRCLE_ERROR_CONST")
    if edge.center is None or arcs.radius_of(at, edge.start) > tolerance + SAME_MM:
        raise AlarmError("14040")
    circles.check_end(channel, at, edge.end, edge.center)


def intersection(channel: SinumerikChannel, args: Arguments) -> bool:
    """INTERSEC(table1[row], table2[row], point, mode): whether two elements meet, and where.

    Of several points the first one on the way of the first element counts. The abscissa, ordinate and applicate of
    every plane are right-handed, so the sense of arcs is that of column 2 in all planes, and mode 1 gives the same.
    """
    first, second = (element_of(arg, "INTERSEC").edge for arg in args[:2])
    mode = 0 if len(args) < 4 or args[3] is None else whole(args[3])
    if mode not in (0, 1):
        raise AlarmError("14020", text="INTERSEC")
    point = _reals(args[2], 2, "INTERSEC")
    found = min(_meetings(first, second), key=lambda at: _way_along(first, at), default=None)
    if found is None:
        return False
    factor = length_factor(channel.mode)
    point[0:2] = [found[0] / factor, found[1] / factor]
    return True


def _meetings(a: Edge, b: Edge) -> Iterator[Point]:
    """The points that two bounded edges share; of a common stretch its ends."""
    ends = ((a, b.start), (a, b.end), (b, a.start), (b, a.end))
    yield from (point for edge, point in ends if _contains(edge, point))
    for point in offset.crossings(a, b, 0.0, 0.0):
        if _contains(a, point) and _contains(b, point):
            yield point


def _contains(edge: Edge, point: Point) -> bool:
    """Whether a point lies on an edge, ends included."""
    if min(arcs.radius_of(point, edge.start), arcs.radius_of(point, edge.end)) <= SAME_MM:
        return True
    if edge.center is None:
        du, dv = edge.departing
        u, v = point[0] - edge.start[0], point[1] - edge.start[1]
        return abs(u * dv - v * du) <= SAME_MM and 0.0 <= u * du + v * dv <= edge.length
    radius = arcs.radius_of(edge.center, edge.start)
    on_circle = abs(arcs.radius_of(edge.center, point) - radius) <= SAME_MM
    return on_circle and arcs.contains_direction(edge.start, edge.end, edge.center, edge.ccw, point)


def _way_along(edge: Edge, point: Point) -> float:
    """How far along an edge a point of it lies, as a measure that grows."""
    if edge.center is None or arcs.radius_of(point, edge.start) <= SAME_MM:
        return arcs.radius_of(edge.start, point)
    return abs(arcs.sweep_angle(edge.start, point, edge.center, edge.ccw))


def circle(_channel: SinumerikChannel, args: Arguments) -> bool:
    """CALCDAT(points, number, result): whether 3 or 4 points lie on a circle, with its centre and radius.

    Four points that miss a common circle give the mean of the circles through three of them.

    Raises:
        AlarmError: 14020 for another number, 12360 for fields of another size.
    """
    number = whole(args[1])
    if number not in CIRCLE_POINTS:
        raise AlarmError("14020", text="CALCDAT")
    field = args[0]
    if not isinstance(field, Array) or len(field.dims) != 2 or field.dims[1] != 2 or field.dims[0] < number:
        raise AlarmError("12360", text="CALCDAT")
    values = _reals(field, 2 * number, "CALCDAT")
    result = _reals(args[2], 3, "CALCDAT")
    points = [(values[2 * k], values[2 * k + 1]) for k in range(number)]
    try:
        found = [_through(*three) for three in combinations(points, 3)]
    except ValueError:
        return False
    result[0:3] = [sum(part) / len(found) for part in zip(*found, strict=True)]
    return True


def _through(a: Point, b: Point, c: Point) -> tuple[float, float, float]:
    """Centre and radius of the circle through three points; ValueError for points on a line."""
    (u, v, _), _ = arcs.three_point_circle((*a, 0.0), (*b, 0.0), (*c, 0.0))
    return u, v, arcs.radius_of((u, v), a)


def _reals(value: Any, least: int, name: str) -> list[float]:
    """The elements of a REAL field, at least so many; 12360, 12330."""
    if not isinstance(value, Array) or len(value.items) < least:
        raise AlarmError("12360", text=name)
    if value.variable.type is not Type.REAL:
        raise AlarmError("12330", text=name)
    items: list[float] = value.items
    return items


PROCEDURES = {"EXECTAB": execute_element}
FUNCTIONS = {"INTERSEC": intersection, "CALCDAT": circle}
