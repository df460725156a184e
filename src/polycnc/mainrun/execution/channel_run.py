"""One channel in the main run: what is prepared for it, what it executes, and what a panel reads of it."""

from __future__ import annotations

from math import inf

from polycnc.control.word_address.states import LastSkip
from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.commands.programs import text_of
from polycnc.mainrun.execution.interpolator import ChannelInterpolator
from polycnc.mainrun.reading.snapshot import ActiveBlock, ChannelSnapshot, Positions, SpindleState, ToolState
from polycnc.motion.frames import carried, shown_by_hand, without_transformation
from polycnc.motion.standing.waits import rpm_at
from polycnc.toolpath import Context

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.geometry.frames import Vector
    from polycnc.mainrun.axes.channel_axes import ChannelAxes
    from polycnc.mainrun.axes.machine_axes import MachineAxes
    from polycnc.mainrun.execution.execution import Execution
    from polycnc.mainrun.execution.machinery import Machinery
    from polycnc.mainrun.preparation.items import Block, Places, Rates
    from polycnc.mainrun.preparation.preprocessing import Preprocessing
    from polycnc.mainrun.reading.display import MainRunDisplay


@dataclass(slots=True, eq=False)
class ChannelRun:
    """A channel with all that executes it.

    Attributes:
        channel: Runs ahead of the axes.
        preprocessing: What it has prepared.
        execution: Executes that.
        machinery: Carries out its events.
        display: Shows its axes.
        axes: Its axes, with what moves them beside the path.
        rates: What the operator has set.
        machine_axes: All axes of the machine.
        reached: The block in execution, or last in it, of every main program: program and line of each level; while no
            block search may enter a section, that in which the section begins (SINUMERIK IPTRLOCK, job planning 8.5).
        parts: How often a program that an operator has started has come to its end.
        interpolator: The channel as its synchronised actions see it.
    """

    channel: Channel
    preprocessing: Preprocessing
    execution: Execution
    machinery: Machinery
    display: MainRunDisplay
    axes: ChannelAxes
    rates: Rates
    machine_axes: MachineAxes
    reached: dict[str, Places] = field(default_factory=dict)
    parts: int = 0
    interpolator: ChannelInterpolator = field(init=False)

    def __post_init__(self) -> None:
        """What its actions see of it."""
        self.interpolator = ChannelInterpolator(self, self.execution.clock)

    @property
    def number(self) -> int:
        """Number of the channel."""
        return self.channel.number

    @property
    def is_active(self) -> bool:
        """Whether a program of the channel is under way, halted or not."""
        group = self.channel.group
        return group is not None and group.is_running(self.number)

    @property
    def path(self) -> list[float]:
        """Where programs have led the real axes, mm (radius) and degrees: of the channel that moved each last."""
        path = self.own_path
        for column, place in self.machine_axes.led_by_others(self.number, self.channel.group):
            path[column] = place
        return path

    @property
    def own_path(self) -> list[float]:
        """Where its own program has led the real axes, those too that another channel has moved since."""
        return self.display.real(self.execution.machine, self.execution.place)

    @property
    def prepared_path(self) -> list[float]:
        """Machine position behind everything prepared."""
        return self.preprocessing.position

    @property
    def without_hand(self) -> list[float]:
        """Where the real axes would be if nobody had moved them by hand since."""
        return self.axes.without_hand(self.path)

    @property
    def machine_position(self) -> list[float]:
        """Commanded position of the real axes, mm (radius) and degrees: the sums of their sources."""
        return self.axes.setpoints(self.path)

    @property
    def work_position(self) -> list[float]:
        """Position in the work coordinate system, internal units, as far as its coordinates know."""
        execution, display = self.execution, self.display
        place, context = execution.place, execution.context
        if self.preprocessing.has_caught_up and not self.axes.by_hand:  # frames may have changed since
            here = self.axes.path_at(self.machine_position)
            if place.transformation is not None:
                here = self._known(execution.machine, place)
            return self.channel.coordinates.from_machine(display.real(here, place))
        if self.axes.by_hand or place.transformation is context.transformation is None:
            return display.work_of(self.axes.path_at(self.machine_position), place)
        if place.transformation is context.transformation:
            return display.work_of(self._known(execution.machine, place), place)
        here = self._known(carried(execution.machine, place, context, display.geometry), context)
        return display.work_of(here, context)

    @property
    def point(self) -> Vector:
        """Where the tool is: X, Y and Z in the system of the work offset, mm (radius); 0 for no axis."""
        here, context = self._shown()
        place, part = self.display.work_of(here, context), context.part
        x, y, z = (place[i] if i >= 0 else 0.0 for i in self.display.geometry)
        return (x, y, z) if part.is_identity else part.apply(x, y, z)

    def positions(self, locked: Mapping[int, float] | None = None) -> Positions:
        """Positions as the displays show them; `locked` axes stand there, and the displays run on."""
        axes, uncounted = self.machine_position, self.axes.uncounted()
        real = [(locked or {}).get(i, value) for i, value in enumerate(axes)]
        here, context = self._shown()
        end = here if self.axes.by_hand else self._shown(self.execution.row_end)[0]
        display, shown = self.display, self.display.positions(here, end, real, context)
        if not any(uncounted):
            return shown
        return replace(
            shown, machine=display.positions(axes, axes, real, without_transformation(context)).machine
        )

    def _shown(self, place: Sequence[float] | None = None) -> tuple[list[float], Context]:
        """A position of the path, None for the one that the axes are at, in the context that displays show it in."""
        execution, context, display = self.execution, self.execution.context, self.display
        if self.axes.by_hand:
            shown_in = context if self.axes.led is not None else shown_by_hand(context)
            return display.on_path(self.axes.path_at(self.machine_position), shown_in), shown_in
        place = execution.machine if place is None else place
        here = self._known(carried(place, execution.place, context, display.geometry), context)
        led = list(self.machine_axes.led_by_others(self.number, self.channel.group))
        if led:
            axes, uncounted = self.machine_position, self.axes.uncounted()
            for column, _ in led:
                here[column] = axes[column] - uncounted[column]
        return here, context

    def _known(self, on_path: Sequence[float], context: Context) -> list[float]:
        """A position of the path with what coordinates know beside it: the axes that are commanded are real ones."""
        ways = self.axes.commanded()
        if context.transformation is None or not any(ways):
            return self.axes.counted(on_path)
        moved = [place + way for place, way in zip(self.display.real(on_path, context), ways, strict=True)]
        known = self.axes.counted(self.display.on_path(moved, context))
        return [place - way for place, way in zip(known, ways, strict=True)]

    def take_in_hand(self, place: Sequence[float]) -> None:
        """An operator has the axes from now on, which stand at a place."""
        self.axes.take_in_hand(place, self.path)

    def intervene(self, *, absolute: bool) -> None:
        """The program goes on from where an operator has left the axes; manual absolute is on or off."""
        if self.axes.by_hand:
            time = self.execution.clock.time
            way = [axis.hand.at(time) for axis in self.axes]
            self.axes.leave()
            self.execution.intervene(way, absolute=absolute)

    def skip_signal(self) -> None:
        """The skip input comes now; the channel knows where the axes are, if a skip move runs."""
        here = self.execution.skip_signal()
        if here is not None:
            LastSkip.of(self.channel).position = self.display.work_of(here, self.execution.context)

    def forget_shift(self) -> None:
        """What was moved with manual absolute off shifts the coordinates no more."""
        here = self.machine_position
        for axis in self.axes:
            axis.offset.shift = 0.0
        self.stand_at(here)

    def stand_at(self, position: Sequence[float]) -> None:
        """The real axes stand here and no program runs."""
        path = self.axes.path_at(position)  # while everything is still where it was
        self.axes.leave()
        self.axes.rebase()
        self.execution.position, self.execution.place = path, Context()
        self.preprocessing.clear(self.execution.position)
        self.show_own_state()

    def begin_at_axes(self) -> None:
        """A program is about to begin: its path goes from where the real axes are, whatever led them there."""
        execution = self.execution
        if execution.place.transformation is not None:
            execution.position = self.display.real(execution.position, execution.place)
            execution.place = without_transformation(execution.place)

    def read_variable(self, name: str) -> object:
        """A variable as programs name it; who reads from outside waits for no axis."""
        channel = self.channel
        main_run, channel.main_run = channel.main_run, None
        try:
            return channel.control.read_variable(channel, name)
        finally:
            channel.main_run = main_run

    @property
    def modal(self) -> Mapping[str, str]:
        """Active code of every modal group in the block in execution."""
        return dict(self.execution.modal)

    @property
    def active_block(self) -> ActiveBlock:
        """The block in execution."""
        block = self.execution.block
        if block is None:
            return ActiveBlock()
        program = next((p for p in reversed(self.channel.programs) if p.name == block.program), None)
        return ActiveBlock(block.program, block.line, text_of(program, block.line))

    @property
    def spindle(self) -> SpindleState:
        """The spindle of the block in execution."""
        context = self.execution.context
        rpm = self.spindle_rpm(context) if context.spindle_direction else 0.0
        return SpindleState(context.spindle, context.spindle_rpm, rpm, context.spindle_direction)

    def spindle_rpm(self, context: Context) -> float:
        """What the spindle of a context turns with while it turns: by its override, under G96 where the tool is now.

        An override passes neither the spindle's limit nor the program's.
        """
        spindle = self.channel.machine.spindle.get(context.spindle)
        facing = self.display.geometry[0]
        radius = abs(self.work_position[facing]) if context.surface_speed and facing >= 0 else 0.0
        override = self.rates.spindle if context.spindle_override else 1.0
        limits = (spindle.max_rpm if spindle else inf, context.spindle_limit_rpm or inf)
        return min(rpm_at(context, radius, spindle) * override, *limits)

    @property
    def tool(self) -> ToolState:
        """Tool in the spindle, and the one that stands by."""
        context = self.execution.context
        return ToolState(context.tool, context.tool_name, self.machinery.next_tool)

    def snapshot(self, program: str, positions: Positions, spindle: SpindleState) -> ChannelSnapshot:
        """Everything at once, of one moment; which program is loaded, what is shown, and what turns, others know."""
        execution = self.execution
        return ChannelSnapshot(
            number=self.number,
            runs=self.is_active,
            waits=execution.waits_for_channel,
            halt=execution.halt,
            positions=positions,
            feed=60.0 * execution.speed,
            block=self.active_block,
            modal=self.modal,
            spindle=spindle,
            tool=self.tool,
            messages=tuple(self.machinery.messages),
            program=program,
            parts=self.parts,
            point=self.point,
            mechanism=self.channel.control.mechanism(self.channel, execution.context),
        )

    def reach(self, block: Block | None) -> None:
        """A block is in execution: a search for the point of interruption goes there."""
        if block is not None and not self.execution.context.search_lock:
            levels = block.levels
            self.reached[levels[0][0]] = levels

    def show_own_state(self) -> None:
        """Between programs the displays show the channel's own state."""
        self.execution.context = self.channel.control.context(self.channel)
        self.execution.modal = self.channel.mode.codes

    def give_up(self) -> None:
        """The axes stand: the program is given up, the channel is as after reset."""
        self.reach(self.execution.block)
        channel, control = self.channel, self.channel.control
        modal, context = self.execution.modal, self.execution.context
        if self.execution.block is None:
            modal, context = channel.mode.codes, control.context(channel)
        self.execution.abandon()
        self.interpolator.end(reset=True)
        self.machinery.reset()
        control.give_up(channel, modal, context)
        if self.channel.group is not None:
            self.channel.group.end(self.number)
