"""Preparation: the channel runs ahead of the axes, and its rows become pieces of the path and events, in order.

The channel writes a block's rows; the planner's kernels (`motion/kernels`) lay them out as pieces with the speed
that the axes allow. What the program asks for is kept beside it, because overrides act on that alone.
"""

from __future__ import annotations

from array import array
from collections import deque
from functools import partial
from math import inf

from polycnc.channel.intervention import NOTHING_BACK, MovedByHand
from polycnc.channel.stack import LevelKind
from polycnc.channel.waits import PREPROCESSING, TYPED_BLOCKS_DONE, Wait, Why
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.mainrun.preparation.items import (
    Block,
    BlockEnd,
    ChannelRates,
    Happening,
    Item,
    Move,
    Piece,
)
from polycnc.mainrun.preparation.piece_buffer import PieceBuffer
from polycnc.mainrun.preparation.queue import Queue, risen
from polycnc.mainrun.preparation.reapproach import line_from
from polycnc.mainrun.preparation.rows import RowLayer
from polycnc.mainrun.preparation.run_blocks import (
    PASSING,
    Delay,
    RunBlocks,
    acts_on_machine,
    callers_of,
    is_silent,
    waits_for_move,
    without_function,
)
from polycnc.mainrun.preparation.standing import Delays
from polycnc.motion.frames import real_of
from polycnc.motion.kernels.columns import (
    ContextRecord,
    PieceRecord,
)
from polycnc.motion.limits import ContextTables
from polycnc.motion.standing.waits import Waits
from polycnc.motion.time_constants import uses_of
from polycnc.motion.transformed import RealAxes
from polycnc.toolpath import Context, Kind, Toolpath
from polycnc.toolpath.events import Auxiliary, BuilderCode, Deed, Stop

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.stack import Level
    from polycnc.machine.model import Machine
    from polycnc.mainrun.axes.machine_axes import MachineAxes
    from polycnc.messages import AlarmError
    from polycnc.motion.kernels.columns import Limits
    from polycnc.motion.standing.beside import Step
    from polycnc.program import Program
    from polycnc.toolpath import Event
    from polycnc.toolpath.motion_settings import MotionSettings
    from polycnc.toolpath.table import Chunk
    from polycnc.transformation.contract import Geometry

#: Items that are prepared at most, and at how few the channel is asked for more.
FULL, LOW = 512, 128
#: Items that are prepared at most where short pieces do not make up the way that a bound reaches (`hold.py`).
MOST = 4096
#: Blocks that the channel runs in one interpolation cycle while it makes no item, and at most to let a run go on.
BLOCKS_A_CYCLE, BLOCKS_AHEAD = 100, 10_000
#: Waits of the channel behind a block that counts as one even without rows.
BEHIND_A_BLOCK = frozenset({Why.SINGLE_BLOCK, Why.STOP})


class Preprocessing:
    """What lies ahead of the axes.

    Args:
        machine: The machine.
        number: Number of the channel.
        machine_axes: The axes of the machine, which channels may share.
        toolpath: The rows of a channel that has run so far without a clock; else they are kept here.

    Attributes:
        items: What is prepared, in order.
        channel: The channel; set by `use` before anything runs.
        waiting: Why the channel does not go on until it is told to; None while it runs.
        finished: The program is at its end, or none runs.
        revised: The speeds ahead have to be worked out again.
        has_caught_up: Everything that the channel has written is executed.
        last_block: The block that has ended the program, where it counts for single block operation; else empty.
        queue: Takes pieces from the items, and lays them out again for other overrides.
        on_step: Called when the channel has run a block; None where nobody asks.
        stop_behind_next: Preparation waits behind the next block that does something on the machine.
        sought: Program and line of a block that counts as one even if it only calculates; None without a search.
        one_block: Single block halts behind every block: none is held back.
    """

    def __init__(
        self, machine: Machine, number: int, machine_axes: MachineAxes, toolpath: Toolpath | None = None
    ) -> None:
        self.toolpath = Toolpath(machine.channel_axes(number)) if toolpath is None else toolpath
        self.toolpath.hand_on_blocks(self._take, keep=toolpath is not None)
        self.on_step: Callable[[], None] | None = None
        self.last_block = ""
        self.one_block, self.stop_behind_next, self._is_noting, self._cut = False, False, False, -1
        self.items: deque[Item] = deque()
        self.channel: Channel
        self.waiting: Wait | None = None
        self.sought: tuple[str, int] | None = None
        self.finished, self._axes = True, len(self.toolpath.axes)
        self.revised = self.has_caught_up = self._stopped = False
        self._run: Iterator[Wait] | None = None
        self._settings: MotionSettings
        self._buffer = PieceBuffer(self._axes)
        self.queue = Queue(self.items, self._buffer)
        self._rows = RowLayer(self.toolpath, self.queue, self._buffer)
        self._machine, self._number, self._machine_axes = machine, number, machine_axes
        self._stations: dict[tuple[object, ...], int] = {}
        self._known_contexts = 0
        self._delays: dict[int, list[Delay]] = {}
        self._delayed = Delays(self.end_in_rest, self._lag)
        self._waits = Waits(machine, self.toolpath, 0, self._delay)
        self._waits.step = self._note_step
        self._blocks = RunBlocks(self.items, self.toolpath.programs)
        self._geometry = machine.geometry_indices(number)

    # ---- the channel ---------------------------------------------------------------------------------------

    def use(self, channel: Channel, settings: MotionSettings) -> None:
        """Say whose channel it is, and how the control leads the axes."""
        self.channel, self._settings = channel, settings
        self._waits.rapid_stops, self._waits.spindle_wait = settings.rapid_stops, settings.spindle_wait
        self._waits.stand_in(channel.setup.tool_at_start(channel.number))
        channel.main_run = self
        real = RealAxes(self._machine, self._number, self.toolpath.axes, settings, ())
        uses = uses_of(self._machine, self._number, settings)
        self._buffer.tables, self._known_contexts = ContextTables(uses.after_s), 0
        self._rows.use(real, settings, uses)

    def start(
        self,
        program: Program,
        position: Sequence[float],
        enter: Callable[[Channel], None] | None = None,
    ) -> None:
        """Begin with a program; the axes stand at a machine position. `enter` may begin at another block."""
        self.channel.alarms.clear()
        self.begin(self.channel.run(program, power_on=False, enter=enter), position)

    def go_on(self, run: Iterator[Wait], position: Sequence[float], wait: Wait | None = None) -> None:
        """Go on with a run that is under way, and may wait; the axes stand at a machine position."""
        self.clear(position)
        self.finished = self.has_caught_up = False
        self._run, self.waiting = run, wait

    def begin(self, run: Iterator[Wait], position: Sequence[float]) -> None:
        """Begin with a run of the channel; the axes stand at a machine position."""
        self.go_on(run, position)
        if self.channel.group is not None:
            self.channel.group.begin(self._number, run)

    def clear(self, position: Sequence[float]) -> None:
        """Forget everything prepared."""
        self.items.clear()
        self._buffer.clear()
        self._waits.settle(0)
        self._waits.angles.clear()
        self._blocks.clear()
        self._rows.context = Context()
        self._rows.real.stand(position)
        self.stand_at(position)
        self._run = self.sought = None
        self.waiting, self.finished, self.has_caught_up = None, True, True

    def fill(self, *, one_block: bool = False) -> bool:
        """Let the channel run ahead, in single block by one block; false if it made nothing although it may go on."""
        self.one_block = one_block
        if self._rests() or self._suffices(LOW, one_block=one_block):
            return True
        before = len(self.items)
        for _ in range(BLOCKS_A_CYCLE):
            self._step()
            if self._rests() or self._suffices(FULL, one_block=one_block):
                break
        made = len(self.items) > before
        self.revised = self.revised or made
        return made or self._rests()

    def fill_on(self, *, one_block: bool = False) -> bool:
        """Let the channel run ahead by some blocks more, however much is prepared; false if it makes nothing."""
        before = len(self.items)
        for blocks in range(1, BLOCKS_AHEAD):
            if self._rests() or self._halts_ahead(one_block=one_block):
                break
            self._step()
            if blocks % BLOCKS_A_CYCLE == 0 and len(self.items) > before:
                break
        self.revised = self.revised or len(self.items) > before
        return len(self.items) > before

    def ends_with_piece(self, *, one_block: bool) -> bool:
        """Whether a row to come could still change the piece in front; the channel runs ahead until that is known.

        So what lies behind blocks that only calculate is prepared while the axes move, however many they are.
        """
        is_last = not self._rests() and self._buffer.may_change
        before, left = len(self.items), BLOCKS_AHEAD
        while is_last and left > 0 and not self._halts_ahead(one_block=one_block):
            self._step()
            is_last, left = not self._rests() and self._buffer.may_change, left - 1
        self.revised = self.revised or len(self.items) > before
        return is_last

    def row_to_rest_before(
        self, *, gated: bool, single_block: bool, stops: Callable[[Item], bool] | None, first: float = -inf
    ) -> float:
        """Number of the first row ahead before which the axes shall rest by what the operator has set; inf for none.

        Rows before `first` do not count: the axes cannot come to rest there any more.
        """
        closed = False
        for item in self.items if gated or single_block or stops is not None else ():
            closed = closed or (stops is not None and stops(item))
            if isinstance(item, Block):
                closed = closed or gated
            elif isinstance(item, BlockEnd):
                closed = closed or single_block
            elif isinstance(item, Move) and closed:
                if item.row >= first:
                    return item.row
                closed = False
        return inf

    def _suffices(self, items: int, *, one_block: bool) -> bool:
        """Whether so much is prepared, and enough for bounds that reach back; or where single block will halt."""
        if self._halts_ahead(one_block=one_block):
            return True
        prepared = len(self.items)
        return prepared > items and (self._buffer.reaches or prepared > MOST - FULL + items)

    def _halts_ahead(self, *, one_block: bool) -> bool:
        """Whether single block will halt behind what is prepared."""
        typed_in = self.channel.stack and self.channel.level.kind is LevelKind.TYPED_IN
        return one_block and not typed_in and any(isinstance(item, BlockEnd) for item in self.items)

    def _rests(self) -> bool:
        """Whether the channel does not go on by itself."""
        return self.finished or self.waiting is not None

    @property
    def is_alone(self) -> bool:
        """Whether no other channel has been spoken of."""
        return self.channel.group is None or len(self.channel.group.channels) == 1

    @property
    def begins_anew(self) -> bool:
        """Whether a block begins next, or one that has waited for everything before it."""
        if self.items:
            return isinstance(self.items[0], Block)
        return self.waiting is not None and self.waiting.reason is Why.PREPROCESSING

    @property
    def is_bare(self) -> bool:
        """Whether nothing of what a waiting program does next is prepared, nor read ahead for compensation."""
        done = all(isinstance(item, BlockEnd) for item in self.items)
        return done and not self.finished and not self.channel.path.changes_ends

    def intervene(self, program: Program) -> None:
        """Blocks that were typed in come before what the waiting program does next, of which nothing is prepared."""
        self.items.clear()
        self.channel.push(program, kind=LevelKind.TYPED_IN, local=self.channel.level.locals)

    @property
    def typed_blocks_end(self) -> bool:
        """Whether nothing comes any more of the blocks that were typed in."""
        return not self.items and self.waiting is TYPED_BLOCKS_DONE

    def end_in_rest(self, *, is_all: bool = False) -> None:
        """The axes come to rest behind what is prepared; `is_all`: for no other reason than that nothing follows."""
        (self._buffer.end_here if is_all else self._buffer.end_in_rest)()

    def reopen(self) -> bool:
        """More may be prepared behind a row than when it began; whether there is, and nothing asks for a rest there."""
        if not self._buffer.reopen():
            return False
        self.fill()
        if any(isinstance(item, Move) for item in self.items):
            return True
        self._buffer.end_here()
        return False

    def refuse(self, error: AlarmError) -> None:
        """What is prepared cannot be executed: an alarm is in its place."""
        self.clear(self.position)
        self.fail(error)

    def fail(self, error: AlarmError) -> None:
        """The run of the channel ends with an alarm that did not arise in a block."""
        self.channel.fail(error)
        self.toolpath.block_boundary()
        self.waiting, self.finished = None, True

    def proceed(self) -> None:
        """What the channel waited for has happened, and everything before it is executed."""
        self.waiting, self.has_caught_up = None, True

    def release(self) -> bool:
        """The channel need not wait for what is prepared: what it asks for is read now. Whether it has waited."""
        waits = self.waiting is PREPROCESSING and not self.finished
        if waits:
            self.proceed()
        return waits

    def note(self, event: Event, block: Block | None) -> None:
        """Keep an event that the main run itself has put out among the rows; it is executed already."""
        context = self.channel.context_number()
        program = self.toolpath.program_number(block.program) if block is not None else 0
        position = self.channel.coordinates.position
        self._is_noting = True
        self.toolpath.append_event(event, program, block.line if block is not None else 0, context, position)
        self.toolpath.block_boundary()
        self._is_noting = False

    def cut(self, row: float) -> None:
        """The rest of a row is dropped; where it ends is known when the axes stand."""
        self._cut = int(row)

    def place_axis(self, column: int, position: float) -> None:
        """An axis is elsewhere than the rows have led it."""
        self._buffer.move_axis(column, position, self._rows.context, self._geometry)

    @property
    def returns_to_path(self) -> bool:
        """Whether cycle start leads axes back that were moved by hand."""
        return self._settings.returns_to_path

    @property
    def geometry(self) -> Geometry:
        """Columns of X, Y and Z of the machine."""
        return self._geometry

    @property
    def position(self) -> list[float]:
        """Machine position behind everything prepared."""
        return self._buffer.position

    def arrived(self, position: Sequence[float], by_hand: Sequence[float] = ()) -> None:
        """Tell the channel that the axes have come to rest elsewhere than its rows have led them.

        `by_hand` is what an operator has moved of it.
        """
        self.stand_at(position)
        real = real_of(position, self._rows.context, self._geometry)
        self.channel.coordinates.arrive_machine(real)
        if self._cut >= 0:
            self.toolpath.set_end(self._cut, self.channel.coordinates.position)
            self._cut = -1
        coordinates = self.channel.coordinates
        programmed = self.channel.path.programmed(coordinates.position)
        if programmed != coordinates.position:
            coordinates.arrive(programmed)
        self.channel.moved_by_hand = MovedByHand(tuple(real), tuple(by_hand)) if by_hand else None

    def stand_at(self, position: Sequence[float]) -> None:
        """The axes stand elsewhere than the rows have led them."""
        self._buffer.stand_at(position)

    def _step(self) -> None:
        """Run the channel to its next wait."""
        channel, is_next, held = self.channel, self.stop_behind_next, len(self.toolpath.chunk)
        wait = next(self._run, None) if self._run is not None else None
        level = channel.stack[-1] if channel.stack else None
        if wait is not None and wait.reason is Why.SINGLE_BLOCK:
            self.last_block = wait.code if channel.finished else ""
        is_block = len(channel.toolpath.chunk) > held or (wait is not None and wait.reason in BEHIND_A_BLOCK)
        if level is not None and (is_block or self._is_sought(level)):
            halts = wait is not None and wait.reason is Why.SINGLE_BLOCK and not channel.finished
            line, code = level.line_of(level.current), wait.code if halts and wait is not None else ""
            key = level.program_number, line
            changed = channel.context if halts and channel.context_is_new else None
            self._blocks.note(
                key, BlockEnd(code or (str(line) if halts else ""), changed), channel.mode.codes,
                channel.takes_back, callers_of(channel.stack), is_part=level.kind is LevelKind.SHAPE,
            )  # fmt: skip
            channel.takes_back = NOTHING_BACK
        self._stopped = self._rows.skips = self.has_caught_up = False
        if (
            is_next
        ):  # not behind the block that asks for it: what stages hold there belongs to blocks in front
            channel.flush()
        acts = is_next and acts_on_machine(
            self.toolpath.chunk, waits=wait is not None and wait.reason in BEHIND_A_BLOCK
        )
        if is_next or not waits_for_move(channel, wait):
            self.toolpath.block_boundary()
        if self.on_step is not None:
            self.on_step()
        if wait is None:
            self._end_waits()
            self._blocks.close()
            self.finished = True
        elif channel.path.head is None:
            self._blocks.close()
        if wait is not None and wait.reason not in PASSING and (wait.reason is not Why.STOP or self._stopped):
            self.waiting = wait
        elif self._rows.skips:
            self.waiting = PREPROCESSING
        if acts:
            self.waiting = self.waiting or PREPROCESSING
            self.stop_behind_next = False
        if self._rests():
            self.end_in_rest()

    def _is_sought(self, level: Level[Any]) -> bool:
        """Whether a search looks for the block that has run, which may have no rows."""
        if self.sought is None:
            return False
        return self.sought == (self.toolpath.programs[level.program_number], level.line_of(level.current))

    # ---- rows ----------------------------------------------------------------------------------------------

    def end_held_block(self) -> None:
        """The rows written last end a block that a stage has held back: those that come are of another one."""
        self.toolpath.block_boundary()
        self._blocks.end_held_block()

    def _take(self, chunk: Chunk) -> bool:
        """Turn the rows of a block into items."""
        if self._is_noting:
            return True
        self._add_contexts()
        self._take_over()
        self._rows.real.go_on_from(self._buffer.position)
        bounds = self._rows.real.bounds(chunk, self.toolpath.contexts)
        self._delays.clear()
        self._waits.take(chunk, self._rows.facing)
        beside, self._waits.parallel[:] = list(self._waits.parallel), []
        contexts = self.toolpath.contexts
        for row in range(len(chunk)):
            number, context, kind = chunk.first + row, contexts[chunk.context[row]], chunk.kind[row]
            delays = self._delays.get(number, [])
            event = chunk.events[chunk.curve[row]] if kind == Kind.EVENT else None
            self._blocks.enter((chunk.program[row], chunk.line[row]), is_silent=is_silent(event))
            if isinstance(event, Auxiliary | BuilderCode):
                delays = without_function(delays, event)
            self.items.extend(self._delayed.item(delay, context) for delay in delays)
            if event is not None:
                stands = self._waits.stands_at(chunk, row)
                self.items.append(Happening(event, context, stands))
                if stands:
                    self.end_in_rest()
                for column, place in event.places if isinstance(event, Deed) else ():
                    self.place_axis(column, place)
                self._stopped = self._stopped or isinstance(event, Stop)
            elif kind == Kind.DWELL:
                self.end_in_rest()
            else:
                self._rows.lay(chunk, row, bounds)
            beside, outlasts = self._rows.go_on_beside(beside, chunk, row, bounds)
            if outlasts:  # the axes rest behind a block that a function beside it outlasts
                self.end_in_rest()
        return True

    def _take_over(self) -> None:
        """An axis that another channel has moved since is where that one has left it."""
        for column, position in self._machine_axes.taken_over(self._number, self.channel.group):
            self.place_axis(column, position)

    def _end_waits(self) -> None:
        """The program is at its end: an exact stop in its last row waits for its window."""
        self._delays.clear()
        self._waits.settle(0)
        context = self._rows.context
        self.items.extend(self._delayed.item(delay, context) for delay in self._delays.get(0, []))

    def _delay(self, row: int, why: str, _context: int, seconds: float) -> None:
        if seconds > 0.0:
            self._delays.setdefault(row, []).append((why, seconds))

    def _note_step(self, step: Step) -> None:
        self._delays.setdefault(step.row, []).append(step)

    def _lag(self) -> float:
        """Seconds by which the axes of the thread in front are behind its spindle, up to speed."""
        if self.ends_with_piece(one_block=self.one_block):
            self.end_in_rest()
            self.revised = True
        return self._buffer.lag

    def turn_spindle(self, context: Context, override: float, time: float) -> None:
        """From a time on an override acts on the spindle of a context, whose angle counts for threads."""
        for angle in self._waits.angles.values():
            angle.turn_with(context.spindle_factor(override), time)

    def _add_contexts(self) -> None:
        for context in self.toolpath.contexts[self._known_contexts :]:
            spindle = self._waits.spindle(context)
            turning = (context.spindle, context.spindle_rpm, context.spindle_direction, context.surface_speed)
            smoothing = self._buffer.tables.smoothing(context, self._machine, self._settings)
            key = (context.tool, context.tool_name, *turning, smoothing)
            station = self._stations.setdefault(key, len(self._stations))
            self._buffer.tables.add(context, self._axes, spindle, station, self._settings, smoothing)
            self._known_contexts += 1

    # ---- speeds --------------------------------------------------------------------------------------------

    def revise(
        self,
        rates: ChannelRates,
        cap2: float,
        *,
        gated: bool,
        single_block: bool,
        stops: Callable[[Item], bool] | None,
    ) -> None:
        """Work out how fast each piece may be entered, so that all that follow can be run.

        Args:
            rates: Overrides.
            cap2: Largest squared speed on the piece that runs now.
            gated: An auxiliary function is running: the next block must wait.
            single_block: Every block ends in a halt.
            stops: Says in front of which items the axes stand for another reason.
        """
        self._buffer.plan(partial(self._entries, rates, cap2, gated, single_block, stops))
        self.revised = False

    def _entries(
        self, rates: ChannelRates, cap2: float, gated: bool, single_block: bool, stops: Callable[[Item], bool] | None,
        records: array[float], width: int,
    ) -> Iterator[tuple[int, float, Limits]]:  # fmt: skip
        """Of each piece the largest squared speed at its start, by what the operator has set, and its limits."""
        at, closed, end, asked = 0, False, len(records), self.queue.asked
        for item in self.items:
            closed = closed or (stops is not None and stops(item))
            if isinstance(item, Block):
                closed = closed or gated
            elif isinstance(item, BlockEnd):
                closed = closed or single_block
            elif isinstance(item, Move):
                row = records[at + PieceRecord.ROW]
                while at < end and records[at + PieceRecord.ROW] == row:
                    laid2 = records[at + PieceRecord.CAP2]
                    own = rates.cap2(item, laid2, asked(item, laid2, records[at + PieceRecord.ASKED]))
                    entry2 = 0.0 if closed else min(records[at + PieceRecord.ENTRY2], cap2, own)
                    yield at, entry2, item.limits
                    cap2, closed = own * risen(records, at), False
                    at += width

    @property
    def reach2(self) -> float:
        """Largest squared speed at which the next piece may be entered; 0 where none is prepared."""
        return self._buffer.reach2

    @property
    def ways_to_rest(self) -> tuple[float, float]:
        """Way of the pieces ahead up to where the axes shall rest, and up to where they rest in any case, mm."""
        return self._buffer.ways_to_rest

    @property
    def early(self) -> float:
        """Seconds by which the next piece may begin before the axes rest."""
        return self._buffer.early

    @property
    def contexts(self) -> array[float]:
        """What the kernels know of the contexts of cuts and rapids."""
        return self._buffer.contexts

    def front_cap2(self, rates: ChannelRates) -> float:
        """Largest squared speed on the piece in front."""
        move = self.items[0]
        assert isinstance(move, Move)
        laid2, asked = self._buffer.front(PieceRecord.CAP2), self._buffer.front(PieceRecord.ASKED)
        return rates.cap2(move, laid2, self.queue.asked(move, laid2, asked))

    def begin_elsewhere(self, move: Move | Piece, start: Sequence[float]) -> None:
        """The rest of a row goes to its end from another start; the axes rest at both."""
        while self.items and isinstance(self.items[0], Move) and self.items[0].row == move.row:
            self.queue.pop_piece()
        self.queue.keep_to_corner()
        use, size = self._rows.use_of(move.kind, move.context), ContextRecord.OFFSETS + self._axes
        fields = self._buffer.context_fields(self.toolpath.context_number(move.context), size, use)
        records, moves = line_from(move, start, fields, self._rows.real.limits(None, use))
        self._buffer.put_in_front(records)
        self.items.extendleft(moves)

    @property
    def axes(self) -> int:
        """Number of axes."""
        return self._axes
