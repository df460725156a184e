"""One axis on its own: from where it is to where it shall come to rest."""

from __future__ import annotations

from math import copysign

from polycnc.deferred.records import dataclass
from polycnc.geometry.tolerances import NO_WAY
from polycnc.motion.averaging import way_after
from polycnc.motion.law import Phase
from polycnc.motion.phases.speed import FREE, Calm, Profile, straight_profile


@dataclass(frozen=True, slots=True)
class AxisMove:
    """A motion of one axis to rest.

    Attributes:
        start: Position when it began.
        phases: Constant accelerations along the axis, signed; they come one after the other.
        since: When it began.
        target: Where the axis comes to rest.
    """

    start: float
    phases: tuple[Phase, ...]
    since: float
    target: float

    @property
    def end(self) -> float:
        """When the axis rests."""
        return self.since + sum(phase.seconds for phase in self.phases)

    def after(self, time: float) -> tuple[float, float]:
        """Position and velocity at a time."""
        if time >= self.end:
            return self.target, 0.0
        position, seconds = self.start, time - self.since
        for phase in self.phases:
            if seconds < phase.seconds:
                velocity = phase.speed + phase.pull * seconds
                return position + way_after(seconds, phase.speed, phase.pull), velocity
            seconds -= phase.seconds
            position += phase.way
        return self.target, 0.0


def axis_move(
    position: float,
    velocity: float,
    target: float,
    speed: float,
    pull: float,
    since: float,
    calm: Calm = FREE,
) -> AxisMove:
    """The quickest way to rest at a target, or as near behind it as the axis can brake, and then back.

    Args:
        position: Where the axis is.
        velocity: How fast it moves, signed.
        target: Where it shall rest.
        speed: How fast it may move; 0 lets it brake where it is.
        pull: Its acceleration.
        since: The time.
        calm: How long it must keep its speed before its acceleration, signed, changes its sign.
    """
    phases: list[Phase] = []
    place, braking = position, velocity * velocity / (2.0 * pull)
    if speed <= 0.0:
        wait = calm.before_down if velocity > 0.0 else calm.before_up
        target = position + copysign(braking + abs(velocity) * wait, velocity)
    way = target - position
    if velocity and (way * velocity <= 0.0 or braking > abs(way) + NO_WAY):
        seconds = abs(velocity) / pull
        phases.append(Phase(seconds, copysign(braking, velocity), velocity, -copysign(pull, velocity)))
        place, velocity = position + copysign(braking, velocity), 0.0
        way = target - place
    if abs(way) > NO_WAY and (speed > 0.0 or velocity):
        cap = speed if speed > 0.0 else abs(velocity)
        sign = copysign(1.0, way)
        own = calm if sign > 0.0 else Calm(calm.level, calm.before_down, calm.before_up)
        profile: Profile = straight_profile(abs(way), velocity * velocity, 0.0, cap * cap, pull, own)
        phases += [Phase(p.seconds, sign * p.way, sign * p.speed, sign * p.pull) for p in profile.phases]
    return AxisMove(position, tuple(phases), since, target)
