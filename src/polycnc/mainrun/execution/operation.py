"""What a control does: from state to state, as commands ask for it and as it follows from what happens."""

from __future__ import annotations

from contextlib import suppress
from functools import partial
from math import inf
from operator import attrgetter

from polycnc.channel.waits import TYPED_BLOCKS_DONE
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.commands.states import Mode, State
from polycnc.mainrun.errors import CommandRefused
from polycnc.mainrun.execution.channel_runs import ChannelRuns
from polycnc.mainrun.execution.machinery import SKIP_SIGNAL
from polycnc.mainrun.signals.machine_states import axis_names, machine_states, turn_magazine
from polycnc.mainrun.signals.program_signals import give
from polycnc.mainrun.status import LOCKED_STATES, PARTS
from polycnc.messages import Alarm, AlarmError
from polycnc.toolpath.events import Auxiliary

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from polycnc.channel.group import ChannelGroup
    from polycnc.channel.waits import Wait
    from polycnc.control.interface import Control
    from polycnc.machine.model import Machine
    from polycnc.machine.setup.values import Setup
    from polycnc.mainrun.commands.programs import Programs
    from polycnc.mainrun.commands.search import ProgramTest
    from polycnc.mainrun.commands.settings import Switches
    from polycnc.mainrun.execution.channel_run import ChannelRun
    from polycnc.mainrun.execution.clock import Clock
    from polycnc.mainrun.preparation.items import Block, Happening
    from polycnc.mainrun.reading.snapshot import Positions
    from polycnc.mainrun.signals.image import SignalImage
    from polycnc.mainrun.signals.interlocks import Interlocks
    from polycnc.mainrun.status import Status
    from polycnc.memory.retained import RetainedStore
    from polycnc.toolpath import Event

#: Programmed stops that the machine's rules know of.
HALT_SIGNALS = {"M00": "HALT_M00", "M0": "HALT_M00", "M01": "HALT_M01", "M1": "HALT_M01"}
#: Manual absolute: coordinates count what is moved by hand while a program waits (FANUC *ABSM, which means on by 0).
MANUAL_ABSOLUTE = "MANUAL_ABSOLUTE"
#: The program has ended without going back to its top: M02 on machines whose rules latch this, or by the control's
#: parameters. A reset goes back.
AT_END = "M02_END"
PROGRAM_ENDS = frozenset((2, 30))
#: A search has come to its block.
FOUND = "search"
#: The soft key that holds the feed at 100 %.
FEED_IS_100 = "F_100"
#: What the reasons of a halt lead to; every other one stops.
HALTS = {"end": State.READY, "alarm": State.ALARM}

#: What the signals begin with that programs read as variables of the same names.
READ_IN_PROGRAMS = "$A_"

_number = attrgetter("number")


class Operation:
    """The channels of a control, and what it does with them.

    Args:
        control: The control.
        machine: The machine.
        setup: What the channels start from.
        programs: What is loaded.
        clock: The time.
        switches: What the operator has set.
        signals: The signal image.
        interlocks: What the machine's controller refuses.
        status: Mode, state and alarms.
        retained: What outlives the power.
        adopted: Channels that have run so far without a clock; None to switch new ones on.

    Attributes:
        runs: The channels.
        keys: What the keys do that are signals too, by name.
        program_mode: The mode in which the program was started that runs or waits.
        waiting_mode: The same of a program that waits while typed blocks run in its midst.
        starts_up: The power has come back: what lived as long as it does begins anew once the axes stand.
        searched: A block search has come to its block; cycle start leads the axes there.
        collected: Auxiliary functions that the search has collected, by channel.
        test: A search that runs the program; None for none.
        mains: Channels whose programs the operator has started; programs start those of others.
    """

    def __init__(
        self,
        control: Control,
        machine: Machine,
        setup: Setup,
        programs: Programs,
        clock: Clock,
        switches: Switches,
        signals: SignalImage,
        interlocks: Interlocks,
        status: Status,
        retained: RetainedStore,
        adopted: ChannelGroup | None = None,
    ) -> None:
        self._resets_at_end = adopted is None
        self.control, self.machine = control, machine
        self.clock, self.switches, self.signals, self.interlocks = clock, switches, signals, interlocks
        self.status, self._retained = status, retained
        self.keys: Mapping[str, Callable[[], None]] = {}
        self.program_mode = self.waiting_mode = Mode.AUTO
        self.searched = self.starts_up = False
        self.collected: dict[int, list[Happening]] = {}
        self.test: ProgramTest | None = None
        self.mains: set[int] = set()
        self._giving_up = self._returning = False
        self._pressed: list[str] = []
        signals.on_edge = self._edge
        interlocks.on_alarm = self._machine_alarm
        self.runs = ChannelRuns(
            control,
            machine,
            setup,
            programs,
            clock,
            switches.rates,
            signals,
            interlocks,
            self,
            retained,
            adopted,
        )
        signals.states |= machine_states(
            self.runs.first.channel, self.runs, switches, lambda: self.program_spindle
        )
        if adopted is None:
            self.runs.switch_on(self.runs.first)
        status.show()
        signals.scan()
        interlocks.look()

    @property
    def halt(self) -> str:
        """Why the program stands (`M00`, `M01`, `single-block` …), or empty."""
        reasons = [run.execution.halt for run in self.runs]
        return reasons[0] or next((reason for reason in reasons if reason not in ("", "end")), "")

    @property
    def runs_freely(self) -> bool:
        """Whether one channel runs its program, and nothing else happens."""
        run, quiet = self.runs.first, not (self._giving_up or self._returning)
        beside = run.axes.by_hand or min(run.axes.due, self.clock.next_visit) < inf
        return quiet and len(self.runs) == 1 and not beside and run.execution.running

    # ---- from state to state -------------------------------------------------------------------------------

    def follow_up(self) -> None:
        """What follows when keys were pressed by signals, or axes have come to rest."""
        while self._pressed:
            with suppress(CommandRefused):  # a key that cannot act now does nothing
                self.keys[self._pressed.pop(0)]()
        if self.runs.move_by_hand:
            return
        goals = self.runs.shall_move_by_hand
        if self._giving_up and not (self.runs.move or self.runs.go_home):
            self.give_up()
        elif self._returning and not goals:
            self.resume()
        elif self.status.state is State.READY and not goals:
            self._stand()
        if self.status.mode is Mode.REFERENCE and not goals:
            self._note_references()

    def positions(self, run: ChannelRun) -> Positions:
        """Positions of a channel as its displays show them."""
        return run.positions(self.switches.locked_at.get(run.number))

    def prepare(self, run: ChannelRun) -> None:
        """Before a program of a channel begins: it is where its axes are, and locked axes stand there."""
        self.switches.lock(run)
        run.begin_at_axes()
        run.channel.coordinates.arrive_machine(list(run.execution.position))
        self.switches.apply_to(run.channel, typed=self.program_mode is Mode.MDI)

    def resume(self) -> None:
        """Every channel that has a program goes on."""
        rates = self.switches.rates
        self._returning = self.searched = rates.hold = rates.gives_up = False
        for run in self.runs:
            run.axes.leave()
            run.interpolator.runs_programs = True
            run.interpolator.hold()
        self._end_halt()
        self.status.become(State.RUNNING)
        for run in self.runs:
            if run.is_active:
                run.execution.single_block = bool(self.switches.panel.single_block)
                run.execution.start()

    @property
    def has_halted(self) -> bool:
        """Whether a channel has halted at a stop or in single block."""
        return any(run.is_active and run.execution.halt for run in self.runs)

    def go_on_halted(self) -> None:
        """Channels that have halted go on; those that run or wait for others are left alone."""
        self._end_halt()
        for run in self.runs:
            if run.is_active and run.execution.halt:
                run.execution.single_block = bool(self.switches.panel.single_block)
                run.execution.start()

    def go_on_from_here(self) -> None:
        """The program goes on from where an operator has left the axes."""
        for run in self.runs:
            run.intervene(absolute=bool(self.signals[MANUAL_ABSOLUTE]))
        self.resume()

    def lead_back(self) -> None:
        """Axes that were moved by hand go to where the program waits, which then goes on."""
        self.status.become(State.RUNNING)
        for number, happenings in self.collected.items():
            for happening in happenings:
                self.runs[number].machinery.perform(happening)
        self.collected = {}
        self._returning = True
        for run in self.runs:
            if run.axes.by_hand:
                run.axes.settle()
                for axis, target in zip(run.axes, run.without_hand, strict=True):
                    axis.hand.towards(target, partial(self.switches.jog_speed, axis.data), self.clock.time)

    def hold(self) -> None:
        """Feed hold."""
        if self.status.state is State.RUNNING:
            self._bring_to_rest()
            self.status.become(State.HOLD)

    def brake(self, state: State) -> None:
        """The axes come to rest, and the program is given up then."""
        self.switches.rates.gives_up = self._giving_up = True
        self.switches.rates.drives_off = state in LOCKED_STATES
        self._bring_to_rest()
        self.status.become(state)
        self.follow_up()

    def _bring_to_rest(self) -> None:
        self.switches.rates.hold = True
        self.runs.revise()
        self.runs.brake_hands()
        for run in self.runs:
            run.interpolator.hold()
        self._returning = False

    def begin_test(self, test: ProgramTest) -> ChannelRun:
        """The program of a channel is run to a block while its axes stand; gives the channel."""
        run, self.test, self.switches.tests = self.runs[test.channel], test, test.channel
        self.prepare(run)
        run.machinery.reset()
        run.machinery.keeps = test.keeps
        self.set_rates()
        return run

    def _end_test(self, test: ProgramTest) -> None:
        """The axes are where they stood, the path is where the program has come to."""
        run, self.test, self.switches.tests = self.runs[test.channel], None, 0
        run.machinery.keeps = None
        self.switches.lock(run)
        run.channel.is_tested = False
        self.set_rates()
        run.interpolator.finish_axes()
        run.take_in_hand(test.here)

    def give_up(self) -> None:
        """The axes stand: the program is given up, the control is as after reset."""
        test = self.test
        missed = test is not None and self.runs[test.channel].execution.halt == "end"
        if test is not None:
            self._end_test(test)
        rates = self.switches.rates
        self._giving_up = self.searched = rates.hold = rates.gives_up = False
        self._end_halt()
        self.status.pulse("ENDED")
        self.signals[AT_END] = 0.0
        here = [(run, run.machine_position) for run in self.runs]
        for run, position in here:
            reached = dict(run.reached)
            run.give_up()
            run.reached = reached if test is not None else run.reached
            if self.status.is_locked:
                self.control.stop_spindles(run.channel)
            if self.starts_up:
                self.runs.switch_on_again(run)
            run.stand_at(position)
            self.prepare(run)
        if test is not None and missed and not self.status.is_locked:
            self.runs[test.channel].machinery.messages.append(str(test.wanted.missed(test.target)))
        self.starts_up = False
        if not self.status.is_locked:
            self.status.show_alarms(())
            self.status.become(State.READY)
            self.interlocks.look()
        self._retained.commit()  # which may fail: the state is right all the same

    def _stand(self) -> None:
        """No program runs: axes that were moved by hand are where one would begin."""
        for run in self.runs:
            if run.axes.by_hand:
                run.stand_at(run.machine_position)
                self.prepare(run)

    def _note_references(self) -> None:
        """Axes that have come to their reference points know their position."""
        for name in {name for run in self.runs for name in axis_names(run.channel)}:
            if self.signals[f"NOT_REFERENCED_{name}"] and self.signals[f"{name}_AT_REFERENCE"]:
                self.signals[f"NOT_REFERENCED_{name}"] = 0.0

    def look_for_deadlock(self) -> None:
        """Every channel that is still there waits for another one: nothing will ever happen again."""
        here = [run for run in self.runs if run.is_active]
        if not here or any(not run.execution.waits_for_channel for run in here):
            return
        first = min((run for run in here if run.number in self.mains), key=_number, default=None)
        if first is not None:
            first.preprocessing.fail(AlarmError("PC0005"))
            first.execution.start()
            return
        for run in here:
            run.give_up()  # the run ends with what the operator has started
        if self.status.state is State.RUNNING:
            self.status.become(State.READY, halt="end")

    def _end_halt(self) -> None:
        for name in HALT_SIGNALS.values():
            self.signals[name] = 0.0

    def set_rates(self) -> None:
        """The speeds follow the override switches; a soft key of the machine holds the feed at 100 %."""
        switches = self.switches
        settings, tests = self.control.motion_settings(self.runs.first.channel), self.test is not None
        in_dry_run = tests or (switches.panel.dry_run and self.program_mode is not Mode.TAPE)
        switches.set_rates(
            feed_is_100=tests or bool(self.signals[FEED_IS_100]),
            rapid_held=settings.rapid_held,
            dry_run=settings.dry_run if in_dry_run else None,
        )
        self.runs.revise()

    # ---- what happens on the channels ----------------------------------------------------------------------

    def started(self, number: int, waits: Iterator[Wait]) -> None:
        """A channel has started another one."""
        run = self.runs[number]
        self.prepare(run)
        run.machinery.reset()
        self._call_attention()
        run.preprocessing.begin(waits, run.execution.position)
        run.execution.single_block = bool(self.switches.panel.single_block)
        if self.status.state is State.RUNNING:
            run.execution.start()

    def failed(self, error: AlarmError) -> None:
        """A channel cannot be switched on."""
        self.status.fail(error)

    def performs(self, number: int, event: Event) -> None:
        """An event of a program is carried out."""
        self.status.report("event", number, type=event.type, **event.data)
        code = event.code if isinstance(event, Auxiliary) else -1
        if code in PROGRAM_ENDS and self.control.stays_at_end(self.runs[number].channel, code):
            self.signals[AT_END] = 1.0

    def enters(self, number: int, block: Block) -> None:
        """A block begins."""
        self.status.report("block", number, program=block.program, line=block.line)
        if self.test is None:  # what the axes have not done is no point of interruption
            self.runs[number].reach(block)
        self.runs[number].interpolator.enter(block)
        if self.test is not None and self.test.is_at(number, block):
            self.runs[number].execution.stop(FOUND)

    def reads_signals(self, number: int) -> None:
        """A program is about to read signals."""
        give(self.runs[number].channel, self.signals.values)

    def says(self, message: str) -> None:
        """A text for the operator."""
        self.status.keep_message(message)

    def shows_alarms(self, number: int) -> None:
        """The alarms of a channel are shown."""
        self.status.show_alarms(tuple(self.runs[number].channel.alarms))

    def stops(self, number: int, code: str) -> None:
        """A programmed stop, or `alarm`."""
        if code == "alarm":
            self.shows_alarms(number)
        self.runs[number].execution.stop(code)

    def halted(self, number: int, reason: str) -> None:
        """The run of a channel has halted of its own accord; the control does when no other one runs."""
        run, test = self.runs[number], self.test
        if test is not None and number == test.channel and reason == FOUND:
            self._end_test(test)
            run.reach(run.execution.block)
            self.collected, self.searched = {number: test.functions}, True
        elif test is not None and number == test.channel and reason == "end":
            self._giving_up = True  # the block did not come
            self.status.report("halt", number, halt="end")
            return
        if reason == "end":
            self.runs.group.end(number)
        others = [other for other in self.runs if other is not run and other.is_active]
        # What knows no hold, such as a thread, may end a program that is held.
        ends_held = self.status.state is State.HOLD and reason in HALTS
        if self.status.state is State.RUNNING or ends_held:
            if reason in HALT_SIGNALS:
                self.signals[HALT_SIGNALS[reason]] = 1.0
            if reason == "alarm" or not any(other.execution.running for other in others):
                state = HALTS.get("stop" if others and reason == "end" else reason, State.STOPPED)
                self.status.become(state, halt=reason)
            else:
                self.status.report("halt", number, halt=reason)
        if reason == TYPED_BLOCKS_DONE.reason:
            self.program_mode = self.waiting_mode
            self.switches.apply_to(run.channel, typed=self.program_mode is Mode.MDI)
        if reason == "alarm" and others:
            self.switches.rates.hold = True
            self.runs.revise()
        if reason == "end":
            run.interpolator.end(reset=False)
        elif reason == "alarm":
            run.interpolator.stop_axes()
        if reason == "end" and number in self.mains and self._resets_at_end:
            run.parts += self.program_mode is not Mode.MDI
            self.status.count(PARTS, float(self.program_mode is not Mode.MDI))
            if self.program_mode is not Mode.MDI:
                self.control.reset(run.channel)
            run.show_own_state()
            self._retained.commit()

    def _call_attention(self) -> None:
        """Something has happened that channels which run freely have to look up for."""
        for run in self.runs:
            run.execution.attention = True

    # ---- what happens on the machine -----------------------------------------------------------------------

    def _edge(self, name: str, value: float) -> None:
        """A signal has changed."""
        self.status.report("signal", name=name, value=value)
        if name.startswith(READ_IN_PROGRAMS):
            for run in self.runs:
                give(run.channel, {name: value})
                run.interpolator.wake()
        if name in self.keys and value:
            self._pressed.append(name)
            self._call_attention()
        for run in self.runs if value else ():
            run.execution.end_dwell(name)
            if name == SKIP_SIGNAL:
                run.skip_signal()
        if name == FEED_IS_100:
            self.set_rates()
        turn_magazine(self.signals, self.machine, name, value)
        self.interlocks.watch(name)

    def _machine_alarm(self, code: str) -> None:
        """The machine's controller raises an alarm: everything comes to rest, a reset ends it."""
        status = self.status
        if any(alarm.code == code for alarm in status.alarms):
            return
        number, place = self.runs.first.number, ("", 0)
        if status.state is State.RUNNING:
            blocks = ((run.number, run.execution.block) for run in self.runs)
            found = ((at, (block.program, block.line)) for at, block in blocks if block is not None)
            number, place = next(found, (number, place))
        status.show_alarms((*status.alarms, Alarm(self.control.id, code, *place)))
        status.report("event", number, type="alarm", code=code, line=place[1], program=place[0])
        if not status.is_locked and status.state is not State.BRAKING:
            self._bring_to_rest()
            status.become(State.ALARM, halt="alarm")

    @property
    def program_spindle(self) -> int:
        """Direction in which a program that waits wants to find the spindle turning: 1, -1, 0 for none."""
        if self.collected or self.switches.panel.mst_lock:  # cycle start starts it, or the program cannot
            return 0
        return next(filter(None, (run.execution.context.spindle_direction for run in self.runs)), 0)
