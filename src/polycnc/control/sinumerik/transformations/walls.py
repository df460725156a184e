"""The stage that leads the tool square to the walls of a groove (TRACYL, types 513 and 514; 6.8.2).

Behind radius compensation it sees how far the tool is from the programmed centre line, and writes the part of that
which lies round the cylinder into a column of its own (`transformation.groove`). At a corner the tool is off the centre
lines of both moves; along a block that begins or ends compensation it goes evenly.
"""

from __future__ import annotations

from dataclasses import replace
from math import ceil, degrees, hypot
from typing import TYPE_CHECKING

from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import END_OF_BLOCK, Item, Move, PlacedEvent, Rank, Stage
from polycnc.control.sinumerik.errors import not_supported
from polycnc.toolpath.kinds import CCW_KINDS

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.arcs import Point

#: Angle of the pieces of an arc, degrees: along each the linear axis goes evenly.
PIECE_DEG = 2.0
NO_WAY = 1e-9
OFF, BEGINS, ON = range(3)


class WallStage(Stage):
    """Holds each move until the next one says where the tool stands between them.

    Args:
        channel: The channel.
        column: Of the rotary axis, in which points of the path have the part that the linear axis goes.
    """

    rank = Rank.NORMAL

    def __init__(self, channel: SinumerikChannel, column: int) -> None:
        self._channel, self._column = channel, column
        self._held: list[Item] = []
        self._state, self._at = OFF, 0.0

    @property
    def active(self) -> bool:
        """Whether compensation is on, or the tool still off the centre line."""
        return bool(self._held) or self._at != 0.0 or self._channel.mode["compensation"] != "G40"

    def move(self, move: Move) -> None:
        """Let go of the move before, and hold this one."""
        side = self._distance(move) != 0.0
        state = (ON if self._state != OFF else BEGINS) if side else OFF
        self._let_go(move, state)
        self._held, self._state = [move], state

    def event(self, event: PlacedEvent) -> None:
        """Keep an event behind the move that is held."""
        if self._held:
            self._held.append(event)
        else:
            self.after.event(event)

    def block(self) -> None:
        """Likewise the end of a block."""
        if self._held:
            self._held.append(END_OF_BLOCK)
        else:
            self.after.block()

    def flush(self) -> None:
        """No move follows."""
        self._let_go(None, OFF)
        self.after.flush()

    def _distance(self, move: Move) -> float:
        """How far left of the centre line the tool is while compensation acts, mm; with its sign."""
        context = self._channel.toolpath.contexts[move.context]
        return context.side * context.radius_mm

    def _let_go(self, following: Move | None, state: int) -> None:
        if not self._held:
            return
        held, self._held = self._held, []
        move = held[0]
        assert isinstance(move, Move)
        end = self._between(move, following, state)
        self._write(move, self._at, end)
        self._at = end
        for item in held[1:]:
            self.pass_on(item)

    def _between(self, move: Move, following: Move | None, state: int) -> float:
        """How far the tool is off the centre line round the cylinder, where a move ends and another one begins."""
        if self._state == OFF:
            return 0.0
        own, ahead = self._normal(move, at_end=True), None
        if following is not None and state == ON:
            ahead = self._normal(following, at_end=False)
            if abs(self._distance(following) - self._distance(move)) > NO_WAY:
                raise not_supported("TRACYL: OFFN")
        distance = self._distance(move)
        if self._state == BEGINS:
            own = ahead or own
        if own is None:
            return self._at if ahead is None else distance * ahead[0]
        if ahead is None:
            return distance * own[0]
        share = 1.0 + own[0] * ahead[0] + own[1] * ahead[1]
        return distance * own[0] if share < NO_WAY else distance * (own[0] + ahead[0]) / share

    def _normal(self, move: Move, *, at_end: bool) -> Point | None:
        """The direction to the left of a move in the unrolled plane; None where it has no way there."""
        _, u, v = self._channel.coordinates.geometry
        if move.center is None:
            du, dv = move.end[u] - move.start[u], move.end[v] - move.start[v]
        else:
            point = move.end if at_end else move.start
            sense = (1.0 if move.kind in CCW_KINDS else -1.0) * move.normal[0]
            du, dv = -sense * (point[v] - move.center[2]), sense * (point[u] - move.center[1])
        size = hypot(du, dv)
        return None if size < NO_WAY else (-dv / size, du / size)

    def _write(self, move: Move, start: float, end: float) -> None:
        """Pass a move on with the linear axis; an arc in pieces."""
        column = self._column
        if move.center is None:
            self.after.move(
                replace(move, start=_with(move.start, column, start), end=_with(move.end, column, end))
            )
            return
        path = MovePath(move, self._channel.coordinates.geometry)
        count = max(1, ceil(abs(degrees(path.sweep)) / PIECE_DEG))
        first, last = self._off(move, path, 0.0), self._off(move, path, 1.0)
        at = start
        for k in range(count):
            share = (k + 1) / count
            piece = path.between(k / count, share)
            goal = self._off(move, path, share) + (1.0 - share) * (start - first) + share * (end - last)
            piece.start, piece.end = _with(piece.start, column, at), _with(piece.end, column, goal)
            self.after.move(piece)
            at = goal

    def _off(self, move: Move, path: MovePath, share: float) -> float:
        """How far a point of an arc is off the centre line round the cylinder."""
        normal = self._normal(replace(move, end=path.at(share)), at_end=True)
        return 0.0 if normal is None else self._distance(move) * normal[0]


def _with(position: list[float], column: int, value: float) -> list[float]:
    moved = position.copy()
    moved[column] = value
    return moved
