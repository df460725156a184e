"""The stage that collects the points of an A or C spline until it ends, and makes its curve out of them.

The curve goes through every point (job planning 4.2). It is cut into chords that stay within `TOLERANCE_MM` of it; the
chords of a block but the last one end at knots, so a display shows one motion for each point. Of a long spline the
first points are passed on when so many are known behind them that others change nothing.
"""

from __future__ import annotations

from itertools import pairwise
from math import hypot

from polycnc.channel.moves.knots import join
from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Rank, Stage
from polycnc.control.sinumerik.motion.last_move import LastMove
from polycnc.control.sinumerik.motion.spline_stage import TOLERANCE_MM
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.through_points import End, akima_tangents, chords, cubic_tangents
from polycnc.geometry.tolerances import NO_WAY
from polycnc.geometry.vectors import cross, minus
from polycnc.toolpath import Kind
from polycnc.toolpath.modes import CornerMode

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.moves.path import Move, PlacedEvent
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Points that are held at most, and how many of them stay: a point does not matter to a curve 32 points away.
MOST_HELD, STAY = 512, 32
#: The parameter of a move that marks it as one to a point of the curve.
POINT = 1.0


class PointsStage(Stage):
    """Collects moves to points.

    Attributes:
        is_akima: An A spline, not a C spline; another kind ends the spline.
        columns: Axes of the spline group; the others move evenly from point to point.
        begins: What holds at its beginning, or its direction there; set with the first point.
        ends: What holds at its end; None for the direction of the move behind it.
    """

    rank = Rank.POINTS

    def __init__(self, channel: Channel) -> None:
        self._channel = channel
        self.is_akima = False
        self.columns: tuple[int, ...] = ()
        self.begins: Sequence[float] | End = End.STRAIGHT
        self.ends: End | None = End.STRAIGHT
        self._held: list[Move] = []
        self._events: list[tuple[int, PlacedEvent]] = []

    @property
    def active(self) -> bool:
        """Whether points are held."""
        return bool(self._held)

    def choose(self, *, is_akima: bool, columns: tuple[int, ...]) -> None:
        """Say which curve the next point belongs to."""
        if self._held and (is_akima, columns) != (self.is_akima, self.columns):
            self._finish(None)
        self.is_akima, self.columns = is_akima, columns

    def move(self, move: Move) -> None:
        """Hold a point; any other move ends the spline."""
        if not (move.kind is Kind.SPLINE and move.parameters == (POINT,)):
            self._finish(move)
            self.after.move(move)
            return
        if self._held and self._held[-1].end != move.start:  # another coordinate system
            self._finish(None)
        self._held.append(move)
        if len(self._held) >= MOST_HELD:
            self._pass(len(self._held) - STAY, End.STRAIGHT)

    def event(self, event: PlacedEvent) -> None:
        """An event keeps its place behind the point of its block."""
        if self._held:
            self._events.append((len(self._held), event))
        else:
            self.after.event(event)

    def flush(self) -> None:
        """The spline ends with the last point that is known."""
        self._finish(None)
        self.after.flush()

    def _finish(self, behind: Move | None) -> None:
        if not self._held:
            return
        end: Sequence[float] | End = End.STRAIGHT if self.ends is None else self.ends
        if self.ends is None and behind is not None:
            end = self._direction(behind) or end
        self._pass(len(self._held), end)

    def _pass(self, count: int, end: Sequence[float] | End) -> None:
        """Pass on the curve through the first points."""
        held = self._held
        points = [[point[i] for i in self.columns] for point in (held[0].start, *(move.end for move in held))]
        make = akima_tangents if self.is_akima else cubic_tangents
        tangents = make(points, self.begins, end)
        events, self._held = self._events, held[count:]
        self._events = [(place - count, event) for place, event in events if place > count]
        segments = zip(held[:count], pairwise(points), pairwise(tangents), strict=False)
        rests = True
        for place, (move, (a, b), (s, t)) in enumerate(segments, 1):
            rested, rests = rests, place == len(held) or self._rests_behind(move)
            self._along(move, list(chords(a, b, s, t, TOLERANCE_MM, rests=(rested, rests))))
            for at, event in events:
                if at == place:
                    self.after.event(event)
        self.begins = tangents[count]

    def _rests_behind(self, move: Move) -> bool:
        return self._channel.toolpath.contexts[move.context].corner_mode is CornerMode.EXACT_STOP

    def _along(self, move: Move, course: list[tuple[float, list[float]]]) -> None:
        """Pass on the chords of a block."""
        start = move.start
        pieces: list[Move] = []
        for share, point in course:
            end = move.end
            if share < 1.0:
                end = [a + (b - a) * share for a, b in zip(move.start, move.end, strict=True)]
                for column, value in zip(self.columns, point, strict=True):
                    end[column] = value
            pieces.append(replace(move, start=start, end=end, parameters=()))
            start = end
        join(self._channel, pieces)
        for piece in pieces:
            self.after.move(piece)

    def _direction(self, move: Move) -> list[float] | None:
        """The direction in which a move begins, on the axes of the spline; None where they stand."""
        way = [b - a for a, b in zip(move.start, move.end, strict=True)]
        if move.is_arc:
            geometry = self._channel.coordinates.geometry
            for column, value in zip(geometry, MovePath(move, geometry).direction(0.0), strict=True):
                if column >= 0:
                    way[column] = value
        return _unit([way[i] for i in self.columns])


def direction_before(channel: SinumerikChannel, columns: Sequence[int]) -> list[float] | None:
    """The direction in which the last move has ended, on some axes; None where none is known."""
    last, end = LastMove.of(channel), channel.coordinates.position
    if last.start is None:
        return None
    way = [b - a for a, b in zip(last.start, end, strict=True)]
    if last.arc is not None:
        geometry = channel.coordinates.geometry
        x, y, z = (end[column] if column >= 0 else 0.0 for column in geometry)
        along = cross(last.arc.normal, minus((x, y, z), last.arc.center))
        for column, value in zip(geometry, along, strict=True):
            if column >= 0:
                way[column] = value * last.arc.sense
    return _unit([way[i] for i in columns])


def _unit(way: list[float]) -> list[float] | None:
    length = hypot(*way)
    return [value / length for value in way] if length > NO_WAY else None
