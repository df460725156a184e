"""The way of a move from the interpreter to the toolpath: a short chain of stages.

The interpreter gives every move and event to the first stage. A stage that must look ahead (corner rounding, cutter
compensation) holds moves back and passes them on, changed, in order; the last stage writes rows. A stage that is not
active is not in the chain, so plain motion goes straight to the table.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING, Any, Protocol

from polycnc.geometry import arcs
from polycnc.toolpath.kinds import ARC_KINDS, CCW_KINDS, Kind

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.geometry.frames import Vector
    from polycnc.toolpath import Event


#: A way shorter than this on every axis (mm, degrees) is the rounding of a changed offset: no way.
NO_WAY = 1e-9


@dataclass(slots=True)
class Move:
    """One motion on its way to the toolpath. Positions are work coordinates of all channel axes (mm, radius, degrees).

    Attributes:
        kind: Row kind.
        start: Position where the move begins.
        end: Position where it ends.
        feed: In internal units, NaN for none.
        program: Number of the program in the toolpath's list.
        line: Line in that program, from 1.
        context: Number of the context that holds.
        center: Arc centre on the geometry axes, or None for a straight move.
        normal: Unit normal of the arc's plane; a `CCW` arc turns counter-clockwise seen from its tip.
        turns: Full turns beyond the first part of an arc.
        parameters: Other curve parameters (lead, start angle, seconds), as `CURVE_WIDTH` documents.
    """

    kind: Kind
    start: list[float]
    end: list[float]
    feed: float = nan
    program: int = 0
    line: int = 0
    context: int = 0
    center: Vector | None = None
    normal: Vector = (0.0, 0.0, 1.0)
    turns: float = 0.0
    parameters: tuple[float, ...] = ()

    @property
    def is_arc(self) -> bool:
        """Whether the move is an arc, a helix or a spiral."""
        return self.center is not None


def is_way(start: list[float], end: list[float]) -> bool:
    """Whether two positions differ by more than rounding."""
    for a, b in zip(start, end, strict=True):  # noqa: SIM110 - a generator costs more than the comparison
        if abs(a - b) > NO_WAY:
            return True
    return False


class PathStage(Protocol):
    """One stage of the chain; `after` is the next one."""

    after: PathStage

    def move(self, move: Move) -> None:
        """Take the next move."""

    def event(self, event: Event, program: int, line: int, context: int) -> None:
        """Take an event; it keeps its place between the moves."""

    def block(self) -> None:
        """Called after every block of the program, with or without motion (look-ahead limits count blocks)."""

    def flush(self) -> None:
        """Pass on everything that is held back: no more moves will come that could change it."""


class PassingStage:
    """A stage that holds nothing back; what it does to moves is up to those that inherit.

    Args:
        after: The next stage.
    """

    def __init__(self, after: PathStage) -> None:
        self.after = after

    def move(self, move: Move) -> None:
        """Pass a move on."""
        self.after.move(move)

    def event(self, event: Event, program: int, line: int, context: int) -> None:
        """Pass an event on."""
        self.after.event(event, program, line, context)

    def block(self) -> None:
        """Pass the end of a block on."""
        self.after.block()

    def flush(self) -> None:
        """Nothing is held back here; the stages behind may do so."""
        self.after.flush()


class LastStage:
    """The last stage of a path: nothing waits here, nothing is held back."""

    def __init__(self) -> None:
        self.after: Any = self

    def block(self) -> None:
        """Nothing waits here."""

    def flush(self) -> None:
        """Nothing is held back here."""


class Recorder(LastStage):
    """The only stage while the control reads a contour without moving: keeps the moves, drops the events."""

    def __init__(self) -> None:
        super().__init__()
        self.moves: list[Move] = []

    def move(self, move: Move) -> None:
        """Keep a move."""
        self.moves.append(move)

    def event(self, event: Event, program: int, line: int, context: int) -> None:
        """Auxiliary functions of a contour that is only read do nothing."""


class TableStage(LastStage):
    """Writes rows: the last stage wherever the control moves."""

    def __init__(self, channel: Channel) -> None:
        super().__init__()
        self._channel = channel
        self.end: list[float] = []

    def move(self, move: Move) -> None:
        """Write a move; one without way and without parameters gives no row."""
        self.end = move.end
        if move.end != move.start or move.center is not None or move.parameters:
            self._channel.write(move)

    def event(self, event: Event, program: int, line: int, context: int) -> None:
        """Write an event at the place of the last move."""
        end = self.end or self._channel.coordinates.position
        self._channel.toolpath.append_event(event, program, line, context, end)


#: Chords of an arc may be this far off it where it is looked at point by point, mm.
CHORD_ERROR_MM = 0.05
_LARGEST_PARTS = 720


def points_of_arc(move: Move, geometry: Sequence[int]) -> Iterator[list[float]]:
    """Points along a circular move between its ends (absolute display, all axes), about evenly spaced."""
    if move.center is None or move.kind not in ARC_KINDS:
        return
    w = max(range(3), key=lambda i: abs(move.normal[i]))
    u, v = (w + 1) % 3, (w + 2) % 3
    first, second = geometry[u], geometry[v]
    if first < 0 or second < 0:
        return
    center = (move.center[u], move.center[v])
    start, end = (move.start[first], move.start[second]), (move.end[first], move.end[second])
    ccw = (move.kind in CCW_KINDS) == (move.normal[w] > 0.0)
    sweep = arcs.sweep_angle(start, end, center, ccw)
    radius = arcs.radius_of(center, start)
    count = min(arcs.parts_for_chord_error(radius, sweep, CHORD_ERROR_MM), _LARGEST_PARTS)
    for number, (a, b) in enumerate(arcs.split(start, end, center, ccw, count)):
        part = (number + 1) / count
        point = [s + part * (e - s) for s, e in zip(move.start, move.end, strict=True)]
        point[first], point[second] = a, b
        yield point
