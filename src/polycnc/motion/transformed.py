"""Under a transformation the axes that move are not those that the path is laid out in.

Polar and cylinder interpolation, tool centre point: the kernels know the limits of the columns of the toolpath. What
the real axes add is found at places along each row. With q(s) the real axes over the way s of the row, v the speed and
M their derivatives by the columns:

- `|q'|·v` stays within their velocity, `|q''|·v²` within a part of their acceleration; with limited jerk v³ times the
  third derivative and `3·|dM/ds|·a·v` within parts of their jerk, a being what the columns may accelerate: these bound
  the speed;
- `|M|·a` stays within the rest of their acceleration, `|M|·j` within the rest of their jerk, whatever the direction,
  for corners and averages too: the columns' limits a and j shrink by one factor, `ease`.

Where all this changes much along a row, it is cut into shares, the shorter the nearer they are to its worst place: the
point next to the centre of polar interpolation.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable
from math import atan2, cos, hypot, inf, pi, sin, sqrt
from typing import TYPE_CHECKING, Any, NamedTuple

from polycnc.motion.frames import carried, machine_of, real_of, work_of
from polycnc.motion.kernels.columns import ACCELERATION, JERK, SHARES
from polycnc.motion.limits import axis_limits, channel_axes, rotary_weight
from polycnc.motion.pace import Way, pace_of
from polycnc.motion.settings import SOFT
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.kinds import ARC_KINDS, CCW_KINDS
from polycnc.toolpath.table import CURVE_WIDTH

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.machine import Machine
    from polycnc.motion.settings import Settings
    from polycnc.toolpath.context import Transformation
    from polycnc.toolpath.table import Chunk

Path = Callable[[float], list[float]]
#: Part of the acceleration that is for the bend of the real axes' way; the rest is for changes of speed.
BEND = 0.5
#: Parts of the jerk: for the third derivative of the way; for bend and acceleration together.
TWIST, TURN = 0.2, 0.3
#: Derivatives are differences over so many mm or degrees: by the columns, along the path.
STEP, PATH_STEP = 1e-3, 5e-3
#: Derivatives by time are differences over so many seconds.
SHORT_S = 1e-4
#: Derivatives below this count as none.
NOTHING = 1e-9
#: Places at which a row is looked at first; a change of the demand by more than UNEVEN is worth shares.
LOOKS, UNEVEN = 4, 1.3
#: Shares become shorter by this factor towards the worst place, on both sides of it; steps of the search for it.
SHORTER, SEARCH = 0.4, 30
#: No share is shorter, mm.
SHORTEST = 1e-3
#: An axis along which an arc's unit normal has more than this does not take part in the arc.
ACROSS = 0.999
RAPIDS = (Kind.RAPID, Kind.REF)


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
    """

    shares: Shares
    feed: array[float]
    enters: dict[int, list[float]]

    def paced(self, feed: array[float], rows: slice = slice(None)) -> array[float]:
        """The feeds of some rows as the program's overrides and rules leave them."""
        if not self.feed:
            return feed
        return array("d", (value * factor for value, factor in zip(feed, self.feed[rows], strict=True)))


class Demand(NamedTuple):
    """What the real axes allow at a place.

    Attributes:
        top: Highest speed along the path by velocity and third derivative.
        bend: Part of an acceleration for each unit of v².
        pull: Part of an acceleration that the columns can ask for; `jerk` likewise.
        turn: Part of a jerk for each unit of speed, at what the columns can accelerate.
    """

    top: float
    bend: float
    pull: float
    jerk: float
    turn: float


class ArcPath(NamedTuple):
    """An arc: points by the share of its angle, length in its plane, lift along its normal, radius and unit normal."""

    path: Path
    planar: float
    lift: float
    radius: float
    normal: tuple[float, float, float]


class RealAxes:
    """Follows the real axes of a channel through the rows of a toolpath.

    Args:
        machine: The machine.
        channel: Number of the channel.
        names: Columns of the toolpath.
        settings: How the control leads the axes.
        start: Machine position before the first row.
    """

    def __init__(
        self,
        machine: Machine,
        channel: int,
        names: tuple[str, ...],
        settings: Settings,
        start: Sequence[float],
    ) -> None:
        self._machine, self._channel, self._names, self._settings = machine, channel, names, settings
        self._axes = channel_axes(machine, channel, names)
        self._geometry = machine.geometry_indices(channel)
        self._laid, self._context = list(start) or [0.0] * len(names), Context()
        self._limits: dict[Transformation | None, array[float]] = {}

    def limits(self, transformation: Transformation | None) -> array[float]:
        """The kernels' `limits` while a transformation acts."""
        if transformation not in self._limits:
            self._limits[transformation] = axis_limits(
                self._machine, self._channel, self._names, self._settings, transformation
            )
        return self._limits[transformation]

    def stand(self, laid: Sequence[float]) -> None:
        """The axes stand elsewhere, without a transformation."""
        self._laid, self._context = list(laid), Context()

    def bounds(self, chunk: Chunk, contexts: Sequence[Context]) -> Bounds:
        """Look at the rows of a chunk."""
        n, bounds = len(self._axes), Bounds(Shares(array("d"), array("d"), array("d")), array("d"), {})
        moves = [row for row in range(len(chunk)) if chunk.kind[row] < Kind.DWELL]
        used = [contexts[number] for number in set(chunk.context)]
        paced = any(context.pace is not None for context in used)
        transformed = any(context.transformation is not None for context in used)
        if self._context.transformation is None and not transformed and not paced:
            moves = moves[-1:]
        else:
            for column, free in zip(bounds.shares, (1.0, inf, 1.0), strict=True):
                column.extend([free] * SHARES * len(chunk))
            bounds.feed.extend([1.0] * len(chunk))
        for row in moves:
            context = contexts[chunk.context[row]]
            end = list(chunk.end[row * n : (row + 1) * n])
            if context.transformation is not self._context.transformation:
                self._laid = carried(self._laid, self._context, context, self._geometry)
                bounds.enters[row] = self._laid
            if context.transformation is not None and chunk.kind[row] != Kind.REF:
                start = work_of(self._laid, context, self._geometry)
                for k, share in enumerate(self._shares(chunk, row, start, end, context)):
                    for column, number in zip(bounds.shares, share, strict=True):
                        column[row * SHARES + k] = number
            goal = machine_of(end, context, self._geometry)
            if context.pace is not None:
                self._pace(chunk, row, goal, context, bounds)
            self._laid, self._context = goal, context
        return bounds

    def _pace(self, chunk: Chunk, row: int, goal: list[float], context: Context, bounds: Bounds) -> None:
        """What the program says about the speed of a row beside its feed is added to its bounds."""
        weight = rotary_weight(context, self._settings)
        weights = [weight if self._rotary(i) else 1.0 for i in range(len(goal))]
        way, limits = self._way_of(chunk, row, goal, context), self.limits(context.transformation)
        bounds.feed[row], top, ease = pace_of(context, way, weights, limits, rapid=chunk.kind[row] in RAPIDS)
        for k in range(row * SHARES, (row + 1) * SHARES):
            bounds.shares.top[k] = min(bounds.shares.top[k], top)
            bounds.shares.ease[k] *= ease

    def _way_of(self, chunk: Chunk, row: int, goal: list[float], context: Context) -> Way:
        """The way of a row in the columns' machine coordinates."""
        kind, at = chunk.kind[row], chunk.curve[row] * CURVE_WIDTH
        moved = [abs(b - a) for a, b in zip(self._laid, goal, strict=True)]
        if kind not in ARC_KINDS or at < 0:
            return Way(moved)
        curve, ccw = chunk.curves[at : at + CURVE_WIDTH], kind in (Kind.CCW, Kind.HELIX_CCW)
        start, end = (work_of(place, context, self._geometry) for place in (self._laid, goal))
        arc = _arc(start, end, curve, self._geometry, ccw=ccw)
        plane = []
        for i, part in zip(self._geometry, arc.normal, strict=True):
            if i >= 0 and abs(part) < ACROSS:
                plane.append(i)
            elif i >= 0:
                moved[i] = abs(part * arc.lift)
        return Way(moved, tuple(plane), arc.planar, arc.radius, ccw)

    def motion(self, moved: tuple[Any, Any, Any], context: Context) -> tuple[Any, Any, Any]:
        """Position, velocity and acceleration of the real axes, (k, axes), for those of the columns."""
        if context.transformation is None:
            return moved
        import numpy as np

        position, velocity, acceleration = moved
        nearby = [position + velocity * t + acceleration * (0.5 * t * t) for t in (-SHORT_S, 0.0, SHORT_S)]
        before, now, after = (
            np.array([real_of(place, context, self._geometry) for place in laid.tolist()]) for laid in nearby
        )
        turning = np.array([self._rotary(i) for i in range(len(self._axes))])
        came, goes = (
            np.where(turning, (way + 180.0) % 360.0 - 180.0, way) for way in (now - before, after - now)
        )
        return now, (came + goes) / (2.0 * SHORT_S), (goes - came) / SHORT_S**2

    def _shares(
        self, chunk: Chunk, row: int, start: list[float], end: list[float], context: Context
    ) -> list[tuple[float, float, float]]:
        """End, speed and `ease` of the shares of a row."""
        assert context.transformation is not None
        kind, at, made = chunk.kind[row], chunk.curve[row] * CURVE_WIDTH, context.transformation.geometry
        path: Path = lambda f: [a + (b - a) * f for a, b in zip(start, end, strict=True)]  # noqa: E731
        length = self._length(context, start, end)
        if kind in ARC_KINDS and at >= 0:
            curve = chunk.curves[at : at + CURVE_WIDTH]
            arc = _arc(start, end, curve, made, ccw=kind in CCW_KINDS)
            path, length = arc.path, hypot(arc.planar, arc.lift)
        if length == 0.0:
            return []
        looks = [self._demand(context, path, length, k / LOOKS, kind) for k in range(LOOKS + 1)]
        sizes = [max(look.pull, 1.0 / look.top) for look in looks]
        if kind in (Kind.SPLINE, Kind.THREAD, Kind.TAP) or max(sizes) < UNEVEN * min(sizes):
            return [(1.0, *self._within(looks))]
        worst = self._worst(context, path, sizes.index(max(sizes)) / LOOKS)
        middle = self._demand(context, path, length, worst, kind)
        shares, first, begin = [], looks[0], 0.0
        for f in _ends(worst, SHORTEST / length):
            last = self._demand(context, path, length, f, kind)
            inside = [first, last, self._demand(context, path, length, 0.5 * (begin + f), kind)]
            if begin <= worst <= f:
                inside.append(middle)
            shares.append((f, *self._within(inside)))
            first, begin = last, f
        return shares

    def _worst(self, context: Context, path: Path, around: float) -> float:
        """Where between two looks the columns ask most of the real axes."""
        low, high = max(around - 1.0 / LOOKS, 0.0), min(around + 1.0 / LOOKS, 1.0)
        for _ in range(SEARCH):
            a, b = low + (high - low) / 3.0, high - (high - low) / 3.0
            if self._pull(context, path(a)) < self._pull(context, path(b)):
                low = a
            else:
                high = b
        return 0.5 * (low + high)

    def _pull(self, context: Context, point: list[float]) -> float:
        columns = [j for j in context.transformation.geometry if j >= 0]  # type: ignore[union-attr]
        slopes = self._slopes(context, point, columns)
        shares = zip(slopes, self._axes, strict=True)
        return max(
            sum(map(abs, own)) / (axis.acceleration or inf) for own, axis in shares if axis is not None
        )

    def _length(self, context: Context, start: Sequence[float], end: Sequence[float]) -> float:
        """Length of a way, as the feed counts it."""
        assert context.transformation is not None
        made, weight = context.transformation.geometry, rotary_weight(context, self._settings)
        ways = [b - a for a, b in zip(start, end, strict=True)]
        turned = [weight if self._rotary(i) and i not in made else 1.0 for i in range(len(ways))]
        return hypot(*(way * w for way, w in zip(ways, turned, strict=True))) or hypot(*ways)

    def _demand(self, context: Context, path: Path, length: float, share: float, kind: int) -> Demand:
        """What the real axes allow at a place of a row."""
        assert context.transformation is not None
        soft, limits, n = self._is_soft(context), self.limits(context.transformation), len(self._axes)
        pulls, jerks = (limits[block * n : block * n + n] for block in (ACCELERATION, JERK))
        nearby = [path(share + (k - 1.5) * PATH_STEP / length) for k in range(4)]
        real = [context.transformation.real(point) for point in nearby]
        direction = [b - a for a, b in zip(nearby[1], nearby[2], strict=True)]
        columns = [j for j, way in enumerate(direction) if way != 0.0 or j in context.transformation.geometry]
        here, there = (self._slopes(context, point, columns) for point in nearby[1:3])
        top, bend, pull, jerk, turn = inf, 0.0, NOTHING, 0.0, 0.0
        for i, axis in enumerate(self._axes):
            if axis is None:
                continue
            ways = [self._way(i, real[k + 1][i] - real[k][i]) / PATH_STEP for k in range(3)]
            bends = [(ways[k + 1] - ways[k]) / PATH_STEP for k in range(2)]
            velocity, fastest = (axis.rapid if kind == Kind.RAPID else axis.max_feed), max(map(abs, ways))
            if velocity and fastest > 0.0:
                top = min(top, velocity / fastest)
            if axis.acceleration:
                bend = max(bend, max(map(abs, bends)) / axis.acceleration)
                pull = max(pull, _sum(here[i], pulls, columns) / axis.acceleration)
            if soft and axis.jerk:
                twist = abs(bends[1] - bends[0]) / PATH_STEP
                top = min(top, (TWIST * axis.jerk / twist) ** (1.0 / 3.0)) if twist > NOTHING else top
                jerk = max(jerk, _sum(here[i], jerks, columns) / axis.jerk)
                change = [abs(b - a) / PATH_STEP for a, b in zip(here[i], there[i], strict=True)]
                turn = max(turn, _sum(change, pulls, columns) / axis.jerk)
        return Demand(top, bend, pull, jerk, turn)

    def _within(self, demands: list[Demand]) -> tuple[float, float]:
        """Speed and `ease` that meet all of some demands."""
        worst = Demand(
            min(d.top for d in demands), *(max(values) for values in list(zip(*demands, strict=True))[1:])
        )
        top = worst.top
        if worst.bend > NOTHING:
            top = min(top, sqrt(BEND / worst.bend))
        ease = min(1.0, (1.0 - (worst.bend * top * top if top < inf else 0.0)) / worst.pull)
        if worst.jerk > 0.0:
            ease = min(ease, (1.0 - TWIST - TURN if worst.turn > NOTHING else 1.0) / worst.jerk)
        if worst.turn > NOTHING:
            top = min(top, TURN / (3.0 * ease * worst.turn))
        return top, ease

    def _slopes(self, context: Context, point: list[float], columns: list[int]) -> list[list[float]]:
        """Derivatives of every real axis by some columns."""
        assert context.transformation is not None
        real = context.transformation.real(point)
        slopes: list[list[float]] = [[] for _ in real]
        for j in columns:
            beside = context.transformation.real([*point[:j], point[j] + STEP, *point[j + 1 :]])
            for i, (a, b) in enumerate(zip(real, beside, strict=True)):
                slopes[i].append(self._way(i, b - a) / STEP)
        return slopes

    def _is_soft(self, context: Context) -> bool:
        return (context.acceleration or self._settings.acceleration) == SOFT

    def _rotary(self, column: int) -> bool:
        axis = self._axes[column]
        return axis is not None and axis.rotary

    def _way(self, column: int, way: float) -> float:
        """The shorter way round of a rotary axis."""
        return (way + 180.0) % 360.0 - 180.0 if self._rotary(column) else way


def _ends(worst: float, shortest: float) -> list[float]:
    """Where shares end that become shorter towards a place, none shorter than that."""
    before = {worst - worst * SHORTER**k for k in range(1, SHARES // 2)}
    behind = {worst + (1.0 - worst) * SHORTER**k for k in range(1, SHARES // 2)}
    ends = [0.0]
    for f in sorted(before | behind):
        if ends[-1] + shortest < f < 1.0 - shortest:
            ends.append(f)
    return [*ends[1:], 1.0]


def _sum(slopes: list[float], limits: Sequence[float], columns: list[int]) -> float:
    """How much of an axis the columns can ask for together."""
    return sum(abs(slope) * limits[j] for slope, j in zip(slopes, columns, strict=True))


def _arc(
    start: list[float], end: list[float], curve: Sequence[float], geometry: tuple[int, int, int], *, ccw: bool
) -> ArcPath:
    """An arc; `curve` is its centre, its normal, and further turns."""
    place = [start[i] - c if i >= 0 else 0.0 for i, c in zip(geometry, curve[:3], strict=True)]
    goal = [end[i] - c if i >= 0 else 0.0 for i, c in zip(geometry, curve[:3], strict=True)]
    size = hypot(*curve[3:6]) or 1.0
    nx, ny, nz = (value / size for value in curve[3:6])
    x, y, z = place
    along = x * nx + y * ny + z * nz
    out = [x - along * nx, y - along * ny, z - along * nz]
    sense = 1.0 if ccw else -1.0
    forth = [
        sense * (ny * out[2] - nz * out[1]),
        sense * (nz * out[0] - nx * out[2]),
        sense * (nx * out[1] - ny * out[0]),
    ]
    angle = atan2(_dot(goal, forth), _dot(goal, out)) % (2.0 * pi)
    angle = (angle if angle > 1e-9 else 2.0 * pi) + 2.0 * pi * curve[6]
    rise = [b - a for a, b in zip(place, goal, strict=True)]
    lift = _dot(rise, [nx, ny, nz])

    def path(f: float) -> list[float]:
        point = [a + (b - a) * f for a, b in zip(start, end, strict=True)]
        c, s = cos(f * angle) - 1.0, sin(f * angle)
        for j, i in enumerate(geometry):
            if i >= 0:
                point[i] = start[i] + c * out[j] + s * forth[j] + f * lift * (nx, ny, nz)[j]
        return point

    radius = hypot(*out)
    return ArcPath(path, angle * radius, lift, radius, (nx, ny, nz))


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))
