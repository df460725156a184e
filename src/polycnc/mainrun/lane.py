"""One channel in the main run: what is prepared for it, what it executes, and what a panel reads of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf
from typing import TYPE_CHECKING

from polycnc.mainrun.programs import text_of
from polycnc.mainrun.snapshot import ActiveBlock, ChannelSnapshot, Positions, SpindleState, ToolState
from polycnc.motion.frames import carried, without_transformation
from polycnc.toolpath import Context

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.mainrun.ahead import Ahead
    from polycnc.mainrun.automatic import Automatic
    from polycnc.mainrun.display import MainRunDisplay
    from polycnc.mainrun.items import Rates
    from polycnc.mainrun.machinery import Machinery
    from polycnc.mainrun.manual import ManualAxes
    from polycnc.mainrun.shared_axes import SharedAxes


@dataclass(slots=True, eq=False)
class Lane:
    """A channel with all that executes it.

    Attributes:
        channel: Runs ahead of the axes.
        ahead: What it has prepared.
        automatic: Executes that.
        machinery: Carries out its events.
        display: Shows its axes.
        manual: Its axes while an operator moves them.
        rates: What the operator has set.
        lanes: Every channel of the control by number, this one too.
        shared: The axes that channels share.
    """

    channel: Channel
    ahead: Ahead
    automatic: Automatic
    machinery: Machinery
    display: MainRunDisplay
    manual: ManualAxes
    rates: Rates
    lanes: Mapping[int, Lane]
    shared: SharedAxes

    @property
    def number(self) -> int:
        """Number of the channel."""
        return self.channel.number

    @property
    def runs(self) -> bool:
        """Whether a program of the channel is under way, halted or not."""
        group = self.channel.group
        return group is not None and group.is_running(self.number)

    @property
    def real(self) -> list[float]:
        """Commanded position of the real axes, mm (radius) and degrees, as their programs have led them."""
        position = self.led
        for column, mover, there in self.shared.elsewhere(self.number, self.channel.group):
            position[column] = self.lanes[mover].led[there]
        return position

    @property
    def led(self) -> list[float]:
        """Where its own program has led the real axes, those too that another channel has moved since."""
        automatic = self.automatic
        return automatic.stray.beside(self.display.real(automatic.machine, automatic.place))

    @property
    def machine_position(self) -> list[float]:
        """Commanded position of the real axes, mm (radius) and degrees, by hand or by program."""
        return self.real if self.manual.place is None else self.manual.positions(self.automatic.time)

    def positions(self, locked: Mapping[int, float] | None = None) -> Positions:
        """Positions as the displays show them; `locked` axes stand there, and the displays run on."""
        automatic, context, display = self.automatic, self.automatic.context, self.display
        axes = self.machine_position
        real = [(locked or {}).get(i, value) for i, value in enumerate(axes)]
        kept = automatic.stray.kept
        if self.manual.place is not None:
            here = [a - b for a, b in zip(axes, kept, strict=True)]
            shown = display.positions(here, here, real, without_transformation(context))
        else:
            here, end = (
                automatic.stray.counted(carried(place, automatic.place, context, display.geometry))
                for place in (automatic.machine, automatic.row_end)
            )
            for column, _, _ in self.shared.elsewhere(self.number, self.channel.group):
                here[column] = end[column] = axes[column] - kept[column]
            shown = display.positions(here, end, real, context)
        if not any(kept):
            return shown
        return replace(
            shown, machine=display.positions(axes, axes, real, without_transformation(context)).machine
        )

    def intervene(self, *, absolute: bool) -> None:
        """The program goes on from where an operator has left the axes; manual absolute is on or off."""
        if self.manual.place is not None:
            way = [a - b for a, b in zip(self.manual.place, self.real, strict=True)]
            self.manual.leave()
            self.automatic.intervene(way, absolute=absolute)

    def forget_shift(self) -> None:
        """What was moved with manual absolute off shifts the coordinates no more."""
        here, stray = self.machine_position, self.automatic.stray
        stray.kept = [0.0] * len(stray.kept)
        self.stand_at(here)

    def stand_at(self, position: Sequence[float]) -> None:
        """The real axes stand here and no program runs."""
        self.manual.leave()
        self.automatic.position, self.automatic.place = self.automatic.stray.path(position), Context()
        self.ahead.clear(self.automatic.position)
        self.show_own_state()

    @property
    def modal(self) -> Mapping[str, str]:
        """Active code of every modal group in the block in execution."""
        return dict(self.automatic.modal)

    @property
    def active_block(self) -> ActiveBlock:
        """The block in execution."""
        block = self.automatic.block
        if block is None:
            return ActiveBlock()
        program = next((p for p in reversed(self.channel.programs) if p.name == block.program), None)
        return ActiveBlock(block.program, block.line, text_of(program, block.line))

    @property
    def spindle(self) -> SpindleState:
        """The spindle of the block in execution."""
        context = self.automatic.context
        spindle = self.channel.machine.spindle.get(context.spindle)
        top = spindle.max_rpm if spindle is not None else inf
        turning = 0.0 if context.surface_speed or not context.spindle_direction else context.spindle_rpm
        override = self.rates.spindle if context.spindle_override else 1.0
        rpm = min(turning * override, top)
        return SpindleState(context.spindle, context.spindle_rpm, rpm, context.spindle_direction)

    @property
    def tool(self) -> ToolState:
        """Tool in the spindle, and the one that stands by."""
        context = self.automatic.context
        return ToolState(context.tool, context.tool_name, self.machinery.next_tool)

    @property
    def snapshot(self) -> ChannelSnapshot:
        """Everything at once, of one moment."""
        automatic = self.automatic
        return ChannelSnapshot(
            number=self.number,
            runs=self.runs,
            waits=automatic.waits_for_channel,
            halt=automatic.halt,
            positions=self.positions(),
            feed=60.0 * automatic.speed,
            block=self.active_block,
            modal=self.modal,
            spindle=self.spindle,
            tool=self.tool,
            messages=tuple(self.machinery.messages),
        )

    def show_own_state(self) -> None:
        """Between programs the displays show the channel's own state."""
        self.automatic.context = self.channel.control.context(self.channel)
        self.automatic.modal = self.channel.mode.codes

    def give_up(self) -> None:
        """The axes stand: the program is given up, the channel is as after reset."""
        running, modal, context = self.automatic.block, self.automatic.modal, self.automatic.context
        self.automatic.abandon()
        self.machinery.reset()
        if running is None:
            self.channel.control.reset(self.channel)
        else:
            self.channel.control.give_up(self.channel, modal, context)
        if self.channel.group is not None:
            self.channel.group.end(self.number)
