"""INVCW, INVCCW: involutes of a base circle (Fundamentals; job planning 16.1).

I, J, K are the centre of the base circle as for arcs, CR is its radius. The end is a point of the involute, or AR tells
the angle round the centre, positive away from the base circle. The curve is written as chords.
"""

from __future__ import annotations

from math import atan, hypot, radians
from typing import TYPE_CHECKING

from polycnc.control.sinumerik.block.positions import number, target
from polycnc.control.sinumerik.motion import moves
from polycnc.control.sinumerik.motion.circles import RoundACentre
from polycnc.control.sinumerik.motion.last_move import ArcOfMove, LastMove
from polycnc.control.sinumerik.tools.tool_plane import CHORD_ERROR_MM
from polycnc.geometry import arcs, involute
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.arcs import Point
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
        _go(channel, self.columns, self.axes, end, curve, moves.checked_feed(channel.feed))

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


def _go(
    channel: SinumerikChannel,
    columns: tuple[int, int, int],
    axes: tuple[int, int, int],
    end: list[float],
    curve: Involute,
    feed: float,
) -> None:
    """Write the chords; other axes go along in proportion to the length. CT goes on in the direction of the end."""
    start, (u, v, _) = channel.coordinates.position, columns
    chords = curve.chords(CHORD_ERROR_MM)
    for point, share in chords[:-1]:
        at = [a + share * (b - a) for a, b in zip(start, end, strict=True)]
        at[u], at[v] = point
        channel.curve(Kind.SPLINE, at, feed)
    before = channel.coordinates.position
    channel.curve(Kind.SPLINE, end, feed)
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
