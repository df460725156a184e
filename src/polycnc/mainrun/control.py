"""A virtual control: what an operator's panel, a factory system or a Python program talk to.

    control = VirtualControl("fanuc-m")
    control.load("O1 ...")
    control.select_mode("auto")
    control.cycle_start()
    control.step(0.5)
    control.positions.work, control.state

Time is simulated and passes only in `step`, `run` and `run_until`; commands act at the moment at which the clock
stands. The same commands at the same times give the same trace, bit for bit.
"""

from __future__ import annotations

from dataclasses import replace
from math import ceil, inf
from typing import TYPE_CHECKING, Any

from polycnc.channel.channel import Channel
from polycnc.mainrun.ahead import Ahead
from polycnc.mainrun.automatic import Automatic
from polycnc.mainrun.display import MainRunDisplay
from polycnc.mainrun.errors import CommandRefused
from polycnc.mainrun.items import Rates
from polycnc.mainrun.machinery import Machinery
from polycnc.mainrun.manual import ManualAxes
from polycnc.mainrun.equipment import equipment
from polycnc.mainrun.program_signals import connect, give
from polycnc.mainrun.programs import Programs, forget_skipped, text_of
from polycnc.mainrun.signals import SignalImage
from polycnc.mainrun.snapshot import (
    ActiveBlock,
    Overrides,
    PanelSwitches,
    Positions,
    Record,
    Snapshot,
    SpindleState,
    ToolState,
)
from polycnc.mainrun.states import Command, Mode, State, is_allowed
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path

    from polycnc.control.interface import Control
    from polycnc.machine.model import Machine
    from polycnc.machine.setup import Setup
    from polycnc.mainrun.items import Block
    from polycnc.messages import Alarm
    from polycnc.program import Program
    from polycnc.toolpath import Event

#: Lowest and highest overrides, 1 for 100 % (Hartford manual, operator panel).
FEED_RANGE, RAPID_RANGE, SPINDLE_RANGE = (0.0, 2.0), (0.0, 1.0), (0.5, 1.2)
#: Jog rate and dry run speed at a feed override of 100 %, mm/min or degrees/min (Hartford manual).
JOG_RATE = 1000.0
#: The input that ends a skip move.
SKIP_SIGNAL = "SKIP"
#: What the reasons of a halt lead to; every other one stops.
HALTS = {"end": State.READY, "alarm": State.ALARM}
SINGLE_BLOCK_KINDS = ("", "SBL1", "SBL2", "SBL3")
#: The state that a run without limit may take at most: a day.
LONGEST_RUN_S = 86400.0


class VirtualControl:
    """One control with its machine, from power-on.

    Args:
        control: Control id.
        machine: Built-in machine or machine file; the setup's, or else the control's usual one.
        setup: Offsets, tools, parameters, inputs: what a case writes under `setup`, or a file with that.
        search: Folders in which calls look for subprograms.
        files: Further programs as texts, by name.

    Raises:
        KeyError: There is no such control.
        FileError: The machine or the setup is wrong.
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
        self._rates = Rates()
        self._cycles = 0
        self._programs = Programs(self.control.form, search, files or {})
        self._program_mode = Mode.AUTO
        self._typed: Program | None = None
        self._giving_up = False
        self._returning = False
        self._hand: list[float] | None = None
        self._locked_at: list[float] | None = None
        self._build(start)

    def _build(self, setup: Setup) -> None:
        """Power-on."""
        ahead = Ahead(self.machine, 1)
        channel = Channel(
            self.control, self.machine, setup, self._programs.store, toolpath=ahead.toolpath
        )
        self.channel, self._ahead = channel, ahead
        signals = {name: float(value) for name, value in setup.switches.signals.items() if _is_number(value)}
        self._signals = SignalImage(signals, self._on_edge, lambda: self.time)
        self._machinery = Machinery(
            self.machine,
            self._signals,
            lambda: self.time,
            (self._on_event, self._on_stop, self._on_block, self._on_halt, lambda: give(channel, self._signals)),
        )
        channel.push(self._programs.typed("\n"), kind="main")  # a control starts with a level to stand on
        try:
            self.control.start(channel)
        except AlarmError as error:
            self._raise_alarm(error)
        connect(channel, self._signals)
        ahead.use(channel, self.control.motion_settings(channel))
        position = channel.coordinates.machine
        ahead.clear(position)
        cycle = self.machine.interpolation_cycle_s
        self._automatic = Automatic(ahead, self._rates, self._machinery, position, cycle)
        self._manual = ManualAxes(channel.axis_data)
        self._display = MainRunDisplay(ahead.toolpath, self.machine, 1)
        self._show_channel()

    # ---- programs ------------------------------------------------------------------------------------------

    def load(self, source: str | bytes | Path) -> None:
        """Load a program: a file, or the text itself (`bytes`, or a `str` with line ends).

        Raises:
            CommandRefused: A program runs.
            ProgramFileError: The file cannot be read.
        """
        self._ask(Command.LOAD)
        self._programs.load(source)
        self.channel.store = self._programs.store

    def mdi(self, text: str) -> None:
        """Type blocks in and start them; allowed in MDI mode. What they change stays."""
        self._ask(Command.MDI)
        self._typed = self._programs.typed(text)
        self.cycle_start()

    # ---- running -------------------------------------------------------------------------------------------

    def cycle_start(self) -> None:
        """Start the program, or go on with it after a hold, a stop or a single block.

        Axes that were moved by hand meanwhile go back to where the program stands first.
        """
        self._ask(Command.CYCLE_START)
        if self._manual.moving:
            raise CommandRefused("mainrun.moving")
        if self.state is State.READY:
            program = self._typed if self.mode is Mode.MDI else self._programs.main
            if program is None:
                raise CommandRefused("mainrun.no-program")
            self._program_mode = self.mode
            self._prepare_channel()
            self._machinery.reset()
            self._ahead.start(program, self._automatic.position)
            self._resume()
        elif self.mode is not self._program_mode:
            raise CommandRefused("mainrun.other-mode", mode=self._program_mode)
        elif self._hand is not None:
            self._set_state(State.RUNNING)
            self._returning = True
            for axis, target in enumerate(self._automatic.machine):
                self._manual.towards(axis, self._hand[axis], target, self._jog_speed(axis), self.time)
        else:
            self._resume()

    def _resume(self) -> None:
        self._returning, self._hand = False, None
        self._rates.hold = False
        self._automatic.single_block = bool(self._switches.single_block)
        self._set_state(State.RUNNING)
        self._automatic.start()

    def feed_hold(self) -> None:
        """Bring the axes to rest on the path; a thread is finished first."""
        self._ask(Command.FEED_HOLD)
        if self.state is State.RUNNING:
            self._rates.hold = True
            self._automatic.revise()
            self._manual.brake_all(self.time)
            self._returning = False
            self._set_state(State.HOLD)

    def reset(self) -> None:
        """Give the program up: the axes brake, alarms go, modal states become those after reset."""
        if self.state is State.EMERGENCY:
            raise CommandRefused("mainrun.refused", command=Command.RESET, mode=self.mode, state=self.state)
        self._brake(State.BRAKING)

    def emergency_stop(self, *, pressed: bool = True) -> None:
        """Press the emergency stop, or pull it out again: then the control is as after reset."""
        if pressed:
            self._brake(State.EMERGENCY)
        elif self.state is State.EMERGENCY:
            self._brake(State.BRAKING)

    def _brake(self, state: State) -> None:
        self._rates.hold = self._giving_up = True
        self._automatic.revise()
        self._manual.brake_all(self.time)
        self._returning = False
        self._set_state(state)
        self._settle()

    # ---- by hand -------------------------------------------------------------------------------------------

    def select_mode(self, mode: Mode | str) -> None:
        """Turn the mode switch. A running program is held; it goes on in the same mode after cycle start."""
        mode = _one_of(Mode, "mode", mode)
        self._ask(Command.SELECT_MODE)
        if mode is not self.mode:
            if self.state is State.RUNNING:
                self.feed_hold()
            self._manual.brake_all(self.time)
            self.mode = mode
            self._report("mode", mode=mode)

    def jog(self, axis: str, direction: int, *, rapid: bool = False) -> None:
        """Press a jog key: the axis moves until `stop_jog`, or to its limit."""
        self._ask(Command.JOG)
        i = self._axis(axis)
        base = self._by_hand()
        speed = self._rapid_speed(i) if rapid else self._jog_speed(i)
        self._manual.towards(i, base[i], self._manual.along(i, direction, base[i]), speed, self.time)

    def stop_jog(self, axis: str | None = None) -> None:
        """Let a jog key go; all of them where no axis is named."""
        for i in range(len(self.channel.axes)) if axis is None else (self._axis(axis),):
            self._manual.brake(i, self.time)

    def increment(self, axis: str, steps: int, size: float = 0.001) -> None:
        """Move by steps of a size, as the machine display counts (mm or degrees; diameters where it shows them)."""
        self._ask(Command.INCREMENT)
        i = self._axis(axis)
        self._shift(i, steps * size, self._jog_speed(i))

    def handle(self, axis: str, pulses: int, size: float = 0.001) -> None:
        """Turn the handwheel: the axis follows its pulses as fast as it can."""
        self._ask(Command.HANDLE)
        i = self._axis(axis)
        self._shift(i, pulses * size, self._rapid_speed(i))

    def home(self, axis: str | None = None) -> None:
        """Approach the first reference point; with all axes where none is named."""
        self._ask(Command.HOME)
        base = self._by_hand()
        for i in range(len(self.channel.axes)) if axis is None else (self._axis(axis),):
            target = self.channel.axis_data[i].reference_points[0]
            self._manual.towards(i, base[i], target, self._rapid_speed(i), self.time)

    def _shift(self, axis: int, shown: float, speed: float) -> None:
        base = self._by_hand()
        factor = self._display.machine_factor(axis, self._automatic.context)
        target = self._manual.goal(axis, base[axis]) + shown / factor
        self._manual.towards(axis, base[axis], target, speed, self.time)

    def _by_hand(self) -> list[float]:
        """Machine position from which axes are moved by hand."""
        if self._automatic.moving:
            raise CommandRefused("mainrun.moving")
        if self._hand is None:
            self._hand = self._automatic.machine
        return self._manual.positions(self._hand, self.time)

    def _jog_speed(self, axis: int) -> float:
        top = self.channel.axis_data[axis].max_feed or inf
        return min(JOG_RATE / 60.0 * self._rates.feed, top)

    def _rapid_speed(self, axis: int) -> float:
        return (self.channel.axis_data[axis].rapid or 1e9) * self._rates.rapid

    # ---- switches ------------------------------------------------------------------------------------------

    def override(
        self, *, feed: float | None = None, rapid: float | None = None, spindle: float | None = None
    ) -> None:
        """Turn the override switches; 1 is 100 %. They act at once, within what the axes can do."""
        new = {"feed": (feed, FEED_RANGE), "rapid": (rapid, RAPID_RANGE), "spindle": (spindle, SPINDLE_RANGE)}
        for name, (value, (low, high)) in new.items():
            if value is not None and not low <= value <= high:
                raise CommandRefused("mainrun.value", name=name, allowed=f"{low:g} … {high:g}", value=value)
        for name, (value, _) in new.items():
            if value is not None:
                setattr(self._rates, name, float(value))
                self._report("override", name=name, value=float(value))
        base = self.machine_position
        for axis in self._manual.goals:
            speed = self._rapid_speed(axis) if self.mode is Mode.REFERENCE else self._jog_speed(axis)
            self._manual.change_speed(axis, base[axis], speed, self.time)
        self._automatic.revise()

    def set_switches(self, **changes: Any) -> None:
        """Turn panel switches, by the names of `PanelSwitches`.

        `single_block` is `SBL1`, `SBL2`, `SBL3`, or True for the first; `block_skip` True, False, or levels. Optional
        stop and single block act on the block in execution, block skip on blocks that are not prepared yet.
        """
        if "single_block" in changes:
            kind = changes["single_block"]
            changes["single_block"] = "SBL1" if kind is True else kind or ""
            if changes["single_block"] not in SINGLE_BLOCK_KINDS:
                allowed = ", ".join(SINGLE_BLOCK_KINDS[1:])
                raise CommandRefused("mainrun.value", name="single_block", allowed=allowed, value=kind)
        if changes.get("block_skip", self._switches.block_skip) != self._switches.block_skip:
            forget_skipped(self.channel)
        if "machine_lock" in changes and changes["machine_lock"] != self._switches.machine_lock:
            self._ask(Command.MACHINE_LOCK)
            self._lock(on=bool(changes["machine_lock"]))
        self._switches = replace(self._switches, **changes)
        self._rates.dry_run = JOG_RATE / 60.0 if self._switches.dry_run else 0.0
        self._machinery.optional_stop = self._switches.optional_stop
        self._automatic.single_block = bool(self._switches.single_block)
        self._apply_switches()
        self._automatic.revise()
        self._report("switch", **changes)

    def _lock(self, *, on: bool) -> None:
        """Machine lock: the axes stand while the display runs on; when it ends, the display shows the axes again."""
        position = self.machine_position
        if not on and self._locked_at is not None:
            self._stand_at(self._locked_at)
        self._locked_at = position if on else None

    def _apply_switches(self) -> None:
        channel, panel = self.channel, self._switches
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

    # ---- time ----------------------------------------------------------------------------------------------

    @property
    def time(self) -> float:
        """Simulated time since power-on, s: a whole number of interpolation cycles, between commands."""
        return self._automatic.time

    def step(self, seconds: float | None = None) -> None:
        """Let time pass: the given seconds in whole interpolation cycles, or one cycle."""
        cycle = self.machine.interpolation_cycle_s
        self._cycles += 1 if seconds is None else max(round(seconds / cycle), 0)
        self._advance(self._cycles * cycle)

    def run(self, *, limit_s: float = LONGEST_RUN_S, real_time: bool = False) -> State:
        """Let time pass until nothing runs any more; gives the state then.

        Args:
            limit_s: No longer than this.
            real_time: As fast as time really passes; else as fast as the computer can.
        """
        if real_time:
            return self._run_in_real_time(limit_s)
        cycle = self.machine.interpolation_cycle_s
        last = self._cycles + ceil(limit_s / cycle)
        while self.is_busy and self._cycles < last and (due := self._due()) < inf:
            # Whole pieces in one step: nothing can happen before `due` but by a command.
            self._cycles = min(max(ceil(due / cycle - 1e-9), self._cycles + 1), last)
            self._advance(self._cycles * cycle)
        return self.state

    def run_until(self, reached: Callable[[VirtualControl], bool], *, limit_s: float = LONGEST_RUN_S) -> bool:
        """Let time pass, cycle by cycle, until a condition holds; false if it did not within the limit."""
        last = self._cycles + ceil(limit_s / self.machine.interpolation_cycle_s)
        while not reached(self):
            if self._cycles >= last:
                return False
            self.step()
        return True

    def _run_in_real_time(self, limit_s: float) -> State:
        from time import monotonic, sleep

        began, at = monotonic(), self.time
        while self.is_busy and self.time - at < limit_s:
            self.step()
            sleep(max(self.time - at - (monotonic() - began), 0.0))
        return self.state

    @property
    def is_busy(self) -> bool:
        """Whether something runs or moves."""
        moving = self._automatic.moving or bool(self._manual.moving)
        return moving or self.state in (State.RUNNING, State.BRAKING)

    def _due(self) -> float:
        return min(self._automatic.next_event, self._manual.due)

    def _advance(self, until: float) -> None:
        """Go from event to event."""
        while (due := self._due()) < until:
            self._move_to(max(due, self.time))
        self._move_to(until)

    def _move_to(self, time: float) -> None:
        self._automatic.advance(time)
        if self._hand is not None:
            self._hand = self._manual.settle(self._hand, self.time)
        self._settle()

    def _settle(self) -> None:
        """What follows when axes have come to rest."""
        if self._manual.moving:
            return
        if self._giving_up and not self._automatic.moving:
            self._give_up()
        elif self._returning and not self._manual.goals:
            self._resume()
        elif self._hand is not None and self.state is State.READY and not self._manual.goals:
            self._stand_at(self._hand)

    def _give_up(self) -> None:
        """The axes stand: the program is given up, the control is as after reset."""
        self._giving_up = self._rates.hold = False
        here = self.machine_position
        self._automatic.abandon()
        self._machinery.reset()
        self.control.reset(self.channel)
        self._stand_at(here)
        if self.state is not State.EMERGENCY:
            self.alarms = ()
            self._set_state(State.READY)

    def _stand_at(self, position: Sequence[float]) -> None:
        """The axes stand here and no program runs."""
        self._hand = None
        self._automatic.position = list(position)
        self._prepare_channel()
        self._ahead.clear(position)
        self._show_channel()

    def _prepare_channel(self) -> None:
        self.channel.coordinates.arrive_machine(list(self._automatic.position))
        self._apply_switches()

    def _show_channel(self) -> None:
        """Between programs the displays show the channel's own state."""
        self._automatic.context = self.control.context(self.channel)
        self._automatic.modal = self.channel.mode.codes

    # ---- what happens --------------------------------------------------------------------------------------

    def _on_event(self, event: Event) -> None:
        self._report("event", type=event.type, **event.data)

    def _on_block(self, block: Block) -> None:
        self._report("block", program=block.program, line=block.line)

    def _on_edge(self, name: str, value: float) -> None:
        self._report("signal", name=name, value=value)
        if name == SKIP_SIGNAL and value:
            here = self._automatic.skip_signal()
            if here is not None:
                self.channel.memory.note_skip(self._display.work_of(here, self._automatic.context))

    def _on_stop(self, code: str) -> None:
        if code == "alarm":
            self.alarms = tuple(self.channel.alarms)
        self._automatic.stop(code)

    def _on_halt(self, reason: str) -> None:
        """The run has halted of its own accord."""
        if self.state is State.RUNNING:
            self._set_state(HALTS.get(reason, State.STOPPED), halt=reason)
        if reason == "end":
            self.parts += self._program_mode is Mode.AUTO
            if self._program_mode is Mode.AUTO:
                self.control.reset(self.channel)
            self._show_channel()

    def _raise_alarm(self, error: AlarmError) -> None:
        from polycnc.messages import Alarm

        self.alarms = (
            Alarm(self.control.id, error.code, args=dict(error.args_by_name), hint=error.hint, detail=error.detail),
        )
        self.state = State.ALARM

    def _set_state(self, state: State, **data: object) -> None:
        if state is not self.state:
            self.state = state
            self._report("state", state=state, **data)

    def _report(self, what: str, **data: object) -> None:
        if self.listeners:
            record = Record(self.time, what, data)
            for listener in self.listeners:
                listener(record)

    def _ask(self, command: Command) -> None:
        if not is_allowed(command, self.mode, self.state):
            raise CommandRefused("mainrun.refused", command=command, mode=self.mode, state=self.state)

    def allows(self, command: Command | str) -> bool:
        """Whether a command may be given in this mode and state."""
        return is_allowed(_one_of(Command, "command", command), self.mode, self.state)

    def _axis(self, name: str) -> int:
        index = self.channel.axis_index.get(name.upper())
        if index is None:
            raise CommandRefused("mainrun.axis", axis=name, known=", ".join(self.channel.axes))
        return index

    # ---- what a panel reads --------------------------------------------------------------------------------

    @property
    def machine_position(self) -> list[float]:
        """Commanded machine position of all axes, mm (radius) and degrees."""
        if self._hand is not None:
            return self._manual.positions(self._hand, self.time)
        return self._automatic.machine

    @property
    def positions(self) -> Positions:
        """Positions as the displays show them."""
        here = self.machine_position
        end = self._automatic.row_end if self._hand is None else here
        real = here if self._locked_at is None else self._locked_at
        return self._display.positions(here, end, real, self._automatic.context)

    @property
    def modal(self) -> Mapping[str, str]:
        """Active code of every modal group in the block in execution."""
        return dict(self._automatic.modal)

    @property
    def active_block(self) -> ActiveBlock:
        """The block in execution."""
        block = self._automatic.block
        if block is None:
            return ActiveBlock()
        program = next((p for p in reversed(self.channel.programs) if p.name == block.program), None)
        return ActiveBlock(block.program, block.line, text_of(program, block.line))

    @property
    def program(self) -> str:
        """Name of the loaded program; empty for none."""
        return self._programs.main.name if self._programs.main is not None else ""

    @property
    def messages(self) -> tuple[str, ...]:
        """Texts that the program has put out."""
        return tuple(self._machinery.messages)

    @property
    def spindle(self) -> SpindleState:
        """The spindle of the block in execution."""
        context = self._automatic.context
        spindle = self.machine.spindle.get(context.spindle)
        top = spindle.max_rpm if spindle is not None else inf
        turning = 0.0 if context.surface_speed or not context.spindle_direction else context.spindle_rpm
        rpm = min(turning * self._rates.spindle, top)
        return SpindleState(context.spindle, context.spindle_rpm, rpm, context.spindle_direction)

    @property
    def tool(self) -> ToolState:
        """Tool in the spindle, and the one that stands by."""
        context = self._automatic.context
        return ToolState(context.tool, context.tool_name, self._machinery.next_tool)

    @property
    def signals(self) -> SignalImage:
        """The signal image; inputs can be set."""
        return self._signals

    @property
    def feed(self) -> float:
        """Path speed now, mm/min; of the fastest axis where axes are moved by hand."""
        return 60.0 * max(self._automatic.speed, self._manual.speed(self.time))

    @property
    def switches(self) -> PanelSwitches:
        """The panel's switches."""
        return self._switches

    @property
    def snapshot(self) -> Snapshot:
        """Everything at once, of one moment."""
        rates = self._rates
        return Snapshot(
            time=self.time,
            mode=self.mode,
            state=self.state,
            halt=self._automatic.halt,
            positions=self.positions,
            feed=self.feed,
            program=self.program,
            block=self.active_block,
            modal=self.modal,
            spindle=self.spindle,
            tool=self.tool,
            overrides=Overrides(rates.feed, rates.rapid, rates.spindle),
            switches=self._switches,
            signals=self._signals.values,
            alarms=self.alarms,
            messages=self.messages,
            parts=self.parts,
        )


def _one_of(kind: Any, name: str, value: object) -> Any:
    try:
        return kind(str(value).lower())
    except ValueError:
        allowed = ", ".join(kind)
        raise CommandRefused("mainrun.value", name=name, allowed=allowed, value=value) from None


def _is_number(value: object) -> bool:
    return isinstance(value, int | float)
