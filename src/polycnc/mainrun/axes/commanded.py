"""An axis that is moved beside the path: by a synchronised action, or by a positioning word of the program.

While it is commanded its place is its own; the share of the setpoint is how far that is from where the path has it.
When a program has it again the place goes into the path.
"""

from __future__ import annotations

from math import copysign, inf

from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.geometry.tolerances import NO_WAY
from polycnc.mainrun.axes.hand import ENDLESS
from polycnc.motion.law import Law as MotionLaw
from polycnc.motion.phases.axis_move import AxisMove, axis_move

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.machine.model import Axis as AxisData
    from polycnc.transformation.couplings.laws import Law

#: Parts of velocity and acceleration with which an axis catches up; what leads it has the rest.
OWN_SPEED, OWN_PULL = 0.2, 0.5


class Leading(Protocol):
    """What leads an axis: another one, or a spindle by what it has turned."""

    def setpoint(self, time: float) -> float:
        """Its place, mm or degrees."""

    def speed(self, time: float) -> float:
        """How fast that changes, mm/s or degrees/s."""


class CommandedAxis:
    """A source of an axis; satisfies `Command` and the channel's `Commanded`.

    Args:
        data: What the machine says of the axis.
        ramp: Seconds over which its motion is averaged (limited jerk); 0 without.
        place: Where it stands, machine position.
        clock: Gives the time, s.

    Attributes:
        base: Where the path has the axis.
        override: 1 for 100 %.
        on_rest: Called when it comes to rest.
    """

    def __init__(
        self,
        data: AxisData,
        ramp: float,
        place: float,
        clock: Callable[[], float],
        on_rest: Callable[[], None],
    ) -> None:
        self.base = place
        self.override = 1.0
        self.on_rest = on_rest
        self._data, self._ramp, self._clock = data, ramp, clock
        self._place = place
        self._lead: AxisMove | None = None
        self._law = MotionLaw(0.0, place)
        self._target: float | None = None
        self._speed = 0.0
        self._led: tuple[tuple[Leading, Law], ...] = ()
        self._is_endless = False

    # ---- a source of the axis ------------------------------------------------------------------------------

    def place(self, time: float) -> float:
        """Where it is at a time."""
        own = self._place if self._lead is None else self._law.mean(time, self._ramp)
        return own + self._shares(time) if self._led else own

    def _shares(self, time: float) -> float:
        return sum(law.share(axis.setpoint(time)) for axis, law in self._led)

    def follow(self, led: Sequence[tuple[Leading, Law]], *, catches_up: bool = True) -> None:
        """Others lead it from now on, beside what it does by itself; without any it brakes, and stays.

        What its speed would change at once it makes up by itself.

        Args:
            led: What leads it, and by which laws.
            catches_up: It makes up for the way that it is behind meanwhile, too.
        """
        time = self._clock()
        before = self.velocity(time) + self._share_speed(time)
        self.stop()
        place = self.place(time)
        self._led = tuple(led)
        self._place = place - self._shares(time)
        self._lead = self._target = None
        after = self._share_speed(time)
        if before != after:
            self._make_up(before - after, time, catches_up=catches_up and bool(led))

    def _share_speed(self, time: float) -> float:
        """How fast those that lead it move it."""
        return sum(law.slope(leading.setpoint(time)) * leading.speed(time) for leading, law in self._led)

    def _make_up(self, velocity: float, time: float, *, catches_up: bool) -> None:
        """Come from a velocity to rest: at its place where it catches up with those that lead it, else where it can."""
        pull, target = OWN_PULL * (self._data.acceleration or 1e9), self._place
        if not catches_up:
            target += copysign(0.5 * velocity * velocity / pull, velocity)
        speed = OWN_SPEED * (self._data.rapid or 1e9)
        self._lead = axis_move(self._place, velocity, target, speed, pull, time)
        self._law = MotionLaw(time, self._place)
        self._law.run(time, self._place, self._lead.phases)
        self._law.forget(time - self._ramp)

    def at(self, time: float) -> float:
        """Its share of the setpoint."""
        return self.place(time) - self.base

    @property
    def due(self) -> float:
        """When the axis comes to rest; inf where it does not move."""
        return self._lead.end + self._ramp if self._lead is not None else inf

    def arrive(self, time: float) -> None:
        """An axis that has arrived moves no more."""
        if self._lead is None or self.due > time:
            return
        self._place, self._lead = self._lead.target, None
        if self._target is not None and abs(self._place - self._target) <= NO_WAY:
            self._target = None
        self.on_rest()

    # ---- commands ------------------------------------------------------------------------------------------

    @property
    def moves(self) -> bool:
        """Whether it is under way, or waits at an override of 0."""
        return self._lead is not None or self._target is not None or bool(self._led)

    @property
    def is_turning(self) -> bool:
        """Whether it moves by itself now, beside what leads it."""
        return self._lead is not None

    @property
    def left(self) -> float:
        """Way to its target, signed; 0 where it has none."""
        return 0.0 if self._target is None else self._target - self.place(self._clock())

    def velocity(self, time: float) -> float:
        """How fast it moves, signed."""
        if self._lead is None:
            return 0.0
        return self._lead.after(time)[1] if self._ramp == 0.0 else self._law.mean_speed(time, self._ramp)

    def move_to(self, target: float, speed: float) -> None:
        """Go to a target, out of whatever it does; within the limits of its travel."""
        self._is_endless = False
        if target == self._target and speed == self._speed:
            return
        if self._lead is None and self._target is None and abs(target - self._place) <= NO_WAY:
            return  # it stands there
        self._target, self._speed = min(max(target, self._low), self._high), speed
        self._go()

    def run_on(self, direction: int, speed: float, end: float | None = None) -> None:
        """Go on, 1 or -1, without end or to this one; 0 brakes."""
        if direction == 0:
            self.stop()
            return
        self._is_endless = True
        limit = self._high if direction > 0 else self._low
        if end is not None:
            limit = min(limit, end) if direction > 0 else max(limit, end)
        here = self.place(self._clock())
        target = limit if abs(limit) < inf else here + copysign(ENDLESS, direction)
        if self._target is not None and speed == self._speed and (self._target > here) == (target > here):
            return
        self._target, self._speed = target, speed
        self._go()

    def change_speed(self, speed: float) -> None:
        """Another speed, where it is under way."""
        if self._target is not None and speed != self._speed:
            self._speed = speed
            self._go()

    def stop(self) -> None:
        """Brake, and drop the way that is left."""
        self._target = None
        if self._lead is not None:
            self._run(0.0, 0.0)

    def set_override(self, override: float) -> None:
        """Another override; 0 lets it wait."""
        if override != self.override:
            self.override = override
            if self._target is not None:
                self._go()

    def preset(self, place: float) -> None:
        """It is called another position where it is, and goes on with the way that is left."""
        time = self._clock()
        way = place - self.place(time)
        if self._target is not None:
            self._target += way
        if self._lead is None:
            self._place = place
            return
        lead = self._lead
        position, velocity = lead.after(time)
        self._lead = axis_move(
            position + way, velocity, lead.target + way, abs(self._speed) * self.override,
            self._data.acceleration or 1e9, time,
        )  # fmt: skip
        self._law = MotionLaw(time, position + way)
        self._law.run(time, position + way, self._lead.phases)

    def stand(self, place: float, base: float) -> None:
        """It rests at a place, where the path has it at `base`."""
        self._place, self.base = place, base
        self._lead = self._target = None

    def finish(self) -> None:
        """What it is about to do is done: it rests at its target, out of an endless motion where it is."""
        if not self.is_turning and self._target is None:
            return
        here = self._place if self._lead is None else self._law.mean(self._clock(), self._ramp)
        self._place = here if self._is_endless or self._target is None else self._target
        self._lead = self._target = None
        self.on_rest()

    def rebase(self) -> None:
        """It rests where it is, and the path has it there."""
        place = self.place(self._clock())
        self.stand(place, place)

    @property
    def _low(self) -> float:
        return min(self._data.limit_minus, self._place)

    @property
    def _high(self) -> float:
        return max(self._data.limit_plus, self._place)

    def _go(self) -> None:
        assert self._target is not None
        speed = min(self._speed * self.override, self._data.rapid or inf)
        if speed > 0.0 or self._lead is not None:
            self._run(self._target, speed)

    def _run(self, target: float, speed: float) -> None:
        time = self._clock()
        position, velocity = self._place, 0.0
        if self._lead is not None:
            position, velocity = self._lead.after(time)
        else:
            self._law = MotionLaw(time, position)
        lead = self._lead = axis_move(position, velocity, target, speed, self._data.acceleration or 1e9, time)
        self._law.run(time, position, lead.phases)
        self._law.forget(time - self._ramp)
