"""The interpreter: runs the blocks of a program ahead and writes their motion and events into the toolpath.

`run()` gives a `Wait` when something outside must happen first (an operator's start after M00, a chunk to be taken) and
goes on when the next one is asked for. It knows no control: blocks are callables that a control's
language compiled, and what differs between controls lies behind `Control`.
"""

from __future__ import annotations

from math import nan

from polycnc.channel.coordinates import Coordinates
from polycnc.channel.family import ControlT_co, MemoryT_co, ProgramT_co
from polycnc.channel.intervention import NOTHING_BACK, MovedByHand
from polycnc.channel.mode import Mode, ModeTable
from polycnc.channel.moves.path import Move, Path, PlacedEvent
from polycnc.channel.moves.travel import TravelGuard, check_straight, check_travel, limits_of
from polycnc.channel.run import Run
from polycnc.channel.stack import Level, LevelKind
from polycnc.channel.states.state import Lifetime, States, end_of
from polycnc.channel.view import Prepared
from polycnc.channel.waits import (
    BLOCK,
    CHUNK,
    CLOCK,
    PREPROCESSING,
    TYPED_BLOCKS_DONE,
    PreprocessingStop,
    Wait,
    Why,
)
from polycnc.deferred.contexts import contextmanager
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING, ClassVar, Generic
from polycnc.geometry.tolerances import FARTHEST
from polycnc.memory.retained import InMemoryStore
from polycnc.messages import AlarmError
from polycnc.toolpath import NO_CURVE, Context, Event, Kind, Toolpath
from polycnc.toolpath.events import Auxiliary, Stop
from polycnc.toolpath.table import CHUNK_ROWS, is_way

with loaded_when_called():
    from polycnc.channel import failure

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from polycnc.channel.group import ChannelGroup
    from polycnc.channel.interface import Boundary, Bulk, MainRun, Scanner
    from polycnc.channel.interpolator import Interpolator
    from polycnc.channel.moves.times import MoveTimes
    from polycnc.channel.states.passes import Passes
    from polycnc.channel.states.standstill import Standstill
    from polycnc.channel.steps import Step
    from polycnc.channel.view import View
    from polycnc.geometry.frames import Vector
    from polycnc.machine.model import Axis, Machine
    from polycnc.machine.setup.values import Setup
    from polycnc.memory.retained import RetainedStore
    from polycnc.messages import Alarm
    from polycnc.program import Program
    from polycnc.program.store import ProgramStore
    from polycnc.transformation.orientation.turning import Turning

DEFAULT_BLOCK_LIMIT = 100_000_000
#: A simulated control prepares a block as a whole; one with more rows is taken for a mistake.
MOST_ROWS_OF_A_BLOCK = 1_000_000
#: More turns than any control can be told to make by one word (SINUMERIK: 999).
MOST_TURNS = 1_000
#: Blocks that run between two looks at the block limit.
BURST = range(4096)


class Channel(Generic[ControlT_co, MemoryT_co, ProgramT_co]):
    """One channel of a control: state, program stack, and the way of its moves.

    Attributes:
        mode: Active codes of all modal groups.
        coordinates: Positions and frames.
        feed: Feed in force in internal units (mm/s, mm/rev, 1/s as the feed mode says), NaN when none was programmed.
        level: The running program level, `stack[-1]`.
        running: The run that was begun last; None before the first one.
        limits: Lowest and highest machine position of every axis; nothing where no axis has a limit.
        stands_at: Machine position at the beginning of the run; of the running block, where somebody executes it.
        path: The stages that moves pass on their way to the toolpath.
        mark: Rows of the chunk when the running block began.
        control: The control. Handlers of a family know its class: `channel.family`.
        single_block: Hand over behind every block at which single block operation halts.
        inner_halts: Blocks at which single block halts inside the block that runs, before its end.
        takes_back: What the running block takes back of a manual intervention.
        off_path: The running block is a call or a return and nothing else, or block skip leaves it out: for stages
            that look ahead it is no block.
        moved_by_hand: The last intervention in front of a block that was not prepared yet.
        block_by_block: With it, behind every other block too.
        is_searched: A block is searched, without motion; `is_tested`: the program runs while the axes stand.
        main_run: What executes the rows while the channel runs; None where nobody waits for that.
        actual: Where its axes are now.
        move_times: How long single moves take; None where a clock runs, which knows.
        turning: How the rotary axes go along the moves of the running block; None where they go evenly. A stage of
            the path must lead them (`moves/turning.py`).
        group: The channels of the control, which the first one belongs to as well; None where it runs alone.
        boundary: What moves must keep to beside the travel of the axes; None for nothing.
        memory: The control's own state (variables, offsets, tools), set by `Control.start`.
        retained: What outlives the channel; a new one in memory where nobody gives another.
        states: The states that features own, one of each class; see `State.of`.
        burst: Blocks that are interpreted between two looks at what is rare.
        passes: What ends a main program that would begin again for ever; None where somebody else ends it.
        standstill: What ends a loop that waits for ever; None where somebody else ends it.
        bulk: Whether and how plain blocks are scanned in bulk; None interprets every block.
    """

    is_searched = is_tested = False
    #: A snapshot of the channel does not go on to these: they are none of its state.
    UNFOLLOWED: ClassVar = frozenset({
        "actual", "axis_data", "blocks", "bulk", "burst", "control", "machine", "main_run", "mark", "setup",
        "move_times",
    })  # fmt: skip

    def __init__(
        self,
        control: ControlT_co,
        machine: Machine,
        setup: Setup,
        store: ProgramStore,
        *,
        number: int = 1,
        block_limit: int = DEFAULT_BLOCK_LIMIT,
        toolpath: Toolpath | None = None,
        bulk: Bulk | None = None,
        retained: RetainedStore | None = None,
    ) -> None:
        self.control = control
        self.machine, self.setup, self.store = machine, setup, store
        self.retained: RetainedStore = InMemoryStore() if retained is None else retained
        self.number = number
        definition = machine.channel(number)
        self.axes: tuple[str, ...] = definition.names
        self.axis_index = {name: i for i, name in enumerate(self.axes)}
        self.axis_data: tuple[Axis, ...] = tuple(machine.axis[name] for name in definition.axes)
        start = control.start_position(self, [setup.start.get(name, 0.0) for name in self.axes])
        self.coordinates = Coordinates(self.axes, machine.geometry_indices(number), start)
        self.stands_at = self.coordinates.machine
        self.toolpath = Toolpath(self.axes) if toolpath is None else toolpath
        self.modes = ModeTable()
        self.mode: Mode = self.modes.mode({})
        self.feed = nan
        self.stack: list[Level[ProgramT_co]] = []
        self._level: Level[ProgramT_co]
        self.path = Path(self, TravelGuard(self))
        self.memory: MemoryT_co = None  # type: ignore[assignment]  # made by `Control.start`
        self.states = States(self)
        self.alarms: list[Alarm] = []
        self._finished = self.attention = self.off_path = self.block_by_block = False
        self.mark = self.blocks = self.skip_levels = 0
        self.block_limit, self.burst = block_limit, BURST
        self.joined_below = block_limit - 2 * len(BURST)  # joined steps go no further: the limit is exact
        self._wait: Wait | None = None
        self.running: Run | None = None
        self.turning: Turning | None = None
        self.group: ChannelGroup | None = None
        self.boundary: Boundary | None = None
        self.single_block = bool(setup.switches.single_block)
        self.inner_halts: list[str] = []
        self.takes_back = NOTHING_BACK
        self.moved_by_hand: MovedByHand | None = None
        self.main_run: MainRun | None = None
        self.actual: View = Prepared(self.coordinates)
        self.move_times: MoveTimes | None = None
        self.passes: Passes | None = None
        self.standstill: Standstill | None = None
        self.optional_stop = setup.switches.optional_stop
        self._context, self._context_changed = 0, True
        self.limits = limits_of(self.axis_data)
        self._executables: dict[int, ProgramT_co] = {}
        self.bulk = bulk
        self._scanner: Scanner | None = None

    # ---- what the inner loop must notice --------------------------------------------------------------------------

    @property
    def level(self) -> Level[ProgramT_co]:
        """The running program level."""
        return self._level

    @level.setter
    def level(self, level: Level) -> None:
        self._level = level
        self.attention = True

    @property
    def finished(self) -> bool:
        """Whether the run is over."""
        return self._finished

    @finished.setter
    def finished(self, finished: bool) -> None:
        self._finished = finished
        self.attention = True

    @property
    def wait(self) -> Wait | None:
        """What the channel will wait for after the running block."""
        return self._wait

    @wait.setter
    def wait(self, wait: Wait | None) -> None:
        self._wait = wait
        self.attention = True

    # ---- program stack -------------------------------------------------------------------------------------------

    def executable(self, program: Program) -> ProgramT_co:
        """The compiled form of a program; each program is compiled once."""
        key = id(program)
        if key not in self._executables:
            code: ProgramT_co = self.control.compile(program)  # type: ignore[assignment]  # of its family
            self._executables[key] = code
        return self._executables[key]

    def forget_programs(self) -> None:
        """Programs are read anew: what they were compiled to may belong to a memory that is no more."""
        self._executables.clear()

    @property
    def programs(self) -> list[Program]:
        """Every program of this run, in the order of their first use."""
        return [executable.program for executable in self._executables.values()]

    def push(
        self, program: Program, *, kind: LevelKind, repeats: int = 0, index: int = 0, local: object = None
    ) -> Level[ProgramT_co]:
        """Call a program: it runs next, `repeats` more times after the first pass."""
        name = self.toolpath.program_number(program.name)
        code = self.executable(program)
        level = Level(code, index, index, name, repeats, index, kind, local)
        level.scanner = self._scanner_for(level)
        self.stack.append(level)
        self.level = level
        return level

    def _scanner_for(self, level: Level) -> Scanner | None:
        """What scans the plain blocks of a program; None where that does not pay."""
        return self.scanner() if self.bulk is not None and self.bulk.pays(len(level.steps)) else None

    def scanner(self) -> Scanner | None:
        """What scans plain blocks, if anything does."""
        if self._scanner is None and self.bulk is not None:
            self._scanner = self.bulk.scanner(self)
        return self._scanner

    def pop(self) -> Level[ProgramT_co]:
        """End the running level; the level below becomes the running one."""
        ended = self.stack.pop()
        if ended.kind is LevelKind.TYPED_IN:
            self.wait = TYPED_BLOCKS_DONE
        if self.stack:
            self.level = self.stack[-1]
        else:
            self.finished = True
        return ended

    def synchronise(self) -> None:
        """A preprocessing stop: the running block waits for the main run, and begins again without its rows.

        Raises:
            PreprocessingStop: The main run is behind. Where a stage holds moves, the block must have done nothing yet.
        """
        if self.main_run is None:
            self.toolpath.rest(None if self.path.head else self.mark)
        elif not self.main_run.has_caught_up:
            raise PreprocessingStop

    def on_clock(self) -> Interpolator:
        """What executes the rows in time: the running block, which has done nothing yet, waits until something does.

        Raises:
            PreprocessingStop: Nobody executes them so far.
        """
        clocked = self.actual.clocked
        if clocked is None:
            self.wait = CLOCK
            raise PreprocessingStop
        return clocked

    @property
    def row_position(self) -> list[float]:
        """The position as a row would hold it: that of the axes where the path leads them."""
        c = self.coordinates
        if c.transformation is None or not self.path.leads_axes:
            return c.position
        return c.transformation.to_machine(c.position)

    def begin_again(self) -> None:
        """The main program goes to its top."""
        if self.passes is not None:
            self.passes.begin_again(self)

    def end(self) -> None:
        """The program is over (M02, M30): everything held back is written, nothing more runs.

        Where a stage has changed the path (compensation that is still on) the tool stands where that has led it.
        """
        is_changed = self.path.changes_ends
        self.flush()
        if is_changed:
            failure.stand_at_last_row(self)
        self.finished = True

    # ---- running -------------------------------------------------------------------------------------------------

    def run(
        self, program: Program, *, power_on: bool = True, enter: Callable[[Channel], None] | None = None
    ) -> Run:
        """Run a program to its end or to an alarm: an iterator that gives every wait of the channel.

        Args:
            program: The main program.
            power_on: Begin in the state of power-on; else in the state that the channel is in.
            enter: Called at the first block: it may begin at another one.
        """
        self.running = Run(self, program, power_on=power_on, enter=enter)
        return self.running

    def begin(self, program: Program, *, power_on: bool) -> None:
        """Stand at the first block of a program; `run` calls it."""
        self.stack.clear()
        self.finished = False
        self.push(program, kind=LevelKind.MAIN)
        try:
            end_of(self, Lifetime.POWER if power_on else Lifetime.PROGRAM)
            (self.control.start if power_on else self.control.begin)(self)
            self.stands_at = self.coordinates.machine
        except AlarmError as error:
            self.fail(error)
        except ArithmeticError as error:
            self.fail(self.control.arithmetic_alarm(error))

    def advance(self) -> Wait | None:
        """Run blocks until the channel has to hand over; None where it has finished, or was stopped by an alarm."""
        toolpath = self.toolpath
        self.mark = toolpath.mark()
        try:
            while not self._finished:
                level = self._level
                self._look_up(level, self._run_burst(level))
                if self.mark >= CHUNK_ROWS:
                    toolpath.block_boundary()
                    self.mark = 0
                    self._wait = self._wait or CHUNK
                if self._wait is not None:
                    wait, self._wait = self._wait, None
                    return wait
        except AlarmError as error:
            failure.take_back(self, found_ahead=bool(error.line))
            self.fail(error)
        except PreprocessingStop:
            failure.begin_again(self)
            wait, self._wait = self._wait or PREPROCESSING, None
            return wait
        except ArithmeticError as error:
            failure.take_back(self)
            self.fail(self.control.arithmetic_alarm(error))
        except RecursionError:
            failure.take_back(self)
            self.fail(AlarmError("PC0003"))
        return None

    def _run_burst(self, level: Level) -> Step | None:
        """Run blocks of a level until something asks for attention; gives the last one.

        This loop is the hottest of the interpreter: whatever is rare (a call, a return, a wait, a stage in the path,
        the end) sets `attention`, and only that is asked after every block.
        """
        burst, is_executed = self._burst(level), self.main_run is not None
        steps, kinds, step = level.steps, self.toolpath.chunk.kind, None
        self.attention = self.path.head is not None or self.single_block
        for _ in burst:
            index = level.index
            step = steps[index] if index < len(steps) else None
            if step is None:
                level.current = index
                self.mark = len(kinds)
                step = level.code.step(index, alone=self.single_block)
                if step is None:
                    self.control.end_of_program(self)
                    break
            if self.single_block:
                step = getattr(step, "alone", step)
            level.current = index
            level.index = index + 1
            self.mark = len(kinds)
            if is_executed and self.path.head is None:  # what a stage holds back is not there yet
                self.stands_at = self.coordinates.machine
            step(self)
            self.blocks += 1
            if self.attention:
                break
        return step

    def _look_up(self, level: Level, step: Step | None) -> None:
        """What must be seen to between bursts: stages that count blocks, single block, the block limit."""
        if self.path.head is not None and not self.off_path and level.counts(level.current):
            self.path.head.block()
        self.off_path = False
        if self.single_block and step is not None:
            if self.control.halts(self, level, step):
                self._wait = self._wait or Wait(Why.SINGLE_BLOCK, level.block_name())
            elif self.block_by_block:
                self._wait = self._wait or BLOCK
        self.mark = self.toolpath.end_block()
        if self.blocks >= self.block_limit:
            raise self.control.block_limit()
        if self.standstill is not None and self.blocks >= self.standstill.next_look:
            self.standstill.look(self)

    def _burst(self, level: Level) -> range:
        """Scan plain blocks; gives as many numbers as blocks are to be interpreted now."""
        burst = self.burst if level.scanner is None else level.scanner.lead(self)
        return burst[: self.block_limit - self.blocks]

    def once_more(self) -> None:
        """A block does its work once more (a hole, some pecks, a pass, a turn): that counts as a block.

        So a limit of blocks holds inside a block too, and the rows of a block need not fit into memory: where they
        fill a chunk, what is done is handed on and stays, as on the machine.

        Raises:
            AlarmError: The block limit is reached.
        """
        self.blocks += 1
        self.attention |= self.blocks > self.joined_below  # those behind it run with the limit in sight
        rows, is_executed = len(self.toolpath.chunk.kind), self.main_run is not None
        if (is_executed and rows >= MOST_ROWS_OF_A_BLOCK) or self.blocks >= self.block_limit:
            raise self.control.block_limit()
        if rows >= CHUNK_ROWS and not is_executed:
            self.keep_rows()
            self.toolpath.block_boundary()
            self.mark = 0
            self.attention = True

    def halt_inside(self, line: int = 0) -> None:
        """Single block halts here, inside the block; `line` is that of another block that it executes."""
        if self.single_block:
            self.inner_halts.append(self.level.block_name(line))

    def keep_rows(self) -> None:
        """What the running block has written stays even if it alarms from here on."""
        self.flush()
        self.mark = self.toolpath.mark()

    def flush(self) -> None:
        """Pass on every move that a stage still holds back."""
        if self.path.head is None:
            return
        try:
            self.path.flush()
        except AlarmError as error:
            failure.take_back(self, found_ahead=True)
            self.fail(error)

    def fail(self, error: AlarmError) -> None:
        """End the run with an alarm."""
        failure.end_run(self, error)

    # ---- writing -------------------------------------------------------------------------------------------------

    @property
    def context_is_new(self) -> bool:
        """Whether the next row gets a context that is still to be worked out."""
        return self._context_changed

    @property
    def line(self) -> int:
        """Line of the running block, from 1."""
        return self._level.code.line(self._level.current)

    def context_changed(self) -> None:
        """Something that a context holds has changed; the next row gets a new context."""
        self._context_changed = True

    @contextmanager
    def under(self, context: Context) -> Iterator[None]:
        """Moves meanwhile have a context of their own."""
        self._context, self._context_changed = self.toolpath.context_number(context), False
        yield
        self._context_changed = True

    @property
    def context(self) -> Context:
        """The context that holds now; an alarm of the setup comes before there is a state that one could tell of."""
        return Context() if self.memory is None else self.control.context(self)

    def context_number(self) -> int:
        """Number of the context that holds now."""
        if self._context_changed:
            self._context = self.toolpath.context_number(self.context)
            self._context_changed = False
        return self._context

    def straight(
        self, kind: Kind, end: list[float], feed: float, programmed: list[float] | None = None
    ) -> None:
        """Move to `end` (absolute display, all axes) in a straight line. No way, no row.

        Raises:
            OverflowError: The end is beyond all machines.
        """
        coordinates = self.coordinates
        start = coordinates.position
        if end != start and is_way(start, end):
            if not -FARTHEST < sum(end) < FARTHEST:
                raise OverflowError("a target that no machine has")
            level = self._level
            context = self._context if not self._context_changed else self.context_number()
            line, head = level.line_of(level.current), self.path.head
            if head is None:
                if self.limits or self.boundary is not None:
                    check_straight(self, kind, start, end)
                self.toolpath.chunk.add(kind, level.program_number, line, context, feed, end, NO_CURVE)
            else:
                move = Move(kind, start, end, feed, level.program_number, line, context)
                move.turning = self.turning
                head.move(move)
        if programmed is None and coordinates.direct:
            coordinates.position = coordinates.programmed = end
        else:
            coordinates.arrive(end, programmed)

    def curve(
        self,
        kind: Kind,
        end: list[float],
        feed: float,
        *,
        center: Vector | None = None,
        normal: Vector = (0.0, 0.0, 1.0),
        turns: float = 0.0,
        parameters: Sequence[float] = (),
        programmed: list[float] | None = None,
    ) -> None:
        """Move along an arc, or make another move with curve parameters (thread, tap, dwell).

        Raises:
            AlarmError: PC0002 for more full turns than a program can mean.
            OverflowError: The end or the centre is beyond all machines.
        """
        if turns > MOST_TURNS:
            raise AlarmError("PC0002", hint="hint.turns")
        if not -FARTHEST < sum(end) + (0.0 if center is None else sum(center)) < FARTHEST:
            raise OverflowError("a target that no machine has")
        level = self._level
        line = level.code.line(level.current)
        start = self.coordinates.position
        move = Move(
            kind, start, end, feed, level.program_number, line, self.context_number(), center, normal, turns,
            tuple(parameters), self.turning,
        )  # fmt: skip
        if self.path.head is None:
            check_travel(self, move)
            self.write(move)
        else:
            self.path.head.move(move)
        if kind != Kind.DWELL:
            self.coordinates.arrive(end, programmed)

    def write(self, move: Move) -> None:
        """Write a finished move as a row: what stands at the end of the path."""
        toolpath = self.toolpath
        if move.center is not None:
            number = toolpath.add_curve(*move.center, *move.normal, move.turns)
        elif move.parameters:
            number = toolpath.add_curve(*move.parameters)
        else:
            number = NO_CURVE
        toolpath.append(move.kind, move.program, move.line, move.context, move.feed, move.end, number)

    def event(self, event: Event) -> None:
        """Record an event in order with the moves."""
        level = self._level
        line = level.code.line(level.current)
        context = self.context_number()
        if self.path.head is None:
            end = self.coordinates.position
            self.toolpath.append_event(event, level.program_number, line, context, end)
            if isinstance(event, Auxiliary) and self.machine.goes_beside(event.code):
                self.toolpath.set_block_apart(self.mark)
                self.attention = True
        else:
            self.path.head.event(PlacedEvent(event, level.program_number, line, context))

    def stop(self, code: str) -> None:
        """A programmed stop: recorded, then the channel waits for a start."""
        self.event(Stop(code))
        self.wait = Wait(Why.STOP, code)

    def dwell(self, *, seconds: float = 0.0, revolutions: float = 0.0) -> None:
        """Stand still for a time or a number of spindle revolutions; nothing for zero."""
        if seconds > 0.0 or revolutions > 0.0:
            position = self.coordinates.position
            self.curve(Kind.DWELL, position, nan, parameters=(seconds, revolutions))
