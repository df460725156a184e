"""The stage that leads the tool square to the walls of a groove (TRACYL, types 513 and 514; 6.8.2).

Behind radius compensation it sees how far the tool is from the programmed centre line, and writes the part of that
which lies round the cylinder into a column of its own (`transformation.groove`). At a corner the tool is off the centre
lines of both moves, by what holds for the first one; along a block that begins or ends compensation, or brings another
OFFN, it goes evenly.
"""

from __future__ import annotations

from math import ceil, degrees, hypot, sqrt

from polycnc.channel.moves import origins
from polycnc.channel.moves.knots import cut
from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import END_OF_BLOCK, Item, Move, PlacedEvent, Rank, Stage
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.kinds import CCW_KINDS

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.arcs import Point

#: Angle of the pieces of an arc, degrees: along each the linear axis goes evenly.
PIECE_DEG = 2.0
NO_WAY = 1e-9
#: Where a move ends decides the one behind it, whose end decides the next one.
MOST_HELD = 2
OFF, BEGINS, ON = range(3)


class _Held(NamedTuple):
    """A move that waits for what follows, with what comes behind it; `state` is that of compensation along it."""

    move: Move
    state: int
    items: list[Item]


class WallStage(Stage):
    """Holds two moves until the next one says where the tool stands between them.

    Args:
        channel: The channel.
        column: Of the rotary axis, in which points of the path have the part that the linear axis goes.
        at: Where the linear axis stands when the stage begins to lead it.
    """

    rank = Rank.NORMAL

    def __init__(self, channel: SinumerikChannel, column: int, at: float = 0.0) -> None:
        self._channel, self._column = channel, column
        self._held: list[_Held] = []
        self._at = at  # where the linear axis stands at the start of the first move that is held
        self._off = 0.0  # how far the tool is off the centre line there

    @property
    def active(self) -> bool:
        """Whether compensation is on, or the tool still off the centre line."""
        return bool(self._held) or self._at != 0.0 or self._channel.mode["compensation"] != "G40"

    def move(self, move: Move) -> None:
        """Hold this one, and let go of the first of three."""
        before = self._held[-1].state if self._held else OFF
        state = (ON if before != OFF else BEGINS) if self._distance(move) != 0.0 else OFF
        self._held.append(_Held(move, state, []))
        if len(self._held) > MOST_HELD:
            self._let_go()

    def event(self, event: PlacedEvent) -> None:
        """Keep an event behind the last move that is held."""
        if self._held:
            self._held[-1].items.append(event)
        else:
            self.after.event(event)

    def block(self) -> None:
        """Likewise the end of a block."""
        if self._held:
            self._held[-1].items.append(END_OF_BLOCK)
        else:
            self.after.block()

    def flush(self) -> None:
        """No move follows."""
        while self._held:
            self._let_go()
        self.after.flush()

    def _distance(self, move: Move) -> float:
        """How far left of the centre line the tool is while compensation acts, mm; with its sign."""
        context = self._channel.toolpath.contexts[move.context]
        return context.side * context.radius_mm

    def _let_go(self) -> None:
        """Pass the first move on, with the linear axis where the tool stands between it and the next one."""
        held = self._held[0]
        distance, end = self._distance_behind(0), self._between()
        self._write(held.move, self._at, end)
        self._at, self._off = end, distance
        del self._held[0]
        for item in held.items:
            self.pass_on(item)

    def _crosses(self, index: int) -> bool:
        """Whether a move that is held is the line on which compensation goes to the other side of the centre line."""
        following = self._held[index + 1 : index + 2]
        joins = self._held[index].move.origin == origins.JOINED
        return joins and bool(following) and self._distance_behind(index) != self._own(index)

    def _own(self, index: int) -> float:
        return self._distance(self._held[index].move)

    def _distance_behind(self, index: int) -> float:
        """The distance where a move ends that is held: its own, but behind a line to the other side that side's."""
        own, following = self._own(index), self._held[index + 1 : index + 2]
        ahead = self._distance(following[0].move) if following else 0.0
        return ahead if own * ahead < 0.0 and self._held[index].move.origin == origins.JOINED else own

    def _between(self) -> float:
        """How far the tool is off the centre line round the cylinder, where the first move ends."""
        move, state, _ = self._held[0]
        if state == OFF:
            return 0.0
        distance, ahead = self._distance_behind(0), None
        own = self._normal(move, distance - self._off, at_end=True)
        if len(self._held) > 1 and self._held[1].state == ON and not self._crosses(1):
            ahead = self._normal(self._held[1].move, self._distance_behind(1) - distance, at_end=False)
        if state == BEGINS or self._crosses(0):
            own = ahead or own
        if own is None:
            return self._at if ahead is None else distance * ahead[0]
        if ahead is None:
            return distance * own[0]
        share = 1.0 + own[0] * ahead[0] + own[1] * ahead[1]
        return distance * own[0] if share < NO_WAY else distance * (own[0] + ahead[0]) / share

    def _normal(self, move: Move, moves_off: float, *, at_end: bool) -> Point | None:
        """The direction to the left of a centre line in the unrolled plane; None where it has no way there.

        `moves_off`: so much farther to the left the straight way of the tool ends than it begins.
        """
        _, u, v = self._channel.coordinates.geometry
        if move.center is None:
            du, dv = move.end[u] - move.start[u], move.end[v] - move.start[v]
            size = hypot(du, dv)
            along = sqrt(max(size * size - moves_off * moves_off, 0.0))
            du, dv = du * along + dv * moves_off, dv * along - du * moves_off
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
        first, last = self._off_arc(move, path, 0.0), self._off_arc(move, path, 1.0)
        at, pieces = start, cut(self._channel, move, [(k + 1) / count for k in range(count)])
        for k, piece in enumerate(pieces, 1):
            share = k / count
            goal = self._off_arc(move, path, share) + (1.0 - share) * (start - first) + share * (end - last)
            piece.start, piece.end = _with(piece.start, column, at), _with(piece.end, column, goal)
            self.after.move(piece)
            at = goal

    def _off_arc(self, move: Move, path: MovePath, share: float) -> float:
        """How far a point of an arc is off the centre line round the cylinder."""
        normal = self._normal(replace(move, end=path.at(share)), 0.0, at_end=True)
        return 0.0 if normal is None else self._distance(move) * normal[0]


def _with(position: list[float], column: int, value: float) -> list[float]:
    moved = position.copy()
    moved[column] = value
    return moved
