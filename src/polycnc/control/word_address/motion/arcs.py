"""Arcs of the word-address controls: the centre of an arc told by R, and how an arc is written.

Where no circle goes through both points, because the end lies beside it or scales differ in the plane: the tool goes
round the circle until one coordinate of the end point is reached, then straight (Hartford manual 3.2.5, note 5). Under
different scales the tool traces no ellipse: a radius takes the larger scale, centre words each take that of their own
axis (FANUC macro B reference 10.5).
"""

from __future__ import annotations

from math import dist, hypot

from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.tolerances import NO_WAY
from polycnc.geometry.vectors import axis_vector
from polycnc.toolpath import Kind
from polycnc.toolpath.kinds import arc_kind
from polycnc.toolpath.modes import FeedMode
from polycnc.toolpath.table import is_way

with loaded_when_called():
    from polycnc.channel.moves import knots

if TYPE_CHECKING:
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.frames import Frame, Vector

#: Scales that differ by less than this are equal.
SAME_SCALE = 1e-9


def center_by_radius(
    channel: WordAddressChannel, begin: arcs.Point, end: arcs.Point, radius: float, ccw: bool
) -> arcs.Point | None:
    """The centre for an R word; None where start and end coincide (an arc of 0 degrees: no motion in the plane)."""
    control = channel.control
    if radius == 0.0:
        raise control.fail("radius_zero", address="R")
    if hypot(end[0] - begin[0], end[1] - begin[1]) < 1e-9:
        return None
    try:
        return arcs.center_from_radius(begin, end, radius, ccw, control.arc_tolerance(channel))
    except ValueError as error:
        raise control.fail("radius_too_small", address="R") from error


def mirrors_plane(frame: Frame, plane: tuple[int, int, int]) -> bool:
    """Whether a frame that keeps a plane turns left and right round in it."""
    u, v, _ = plane
    return frame.m[u][u] * frame.m[v][v] - frame.m[u][v] * frame.m[v][u] < 0.0


def emit_arc(
    channel: WordAddressChannel,
    programmed: list[float],
    center: arcs.Point,
    plane: tuple[int, int, int],
    *,
    ccw: bool,
    feed: float,
    turns: float = 0.0,
) -> None:
    """Write an arc from programmed coordinates: the programming frame maps it, a mirror swaps its sense."""
    u, v, w = plane
    c = channel.coordinates
    point = [0.0, 0.0, 0.0]
    for i, axis in enumerate(c.geometry):
        point[i] = c.programmed[axis] if axis >= 0 else 0.0
    point[u], point[v] = center
    normal = axis_vector(w)
    third = c.geometry[w]
    helix = third >= 0 and abs(programmed[third] - c.programmed[third]) > NO_WAY
    position = c.to_position(programmed)
    middle: Vector = (point[0], point[1], point[2])
    if c.programming is not IDENTITY:
        middle = c.programming.apply(*point)
        ccw = ccw != mirrors_plane(c.programming, plane)
    channel.curve(
        arc_kind(ccw=ccw, helix=helix),
        position,
        feed,
        center=middle,
        normal=normal,
        turns=turns,
        programmed=programmed,
    )


# ---- arcs that are no circle: other scales in the plane, end points beside it


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


def scales_one_axis(frame: Frame, plane: tuple[int, int, int]) -> bool:
    """Whether a frame stretches one axis of a plane and leaves the other as long as it is."""
    return is_stretched(frame, plane) and any(
        abs(scale - 1.0) <= SAME_SCALE for scale in scales(frame, plane)
    )


def emit_stretched(
    channel: WordAddressChannel,
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
    ccw = ccw != mirrors_plane(frame, plane)
    position = c.to_position(programmed)
    columns = (c.geometry[u], c.geometry[v])
    begin = (c.position[columns[0]], c.position[columns[1]])
    end = (position[columns[0]], position[columns[1]])
    if isinstance(told_by, float):
        found = center_by_radius(channel, begin, end, told_by * max(scales(frame, plane)), ccw)
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
    channel: WordAddressChannel,
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
    helix = third >= 0 and abs(on_circle[third] - c.position[third]) > NO_WAY
    held, x, y, z = channel.context, *middle
    is_whole = not is_way(on_circle, position)
    with channel.under(held if is_whole else knots.passing(held)):
        channel.curve(
            arc_kind(ccw=ccw, helix=helix), on_circle, feed, center=(x, y, z), normal=axis_vector(w)
        )
    if held.feed_mode is FeedMode.INVERSE_TIME and not is_whole:
        # F counts the radius: the tool goes on as fast as on the arc.
        feed *= arcs.radius_of(center, begin) / dist(on_circle, position)
    channel.straight(Kind.FEED, position, feed, programmed)
