"""Speed and angle of the master spindle over time: it goes to each speed that it is told by its ramp."""

from __future__ import annotations

from bisect import bisect_right

import numpy as np

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.motion.sampling.run import Numbers

#: Degrees a second of a revolution a minute.
DEGREES = 6.0


class Knot(NamedTuple):
    """From a time on the speed changes evenly: rpm and rpm/s, degrees turned until then."""

    time: float
    rpm: float
    pull: float
    angle: float

    def later(self, time: float, pull: float = 0.0) -> Knot:
        """The motion at a later time, from which on it changes otherwise."""
        passed = time - self.time
        turned = DEGREES * passed * (self.rpm + 0.5 * self.pull * passed)
        return Knot(time, self.rpm + self.pull * passed, pull, self.angle + turned)


class SpindleCourse:
    """The speed of a spindle, at rest at first. Its angle is the integral of its speed."""

    def __init__(self) -> None:
        self._knots = [Knot(0.0, 0.0, 0.0, 0.0)]
        self._aim = 0.0

    @property
    def aim(self) -> float:
        """The speed that it has been told last, rpm."""
        return self._aim

    def go_to(self, time: float, rpm: float, pull: float) -> None:
        """From a time on it goes to a speed, by so many rpm a second; 0 for at once."""
        if rpm == self._aim:
            return
        self._aim, here = rpm, self._turn_off(time)
        change = rpm - here.rpm
        if pull > 0.0 and change != 0.0:
            ramp = here._replace(pull=pull if change > 0.0 else -pull)
            self._knots.append(ramp)
            here = ramp.later(time + abs(change) / pull)
        self._knots.append(here._replace(rpm=rpm))

    def go_evenly(self, time: float, rpm: float, seconds: float) -> None:
        """From a time on it takes so many seconds to come to a speed."""
        here = self._at(time)
        self._aim = here.rpm
        self.go_to(time, rpm, abs(rpm - here.rpm) / seconds)

    def stand(self, time: float, angle: float) -> None:
        """Something else has turned it to an angle, where it stands from a time on."""
        self._turn_off(time)
        self._aim = 0.0
        self._knots.append(Knot(time, 0.0, 0.0, angle))

    def at(self, times: Numbers) -> tuple[Numbers, Numbers]:
        """Speed and angle at times, (k,) each."""
        knots = np.array(self._knots)
        k = np.maximum(np.searchsorted(knots[:, 0], times, "right") - 1, 0)
        passed, rpm, pull = times - knots[k, 0], knots[k, 1], knots[k, 2]
        turned = DEGREES * passed * (rpm + 0.5 * pull * passed)
        return rpm + pull * passed, knots[k, 3] + turned

    def angle(self, time: float) -> float:
        """Degrees turned until a time."""
        return self._at(time).angle

    def forget(self, before: float) -> None:
        """Nobody asks for a time before this one."""
        del self._knots[: self._place(before)]

    def _place(self, time: float) -> int:
        return max(bisect_right(self._knots, time, key=lambda knot: knot.time) - 1, 0)

    def _at(self, time: float) -> Knot:
        return self._knots[self._place(time)].later(time)

    def _turn_off(self, time: float) -> Knot:
        """Forget what would come behind a time: the motion there."""
        here = self._at(time)
        del self._knots[self._place(time) + 1 :]
        return here
