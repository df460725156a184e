"""The axes by hand: jog, steps, handwheel, reference approach."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from polycnc.mainrun.commands.states import Command, Mode, is_allowed
from polycnc.mainrun.core import JOG_RATE
from polycnc.mainrun.errors import CommandRefused
from polycnc.mainrun.readings import Readings
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from polycnc.mainrun.execution.channel_run import ChannelRun


class ByHand(Readings):
    """What moves axes without a program. `channel` is the number of the channel whose axis is meant."""

    def jog(self, axis: str, direction: int, *, rapid: bool = False, channel: int = 1) -> None:
        """Press a jog key: the axis moves until `stop_jog`, or to its limit."""
        self._ask(Command.JOG)
        run, i = self._axis(axis, channel)
        self._ask_machine(*self._move_words(run, i))
        here = self._hand_of(run)[i]
        speed = self._rapid_speed(run, i) if rapid else self._jog_speed(run, i)
        run.manual.towards(i, run.manual.along(i, direction, here), speed, self.time)

    def stop_jog(self, axis: str | None = None, *, channel: int = 1) -> None:
        """Let a jog key go; all of them where no axis is named."""
        if axis is None:
            self._brake_hands()
        else:
            run, i = self._axis(axis, channel)
            run.manual.brake(i, self.time)

    def increment(self, axis: str, steps: int, size: float = 0.001, *, channel: int = 1) -> None:
        """Move by steps of a size, as the machine display counts (mm or degrees; diameters where it shows them)."""
        self._ask(Command.INCREMENT)
        run, i = self._axis(axis, channel)
        self._shift(run, i, steps * size, self._jog_speed(run, i))

    def handle(self, axis: str, pulses: int, size: float = 0.001, *, channel: int = 1) -> None:
        """Turn the handwheel: the axis follows its pulses as fast as it can."""
        self._ask(Command.HANDLE)
        run, i = self._axis(axis, channel)
        self._shift(run, i, pulses * size, self._rapid_speed(run, i))

    def home(self, axis: str | None = None, *, channel: int = 1) -> None:
        """Approach the first reference point; with all axes of the channel where none is named."""
        self._ask(Command.HOME)
        run = self._run_of(channel)
        named = range(len(run.channel.axes)) if axis is None else (self._axis(axis, channel)[1],)
        self._ask_machine(*(f"HOME_{run.channel.axes[i]}" for i in named))
        self._hand_of(run)
        for i in named:
            target = run.channel.axis_data[i].reference_points[0]
            run.execution.manual_offset.shift[i] = 0.0
            run.manual.towards(i, target, self._rapid_speed(run, i), self.time)

    # ---- speeds and ways -----------------------------------------------------------------------------------

    def _jog_speed(self, run: ChannelRun, axis: int) -> float:
        top = run.channel.axis_data[axis].max_feed or inf
        return min(JOG_RATE / 60.0 * self._dials.feed, top)

    def _rapid_speed(self, run: ChannelRun, axis: int) -> float:
        return (run.channel.axis_data[axis].rapid or 1e9) * self._rates.rapid

    def _set_hand_speeds(self) -> None:
        """The overrides have changed."""
        speed = self._rapid_speed if self.mode is Mode.REFERENCE else self._jog_speed
        for run in self._runs.values():
            for axis in run.manual.goals:
                run.manual.change_speed(axis, speed(run, axis), self.time)

    def _shift(self, run: ChannelRun, axis: int, shown: float, speed: float) -> None:
        self._ask_machine(*self._move_words(run, axis))
        here = self._hand_of(run)[axis]
        factor = run.display.machine_factor(axis, run.execution.context)
        run.manual.towards(axis, run.manual.goal(axis, here) + shown / factor, speed, self.time)

    def _move_words(self, run: ChannelRun, axis: int) -> list[str]:
        """What an axis that is to move asks the machine for."""
        channel = run.channel
        rotary = [i for i, data in enumerate(channel.axis_data) if data.rotary]
        words = [f"MOVE_{channel.axes[axis]}"]
        words += ["MOVE_FIFTH_AXIS"] if axis in rotary[1:2] else []
        return words + (["MOVE_SECOND_AXIS"] if run.manual.moving - {axis} else [])

    # ---- what may be done ----------------------------------------------------------------------------------

    def _hand_of(self, run: ChannelRun) -> list[float]:
        """Machine position from which axes of a channel are moved by hand."""
        if self._axes_move:
            raise CommandRefused("mainrun.moving")
        run.manual.begin(run.machine_position)
        return run.machine_position

    def _ask(self, command: Command) -> None:
        if not is_allowed(command, self.mode, self.state):
            raise CommandRefused("mainrun.refused", command=command, mode=self.mode, state=self.state)

    def _ask_machine(self, *words: str) -> None:
        """Ask the machine's controller for something; it answers with an alarm or a message where it refuses."""
        for word in words:
            if code := self._guard.refuses(word):
                text = self.control.catalogue.text(code)
                raise CommandRefused("mainrun.machine", code=code, text=text)

    def _run_of(self, number: int) -> ChannelRun:
        """A channel of the machine."""
        if not self._group.has(number):
            known = listed(str(channel.number) for channel in self.machine.channels)
            raise CommandRefused("mainrun.value", name="channel", allowed=known, value=number)
        self._group.channel(number)
        return self._runs[number]

    def _axis(self, name: str, channel: int) -> tuple[ChannelRun, int]:
        run = self._run_of(channel)
        index = run.channel.axis_index.get(name.upper())
        if index is None:
            raise CommandRefused("mainrun.axis", axis=name, known=listed(run.channel.axes))
        if (owner := self._group.owner[run.channel.axis_data[index].name]) not in (0, channel):
            raise CommandRefused("mainrun.value", name="channel", allowed=str(owner), value=channel)
        return run, index
