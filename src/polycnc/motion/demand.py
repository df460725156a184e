"""What the real axes behind the path allow at a place of a row.

`transformed` looks at places of rows one by one, by differences; rows of a tool's tip that ask for much the same all
along are bounded many at once by a kernel (`kernels/demands.py`), whose parts hold here too.
"""

from __future__ import annotations

from array import array
from math import ceil, cos, hypot, inf, pi, radians

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.compiled import share_rows
from polycnc.motion.kernels import demands as kernels
from polycnc.motion.kernels.columns import AT_END, AT_START
from polycnc.motion.kernels.demands import LOOK_DEG, LOOKS, MOST_LOOKS, NOTHING, TWIST, UNEVEN
from polycnc.transformation.orientation.linkage import room_for

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.motion.kernels.columns import Limits
    from polycnc.motion.pace import AxisLimits
    from polycnc.motion.pole import PathLeg
    from polycnc.toolpath.row_path import Path
    from polycnc.transformation.contract import Transformation

__all__ = [
    "FULL", "LOOKS", "PATH_STEP", "UNEVEN", "Bounds", "Corner", "Demand", "RowShares", "Shares", "Way", "between",
    "bound_tip", "crest", "even_row", "farthest", "looks_along", "share_ends", "within",
]  # fmt: skip

#: Derivatives along the path are differences over so many mm or degrees at most.
PATH_STEP = 5e-3
#: The turn of a full circle; rows are looked at after so much of it at most, radians.
FULL, LOOK = 2.0 * pi, radians(LOOK_DEG)
#: A corner reaches as far along a row as there is so much left of what there is at the row's end; looks.
KEPT, FAR_LOOKS = 0.8, 4
#: Steps of the search for the worst place of a row.
SEARCH = 40
#: Looks between which an axis is faster by no more than this part are near enough to each other.
SAME_SPEED = 1e-4
#: Shares become shorter by this factor towards the worst place, or by a smaller one.
SHORTER = 0.5


class Shares(NamedTuple):
    """SHARES numbers of each row, as `Rows` of the kernels has them; empty where no transformation acts."""

    end: array[float]
    top: array[float]
    ease: array[float]


class Bounds(NamedTuple):
    """What the kernels must know of the rows of a chunk.

    Attributes:
        shares: Bounds along the rows.
        feed: Factor on the feed of every row; empty where all are 1.
        enters: Rows at which the columns get another meaning, with the position of the path there: the axes stand.
        legs: Rows that lead through the pole, or begin or end there: they are laid as these legs instead.
        placed: Position of the path from a row on, by its place in the chunk, where events say where real axes are.
    """

    shares: Shares
    feed: array[float]
    enters: dict[int, list[float]]
    legs: dict[int, list[PathLeg]]
    placed: dict[int, list[float]]

    def paced(self, feed: array[float], rows: slice = slice(None)) -> array[float]:
        """The feeds of some rows as the program's overrides and rules leave them."""
        if not self.feed:
            return feed
        return array("d", (value * factor for value, factor in zip(feed, self.feed[rows], strict=True)))


class Corner(NamedTuple):
    """What a row leaves a corner at its start or its end: an `ease`, and how much of the row it holds for.

    Without limited jerk no more of the row is bent for the corner.
    """

    ease: float = 1.0
    reach: float = 1.0


class RowShares(NamedTuple):
    """The shares of one row: end, speed and `ease` of each, and what holds at its corners."""

    shares: list[tuple[float, float, float]]
    at_start: Corner
    at_end: Corner

    def eased(self, reserve: float) -> RowShares:
        """The same where the columns can accelerate so much more than their limits say; at corners they do not."""
        if reserve == 1.0:
            return self
        shares = [(end, top, reserve * ease) for end, top, ease in self.shares]
        ends = (own._replace(ease=min(reserve * own.ease, 1.0)) for own in (self.at_start, self.at_end))
        return RowShares(shares, *ends)

    def write(self, columns: Shares, first: int, top: float = inf) -> None:
        """Write them behind number `first` of the columns, with no speed above `top`."""
        for at, (end, most, ease) in enumerate(self.shares, first):
            columns.end[at], columns.top[at], columns.ease[at] = end, min(most, top), ease
        for at, corner in ((AT_START, self.at_start), (AT_END, self.at_end)):
            columns.ease[first + at], columns.end[first + at] = corner


class Demand(NamedTuple):
    """What the real axes allow at a place.

    Attributes:
        top: Highest speed along the path by velocity and third derivative.
        bend: Part of an acceleration for each unit of v².
        pull: Part of an acceleration that the columns can ask for; `jerk` likewise.
        turn: Part of a jerk for each unit of speed, at what the columns can accelerate.
        along: What they can accelerate along the path.
    """

    top: float
    bend: float
    pull: float
    jerk: float
    turn: float
    along: float


class Way(NamedTuple):
    """A row under a transformation, with what bounds it.

    Attributes:
        made: The transformation.
        path: The row's points.
        length: Its length, mm.
        axes: What the machine's axes may do, by their columns.
        turning: Which axes are rotary.
        pulls: What the columns can accelerate; `jerks` likewise.
        soft: The jerk is limited.
    """

    made: Transformation
    path: Path
    length: float
    axes: Sequence[tuple[int, AxisLimits]]
    turning: Sequence[bool]
    pulls: Sequence[float]
    jerks: Sequence[float]
    soft: bool

    def demand(self, share: float, step: float = PATH_STEP, *, lateral: bool = True) -> Demand:
        """What the real axes allow at a place of the row; `lateral`: the columns may accelerate in any direction."""
        pulls, jerks, length = self.pulls, self.jerks, self.length
        step, inside = min(step, PATH_STEP), 4.0 * step < length
        middle = min(max(share, 1.5 * step / length), 1.0 - 1.5 * step / length) if inside else share
        nearby = [self.path(middle + (k - 1.5) * step / length) for k in range(4)]
        real = [self.made.to_machine(point) for point in nearby]
        direction = [(b - a) / step for a, b in zip(nearby[1], nearby[2], strict=True)]
        along = [
            min((limit / abs(u) for limit, u in zip(of, direction, strict=True) if u), default=0.0)
            for of in (pulls, jerks)
        ]
        columns = [j for j, way in enumerate(direction) if way != 0.0 or j in self.made.geometry]
        here, there = (self._slopes(point, columns) if lateral else [] for point in nearby[1:3])
        top, bend, pull, jerk, turn = inf, 0.0, NOTHING, 0.0, 0.0
        for i, axis in self.axes:
            ways = [self._shorter(i, real[k + 1][i] - real[k][i]) / step for k in range(3)]
            bends = [(ways[k + 1] - ways[k]) / step for k in range(2)]
            fastest, steepest = max(map(abs, ways)), max(map(abs, bends))
            if axis.velocity and fastest > 0.0:
                top = min(top, axis.velocity / fastest)
            if axis.acceleration:
                bend = max(bend, steepest / axis.acceleration)
                asked = asked_of(here[i], pulls, columns) if lateral else fastest * along[0]
                pull = max(pull, asked / axis.acceleration)
            if self.soft and axis.jerk:
                twist = abs(bends[1] - bends[0]) / step
                top = min(top, (TWIST * axis.jerk / twist) ** (1.0 / 3.0)) if twist > NOTHING else top
                asked = asked_of(here[i], jerks, columns) if lateral else fastest * along[1]
                jerk = max(jerk, asked / axis.jerk)
                change = steepest * along[0]
                if lateral:
                    changes = [abs(b - a) / step for a, b in zip(here[i], there[i], strict=True)]
                    change = asked_of(changes, pulls, columns)
                turn = max(turn, change / axis.jerk)
        return Demand(top, bend, pull, jerk, turn, along[0])

    def worst(self, around: float) -> float:
        """Where between two looks the columns ask most of the real axes."""
        low, high = max(around - 1.0 / LOOKS, 0.0), min(around + 1.0 / LOOKS, 1.0)
        for _ in range(SEARCH):
            a, b = low + (high - low) / 3.0, high - (high - low) / 3.0
            if self._pull(a) < self._pull(b):
                low = a
            else:
                high = b
        return 0.5 * (low + high)

    def extent(self, worst: float) -> float:
        """How far around its worst place the row asks for at least half as much."""
        most, extent = self._pull(worst), 1.0 / LOOKS
        sides = [side for side in (-1.0, 1.0) if 0.0 <= worst + side * extent <= 1.0]
        for _ in range(SEARCH):
            if max(self._pull(worst + side * extent) for side in sides) > 0.5 * most:
                break
            extent *= 0.5
        return extent

    def _pull(self, share: float) -> float:
        columns = [j for j in self.made.geometry if j >= 0]
        slopes = self._slopes(self.path(share), columns)
        # Counted alike in all directions, it is most where the path is nearest to the centre of polar interpolation.
        return max(hypot(*slopes[i]) / (axis.acceleration or inf) for i, axis in self.axes)

    def _slopes(self, point: list[float], columns: list[int]) -> list[list[float]]:
        """Derivatives of every real axis by some columns."""
        return [[row[j] for j in columns] for row in self.made.jacobian(point)]

    def _shorter(self, i: int, way: float) -> float:
        """The shorter way round of a rotary axis."""
        return (way + 180.0) % 360.0 - 180.0 if self.turning[i] else way


def looks_along(angle: float, least: int = LOOKS) -> int:
    """In how many parts a row is looked at that turns by an angle, radians."""
    return max(least, ceil(min(angle / LOOK, MOST_LOOKS)))


def between(demand: Demand, angle: float) -> Demand:
    """The most that is asked on both sides of a place, half an angle far: as the path turns, so does what is asked."""
    nearer = cos(0.5 * min(angle, LOOK))
    bend, pull, jerk, turn = (value / nearer for value in demand[1:5])
    return Demand(demand.top * nearer, bend, pull, jerk, turn, demand.along)


def crest(looks: Sequence[Demand]) -> list[float]:
    """Where between even looks along a row its axes are fastest, if they are faster there than at a look.

    That is the top of a parabola through the fastest look and those beside it.
    """
    speeds = [1.0 / look.top for look in looks]
    at, last = speeds.index(max(speeds)), len(speeds) - 1
    middle = min(max(at, 1), last - 1)
    before, here, behind = speeds[middle - 1 : middle + 2]
    slope, bow = 0.5 * (behind - before), before - 2.0 * here + behind
    if bow >= 0.0 or here - 0.5 * slope * slope / bow <= (1.0 + SAME_SPEED) * speeds[at]:
        return []
    place = middle - slope / bow
    return [place / last] if 0.0 < place < last else []


def within(demands: list[Demand], length: float) -> tuple[float, float]:
    """Speed and `ease` that meet all of some demands along a length."""
    _, bend, pull, jerk, turn, along = (max(values) for values in zip(*demands, strict=True))
    top = min(each.top for each in demands)
    return kernels.within(top, bend, pull, jerk, turn, length, along)


def even_row(top: float, ease: float) -> RowShares:
    """A row of one share, with one speed and one factor all along and at both corners."""
    return RowShares([(1.0, top, ease)], Corner(ease), Corner(ease))


def farthest(beside: Callable[[list[float]], tuple[float, float]], near: Corner) -> Corner:
    """What holds at a corner as far along a row as little changes, up to half of it; `near` is what holds next to it.

    `beside` gives speed and `ease` for places of the row, by how far they are from the corner.
    """
    reach = 0.5
    while reach > near.reach:
        _, ease = beside([reach * k / FAR_LOOKS for k in range(1, FAR_LOOKS + 1)])
        if ease >= KEPT * near.ease:
            return Corner(min(ease, near.ease), reach)
        reach *= 0.5
    return near


def bound_tip(
    kinds: array[int],
    ends: array[float],
    rows: tuple[int, int],
    start: Sequence[float],
    weight: float,
    limits: Limits,
    shares: tuple[array[float], array[float]],
    *,
    soft: bool,
) -> bytes:
    """Set speed and `ease` of the straight rows of a tip along which the demand hardly changes; 1 for each that is set.

    Args:
        kinds: Of the rows of a chunk.
        ends: Where they lead, work coordinates.
        rows: The first of them, and the one behind the last: all of one context.
        start: Where the first one begins, work coordinates.
        weight: Millimetres that a degree counts in the length of a row.
        limits: The machine, with how its axes follow the tip.
        shares: Speeds and factors of the shares of all rows.
        soft: The jerk is limited.
    """
    n, done = len(start), array("B", bytes(len(kinds)))
    room, unit = array("d", bytes(8 * room_for(n))), array("d", bytes(8 * n))
    share_rows()(
        kinds, ends, *rows, array("d", start), weight, int(soft), limits.linkage, limits, room, unit,
        *shares, done,
    )  # fmt: skip
    return done.tobytes()


def share_ends(worst: float, extent: float) -> list[float]:
    """Where shares end that become shorter towards a place, down to its extent."""
    ends, most = {1.0}, AT_START // 2 - 1
    for span in (-worst, 1.0 - worst):
        if abs(span) > extent:
            shorter = min(SHORTER, (extent / abs(span)) ** (1.0 / most))
            parts = [span * shorter**k for k in range(1, most + 1)]
            ends.update(worst + part for part in parts if abs(part) >= 0.99 * extent)
    return sorted(ends)


def asked_of(slopes: list[float], limits: Sequence[float], columns: list[int]) -> float:
    """How much of an axis the columns can ask for together."""
    total = 0.0
    for slope, j in zip(slopes, columns, strict=True):
        total += abs(slope) * limits[j]
    return total
