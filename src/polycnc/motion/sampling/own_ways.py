"""Axes that are positioned beside the path, as samples show them: how far they are from where the path has them."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.law import Law

if TYPE_CHECKING:
    from polycnc.motion.sampling.run import Moved, Numbers
    from polycnc.motion.standing.positioning import AxisOnItsWay


class OwnWays:
    """Adds to the motion of the path what axes do by themselves.

    The path has such an axis at its target from the time on at which it begins.
    """

    def __init__(self) -> None:
        self._laws: dict[int, tuple[Law, float, float, float]] = {}

    def begin(self, way: AxisOnItsWay, time: float) -> float:
        """An axis begins at a time, s, out of whatever it does; gives its target."""
        move = way.move
        assert move is not None
        known = self._laws.get(way.column)
        law = Law(time, move.start) if known is None or known[1] <= time else known[0]
        law.run(time, move.start, move.phases)
        self._laws[way.column] = law, time + move.end + way.ramp_s, way.ramp_s, move.target
        return move.target

    def add(self, times: Numbers, moved: Moved) -> Moved:
        """The motion of all axes at times, s from the start."""
        if not self._laws or not len(times):
            return moved
        position, velocity, acceleration = (each.copy() for each in moved)
        for column, (law, end, ramp_s, target) in self._laws.items():
            here = times < end
            if here.any():
                place, speed, pull = law.motion(times[here], ramp_s)
                position[here, column] += place - target
                velocity[here, column] += speed
                acceleration[here, column] += pull
        self._laws = {column: known for column, known in self._laws.items() if known[1] > times[-1]}
        return position, velocity, acceleration
