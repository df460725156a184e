"""INVCW, INVCCW: involutes of a base circle (Fundamentals; job planning 16.1).

I, J, K are the centre of the base circle as for arcs, CR is its radius. The end is a point of the involute, or AR tells
the angle round the centre, positive away from the base circle. The curve is written as chords.
"""

from __future__ import annotations

from functools import partial
from math import atan, hypot, radians, sqrt

from polycnc.channel.moves.chord_path import ChordPath
from polycnc.channel.moves.knots import write_chords
from polycnc.control.sinumerik.block.positions import number, target
from polycnc.control.sinumerik.motion import moves
from polycnc.control.sinumerik.motion.circles import RoundACentre
from polycnc.control.sinumerik.motion.last_move import ArcOfMove, LastMove
from polycnc.control.sinumerik.tools.tool_plane import CHORD_ERROR_MM
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, involute
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.frames import Vector
    from polycnc.geometry.involute import Involute

#: How far the programmed end may miss the involute.
TOLERANCE = "$MC_INVOLUTE_RADIUS_DELTA"


class InvoluteBlock(RoundACentre):
    """An involute, worked out for the words of its block."""

    def __init__(self, draft: Draft) -> None:
        super().__init__(draft)
        self.ccw = draft.mode["motion"] == "INVCCW"
        self.radius, self.angle = draft.take("CR"), draft.take("AR")
        self.terms = draft.take_axes()
        self.lead = draft.take_lead()

    @property
    def is_motion(self) -> bool:
        """Whether the block names an involute at all."""
        return bool(self.terms or self.centre or self.angle is not None)

    def run(self, channel: SinumerikChannel, values: Values) -> None:
        """Move along the involute.

        Raises:
            AlarmError: 14040 for a start or end that is not on the involute, 14900 where both an end point and AR are
                given, 14910 for an angle that leads beyond the base circle, 10860 without a feed.
        """
        start = channel.coordinates.position
        end = target(channel, self.terms, values)
        u, v = self.columns[:2]
        begin = start[u], start[v]
        center, radius = self._base(channel, values, begin)
        if self.angle is None:
            curve = self._to_point(channel, begin, (end[u], end[v]), center, radius)
        else:
            if any(term.column in (u, v) for term in self.terms):
                raise AlarmError("14900")
            curve = self._by_angle(begin, center, radius, radians(number(values, self.angle)))
            end[u], end[v] = curve.end
        feed = moves.checked_feed(channel.feed)
        path = _path(channel, self.columns, self.axes, end, curve)
        if self.lead is not None:
            end = self.lead(channel, values, end, path)
        _go(channel, self.columns, self.axes, path, curve, feed)

    def _base(self, channel: SinumerikChannel, values: Values, begin: Point) -> tuple[Point, float]:
        """Centre and radius of the base circle."""
        if self.radius is None or not number(values, self.radius) > 0.0:
            raise AlarmError("14040")
        return self.programmed_centre(channel, values, begin), number(values, self.radius) * self.factor

    def _to_point(
        self, channel: SinumerikChannel, begin: Point, end: Point, center: Point, radius: float
    ) -> Involute:
        try:
            curve = involute.to_point(begin, end, center, radius, self.ccw)
        except ValueError:
            raise AlarmError("14040") from None
        off = hypot(curve.end[0] - end[0], curve.end[1] - end[1])
        if off > channel.memory.data.number(TOLERANCE) + NO_WAY or curve.first == curve.last:
            raise AlarmError("14040")
        return curve

    def _by_angle(self, begin: Point, center: Point, radius: float, angle: float) -> Involute:
        if not angle:
            raise AlarmError("14910")
        try:
            return involute.by_angle(begin, center, radius, angle, self.ccw)
        except ValueError:
            inside = arcs.radius_of(center, begin) < radius
            raise AlarmError("14040" if inside else "14910") from None


def _path(
    channel: SinumerikChannel,
    columns: tuple[int, int, int],
    axes: tuple[int, int, int],
    end: list[float],
    curve: Involute,
) -> ChordPath:
    """The way along the chords; other axes go along in proportion to the length."""
    start, (u, v, third), geometry = channel.coordinates.position, columns, channel.coordinates.geometry
    chords = []
    for point, share in curve.chords(CHORD_ERROR_MM)[:-1]:
        at = [a + share * (b - a) for a, b in zip(start, end, strict=True)]
        at[u], at[v] = point
        chords.append((share, at))
    squares = curve.first**2, curve.last**2
    length = 0.5 * curve.radius * abs(squares[1] - squares[0])
    rise = (end[third] - start[third]) / length if third >= 0 else 0.0
    sense = 1.0 if curve.last > curve.first else -1.0

    def toward(part: float) -> Vector:
        roll = sqrt(squares[0] + (squares[1] - squares[0]) * part)
        found, size = [0.0, 0.0, 0.0], hypot(1.0, rise)
        for axis, value in zip(axes, (*curve.direction(roll), sense * rise), strict=True):
            found[axis] = sense * value / size
        return found[0], found[1], found[2]

    return ChordPath(start, [*chords, (1.0, end)], toward, geometry)


def _go(
    channel: SinumerikChannel,
    columns: tuple[int, int, int],
    axes: tuple[int, int, int],
    path: ChordPath,
    curve: Involute,
    feed: float,
) -> None:
    """Write the chords. CT goes on in the direction of the end."""
    u, v, _ = columns
    before = end = channel.coordinates.position
    points = list(path.led(channel))
    before, end = [before, *points][-2], points[-1]
    write_chords(channel, points, feed, partial(channel.curve, Kind.SPLINE))
    leads_away = curve.last > curve.first
    bearing = arcs.angle_at(curve.center, (end[u], end[v]))
    touch = bearing + (1.0 if leads_away is curve.ccw else -1.0) * atan(curve.last)
    space, normal = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    space[axes[0]], space[axes[1]] = arcs.point_at(curve.center, curve.radius, touch)
    normal[axes[2]] = 1.0
    last = LastMove.of(channel)
    last.start = before
    last.arc = ArcOfMove(
        (space[0], space[1], space[2]), (normal[0], normal[1], normal[2]), 1.0 if curve.ccw else -1.0
    )


def wind(draft: Draft) -> Step | None:
    """INVCW, INVCCW: an involute in the plane."""
    planned = InvoluteBlock(draft)
    return planned.run if planned.is_motion else None
