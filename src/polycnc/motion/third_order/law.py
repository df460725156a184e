"""The law of a run: how far along its bent path the axes are at every moment, in phases of constant jerk."""

from __future__ import annotations

from array import array

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias
from polycnc.motion.third_order.laws.courses import Axes, Phase
from polycnc.motion.third_order.laws.quickest import NoLawError, course_of, quickest

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy as np
    from numpy.typing import NDArray

    from polycnc.machine.model import Axis
    from polycnc.motion.third_order.bent_path import BentPath

Numbers: TypeAlias = "NDArray[np.float64]"


@dataclass(frozen=True)
class JerkLaw:
    """Phases of constant jerk along a path, one behind the other: k of them.

    Attributes:
        start: The time at which each begins, s, from 0 on, (k,).
        way: The way then, mm.
        speed: Along the path, mm/s.
        pull: Acceleration along the path, mm/s².
        jerk: Along the path, mm/s³.
        seconds: The time at which the last one ends.
        length: The way then.
    """

    start: Numbers
    way: Numbers
    speed: Numbers
    pull: Numbers
    jerk: Numbers
    seconds: float
    length: float

    def at(self, times: Numbers) -> tuple[Numbers, Numbers, Numbers, Numbers]:
        """Way, speed, acceleration and jerk at times, each (q,); before and behind as at the ends, without jerk."""
        import numpy as np

        k = np.clip(np.searchsorted(self.start, times, "right") - 1, 0, len(self.start) - 1)
        t = np.clip(times, 0.0, self.seconds) - self.start[k]
        way, speed, pull, jerk = self.way[k], self.speed[k], self.pull[k], self.jerk[k]
        inside = (times >= 0.0) & (times <= self.seconds)
        return (
            np.clip(way + t * (speed + t * (0.5 * pull + t * jerk / 6.0)), 0.0, self.length),
            speed + t * (pull + 0.5 * t * jerk),
            pull + t * jerk,
            np.where(inside, jerk, 0.0),
        )

    def times_at(self, ways: Numbers) -> Numbers:
        """The times at which places are reached, (q,)."""
        import numpy as np

        k = np.clip(np.searchsorted(self.way, ways, "right") - 1, 0, len(self.way) - 1)
        low, high = self.start[k].copy(), np.append(self.start[1:], self.seconds)[k]
        for _ in range(52):  # halves down to the last bit
            middle = 0.5 * (low + high)
            t = middle - self.start[k]
            beyond = (
                self.way[k] + t * (self.speed[k] + t * (0.5 * self.pull[k] + t * self.jerk[k] / 6.0)) > ways
            )
            low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
        return np.where(ways >= self.length, self.seconds, 0.5 * (low + high))


def limits_of(axes: Iterable[Axis]) -> Axes:
    """Highest speed, acceleration and jerk of machine axes, for cuts."""
    axes = list(axes)
    return Axes(
        array("d", [axis.max_feed for axis in axes]),
        array("d", [axis.acceleration for axis in axes]),
        array("d", [axis.jerk for axis in axes]),
    )


def quickest_law(
    path: BentPath,
    axes: Axes,
    *,
    start: tuple[float, float] = (0.0, 0.0),
    end: tuple[float, float] = (0.0, 0.0),
) -> JerkLaw:
    """The law that gets along a path as quickly as velocity, acceleration and jerk of every axis allow.

    It is close to the least time, not it: barriers keep a small distance from the limits (`laws/barrier.py`). That the
    limits are kept, to a part in a million, is proved piece by piece for all moments (`laws/phases.py`).

    Args:
        path: The path of n axes.
        axes: Limits of the n axes.
        start: Speed and acceleration at its start; both zero at rest.
        end: The same at its end.

    Raises:
        NoLawError: From the motion at its start the end cannot be reached as it shall be.
    """
    course = course_of(*(_flat(v) for v in (path.way, path.first, path.second, path.cap2, path.ease)))
    found = quickest(course, axes, array("d", [*start, *end]))
    if found is None:
        msg = "no law within the limits from this state"
        raise NoLawError(msg)
    return law_of(found.phases, float(path.way[-1]))


def law_of(phases: array[float], length: float) -> JerkLaw:
    """Phases, see `Phase`, as arrays of numpy."""
    import numpy as np

    table = np.frombuffer(phases).reshape(-1, Phase.SIZE)
    table = table[table[:, Phase.TIME] > 0.0]
    ends = np.cumsum(table[:, Phase.TIME])
    return JerkLaw(
        np.append(0.0, ends[:-1]),
        table[:, Phase.WAY].copy(),
        table[:, Phase.SPEED].copy(),
        table[:, Phase.PULL].copy(),
        table[:, Phase.JERK].copy(),
        float(ends[-1]),
        length,
    )


def _flat(values: Numbers) -> array[float]:
    found = array("d")
    found.frombytes(values.astype(float).tobytes())
    return found
