"""Leads a channel through runs of plain blocks: gives the kernel its numbers, takes rows and state back."""

from __future__ import annotations

from array import array
from functools import cached_property
from math import inf

from polycnc.channel.states.unchanging import unchanging
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, Any, Protocol
from polycnc.language.bulk import layout
from polycnc.language.bulk.buffers import Room, Window
from polycnc.language.bulk.layout import Columns, State, Tables, new_state
from polycnc.language.bulk.routines.layout import NO_ROUTINE
from polycnc.language.bulk.shapes import Shapes
from polycnc.messages import AlarmError
from polycnc.toolpath.kinds import CURVE_WIDTH, Kind
from polycnc.toolpath.table import CHUNK_ROWS

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Iterable, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.geometry.frames import Frame
    from polycnc.kernels.layout import Floats
    from polycnc.language.bulk.guard import Guard
    from polycnc.language.bulk.recipe import Drilled, Recipe, Spelling
    from polycnc.language.bulk.routines.running import RoutineDialect, RunningRoutines
    from polycnc.language.bulk.scannable import ScannedChannel

#: A run of so many blocks is worth its beginning.
WORTHWHILE = 16
#: Blocks that one call of the kernel runs at the most where it may loop: between two calls it can be interrupted, and
#: a loop that waits for ever is found.
MOST_BLOCKS = 1 << 18
#: Blocks that are scanned for stages at a time, twice as many behind each run that had no end among them: what is
#: scanned behind the end of a run is scanned again.
FEWEST_AHEAD = 128


class Dialect(Protocol):
    """What a control tells of its plain blocks; its `plain_blocks(channel)` gives one, or None.

    Attributes:
        spelling: How its text looks.
    """

    spelling: Spelling

    @property
    def routines(self) -> RoutineDialect | None:
        """What it tells of programs that are called and of loops; None where these are the interpreter's.

        A program that has none of them does not ask.
        """

    def ready(self, channel: Channel) -> bool:
        """Whether plain blocks may be scanned now: nothing watches single blocks or holds moves back."""

    def generation(self, channel: Channel) -> Hashable:
        """Something that changes when recipes given before no longer hold."""

    def state(self, channel: Channel) -> Hashable:
        """The modal state that holds."""

    def enter(self, channel: Channel, state: Any) -> None:
        """Bring the modal state about that blocks have left."""

    def recipe(self, channel: Channel, keys: Sequence[int], line: str) -> Recipe | None:
        """What a block of a shape does in the channel's modal state; None for one that is not plain."""

    def owes(self, channel: Channel) -> bool:
        """Whether incremental words are still owed something."""

    def limits(self, channel: Channel) -> Sequence[tuple[float, float]]:
        """Machine positions of every axis beyond which the interpreter decides; nothing where none has a limit."""

    def tolerance(self, channel: Channel) -> float:
        """Allowed difference between the radii at an arc's start and end, mm."""

    def recipe_of_step(self, channel: Channel, code: Any, step: int, keys: Sequence[int]) -> Recipe | None:
        """As `recipe`, for a block of a routine."""

    def numbered(self, channel: Channel) -> int:
        """Variables below this number may be named by their numbers in text."""

    def put_variables(self, channel: Channel, variables: Floats) -> None:
        """Give the kernel the variables that formulas may read, by number; not a number for a vacant one."""

    def tool(self, channel: Channel) -> Sequence[float]:
        """What must be known to stand the tool along a direction; nothing where no block names one."""

    def skipped(self, channel: Channel) -> int:
        """Levels of block skip that are on (`layout.Scan.skipped`)."""

    def drilled(self, channel: Channel) -> Drilled | None:
        """The strokes of the next hole; None where the interpreter drills."""

    def turned(self, channel: Channel, start: list[float], end: list[float]) -> None:
        """Blocks have stood the tool along directions, the last one between two positions."""

    def stood(self, channel: Channel, times: int, seconds: float) -> None:
        """Holes have had so many dwells of so many seconds."""

    def moved(self, channel: Channel, last: LastMoves) -> None:
        """Blocks have moved the channel; for controls that remember how."""


class LastMoves(NamedTuple):
    """What the blocks of a run did last.

    Attributes:
        kind: Kind of the last row.
        came_from: Position before it.
        center: Centre of the last arc less its start, on the geometry axes; None where there was none.
        curve: Curve row of that arc, as `CURVE_WIDTH` documents.
    """

    kind: int
    came_from: list[float]
    center: tuple[float, float, float] | None
    curve: tuple[float, ...]


@unchanging
class Scanner:
    """Scans the plain blocks of one channel.

    Args:
        dialect: The control's part.
        scan: The kernel.
        axes: Number of the channel's axes.
        rooms: Rows that one call of the kernel may give.
        most_patience: Blocks that are interpreted at the most between two tries.
        plain: The kernel is one as it is written; others are taken likewise.
    """

    def __init__(
        self,
        dialect: Dialect,
        scan: Callable[[Tables, State, Columns], int],
        axes: int,
        rooms: int,
        most_patience: int,
        *,
        plain: bool = False,
    ) -> None:
        self._dialect = dialect
        self._scan = scan
        self._plain = plain
        self._axes = axes
        self._rooms = rooms
        self._shapes = Shapes()
        self._generation: Hashable = None
        self._window = Window()
        self._patience = 1
        self._next_try = 0
        self._most_patience = most_patience
        self._ahead = FEWEST_AHEAD
        self._state = new_state(axes)
        self._routines: RunningRoutines | None = None  # until a program has one
        self._room = Room(axes, rooms)

    @cached_property
    def _guard(self) -> Guard:
        """Watches the travel of the axes behind a tip."""
        from polycnc.language.bulk.guard import Guard  # for programs with a transformation

        return Guard(self._axes, plain=self._plain)

    def _needed_routines(self) -> RunningRoutines | None:
        """The channel's routines; None where they are the interpreter's."""
        told = None if self._routines is not None else self._dialect.routines
        if told is not None:
            from polycnc.language.bulk.routines.running import RunningRoutines  # for programs that have some

            self._routines = RunningRoutines(told, self._state, self._dialect.spelling)
            self._routines.forget(self._shapes)
        return self._routines

    def lead(self, channel: ScannedChannel) -> range:
        """Work off plain blocks; gives as many numbers as blocks are the interpreter's before the next try.

        Where hardly any block is plain, tries become rare: also from call to call, for a program whose blocks call
        is entered again behind each of them. Behind a full chunk, which is handed on first, the next try comes at once.
        """
        ahead, level = self._next_try - channel.blocks, channel.level
        if not 0 < ahead <= self._patience:  # behind it, or counted in another run
            taken = self.run(channel)
            self._patience = 1 if taken >= WORTHWHILE else min(2 * self._patience, self._most_patience)
            self._next_try = channel.blocks + self._patience
            ahead = self._patience
            if taken and len(channel.toolpath.chunk) >= CHUNK_ROWS and channel.path.head is None:
                self._next_try, ahead = channel.blocks, 0
        # Where a program has been called and not left, none of the caller's blocks is next.
        return range(ahead if channel.level is level else 0)

    def run(self, channel: ScannedChannel) -> int:
        """Work off plain blocks from where the channel stands; gives their number."""
        blocks, level = channel.blocks, channel.level
        if level.data:
            self._run_loop(channel)
        while channel.level is level and self._is_ready(channel) and self._some(channel):
            pass
        return channel.blocks - blocks

    def _is_ready(self, channel: ScannedChannel) -> bool:
        """Whether blocks may be scanned now: the control allows it, and limits of travel can be looked at."""
        if not self._dialect.ready(channel):
            return False
        return not _is_guarded(channel) or (channel.path.is_idle and self._guard.is_able(channel))

    def _some(self, channel: ScannedChannel) -> bool:
        """One call of the kernel; true if it may be called again at once."""
        level, window = channel.level, self._window
        code = level.code
        lines = code.program.lines
        line = code.line_of_step(level.index)
        if not window.stand_at(lines, line, code.scannable_to(line)):
            return False
        outcome = self._scanned(channel) if channel.path.is_idle else self._staged(channel)
        if outcome == layout.Outcome.UNKNOWN:
            return self._learn(channel, window.next_line()) and channel.level is level
        known = False
        if self._routines is not None:
            # Within a program that has been called, too: the next call finds it known.
            if outcome == layout.Outcome.UNREAD:
                known = self._routines.read_lines(channel)
            elif outcome == layout.Outcome.UNKNOWN_PROGRAM:
                known = self._routines.learn_callee(channel)
        if channel.level is not level:
            return False
        if known or (outcome == layout.Outcome.NOT_PLAIN and window.fold()):
            return True
        room = len(channel.toolpath.chunk) < CHUNK_ROWS and channel.blocks < channel.block_limit
        return outcome == layout.Outcome.AT_END or (outcome == layout.Outcome.FULL and room)

    def _scanned(self, channel: ScannedChannel) -> int:
        """Rows of plain blocks straight into the table."""
        is_guarded = _is_guarded(channel)
        outcome = self._call(channel, calls=not is_guarded)
        if is_guarded:
            outcome = self._guarded(channel, outcome)
        taken = self._state.scan.line - channel.level.code.program.first_line - self._window.line
        if taken:
            self._take_rows(channel)
            self._go_on(channel, taken)
            if self._routines is not None and (self._has_routines or self._shapes.assigns):
                self._routines.take(channel)
        return outcome

    def _guarded(self, channel: ScannedChannel, outcome: int) -> int:
        """The same blocks once more, up to the first row that could lead beyond the travel of the axes."""
        from polycnc.language.bulk.guard import notes_before

        at = self._state.scan
        rows = self._guard.rows(channel, self._room.table[0], self._room.table[4], at.rows)
        if rows == at.rows:
            return outcome
        most = rows + notes_before(rows, self._room.columns.notes, at.notes)
        self._put_state(channel)
        if rows:
            self._call(channel, most_rows=most)
        return layout.Outcome.NOT_PLAIN

    def _staged(self, channel: ScannedChannel) -> int:
        """Moves of plain blocks through the stages of the path.

        Where one finds an alarm, the channel stands in that block: the blocks up to there are scanned once more.
        """
        from polycnc.language.bulk.staged import StagedRun, leading_moves  # for programs with stages

        at = self._state.scan
        outcome = self._call(channel, self._ahead)
        first_line = channel.level.code.program.first_line + self._window.line
        moves = leading_moves(first_line, at, self._room.columns)
        is_all = moves == at.blocks and at.line == first_line + moves
        self._ahead = min(2 * self._ahead, self._rooms) if is_all else FEWEST_AHEAD
        if not moves:
            return outcome if is_all else layout.Outcome.NOT_PLAIN
        if not is_all:
            self._call(channel, moves)
        run = StagedRun(channel, self._room.table)
        try:
            run.lead(moves, at.first_curve)
        except (AlarmError, ArithmeticError):
            self._call(channel, run.moved)
            self._go_on(channel, run.moved)
            channel.blocks += run.blocks - run.moved
            raise
        self._go_on(channel, moves)
        return outcome if is_all else layout.Outcome.NOT_PLAIN

    def _call(
        self,
        channel: ScannedChannel,
        most_blocks: int | None = None,
        most_rows: int | None = None,
        *,
        calls: bool = False,
    ) -> int:
        """Let the kernel work off blocks from where the channel stands; gives how it ended."""
        self._put_state(channel)
        at = self._state.scan
        blocks = self._blocks_at_once(channel)
        if calls and blocks and self._routines is not None:
            self._routines.allow_calls(channel)
            at.most_blocks = min(at.most_blocks, blocks)
        if most_blocks is not None:
            at.most_blocks = min(at.most_blocks, most_blocks)
        if most_rows is not None:
            at.most_rows = most_rows
        return self._run_kernel()

    @property
    def _has_routines(self) -> bool:
        return self._routines is not None and bool(self._routines.known.kept)

    def _run_kernel(self) -> int:
        shapes, routines = self._shapes, self._routines
        tables = Tables(
            self._window.text, shapes.nexts, shapes.leaves, shapes.rules, shapes.factors, shapes.formulas,
            *(_NO_ROUTINES if routines is None else routines.known.tables),
        )  # fmt: skip
        return self._scan(tables, self._state, self._room.columns)

    def _go_on(self, channel: ScannedChannel, lines: int) -> None:
        """The channel stands behind the blocks of so many lines."""
        level, window = channel.level, self._window
        window.place, window.line = self._state.scan.place, window.line + lines
        self._take_state(channel)
        level.index = level.code.step_of_line(window.line)
        level.current = level.index - 1

    def _learn(self, channel: Channel, line: str) -> bool:
        """Ask the control for the rule of a new shape, that of a line in the text; true if it has one."""
        keys, dialect = tuple(self._state.keys[: self._state.scan.keys]), self._dialect
        kept = None if self._routines is None else self._routines.place()
        read = (
            dialect.recipe(channel, keys, line)
            if kept is None
            else dialect.recipe_of_step(channel, *kept, keys)
        )
        return self._shapes.learn(self._state.scan.root, keys, read)

    # ---- loops ---------------------------------------------------------------------------------------------

    def turn(self, channel: ScannedChannel) -> int:
        """Work off the loop that the channel is in, from the running block on; gives the number of its blocks.

        The blocks are counted; the channel stands behind them.
        """
        blocks, level = channel.blocks, channel.level
        level.index = level.current
        self._run_loop(channel)
        if channel.blocks == blocks:
            level.index = level.current + 1
        return channel.blocks - blocks

    def _run_loop(self, channel: ScannedChannel) -> None:
        """Work off the loop that the channel is in, if it is in one, from the next block on."""
        while (
            self._is_ready(channel)
            and not _is_guarded(channel)
            and channel.path.is_idle
            and self._turned(channel)
        ):
            pass

    def _turned(self, channel: ScannedChannel) -> bool:
        """One call of the kernel for a loop; true if it may be called again at once."""
        routines, at = self._needed_routines(), self._state.scan
        if routines is None:
            return False
        self._put_state(channel)
        if not routines.begin_loop(channel):
            return False
        if self._shapes.calculates:
            self._dialect.put_variables(channel, self._state.variables)
            routines.begin()
        routines.allow_calls(channel)
        at.most_blocks = min(at.most_blocks, self._blocks_at_once(channel))
        outcome = self._run_kernel()
        if at.blocks:
            self._take_rows(channel)
            self._take_state(channel)
            routines.take(channel)
        if outcome == layout.Outcome.UNKNOWN:
            learnt = self._learn(channel, "")
        elif outcome == layout.Outcome.UNREAD:
            learnt = routines.read_lines(channel)
        elif outcome == layout.Outcome.UNKNOWN_PROGRAM:
            learnt = routines.learn_callee(channel)
        else:
            learnt = outcome == layout.Outcome.FULL and at.blocks > 0
        # Where the scan has ended within a program that it has called, it goes on there.
        room = len(channel.toolpath.chunk) < CHUNK_ROWS and channel.blocks < channel.block_limit
        return learnt and room

    @staticmethod
    def _blocks_at_once(channel: ScannedChannel) -> int:
        """Blocks that routines may run until the channel must look whether it waits for ever, or is interrupted."""
        look = inf if channel.standstill is None else channel.standstill.next_look - channel.blocks
        return int(min(MOST_BLOCKS, max(look, 0)))

    # ---- state ---------------------------------------------------------------------------------------------

    def _put_state(self, channel: ScannedChannel) -> None:
        """Where the channel stands, as the kernel reads it."""
        dialect, state, at = self._dialect, self._state, self._state.scan
        generation = dialect.generation(channel)
        if generation != self._generation:
            self._generation, self._shapes = generation, Shapes()
            if self._routines is not None:
                self._routines.forget(self._shapes)
        room = self._room
        room.make_fit(at)
        chunk, c = channel.toolpath.chunk, channel.coordinates
        window, spelling = self._window, dialect.spelling
        at.place, at.end = window.place, window.end
        at.line = channel.level.code.program.first_line + window.line
        at.routine, at.frames, at.most_frames = NO_ROUTINE, 0, 0
        at.program = at.text_program = channel.level.program_number
        at.blocks, at.most_blocks = 0, channel.block_limit - channel.blocks
        at.notes, at.most_notes = 0, room.notes
        at.curves, at.most_curves = 0, room.curves
        at.first_curve = len(chunk.curves) // CURVE_WIDTH
        at.root = self._shapes.root(dialect.state(channel))
        for i, axis in enumerate(c.geometry):
            state.geometry[i] = axis
        at.has_programming = _put_frame(state.programming, c.programming)
        at.has_zero = _put_frame(state.zero, c.zero)
        at.direct, at.owes = c.direct, dialect.owes(channel)
        at.shifted, at.mirrors = c.shift is not None, c.programming.mirrors
        if self._shapes.calculates or self._has_routines:
            dialect.put_variables(channel, state.variables)
        if self._shapes.calls or self._shapes.assigns:
            self._needed_routines()
        if self._routines is not None:
            self._routines.begin()
        limits = () if _is_guarded(channel) else dialect.limits(channel)
        at.limited = bool(limits)
        at.numbered, at.skipped = dialect.numbered(channel), dialect.skipped(channel)
        at.grammar, at.most_digits = spelling.flags, spelling.max_digits
        at.feed, at.tolerance = channel.feed, dialect.tolerance(channel)
        at.turned, at.dwells, state.tool[0] = 0, 0, -1.0
        _put(state.tool, dialect.tool(channel))
        _put_strokes(state.strokes, at.root, dialect.drilled(channel))
        at.rows, at.most_rows = 0, self._most_rows(channel)
        _put(state.position, c.position)
        _put(state.programmed, c.programmed)
        _put(state.pending, c.pending)
        _put(state.shift, c.shift or ())
        _put(state.offsets, c.offsets)
        _put(state.low, [low for low, _ in limits])
        _put(state.high, [high for _, high in limits])

    def _most_rows(self, channel: Channel) -> int:
        """Rows that the next call of the kernel may give; a hole may go beyond the end of a chunk, as elsewhere."""
        if channel.context_is_new:
            return 1  # it is that of the first row, and must be known before the modal state goes on
        left = CHUNK_ROWS - len(channel.toolpath.chunk)
        if left > 0:
            left = max(left, int(self._state.strokes[layout.Strokes.COUNT]) + 2)
        return min(self._room.rows, max(left, 0))

    def _take_rows(self, channel: ScannedChannel) -> None:
        """Rows into the chunk; where a block has left a note, its steps act between them, as they would have there."""
        state, axes, room = self._state, self._axes, self._room
        channel.toolpath.chunk.add_curves(state.scan.curves, room.views[-1])
        code = channel.level.code
        taken = 0
        for i in range(state.scan.notes):
            rows, line, rule = room.columns.notes[
                layout.NoteRecord.SIZE * i : layout.NoteRecord.SIZE * (i + 1)
            ]
            value, *position = room.columns.said[(axes + 1) * i : (axes + 1) * (i + 1)]
            self._add_rows(channel, taken, rows, position)
            taken = rows
            channel.level.current = code.step_of_line(line - code.program.first_line)
            channel.coordinates.position = position
            self._dialect.enter(channel, self._shapes.state_behind(rule))
            channel.mark = len(channel.toolpath.chunk)
            for step, note in self._shapes.notes[rule]:
                step(channel, {note.slot: value})
            channel.mark = channel.toolpath.end_block()
        self._add_rows(channel, taken, state.scan.rows, list(state.position))

    def _add_rows(self, channel: Channel, first: int, end: int, position: list[float]) -> None:
        """Rows of the kernel's columns into the chunk; behind them the channel stands at a position."""
        if first == end:
            return
        context = channel.context_number()
        channel.toolpath.chunk.extend(first, end, context, self._room.views)
        if channel.path.head is not None:
            # The moves have gone past a stage that had nothing to do.
            channel.path.table.end, channel.path.table.context = position, context

    def _take_state(self, channel: Channel) -> None:
        """Where the blocks have left the channel."""
        state, c = self._state, channel.coordinates
        channel.blocks += state.scan.blocks
        self._dialect.enter(channel, self._shapes.states[state.scan.root])
        channel.feed = state.scan.feed
        c.position = list(state.position)
        c.programmed = c.position if c.direct else list(state.programmed)
        if state.scan.owes:
            c.pending = list(state.pending)
        if state.scan.turned:
            self._dialect.turned(channel, list(state.turned_from), list(state.turned_to))
        if state.scan.dwells:
            self._dialect.stood(channel, state.scan.dwells, _dwell(state.strokes))
        if state.scan.rows:
            arcs = state.scan.curves - state.scan.dwells
            self._dialect.moved(channel, self._last_moves(state.scan.rows, arcs))

    def _last_moves(self, rows: int, curves: int) -> LastMoves:
        columns, (x, y, z) = self._room.columns, self._state.last_center
        return LastMoves(
            columns.kind[rows - 1],
            list(self._state.came_from),
            (x, y, z) if curves else None,
            tuple(columns.curves[(curves - 1) * CURVE_WIDTH : curves * CURVE_WIDTH]) if curves else (),
        )


def _is_guarded(channel: Channel) -> bool:
    """Whether travel must be watched: a transformation acts, and axes have limits."""
    return channel.coordinates.transformation is not None and bool(channel.limits)


#: Tables of routines where there are none.
_NO_ROUTINES = array("i"), array("i"), array("i"), array("d"), array("i")


def _put(vector: Floats, values: Iterable[float]) -> None:
    for i, value in enumerate(values):
        vector[i] = value


def _put_strokes(numbers: Floats, root: int, drilled: Drilled | None) -> None:
    """Give the kernel the strokes of the next hole."""
    numbers[layout.Strokes.COUNT] = -1.0
    if drilled is None or len(drilled.strokes) > layout.MOST_STROKES:
        return
    axis, level, feed, end, blocks, strokes = drilled
    places = [place for _, _, place in strokes] or [level]
    dwells = sum(kind == Kind.DWELL for kind, _, _ in strokes)
    head = (len(strokes), root, axis, level, feed, end, blocks, min(places), max(places), dwells)
    _put(numbers, (*head, *(number for stroke in strokes for number in stroke)))


def _dwell(strokes: Floats) -> float:
    """Seconds of a dwell of the hole."""
    first = layout.Strokes.FIRST
    ends = first + 3 * int(strokes[layout.Strokes.COUNT])
    return next(strokes[i + 1] for i in range(first, ends, 3) if strokes[i] == Kind.DWELL)


def _put_frame(numbers: Floats, frame: Frame) -> bool:
    """Give the kernel a frame; false where it changes nothing."""
    if not frame.is_identity:
        _put(numbers, (*frame.m[0], *frame.m[1], *frame.m[2], *frame.t))
    return not frame.is_identity
