"""A virtual control: what an operator's panel, a factory system or a Python program talk to.

    control = VirtualControl("fanuc-m")
    control.load("O1 ...")
    control.cycle_start()
    control.step(0.5)
    control.positions.work, control.state

Time is simulated and passes only in `step`, `run` and `run_until`; commands act at the moment at which the clock
stands. The same commands at the same times give the same trace, bit for bit.

The control is made of objects, and does nothing itself: `MainLoop` lets time pass, `Operation` goes from state to
state, `ProgramCommands`, `HandCommands` and `SwitchCommands` are the operator's, `Readings` is what can be read.
"""

from __future__ import annotations

from polycnc.channel.channel import DEFAULT_BLOCK_LIMIT
from polycnc.channel.states.snapshot import Snapshot as Checkpoint
from polycnc.control.alarm_text import catalogue_of
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.mainrun.commands.data import DataCommands
from polycnc.mainrun.commands.hand import HandCommands
from polycnc.mainrun.commands.permission import Permission
from polycnc.mainrun.commands.program_keys import ProgramCommands
from polycnc.mainrun.commands.programs import Programs
from polycnc.mainrun.commands.search import SearchMode
from polycnc.mainrun.commands.settings import Switches
from polycnc.mainrun.commands.states import Command, Mode, State, is_allowed
from polycnc.mainrun.commands.switches import SwitchCommands
from polycnc.mainrun.equipment import equipment
from polycnc.mainrun.errors import one_of
from polycnc.mainrun.execution.clock import Clock
from polycnc.mainrun.execution.main_loop import LONGEST_RUN_S, MainLoop
from polycnc.mainrun.execution.operation import MANUAL_ABSOLUTE, Operation
from polycnc.mainrun.reading.forecast import forecast_of
from polycnc.mainrun.reading.readings import Readings
from polycnc.mainrun.signals.image import SignalImage
from polycnc.mainrun.signals.interlocks import Interlocks
from polycnc.mainrun.status import Counters, Status
from polycnc.memory.retained import PANEL, PROGRAMS, opened
from polycnc.messages.catalogue import language

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path

    from polycnc.channel.channel import Channel
    from polycnc.control.interface import Control
    from polycnc.control.parameters import KnownParameter
    from polycnc.machine.model import Machine
    from polycnc.machine.setup.values import Setup
    from polycnc.mainrun.commands.data import ProgramEntry
    from polycnc.mainrun.preparation.items import Places
    from polycnc.mainrun.reading.forecast import Forecast
    from polycnc.mainrun.reading.snapshot import (
        ActiveBlock,
        ChannelSnapshot,
        PanelSwitches,
        Positions,
        Record,
        Snapshot,
        SpindleState,
        ToolState,
    )
    from polycnc.memory.retained import RetainedStore
    from polycnc.messages import Alarm


class VirtualControl:
    """One control with its machine, from power-on.

    Args:
        control: Control id.
        machine: Built-in machine or machine file; the setup's, or else the control's usual one.
        setup: Offsets, tools, parameters, inputs: what a case writes under `setup`, or a file with that.
        search: Folders in which calls look for subprograms.
        files: Further programs as texts, by name.
        retained: What outlives the power: offsets, variables, parameters, edited programs, alarms. Where it holds
            something already, the setup does not count. The path of a memory file, a store, or None for one that
            lasts as long as the object.

    Attributes:
        control: The control.
        machine: Its machine.
        catalogue: The texts of all alarms and messages of both.
        signals: The signal image; inputs can be set.

    Raises:
        CommandRefused: There is no such control.
        FileError: The machine or the setup is wrong.
        MemoryFileError: The memory file cannot be used.
    """

    def __init__(
        self,
        control: str | Control,
        *,
        machine: str | Path | Machine | None = None,
        setup: Mapping[str, Any] | str | Path | Setup | None = None,
        search: Sequence[str | Path] = (),
        files: Mapping[str, str] | None = None,
        retained: RetainedStore | str | Path | None = None,
    ) -> None:
        self.control, self.machine, start = equipment(control, machine, setup)
        given = start.switches.signals.items()
        signals = {name: float(value) for name, value in given if isinstance(value, int | float)}
        signals.setdefault(MANUAL_ABSOLUTE, 1.0)
        plc, clock = self.machine.plc(self.control.id), Clock(self.machine.interpolation_cycle_s)
        self.catalogue = catalogue_of(self.control, self.machine)
        self.signals = SignalImage(signals, plc.rules, clock)
        interlocks = Interlocks(plc, self.signals)
        retained = self._retained = opened(retained, self.control.id, self.machine.id)
        self._status = Status(self.control.id, clock, self.signals, retained)
        edited = retained.table(PROGRAMS)
        self._programs = Programs(self.control.form, search, files or {}, edited)
        self._operation = operation = Operation(
            self.control, self.machine, start, self._programs, clock, Switches(start.switches), self.signals,
            interlocks, self._status, retained,
        )  # fmt: skip
        permission = Permission(self.catalogue, self._status, interlocks)
        self._commands = commands = ProgramCommands(operation, self._programs, permission)
        self._data = DataCommands(operation, self._programs, commands, permission, retained)
        self._hand = HandCommands(operation, permission)
        self._switches = SwitchCommands(operation, permission)
        self._loop = MainLoop(operation, clock)
        self._readings = Readings(operation, self._programs)
        operation.keys = {
            "CYCLE_START": commands.cycle_start,
            "FEED_HOLD": commands.feed_hold,
            "RESET": commands.reset,
            "EMERGENCY_STOP": commands.emergency_stop,
            "POWER_OFF": commands.power_off,
        }

    # ---- programs ------------------------------------------------------------------------------------------

    def load(self, source: str | bytes | Path, *, channel: int = 1) -> None:
        """Load a program into a channel: a file, or the text itself (`bytes`, or a `str` with line ends).

        What is loaded in other channels stays. Cycle start starts every channel in which a program is loaded.

        Raises:
            CommandRefused: A program runs.
            ProgramFileError: The file cannot be read.
        """
        self._commands.load(source, channel)

    def load_tape(self, source: str | bytes | Path, *, channel: int = 1) -> None:
        """Give the program that comes from outside in mode `tape`: tape, DNC, memory card. Sources as for `load`.

        Raises:
            CommandRefused: A program runs.
            ProgramFileError: The file cannot be read.
        """
        self._commands.load_tape(source, channel)

    def mdi(self, text: str, *, channel: int = 1) -> None:
        """Type blocks in for a channel and start them; allowed in MDI mode. What they change stays.

        While a program waits at a stop or in single block, they are run in its midst (MDI intervention; not on
        SINUMERIK and SYNTEC): it goes on behind them, from where the axes then are, with the codes that then hold.

        Raises:
            CommandRefused: Out of place; or blocks of a waiting program are prepared already, or read ahead for
                compensation.
        """
        self._commands.mdi(text, channel)

    def teach(self, words: str = "", *, line: int | None = None, channel: int = 1) -> str:
        """Write a block with the present position into the program loaded in a channel; allowed in teach-in.

        Args:
            words: What stands in front of the position (`G1`).
            line: Line of the file behind which the block goes; behind the one taught last, or the last line.
            channel: The channel.

        Returns:
            The block.
        """
        return self._commands.teach(words, line, channel)

    def block_search(
        self, target: int | str | Places, *, channel: int = 1, how: SearchMode | str = "contour"
    ) -> None:
        """Search a block: a line of a channel's main program, or a block number such as `N50`.

        One of a subprogram is named by program and line of each level, as `snapshot.interrupted` has them.

        Everything before it is calculated without motion. Cycle start puts out the auxiliary functions that hold there,
        leads the axes to where the block begins (`contour`) or ends (`end-point`), and goes on. `without-calculation`
        begins with the block where the axes are; `program-test` takes its time: the program runs, the axes stand.

        Raises:
            CommandRefused: The program ends before it.
        """
        self._commands.block_search(target, channel, one_of(SearchMode, "how", how))

    # ---- data ----------------------------------------------------------------------------------------------

    def write_variable(self, name: str, value: object, *, channel: int = 1) -> None:
        """Give a variable, an offset or a datum another value, by its name in programs; it lasts from here on.

        Raises:
            CommandRefused: There is no such variable, it takes no such value, or edit protection is on.
        """
        self._data.write_variable(name, value, channel)

    def change(
        self, action: Callable[[Channel], object], *, channel: int = 1, protected: bool = True
    ) -> None:
        """Change data by a function of the control's, such as those of its offset screens; it lasts from here on.

        What is not `protected` changes under edit protection too: the key switch is no datum.

        Raises:
            CommandRefused: Edit protection is on.
            UserError: The function refuses it.
        """
        self._data.change(action, channel, protected=protected)

    @property
    def parameters(self) -> tuple[KnownParameter, ...]:
        """The parameters that the control knows, in the order of their numbers."""
        return self._data.parameters

    def read_parameter(self, number: str) -> object:
        """The value of a parameter by its number (`3401#0`) or identifier; None where only the machine knows it."""
        return self._data.read_parameter(number)

    def write_parameter(self, number: str, value: float) -> None:
        """Give a parameter another value; it lasts from here on.

        Raises:
            CommandRefused: The control knows no such parameter, a program runs, or edit protection is on.
        """
        self._data.write_parameter(number, value)

    @property
    def programs(self) -> tuple[ProgramEntry, ...]:
        """Every program that is loaded or in the memory."""
        return self._data.entries()

    def program_lines(self, name: str) -> Sequence[str]:
        """The lines of a program, by its name or number.

        Raises:
            CommandRefused: There is none.
        """
        return self._data.lines(name)

    def first_line(self, name: str) -> int:
        """The line of its file at which a program begins; raises as `program_lines` does."""
        return self._data.first_line(name)

    def store_program(self, name: str, text: str) -> None:
        """Write a program into the memory, in the place of one with its name; its own heading names it first.

        Raises:
            CommandRefused: It is under way, or edit protection is on.
        """
        self._data.store(name, text)

    def delete_program(self, name: str) -> None:
        """Take a program out of the memory; refused as `store_program` is."""
        self._data.delete(name)

    def select_program(self, name: str, *, channel: int = 1) -> None:
        """Load a program of the memory as the main program of a channel.

        Raises:
            CommandRefused: There is none, or a program runs.
        """
        self._data.select(name, channel)

    def forecast(
        self,
        name: str = "",
        *,
        text: str | None = None,
        channel: int = 1,
        block_limit: int = DEFAULT_BLOCK_LIMIT,
    ) -> Forecast:
        """Calculate what a program will do, beside the control and in pieces: nothing of the control changes.

        Args:
            name: A program of the memory; empty for the main program of the channel.
            text: Another text of it, as an editor has it.
            channel: The channel.
            block_limit: The calculation ends after so many blocks.

        Raises:
            CommandRefused: There is no such program.
        """
        main = None
        if text is None:
            main = self._data.named(name) if name else self._programs.main(channel)
        return forecast_of(
            self._operation.runs.named(channel), self._programs, self._retained, main, text=text, name=name,
            block_limit=block_limit,
        )  # fmt: skip

    # ---- running -------------------------------------------------------------------------------------------

    def cycle_start(self) -> None:
        """Start the program, or go on with it after a hold, a stop or a single block.

        Axes that were moved by hand meanwhile go back to where the program stands first, or the program goes on from
        where they are: as the control has it, and the signal `MANUAL_ABSOLUTE` says (`axes/manual_offset.py`).
        """
        self._commands.cycle_start()

    def feed_hold(self) -> None:
        """Bring the axes to rest on the path; a thread is finished first."""
        self._commands.feed_hold()

    def reset(self) -> None:
        """Give the program up: the axes brake, alarms go, modal states become those after reset."""
        self._commands.reset()

    def emergency_stop(self, *, pressed: bool = True) -> None:
        """Press the emergency stop, or pull it out again: then the control is as after reset."""
        self._commands.emergency_stop(pressed=pressed)

    def power_off(self) -> None:
        """Switch off: the axes come to rest, outputs drop. Programs, offsets and variables stay."""
        self._commands.power_off()

    def power_on(self) -> None:
        """Switch on again: codes and values that live as long as the power are as at first, the axes where they were.

        Machines without absolute encoders have to return to their references.
        """
        self._commands.power_on()

    def close(self) -> None:
        """Write down what is to last and let a memory file go; the control is not used any more."""
        self._retained.commit()
        self._retained.close()

    def key(self, name: str, *, pressed: bool = True) -> None:
        """Press a key of the machine panel by its name in the machine's rules (`B3`, `D1`), or let it go.

        Raises:
            CommandRefused: The machine refuses it; where that is an alarm, it has come.
        """
        self._commands.key(name, pressed=pressed)

    def select_mode(self, mode: Mode | str) -> None:
        """Turn the mode switch. A running program is held; it goes on in the same mode after cycle start."""
        self._commands.select_mode(one_of(Mode, "mode", mode))

    def allows(self, command: Command | str) -> bool:
        """Whether a command may be given in this mode and state."""
        return is_allowed(one_of(Command, "command", command), self.mode, self.state)

    # ---- by hand -------------------------------------------------------------------------------------------

    def jog(self, axis: str, direction: int, *, rapid: bool = False, channel: int = 1) -> None:
        """Press a jog key: the axis moves until `stop_jog`, or to its limit."""
        self._hand.jog(axis, direction, rapid=rapid, channel=channel)

    def stop_jog(self, axis: str | None = None, *, channel: int = 1) -> None:
        """Let a jog key go; all of them where no axis is named."""
        self._hand.stop_jog(axis, channel=channel)

    def increment(self, axis: str, steps: int, size: float = 0.001, *, channel: int = 1) -> None:
        """Move by steps of a size, as the machine display counts (mm or degrees; diameters where it shows them)."""
        self._hand.increment(axis, steps * size, channel=channel)

    def handle(self, axis: str, pulses: int, size: float = 0.001, *, channel: int = 1) -> None:
        """Turn the handwheel: the axis follows its pulses as fast as it can."""
        self._hand.handle(axis, pulses * size, channel=channel)

    def home(self, axis: str | None = None, *, channel: int = 1) -> None:
        """Approach the first reference point; with all axes of the channel where none is named."""
        self._hand.home(axis, channel=channel)

    def preset(self, axis: str, value: float, *, channel: int = 1) -> None:
        """Call the place where an axis stands another one, as the machine display counts; nothing moves.

        Raises:
            CommandRefused: The control has no such function, a program is under way, or a transformation is active.
        """
        self._hand.preset(axis, value, channel=channel)

    # ---- switches ------------------------------------------------------------------------------------------

    def override(
        self, *, feed: float | None = None, rapid: float | None = None, spindle: float | None = None
    ) -> None:
        """Turn the override switches; 1 is 100 %. They act at once, within what the axes can do."""
        self._switches.override(feed, rapid, spindle)

    def set_switches(self, **changes: Any) -> None:
        """Turn panel switches, by the names of `PanelSwitches`.

        `single_block` is `SBL1`, `SBL2`, `SBL3`, or True for the first; `block_skip` True, False, or levels. Optional
        stop and single block act on the block in execution, block skip on blocks that are not prepared yet.
        """
        self._switches.set_switches(changes)

    # ---- time ----------------------------------------------------------------------------------------------

    def step(self, seconds: float | None = None) -> None:
        """Let time pass: the given seconds in whole interpolation cycles, or one cycle."""
        self._loop.step(seconds)

    def run(self, *, limit_s: float = LONGEST_RUN_S, real_time: bool = False) -> State:
        """Let time pass until nothing runs any more; gives the state then.

        Args:
            limit_s: No longer than this.
            real_time: As fast as time really passes; else as fast as the computer can.
        """
        if real_time:
            self._loop.run_in_real_time(limit_s)
        else:
            self._loop.run(limit_s)
        return self.state

    def run_until(self, reached: Callable[[VirtualControl], bool], *, limit_s: float = LONGEST_RUN_S) -> bool:
        """Let time pass, cycle by cycle, until a condition holds; false if it did not within the limit."""
        return self._loop.run_until(lambda: reached(self), limit_s)

    # ---- readings: of the moment at which the clock stands; `snapshot` is all of them ------------------------

    @property
    def time(self) -> float:
        """Simulated time since power-on, s: a whole number of interpolation cycles, between commands."""
        return self._operation.clock.time

    @property
    def mode(self) -> Mode:
        """What the mode switch says."""
        return self._status.mode

    @property
    def state(self) -> State:
        """What the control is doing."""
        return self._status.state

    @property
    def halt(self) -> str:
        """Why the program stands (`M00`, `M01`, `single-block` …), or empty."""
        return self._operation.halt

    @property
    def alarms(self) -> tuple[Alarm, ...]:
        """Alarms that wait for reset."""
        return tuple(alarm.told_by(self.catalogue) for alarm in self._status.alarms)

    @property
    def alarm_history(self) -> tuple[Alarm, ...]:
        """The alarms of the past, the latest first; reset and power-off leave them."""
        return tuple(alarm.told_by(self.catalogue) for alarm in self._status.alarm_history)

    def clear_alarm_history(self) -> None:
        """The alarm history begins anew."""
        self._status.clear_history()

    @property
    def message_history(self) -> tuple[str, ...]:
        """The texts that programs have put out for the operator, the latest first."""
        return self._status.message_history

    @property
    def counters(self) -> Counters:
        """Parts made and running time over all power-ons."""
        return self._status.counters

    @property
    def panel_settings(self) -> dict[str, Any]:
        """What an operator panel keeps of itself; it lasts with the next command that is confirmed."""
        return self._retained.table(PANEL)

    @property
    def parts(self) -> int:
        """How often a program of the first channel has come to its end; `channels` says it of each."""
        return self._operation.runs.first.parts

    @property
    def listeners(self) -> list[Callable[[Record], object]]:
        """Called with each `Record` of what happens, in order; append to it."""
        return self._status.listeners

    @property
    def channel(self) -> Channel:
        """The first channel; it runs ahead of the axes."""
        return self._operation.runs.first.channel

    @property
    def channels(self) -> Mapping[int, ChannelSnapshot]:
        """Every channel that has been spoken of, by number; the other readings are of the first."""
        return self._readings.channels

    @property
    def is_busy(self) -> bool:
        """Whether something runs or moves."""
        return self._loop.is_busy

    @property
    def positions(self) -> Positions:
        """Positions as the displays show them."""
        return self._readings.positions

    @property
    def machine_position(self) -> list[float]:
        """Commanded position of the real axes of the first channel, mm (radius) and degrees."""
        return self._operation.runs.first.machine_position

    @property
    def restart(self) -> Mapping[str, tuple[float, float]]:
        """Where a program waits while its axes stand elsewhere: axis to position and way that is left, work units.

        Empty where no program waits for axes that were moved by hand, or that a block search has left behind.
        """
        return self._readings.restart

    @property
    def collected(self) -> tuple[str, ...]:
        """What a block search has collected for cycle start to put out: `M3`, `S1000`, `T2`."""
        return self._readings.collected

    @property
    def feed(self) -> float:
        """Path speed now, mm/min; of the fastest axis where axes are moved by hand."""
        return self._readings.feed

    @property
    def program(self) -> str:
        """Name of the program loaded in the first channel; empty for none."""
        return self._readings.program

    @property
    def active_block(self) -> ActiveBlock:
        """The block in execution."""
        return self._operation.runs.first.active_block

    @property
    def modal(self) -> Mapping[str, str]:
        """Active code of every modal group in the block in execution."""
        return self._operation.runs.first.modal

    @property
    def spindle(self) -> SpindleState:
        """The spindle of the block in execution; where the machine's rules drive it, as they do."""
        return self._readings.spindle

    @property
    def tool(self) -> ToolState:
        """Tool in the spindle, and the one that stands by."""
        return self._operation.runs.first.tool

    @property
    def switches(self) -> PanelSwitches:
        """The panel's switches."""
        return self._operation.switches.panel

    @property
    def messages(self) -> tuple[str, ...]:
        """Texts that the program has put out."""
        return tuple(self._operation.runs.first.machinery.messages)

    @property
    def notices(self) -> tuple[str, ...]:
        """Numbers of the messages from the machine's controller; their texts are in `catalogue`."""
        return self._operation.interlocks.messages

    def read_variable(self, name: str, *, channel: int = 1) -> object:
        """A variable of a channel as programs name it; None where it is vacant.

        What programs have computed may be ahead of the axes; actual positions are those of the axes.

        Raises:
            KeyError: There is no such variable.
        """
        return self._operation.runs.named(channel).read_variable(name)

    def alarm_text(self, alarm: Alarm, lang: str | None = None) -> str:
        """The text of an alarm, with the hint on this very case if there is one."""
        return alarm.told_by(self.catalogue).text_in(lang or language())

    @property
    def snapshot(self) -> Snapshot:
        """Everything at once, of one moment."""
        return self._readings.snapshot

    def checkpoint(self) -> Checkpoint:
        """Note the whole state as it is now, also in the midst of a motion: its `restore` goes back here.

        Everything is as it was then, as often as one likes: time, axes, variables, signals, what is prepared. The
        listeners stay as they are.

        Raises:
            SnapshotError: Something is running that cannot be noted.
        """
        return Checkpoint(self)
