"""Contours that cycles read: a subprogram, or a section of the calling program between two labels.

The blocks run as they are, with the tool held: their moves are caught before they reach the toolpath, and position,
G functions, feed and frames are put back.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING, Any

from polycnc.cycles.contour import Contour, Piece
from polycnc.geometry import offset
from polycnc.language.sinumerik.calls import call_section, call_without_arguments, named_program
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Generator

    from polycnc.channel.channel import Channel
    from polycnc.channel.path import Move, PathStage
    from polycnc.control.sinumerik.cycles_moves import Moves
    from polycnc.control.sinumerik.memory import Memory
    from polycnc.control.sinumerik.stages import Stages
    from polycnc.geometry.arcs import Point
    from polycnc.toolpath import Event

#: Before a contour is read the tool is thought this far away, mm: so the first block always is a move, and an axis
#: that it does not name shows that.
AWAY_MM = 1e6
COUNTER_CLOCKWISE = (Kind.CCW, Kind.HELIX_CCW)


class Recorder:
    """The stage of the path while a contour is read: it keeps moves and drops events."""

    def __init__(self) -> None:
        self.after: PathStage = self
        self.moves: list[Move] = []

    def move(self, move: Move) -> None:
        """Keep a move."""
        self.moves.append(move)

    def event(self, event: Event, program: int, line: int, context: int) -> None:
        """Auxiliary functions of a contour do nothing."""

    def block(self) -> None:
        """Nothing waits here."""

    def flush(self) -> None:
        """Nothing is held back here."""


@dataclass(slots=True)
class _State:
    """What reading a contour must not change."""

    position: list[float]
    feed: float
    saved: Any
    table: PathStage
    head: PathStage | None
    stages: Stages | None
    previous: Any

    def restore(self, channel: Channel) -> None:
        """Put everything back."""
        memory: Memory = channel.memory
        memory.recorder = None
        memory.stages = self.stages
        channel.table = self.table
        channel.head = self.head
        channel.control.restore(channel, self.saved)
        channel.coordinates.arrive(self.position)
        channel.feed = self.feed
        memory.previous = self.previous


def read(moves: Moves, name: str) -> Generator[None, None, Contour]:
    """The contour that a name means, in the plane of the cycle: "NAME", or "LABEL1:LABEL2" of the calling program.

    The first block leads to its first point.

    Raises:
        AlarmError: 14011 for a program that does not exist, 14082 for a label, 61605 for a contour without moves.
    """
    channel = moves.channel
    memory: Memory = channel.memory
    channel.flush()
    state = _State(
        channel.coordinates.position.copy(),
        channel.feed,
        channel.control.save(channel),
        channel.table,
        channel.head,
        memory.stages,
        memory.previous,
    )
    recorder = Recorder()
    begin = state.position.copy()
    for column in moves.columns[:2]:
        if column >= 0:
            begin[column] += AWAY_MM
    start, _, end = (part.strip() for part in name.partition(":"))
    if end:
        call_section(channel, "", start.upper(), end.upper())
    else:
        call_without_arguments(channel, named_program(channel, start))
    channel.coordinates.arrive(begin)
    channel.feed = channel.feed if channel.feed > 0.0 else 1.0
    memory.stages = None
    memory.recorder = recorder
    channel.table = recorder
    channel.head = recorder
    yield
    channel.flush()
    state.restore(channel)
    if len(recorder.moves) < 2:
        raise AlarmError("61605")
    return [_piece(moves, move) for move in recorder.moves[1:]]


def _piece(moves: Moves, move: Move) -> Piece:
    start, end = _point(moves, move.start), _point(moves, move.end)
    if move.center is None:
        return Piece(offset.line(start, end), move.kind is Kind.RAPID)
    center = move.center[moves.axes[0]], move.center[moves.axes[1]]
    ccw = (move.kind in COUNTER_CLOCKWISE) is (move.normal[moves.axes[2]] > 0.0)
    return Piece(offset.arc(start, end, center, ccw))


def _point(moves: Moves, position: list[float]) -> Point:
    """A position in the plane; an axis that the first block does not name stays where the tool stands."""
    u, v = (
        (position[column] - (AWAY_MM if position[column] > AWAY_MM / 2.0 else 0.0)) if column >= 0 else nan
        for column in moves.columns[:2]
    )
    return u, v
