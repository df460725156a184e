"""A shift of an axis beside everything else: it goes to what an action (`$AA_OFF`) or a handwheel (DRF) asks for."""

from __future__ import annotations

from math import inf


class Overlay:
    """A source of an axis, at a constant speed to its value."""

    def __init__(self) -> None:
        self._from = self._to = 0.0
        self._since = self._until = 0.0

    def at(self, time: float) -> float:
        """Its share of the setpoint."""
        if time >= self._until:
            return self._to
        share = (time - self._since) / (self._until - self._since)
        return self._from + (self._to - self._from) * max(share, 0.0)

    @property
    def target(self) -> float:
        """The value that it goes to."""
        return self._to

    @property
    def due(self) -> float:
        """When it has reached its value; inf where it does not move."""
        return self._until if self._from != self._to else inf

    def arrive(self, time: float) -> None:
        """What has reached its value moves no more."""
        if time >= self._until:
            self._from = self._to

    def go(self, value: float, speed: float, time: float) -> None:
        """Go to a value, mm/s or degrees/s at most."""
        if value == self._to:
            return
        here = self.at(time)
        self._from, self._to, self._since = here, value, time
        self._until = time + abs(value - here) / speed
