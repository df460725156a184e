"""What a virtual control is made of, and how its time passes."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from polycnc.channel.channel import Channel
from polycnc.channel.group import ChannelGroup
from polycnc.channel.waits import TYPED_BLOCKS_DONE
from polycnc.mainrun.axes.manual import ManualAxes
from polycnc.mainrun.axes.shared_axes import SharedAxes
from polycnc.mainrun.commands.programs import Programs
from polycnc.mainrun.commands.states import Mode, State
from polycnc.mainrun.equipment import equipment
from polycnc.mainrun.execution.channel_run import ChannelRun
from polycnc.mainrun.execution.execution import Execution
from polycnc.mainrun.execution.machinery import SKIP_SIGNAL, Machinery
from polycnc.mainrun.preparation.items import Happening, Rates
from polycnc.mainrun.preparation.preprocessing import Preprocessing
from polycnc.mainrun.reading.display import MainRunDisplay
from polycnc.mainrun.reading.snapshot import PanelSwitches, Record
from polycnc.mainrun.signals.guard import Guard
from polycnc.mainrun.signals.image import SignalImage
from polycnc.mainrun.signals.machine_states import axis_states, machine_states, turn_magazine
from polycnc.mainrun.signals.program_signals import connect, give
from polycnc.messages import Alarm, AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence
    from pathlib import Path

    from polycnc.channel.waits import Wait
    from polycnc.control.interface import Control
    from polycnc.machine.model import Machine
    from polycnc.machine.setup import Setup
    from polycnc.mainrun.preparation.items import Block
    from polycnc.program import Program
    from polycnc.toolpath import Event

#: Keys of the panel that signals can press.
KEYS = frozenset({"CYCLE_START", "FEED_HOLD", "RESET", "EMERGENCY_STOP", "POWER_OFF"})
#: What the reasons of a halt lead to; every other one stops.
LOCKED_STATES = frozenset((State.EMERGENCY, State.OFF))
#: Jog rate at a feed override of 100 %, mm/min or degrees/min (Hartford manual).
JOG_RATE = 1000.0
#: Programmed stops that the machine's rules know of.
HALT_SIGNALS = {"M00": "HALT_M00", "M0": "HALT_M00", "M01": "HALT_M01", "M1": "HALT_M01"}
#: Manual absolute: coordinates count what is moved by hand while a program waits (FANUC *ABSM, which means on by 0).
MANUAL_ABSOLUTE = "MANUAL_ABSOLUTE"
#: The program has ended without going back to its top: M02 on machines whose rules latch this, or by the control's
#: parameters. A reset goes back.
AT_END = "M02_END"
PROGRAM_ENDS = frozenset((2, 30))
#: The soft key that holds the feed at 100 %.
FEED_IS_100 = "F_100"
HALTS = {"end": State.READY, "alarm": State.ALARM}
SINGLE_BLOCK_KINDS = ("", "SBL1", "SBL2", "SBL3")


class Core(ABC):
    """The parts of a virtual control and the events between them; commands and readings stand above it.

    Attributes:
        control: The control.
        machine: Its machine.
        channel: The channel; it runs ahead of the axes.
        mode: What the mode switch says.
        state: What the control is doing.
        alarms: Alarms that wait for reset.
        parts: How often a program has come to its end.
        listeners: Called with each `Record`, in order.
    """

    def __init__(
        self,
        control: str | Control,
        *,
        machine: str | Path | Machine | None = None,
        setup: Mapping[str, Any] | str | Path | Setup | None = None,
        search: Sequence[str | Path] = (),
        files: Mapping[str, str] | None = None,
    ) -> None:
        self.control, self.machine, start = equipment(control, machine, setup)
        self.listeners: list[Callable[[Record], object]] = []
        self.mode, self.state = Mode.AUTO, State.READY
        self.alarms: tuple[Alarm, ...] = ()
        self.parts = 0
        self._switches = PanelSwitches(
            start.switches.single_block, start.switches.optional_stop, start.switches.block_skip
        )
        self._rates, self._dials = Rates(), Rates()
        self._cycles = 0
        self._programs = Programs(self.control.form, search, files or {})
        self._program_mode = self._waiting_mode = Mode.AUTO
        self._typed: Program | None = None
        self._giving_up = False
        self._returning = self._searched = False
        self._tape: Program | None = None
        self._locked_at: dict[int, float] = {}
        self._collected: list[Happening] = []
        self._pressed: list[str] = []
        self._build(start)

    def _build(self, setup: Setup) -> None:
        """Power-on."""
        given = setup.switches.signals.items()
        signals = {name: float(value) for name, value in given if isinstance(value, int | float)}
        signals.setdefault(MANUAL_ABSOLUTE, 1.0)
        cycle = self.machine.interpolation_cycle_s
        self._setup = setup
        rules = (*self.control.plc.rules, *self.machine.rules)
        states = {**machine_states(self), **axis_states(self)}
        self._signals = SignalImage(signals, rules, self._on_edge, lambda: self.time, cycle, states)
        self._guard = Guard(self.control.plc, self._signals, self._machine_alarm)
        self._shared = SharedAxes(self.machine)
        self._runs: dict[int, ChannelRun] = {}
        self._run = run = self._new_run(self.machine.channels[0].number, setup)
        self.channel, self._preprocessing, self._execution = run.channel, run.preprocessing, run.execution
        self._machinery, self._display = run.machinery, run.display
        self._group = ChannelGroup(self.channel, self._further_channel, self._on_start)
        self._power_on(run)
        self._signals[self.mode.upper()] = self._signals[self.state.upper()] = 1.0
        self._signals.scan()
        self._guard.look()

    def _new_run(self, number: int, setup: Setup) -> ChannelRun:
        """A channel of the control; `_power_on` starts it."""
        preprocessing = Preprocessing(self.machine, number, self._shared)
        channel = Channel(
            self.control,
            self.machine,
            setup,
            self._programs.store,
            number=number,
            toolpath=preprocessing.toolpath,
        )
        reports = (
            partial(self._on_event, number),
            partial(self._on_stop, number),
            partial(self._on_block, number),
            partial(self._on_halt, number),
            lambda: give(channel, self._signals),
            self._guard,
        )
        machinery = Machinery(self.machine, self._signals, lambda: self._runs[number].execution.time, reports)
        position = channel.coordinates.machine
        execution = Execution(
            preprocessing, self._rates, machinery, position, self.machine.interpolation_cycle_s,
            setup.switches.skip_signal_after,
        )  # fmt: skip
        display = MainRunDisplay(preprocessing.toolpath, self.machine, number)
        manual = ManualAxes(channel.axis_data, self.control.motion_settings(channel))
        run = ChannelRun(
            channel,
            preprocessing,
            execution,
            machinery,
            display,
            manual,
            self._rates,
            self._runs,
            self._shared,
        )
        self._runs[number], self._shared.paths[number] = run, preprocessing
        return run

    def _further_channel(self, number: int) -> Channel:
        run = self._new_run(number, self.channel.setup)
        run.channel.group = self._group
        self._power_on(run)
        return run.channel

    def _power_on(self, run: ChannelRun) -> None:
        channel = run.channel
        channel.push(self._programs.typed("\n"), kind="main")  # a control starts with a level to stand on
        try:
            self.control.start(channel)
        except AlarmError as error:
            self._raise_alarm(error)
        connect(channel, self._signals)
        run.preprocessing.use(channel, self.control.motion_settings(channel))
        run.preprocessing.clear(channel.coordinates.machine)
        run.execution.position = channel.coordinates.machine
        run.show_own_state()

    def _on_start(self, number: int, waits: Iterator[Wait]) -> None:
        """A channel has started another one."""
        run = self._runs[number]
        self._prepare(run)
        run.machinery.reset()
        self._execution.attention = True
        run.preprocessing.begin(waits, run.execution.position)
        run.execution.time = max(each.execution.time for each in self._runs.values())
        run.execution.single_block = bool(self._switches.single_block)
        if self.state is State.RUNNING:
            run.execution.start()

    # ---- time ----------------------------------------------------------------------------------------------

    @property
    def time(self) -> float:
        """Simulated time since power-on, s: a whole number of interpolation cycles, between commands."""
        return self._execution.time

    @property
    def machine_position(self) -> list[float]:
        """Commanded position of the real axes of the first channel, mm (radius) and degrees."""
        return self._run.machine_position

    @property
    def halt(self) -> str:
        """Why the program stands (`M00`, `M01`, `single-block` …), or empty."""
        return self._execution.halt or next(
            (run.execution.halt for run in self._runs.values() if run.execution.halt not in ("", "end")),
            "",
        )

    @property
    def _axes_move(self) -> bool:
        """Whether axes move because of a program."""
        return any(run.execution.moving for run in self._runs.values())

    def _due(self) -> float:
        return min(min(run.manual.due, run.execution.next_event) for run in self._runs.values())

    def _advance(self, until: float) -> None:
        """Go from event to event."""
        if self._runs_freely:
            self._execution.advance(until, freely=True)
            self._move_to(self.time)
        while (due := self._due()) < until:
            self._move_to(max(due, self.time))
        self._move_to(until)

    @property
    def _runs_freely(self) -> bool:
        """Whether one channel runs its program, and nothing else happens."""
        run, quiet = self._run, not (self._giving_up or self._returning)
        return quiet and len(self._runs) == 1 and run.manual.place is None and run.execution.running

    def _move_to(self, time: float) -> None:
        for run in list(self._runs.values()):
            run.execution.advance(time)
        while [run for run in self._runs.values() if run.execution.look_up()]:
            for run in list(self._runs.values()):
                run.execution.advance(time)
        self._look_for_deadlock()
        for run in self._runs.values():
            run.manual.arrive(time)
        self._follow_up()

    def _follow_up(self) -> None:
        """What follows when keys were pressed by signals, or axes have come to rest."""
        while self._pressed:
            self._press(self._pressed.pop(0))
        if self._by_hand:
            return
        goals = any(run.manual.goals for run in self._runs.values())
        if self._giving_up and not self._axes_move:
            self._give_up()
        elif self._returning and not goals:
            self._resume()
        elif self.state is State.READY and not goals:
            self._stand()
        if self.mode is Mode.REFERENCE and not goals:
            self._note_references()

    @property
    def _by_hand(self) -> bool:
        """Whether an axis moves because of an operator."""
        return any(run.manual.moving for run in self._runs.values())

    @property
    def _left_path(self) -> bool:
        """Whether an axis has been moved by hand since a program led it."""
        return any(run.manual.place is not None for run in self._runs.values())

    def _note_references(self) -> None:
        """Axes that have come to their reference points know their position."""
        for name in self.channel.axes:
            if self._signals[f"NOT_REFERENCED_{name}"] and self._signals[f"{name}_AT_REFERENCE"]:
                self._signals[f"NOT_REFERENCED_{name}"] = 0.0

    def _resume(self) -> None:
        self._returning = self._searched = self._rates.hold = self._rates.gives_up = False
        for run in self._runs.values():
            run.manual.leave()
        self._end_halt()
        self._set_state(State.RUNNING)
        for run in list(self._runs.values()):
            if run.is_active:
                run.execution.single_block = bool(self._switches.single_block)
                run.execution.start()

    def _look_for_deadlock(self) -> None:
        """Every channel that is still there waits for another one: nothing will ever happen again."""
        here = [run for run in self._runs.values() if run.is_active]
        if not here or any(not run.execution.waits_for_channel for run in here):
            return
        if self._run.is_active:
            self._preprocessing.fail(AlarmError("PC0005"))
            self._execution.start()
            return
        for run in here:
            run.give_up()  # the run ends with the first channel
        self._finish()

    def _finish(self) -> None:
        """No channel runs any more."""
        if self.state is State.RUNNING:
            self._set_state(State.READY, halt="end")

    @abstractmethod
    def _press(self, key: str) -> None:
        """A key of the panel, as a signal."""

    def _give_up(self) -> None:
        """The axes stand: the program is given up, the control is as after reset."""
        self._giving_up = self._searched = self._rates.hold = self._rates.gives_up = False
        self._end_halt()
        self._pulse("ENDED")
        self._signals[AT_END] = 0.0
        here = {number: run.machine_position for number, run in self._runs.items()}
        for number, run in self._runs.items():
            run.give_up()
            if self.state in LOCKED_STATES:
                self.control.stop_spindles(run.channel)
            run.stand_at(here[number])
            self._prepare(run)
        if self.state not in LOCKED_STATES:
            self.alarms = ()
            self._set_state(State.READY)
            self._guard.look()

    def _stand(self) -> None:
        """No program runs: axes that were moved by hand are where one would begin."""
        for run in self._runs.values():
            if run.manual.place is not None:
                run.stand_at(run.manual.place)
                self._prepare(run)

    def _prepare(self, run: ChannelRun) -> None:
        """Before a program of a channel begins: it is where its axes are."""
        run.channel.coordinates.arrive_machine(list(run.execution.position))
        self._apply_switches(run.channel)

    def _revise(self) -> None:
        """What bounds the speeds has changed."""
        for run in self._runs.values():
            run.execution.revise()

    def _brake_hands(self) -> None:
        """Axes that are moved by hand come to rest."""
        for run in self._runs.values():
            run.manual.brake_all(self.time)

    def _brake(self, state: State) -> None:
        self._rates.hold = self._rates.gives_up = self._giving_up = True
        self._revise()
        self._brake_hands()
        self._returning = False
        self._set_state(state)
        self._follow_up()

    def _apply_switches(self, channel: Channel) -> None:
        panel = self._switches
        skip = panel.block_skip
        switches = replace(
            channel.setup.switches,
            single_block=panel.single_block or SINGLE_BLOCK_KINDS[1],  # so that blocks are run one by one
            block_skip=skip,
            optional_stop=panel.optional_stop,
            mode="mdi" if self._program_mode is Mode.MDI else "memory",
        )
        channel.setup = replace(channel.setup, switches=switches)
        channel.skip_levels = sum(1 << level for level in ((1,) if skip is True else skip or ()))
        # Whether to halt is decided when the block is executed, not when it is prepared.
        channel.single_block = channel.block_by_block = channel.optional_stop = True

    # ---- what happens --------------------------------------------------------------------------------------

    def _on_event(self, number: int, event: Event) -> None:
        self._report("event", number, type=event.type, **event.data)
        code = event.data.get("code") if event.type == "m" else None
        if code in PROGRAM_ENDS and self.control.stays_at_end(self.channel, code):
            self._signals[AT_END] = 1.0

    def _on_block(self, number: int, block: Block) -> None:
        self._report("block", number, program=block.program, line=block.line)

    def _on_edge(self, name: str, value: float) -> None:
        self._report("signal", name=name, value=value)
        if name in KEYS and value:
            self._pressed.append(name)
            self._execution.attention = True
        if name == SKIP_SIGNAL and value:
            for run in self._runs.values():
                here = run.execution.skip_signal()
                if here is not None:
                    run.channel.memory.note_skip(run.display.work_of(here, run.execution.context))
        if name == FEED_IS_100:
            self._set_rates()
        turn_magazine(self._signals, self.machine, name, value)
        self._guard.watch(name)

    def _on_stop(self, number: int, code: str) -> None:
        if code == "alarm":
            self.alarms = tuple(self.channel.alarms)
        self._runs[number].execution.stop(code)

    def _on_halt(self, number: int, reason: str) -> None:
        """The run of a channel has halted of its own accord; the control does when no other one runs."""
        run = self._runs[number]
        if reason == "end":
            self._group.end(number)
        others = [other for other in self._runs.values() if other is not run and other.is_active]
        if self.state is State.RUNNING:
            if reason in HALT_SIGNALS:
                self._signals[HALT_SIGNALS[reason]] = 1.0
            if reason == "alarm" or not any(other.execution.running for other in others):
                self._set_state(
                    HALTS.get("stop" if others and reason == "end" else reason, State.STOPPED), halt=reason
                )
            else:
                self._report("halt", number, halt=reason)
        if reason == TYPED_BLOCKS_DONE.reason:
            self._program_mode = self._waiting_mode
            self._apply_switches(run.channel)
        if reason == "alarm" and others:
            self._rates.hold = True
            self._revise()
        if reason == "end" and run is self._run:
            self.parts += self._program_mode is not Mode.MDI
            if self._program_mode is not Mode.MDI:
                self.control.reset(self.channel)
            run.show_own_state()

    def _end_halt(self) -> None:
        for name in HALT_SIGNALS.values():
            self._signals[name] = 0.0

    def _pulse(self, signal: str) -> None:
        """Something happens that has no length in time; the rules answer."""
        self._signals[signal] = 1.0
        self._signals[signal] = 0.0

    def _set_rates(self) -> None:
        """The speeds follow the override switches; a soft key of the machine holds the feed at 100 %."""
        dials, rates = self._dials, self._rates
        rates.feed_cancelled = bool(self._signals[FEED_IS_100])
        rates.feed = 1.0 if rates.feed_cancelled else dials.feed
        rates.rapid, rates.spindle = dials.rapid, dials.spindle
        in_dry_run = self._switches.dry_run and self._program_mode is not Mode.TAPE
        dry = rates.dry_run = self.control.motion_settings(self.channel).dry_run if in_dry_run else None
        for run in self._runs.values():
            run.preprocessing.free_threads(free=dry is not None and dry.with_spindle)
        self._revise()

    def _machine_alarm(self, code: str) -> None:
        """The machine's controller raises an alarm: everything comes to rest, a reset ends it."""
        if any(alarm.code == code for alarm in self.alarms):
            return
        block = self._execution.block if self.state is State.RUNNING else None
        place = (block.program, block.line) if block is not None else ("", 0)
        self.alarms = (*self.alarms, Alarm(self.control.id, code, *place))
        self._report("event", 1, type="alarm", code=code, line=place[1], program=place[0])
        if self.state not in LOCKED_STATES and self.state is not State.BRAKING:
            self._rates.hold = True
            self._returning = False
            self._revise()
            self._brake_hands()
            self._set_state(State.ALARM, halt="alarm")

    @property
    def program_spindle(self) -> int:
        """Direction in which a program that waits wants to find the spindle turning: 1, -1, 0 for none."""
        if self._collected or self._switches.mst_lock:  # cycle start still starts it, or the program cannot
            return 0
        return self._execution.context.spindle_direction

    @property
    def switches(self) -> PanelSwitches:
        """The panel's switches."""
        return self._switches

    @property
    def waiting_tool(self) -> int | str:
        """The tool that stands by."""
        return self._machinery.next_tool

    def _raise_alarm(self, error: AlarmError) -> None:
        self.alarms = (
            Alarm(
                self.control.id,
                error.code,
                args=dict(error.args_by_name),
                hint=error.hint,
                detail=error.detail,
            ),
        )
        self.state = State.ALARM

    def _set_state(self, state: State, **data: object) -> None:
        if state is not self.state:
            self._signals[self.state.upper()] = 0.0
            self.state = state
            self._signals[state.upper()] = 1.0
            self._report("state", state=state, **data)

    def _report(self, what: str, channel: int = 1, /, **data: object) -> None:
        if self.listeners:
            if channel != 1:
                data["channel"] = channel
            record = Record(self.time, what, data)
            for listener in self.listeners:
                listener(record)
