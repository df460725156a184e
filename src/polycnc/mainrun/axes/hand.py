"""An axis by hand: jog, steps, handwheel, reference approach; until it has reached its goal or is stopped."""

from __future__ import annotations

from math import inf

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.motion.law import Law
from polycnc.motion.phases.axis_move import AxisMove, axis_move

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.machine.model import Axis as AxisData

#: How far an axis without limits is sent, mm or degrees.
ENDLESS = 1e6


class Hand:
    """What an operator moves of an axis.

    With limited jerk the axis follows what leads it as an average over `2·a/j` (`motion/averaging.py`): so long takes
    the acceleration a to change its sign. Places are machine positions; the share of the setpoint is how far the axis
    is from where it would be without the hand.

    Args:
        data: What the machine says of the axis.
        ramp: Seconds over which its motion is averaged.
    """

    __slots__ = (
        "_base", "_data", "_follows", "_goal", "_high", "_law", "_lead", "_low", "_place", "_ramp", "_speed",
    )  # fmt: skip

    def __init__(self, data: AxisData, ramp: float) -> None:
        self._data = data
        self._ramp = ramp
        self._low, self._high = data.limit_minus, data.limit_plus
        self._base = self._place = 0.0
        self._lead: AxisMove | None = None
        self._law = Law(0.0, 0.0)
        self._goal: float | None = None
        self._follows: Callable[[float], float] | None = None
        self._speed: Callable[[], float] = lambda: 0.0

    # ---- a source of the axis ------------------------------------------------------------------------------

    def at(self, time: float) -> float:
        """Its share of the setpoint."""
        beside = self._follows(time) if self._follows is not None else 0.0
        if self._lead is None:
            return self._place - self._base + beside
        return self._law.mean(time, self._ramp) - self._base + beside

    @property
    def due(self) -> float:
        """When the axis comes to rest; inf where it does not move."""
        return self._lead.end + self._ramp if self._lead is not None else inf

    def arrive(self, time: float) -> None:
        """An axis that has arrived moves no more."""
        if self._lead is None or self.due > time:
            return
        here = self._place = self._lead.target
        self._lead = None
        if self._goal is not None and abs(here - self._goal) <= NO_WAY:
            self._goal = None

    # ---- states --------------------------------------------------------------------------------------------

    @property
    def moves(self) -> bool:
        """Whether the axis is under way."""
        return self._lead is not None

    @property
    def has_goal(self) -> bool:
        """Whether the axis is not yet where it is meant to be; at an override of zero it waits."""
        return self._goal is not None

    def speed(self, time: float) -> float:
        """Speed, mm/s or degrees/s, signed."""
        if self._lead is None:
            return 0.0
        if self._ramp == 0.0:
            return self._lead.after(time)[1]
        return self._law.mean_speed(time, self._ramp)

    def bound(self, low: float, high: float) -> None:
        """The axis keeps to this range too, beside the travel of the machine."""
        self._low, self._high = max(self._data.limit_minus, low), min(self._data.limit_plus, high)

    # ---- commands ------------------------------------------------------------------------------------------

    def stand(self, place: float, base: float) -> None:
        """The axis rests at a place; without the hand it would be at `base`."""
        self._place, self._base = place, base
        self._lead = self._goal = self._follows = None

    def rebase(self, way: float) -> None:
        """Without the hand the axis would be elsewhere from now on, by this way; it stays where it is."""
        self._base += way

    def follow(self, share: Callable[[float], float]) -> None:
        """The axis goes along with others: a share of its own by time, until `settle` or `stand`."""
        self._follows = share

    def settle(self, time: float) -> None:
        """The others stand: where the axis has followed them is its own place."""
        if self._follows is not None:
            self._place, self._follows = self._place + self._follows(time), None

    def towards(self, target: float, speed: Callable[[], float], time: float) -> None:
        """Lead the axis to a target (its limits kept), from rest or out of its motion.

        `speed` is asked again when the operator has turned an override.
        """
        here = self._place
        # An axis beyond a limit may come back.
        low, high = min(self._low, here), max(self._high, here)
        self._goal, self._speed = min(max(target, low), high), speed
        self._move(self._goal, speed(), time)

    def revise(self, time: float) -> None:
        """The operator has turned an override: the axis goes on with the speed that it asks for now."""
        if self._goal is not None:
            self._move(self._goal, self._speed(), time)

    def brake(self, time: float) -> None:
        """Bring the axis to rest as quickly as it can, and leave it there."""
        if self._lead is not None:
            self._move(0.0, 0.0, time)
        self._goal = None

    def _move(self, target: float, speed: float, time: float) -> None:
        position, velocity = self._place, 0.0
        if self._lead is not None:
            position, velocity = self._lead.after(time)
        else:
            self._law = Law(time, position)
        pull = self._data.acceleration or 1e9
        lead = self._lead = axis_move(position, velocity, target, speed, pull, time)
        self._law.run(time, position, lead.phases)
        self._law.forget(time - self._ramp)

    def end_of_travel(self, direction: int, position: float) -> float:
        """How far the axis can go in a direction: its limit, or so far that nobody waits for it."""
        limit = self._high if direction > 0 else self._low
        if abs(limit) == inf:
            return position + direction * ENDLESS
        return max(limit, position) if direction > 0 else min(limit, position)

    def goal(self, position: float) -> float:
        """Where the axis is meant to go; where it stands if it is not meant to move."""
        return self._goal if self._goal is not None else position
