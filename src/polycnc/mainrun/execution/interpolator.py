"""What synchronised actions ask of the main run of a channel: where it is in this cycle, and what they may change.

It satisfies the channel's `Interpolator`. The clock visits every interpolation cycle while it is awake; asleep it wakes
when a block begins, something is prepared, a signal changes, or an axis comes to rest.
"""

from __future__ import annotations

from math import acos, degrees, inf

from polycnc.channel.interpolator import HANDWHEEL_OFFSET, BlockKind, Influence, OnPath
from polycnc.channel.moves.travel import limits_of
from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.mainrun.axes.commanded import CommandedAxis
from polycnc.mainrun.axes.overlay import Overlay
from polycnc.mainrun.execution.block_parts import BlockParts, direction
from polycnc.mainrun.execution.leading_spindles import LeadingSpindles
from polycnc.mainrun.preparation.items import UNINFLUENCED, BlockEnd, Happening, Move
from polycnc.transformation.couplings.graph import in_order

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.interpolator import Watcher
    from polycnc.mainrun.axes.channel_axes import ChannelAxes
    from polycnc.mainrun.axes.commanded import Leading
    from polycnc.mainrun.execution.clock import Clock
    from polycnc.mainrun.execution.execution import Execution
    from polycnc.mainrun.execution.machinery import Machinery
    from polycnc.mainrun.preparation.items import Block, Rates, Row
    from polycnc.mainrun.reading.snapshot import SpindleState
    from polycnc.messages import AlarmError
    from polycnc.toolpath import Context, Event
    from polycnc.transformation.couplings.laws import Law as CouplingLaw


class Led(Protocol):
    """Where the axes of a channel are, mm (radius) and degrees."""

    execution: Execution
    machinery: Machinery
    axes: ChannelAxes
    rates: Rates

    @property
    def path(self) -> list[float]:
        """Where programs have led them."""

    @property
    def machine_position(self) -> list[float]:
        """Their setpoints."""

    def spindle_rpm(self, context: Context) -> float:
        """Speed of the spindle where a context holds, 1/min."""

    @property
    def spindle(self) -> SpindleState:
        """The spindle of the block in execution."""

    @property
    def channel(self) -> Channel:
        """The channel."""


class LeadingAxis:
    """An axis that leads another one; satisfies `Leading`.

    Args:
        interpolator: The main run of its channel.
        column: The axis.
    """

    def __init__(self, interpolator: ChannelInterpolator, column: int) -> None:
        self._interpolator, self._column = interpolator, column

    def setpoint(self, time: float) -> float:
        """Its place; of the path that of this moment alone."""
        return self._interpolator.setpoint(self._column, time)

    def speed(self, time: float) -> float:  # noqa: ARG002 - it is that of this moment
        """How fast it moves, by what it has gone since the last look."""
        return 0.0 if self._interpolator.is_still else self._interpolator.speed(self._column)


class ChannelInterpolator:
    """The main run of one channel as its actions see it.

    Args:
        run: The channel in the main run.
        clock: The time.

    Attributes:
        runs_programs: The control is in the mode in which the channel's program was started.
    """

    def __init__(self, run: Led, clock: Clock) -> None:
        self._run, self._clock = run, clock
        self._watchers: list[Watcher] = []
        self._awake = False
        self._block_since = 0.0
        self._parts: BlockParts | None = None
        self._static: set[int] = set()
        self._looks = False
        self.runs_programs = True
        self._commanded: dict[int, CommandedAxis] = {}
        self._overlays: dict[tuple[str, int], Overlay] = {}
        self._led: dict[int, tuple[CouplingLaw, ...]] = {}
        self._turning = LeadingSpindles(run, clock)
        self._seen: tuple[float, list[float]] = (-1.0, [])
        self._before: tuple[float, list[float]] = (-1.0, [])

    # ---- who looks -----------------------------------------------------------------------------------------

    def watch(self, watcher: Watcher) -> None:
        """From now on somebody is told of cycles and blocks."""
        if watcher not in self._watchers:
            self._watchers.append(watcher)
        execution = self._run.execution
        execution.lingers, execution.on_row = self._lingers, self._row
        self._parts = self._parts or BlockParts(execution.preprocessing.channel.coordinates.geometry)
        execution.preprocessing.on_step = self.wake
        self.wake()

    def wake(self) -> None:
        """Look in every cycle from the next one on."""
        if not self._awake and self._watchers:
            self._awake = self._run.execution.attention = True
            self._clock.arm(self)

    def sleep(self) -> None:
        """Look in none before something happens."""
        if self._awake:
            self._awake = False
            self._clock.disarm(self)

    def look(self, time: float) -> None:  # noqa: ARG002 - the clock stands at it
        """An interpolation cycle has come; satisfies the clock's `Watch`."""
        self._look(lambda watcher: watcher.look())

    def _look(self, do: Callable[[Watcher], None]) -> None:
        if self._seen[0] != self._clock.time:
            self._before = self._seen
        self._looks, self._seen = True, (-1.0, [])
        try:
            for watcher in self._watchers:
                do(watcher)
        finally:
            self._looks = False
        if all(watcher.is_quiet for watcher in self._watchers):
            self.sleep()

    def enter(self, block: Block) -> None:
        """A block begins."""
        for watcher in self._watchers:
            watcher.block_ends()
        if self._parts is not None and not block.is_silent:
            self._begin(self._parts.block(self._run.execution.preprocessing.items))
        self.wake()

    def _row(self, move: Move) -> None:
        """A row begins."""
        if self._parts is not None:
            self._begin(self._parts.row(move, self._run.execution.modal))

    def _begin(self, blocks: Iterator[bool]) -> None:
        """Let the watchers look where blocks begin, those of the program and others."""
        for is_own in blocks:
            self._block_since = self._clock.time
            if is_own:
                self._look(lambda watcher: watcher.block_begins())
            else:
                self._look(lambda watcher: watcher.look())

    def end(self, *, reset: bool) -> None:
        """The program has ended, or was given up by a reset: no action holds the path any more."""
        for watcher in self._watchers:
            watcher.abandon(reset=reset)
        for column in tuple(self._led):
            self.follow(column, ())
        self._run.execution.influence(UNINFLUENCED)

    def hold(self) -> None:
        """Feed hold has come, or gone: axes that are not moved by static actions wait."""
        self._set_overrides()
        self.wake()

    def finish_axes(self) -> None:
        """The end of a program test: what axes are about to do beside the path is done."""
        for axis in self._commanded.values():
            axis.finish()

    def stop_axes(self) -> None:
        """An alarm stops motions: those of actions too."""
        for axis in self._commanded.values():
            axis.stop()

    @property
    def spindle_rpm(self) -> float:
        """Speed of the spindle in the block in execution, signed."""
        context = self._run.execution.context
        return context.spindle_direction * self._run.spindle_rpm(context)

    @property
    def goes_home(self) -> bool:
        """Whether a reset has to wait for an axis that is led to its place of rest."""
        return any(watcher.goes_home for watcher in self._watchers)

    @property
    def is_held(self) -> bool:
        """Whether the program is held, is being given up, or has ended in an alarm."""
        rates = self._run.execution.rates
        return rates.hold or rates.gives_up or self._run.execution.halt == "alarm"

    @property
    def has_power(self) -> bool:
        """Whether the drives have power: no emergency stop is pressed."""
        return not self._run.execution.rates.operator.drives_off

    def _lingers(self) -> bool:
        return any(watcher.lingers for watcher in tuple(self._watchers))

    # ---- where it is ---------------------------------------------------------------------------------------

    @property
    def time(self) -> float:
        """Simulated time, s."""
        return self._clock.time

    @property
    def cycle_s(self) -> float:
        """Interpolation cycle, s."""
        return self._clock.cycle_s

    @property
    def _current_row(self) -> Row | None:
        """The move in execution; while a block begins, or the axes stand in it, the one that it comes to."""
        execution = self._run.execution
        if execution.motion is not None:
            return execution.motion.piece
        for item in execution.preprocessing.items:
            if isinstance(item, Move):
                return item
            if isinstance(item, BlockEnd):
                break
        return None

    @property
    def on_path(self) -> OnPath:
        """Where the block in execution is."""
        execution, time = self._run.execution, self._clock.time
        seconds, motion = time - self._block_since, execution.motion
        row, parts = self._current_row, self._parts
        passed = coming = 0.0
        if row is not None and parts is not None:
            passed, coming = parts.passed, parts.coming(row, execution.preprocessing.items)
        if motion is None:
            left = row.total * (1.0 - row.done) if isinstance(row, Move) else 0.0
            return OnPath(seconds, 0.0, left + coming, 0.0)
        piece = motion.piece
        length = piece.length / piece.share if piece.share else piece.length
        done = motion.done(time) + piece.first * length
        return OnPath(seconds, passed + done, max(length - done, 0.0) + coming, execution.speed)

    @property
    def block_number(self) -> int:
        """How many blocks have begun, intermediate ones too."""
        return self._parts.number if self._parts is not None else 0

    @property
    def block_kind(self) -> BlockKind:
        """What has made the block in execution."""
        return self._parts.kind if self._parts is not None else BlockKind()

    @property
    def block_split(self) -> tuple[bool, bool]:
        """Whether the block in execution is not as the program has it, and whether the one behind it is not."""
        items = self._run.execution.preprocessing.items
        return self._parts.split(items) if self._parts is not None else (False, False)

    @property
    def operator_override(self) -> float:
        """The feed override that the operator has set, 1 for 100 %."""
        operator = self._run.execution.rates.operator
        return 1.0 if operator.feed_cancelled else operator.feed

    @property
    def modal(self) -> Mapping[str, str]:
        """Active codes in the block in execution."""
        return self._run.execution.modal

    def setpoint(self, column: int, time: float) -> float:
        """Where an axis shall be at a time, as far as that is known ahead."""
        return self._run.axes[column].setpoint(time)

    def machine(self, column: int) -> float:
        """Commanded position of an axis on the machine."""
        return self._positions()[column]

    def _positions(self) -> list[float]:
        if self._seen[0] != self._clock.time:
            self._seen = (self._clock.time, self._run.machine_position)
        return self._seen[1]

    @property
    def seen(self) -> list[float] | None:
        """Setpoints of all axes while somebody looks, worked out once; None at other times: nothing is kept then."""
        return self._positions() if self._looks else None

    def left(self, column: int) -> float:
        """Way of an axis to where it goes, signed: by what commands it, or in the move in execution."""
        commanded = self._commanded.get(column)
        if commanded is not None and commanded.moves:
            return commanded.left
        execution, row = self._run.execution, self._current_row
        end = row.way.end if row is not None else execution.position
        return end[column] - execution.machine[column]

    def is_on_path(self, column: int) -> bool:
        """Whether the move in execution moves an axis."""
        row = self._current_row
        return row is not None and row.way.start[column] != row.way.end[column]

    def speed(self, column: int) -> float:
        """Speed of an axis, mm/s or degrees/s, signed: what it has gone since the last look."""
        now = self._positions()
        since, before = self._before
        if since < 0.0 or since >= self._clock.time:
            return 0.0
        return (now[column] - before[column]) / (self._clock.time - since)

    def corner_angle(self) -> float | None:
        """Angle between the end of the move in execution and the next one, degrees; None where none is prepared."""
        execution, row = self._run.execution, self._current_row
        if row is None:
            return None
        # an arc stays the first item until its last piece begins
        moves = (item for item in execution.preprocessing.items if isinstance(item, Move))
        ahead = next((move for move in moves if move.row != row.row), None)
        if ahead is None:
            return None
        axes = [axis for axis in execution.preprocessing.channel.coordinates.geometry if axis >= 0]
        out, into = direction(row.way, 1.0, axes), direction(ahead.way, 0.0, axes)
        cosine = sum(a * b for a, b in zip(out, into, strict=True))
        return degrees(acos(min(max(cosine, -1.0), 1.0)))

    @property
    def is_still(self) -> bool:
        """Whether no axis of the channel moves."""
        turning = any(axis.is_turning for axis in self._commanded.values())
        shifting = any(overlay.due < inf for overlay in self._overlays.values())
        return not turning and not shifting and self._run.execution.rests

    # ---- what they change ----------------------------------------------------------------------------------

    def influence(self, influence: Influence) -> None:
        """Let these speeds hold until the next look."""
        self._run.execution.influence(influence)
        self._set_overrides()

    def _set_overrides(self) -> None:
        rates = self._run.execution.rates
        for column, axis in self._commanded.items():
            waits = rates.hold and column not in self._static
            axis.set_override(0.0 if waits else rates.influence.of_axes.get(column, 1.0))

    def move_static(self, column: int, *, static: bool) -> None:
        """Whether what moves an axis beside the path goes on while the program is held."""
        (self._static.add if static else self._static.discard)(column)

    def gate(self, *, closed: bool) -> None:
        """Whether every block ends in an exact stop."""
        self._run.execution.gate(closed=closed)

    def stop_behind_next(self) -> None:
        """Preparation waits behind the next block that does something."""
        self._run.execution.preprocessing.stop_behind_next = True

    def release(self) -> None:
        """Preparation need not wait for the end of the block in execution."""
        execution = self._run.execution
        if execution.preprocessing.release() and execution.running:
            execution.preprocessing.fill(one_block=execution.single_block)
            execution.revise()

    def drop_rest(self) -> float:
        """Brake on the path and drop what is left of the block in execution; gives the way dropped, mm."""
        left = self.on_path.left
        return left if self._run.execution.drop_rest() else 0.0

    def put_out(self, event: Event) -> None:
        """An auxiliary function goes out to the machine."""
        run = self._run
        run.execution.preprocessing.note(event, run.execution.block)
        run.machinery.perform(Happening(event, run.execution.context, stands=False))

    def fail(self, error: AlarmError, *, program: str, line: int) -> None:
        """An action raises an alarm: the program ends behind what is prepared."""
        preprocessing = self._run.execution.preprocessing
        error.program, error.line = preprocessing.toolpath.program_number(program), line
        preprocessing.fail(error)
        self._run.execution.revise()

    # ---- axes beside the path ------------------------------------------------------------------------------

    def commanded(self, column: int) -> CommandedAxis:
        """An axis that is moved beside the path."""
        found = self._commanded.get(column)
        if found is not None:
            found.arrive(self._clock.time)  # a program that runs freely is ahead of what looks after axes
        if found is None:
            axis, place = self._run.axes[column], self._run.path[column]
            found = CommandedAxis(axis.data, axis.ramp, place, lambda: self._clock.time, self.wake)
            self._commanded[column] = found
            axis.command(found)
        elif not found.moves:
            share, path = found.at(self._clock.time), self._run.path[column]
            found.stand(path + share, path)
        return found

    def led_by(self, column: int) -> tuple[CouplingLaw, ...]:
        """What leads an axis beside the path."""
        return tuple(self._led.get(column, ()))

    def follow(
        self,
        column: int,
        laws: Sequence[CouplingLaw],
        spindles: Mapping[int, float] | None = None,
        speed: Callable[[int, float], float] | None = None,
        *,
        catches_up: bool = True,
    ) -> None:
        """These lead an axis beside the path from now on, none lets it brake.

        Raises:
            CircularCouplingError: An axis would lead itself.
        """
        every = {**self._led, column: tuple(laws)}
        in_order(every)
        self._led = {each: of for each, of in every.items() if of}
        leading: list[tuple[Leading, CouplingLaw]] = [(LeadingAxis(self, law.leading), law) for law in laws]
        if spindles is not None:
            leading += self._turning.led_by(column, spindles, speed)
        self.commanded(column).follow(leading, catches_up=catches_up)
        self.wake()

    def commanded_shares(self) -> dict[int, float]:
        """How far commanded axes are from where the path has them, by column."""
        return {column: axis.at(self._clock.time) for column, axis in self._commanded.items()}

    def position_beside(self, column: int, target: float, speed: float) -> None:
        """An axis goes to a target beside the path, which has it there from now on; nothing moves on the path."""
        self.shift_path(column, target)
        self.commanded(column).move_to(target, speed)

    def shift_path(self, column: int, place: float) -> None:
        """The path has an axis elsewhere from now on; the axis stays, and nothing moves on the path."""
        axis = self.commanded(column)
        self._run.execution.lead_axis(column, place)
        axis.base = place

    def stand_at(self, column: int, place: float) -> None:
        """An axis, which stands, is called another position; nothing moves."""
        axis = self._commanded.get(column)
        if axis is not None:
            axis.stand(place, place)
        self._seen = (-1.0, [])
        self._run.execution.lead_axis(column, place)

    def take_back(self, column: int) -> float:
        """The program has a commanded axis again, which stands: gives its machine position."""
        axis = self._commanded.get(column)
        if axis is None:
            return self._run.path[column]
        place = self._run.path[column] + axis.at(self._clock.time)
        self._seen = (-1.0, [])
        axis.stand(place, place)
        self._run.execution.place_axis(column, place)
        return place

    def overlay(self, name: str, column: int, value: float, speed: float, pull: float = 1.0) -> None:
        """Shift an axis beside everything else, no faster than a speed and with a part of its acceleration.

        `name` says which of its shifts is meant.
        """
        found = self._overlays.get((name, column))
        if found is None:
            axis = self._run.axes[column]
            found = self._overlays[name, column] = Overlay(axis.data.acceleration)
            axis.add(found)
        found.go(value, speed, self._clock.time, pull)
        self._narrow_travel()

    def shift_by_hand(self, column: int, way: float, speed: float, pull: float) -> None:
        """The handwheel shifts an axis by a way more, from where it is no further than its travel allows."""
        found, axis = self._overlays.get((HANDWHEEL_OFFSET, column)), self._run.axes[column]
        before = found.target if found is not None else 0.0
        bare = self.without_overlay(HANDWHEEL_OFFSET, column)
        low, high = min(axis.data.limit_minus - bare, before), max(axis.data.limit_plus - bare, before)
        self.overlay(HANDWHEEL_OFFSET, column, min(max(before + way, low), high), speed, pull)

    def _narrow_travel(self) -> None:
        """Rows that are prepared from now on leave room for the shifts of the axes."""
        channel = self._run.execution.preprocessing.channel
        channel.limits = limits_of(channel.axis_data)
        for (_, column), each in self._overlays.items() if channel.limits else ():
            low, high = channel.limits[column]
            room = (low - min(each.target, 0.0), high - max(each.target, 0.0))
            channel.limits = (*channel.limits[:column], room, *channel.limits[column + 1 :])

    def without_overlay(self, name: str, column: int) -> float:
        """Where a real axis would be now without one of its shifts, machine position."""
        found, time = self._overlays.get((name, column)), self._clock.time
        return self._run.axes[column].setpoint(time) - (found.at(time) if found is not None else 0.0)

    def overlaid(self, name: str, column: int) -> float:
        """How far a shift of an axis has been asked to go, mm or degrees; 0 where there is none."""
        found = self._overlays.get((name, column))
        return found.target if found is not None else 0.0

    def take_in_overlay(self, name: str, column: int) -> float:
        """A shift of an axis, which stands, becomes a part of the path: gives its machine position."""
        found = self._overlays.pop((name, column), None)
        place = self._run.path[column]
        if found is not None:
            self._run.axes[column].remove(found)
            place += found.at(self._clock.time)
            self._run.execution.place_axis(column, place)
            self._narrow_travel()
        return place
