"""The laws of windows of a run, one behind the other: each from the motion in which the one before is left."""

from __future__ import annotations

from array import array
from bisect import bisect_left, bisect_right
from collections import deque
from math import ceil, inf

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.third_order.compiled import kernels as bending
from polycnc.motion.third_order.laws.compiled import kernels
from polycnc.motion.third_order.laws.courses import Known, Phase
from polycnc.motion.third_order.laws.phases import PAIR
from polycnc.motion.third_order.laws.quickest import NONE, NoLawError, Room, course_of, numbers, quickest

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from polycnc.motion.third_order.laws.courses import Axes, Course
    from polycnc.motion.third_order.laws.quickest import Found
    from polycnc.motion.third_order.parts import Part

#: How far a law looks beyond its window: so many times the time in which an axis builds its acceleration up, and that
#: in which it comes to rest.
BUILDS, STOPS = 10.0, 2.0
#: Nodes behind the first one at which the next law is tried to begin where it cannot there; then the rest.
LATER = (0, 8, 24, 56, 120)
#: So little of a piece is none.
SLIVER = 1e-9
#: Part of the nodes beyond a window that the next law takes over.
TAKEN = 0.5


class Window(NamedTuple):
    """A window of a run.

    Attributes:
        part: Its path.
        phases: Its law, `Phase` by `Phase`, ways counted from its start as those of the path. At rests there are ones
            that last no time.
        stops: Whether the axes rest at its end.
    """

    part: Part
    phases: array[float]
    stops: bool


class _Law(NamedTuple):
    """A law as found: the way at which the window to come begins, its length, whether it ends with the leg."""

    found: Found
    origin: float
    length: float
    final: bool

    def beyond(self) -> int:
        """The first node behind the origin."""
        return bisect_left(self.found.nodes.way, self.origin)


class _Start(NamedTuple):
    """Where and how a law can begin: the way in the window, speed and acceleration, phases up to there, nodes."""

    way: float
    state: tuple[float, float]
    begun: array[float]
    known: Known


class Windows:
    """Parts of a path become windows; a leg is what lies between two rests.

    Args:
        axes: Limits.
        take: Gets the windows.
        room: In which their laws are found, one after another.
        speed: Of the motion in which the first leg begins.
    """

    def __init__(self, axes: Axes, take: Callable[[Window], object], room: Room, speed: float = 0.0) -> None:
        self._axes, self._take = axes, take
        self._parts: deque[Part] = deque()
        self._first = (speed, 0.0)
        self._law: _Law | None = None
        self._room = room
        self._end: float | None = None
        build = max(pull / jerk for pull, jerk in zip(axes.pull, axes.jerk, strict=True))
        stop = max(speed / pull for speed, pull in zip(axes.speed, axes.pull, strict=True))
        self._ahead = BUILDS * build + STOPS * stop
        self.detours = 0

    def add(self, part: Part, end: float | None = None) -> None:
        """The next part of the leg; the last one with the steady speed at its end, 0 at rest.

        Raises:
            NoLawError: From the motion in which the leg begins, or to that in which it ends, there is no law.
        """
        self._parts.append(part)
        self._end = end
        while self._parts:
            if self._law is not None and self._law.final:
                self._keep_on(self._law)
            elif (ahead := self._look_ahead()) is not None:
                self._find(*ahead)
            else:
                break
        if end is not None:
            self._end, self._law, self._first = None, None, (0.0, 0.0)

    def _look_ahead(self) -> tuple[_Joined, bool] | None:
        """The path of the law to come, and whether it ends with the leg; nothing as long as it is not known."""
        left, told, reached = self._ahead, numbers(1), [self._parts[0]]
        for part in list(self._parts)[1:]:
            reached.append(part)
            course = course_of(part.way, part.first, part.second, part.cap2, part.ease)
            count = kernels().look_ahead(course, self._axes, numbers(4), left, told)
            if count > 0 and (count < len(part.cap2) or self._end is None):
                return _Joined(reached, count), False
            left = told[0]
        return None if self._end is None else (_Joined(reached, len(reached[-1].cap2)), True)

    def _find(self, path: _Joined, final: bool) -> None:
        """Find the law of the first part, and give its window."""
        for number, start in enumerate(self._starts()):
            if start.way >= self._parts[0].way[-1]:
                break
            self.detours += number == 1
            if self._begin(path, start, final) or (
                not path.is_whole and self._begin(path.whole(), start, final)
            ):
                return
        law = self._law
        if law is None or law.length - law.origin < self._parts[0].way[-1]:
            msg = "no law within the limits from or to this motion"
            raise NoLawError(msg)
        self._keep_on(law)

    def _starts(self) -> Iterator[_Start]:
        """Where the next law can begin: at nodes of the one before, and where that rests."""
        law = self._law
        if law is None:
            yield _Start(0.0, self._first, array("d"), NONE)
            return
        (phases, nodes), beyond = law.found, law.beyond()
        count = len(nodes.way)
        taken = beyond + ceil(TAKEN * (count - beyond))
        for later in LATER:
            k = beyond + later
            if k + 2 < taken:
                way, at = nodes.way[k], PAIR * k * Phase.SIZE
                known = Known(*(values[k:taken] for values in nodes))
                bending().shift_ways(nodes.way, k, taken - k, way, known.way, 0)
                state = phases[at + Phase.SPEED], phases[at + Phase.PULL]
                near = phases[PAIR * max(beyond - 1, 0) * Phase.SIZE : PAIR * (k + 1) * Phase.SIZE]
                yield _Start(way - law.origin, state, _cut(near, law.origin, way, law.origin), known)
        begun = _cut(phases, law.origin, inf, law.origin)
        yield _Start(law.length - law.origin, (0.0, 0.0), begun, NONE)

    def _begin(self, path: _Joined, start: _Start, final: bool) -> bool:
        """Find a law from a place on; gives whether there is one."""
        end = self._end if final and self._end is not None else 0.0
        course = path.course(start.way)
        found = quickest(course, self._axes, array("d", (*start.state, end, 0.0)), start.known, self._room)
        if found is None:
            return False
        length, last = self._parts[0].way[-1] - start.way, final and len(self._parts) == 1
        window = found.phases
        if not last or start.way > 0.0:
            window = _cut(window, 0.0, inf if last else length, -start.way, start.begun)
        self._law = _Law(found, length, course.way[-1], final)
        self._give(window, last)
        return True

    def _keep_on(self, law: _Law) -> None:
        """Give the window of the first part by a law that leads beyond it."""
        end, last = law.origin + self._parts[0].way[-1], law.final and len(self._parts) == 1
        kept = _cut(law.found.phases, law.origin, inf if last else end, law.origin)
        self._law = law._replace(origin=end)
        self._give(kept, last)

    def _give(self, phases: array[float], last: bool) -> None:
        part = self._parts.popleft()
        self._take(Window(part, phases, last and self._end == 0.0))


class _Joined:
    """The path of some parts behind one another, up to a piece of the last one: there the law shall lead."""

    def __init__(self, parts: list[Part], last: int) -> None:
        self._parts, self._last = parts, last

    @property
    def is_whole(self) -> bool:
        """Whether that piece is the last one."""
        return self._last == len(self._parts[-1].cap2)

    def whole(self) -> _Joined:
        """The same up to the end of the last part."""
        return _Joined(self._parts, len(self._parts[-1].cap2))

    def course(self, start: float) -> Course:
        """The path from a way on, its ways counted from there."""
        first, *others = self._parts
        if start == 0.0 and not others and self.is_whole:  # its arrays but for the one that the law changes
            return course_of(first.way, first.first, first.second, first.cap2[:], first.ease)
        n, way = len(first.first) // len(first.way), array("d", first.way)
        p = bisect_right(way, start) - 1
        if way[p + 1] - start < SLIVER * (way[p + 1] - way[p]):
            p, start = p + 1, way[p + 1]
        q, second, cap2, ease = first.first[p * n :], first.second[p * n :], first.cap2[p:], first.ease[p:]
        for part in others:
            count, at, offset = len(part.cap2) if part is not others[-1] else self._last, len(way), way[-1]
            way.extend(numbers(count))
            bending().shift_ways(part.way, 1, count, -offset, way, at)
            q.extend(part.first[n : (count + 1) * n])
            second.extend(part.second[n : (count + 1) * n])
            cap2.extend(part.cap2[:count])
            ease.extend(part.ease[:count])
        t, step = start - way[p], way[p + 1] - way[p]
        bending().shift_ways(way, p, len(way) - p, start, way, 0)
        del way[len(way) - p :]
        way[0] = 0.0
        for i in range(n if t > 0.0 else 0):
            third = (second[n + i] - second[i]) / step
            q[i] += t * (second[i] + 0.5 * t * third)
            second[i] += t * third
        return course_of(way, q, second, cap2, ease)


def _cut(
    phases: array[float], begin: float, end: float, origin: float, before: array[float] | None = None
) -> array[float]:
    """The phases between two ways, counted from `origin`, behind others that come before."""
    known = len(before) if before else 0
    out = numbers(known + len(phases))
    if before:
        out[:known] = before
    count = kernels().cut_law(phases, begin, end, origin, out, known // Phase.SIZE)
    del out[count * Phase.SIZE :]
    return out
