"""Arcs that no circle through both points describes: end points beside it, and scales that differ in the plane.

The tool goes round the circle until one coordinate of the end point is reached, then straight (Hartford manual 3.2.5,
note 5). Under different scales the tool traces no ellipse: a radius takes the larger scale, centre words each take that
of their own axis (FANUC macro B reference 10.5).
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

from polycnc.control.word_address import path
from polycnc.geometry import arcs
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.vectors import axis_vector
from polycnc.toolpath import Kind
from polycnc.toolpath.kinds import arc_kind

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.frames import Frame

#: Scales that differ by less than this are equal.
SAME_SCALE = 1e-9


def scales(frame: Frame, plane: tuple[int, int, int]) -> tuple[float, float]:
    """By how much a frame stretches the two axes of a plane."""
    return _length(frame, plane[0]), _length(frame, plane[1])


def _length(frame: Frame, axis: int) -> float:
    x, y, z = (float(i == axis) for i in range(3))
    first, second, third = frame.direct(x, y, z)
    return float(hypot(hypot(first, second), third))


def is_stretched(frame: Frame, plane: tuple[int, int, int]) -> bool:
    """Whether circles of a plane become ellipses."""
    if frame is IDENTITY:
        return False
    first, second = scales(frame, plane)
    return abs(first - second) > SAME_SCALE


def emit_stretched(
    channel: Channel,
    programmed: list[float],
    plane: tuple[int, int, int],
    told_by: float | Point,
    *,
    ccw: bool,
    feed: float,
) -> None:
    """Write an arc told by its radius or by the way from its start to its centre."""
    u, v, _ = plane
    c, frame = channel.coordinates, channel.coordinates.programming
    ccw = ccw != path.mirrors_plane(frame, plane)
    position = c.to_position(programmed)
    columns = (c.geometry[u], c.geometry[v])
    begin = (c.position[columns[0]], c.position[columns[1]])
    end = (position[columns[0]], position[columns[1]])
    if isinstance(told_by, float):
        found = path.center_by_radius(channel, begin, end, told_by * max(scales(frame, plane)), ccw)
        if found is None:
            channel.straight(Kind.FEED, position, feed, programmed)
            return
        center = found
    else:
        way = [0.0, 0.0, 0.0]
        way[u], way[v] = told_by
        turned = frame.direct(way[0], way[1], way[2])
        center = (begin[0] + turned[u], begin[1] + turned[v])
    write_with_rest(channel, position, center, plane, ccw=ccw, feed=feed, programmed=programmed)


def write_with_rest(
    channel: Channel,
    position: list[float],
    center: Point,
    plane: tuple[int, int, int],
    *,
    ccw: bool,
    feed: float,
    programmed: list[float],
) -> None:
    """Write an arc of the display whose end point may lie beside its circle: the rest is straight."""
    u, v, w = plane
    c = channel.coordinates
    begin = (c.position[c.geometry[u]], c.position[c.geometry[v]])
    end = (position[c.geometry[u]], position[c.geometry[v]])
    on_circle = list(position)
    if abs(arcs.radius_mismatch(begin, end, center)) > channel.control.spiral_tolerance(channel):
        on_circle[c.geometry[u]], on_circle[c.geometry[v]] = arcs.stop_on_circle(begin, end, center, ccw)
    middle = [c.position[axis] if axis >= 0 else 0.0 for axis in c.geometry]
    middle[u], middle[v] = center
    third = c.geometry[w]
    helix = third >= 0 and on_circle[third] != c.position[third]
    normal = axis_vector(w)
    channel.curve(
        arc_kind(ccw=ccw, helix=helix),
        on_circle,
        feed,
        center=(middle[0], middle[1], middle[2]),
        normal=normal,
    )
    channel.straight(Kind.FEED, position, feed, programmed)
