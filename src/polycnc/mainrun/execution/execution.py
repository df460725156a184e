"""Automatic operation: what is prepared is executed in time, piece by piece and event by event.

Between two events the motion is known in closed form, so the clock goes from event to event, however far apart they
are, and an override or a hold takes effect at the very moment it is given.
"""

from __future__ import annotations

from math import inf

from polycnc.channel.waits import TIME_SLICE, TYPED_BLOCKS_DONE, Why
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.execution.beside_path import beyond_limits, stops_beside, taken_back
from polycnc.mainrun.execution.by_law import ByLaw
from polycnc.mainrun.execution.by_pieces import REST2, ByPieces
from polycnc.mainrun.motion.law_motion import LawMotion
from polycnc.mainrun.motion.piece_motion import Motion, PathMotion
from polycnc.mainrun.preparation.items import Block, BlockEnd, ChannelRates, Happening, Move, Rates, Standing
from polycnc.mainrun.preparation.preprocessing import BLOCKS_A_CYCLE, Preprocessing
from polycnc.motion.frames import with_axis
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.events import Deed

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from polycnc.channel.interpolator import Influence
    from polycnc.mainrun.axes.channel_axes import ChannelAxes
    from polycnc.mainrun.execution.clock import Clock
    from polycnc.mainrun.execution.outside import Machinery
    from polycnc.mainrun.preparation.items import Item, Piece

#: Blocks are prepared while the axes move, and take no time; so that a loop that never ends lasts all the same, a block
#: takes this, s, behind so many without a way. So often a program may ask where the axes rest for what the main run
#: knows before that takes an interpolation cycle each time.
BLOCK_S, FREE_BLOCKS, ASKED = 0.001, 10_000, 100


class Execution:
    """Executes what is prepared.

    Args:
        preprocessing: What is prepared.
        rates: What the operator has set, for all channels; tell `revise` when it changes.
        machinery: Carries out events.
        axes: The axes of the channel.
        position: Machine position at the start.
        clock: The time; an interpolation cycle lasts what a program computes between two moves.
        skip_after_s: How long after the start of a skip move the skip input comes; None where it does not.

    Attributes:
        running: Cycle start has been given, and nothing has halted the run since.
        halt: Why it has halted: `single-block`, `M00`, `M01`, `alarm`, `end`; empty while it runs.
        halted_behind: The block behind which single block has halted last, as `BlockEnd.code`.
        attention: Somebody else has to act on what has just happened.
        single_block: Halt behind every block.
        block: The block in execution.
        stands_for: What the axes have stood for last, as `Standing.why`.
        context: What holds in it.
        axes: The axes, with what moves them beside the path.
        position: Where on the path the axes last were at a joint, and `place` what held there.
        rates: The speeds of this channel.
        on_row: Is told of every row that begins; None where nobody asks.
        lingers: Says whether the end of the program has to wait for actions; None where there are none.
    """

    def __init__(
        self,
        preprocessing: Preprocessing,
        rates: Rates,
        machinery: Machinery,
        axes: ChannelAxes,
        position: Sequence[float],
        clock: Clock,
        skip_after_s: float | None = None,
    ) -> None:
        self.preprocessing = preprocessing
        self.rates = ChannelRates(rates)
        self.lingers: Callable[[], bool] | None = None
        self.on_row: Callable[[Move], None] | None = None
        self._awaits: Callable[[], bool] | None = None
        self.clock, self.axes = clock, axes
        self.running, self.halt, self.halted_behind = False, "", ""
        self.attention = self.single_block = False
        self.block: Block | None = None
        self.context = self.place = Context()
        self.modal: Mapping[str, str] = {}
        self.motion: Motion | None = None
        self._machinery, self._x2, self._cap2, self._rise = machinery, 0.0, inf, 1.0
        self._until, self._dwell_signal, self.stands_for = 0.0, "", ""
        self._gated = self._waiting = self._stands = self._blocked = self._moved_on = False
        self.position, self._by_hand = list(position), tuple[float, ...]()
        self._skip_after_s, self._skips_at = skip_after_s, inf
        self._without_way, self._asked, self._acted = 0, 0, False
        self._pieces = ByPieces(preprocessing, self.rates, clock)
        self._by_law = ByLaw(preprocessing, self.rates, clock, self._rest_before)

    # ---- what a panel reads --------------------------------------------------------------------------------

    @property
    def moving(self) -> bool:
        """Whether the axes move now."""
        leads = self.motion is not None and self.motion.speed(self.clock.time) > 0.0
        return leads or self.clock.time < self._pieces.rest_time

    @property
    def rests(self) -> bool:
        """Whether no motion is under way, nor comes next."""
        items = self.preprocessing.items
        comes = bool(items) and isinstance(items[0], Move) and self.running
        return self.motion is None and not comes and self.clock.time >= self._pieces.rest_time

    @property
    def speed(self) -> float:
        """Path speed now, mm/s."""
        if self._pieces.follows(self.motion):
            return self._pieces.speed
        return self.motion.speed(self.clock.time) if self.motion is not None else 0.0

    @property
    def machine(self) -> list[float]:
        """Machine position now."""
        if self._pieces.follows(self.motion):
            return self._pieces.machine
        return self.motion.machine(self.clock.time) if self.motion is not None else list(self.position)

    @property
    def row_end(self) -> list[float]:
        """Machine position at the end of the move in execution."""
        return list(self.motion.piece.way.end) if self.motion is not None else list(self.position)

    @property
    def standing(self) -> bool:
        """Whether the run has come to rest: no motion, no dwell, no auxiliary function under way."""
        return not self.moving and self._until <= self.clock.time and not self._machinery.busy

    # ---- time ----------------------------------------------------------------------------------------------

    def advance(self, until: float, *, freely: bool = False) -> None:
        """Execute up to a time.

        Args:
            until: The time.
            freely: Come back before it when `attention` is asked for, or when nothing goes on.
        """
        machinery = self._machinery
        while (due := self._due()) <= until:
            self.clock.time = max(self.clock.time, due)
            if self._skips_at <= self.clock.time:
                self._skips_at = inf
                machinery.skip()
            elif machinery.due <= self.clock.time:
                was_busy = machinery.busy
                machinery.advance(self.clock.time)
                if was_busy and not machinery.busy:
                    self.revise()  # the gate behind the block opens
            elif self.motion is not None:
                if self.motion.end <= self.clock.time:
                    self._arrive()
                elif self.motion.rest <= self.clock.time:
                    self._rest_within()
            elif self._go_on():
                self._blocked = False
            else:
                self._blocked = True
                if freely:
                    return
                if machinery.due > until:
                    break
                self.clock.time = machinery.due
            if freely and self.attention:
                self.attention = False
                return
        if due < inf or not freely:
            self.clock.time = max(self.clock.time, until)

    def _due(self) -> float:
        """When something happens next, as far as it is known."""
        motion, now = self.motion, self.clock.time
        if motion is not None:
            due = min(motion.end, self._skips_at, self._machinery.due)
            if now < motion.rest < due:
                due = motion.rest
            rest = self._pieces.rest_time
            return rest if now < rest < due else due
        if (self._waiting and self._machinery.busy) or (self._stands and self._machinery.stands):
            return self._machinery.due
        return min(max(self._until, self.clock.time), self._machinery.due)

    @property
    def next_event(self) -> float:
        """When something will happen next; inf where nothing will without a command."""
        idle = self.motion is None and (self._blocked or not self.running)
        return self._machinery.due if idle else self._due()

    def _arrive(self) -> None:
        """The end of a piece."""
        motion = self.motion
        assert motion is not None
        self._x2 = motion.end2 if motion.end2 > REST2 else 0.0
        self.position = motion.end_position
        self._pieces.end(motion)
        self.motion, self._skips_at = None, inf
        if motion.piece.left > 0.0 and isinstance(motion, PathMotion):
            self._coast(motion, 0.5 * self._pieces.window)
        if self.motion is None:
            self._pieces.leave(motion)
            if self._x2 == 0.0:
                self._come_to_rest()

    def _come_to_rest(self) -> None:
        """The interpolator rests; nothing follows before the axes do, but for a stroke that overlaps."""
        self._pieces.come_to_rest()
        self._until = max(self._until, self._pieces.rest_time - self.preprocessing.early)

    def _rest_within(self) -> None:
        """The axes rest within a row."""
        if self.rates.stops:
            self._drop()
        elif isinstance(self.motion, LawMotion):
            self._by_law.go_on(held=self._cap2 == 0.0)
            self.motion.follow()

    def _coast(self, motion: PathMotion, late: float) -> None:
        """A skip signal has come: the axes brake on the line of the move, and the rest of it is dropped."""
        self.motion = self._pieces.coast(motion, late)
        self._x2, self._moved_on = 0.0, True
        self.preprocessing.queue.drop_moves()

    def skip_signal(self) -> list[float] | None:
        """The skip input comes now: where the axes are if a skip move runs, else None."""
        motion = self.motion
        if not isinstance(motion, PathMotion) or motion.piece.kind != Kind.SKIP or motion.piece.is_coasting:
            return None
        here = self.axes.counted(self.machine)
        self.position = motion.machine(self.clock.time)
        self._coast(motion, 0.0)
        if self.motion is None:
            self._come_to_rest()
        return here

    def end_dwell(self, signal: str) -> None:
        """A signal has come: a dwell that it ends is over."""
        if signal == self._dwell_signal and self._until > self.clock.time:
            self._until, self._dwell_signal = self.clock.time, ""

    def drop_rest(self) -> bool:
        """The axes brake on the path, and what is left of the move that runs is dropped; whether one runs."""
        if self.motion is None or self.rates.stops:
            return False
        motion = self.motion
        self.preprocessing.cut(motion.piece.row)
        self.rates.stops = True
        self.revise()
        if motion.rest <= self.clock.time:
            self._drop()
        return True

    def _drop(self) -> None:
        """The axes have braked: what is left of the block is no more."""
        if self.motion is not None:
            self.position = self.motion.machine(self.clock.time)
            self.motion = None
            self._come_to_rest()
        self._by_law.drop()
        self.rates.stops, self._moved_on = False, True
        self._x2, self._skips_at = 0.0, inf
        self.preprocessing.queue.drop_moves()

    def _go_on(self) -> bool:
        """Begin what comes next; false where nothing can begin now."""
        self._waiting = self._stands = False
        if not self.running:
            return False
        if self.rates.stops and self._x2 == 0.0:
            self._drop()
        if self._awaits is not None and self._awaits():
            now, due = self.clock.time, self.axes.due
            self._until = due if now < due < inf else now + self.clock.cycle_s
            return True
        self._awaits = None
        filled = self.preprocessing.fill(one_block=self.single_block)
        if self.rates.influence.holds_next and self._x2 == 0.0 and self.preprocessing.begins_anew:
            self._until = self.clock.time + self.clock.cycle_s
            return True
        if not self.preprocessing.items:
            return self._run_out(filled=filled)
        item = self.preprocessing.items[0]
        if isinstance(item, Move):
            return self._begin(item)
        held = self.context.feed_hold or (isinstance(item, Block) and self.preprocessing.queue.knows_hold)
        held = self.rates.gives_up or (self.rates.hold and held)
        if held and self._x2 == 0.0 and not isinstance(item, BlockEnd):
            return False
        return self._pass(item)

    def _run_out(self, *, filled: bool) -> bool:
        """Nothing is prepared."""
        if not filled:
            self._without_way += BLOCKS_A_CYCLE
            if self._without_way > FREE_BLOCKS:
                self._until = self.clock.time + self.clock.cycle_s  # the program computes
            return True
        waiting = self.preprocessing.waiting
        self._take_in_offset()
        if self.preprocessing.finished or waiting is None:
            return self._end("end")
        if waiting.until is not None and not waiting.until():
            return False
        if self._moved_on:
            self._moved_on = False
            self.preprocessing.arrived(self.position, self._by_hand)
            self._by_hand = ()
        if waiting is TYPED_BLOCKS_DONE:
            return self._end(waiting.reason)
        if waiting.reason is Why.PREPROCESSING:
            self._machinery.synchronise()
            self._asked += 1
            needs_time = self._acted or self.lingers is not None or not self.preprocessing.is_alone
            if needs_time or waiting is TIME_SLICE or self._asked > ASKED:
                self._until = self.clock.soon(self.axes.due)
        self.preprocessing.proceed()
        return True

    def _end(self, reason: str) -> bool:
        """What runs is over once the machine has done its functions; whether that is still to come."""
        if self.lingers is not None and self.lingers():
            self._until = self.clock.time + self.clock.cycle_s
            return True
        self._waiting = self._machinery.busy
        if not self._waiting:
            self.preprocessing.proceed()
            self.stop(reason)
        return self._waiting

    @property
    def waits_for_channel(self) -> bool:
        """Whether nothing goes on until another channel has done something."""
        waiting = self.preprocessing.waiting
        halted = not self.running or self.motion is not None or not self._blocked
        return (
            not halted and waiting is not None and waiting.until is not None and not self.preprocessing.items
        )

    def look_up(self) -> bool:
        """Go on if another channel has done what this one waits for; whether it has."""
        waiting = self.preprocessing.waiting
        if not self.waits_for_channel or waiting is None or waiting.until is None or not waiting.until():
            return False
        self._blocked = False
        return True

    def _pass(self, item: Block | BlockEnd | Happening | Standing) -> bool:
        """Execute something that is no motion."""
        if isinstance(item, Block) and self._x2 == 0.0 and self._machinery.busy:
            self._waiting = True
            return True
        self.preprocessing.items.popleft()
        if isinstance(item, Block):
            self._enter(item)
            self._without_way += 1
            if self._without_way > FREE_BLOCKS and self._x2 == 0.0:
                self._until = max(self._until, self.clock.time + BLOCK_S)
        elif isinstance(item, BlockEnd):
            halts = self.single_block and not self.context.stop_delay
            self.context = item.context or self.context
            if halts and self._x2 == 0.0 and not self.preprocessing.typed_blocks_end:
                self.halted_behind = item.code
                self.stop("single-block")
        elif isinstance(item, Standing):
            self._turn_spindle(item.context)
            self.context = item.context
            self.rates.enter(item.context)
            seconds = item.wait_s(self.clock.time)
            self._until = self.clock.time + seconds
            self._without_way *= seconds < self.clock.cycle_s
            self._dwell_signal, self.stands_for = item.context.dwell_signal, item.why
            if item.is_asked_again and self._until > self.clock.time:
                self.preprocessing.items.appendleft(item)
        else:
            self.context = item.context
            self._machinery.perform(item)
            self._stands = item.stands
            self._acted |= isinstance(item.event, Deed) and item.event.takes_effect_late
            self._awaits = item.event.awaits if isinstance(item.event, Deed) else None
            if self._machinery.busy:
                self._look_ahead()
        return self.running

    def _turn_spindle(self, context: Context) -> None:
        """The spindle's angle follows what the operator has set."""
        self.preprocessing.turn_spindle(context, self.rates.spindle, self.clock.time)

    def _enter(self, block: Block) -> None:
        self.block, self.modal = block, block.modal
        self._machinery.enter(block)

    def _begin(self, move: Move) -> bool:
        """Start along the next piece of a move."""
        if self.rates.enter(move.context):
            self._look_ahead()
        if self._x2 == 0.0 and self.axes.have_offset:
            if (error := beyond_limits(move, self.axes, self.preprocessing.channel)) is not None:
                self.preprocessing.refuse(error)
                return True
            if self._take_back(move, self.position):
                self._look_ahead()
                return True
        if move.done == 0.0 and self.on_row is not None:
            self.on_row(move)
        cap2 = self.preprocessing.front_cap2(self.rates)
        if self._x2 == 0.0 and cap2 == 0.0:
            return False
        led = self._by_law.motion(
            move, at_rest=self._x2 == 0.0, held=cap2 == 0.0, one_block=self.single_block
        )
        if led is not None:
            self._pieces.begin_by_law(at_rest=self._x2 == 0.0)
            self.motion = led
            self._take_up(led.piece, cap2)
            return True
        cap2 = self.preprocessing.front_cap2(self.rates)  # it may have been laid out again
        if self.preprocessing.ends_with_piece(one_block=self.single_block):
            self.preprocessing.end_in_rest(is_all=True)
            self.preprocessing.revised = True
        if self.preprocessing.revised:
            self._look_ahead()
        piece, record = self.preprocessing.queue.pop_piece()
        self._take_up(piece, cap2)
        if piece.kind == Kind.SKIP and piece.first == 0.0 and self._skip_after_s is not None:
            self._skips_at = self.clock.time + self._skip_after_s
        self.motion = self._pieces.begin(piece, record, self._x2, cap2, self.position)
        if not self.preprocessing.queue.suits(self.rates, at_rest=False):
            self._lay_again(self.motion)
        return True

    def _take_up(self, piece: Piece, cap2: float) -> None:
        """A piece, or a row, is in execution."""
        self._turn_spindle(piece.context)
        self._cap2, self._rise, self._asked, self._without_way = cap2, piece.rise, 0, 0
        self.context = self.place = piece.context
        if self.block is not None and (self.block.program, self.block.line) != (piece.program, piece.line):
            self._enter(self.block.followed_by(piece.program, piece.line, self.modal))

    def _rest_before(self, *, gated: bool, first: float = -inf) -> float:
        """The row before which the axes shall rest, because an operator or an auxiliary function asks for it."""
        return self.preprocessing.row_to_rest_before(
            gated=gated and (self._gated or self._machinery.is_open),
            single_block=self.single_block,
            stops=self._stops_beside,
            first=first,
        )

    @property
    def _stops_beside(self) -> Callable[[Item], bool] | None:
        """Says in front of which items the axes, which are beside the path, stand; None where they are on it."""
        return (
            stops_beside(self.block, self.axes, self.preprocessing.channel) if self.axes.have_offset else None
        )

    # ---- changes -------------------------------------------------------------------------------------------

    def _look_ahead(self) -> None:
        """Work out the speeds of what is prepared again."""
        cap2, single = self._cap2 * self._rise, self.single_block
        gated, stops = self._gated or self._machinery.is_open, self._stops_beside
        self.preprocessing.revise(self.rates, cap2, gated=gated, single_block=single, stops=stops)

    def revise(self) -> None:
        """Something that bounds the speed has changed: the motion goes on accordingly from where it is."""
        self._blocked = False
        self._turn_spindle(self.context)
        motion = self.motion
        if motion is None:
            at_rest = self._x2 == 0.0
            if not self.preprocessing.queue.suits(self.rates, at_rest=at_rest):
                self.preprocessing.queue.lay_again(self.rates, at_rest=at_rest)
            self._look_ahead()
            return
        if not self.single_block and self.rates.moves(motion.piece):
            led = self._by_law.take_over(motion.piece, self._pieces.on_line(motion))
            if led is not None:
                self._pieces.begin_by_law(at_rest=True)
                self.motion = motion = led
            elif self._pieces.window == 0.0 and self.preprocessing.reopen() and self._lay_again(motion):
                return
        by_law = isinstance(motion, LawMotion)
        suits = by_law or self.preprocessing.queue.suits(self.rates, at_rest=False)
        if not suits and self._lay_again(motion):
            return
        piece = motion.piece
        self._cap2 = self.rates.cap2(piece, piece.cap2, piece.asked)
        if by_law:
            self.preprocessing.revised = True  # for what comes behind the run
            self._by_law.revise(held=self._cap2 == 0.0)
        else:
            self._look_ahead()
        if isinstance(motion, PathMotion) and motion.is_bound:
            motion.ahead = self.preprocessing.ways_to_rest
        motion.revise(self.clock.time, self.preprocessing.reach2, self._cap2, self.rates)
        self._pieces.lead(motion)

    def _lay_again(self, motion: Motion) -> bool:
        """Lay out again what lies ahead; true where the motion goes on along another piece of its row.

        Bounds of faster curves reach farther back. Where the axes could not brake to these any more, it stays as it is.
        """
        open_row = isinstance(motion, PathMotion) and not motion.is_bound and not motion.piece.is_coasting
        done = motion.done(self.clock.time) if isinstance(motion, PathMotion) else 0.0
        found = self.preprocessing.queue.lay_again(self.rates, motion.piece.row if open_row else None, done)
        if found is None or not isinstance(motion, PathMotion):
            return False
        before, piece = (self._cap2, self._rise), found[0]
        self._cap2, self._rise = self.rates.cap2(piece, piece.cap2, piece.asked), piece.rise
        self._look_ahead()
        other = self._pieces.exchange(motion, found, self._cap2)
        if other is None:
            self.preprocessing.queue.lay_back()
            self._cap2, self._rise = before
            return False
        self.motion = other
        return True

    def influence(self, influence: Influence) -> None:
        """What actions make of the speeds from now on."""
        if influence != self.rates.influence:
            self.rates.influence = influence
            self.revise()

    def gate(self, *, closed: bool) -> None:
        """Whether every block ends in an exact stop, because an action may hold the next one."""
        if closed is not self._gated:
            self._gated = closed
            self.revise()

    def place_axis(self, column: int, position: float) -> None:
        """An axis, which stands, is elsewhere than the path has led it; the path goes on from there."""
        self.lead_axis(column, position)
        self.preprocessing.place_axis(column, position)

    def lead_axis(self, column: int, position: float) -> None:
        """The path has a real axis elsewhere from now on; nothing moves on it."""
        self.position = with_axis(self.position, self.place, self.preprocessing.geometry, column, position)

    # ---- beside the path -----------------------------------------------------------------------------------

    def intervene(self, way: Sequence[float], *, absolute: bool) -> None:
        """The axes, which stand, have been moved by hand; manual absolute is on or off."""
        self.axes.moved(way, absolute=absolute)
        motion = self.motion
        if motion is not None and self._take_back(motion.piece, motion.machine(self.clock.time)):
            self.motion, self._x2, self._skips_at = None, 0.0, inf

    def _take_back(self, piece: Move | Piece, here: Sequence[float]) -> bool:
        """Let the row of a piece go to its end from where the axes are; false where it does not do that."""
        taken = taken_back(self.block, piece, here, self.axes)
        if taken is not None:
            self.position = taken
            self._by_law.drop()
            self.preprocessing.begin_elsewhere(piece, taken)
        return taken is not None

    def _take_in_offset(self) -> None:
        """Nothing is prepared: what the axes were moved by hand is where the program goes on from."""
        if self.axes.have_pending:
            self._by_hand = tuple(self.axes.take_back(-1))
            self.position = [a + b for a, b in zip(self.position, self._by_hand, strict=True)]
            self._moved_on = True

    def stand_before(self, position: list[float], context: Context, modal: Mapping[str, str]) -> None:
        """A block search has come to a block: from here, with this, it begins."""
        self.position, self.modal = position, modal
        self.context = self.place = context

    @property
    def knows_when(self) -> bool:
        """Whether it is known when what is waited for comes, and not soon: a dwell."""
        return self._awaits is None and self._until > self.clock.time + 1.0

    def start(self) -> None:
        """Go on, or begin."""
        self.running, self.halt = True, ""
        self.revise()

    def stop(self, reason: str) -> None:
        """Halt here: the axes stand."""
        self.running, self.halt, self.attention, self._x2 = False, reason, True, 0.0
        self._machinery.halted(reason)

    def abandon(self) -> None:
        """Give up what is left: reset. The axes stand where they are, or have been braked before."""
        self.position = self.axes.counted(self.machine)
        self.axes.take_back(-1)
        self.axes.rebase()
        self.motion, self.running, self.halt = None, False, ""
        self._by_law.drop()
        self._x2, self._until, self._skips_at = 0.0, self.clock.time, inf
        self._pieces.rest_time = self.clock.time
        self.block, self.rates.stops, self._awaits = None, False, None
        self.preprocessing.clear(self.position)
