"""The stage of the path that turns a rotary axis with the direction of travel (G41.1, G42.1).

It reads each cut's direction in the control plane and gives the rotary axis its end position: over the block, within
the first part of a long one, or in front of it.
"""

from __future__ import annotations

from math import atan2, degrees, hypot, inf

from polycnc.channel.moves.path import Rank, Stage
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs
from polycnc.geometry.angles import nearest_turn
from polycnc.toolpath.kinds import CCW_KINDS, Kind
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from polycnc.channel.moves.path import Move, PlacedEvent
    from polycnc.geometry.arcs import Point
    from polycnc.toolpath import Toolpath

CUTS = frozenset((Kind.FEED, Kind.CW, Kind.CCW, Kind.HELIX_CW, Kind.HELIX_CCW))
SAME_DEG = 1e-9
#: A rapid down waits for the cut over its own block and four more.
PATIENCE = 5


@dataclass(frozen=True, slots=True)
class Direction:
    """How the rotary axis stands to the path.

    Attributes:
        axis: Column of the rotary axis.
        sense: 1 where it counts counter-clockwise in the plane, else -1.
        plane: Columns of the plane's first and second axis.
        places: The same two as geometry axes 0 to 2.
        offset_deg: Added to the direction of travel in the plane, it gives the axis' angle (work coordinates).
        shortest_mm: Blocks below this length leave the axis alone.
        longest_mm: In longer blocks the axis has turned after this length.
        turns_first: The axis turns in front of a block instead of within it.
        least_turn_deg: Turns in front of a block that are not greater are left out.
        turn_feed: Feed of a turn in front of a block, degrees a second; None for the number that F gives.
        follows: Kinds of moves that the axis follows.
    """

    axis: int
    sense: float
    plane: tuple[int, int]
    places: tuple[int, int]
    offset_deg: float
    shortest_mm: float = 0.0
    longest_mm: float = inf
    turns_first: bool = True
    least_turn_deg: float = SAME_DEG
    turn_feed: float | None = None
    follows: frozenset[Kind] = CUTS

    def point(self, position: list[float]) -> Point:
        """A position in the control plane."""
        return position[self.plane[0]], position[self.plane[1]]

    def angle(self, tangent: Point, near: float) -> float:
        """Position of the axis for a direction of travel, on the turn nearest to another position."""
        angle = self.sense * (degrees(atan2(tangent[1], tangent[0]))) + self.offset_deg
        return nearest_turn(angle, near)


@dataclass(frozen=True, slots=True)
class _Cut:
    """What a cut does in the control plane: its length, and where the axis must stand at a length behind its start."""

    direction: Direction
    move: Move
    center: Point | None

    @property
    def length(self) -> float:
        start, end = self.direction.point(self.move.start), self.direction.point(self.move.end)
        if self.center is None:
            return hypot(end[0] - start[0], end[1] - start[1])
        return arcs.radius_of(self.center, start) * abs(self.sweep)

    @property
    def sweep(self) -> float:
        """Angle of an arc, radians, counter-clockwise positive."""
        assert self.center is not None
        start, end = self.direction.point(self.move.start), self.direction.point(self.move.end)
        ccw = self.move.kind in CCW_KINDS
        return arcs.sweep_angle(start, end, self.center, ccw) + self.move.turns * (
            arcs.TAU if ccw else -arcs.TAU
        )

    def first_angle(self, near: float) -> float:
        """Position of the axis at the start."""
        start, end = self.direction.point(self.move.start), self.direction.point(self.move.end)
        if self.center is None:
            return self.direction.angle((end[0] - start[0], end[1] - start[1]), near)
        tangent = arcs.tangent_at(self.center, start, self.move.kind in CCW_KINDS)
        return self.direction.angle(tangent, near)

    def turned_by(self, part: float) -> float:
        """How far the axis turns along with an arc up to a part of its length, degrees."""
        return 0.0 if self.center is None else self.direction.sense * degrees(self.sweep) * part

    def at(self, part: float) -> list[float]:
        """The position at a part of the way."""
        move = self.move
        position = [a + (b - a) * part for a, b in zip(move.start, move.end, strict=True)]
        if self.center is not None:
            start = self.direction.point(move.start)
            angle = arcs.angle_at(self.center, start) + self.sweep * part
            point = arcs.point_at(self.center, arcs.radius_of(self.center, start), angle)
            position[self.direction.plane[0]], position[self.direction.plane[1]] = point
        return position


class NormalStage(Stage):
    """Turns the rotary axis; positions that it changes are changed in place, so the channel knows them too."""

    rank = Rank.NORMAL

    def __init__(self, direction: Direction, toolpath: Toolpath) -> None:
        self.direction = direction
        self._toolpath = toolpath
        self._held: Move | None = None
        self._patience = 0
        #: Where the axis stands behind the last move.
        self.at: float | None = None

    def move(self, move: Move) -> None:
        """Take the next move; a rapid square to the plane waits for the cut behind it."""
        held, self._held = self._held, None
        axis = self.direction.axis
        if self.at is not None and move.start[axis] != self.at:
            move.start = list(move.start)
            move.start[axis] = self.at
        self._turn(move, held)
        self.at = move.end[axis]

    def _turn(self, move: Move, held: Move | None) -> None:
        axis = self.direction.axis
        if move.kind not in self.direction.follows:
            self._release(held)
            move.end[axis] = move.start[axis]
            if move.kind == Kind.RAPID and self.direction.point(move.start) == self.direction.point(move.end):
                self._held, self._patience = move, PATIENCE
            else:
                self.after.move(move)
            return
        way = self._way(move)
        if held is not None:
            if way.length >= self.direction.shortest_mm and way.length > 0.0:
                held.end[axis] = way.first_angle(held.start[axis])
                move.start[axis] = held.end[axis]
            self.after.move(held)
        self._cut(way)

    def _way(self, move: Move) -> _Cut:
        first, second = self.direction.places
        center = None if move.center is None else (move.center[first], move.center[second])
        return _Cut(self.direction, move, center)

    def _count_degrees(self, turn: Move, feed: float) -> None:
        """Give a turn a feed of its own, degrees/s, whatever F counts."""
        context = self._toolpath.contexts[turn.context]
        turn.feed = feed * context.degree_mm
        if context.feed_mode is not FeedMode.PER_MINUTE:
            per_minute = replace(context, feed_mode=FeedMode.PER_MINUTE)
            turn.context = self._toolpath.context_number(per_minute)

    def _cut(self, way: _Cut) -> None:
        direction, move, length = self.direction, way.move, way.length
        axis = direction.axis
        before = move.start[axis]
        if length <= 0.0 or length < direction.shortest_mm:
            move.end[axis] = before
            self.after.move(move)
            return
        first = way.first_angle(before)
        if direction.turns_first and abs(first - before) <= direction.least_turn_deg:
            first = before
        if direction.turns_first and first != before:
            turned = list(move.start)
            turned[axis] = first
            kind = Kind.RAPID if move.kind == Kind.RAPID else Kind.FEED
            turn = replace(move, kind=kind, end=turned, center=None, turns=0.0, start=list(move.start))
            if kind == Kind.FEED and direction.turn_feed is not None:
                self._count_degrees(turn, direction.turn_feed)
            self.after.move(turn)
            move.start = turned
        elif length > direction.longest_mm and abs(first - before) > SAME_DEG:
            part = direction.longest_mm / length
            middle = way.at(part)
            middle[axis] = first + way.turned_by(part)
            begin = replace(move, end=middle, turns=0.0)
            self.after.move(begin)
            move.start = middle
        move.end[axis] = first + way.turned_by(1.0)
        self.after.move(move)

    def _release(self, held: Move | None) -> None:
        if held is not None:
            self.after.move(held)

    def event(self, event: PlacedEvent) -> None:
        """Take an event: a rapid down waits no longer."""
        self.flush_own()
        self.after.event(event)

    def block(self) -> None:
        """A block without a cut has passed."""
        if self._held is not None:
            self._patience -= 1
            if self._patience < 0:
                self.flush_own()
        self.after.block()

    def flush_own(self) -> None:
        """Let a rapid down go as it is."""
        held, self._held = self._held, None
        self._release(held)

    def flush(self) -> None:
        """Pass on what is held back."""
        self.flush_own()
        self.after.flush()
