"""A shift of an axis beside everything else: it goes to what an action (`$AA_OFF`) or a handwheel (DRF) asks for."""

from __future__ import annotations

from math import inf

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.phases.axis_move import axis_move

if TYPE_CHECKING:
    from polycnc.motion.phases.axis_move import AxisMove

#: Of an axis about whose acceleration the machine says nothing, mm/s² or degrees/s².
FREE = 1e9


class Overlay:
    """A source of an axis, which goes to its value and rests there.

    Args:
        acceleration: That of the axis, mm/s² or degrees/s²; 0 for one without limit.
    """

    def __init__(self, acceleration: float = 0.0) -> None:
        self._acceleration = acceleration or FREE
        self._to = self._place = 0.0
        self._lead: AxisMove | None = None

    def at(self, time: float) -> float:
        """Its share of the setpoint."""
        return self._place if self._lead is None else self._lead.after(time)[0]

    @property
    def target(self) -> float:
        """The value that it goes to."""
        return self._to

    @property
    def due(self) -> float:
        """When it has reached its value; inf where it does not move."""
        return self._lead.end if self._lead is not None else inf

    def arrive(self, time: float) -> None:
        """What has reached its value moves no more."""
        if self._lead is not None and time >= self._lead.end:
            self._place, self._lead = self._to, None

    def go(self, value: float, speed: float, time: float, pull: float = 1.0) -> None:
        """Go to a value, mm/s or degrees/s at most, with a part of the acceleration."""
        if value == self._to:
            return
        here, velocity = (self._place, 0.0) if self._lead is None else self._lead.after(time)
        self._to = value
        self._lead = axis_move(here, velocity, value, speed, self._acceleration * pull, time)
