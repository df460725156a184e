"""The way of a move from the interpreter to the toolpath: ranked stages.

The interpreter gives every move and event to the first stage. A stage that must look ahead (corner rounding, cutter
compensation) holds moves back and passes them on, changed, in order; behind the last one stands the table, which
writes rows. A stage that is not there costs nothing: with an empty path, plain motion goes straight to the table.

`Rank` is the order, whatever order codes were typed in. `Path.put` puts a stage into its place, `Path.take` takes it
out; `Path.divert` lays the whole path aside while a control reads a contour without moving.
"""

from __future__ import annotations

from array import array
from itertools import count, pairwise
from math import nan
from typing import TYPE_CHECKING, ClassVar, TypeVar

from polycnc.deferred.contexts import contextmanager
from polycnc.deferred.records import dataclass, replace
from polycnc.toolpath.context import PROGRAMMED
from polycnc.toolpath.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.geometry.frames import Vector
    from polycnc.toolpath import Event
    from polycnc.transformation.orientation.turning import Turning


#: Gives the numbers of ranks, one behind the other: as an enumeration so many would take as long as ten modules.
_place = count(1).__next__


class Rank:
    """The place of a stage in the path, first to last; the path holds at most one stage of a rank."""

    #: States of the program that are told to the main run, in order with the moves.
    STATES = _place()
    #: What is noted of moves as the program means them (contour tables).
    NOTES = _place()
    #: Inputs that interrupt a block: they see moves as the program means them.
    INTERRUPTS = _place()
    #: Points become the chords of a curve that goes through them.
    POINTS = _place()
    #: Control points become the chords of a curve.
    SPLINE = _place()
    #: A smooth approach waits for the contour.
    APPROACH = _place()
    #: Chamfers and roundings belong to the contour, so they come before the tool leaves it.
    CORNERS = _place()
    #: The contour as the tool sees it, where frames distort or tilt it.
    INTO_TOOL_PLANE = _place()
    #: Edges of a contour tool: they see the contour.
    EDGES = _place()
    #: Cutter and nose radius.
    COMPENSATION = _place()
    #: Back to programmed lengths and directions.
    OUT_OF_TOOL_PLANE = _place()
    #: Tool radius in space, across a tool that tilts.
    SPATIAL_COMPENSATION = _place()
    #: A rotary axis follows the direction of the way that the tool really takes.
    NORMAL = _place()
    #: A way with punching or nibbling becomes segments, with a stroke behind each.
    SEGMENTS = _place()
    #: Rotary axes turn along the way so that the tool keeps to the way of its direction.
    TURNING = _place()
    #: The history of the tool's direction is smoothed over several moves.
    HISTORY = _place()
    #: The feed takes its course along the way.
    FEED = _place()
    #: Moves that a fit of the path leaves as they are.
    FITTING = _place()
    #: The side of a pole on which an axis is.
    POLE = _place()
    #: Positions of the work become those of the axes.
    AXES = _place()
    #: Slave axes, which only their master moves.
    SLAVES = _place()
    #: Following axes of a gantry, which no program moves.
    GANTRY = _place()
    #: Axes that wait for their leading axes: they see where those are.
    COUPLINGS = _place()
    #: Protection zones: they see where the machine would go.
    ZONES = _place()
    #: Limits of travel: they see where the machine would go, too.
    LIMITS = _place()
    #: Touch probes end moves, so they know how far one was allowed to go.
    PROBES = _place()
    #: Keeps or drops moves: nothing reaches the rows, and all stages in front work as if it did.
    SINK = _place()
    #: Writes rows; always there.
    TABLE = _place()


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
        turning: How the rotary axes go on the way, where they do not go evenly from start to end.
        origin: What has made it of the program's moves, as `Context` says.
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
    turning: Turning | None = None
    origin: int = PROGRAMMED

    @property
    def is_arc(self) -> bool:
        """Whether the move is an arc, a helix or a spiral."""
        return self.center is not None

    def between(self, start: list[float], end: list[float]) -> Move:
        """The same move between two other positions."""
        return Move(
            self.kind, start, end, self.feed, self.program, self.line, self.context,
            self.center, self.normal, self.turns, self.parameters, self.turning, self.origin,
        )  # fmt: skip


@dataclass(frozen=True, slots=True)
class Run:
    """Moves of blocks that follow each other, a move a block and nothing else, as columns of a toolpath.

    Attributes:
        kinds: Row kinds.
        lines: Lines in the program.
        feeds: In internal units.
        ends: Where the moves end, flat.
        curves: `NO_CURVE` for each: none is an arc.
        start: Where the first one begins.
        program: Number of the program in the toolpath's list.
        context: Number of the context that holds.
    """

    kinds: array[int]
    lines: array[int]
    feeds: array[float]
    ends: array[float]
    curves: array[int]
    start: list[float]
    program: int
    context: int

    def part(self, count: int, first: int = 0) -> Run:
        """So many of its moves, from one on."""
        axes, end = len(self.start), first + count
        start = self.ends[(first - 1) * axes : first * axes].tolist() if first else self.start
        return Run(
            self.kinds[first:end], self.lines[first:end], self.feeds[first:end],
            self.ends[first * axes : end * axes], self.curves[first:end], start, self.program, self.context,
        )  # fmt: skip

    def behind(self, moves: Sequence[Move]) -> Run:
        """The same with some moves in front that belong to it, as `continues` tells."""
        return Run(
            array("B", [move.kind for move in moves]) + self.kinds,
            array("I", [move.line for move in moves]) + self.lines,
            array("d", [move.feed for move in moves]) + self.feeds,
            array("d", [number for move in moves for number in move.end]) + self.ends,
            self.curves[:1] * len(moves) + self.curves,
            moves[0].start,
            self.program,
            self.context,
        )

    def continues(self, move: Move) -> bool:
        """Whether program and context are those of a move."""
        return move.program == self.program and move.context == self.context


@dataclass(frozen=True, slots=True)
class PlacedEvent:
    """An event on its way to the toolpath, with program, line and context as a `Move` has them."""

    event: Event
    program: int
    line: int
    context: int


@dataclass(frozen=True, slots=True)
class EndOfBlock:
    """The end of a block that keeps its place behind moves that are held back."""


#: The only one that is needed.
END_OF_BLOCK = EndOfBlock()
#: What a stage may hold back.
Item = Move | PlacedEvent | EndOfBlock


class Stage:
    """A stage of the path. This one passes everything on; what others do to moves they say themselves.

    What a stage remembers are plain fields, so that a path can be copied at any block.

    Attributes:
        rank: Its place in the path.
        lasts: It stays in the path when a program is broken off by an alarm or a reset.
        keeps_ends: Blocks end where the channel knows itself, whatever it does.
        takes_runs: It looks at nothing but moves and ends of blocks, so runs of plain blocks may be scanned for it.
        after: The next stage; the path sets it.
    """

    rank: ClassVar[int]
    lasts: ClassVar[bool] = False
    keeps_ends: ClassVar[bool] = False
    takes_runs: ClassVar[bool] = False
    after: Stage

    @property
    def active(self) -> bool:
        """Whether moves are held back or changed; where not, the path may do without the stage."""
        return True

    def move(self, move: Move) -> None:
        """Take the next move."""
        self.after.move(move)

    def event(self, event: PlacedEvent) -> None:
        """Take an event; it keeps its place between the moves."""
        self.after.event(event)

    def block(self) -> None:
        """Called after every block of the program, with or without motion (look-ahead limits count blocks)."""
        self.after.block()

    def run(self, _run: Run) -> int:
        """Take as many of a run's first moves as can be taken at once, with the ends of their blocks; gives how many.

        The next move, which may be the first one, is given by itself.
        """
        return 0

    def flush(self) -> None:
        """Pass on everything that is held back: no more moves will come that could change it."""
        self.after.flush()

    def beside(self, position: list[float]) -> list[float]:
        """Where the axes stand when the program stands at a position behind all that has been passed on."""
        return position

    def programmed(self, position: list[float]) -> list[float]:
        """The other way round: where the program stands when the axes stand at a position."""
        return position

    def pass_on(self, item: Item) -> None:
        """Pass on something that was held back, as it is."""
        if isinstance(item, Move):
            self.after.move(item)
        elif isinstance(item, PlacedEvent):
            self.after.event(item)
        else:
            self.after.block()


class Sink(Stage):
    """A stage behind which nothing comes: moves and events end here."""

    rank = Rank.SINK

    def move(self, move: Move) -> None:
        """Drop a move."""

    def event(self, event: PlacedEvent) -> None:
        """Drop an event."""

    def block(self) -> None:
        """Nothing waits here."""

    def flush(self) -> None:
        """Nothing is held back here."""


class Recorder(Sink):
    """Keeps the moves of a contour that is read without moving; its auxiliary functions do nothing."""

    def __init__(self) -> None:
        self.moves: list[Move] = []

    def move(self, move: Move) -> None:
        """Keep a move."""
        self.moves.append(move)


class TableStage(Sink):
    """Writes rows: the end of every path.

    Attributes:
        end: End of the last move that came this way, in `context`; empty where moves go past the stages.
    """

    rank = Rank.TABLE

    def __init__(self, channel: Channel) -> None:
        self._channel = channel
        self.end: list[float] = []
        self.context = 0

    def move(self, move: Move) -> None:
        """Write a move; one without way and without parameters gives no row."""
        self.end = move.end
        self.context = move.context
        if move.end != move.start or move.center is not None or move.parameters:
            channel = self._channel
            if move.origin != PROGRAMMED and channel.main_run is not None:
                # Nobody but the main run asks for it.
                held = channel.toolpath.contexts[move.context]
                made = channel.toolpath.context_number(replace(held, origin=move.origin))
                move = replace(move, context=made)
            channel.write(move)

    def run(self, run: Run) -> int:
        """Write moves that all have a way."""
        count = len(run.kinds)
        if count:
            self.end, self.context = run.ends[-len(run.start) :].tolist(), run.context
            programs = array("H", (run.program,)) * count
            columns = (run.kinds, programs, run.lines, run.feeds, run.ends, run.curves)
            views = [memoryview(column).cast("B") for column in columns]
            self._channel.toolpath.chunk.extend(0, count, run.context, views)
        return count

    def event(self, event: PlacedEvent) -> None:
        """Write an event at the place of the last move, as the event's own coordinates have it."""
        channel = self._channel
        end = self.end
        if not end:
            end = channel.coordinates.position
        elif self.context != event.context:
            old, new = (channel.toolpath.contexts[number] for number in (self.context, event.context))
            end = channel.toolpath.seen_from(end, old, new, channel.coordinates.geometry)
        channel.toolpath.append_event(event.event, event.program, event.line, event.context, end)


S = TypeVar("S", bound=Stage)


class Path:
    """The stages that a channel's moves pass, in the order of their ranks.

    Args:
        channel: The channel whose moves they are.
        guard: Looks at what stages have made of moves, in its place behind them; it is none of the stages.

    Attributes:
        head: The first stage, or None while moves go straight to the table.
        table: Writes the rows.
    """

    def __init__(self, channel: Channel, guard: Stage | None = None) -> None:
        self.head: Stage | None = None
        self._guard = guard
        self.table = TableStage(channel)
        self._channel = channel
        self._stages: list[Stage] = []
        self._aside: list[list[Stage]] = []

    @property
    def stages(self) -> Sequence[Stage]:
        """The stages in front of the table, in their order."""
        return self._stages

    @property
    def is_idle(self) -> bool:
        """Whether no stage holds back or changes anything."""
        return not any(stage.active for stage in self._stages)

    @property
    def changes_ends(self) -> bool:
        """Whether the axes may stand elsewhere than the channel knows itself."""
        return any(stage.active and not stage.keeps_ends for stage in self._stages)

    @property
    def takes_runs(self) -> bool:
        """Whether all stages look at nothing but moves and ends of blocks."""
        return all(stage.takes_runs for stage in self._stages)

    @property
    def leads_axes(self) -> bool:
        """Whether rows hold positions of the axes, because a stage has turned those of the work into them."""
        return any(stage.rank == Rank.AXES for stage in self._stages)

    def find(self, kind: type[S]) -> S | None:
        """The stage of a kind; None where the path has none."""
        for stage in self._stages:
            if isinstance(stage, kind):
                return stage
        return None

    def put(self, stage: S) -> S:
        """Put a stage into its place; one of the same rank goes, and must hold nothing back (see `flush`)."""
        others = [each for each in self._stages if each.rank is not stage.rank]
        self._lead(sorted([*others, stage], key=lambda each: each.rank))
        return stage

    def take(self, *kinds: type[Stage]) -> None:
        """Take out the stages of some kinds, which must hold nothing back (see `flush`)."""
        self._lead([stage for stage in self._stages if not isinstance(stage, kinds)])

    def relax(self) -> None:
        """Take out the stages that have nothing to do."""
        if not all(stage.active for stage in self._stages):
            self._lead([stage for stage in self._stages if stage.active])

    def clear(self) -> None:
        """The program is broken off: all stages go but those that last; what was laid aside is forgotten."""
        stages = self._aside[0] if self._aside else self._stages
        self._aside.clear()
        self._lead([stage for stage in stages if stage.lasts])

    def divert(self, recorder: Recorder) -> None:
        """Lay the path aside: moves end in a recorder, through stages of their own, until `resume`."""
        self._aside.append(self._stages)
        self._lead([recorder])

    @property
    def is_diverted(self) -> bool:
        """Whether moves end in a recorder: no axis goes anywhere."""
        return bool(self._aside)

    def resume(self, recorder: Recorder) -> None:
        """The path is as it was before `divert`; where the recorder has gone already, nothing happens."""
        if recorder in self._stages:
            self._lead(self._aside.pop())

    @contextmanager
    def diverted(self, recorder: Recorder) -> Iterator[None]:
        """Moves end in a recorder meanwhile."""
        self.divert(recorder)
        try:
            yield
        finally:
            self.resume(recorder)

    def beside(self, position: list[float]) -> list[float]:
        """Where the axes stand when the program stands at a position: stages may have led them beside it."""
        for stage in self._stages:
            position = stage.beside(position)
        return position

    def programmed(self, position: list[float]) -> list[float]:
        """The other way round: where the program stands when the axes stand at a position."""
        for stage in reversed(self._stages):
            position = stage.programmed(position)
        return position

    def flush(self) -> None:
        """Pass on everything that stages hold back."""
        if self.head is not None:
            self.head.flush()

    def _lead(self, stages: list[Stage]) -> None:
        """Lead moves through these stages, which are in order."""
        self._stages = stages
        way = stages
        if stages and self._guard is not None and not any(isinstance(stage, Sink) for stage in stages):
            way = sorted([*stages, self._guard], key=lambda each: each.rank)
        for stage, after in pairwise([*way, self.table]):
            stage.after = after
        if self.head is None:
            self._channel.off_path = False  # an earlier block may have said so, when no stage asked
        self.head = way[0] if way else None
        self._channel.attention = True
        if self.head is None:
            self.table.end = []  # moves no longer come this way
