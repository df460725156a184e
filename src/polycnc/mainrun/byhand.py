"""The axes by hand: jog, steps, handwheel, reference approach."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from polycnc.mainrun.core import JOG_RATE
from polycnc.mainrun.errors import CommandRefused
from polycnc.mainrun.readings import Readings
from polycnc.mainrun.states import Command, Mode, is_allowed
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from polycnc.mainrun.lane import Lane


class ByHand(Readings):
    """What moves axes without a program. `channel` is the number of the channel whose axis is meant."""

    def jog(self, axis: str, direction: int, *, rapid: bool = False, channel: int = 1) -> None:
        """Press a jog key: the axis moves until `stop_jog`, or to its limit."""
        self._ask(Command.JOG)
        lane, i = self._axis(axis, channel)
        self._ask_machine(*self._move_words(lane, i))
        here = self._hand_of(lane)[i]
        speed = self._rapid_speed(lane, i) if rapid else self._jog_speed(lane, i)
        lane.manual.towards(i, lane.manual.along(i, direction, here), speed, self.time)

    def stop_jog(self, axis: str | None = None, *, channel: int = 1) -> None:
        """Let a jog key go; all of them where no axis is named."""
        if axis is None:
            self._brake_hands()
        else:
            lane, i = self._axis(axis, channel)
            lane.manual.brake(i, self.time)

    def increment(self, axis: str, steps: int, size: float = 0.001, *, channel: int = 1) -> None:
        """Move by steps of a size, as the machine display counts (mm or degrees; diameters where it shows them)."""
        self._ask(Command.INCREMENT)
        lane, i = self._axis(axis, channel)
        self._shift(lane, i, steps * size, self._jog_speed(lane, i))

    def handle(self, axis: str, pulses: int, size: float = 0.001, *, channel: int = 1) -> None:
        """Turn the handwheel: the axis follows its pulses as fast as it can."""
        self._ask(Command.HANDLE)
        lane, i = self._axis(axis, channel)
        self._shift(lane, i, pulses * size, self._rapid_speed(lane, i))

    def home(self, axis: str | None = None, *, channel: int = 1) -> None:
        """Approach the first reference point; with all axes of the channel where none is named."""
        self._ask(Command.HOME)
        lane = self._lane_of(channel)
        named = range(len(lane.channel.axes)) if axis is None else (self._axis(axis, channel)[1],)
        self._ask_machine(*(f"HOME_{lane.channel.axes[i]}" for i in named))
        self._hand_of(lane)
        for i in named:
            target = lane.channel.axis_data[i].reference_points[0]
            lane.automatic.stray.kept[i] = 0.0
            lane.manual.towards(i, target, self._rapid_speed(lane, i), self.time)

    # ---- speeds and ways -----------------------------------------------------------------------------------

    def _jog_speed(self, lane: Lane, axis: int) -> float:
        top = lane.channel.axis_data[axis].max_feed or inf
        return min(JOG_RATE / 60.0 * self._dials.feed, top)

    def _rapid_speed(self, lane: Lane, axis: int) -> float:
        return (lane.channel.axis_data[axis].rapid or 1e9) * self._rates.rapid

    def _set_hand_speeds(self) -> None:
        """The overrides have changed."""
        speed = self._rapid_speed if self.mode is Mode.REFERENCE else self._jog_speed
        for lane in self._lanes.values():
            for axis in lane.manual.goals:
                lane.manual.change_speed(axis, speed(lane, axis), self.time)

    def _shift(self, lane: Lane, axis: int, shown: float, speed: float) -> None:
        self._ask_machine(*self._move_words(lane, axis))
        here = self._hand_of(lane)[axis]
        factor = lane.display.machine_factor(axis, lane.automatic.context)
        lane.manual.towards(axis, lane.manual.goal(axis, here) + shown / factor, speed, self.time)

    def _move_words(self, lane: Lane, axis: int) -> list[str]:
        """What an axis that is to move asks the machine for."""
        channel = lane.channel
        rotary = [i for i, data in enumerate(channel.axis_data) if data.rotary]
        words = [f"MOVE_{channel.axes[axis]}"]
        words += ["MOVE_FIFTH_AXIS"] if axis in rotary[1:2] else []
        return words + (["MOVE_SECOND_AXIS"] if lane.manual.moving - {axis} else [])

    # ---- what may be done ----------------------------------------------------------------------------------

    def _hand_of(self, lane: Lane) -> list[float]:
        """Machine position from which axes of a channel are moved by hand."""
        if self._axes_move:
            raise CommandRefused("mainrun.moving")
        lane.manual.begin(lane.machine_position)
        return lane.machine_position

    def _ask(self, command: Command) -> None:
        if not is_allowed(command, self.mode, self.state):
            raise CommandRefused("mainrun.refused", command=command, mode=self.mode, state=self.state)

    def _ask_machine(self, *words: str) -> None:
        """Ask the machine's controller for something; it answers with an alarm or a message where it refuses."""
        for word in words:
            if code := self._guard.refuses(word):
                told = self.control.catalogue.text(code)
                raise CommandRefused("mainrun.machine", code=code, text=told)

    def _lane_of(self, number: int) -> Lane:
        """A channel of the machine."""
        if not self._group.has(number):
            known = listed(str(channel.number) for channel in self.machine.channels)
            raise CommandRefused("mainrun.value", name="channel", allowed=known, value=number)
        self._group.channel(number)
        return self._lanes[number]

    def _axis(self, name: str, channel: int) -> tuple[Lane, int]:
        lane = self._lane_of(channel)
        index = lane.channel.axis_index.get(name.upper())
        if index is None:
            raise CommandRefused("mainrun.axis", axis=name, known=listed(lane.channel.axes))
        if (owner := self._group.owner[lane.channel.axis_data[index].name]) not in (0, channel):
            raise CommandRefused("mainrun.value", name="channel", allowed=str(owner), value=channel)
        return lane, index
