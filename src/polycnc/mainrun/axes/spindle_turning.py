"""How far a spindle has turned that leads an axis: it gets to another speed with its acceleration."""

from __future__ import annotations

from math import copysign

#: Degrees per second of a revolution per minute.
DEGREES_S = 6.0


class SpindleTurning:
    """What a spindle has turned since somebody follows it; an axis that is led reads it as the place of a leading one.

    Args:
        rpm: What it turns with, positive for M3.
        acceleration: rpm/s; 0 for one that is at its speed at once.
        time: The time, s.
    """

    def __init__(self, rpm: float, acceleration: float, time: float) -> None:
        self._acceleration = acceleration
        self._since, self._angle, self._rpm, self._wanted = time, 0.0, rpm, rpm

    def setpoint(self, time: float) -> float:
        """Degrees at a time."""
        seconds = max(time - self._since, 0.0)
        ramp = min(seconds, self._ramp)
        turned = ramp * 0.5 * (self._rpm + self._rpm_after(ramp)) + (seconds - ramp) * self._wanted
        return self._angle + DEGREES_S * turned

    def speed(self, time: float) -> float:
        """Degrees a second at a time."""
        return DEGREES_S * self._rpm_after(max(time - self._since, 0.0))

    def turn_with(self, rpm: float, time: float) -> None:
        """From a time on it gets to another speed."""
        if rpm == self._wanted:
            return
        self._angle, self._rpm = self.setpoint(time), self._rpm_after(max(time - self._since, 0.0))
        self._since, self._wanted = time, rpm

    @property
    def _ramp(self) -> float:
        """Seconds in which it gets to its speed."""
        return abs(self._wanted - self._rpm) / self._acceleration if self._acceleration > 0.0 else 0.0

    def _rpm_after(self, seconds: float) -> float:
        if seconds >= self._ramp:
            return self._wanted
        return self._rpm + copysign(self._acceleration * seconds, self._wanted - self._rpm)
