"""The law of motion along a path: phases of constant acceleration or constant jerk, and their average over time.

The interpolator runs in phases, so that the way is piecewise quadratic in time (cubic under a jerk), the area below it
of one degree more, and the average of the way over a window the difference of two areas. Plan, samples and main run ask
the same class: a number for one moment, an array for many.
"""

from __future__ import annotations

from array import array
from bisect import bisect_left, bisect_right
from math import sqrt
from typing import TYPE_CHECKING, TypeAlias

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.motion.averaging import area_after, average, way_after

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy as np
    from numpy.typing import NDArray

    from polycnc.motion.averaging import Value

Numbers: TypeAlias = "NDArray[np.float64]"
#: Areas are summed in two parts, multiples of this and the rest: those of a long run are as exact as of a short one.
GRID = 2.0**-20
#: How long a phase has lasted, and what it began with: place, speed, acceleration, jerk, area in two parts.
_InPhase: TypeAlias = "tuple[Value, Value, Value, Value, Value, Value, Value]"
#: Steps of the search for a time: each halves what the step before has left at least.
STEPS = 60


class Phase(NamedTuple):
    """Constant `jerk` for `seconds` from `speed` and the acceleration `pull` on, over `way`."""

    seconds: float
    way: float
    speed: float
    pull: float
    jerk: float = 0.0


class Law:
    """One place over time: phases of constant jerk, most of them of none, at rest before and behind them.

    Args:
        time: When it begins.
        place: Where it is then.
    """

    def __init__(self, time: float = 0.0, place: float = 0.0) -> None:
        # When a phase begins, where, its first speed and pull, its jerk, and the area below the places before it.
        self._start, self._place = array("d", (time,)), array("d", (place,))
        self._speed, self._pull, self._jerk = (array("d", (0.0,)) for _ in range(3))
        self._area, self._fine = array("d", (0.0,)), array("d", (0.0,))
        self._origin = place

    @classmethod
    def of(
        cls,
        seconds: Numbers,
        ways: Numbers,
        speed: Numbers,
        pull: Numbers | None = None,
        jerk: Numbers | None = None,
    ) -> Law:
        """A law from time 0 and place 0 on, by duration, way and first speed of many phases, (m,) each.

        And by their first acceleration and their jerk: where these are left out, by the constant acceleration that
        leads over the way.
        """
        law = cls()
        law.extend(seconds, ways, speed, pull, jerk)
        return law

    def extend(
        self,
        seconds: Numbers,
        ways: Numbers,
        speed: Numbers,
        pull: Numbers | None = None,
        jerk: Numbers | None = None,
    ) -> None:
        """Go on behind the last phase with many phases, as `of` says."""
        import numpy as np

        keep = seconds > 0.0
        seconds, ways, speed = seconds[keep], ways[keep], speed[keep]
        pull = 2.0 * (ways - speed * seconds) / (seconds * seconds) if pull is None else pull[keep]
        jerk = np.zeros(len(seconds)) if jerk is None else jerk[keep]
        is_begun = len(self._start) > 1  # before the first phase it rests
        time, place, _, _, _, area, fine = (
            column.pop() if is_begun else column[-1] for column in self._columns
        )
        places = _sums(place, ways)
        areas = area_after(seconds, places[:-1] - self._origin, speed, pull, jerk)
        coarse = np.round(areas / GRID) * GRID
        more = (
            _sums(time, seconds),
            places,
            speed,
            pull,
            jerk,
            _sums(area, coarse),
            _sums(fine, areas - coarse),
        )
        for column, values in zip(self._columns, more, strict=True):
            column.frombytes(np.ascontiguousarray(values, np.float64).tobytes())
        for rest in (self._speed, self._pull, self._jerk):
            rest.append(0.0)

    def run(self, time: float, place: float, phases: Iterable[Phase]) -> None:
        """What happens from a time on, in place of what was said before."""
        columns = self._columns
        while len(self._start) > 1 and self._start[-1] >= time:
            for column in columns:
                column.pop()
        area, fine = self._area_at(self._phase(time))
        coarse = round(fine / GRID) * GRID
        area, fine = area + coarse, fine - coarse
        for phase in (*phases, Phase(0.0, 0.0, 0.0, 0.0)):
            row = time, place, phase.speed, phase.pull, phase.jerk, area, fine
            for column, value in zip(columns, row, strict=True):
                column.append(value)
            more = area_after(phase.seconds, place - self._origin, phase.speed, phase.pull, phase.jerk)
            coarse = round(more / GRID) * GRID
            area, fine = area + coarse, fine + (more - coarse)
            time, place = time + phase.seconds, place + phase.way

    def forget(self, before: float) -> None:
        """Nobody will ask for a time before this one."""
        last = bisect_right(self._start, before) - 1
        for column in self._columns:
            del column[: max(last, 0)]

    @property
    def phases(self) -> int:
        """How many phases are kept."""
        return len(self._start)

    @property
    def seconds(self) -> float:
        """Duration."""
        return self._start[-1] - self._start[0]

    @property
    def end_time(self) -> float:
        """When it ends."""
        return self._start[-1]

    @property
    def end(self) -> float:
        """The place at the end."""
        return self._place[-1]

    def at(self, time: Value) -> Value:
        """The place at a time."""
        seconds, place, speed, pull, jerk, _, _ = self._phase(time)
        return place + way_after(seconds, speed, pull, jerk)

    def speed(self, time: Value) -> Value:
        """The speed at a time."""
        seconds, _, speed, pull, jerk, _, _ = self._phase(time)
        return speed + seconds * (pull + 0.5 * seconds * jerk)

    def pull(self, time: Value) -> Value:
        """The acceleration at a time."""
        seconds, _, _, pull, jerk, _, _ = self._phase(time)
        return pull + seconds * jerk

    def mean(self, time: Value, window: float) -> Value:
        """The average place over the time `window` before."""
        if window <= 0.0:
            return self.at(time)
        return self._mean(self._phase(time - window), self._phase(time), window)

    def mean_speed(self, time: Value, window: float) -> Value:
        """The average speed over the time `window` before."""
        return average(self.at(time - window), self.at(time), window) if window > 0.0 else self.speed(time)

    def mean_pull(self, time: Value, window: float) -> Value:
        """The average acceleration over the time `window` before."""
        if window <= 0.0:
            return self.pull(time)
        return average(self.speed(time - window), self.speed(time), window)

    def motion(self, time: Numbers, window: float) -> tuple[Numbers, Numbers, Numbers]:
        """The averages of place, speed and acceleration over the time `window` before many times, (k,) each."""
        phase = self._phase(time)
        seconds, place, speed, pull, jerk, _, _ = phase
        here = place + way_after(seconds, speed, pull, jerk)
        fast = speed + seconds * (pull + 0.5 * seconds * jerk)
        if window <= 0.0:
            return here, fast, pull + seconds * jerk
        earlier = self._phase(time - window)
        seconds, place, speed, pull, jerk, _, _ = earlier
        before = place + way_after(seconds, speed, pull, jerk)
        slow = speed + seconds * (pull + 0.5 * seconds * jerk)
        mean = self._mean(earlier, phase, window)
        return mean, average(before, here, window), average(slow, fast, window)

    def edges(self, first: float, last: float, window: float) -> list[float]:
        """Times between two at which the average over the time `window` before begins to follow another rule."""
        found: list[float] = []
        for late in (0.0, window) if window > 0.0 else (0.0,):
            low, high = bisect_right(self._start, first - late), bisect_left(self._start, last - late)
            found += [time + late for time in self._start[low:high]]
        return found

    def when(self, place: float) -> float:
        """The time at which a law that never goes back comes to a place."""
        k = max(bisect_right(self._place, place) - 1, 0)
        left, speed, pull = max(place - self._place[k], 0.0), self._speed[k], self._pull[k]
        if self._jerk[k] != 0.0:
            return self._start[k] + self._time_over(k, left)
        fast = sqrt(max(speed * speed + 2.0 * pull * left, 0.0)) + speed
        return self._start[k] + (2.0 * left / fast if fast > 0.0 else 0.0)

    def when_at(self, places: Numbers) -> Numbers:
        """The same for many places, (k,)."""
        import numpy as np

        k = np.maximum(np.searchsorted(np.asarray(self._place), places, "right") - 1, 0)
        start, place, speed, pull, jerk = (np.asarray(column)[k] for column in self._columns[:5])
        left = np.maximum(places - place, 0.0)
        fast = np.sqrt(np.maximum(speed * speed + 2.0 * pull * left, 0.0)) + speed
        moves = fast > 0.0
        seconds = np.where(moves, 2.0 * left / np.where(moves, fast, 1.0), 0.0)
        for i in np.flatnonzero(jerk != 0.0).tolist():
            seconds[i] = self._time_over(int(k[i]), float(left[i])) if left[i] > 0.0 else 0.0
        times: Numbers = start + seconds
        return times

    def when_mean(self, place: float, window: float) -> float:
        """The time at which its average over the time `window` before comes to a place."""
        low = self.when(place)
        if window <= 0.0:
            return low
        high = low + window
        for _ in range(STEPS):
            middle = 0.5 * (low + high)
            if not low < middle < high:
                break
            low, high = (middle, high) if self.mean(middle, window) < place else (low, middle)
        return high

    @property
    def _columns(self) -> tuple[array[float], ...]:
        return self._start, self._place, self._speed, self._pull, self._jerk, self._area, self._fine

    def _time_over(self, k: int, way: float) -> float:
        """Seconds from the start of a phase with a jerk until a way is done: steps of Newton, kept between bounds."""
        speed, pull, jerk = self._speed[k], self._pull[k], self._jerk[k]
        low, high = 0.0, self._start[k + 1] - self._start[k] if way > 0.0 else 0.0
        seconds = high
        for _ in range(STEPS):
            off = way_after(seconds, speed, pull, jerk) - way
            low, high = (low, seconds) if off > 0.0 else (seconds, high)
            fast = speed + seconds * (pull + 0.5 * seconds * jerk)
            new = seconds - off / fast if fast > 0.0 else low
            if not low < new < high:
                new = 0.5 * (low + high)
            if new in (low, seconds, high):
                break
            seconds = new
        return seconds

    def _phase(self, time: Value) -> _InPhase[Value]:
        """How long the phase at a time has lasted, and what it began with."""
        if isinstance(time, float | int):
            k = max(bisect_right(self._start, time) - 1, 0)
            return (
                time - self._start[k], self._place[k], self._speed[k], self._pull[k], self._jerk[k],
                self._area[k], self._fine[k],
            )  # fmt: skip
        import numpy as np

        start = np.asarray(self._start)
        at = np.maximum(np.searchsorted(start, time, "right") - 1, 0)
        place, speed, pull, jerk, area, fine = (np.asarray(column)[at] for column in self._columns[1:])
        return time - start[at], place, speed, pull, jerk, area, fine

    def _area_at(self, phase: _InPhase[Value]) -> tuple[Value, Value]:
        """The integral of the places, counted from the origin, over the time before: in two parts."""
        seconds, place, speed, pull, jerk, area, fine = phase
        return area, fine + area_after(seconds, place - self._origin, speed, pull, jerk)

    def _mean(self, before: _InPhase[Value], here: _InPhase[Value], window: float) -> Value:
        """The average place between two times, `window` apart."""
        (first, fine), (last, finer) = self._area_at(before), self._area_at(here)
        return self._origin + ((last - first) + (finer - fine)) / window


def _sums(first: float, values: Numbers) -> Numbers:
    """A number, and the sums of it and of the first, the first two and so on of many."""
    import numpy as np

    sums: Numbers = np.cumsum(np.concatenate([[first], values]))
    return sums
