"""Spindles that lead axes: what they turn with is looked at in every interpolation cycle, as long as one is led."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.mainrun.axes.commanded import OWN_PULL
from polycnc.mainrun.axes.spindle_turning import DEGREES_S, SpindleTurning
from polycnc.transformation.couplings.laws import Ratio

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from polycnc.channel.channel import Channel
    from polycnc.mainrun.axes.channel_axes import ChannelAxes
    from polycnc.mainrun.axes.commanded import Leading
    from polycnc.mainrun.execution.clock import Clock
    from polycnc.mainrun.execution.execution import Execution
    from polycnc.mainrun.preparation.items import Rates
    from polycnc.mainrun.reading.snapshot import SpindleState
    from polycnc.transformation.couplings.laws import Law


class Turning(Protocol):
    """A channel, and what turns in it."""

    execution: Execution
    axes: ChannelAxes

    @property
    def channel(self) -> Channel:
        """The channel."""

    @property
    def spindle(self) -> SpindleState:
        """The spindle of the block in execution."""

    rates: Rates


class LeadingSpindles:
    """Follows the spindles of a channel that lead axes; satisfies the clock's `Watch`.

    Args:
        run: The channel in the main run.
        clock: The time.
    """

    def __init__(self, run: Turning, clock: Clock) -> None:
        self._run, self._clock = run, clock
        self._turning: dict[int, SpindleTurning] = {}
        self._led: dict[int, tuple[int, ...]] = {}
        self._speed: Callable[[int, float], float] | None = None

    def led_by(
        self, column: int, ratios: Mapping[int, float], speed: Callable[[int, float], float] | None = None
    ) -> list[tuple[Leading, Law]]:
        """What leads an axis from now on: by degrees that it turns for one of each spindle, its number.

        A law is told by the column of the axis that it leads: a spindle has none.
        """
        self._speed = speed or self._speed
        was_armed = bool(self._led)
        self._led.pop(column, None)
        if ratios:
            self._led[column] = tuple(ratios)
        used = {number for numbers in self._led.values() for number in numbers}
        self._turning = {
            number: self._turning.get(number) or self._begun(number, column, ratios[number])
            for number in used
        }
        if used and not was_armed:
            self._clock.arm(self)
            self._run.execution.attention = True  # time does not go on before the next cycle
        elif was_armed and not used:
            self._clock.disarm(self)
        return [(self._turning[number], Ratio(column, ratio)) for number, ratio in ratios.items()]

    def look(self, time: float) -> None:
        """An interpolation cycle has come."""
        for number, turning in self._turning.items():
            turning.turn_with(self._rpm(number), time)

    def _rpm(self, number: int) -> float:
        """What a spindle turns with; one that the block in execution does not follow by its speed and the override."""
        state = self._run.spindle
        if state.number == number:
            return state.rpm * state.direction
        if self._speed is None:
            return 0.0
        context = self._run.execution.context
        override = self._run.rates.spindle if context.spindle_override else 1.0
        most = self._run.channel.machine.spindle[number].max_rpm
        return max(-most, min(most, self._speed(number, override)))

    def _begun(self, number: int, column: int, ratio: float) -> SpindleTurning:
        """A spindle begins to lead: it gets to other speeds no faster than the axis can follow."""
        spindle = self._run.channel.machine.spindle[number]
        pull = (1.0 - OWN_PULL) * self._run.axes[column].data.acceleration
        follows = pull / (DEGREES_S * abs(ratio)) if ratio else 0.0
        pulls = [pull for pull in (spindle.acceleration_rpm_s, follows) if pull > 0.0]
        return SpindleTurning(self._rpm(number), min(pulls, default=0.0), self._clock.time)
