"""Preparation: the channel runs ahead of the axes, and its rows become pieces of the path and events, in order.

The channel writes a block's rows; the planner's kernels (`motion/kernels`) lay them out as pieces with the speed
that the axes allow. What the program asks for is kept beside it, because overrides act on that alone.
"""

from __future__ import annotations

from array import array
from collections import deque
from math import inf, sqrt
from typing import TYPE_CHECKING, Any

from polycnc.channel.intervention import NOTHING_BACK, MovedByHand
from polycnc.channel.waits import PREPROCESSING, Wait
from polycnc.mainrun.anew import line_anew, parts_of
from polycnc.mainrun.geometry import Arc, arc_laid, line_laid, way_along
from polycnc.mainrun.items import Block, BlockEnd, Happening, Item, Piece, Rates, Standing
from polycnc.motion.frames import carried, real_of
from polycnc.motion.kernels.alone import settle_alone
from polycnc.motion.kernels.arcs import facing_radius
from polycnc.motion.kernels.columns import (
    BLEND,
    BLOCKS,
    CAP2,
    EARLY,
    ENTRY2,
    FACING,
    FORM,
    FREE,
    GEOMETRY,
    HOLD_WAY,
    LARGEST_OVERRIDE,
    LENGTH,
    LIMIT_BLOCKS,
    LOW2,
    LOW_PULL,
    OFFSETS,
    PAUSE,
    PER_REVOLUTION,
    PIECES,
    POSITION,
    RAMP,
    REACH2,
    ROW,
    ROW_LENGTH,
    SHARES,
    STATE_BLOCKS,
    STOP,
    STRAIGHT,
    SWEEP,
    TIMED,
    TOP2,
    WINDOW,
    Rows,
    piece_width,
)
from polycnc.motion.kernels.feeds import asked_speed, faster, follows_radius, is_rapid
from polycnc.motion.kernels.lay import lay
from polycnc.motion.kernels.speeds import backward
from polycnc.motion.limits import averages, context_fields
from polycnc.motion.transformed import Bounds, RealAxes
from polycnc.motion.waits import ORIENT, Waits
from polycnc.toolpath import Context, Kind, Toolpath
from polycnc.toolpath.kinds import ARC_KINDS
from polycnc.toolpath.table import CURVE_WIDTH

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.intervention import TakesBack
    from polycnc.machine.model import Machine
    from polycnc.machine.motion_settings import MotionSettings
    from polycnc.mainrun.geometry import Way
    from polycnc.mainrun.shared_axes import SharedAxes
    from polycnc.messages import AlarmError
    from polycnc.program import Program
    from polycnc.toolpath.table import Chunk

#: Items that are prepared at most, and at how few the channel is asked for more.
FULL, LOW = 512, 128
#: Items that are prepared at most where short pieces do not make up the way that a bound reaches (`hold.py`).
MOST = 4096
#: Blocks that the channel runs in one interpolation cycle while it makes no item.
BLOCKS_A_CYCLE = 1000
#: Waits of the channel behind a block that counts as one even without rows.
BEHIND_A_BLOCK = frozenset({"single-block", "stop"})
#: Waits of the channel that only let others look in.
PASSING = frozenset({"chunk", "block", "single-block"})


class Ahead:
    """What lies ahead of the axes.

    Args:
        machine: The machine.
        number: Number of the channel.
        left: Where channels leave the axes that they share.

    Attributes:
        items: What is prepared, in order.
        channel: The channel; set by `use` before anything runs.
        waiting: Why the channel does not go on until it is told to; None while it runs.
        finished: The program is at its end, or none runs.
        revised: The speeds ahead have to be worked out anew.
        has_caught_up: Everything that the channel has written is executed.
    """

    def __init__(self, machine: Machine, number: int, left: SharedAxes) -> None:
        self.toolpath = Toolpath(machine.channel_axes(number), chunk_rows=1, on_full=self._take)
        self.items: deque[Item] = deque()
        self._held: deque[Piece] = deque()  # those of the items that are pieces
        self._planned = array("d")
        self._way_ahead = 0.0  # of them, mm
        self._rests_ahead = 0  # those at whose start the axes rest
        self.channel: Channel
        self.waiting: Wait | None = None
        self.finished = True
        self.revised = False
        self.has_caught_up = False
        self._run: Iterator[Wait] = iter(())
        self._axes = len(self.toolpath.axes)
        self._width = piece_width(self._axes)
        self._settings: MotionSettings
        self.limits: array[float]
        self._machine, self._number = machine, number
        self._state = array("d", bytes(8 * (STATE_BLOCKS + BLOCKS * self._axes)))
        self._state[FREE] = 1.0
        self._state[LOW2] = self._state[LOW_PULL] = inf
        self._pieces = array("d", bytes(8 * self._width * 256))
        self._contexts = array("d")
        self._stations: dict[tuple[object, ...], int] = {}
        self._laid_contexts = 0
        self._delays: dict[int, list[tuple[str, float]]] = {}
        self._waits = Waits(machine, self.toolpath.contexts, 0, self._delay)
        self._blocks: deque[tuple[tuple[int, int], str, Mapping[str, str], TakesBack]] = deque()
        self._open: tuple[tuple[int, int], str] | None = None
        self._stopped = self._skips = False
        self._geometry = machine.geometry_indices(number)
        self._last_context, self._left = Context(), left
        self._real: RealAxes

    # ---- the channel ---------------------------------------------------------------------------------------

    def use(self, channel: Channel, settings: MotionSettings) -> None:
        """Say whose channel it is, and how the control leads the axes."""
        self.channel, self._settings = channel, settings
        self._waits.rapid_stops = settings.rapid_stops
        self._waits.stand_in(channel.setup.spindle_tool if channel.number == 1 else 0)
        channel.main_run = self
        self._real = RealAxes(self._machine, self._number, self.toolpath.axes, settings, ())
        self.limits = self._real.limits(None)

    def start(self, program: Program, position: Sequence[float]) -> None:
        """Begin with a program; the axes stand at a machine position."""
        self.channel.alarms.clear()
        self.begin(self.channel.run(program, power_on=False), position)

    def begin(self, run: Iterator[Wait], position: Sequence[float]) -> None:
        """Begin with a run of the channel; the axes stand at a machine position."""
        self.clear(position)
        self.finished = False
        self._run = run
        if self.channel.group is not None:
            self.channel.group.begin(self._number, run)

    def clear(self, position: Sequence[float]) -> None:
        """Forget everything prepared."""
        self.items.clear()
        self._held.clear()
        self._way_ahead, self._rests_ahead = 0.0, 0
        del self._planned[:]
        self._blocks.clear()
        self._open = None
        self._state[PIECES] = 0.0
        self._last_context = Context()
        self._real.stand(position)
        self.stand_at(position)
        self._run = iter(())
        self.waiting, self.finished = None, True

    def fill(self) -> bool:
        """Let the channel run ahead; false if it made nothing although it may go on."""
        if self._rests() or self._suffices(LOW):
            return True
        before = len(self.items)
        for _ in range(BLOCKS_A_CYCLE):
            self._step()
            if self._rests() or self._suffices(FULL):
                break
        made = len(self.items) > before
        self.revised = self.revised or made
        return made or self._rests()

    def _suffices(self, items: int) -> bool:
        """Whether so much is prepared, and enough for bounds that reach back."""
        return len(self.items) > items and (len(self.items) > MOST or self._reaches())

    def _rests(self) -> bool:
        """Whether the channel does not go on by itself."""
        return self.finished or self.waiting is not None

    def end_in_rest(self) -> None:
        """The axes come to rest behind what is prepared."""
        self._state[STOP] = 1.0
        settle_alone(self._pieces, self._axes, self.limits, self._state)

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

    @property
    def returns_to_path(self) -> bool:
        """Whether cycle start leads axes back that were moved by hand."""
        return self._settings.returns_to_path

    @property
    def position(self) -> list[float]:
        """Machine position behind everything prepared."""
        first = STATE_BLOCKS + POSITION * self._axes
        return list(self._state[first : first + self._axes])

    def arrived(self, position: Sequence[float], by_hand: Sequence[float] = ()) -> None:
        """Tell the channel that the axes have come to rest elsewhere than its rows have led them.

        `by_hand` is what an operator has moved of it.
        """
        self.stand_at(position)
        real = real_of(position, self._last_context, self._geometry)
        self.channel.coordinates.arrive_machine(real)
        self.channel.moved_by_hand = MovedByHand(tuple(real), tuple(by_hand)) if by_hand else None

    def stand_at(self, position: Sequence[float]) -> None:
        """The axes stand elsewhere than the rows have led them."""
        first = STATE_BLOCKS + POSITION * self._axes
        self._state[STOP] = 1.0
        self._state[first : first + self._axes] = array("d", position)

    def _step(self) -> None:
        """Run the channel to its next wait."""
        channel = self.channel
        wait = next(self._run, None)
        level = channel.stack[-1] if channel.stack else None
        if level is not None and (len(channel.toolpath.chunk) or (wait and wait.reason in BEHIND_A_BLOCK)):
            halts = wait is not None and wait.reason == "single-block" and not channel.finished
            self._note_block(level.program_number, level.line_of(level.current), wait if halts else None)
        self._stopped = self._skips = self.has_caught_up = False
        self.toolpath.block_boundary()
        if wait is None:
            self._close_blocks()
            self.finished = True
        elif channel.head is None:
            self._close_blocks()
        if wait is not None and wait.reason not in PASSING and (wait.reason != "stop" or self._stopped):
            self.waiting = wait
        elif self._skips:
            self.waiting = PREPROCESSING
        if self._rests():
            self.end_in_rest()

    # ---- blocks --------------------------------------------------------------------------------------------

    def _note_block(self, program: int, line: int, halt: Wait | None) -> None:
        """The channel has run a block; its rows may come later, if a stage of the path holds them back."""
        code = "" if halt is None else halt.code or str(line)
        channel = self.channel
        self._blocks.append(((program, line), code, channel.mode.codes, channel.takes_back))
        channel.takes_back = NOTHING_BACK

    def _enter_block(self, key: tuple[int, int]) -> None:
        """A row of a block comes: every block run before that one is over."""
        if self._open is not None and self._open[0] == key:
            return
        if not any(block[0] == key for block in self._blocks):
            return  # a row that a stage has added counts for the block before it
        self._end_block()
        while self._blocks:
            found, code, modal, back = self._blocks.popleft()
            self.items.append(Block(self.toolpath.programs[found[0]], found[1], modal, back))
            self._open = (found, code)
            if found == key:
                return
            self._end_block()

    def _end_block(self) -> None:
        if self._open is not None and self._open[1]:
            self.items.append(BlockEnd(self._open[1]))
        self._open = None

    def _close_blocks(self) -> None:
        """Nothing is held back: every block that was run is over."""
        if self._blocks:
            self._enter_block(self._blocks[-1][0])
        self._end_block()

    # ---- rows ----------------------------------------------------------------------------------------------

    def _take(self, chunk: Chunk) -> bool:
        """Turn the rows of a block into items."""
        self._add_contexts()
        self._take_over()
        bounds = self._real.bounds(chunk, self.toolpath.contexts)
        self._delays.clear()
        self._waits.take(chunk, int(self.limits[LIMIT_BLOCKS * self._axes + GEOMETRY]))
        self._waits.parallel.clear()
        contexts = self.toolpath.contexts
        for row in range(len(chunk)):
            self._enter_block((chunk.program[row], chunk.line[row]))
            number, context, kind = chunk.first + row, contexts[chunk.context[row]], chunk.kind[row]
            delays = self._delays.get(number, [])
            event = chunk.events[chunk.curve[row]] if kind == Kind.EVENT else None
            if event is not None and event.type == "m":
                delays = _without_function(delays, event.data.get("code"))
            self.items.extend(Standing(why, seconds, context) for why, seconds in delays)
            if event is not None:
                stands = self._waits.stands_for(event)
                self.items.append(Happening(event, context, stands))
                if stands:
                    self.end_in_rest()
                self._stopped = self._stopped or event.type == "stop"
            elif kind == Kind.DWELL:
                self.end_in_rest()
            else:
                self._lay(chunk, row, bounds)
        return True

    def _take_over(self) -> None:
        """An axis that another channel has moved since is where that one has left it."""
        first = STATE_BLOCKS + POSITION * self._axes
        for column, position in self._left.taken(self._number, self.channel.group):
            self._state[first + column] = position

    def _delay(self, row: int, why: str, _context: int, seconds: float) -> None:
        if seconds > 0.0:
            self._delays.setdefault(row, []).append((why, seconds))

    def _add_contexts(self) -> None:
        for context in self.toolpath.contexts[self._laid_contexts :]:
            spindle = self._waits.spindle(context)
            turning = (context.spindle, context.spindle_rpm, context.spindle_direction, context.surface_speed)
            smoothing = averages(context, self._machine, self._settings)
            key = (context.tool, context.tool_name, *turning, smoothing)
            station = self._stations.setdefault(key, len(self._stations))
            self._contexts.extend(
                context_fields(context, self._axes, spindle, station, self._settings, smoothing)
            )
            self._laid_contexts += 1

    def _lay(self, chunk: Chunk, row: int, bounds: Bounds) -> None:
        """Lay a move out as pieces. Its feed is FREE, so that the pieces know what the axes allow."""
        n, state, context = self._axes, self._state, self.toolpath.contexts[chunk.context[row]]
        self._enter_context(context)
        end, limits = chunk.end[row * n : (row + 1) * n], self._real.limits(context.transformation)
        own, shares = slice(row, row + 1), slice(row * SHARES, (row + 1) * SHARES)
        rows = Rows(
            chunk.kind[own], chunk.context[own], chunk.feed[own], end, chunk.curve[own], [],
            *(column[shares] for column in bounds.shares),
        )  # fmt: skip
        start, numbered = tuple(self.position), chunk.first + row
        while lay(rows, 0, chunk.curves, numbered, self._contexts, limits, self._pieces, state) == 0:
            self._pieces.frombytes(bytes(len(self._pieces) * 8))
        count = self._laid(numbered)
        if count == 0:
            return
        before = int(state[PIECES]) - count
        self._rests_ahead += self._pieces[before * self._width + PAUSE] > 0.0
        self._split(before)
        self._skips = self._skips or chunk.kind[row] == Kind.SKIP
        form = self._pieces[before * self._width + FORM]
        is_arc = chunk.kind[row] in (*ARC_KINDS, Kind.THREAD) and form != STRAIGHT
        way = arc_laid(start, state, limits, n) if is_arc else line_laid(start, state, n)
        self._add_pieces(chunk, row, way, before, count)

    def _add_pieces(self, chunk: Chunk, row: int, way: Way, before: int, count: int) -> None:
        """Make items of the last `count` records, the pieces of a row."""
        state, is_arc = self._state, isinstance(way, Arc)
        is_cut_short = chunk.kind[row] == Kind.SKIP and chunk.curve[row] >= 0
        record = chunk.context[row] * (OFFSETS + self._axes)
        total = sum(self._pieces[(before + part) * self._width + LENGTH] for part in range(count))
        done = 0.0
        for part in range(count):
            at = (before + part) * self._width
            share = self._pieces[at + LENGTH] / total
            asked = asked_speed(
                chunk.curves, self._contexts, record, state, state[ROW_LENGTH],
                self._radius(record, done + 0.5 * share, is_arc=is_arc),
            )  # fmt: skip
            self._add_piece(
                Piece(
                    way=way,
                    row=chunk.first + row,
                    length=self._pieces[at + LENGTH],
                    first=done,
                    share=share if part < count - 1 else 1.0 - done,
                    kind=chunk.kind[row],
                    context=self.toolpath.contexts[chunk.context[row]],
                    program=self.toolpath.programs[chunk.program[row]],
                    line=chunk.line[row],
                    entry2=self._pieces[at + ENTRY2],
                    cap2=self._pieces[at + CAP2],
                    asked=asked if asked > 0.0 else inf,
                    rapid=is_rapid(state),
                    fixed=chunk.kind[row] in (Kind.THREAD, Kind.TAP),
                    per_revolution=self._contexts[record + PER_REVOLUTION] != 0.0,
                    left=chunk.curves[chunk.curve[row] * CURVE_WIDTH]
                    if part == count - 1 and is_cut_short
                    else 0.0,
                    by_axis=self._pieces[at + FORM] == TIMED,
                    overridden=chunk.kind[row] == Kind.TAP and self._settings.taps_overridden,
                    held=chunk.kind[row] == Kind.TAP and self._settings.taps_held,
                    faster=faster(chunk.curves, state),
                    largest_override=self._largest_override(chunk, row),
                )
            )
            done += share

    def _largest_override(self, chunk: Chunk, row: int) -> float:
        """Of a tap, by its record of parameters; any for other moves."""
        if chunk.kind[row] != Kind.TAP or chunk.curve[row] < 0:
            return inf
        return chunk.curves[chunk.curve[row] * CURVE_WIDTH + LARGEST_OVERRIDE] or inf

    def _add_piece(self, piece: Piece) -> None:
        self._way_ahead += piece.length
        self.items.append(piece)
        self._held.append(piece)

    def _laid(self, number: int) -> int:
        """The number of pieces of the row laid last."""
        count, last = 0, int(self._state[PIECES]) - 1
        while last - count >= 0 and self._pieces[(last - count) * self._width + ROW] == number:
            count += 1
        return count

    def _split(self, count: int) -> None:
        """A new row may bound and cut pieces before it (`hold.py`): the first `count` records and items agree again."""
        width, held = self._width, self._held
        reach = max(self._pieces[k * width + HOLD_WAY] for k in range(count, int(self._state[PIECES])))
        at, way = count * width, 0.0
        fresh: list[Piece] = []
        while held and (way < reach or len(held) != at // width):
            piece, left, parts = held.pop(), 0.0, list[tuple[float, int]]()
            way += piece.length
            while not parts or left < piece.length * (1.0 - 1e-9):
                at -= width
                parts.insert(0, (self._pieces[at + LENGTH], at))
                left += self._pieces[at + LENGTH]
            pieces = list(parts_of(piece, parts, self._pieces))
            if len(parts) > 1:
                place = self.items.index(piece)
                del self.items[place]
                for part in reversed(pieces):
                    self.items.insert(place, part)
            fresh = [*pieces, *fresh]
        held.extend(fresh)

    def _enter_context(self, context: Context) -> None:
        """Where a transformation begins or ends, the path goes on from where the real axes are."""
        last, self._last_context = self._last_context, context
        if context.transformation is not last.transformation:
            self.stand_at(carried(self.position, last, context, self._geometry))

    def _radius(self, record: int, middle: float, *, is_arc: bool) -> float:
        """Turning radius at a share of the row laid last, as the planner takes it."""
        state, n = self._state, self._axes
        facing = int(self.limits[LIMIT_BLOCKS * n + GEOMETRY])
        if facing < 0:
            return 0.0
        follows = follows_radius(self._contexts, record)
        if is_arc:
            return facing_radius(middle * state[SWEEP] if follows else 0.0, n, self.limits, state)
        return state[FACING] - (way_along(state, facing, n) * (1.0 - middle) if follows else 0.0)

    # ---- speeds --------------------------------------------------------------------------------------------

    def revise(
        self,
        rates: Rates,
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
        at, width = 0, self._width
        # A copy: what the axes allow must be known again when the overrides change.
        pieces = self._planned = self._pieces[: int(self._state[PIECES]) * width]
        closed = False
        for item in self.items:
            closed = closed or (stops is not None and stops(item))
            if isinstance(item, Piece):
                own = rates.cap2(item)
                pieces[at + ENTRY2] = 0.0 if closed else min(item.entry2, cap2, own)
                cap2, closed = own, False
                at += width
            elif isinstance(item, Block):
                closed = closed or gated
            elif isinstance(item, BlockEnd):
                closed = closed or single_block
        backward(pieces, int(self._state[PIECES]), self._axes, self.limits)
        self.revised = False

    def reach2(self) -> float:
        """Largest squared speed at which the next piece may be entered; 0 where none is prepared."""
        return self._planned[REACH2] if self._planned else 0.0

    def pop_piece(self) -> array[Any]:
        """Take the piece in front out of the queue; its record."""
        self.items.popleft()
        self._held.popleft()
        width, count = self._width, int(self._state[PIECES])
        record = self._pieces[:width]
        self._way_ahead -= record[LENGTH]
        self._rests_ahead -= record[PAUSE] > 0.0
        self._pieces[: (count - 1) * width] = self._pieces[width : count * width]
        self._state[PIECES] = count - 1
        del self._planned[:width]
        return record

    def begin_elsewhere(self, piece: Piece, start: Sequence[float]) -> None:
        """The rest of the row of a piece goes to its end from another start; the axes rest at both."""
        while self._held and self._held[0].row == piece.row:
            self.pop_piece()
        number, width = self.toolpath.context_number(piece.context), self._width
        size, count = OFFSETS + self._axes, int(self._state[PIECES])
        fields = self._contexts[number * size : (number + 1) * size]
        records, pieces = line_anew(piece, start, fields, self.limits)
        if count == 0:
            self._state[STOP] = 1.0
        else:
            self._rests_ahead += self._pieces[PAUSE] == 0.0
            self._pieces[ENTRY2] = self._held[0].entry2 = 0.0
            self._pieces[PAUSE] = max(self._pieces[PAUSE], self._pieces[RAMP] + 2.0 * self._pieces[BLEND])
        self._pieces[0:0] = records
        self._state[PIECES] = count + len(pieces)
        for record, each in zip(range(0, len(records), width), pieces, strict=True):
            self._rests_ahead += records[record + PAUSE] > 0.0
            self._way_ahead += each.length
        self.items.extendleft(reversed(pieces))
        self._held.extendleft(reversed(pieces))

    @property
    def early(self) -> float:
        """Seconds by which the next piece may begin before the axes rest: strokes of drilling cycles overlap."""
        if not self._held:
            return 0.0
        return min(self._pieces[EARLY], self._pieces[PAUSE])

    @property
    def is_last_piece(self) -> bool:
        """Whether a row to come could still change the piece in front, and nobody knows when one will come."""
        if self._state[STOP] != 0.0 or self.finished or self.waiting is not None:
            return False
        return self._state[PIECES] <= 1.0 or not self._reaches()

    def _reaches(self) -> bool:
        """Whether so much is prepared behind the piece in front that no row to come can bound it."""
        if not self._held:
            return False
        if self._rests_ahead > (self._pieces[PAUSE] > 0.0):
            return True
        reach = 0.5 * sqrt(self._state[TOP2]) * self._state[WINDOW]
        return self._way_ahead - self._pieces[LENGTH] >= reach

    @property
    def axes(self) -> int:
        """Number of axes."""
        return self._axes


def _without_function(delays: list[tuple[str, float]], code: object) -> list[tuple[str, float]]:
    """Delays of a row without what its M function takes: that is up to the machine's own controller."""
    kept = [delay for delay in delays if delay[0] != "auxiliary_s"]
    return kept[:-1] if code == ORIENT and kept else kept
