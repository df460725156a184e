"""The channels of a control in the main run; further ones are made when they are first spoken of."""

from __future__ import annotations

from math import inf, nan

from polycnc.channel.channel import Channel
from polycnc.channel.group import ChannelGroup
from polycnc.channel.stack import LevelKind
from polycnc.channel.states.state import Lifetime, end_of
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.mainrun.axes.channel_axes import ChannelAxes
from polycnc.mainrun.axes.machine_axes import MachineAxes
from polycnc.mainrun.errors import CommandRefused
from polycnc.mainrun.execution.channel_run import ChannelRun
from polycnc.mainrun.execution.execution import Execution
from polycnc.mainrun.execution.machinery import Machinery, Observer
from polycnc.mainrun.preparation.preprocessing import Preprocessing
from polycnc.mainrun.reading.display import MainRunDisplay
from polycnc.mainrun.reading.view import Executed
from polycnc.mainrun.signals.machine_states import axis_states
from polycnc.mainrun.signals.program_signals import connect
from polycnc.messages import AlarmError
from polycnc.messages.catalogue import listed
from polycnc.motion.frames import path_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.channel.waits import Wait
    from polycnc.control.interface import Control
    from polycnc.machine.model import Machine
    from polycnc.machine.setup.values import Setup
    from polycnc.mainrun.commands.programs import Programs
    from polycnc.mainrun.execution.clock import Clock
    from polycnc.mainrun.preparation.items import Rates
    from polycnc.mainrun.signals.image import SignalImage
    from polycnc.mainrun.signals.interlocks import Interlocks
    from polycnc.memory.retained import RetainedStore


class Supervisor(Observer, Protocol):
    """What is told of everything that happens on the channels."""

    def started(self, number: int, waits: Iterator[Wait]) -> None:
        """A channel has been started by another one."""

    def failed(self, error: AlarmError) -> None:
        """A channel cannot be switched on."""


class ChannelRuns:
    """Every channel that has been spoken of, by number.

    Args:
        control: The control.
        machine: The machine.
        setup: What the channels start from.
        programs: What is loaded.
        clock: The time.
        rates: What the operator has set of the speeds.
        signals: The signal image.
        interlocks: What the machine's controller refuses.
        supervisor: Is told of what happens.
        retained: What outlives the power, of all channels.
        adopted: Channels that have run so far without a clock, and go on in time; None to make new ones.

    Attributes:
        first: The channel that a control has in any case.
        group: What the channels share.
        axes: The axes of the machine.
    """

    def __init__(
        self,
        control: Control,
        machine: Machine,
        setup: Setup,
        programs: Programs,
        clock: Clock,
        rates: Rates,
        signals: SignalImage,
        interlocks: Interlocks,
        supervisor: Supervisor,
        retained: RetainedStore,
        adopted: ChannelGroup | None = None,
    ) -> None:
        self._adopted = adopted is not None
        self._control, self._machine, self._setup, self._programs = control, machine, setup, programs
        self._clock, self._rates, self._signals, self._interlocks = clock, rates, signals, interlocks
        self._supervisor, self._retained = supervisor, retained
        self._runs: dict[int, ChannelRun] = {}
        self.axes = MachineAxes(machine, self._runs)
        self.first = self._make(
            machine.channels[0].number, setup, adopted.first if adopted is not None else None
        )
        if adopted is None:
            self.group = ChannelGroup(self.first.channel, self._further, supervisor.started)
            return
        self.group = adopted
        for channel in adopted.channels[1:]:
            self._make(channel.number, setup, channel)

    def go_on(self) -> None:
        """The channels that were adopted go on with what they run; one that has run nothing yet is switched on."""
        under_way = self.group.drive(self._further, self._supervisor.started)
        for number, run in self._runs.items():
            if run.channel.memory is None:
                self.switch_on(run)
                continue
            self._use(run)
            if number in under_way:
                execution, (waits, wait) = run.execution, under_way[number]
                geometry = run.channel.coordinates.geometry
                execution.position = path_of(execution.position, execution.place, geometry)
                run.preprocessing.go_on(waits, run.own_path, wait)

    def __iter__(self) -> Iterator[ChannelRun]:
        return iter(tuple(self._runs.values()))

    def __len__(self) -> int:
        return len(self._runs)

    def __getitem__(self, number: int) -> ChannelRun:
        return self._runs[number]

    def named(self, number: int) -> ChannelRun:
        """A channel of the machine by its number.

        Raises:
            CommandRefused: The machine has none of this number.
        """
        if not self.group.has(number):
            known = listed(str(channel.number) for channel in self._machine.channels)
            raise CommandRefused("mainrun.value", name="channel", allowed=known, value=number)
        self.group.channel(number)
        return self._runs[number]

    # ---- states --------------------------------------------------------------------------------------------

    @property
    def due(self) -> float:
        """When something happens next on any channel; inf where nothing will without a command."""
        return min(min(run.axes.due, run.execution.next_event) for run in self._runs.values())

    @property
    def move(self) -> bool:
        """Whether axes move because of a program, or strokes are under way that it will finish."""
        executions = [run.execution for run in self._runs.values()]
        return any(each.moving or (each.running and each.rates.finishing) for each in executions)

    @property
    def move_by_hand(self) -> bool:
        """Whether an axis moves because of an operator."""
        return any(run.axes.move_by_hand for run in self._runs.values())

    @property
    def go_home(self) -> bool:
        """Whether an axis that moves beside its program is led to its place of rest."""
        return any(run.interpolator.goes_home for run in self._runs.values())

    @property
    def move_beside_path(self) -> bool:
        """Whether something else than a program moves an axis."""
        return any(run.axes.due < inf for run in self._runs.values())

    @property
    def shall_move_by_hand(self) -> bool:
        """Whether an axis is not yet where an operator wants it."""
        return any(run.axes.shall_move_by_hand for run in self._runs.values())

    @property
    def left_path(self) -> bool:
        """Whether an axis has been moved by hand since a program led it."""
        return any(run.axes.by_hand for run in self._runs.values())

    def revise(self) -> None:
        """What bounds the speeds has changed."""
        for run in self:
            run.execution.revise()

    def brake_hands(self) -> None:
        """Axes that are moved by hand come to rest."""
        for run in self:
            run.axes.brake_hands()

    # ---- making channels -----------------------------------------------------------------------------------

    def _make(self, number: int, setup: Setup, channel: Channel | None = None) -> ChannelRun:
        """A channel; `switch_on` starts it."""
        machine = self._machine
        known = None if channel is None else channel.toolpath
        preprocessing = Preprocessing(machine, number, self.axes, known)
        if channel is None:
            channel = Channel(
                self._control,
                machine,
                setup,
                self._programs.store,
                number=number,
                toolpath=preprocessing.toolpath,
                retained=self._retained,
            )
        machinery = Machinery(number, machine, self._signals, self._clock, self._interlocks, self._supervisor)
        axes = ChannelAxes(
            self.axes.of(number, channel.axis_data, self._control.motion_settings(channel)), self._clock
        )
        execution = Execution(
            preprocessing, self._rates, machinery, axes, channel.coordinates.machine, self._clock,
            setup.switches.skip_signal_after,
        )  # fmt: skip
        run = self._runs[number] = ChannelRun(
            channel, preprocessing, execution, machinery,
            MainRunDisplay(preprocessing.toolpath, machine, number),
            axes, self._rates, self.axes,
        )  # fmt: skip
        if known is None:
            channel.actual = Executed(run)
        # An axis that several channels have is that of the one made first.
        self._signals.states = axis_states(channel) | self._signals.states
        return run

    def _further(self, number: int) -> Channel:
        run = self._make(number, self.first.channel.setup)
        run.channel.group = self.group
        self.switch_on(run)
        return run.channel

    def switch_on(self, run: ChannelRun) -> None:
        """Power-on of a channel."""
        channel = run.channel
        channel.push(
            self._programs.typed("\n"), kind=LevelKind.MAIN
        )  # a control starts with a level to stand on
        try:
            self._control.start(channel)
        except AlarmError as error:
            self._supervisor.failed(error)
        except ArithmeticError as error:
            self._supervisor.failed(self._control.arithmetic_alarm(error))
        self._use(run)

    def switch_on_again(self, run: ChannelRun) -> None:
        """Power comes back to a channel that has been reset: what lived as long as the power begins anew.

        The axes are where they were, and the tool is still in the spindle.
        """
        channel, here = run.channel, run.machine_position
        tool = run.execution.context.tool_name or run.execution.context.tool
        channel.stack.clear()
        channel.forget_programs()
        channel.feed = nan
        end_of(channel, Lifetime.POWER)
        begun = channel.setup
        channel.setup = replace(begun, spindle_tool={**begun.spindle_tool, channel.number: tool})
        self.switch_on(run)
        run.stand_at(here)

    def _use(self, run: ChannelRun) -> None:
        """A channel, which stands, is executed from here on."""
        channel = run.channel
        channel.actual = Executed(run)
        connect(channel, self._signals)
        run.preprocessing.use(channel, self._control.motion_settings(channel))
        run.preprocessing.clear(channel.coordinates.machine)
        run.execution.position = channel.coordinates.machine
        self._control.clocked(channel)
        run.show_own_state()
