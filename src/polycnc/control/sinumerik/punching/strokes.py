"""The stage that cuts the moves of a block into equal segments, and puts a stroke behind each of them (12.1, 12.2).

Its block announces itself by two marks in the path, so the stage knows what belongs to it whatever stages in front
hold back. The marks end here.
"""

from __future__ import annotations

from math import ceil, hypot

from polycnc.channel.moves import origins
from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Move, PlacedEvent, Rank, Stage
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.toolpath.context import SHORTENED, Pace
from polycnc.toolpath.events import Event, Stroke

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.channel.channel import Channel

#: By so much of a segment a way may be longer and still be cut into no further one: 1.1 : 0.1 is 11.
ROUNDING = 1e-6
#: MD26016: axes beside the path go evenly, in the first segment, or evenly on arcs only.
EVENLY, IN_FIRST, EVENLY_ON_ARCS = range(3)


@dataclass(frozen=True, slots=True)
class Acceleration:
    """How far the axes accelerate by the distance of two strokes (PUNCHACC).

    Attributes:
        shortest: Up to this distance, mm, `first` holds.
        first: Share of the acceleration of the axes.
        longest: From this distance on, mm, `last` holds.
        last: Share of the acceleration of the axes.
    """

    shortest: float
    first: float
    longest: float
    last: float

    def at(self, distance: float) -> float:
        """The share that a distance, mm, gives."""
        if distance <= self.shortest:
            return self.first
        if distance >= self.longest:
            return self.last
        share = (distance - self.shortest) / (self.longest - self.shortest)
        return self.first + (self.last - self.first) * share


@dataclass(frozen=True, slots=True)
class Begin(Event):
    """A block with strokes or segments begins.

    Attributes:
        stroke: What is put out behind each segment; None for segments alone.
        at_start: There is a stroke before the first segment as well (nibbling).
        parts: Number of segments (SPN), 0 for none.
        longest: Longest segment, mm (SPP); 0 for none.
        axes: Columns of the axes that make a stroke when they are named.
        single: Columns of the axes beside the path that are cut into segments with it.
        division: MD26016.
        acceleration: That of moves to a stroke; None for that of the axes.
    """

    stroke: Stroke | None
    at_start: bool
    parts: int
    longest: float
    axes: frozenset[int]
    single: frozenset[int]
    division: int
    acceleration: Acceleration | None


@dataclass(frozen=True, slots=True)
class End(Event):
    """A block with strokes or segments ends."""


class SegmentStage(Stage):
    """Cuts moves into segments and puts strokes between them, as the marks of their block say."""

    rank = Rank.SEGMENTS

    def __init__(self, channel: Channel) -> None:
        self._channel = channel
        self._block: Begin | None = None
        self._at_start = False
        self._strokes = 0
        self.awaited = 0

    @property
    def active(self) -> bool:
        """Whether the marks of a block are still to come."""
        return self.awaited > 0

    def event(self, event: PlacedEvent) -> None:
        """Take the marks of a block; everything else passes."""
        mark = event.event
        if isinstance(mark, Begin):
            self._block, self._at_start, self._strokes = mark, mark.at_start, 0
        elif isinstance(mark, End):
            self._end(event)
        else:
            self.after.event(event)

    def _end(self, place: PlacedEvent) -> None:
        """A block that names a punching axis and leads nowhere makes its stroke in place."""
        if self._block is not None and not self._strokes:
            self._stroke(place.program, place.line, place.context, starts=True)
        self._block = None
        self.awaited -= 1

    def move(self, move: Move) -> None:
        """Pass a move on in segments."""
        block = self._block
        if block is None:
            self.after.move(move)
            return
        strikes = block.stroke is not None and self._leads(move, block.axes)
        length = self._length(move)
        count = self._count(block, move, length)
        context = self._context(block, move, length / count) if strikes else move.context
        if strikes:
            self._stroke(move.program, move.line, context, starts=True, ends=False)
        segment = origins.STROKE_SEGMENT if strikes else origins.SEGMENT
        for number, piece in enumerate(self._pieces(block, move, count), 1):
            self._channel.once_more()
            piece.context = context
            if count > 1:
                piece.origin = segment if number < count else SHORTENED
            self.after.move(piece)
            if strikes:
                self._stroke(move.program, move.line, context)

    def _stroke(
        self, program: int, line: int, context: int, *, starts: bool = False, ends: bool = True
    ) -> None:
        """Put out the stroke of a segment's end, and that of the block's start where it is still due."""
        block = self._block
        if block is None or block.stroke is None:
            return
        count = int(starts and self._at_start) + int(ends)
        for _ in range(count):
            self.after.event(PlacedEvent(block.stroke, program, line, context))
        self._at_start = self._at_start and not starts
        self._strokes += count

    def _pieces(self, block: Begin, move: Move, count: int) -> Iterator[Move]:
        """The segments of a move; axes beside the path go as MD26016 says."""
        if count == 1:
            yield move
            return
        path, held, start = (
            MovePath(move, self._channel.coordinates.geometry),
            self._undivided(block, move),
            move.start,
        )
        for k in range(count):
            piece = path.between(k / count, (k + 1) / count)
            piece.start = start
            for column in held:
                piece.end[column] = move.end[column]
            start = piece.end
            yield piece

    def _undivided(self, block: Begin, move: Move) -> list[int]:
        """Axes beside the path that make their whole way in the first segment."""
        divides = block.division == EVENLY or (block.division == EVENLY_ON_ARCS and move.is_arc)
        geometry = self._channel.coordinates.geometry
        beside = (column for column in range(len(move.end)) if column not in geometry)
        if not self._length(move):
            return [column for column in beside if column not in block.single]
        return [column for column in beside if not (divides and column in block.single)]

    def _count(self, block: Begin, move: Move, length: float) -> int:
        """How many segments a move has."""
        if block.parts:
            return block.parts if length or self._leads(move, block.single) else 1
        if block.longest and length:
            return max(ceil(length / block.longest - ROUNDING), 1)
        return 1

    def _length(self, move: Move) -> float:
        """Length on the geometry axes, mm; zero where they stand."""
        geometry = [column for column in self._channel.coordinates.geometry if column >= 0]
        if move.is_arc:
            return MovePath(move, self._channel.coordinates.geometry).length
        way = hypot(*(move.end[column] - move.start[column] for column in geometry))
        return way if way > NO_WAY else 0.0

    @staticmethod
    def _leads(move: Move, columns: frozenset[int]) -> bool:
        return move.is_arc or any(abs(move.end[i] - move.start[i]) > NO_WAY for i in columns)

    def _context(self, block: Begin, move: Move, distance: float) -> int:
        """The context of a move to a stroke: it accelerates as PUNCHACC says."""
        if block.acceleration is None:
            return move.context
        toolpath = self._channel.toolpath
        context = toolpath.contexts[move.context]
        pace = context.pace or Pace()
        own = pace.acceleration or (1.0,) * len(move.end)
        share = block.acceleration.at(distance)
        slower = replace(pace, acceleration=tuple(factor * share for factor in own))
        return toolpath.context_number(replace(context, pace=slower))
