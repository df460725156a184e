"""What a panel or a factory system reads from a virtual control."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING

from polycnc.control.alarm_text import alarm_text
from polycnc.mainrun.commands.states import State
from polycnc.mainrun.core import Core
from polycnc.mainrun.reading.snapshot import (
    ActiveBlock,
    ChannelSnapshot,
    Overrides,
    Positions,
    Snapshot,
    SpindleState,
    ToolState,
)
from polycnc.motion.frames import without_transformation

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.mainrun.signals.image import SignalImage
    from polycnc.messages import Alarm


class Readings(Core):
    """The readings; each is of the moment at which the clock stands, `snapshot` is all of them."""

    @property
    def is_busy(self) -> bool:
        """Whether something runs or moves."""
        moving = self._axes_move or self._by_hand
        return moving or self.state in (State.RUNNING, State.BRAKING)

    @property
    def positions(self) -> Positions:
        """Positions as the displays show them."""
        return self._run.positions(self._locked_at)

    @property
    def channels(self) -> Mapping[int, ChannelSnapshot]:
        """Every channel that has been spoken of, by number; the other readings are of the first."""
        return {number: run.snapshot for number, run in sorted(self._runs.items())}

    @property
    def modal(self) -> Mapping[str, str]:
        """Active code of every modal group in the block in execution."""
        return self._run.modal

    @property
    def active_block(self) -> ActiveBlock:
        """The block in execution."""
        return self._run.active_block

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
        """The spindle of the block in execution; where the machine's rules drive it, as they do."""
        spindle = self._run.spindle
        if not self._guard.drives_spindle:
            return spindle
        direction = int(self._signals["SPINDLE_CW"] - self._signals["SPINDLE_CCW"])
        if not direction or not self._signals["SPINDLE_TURNS"]:
            return replace(spindle, rpm=0.0, direction=0)
        context, data = self._execution.context, self.machine.spindle.get(spindle.number)
        override = self._rates.spindle if context.spindle_override else 1.0
        top = data.max_rpm if data is not None else inf
        rpm = 0.0 if context.surface_speed else min(spindle.programmed_rpm * override, top)
        return replace(spindle, rpm=rpm, direction=direction)

    @property
    def notices(self) -> tuple[str, ...]:
        """Numbers of the messages from the machine's controller; their texts are in the control's catalogue."""
        return self._guard.messages

    @property
    def restart(self) -> Mapping[str, tuple[float, float]]:
        """Where a program waits while its axes stand elsewhere: axis to position and way that is left, work units.

        Empty where no program waits for axes that were moved by hand, or that a block search has left behind.
        """
        if self._run.manual.place is None or self.state not in (State.HOLD, State.STOPPED):
            return {}
        context, here, waits = (
            without_transformation(self._execution.context),
            self.machine_position,
            self._run.real,
        )
        target = self._display.positions(waits, waits, waits, context).work
        left = self._display.positions(here, waits, here, context).to_go
        return {axis: (target[axis], left[axis]) for axis in target}

    @property
    def tool(self) -> ToolState:
        """Tool in the spindle, and the one that stands by."""
        return self._run.tool

    @property
    def signals(self) -> SignalImage:
        """The signal image; inputs can be set."""
        return self._signals

    def read_variable(self, name: str) -> object:
        """A variable of the control as programs name it; None where it is vacant. It may be ahead of the axes.

        Raises:
            KeyError: There is no such variable.
        """
        return self.control.read_variable(self.channel, name)

    @property
    def feed(self) -> float:
        """Path speed now, mm/min; of the fastest axis where axes are moved by hand."""
        return 60.0 * max(self._execution.speed, self._run.manual.speed(self.time))

    @property
    def snapshot(self) -> Snapshot:
        """Everything at once, of one moment."""
        dials = self._dials
        return Snapshot(
            time=self.time,
            mode=self.mode,
            state=self.state,
            halt=self.halt,
            positions=self.positions,
            feed=self.feed,
            program=self.program,
            block=self.active_block,
            modal=self.modal,
            spindle=self.spindle,
            tool=self.tool,
            overrides=Overrides(dials.feed, dials.rapid, dials.spindle),
            switches=self._switches,
            signals=self._signals.values,
            alarms=self.alarms,
            messages=self.messages,
            parts=self.parts,
            channels=self.channels,
            notices=self.notices,
        )

    def alarm_text(self, alarm: Alarm, lang: str | None = None) -> str:
        """The control's own text of an alarm, with the hint on this very case if there is one."""
        return alarm_text(self.control, alarm, lang)
