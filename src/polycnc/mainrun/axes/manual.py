"""Axes moved by hand: each on its own, until it has reached its goal or is stopped."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from polycnc.machine.motion_settings import SOFT
from polycnc.mainrun.motion.axis_move import NO_WAY, AxisMove, axis_move
from polycnc.mainrun.motion.follower import Law

if TYPE_CHECKING:
    from polycnc.machine.model import Axis
    from polycnc.machine.motion_settings import MotionSettings

#: How far an axis without limits is sent, mm or degrees.
ENDLESS = 1e6


class ManualAxes:
    """The axes of a channel while an operator moves them.

    With limited jerk an axis follows what leads it as an average over `2·a/j` (`follower.py`): so long takes the
    acceleration a to change its sign.

    Args:
        axes: The machine's axes in the order of the channel.
        settings: How the control leads the axes.

    Attributes:
        place: Where axes stand that do not move, machine position; None while nobody has moved any, and all of them
            are where a program has led them.
    """

    def __init__(self, axes: tuple[Axis, ...], settings: MotionSettings) -> None:
        soft = settings.acceleration == SOFT
        self.place: list[float] | None = None
        self._axes = axes
        self._ramps = [
            2.0 * axis.acceleration / axis.jerk if soft and axis.jerk > 0.0 else 0.0 for axis in axes
        ]
        self._leads: dict[int, AxisMove] = {}
        self._laws: dict[int, Law] = {}
        self._goals: dict[int, float] = {}

    @property
    def moving(self) -> frozenset[int]:
        """The axes under way."""
        return frozenset(self._leads)

    @property
    def goals(self) -> frozenset[int]:
        """The axes that are not yet where they are meant to be; at an override of zero they wait."""
        return frozenset(self._goals)

    @property
    def due(self) -> float:
        """When the next axis comes to rest; inf where none moves."""
        return min((self._rests(axis) for axis in self._leads), default=inf)

    def _rests(self, axis: int) -> float:
        return self._leads[axis].end + self._ramps[axis]

    def begin(self, place: list[float]) -> None:
        """Axes are going to be moved from where they stand."""
        if self.place is None:
            self.place = list(place)

    def positions(self, time: float) -> list[float]:
        """Machine position at a time, once an axis has been moved."""
        now = list(self.place or ())
        for axis, law in self._laws.items():
            now[axis] = law.mean(time, self._ramps[axis])
        return now

    def speed(self, time: float) -> float:
        """The fastest axis, mm/s or degrees/s."""
        return max((abs(self._speed(axis, time)) for axis in self._leads), default=0.0)

    def _speed(self, axis: int, time: float) -> float:
        ramp, law = self._ramps[axis], self._laws[axis]
        if ramp == 0.0:
            return self._leads[axis].after(time)[1]
        return (law.at(time) - law.at(time - ramp)) / ramp

    def arrive(self, time: float) -> None:
        """Axes that have arrived move no more."""
        if self.place is None:
            return
        for axis in [axis for axis in self._leads if self._rests(axis) <= time]:
            here = self.place[axis] = self._leads[axis].target
            del self._leads[axis], self._laws[axis]
            if abs(here - self._goals.get(axis, here)) <= NO_WAY:
                self._goals.pop(axis, None)

    def leave(self) -> None:
        """The axes belong to a program again."""
        self.place = None
        self._leads.clear()
        self._laws.clear()
        self._goals.clear()

    def towards(self, axis: int, target: float, speed: float, time: float) -> None:
        """Lead an axis to a target (machine position, its limits kept), from rest or out of its motion."""
        assert self.place is not None
        here, limits = self.place[axis], self._axes[axis]
        low, high = (
            min(limits.limit_minus, here),
            max(limits.limit_plus, here),
        )  # an axis beyond one may come back
        self._goals[axis] = min(max(target, low), high)
        self._move(axis, self._goals[axis], speed, time)

    def change_speed(self, axis: int, speed: float, time: float) -> None:
        """Another speed for an axis that has a goal."""
        if axis in self._goals:
            self._move(axis, self._goals[axis], speed, time)

    def _move(self, axis: int, target: float, speed: float, time: float) -> None:
        assert self.place is not None
        position, velocity = self.place[axis], 0.0
        if axis in self._leads:
            position, velocity = self._leads[axis].after(time)
        else:
            self._laws[axis] = Law(time, position)
        lead = axis_move(position, velocity, target, speed, self._axes[axis].acceleration or 1e9, time)
        self._leads[axis] = lead
        self._laws[axis].run(time, position, lead.phases)
        self._laws[axis].forget(time - self._ramps[axis])

    def along(self, axis: int, direction: int, position: float) -> float:
        """How far an axis can go in a direction: its limit, or so far that nobody waits for it."""
        limits = self._axes[axis]
        limit = limits.limit_plus if direction > 0 else limits.limit_minus
        if abs(limit) == inf:
            return position + direction * ENDLESS
        return max(limit, position) if direction > 0 else min(limit, position)

    def goal(self, axis: int, position: float) -> float:
        """Where an axis is meant to go; where it stands if it is not meant to move."""
        return self._goals.get(axis, position)

    def brake(self, axis: int, time: float) -> None:
        """Bring an axis to rest as quickly as it can, and leave it there."""
        if axis in self._leads:
            self._move(axis, 0.0, 0.0, time)
        self._goals.pop(axis, None)

    def brake_all(self, time: float) -> None:
        """Bring every axis to rest."""
        for axis in range(len(self._axes)):
            self.brake(axis, time)
