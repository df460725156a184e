"""A run with limited jerk in the main run: a bent path, and a law along it that may be found anew at any moment.

As long as nobody disturbs it the law is that of the plan, window by window (`motion/third_order/runs.py`). An override,
a hold, a rest that somebody asks for: from the place, the speed and the acceleration of that moment another law is
found, as far ahead as the axes need to come to rest. It ends in rest there, and leads on in time.
"""

from __future__ import annotations

from array import array
from bisect import bisect_right
from itertools import pairwise
from math import hypot, inf, sqrt

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.motion.law import Law, Phase
from polycnc.motion.third_order.laws.courses import Axes
from polycnc.motion.third_order.laws.courses import Phase as Fields
from polycnc.motion.third_order.laws.quickest import course_of, quickest
from polycnc.motion.third_order.runs import RunPlanner

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from polycnc.motion.third_order.bends.stretches import Stretches
    from polycnc.motion.third_order.laws.courses import Course
    from polycnc.motion.third_order.parts import Part
    from polycnc.motion.third_order.windows import Window

#: Ways nearer than this are one, mm; speeds below this are rest, mm/s.
NEAR_MM, STILL = 1e-7, 1e-6
#: The way to rest is at first taken to be so many times that of the plain formula; it is found to this part of it.
LONGER, EXACT = 1.25, 0.02
#: Where no law is found over a way, this many times as long a way is tried, so many times.
FARTHER, TRIES = 1.5, 6
#: As long as nothing is known of it a motion goes on for a moment, seconds.
MOMENT_S = 1e-9
#: Slowing down a little takes so long at least, seconds.
AT_LEAST_S = 0.01


class Caps(Protocol):
    """Gives the largest square of the speed between two ways of a run."""

    def __call__(self, begin: float, end: float, *, asked: bool) -> float:
        """By what the rows allow, and, if `asked`, by the program and what the operator has set."""


class State(NamedTuple):
    """Way, speed and acceleration at a moment."""

    way: float
    speed: float
    pull: float


class Piece(NamedTuple):
    """Where a knot of the path lies: the part, and the number of its piece."""

    part: int
    piece: int


class LawRun:
    """A run from rest on.

    Args:
        axes: What the n axes can do.
        time: When it begins.
        caps: What bounds the speed along the run.

    Attributes:
        law: The way over the time.
        is_planned: Nobody has disturbed it yet.
        is_closed: It leads to a rest of the program: no stretches follow.
        fastest: No path speed is above it, mm/s.
        is_short: The law rests where nobody asks for it: it is to be found anew in time.
    """

    def __init__(self, axes: Axes, time: float, caps: Caps) -> None:
        self._axes, self._n, self._caps = axes, len(axes.jerk), caps
        self.fastest = hypot(*axes.speed)
        self.law = Law(time, 0.0)
        self._parts: list[Part] = []
        self._starts = [0.0]  # ways at which parts begin, and the last one ends
        self._planner = RunPlanner(axes, self._note)
        self.is_planned, self.is_closed, self.is_short = True, False, False

    # ---- the path ------------------------------------------------------------------------------------------

    def take(self, stretches: Stretches, *, closed: bool) -> None:
        """More of the run is known; it is over with that where it is closed."""
        self._planner.take(stretches, closed=closed)
        if closed:
            self._planner.finish()
            self.is_closed = True

    def forget(self, way: float, time: float) -> None:
        """Nobody will ask for what lies before a way and a time."""
        behind = bisect_right(self._starts, way - NEAR_MM) - 1
        if behind > 0:
            del self._parts[:behind], self._starts[:behind]
            self.law.forget(time)

    def _note(self, window: Window) -> None:
        """A part of the path is bent; as long as it is planned, with its law."""
        start = self._starts[-1]
        self._parts.append(window.part)
        self._starts.append(start + window.part.way[-1])
        if self.is_planned:
            self.law.run(self.end_time, start, _phases(window.phases))

    @property
    def known_way(self) -> float:
        """How far the path is known."""
        return self._starts[-1]

    @property
    def end_time(self) -> float:
        """When the law, as far as it is known, is over."""
        return self.law.end_time

    @property
    def end_way(self) -> float:
        """How far the law, as far as it is known, leads."""
        return self.law.end

    def place(self, way: float) -> list[float]:
        """Where the axes are at a way."""
        part, k = self._piece(way)
        path, n = self._parts[part], self._n
        t, h = way - self._starts[part] - path.way[k], path.way[k + 1] - path.way[k]
        found: list[float] = []
        for i in range(n):
            q = k * n + i
            third = (path.second[q + n] - path.second[q]) / h
            found.append(path.place[q] + t * (path.first[q] + t * (0.5 * path.second[q] + t * third / 6.0)))
        return found

    def _piece(self, way: float) -> Piece:
        """The piece on which a way lies."""
        part = min(max(bisect_right(self._starts, way) - 1, 0), len(self._parts) - 1)
        ways = self._parts[part].way
        k = bisect_right(ways, way - self._starts[part]) - 1
        return Piece(part, min(max(k, 0), len(ways) - 2))

    # ---- the law -------------------------------------------------------------------------------------------

    def take_up(self, time: float, state: State) -> None:
        """Before anything of the run is known: it begins in a motion, not at rest."""
        self._follow(time, state, (Phase(MOMENT_S, state.speed * MOMENT_S, state.speed, state.pull),))

    def lead_to(self, time: float, stop: float = inf, far: float = inf) -> bool:
        """Find the law anew from a time on, to rest at a way, or so far ahead at most; false where there is none.

        Where the axes are faster than they may be, they slow down as soon as they can.
        """
        state, goal = self._state(time), min(stop, far, self.known_way)
        if not (self._find(time, state, goal) or self._slow_down(time, state, goal)):
            return False
        self.is_short = self._is_short(goal, stop)
        return True

    def lead_farther(self, time: float, stop: float, far: float) -> None:
        """Let the law lead farther than where it rests without need, if one is found."""
        goal = min(stop, far, self.known_way)
        if goal > self.end_way + NEAR_MM and self._find(time, self._state(time), goal):
            self.is_short = self._is_short(goal, stop)

    def _is_short(self, goal: float, stop: float) -> bool:
        """Whether nobody asks for the rest at a way."""
        return goal < stop and not (self.is_closed and goal >= self.known_way)

    def brake(self, time: float) -> bool:
        """Come to rest as soon as the axes can, from a time on; false where the law stays as it is, and ends as soon.

        Where nobody asks for that rest, the law is short.
        """
        state = self._state(time)
        if state.speed <= STILL:
            self._follow(time, state, ())
            return True
        most = self.end_way - state.way - NEAR_MM
        return self._least(time, state, most, lambda way: self._to_rest(state, state.way + way, free=inf))

    def _slow_down(self, time: float, state: State, stop: float) -> bool:
        """Come down to the speed that is allowed as soon as the axes can, and go on; whether they can."""
        most, allowed2 = stop - state.way, self._caps(state.way, state.way, asked=True)

        def law_over(way: float) -> list[Phase] | None:
            return self._to_rest(state, stop, free=state.way + way)

        if state.speed * state.speed <= allowed2:
            return self._least(time, state, most, law_over)
        way = max(
            self._way_down(state, sqrt(allowed2)), AT_LEAST_S * state.speed
        )  # on less they would come below it
        for _ in range(TRIES):
            found = law_over(min(way, most))
            if found is not None:
                self._follow(time, state, found)
                return True
            way *= FARTHER
        return False

    def _way_down(self, state: State, speed: float) -> float:
        """The way on which the slowest axis alone would come down to a speed, its acceleration to nothing."""
        pull, jerk = min(self._axes.pull), min(self._axes.jerk)
        rise = state.pull / jerk
        high = state.speed + 0.5 * state.pull * rise
        change = max(high - speed, 0.0)
        seconds = change / pull + pull / jerk if change * jerk > pull * pull else 2.0 * sqrt(change / jerk)
        return max(0.5 * (high + speed) * seconds + rise * high, 0.0)

    def _least(
        self, time: float, state: State, most: float, law_over: Callable[[float], list[Phase] | None]
    ) -> bool:
        """Follow the law over the least way for which there is one, up to the longest; whether there is."""
        low, high, found = 0.0, min(self.way_to_rest(state.speed), most), None
        for _ in range(TRIES):
            found = law_over(high)
            if found is not None or high >= most:
                break
            low, high = high, min(FARTHER * high, most)
        if found is None:
            return False
        while high - low > EXACT * high:
            middle = 0.5 * (low + high)
            better = law_over(middle)
            low, high, found = (middle, high, found) if better is None else (low, middle, better)
        self._follow(time, state, found)
        return True

    def _follow(self, time: float, state: State, phases: Iterable[Phase]) -> None:
        """From a time on the law is another one."""
        self.is_planned, self.is_short = False, True
        self.law.run(time, state.way, phases)

    def way_to_rest(self, speed: float) -> float:
        """A way on which the axes can come to rest, mm: braking, and building up the acceleration for it."""
        slowest = min(self._axes.pull)
        return LONGER * speed * (0.5 * speed / slowest + slowest / min(self._axes.jerk))

    def _state(self, time: float) -> State:
        """The motion at a time."""
        law = self.law
        time = min(time, law.end_time)
        speed = law.speed(time)
        return State(law.at(time), speed, law.pull(time)) if speed > STILL else State(law.at(time), 0.0, 0.0)

    def _find(self, time: float, state: State, stop: float) -> bool:
        """Find a law from a motion to rest at a way, and follow it."""
        found = self._to_rest(state, stop)
        if found is not None:
            self._follow(time, state, found)
        return found is not None

    def _to_rest(self, state: State, stop: float, *, free: float = -inf) -> list[Phase] | None:
        """The law from a motion to rest at a way; up to the way `free` nothing bounds the speed but the axes."""
        way, speed, pull = state
        if stop - way <= NEAR_MM:
            return [] if speed <= STILL else None
        course = self._course(way, stop, free)
        cap2 = course.cap2
        if free > way:
            cap2[0] = max(cap2[0], speed * speed)
        if speed * speed > cap2[0] * (1.0 + 1e-9) or min(cap2) <= 0.0:
            return None
        found = quickest(course, self._axes, array("d", (speed, pull, 0.0, 0.0)))
        return None if found is None else list(_phases(found.phases))

    def _course(self, begin: float, end: float, free: float) -> Course:
        """The path between two ways, counted from the first; up to the way `free` with the caps of the axes alone."""
        n, ways = self._n, array("d")
        first, second, cap2, ease = array("d"), array("d"), array("d"), array("d")
        (part, k), last = self._piece(begin), self._piece(end)
        while True:
            path, start = self._parts[part], self._starts[part]
            low, high = max(start + path.way[k], begin), min(start + path.way[k + 1], end)
            if high - low > NEAR_MM or not ways:
                if not ways:
                    self._knot(path, k, low - start, ways, first, second, begin - start)
                most = min(_axes_cap2(path, k, n, self._axes), path.corner2[k])
                for a, b in pairwise(
                    (low, free, high) if low + NEAR_MM < free < high - NEAR_MM else (low, high)
                ):
                    self._knot(path, k, b - start, ways, first, second, begin - start)
                    cap2.append(min(most, self._caps(a, b, asked=0.5 * (a + b) > free)))
                    ease.append(path.ease[k])
            if (part, k) >= last:
                return course_of(ways, first, second, cap2, ease)
            k += 1
            if k == len(path.cap2):
                part, k = part + 1, 0

    def _knot(
        self,
        path: Part,
        k: int,
        at: float,
        ways: array[float],
        first: array[float],
        second: array[float],
        origin: float,
    ) -> None:
        """Add a knot at a way of piece k."""
        n, t, h = self._n, at - path.way[k], path.way[k + 1] - path.way[k]
        ways.append(at - origin)
        for i in range(n):
            q = k * n + i
            third = (path.second[q + n] - path.second[q]) / h
            first.append(path.first[q] + t * (path.second[q] + 0.5 * t * third))
            second.append(path.second[q] + t * third)


def _axes_cap2(path: Part, k: int, n: int, axes: Axes) -> float:
    """Largest square of the speed on a piece by the highest speeds of the axes: q' lies within its Bézier points."""
    half, least = 0.5 * (path.way[k + 1] - path.way[k]), inf
    for i in range(n):
        q = k * n + i
        most = max(abs(path.first[q]), abs(path.first[q + n]), abs(path.first[q] + half * path.second[q]))
        if most > 0.0:
            least = min(least, axes.speed[i] / most)
    return least * least


def _phases(records: array[float]) -> Iterable[Phase]:
    """The phases of a law as the kernels write them."""
    for at in range(0, len(records), Fields.SIZE):
        seconds, _, speed, pull, jerk = records[at : at + Fields.SIZE]
        if seconds > 0.0:
            way = seconds * (speed + seconds * (0.5 * pull + seconds * jerk / 6.0))
            yield Phase(seconds, way, speed, pull, jerk)
