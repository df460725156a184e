"""Axes moved by hand: each on its own, until it has reached its goal or is stopped."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from polycnc.mainrun.axis_move import NO_WAY, AxisMove, axis_move

if TYPE_CHECKING:
    from polycnc.machine.model import Axis

#: How far an axis without limits is sent, mm or degrees.
ENDLESS = 1e6


class ManualAxes:
    """The axes of a channel while an operator moves them.

    Args:
        axes: The machine's axes in the order of the channel.
    """

    def __init__(self, axes: tuple[Axis, ...]) -> None:
        self._axes = axes
        self._moves: dict[int, AxisMove] = {}
        self._goals: dict[int, float] = {}

    @property
    def moving(self) -> frozenset[int]:
        """The axes under way."""
        return frozenset(self._moves)

    @property
    def goals(self) -> frozenset[int]:
        """The axes that are not yet where they are meant to be; at an override of zero they wait."""
        return frozenset(self._goals)

    @property
    def due(self) -> float:
        """When the next axis comes to rest; inf where none moves."""
        return min((move.end for move in self._moves.values()), default=inf)

    def positions(self, position: list[float], time: float) -> list[float]:
        """Machine position at a time; `position` is where axes stand that do not move."""
        now = list(position)
        for i, move in self._moves.items():
            now[i] = move.after(time)[0]
        return now

    def speed(self, time: float) -> float:
        """The fastest axis, mm/s or degrees/s."""
        return max((abs(move.after(time)[1]) for move in self._moves.values()), default=0.0)

    def settle(self, position: list[float], time: float) -> list[float]:
        """As `positions`; axes that have arrived move no more."""
        now = self.positions(position, time)
        for i in [i for i, move in self._moves.items() if move.end <= time]:
            del self._moves[i]
            if abs(now[i] - self._goals.get(i, now[i])) <= NO_WAY:
                self._goals.pop(i, None)
        return now

    def towards(self, axis: int, position: float, target: float, speed: float, time: float) -> None:
        """Lead an axis to a target (machine position, its limits kept), from rest or out of its motion."""
        limits = self._axes[axis]
        self._goals[axis] = min(max(target, limits.limit_minus), limits.limit_plus)
        self._move(axis, position, speed, time)

    def change_speed(self, axis: int, position: float, speed: float, time: float) -> None:
        """Another speed for an axis that has a goal."""
        if axis in self._goals:
            self._move(axis, position, speed, time)

    def _move(self, axis: int, position: float, speed: float, time: float) -> None:
        velocity = 0.0
        if axis in self._moves:
            position, velocity = self._moves[axis].after(time)
        pull = _pull(self._axes[axis])
        self._moves[axis] = axis_move(position, velocity, self._goals[axis], speed, pull, time)

    def along(self, axis: int, direction: int, position: float) -> float:
        """How far an axis can go in a direction: its limit, or so far that nobody waits for it."""
        limits = self._axes[axis]
        limit = limits.limit_plus if direction > 0 else limits.limit_minus
        return limit if abs(limit) < inf else position + direction * ENDLESS

    def goal(self, axis: int, position: float) -> float:
        """Where an axis is meant to go; where it stands if it is not meant to move."""
        return self._goals.get(axis, position)

    def brake(self, axis: int, time: float) -> None:
        """Bring an axis to rest as quickly as it can, and leave it there."""
        if axis in self._moves:
            position, velocity = self._moves[axis].after(time)
            pull = _pull(self._axes[axis])
            self._moves[axis] = axis_move(position, velocity, position, 0.0, pull, time)
        self._goals.pop(axis, None)

    def brake_all(self, time: float) -> None:
        """Bring every axis to rest."""
        for axis in range(len(self._axes)):
            self.brake(axis, time)


def _pull(axis: Axis) -> float:
    return axis.acceleration or 1e9
