"""Under a transformation the axes that move are not those that the path is laid out in.

Polar and cylinder interpolation, tool centre point: the kernels know the limits of the columns of the toolpath. What
the real axes add is found at places along each row. With q(s) the real axes over the way s of the row, v the speed and
M their derivatives by the columns:

- `|q'|·v` stays within their velocity, `|q''|·v²` within a part of their acceleration; with limited jerk v³ times the
  third derivative and `3·|dM/ds|·a·v` within parts of their jerk, a being what the columns may accelerate: these bound
  the speed;
- `|M·d|·a` stays within the rest of their acceleration, `|M·d|·j` within the rest of their jerk, d being the direction
  of the path: the columns' acceleration along it shrinks by one factor, `ease`;
- at corners, and as far as their averages reach, it is `|M|·a` and `|M|·j`, whatever the direction: the columns' limits
  shrink there by a factor of their own.

Where all this changes much along a row, it is cut into shares, the shorter the nearer they are to its worst place: the
point next to the centre of polar interpolation.
"""

from __future__ import annotations

from array import array
from math import hypot, inf, radians
from operator import sub

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.demand import (
    FULL,
    PATH_STEP,
    UNEVEN,
    Bounds,
    Corner,
    Demand,
    RowShares,
    Shares,
    Way,
    between,
    bound_tip,
    crest,
    even_row,
    farthest,
    looks_along,
    share_ends,
    within,
)  # fmt: skip
from polycnc.motion.frames import (
    carried,
    led_ends,
    led_to,
    machine_of,
    path_of,
    real_of,
    real_rows,
    with_axis,
    work_of,
)
from polycnc.motion.kernels.columns import AT_END, AT_START, SHARES, Limits, Rows
from polycnc.motion.limits import (
    NO_LINKAGE,
    averages,
    axis_limits,
    channel_axes,
    is_bent_by_way,
    is_led,
    rotary_weight,
)
from polycnc.motion.pace import Travel, axis_limits_of, following_top, pace_of, reserve
from polycnc.motion.pole import (
    RING_MM,
    PathLeg,
    Turn,
    kink_legs,
    legs_of,
    runs_in_legs,
    slope_steps,
    turn_records,
)
from polycnc.motion.reach import looked_at, shares_of
from polycnc.motion.standing.positioning import placed_by_events
from polycnc.motion.time_constants import Use, cut_use
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.kinds import ARC_KINDS, CCW_KINDS, CURVE_WIDTH, RAPID_KINDS
from polycnc.toolpath.modes import AccelerationMode, FeedMode
from polycnc.toolpath.row_path import arc_path, line_path
from polycnc.transformation.orientation.linkage import STANDS_MM
from polycnc.transformation.pole import is_at

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.machine import Machine
    from polycnc.motion.pace import AxisLimits
    from polycnc.motion.sampling.run import Moved
    from polycnc.motion.settings import Settings
    from polycnc.toolpath.row_path import Path
    from polycnc.toolpath.table import Chunk
    from polycnc.transformation.contract import Geometry, Transformation

#: Kinds of rows in which no axis moves.
_STANDING = bytes((Kind.DWELL, Kind.EVENT))
#: Derivatives by time are differences over so many seconds.
SHORT_S = 1e-4
#: Parts of the share around the worst place that are looked at.
WITHIN = 8
#: Part of the share next to a corner that the corner may reach; no share of a way to the pole is much shorter, mm.
CORNER_REACH, NEAR_POLE = 0.5, 0.05
#: A share that bounds nothing.
FREE_SHARE = (1.0, inf, 1.0)
#: Kinds of rows that are cut at the pole.
LEGGED = frozenset((Kind.RAPID, Kind.FEED, *ARC_KINDS))
#: Nothing within a leg lets the axes stand.
NO_STOPS = array("B")
#: Kinds of rows that kernels lay out under a tip without being told more, and those that do not move.
LED_ALONE = frozenset((Kind.RAPID, Kind.FEED, Kind.REF, Kind.DWELL, Kind.EVENT))
#: From kinds to whether a row is such.
LED_KINDS = bytes(kind in LED_ALONE for kind in range(256))
#: An axis along which an arc's unit normal has more than this does not take part in the arc.
ACROSS = 0.999


def _last_move(chunk: Chunk) -> list[int]:
    """The last row in which axes move; nothing where none do."""
    behind = len(chunk.kind.tobytes().rstrip(_STANDING))
    return [behind - 1] if behind else []


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
        self._on_path, self._context = list(start) or [0.0] * len(names), Context()
        self._limits: dict[tuple[Geometry | None, Use], Limits] = {}
        self._linked: tuple[Transformation, Use, Limits] | None = None
        self._turning = [axis is not None and axis.rotary for axis in self._axes]
        self._turned = [column for column, turns in enumerate(self._turning) if turns]
        self._left: tuple[Context, bool, list[tuple[int, AxisLimits]]] | None = None
        self._placed: list[tuple[int, dict[int, float]]] = []
        #: The last row's context and where it led, as the row says it.
        self._behind: tuple[Context, list[float]] | None = None

    def limits(self, context: Context | None, use: Use = Use.CUT) -> Limits:
        """The kernels' `limits` of rows of a use; under a transformation of a context there are no uses but of cuts."""
        transformation = context.transformation if context is not None else None
        if context is not None and transformation is not None:
            use = cut_use(context, self._settings)
        if self._linked is not None and transformation is self._linked[0] and use is self._linked[1]:
            return self._linked[2]
        key = (None if transformation is None else transformation.geometry, use)
        linkage = NO_LINKAGE
        if transformation is not None and None not in self._axes:
            from polycnc.transformation.orientation.linked import linkage_of  # where a transformation acts

            linkage = linkage_of(transformation)
        if not linkage and key in self._limits:
            return self._limits[key]
        made, own = key
        found = axis_limits(self._machine, self._channel, self._names, self._settings, made, own, linkage)
        if linkage and transformation is not None:
            self._linked = transformation, use, found
        else:
            self._limits[key] = found
        return found

    def stand(self, on_path: Sequence[float]) -> None:
        """The axes stand elsewhere, without a transformation."""
        self._on_path, self._context, self._behind = list(on_path), Context(), None

    def go_on_from(self, on_path: Sequence[float]) -> None:
        """The path goes on from a position."""
        self._on_path, self._behind = list(on_path), None

    def bounds(self, chunk: Chunk, contexts: Sequence[Context]) -> Bounds:
        """Look at the rows of a chunk."""
        bounds = Bounds(Shares(array("d"), array("d"), array("d")), array("d"), {}, {}, {})
        self._placed = sorted(placed_by_events(chunk).items())
        runs = chunk.context_runs()
        used = [contexts[number] for number in {number for number, _, _ in runs}]
        paced = any(context.pace is not None for context in used)
        if self._context.transformation is None and not paced and not any(c.transformation for c in used):
            for row in _last_move(chunk):
                self._context = contexts[chunk.context[row]]
                self._on_path = self._end_of(chunk, row, self._context)
                self._placed = [each for each in self._placed if each[0] > row]
            self._place(len(chunk), bounds)
            return bounds
        if paced or not LED_ALONE.issuperset(chunk.kind) or not all(map(self._needs_no_shares, used)):
            for column, free in zip(bounds.shares, FREE_SHARE, strict=True):
                column.extend(array("d", (free,)) * (SHARES * len(chunk)))
            bounds.feed.extend(array("d", (1.0,)) * len(chunk))
        for number, first, last in runs:
            moves = [row for row in range(first, last) if chunk.kind[row] < Kind.DWELL]
            if moves:
                self._run(chunk, moves, contexts[number], bounds)
        self._place(len(chunk), bounds)
        return bounds

    def _is_placed(self, row: int) -> bool:
        """Whether axes are elsewhere on the path from a row on."""
        return bool(self._placed) and self._placed[0][0] <= row

    def _place(self, row: int, bounds: Bounds) -> None:
        """Real axes are elsewhere from a row on, by events before it."""
        while self._is_placed(row):
            number, places = self._placed.pop(0)
            for column, place in places.items():
                self._on_path = with_axis(self._on_path, self._context, self._geometry, column, place)
            bounds.placed[number], self._behind = self._on_path, None

    def _needs_no_shares(self, context: Context) -> bool:
        """Whether the kernels find out themselves what bounds straight rows."""
        if context.transformation is None:
            return True
        return is_led(context, self._settings) and len(self.limits(context).linkage) > 0

    def _run(self, chunk: Chunk, moves: Sequence[int], context: Context, bounds: Bounds) -> None:
        """Look at moves of one context after each other."""
        self._place(moves[0], bounds)
        if context.transformation is not self._context.transformation:
            self._on_path = self._carried(context)
            bounds.enters[moves[0]] = self._on_path
        is_done = self._bounded(chunk, moves, context, bounds)
        for before, row in zip((-1, *moves), moves, strict=False):
            if before >= 0 and is_done[before] and (not is_done[row] or self._is_placed(row)):
                self._on_path = self._end_of(chunk, before, context)
            self._place(row, bounds)
            if is_done[row]:
                continue
            self._row(chunk, row, context, bounds)
        if is_done[moves[-1]]:
            self._on_path = self._end_of(chunk, moves[-1], context)
        self._context = context
        self._behind = context, self._led_to(chunk, moves[-1], context)

    def _bounded(self, chunk: Chunk, moves: Sequence[int], context: Context, bounds: Bounds) -> bytes:
        """Which rows need no look of their own: 1 for each; those of a tip are bounded all at once."""
        made = context.transformation
        if context.pace is not None:
            return bytes(len(chunk))
        if made is None:
            return b"\1" * len(chunk)
        if self._needs_no_shares(context):
            return chunk.kind.tobytes().translate(LED_KINDS)
        limits = self.limits(context)
        if not limits.linkage:
            return bytes(len(chunk))
        if self._behind is not None and self._behind[0] is context:
            start = self._behind[1]
        else:
            start = work_of(self._on_path, context, self._geometry)
        weight = rotary_weight(context, self._settings)
        shares = bounds.shares.top, bounds.shares.ease
        soft = self._is_soft(context)
        rows = moves[0], moves[-1] + 1
        ends = led_ends(chunk, rows, context, self._geometry, self._turned)
        return bound_tip(chunk.kind, ends, rows, start, weight, limits, shares, soft=soft)

    def _row(self, chunk: Chunk, row: int, context: Context, bounds: Bounds) -> None:
        """Look at one row, behind the one on whose end `_on_path` is."""
        end = self._led_to(chunk, row, context)
        if context.transformation is not None and chunk.kind[row] != Kind.REF:
            start = work_of(self._on_path, context, self._geometry)
            legs = self._legs(chunk, row, start, end, context)
            if legs:
                bounds.legs[row] = legs
                if context.pace is not None:
                    self._pace(chunk, row, legs[-1].end, context, bounds, [leg.rows for leg in legs])
                self._on_path = legs[-1].end
                return
            path, length, angle = self._path(chunk, row, start, end, context)
            shares = self._shares(context, path, length, chunk.kind[row], angle)
            top = following_top(context, path, length, rapid=chunk.kind[row] in RAPID_KINDS)
            shares.write(bounds.shares, row * SHARES, top)
        goal = machine_of(end, context, self._geometry)
        if context.pace is not None:
            self._pace(chunk, row, goal, context, bounds)
        self._on_path = goal

    def _end_of(self, chunk: Chunk, row: int, context: Context) -> list[float]:
        """Machine position of the path at the end of a row."""
        return machine_of(self._led_to(chunk, row, context), context, self._geometry)

    def _led_to(self, chunk: Chunk, row: int, context: Context) -> list[float]:
        """Where a row leads, work coordinates: beside its end, where it is led there."""
        return led_to(chunk, row, context, self._geometry, self._turned)

    def _pace(
        self,
        chunk: Chunk,
        row: int,
        goal: list[float],
        context: Context,
        bounds: Bounds,
        legs: Sequence[Rows] = (),
    ) -> None:
        """What the program says about the speed of a row is added to its bounds, or to those of its legs."""
        weight = rotary_weight(context, self._settings)
        weights = [weight if self._rotary(i) else 1.0 for i in range(len(goal))]
        way, limits = self._way_of(chunk, row, goal, context), self.limits(context)
        soft = self._is_soft(context)
        bounds.feed[row], top, ease, at_corners = pace_of(
            context,
            way,
            weights,
            limits,
            rapid=chunk.kind[row] in RAPID_KINDS,
            curved=chunk.kind[row] == Kind.SPLINE or context.chords,
            soft=soft,
            by_way=soft and is_bent_by_way(context, self._settings),
        )
        whole = (bounds.shares.top, bounds.shares.ease, row * SHARES)
        for tops, eases, first in [(leg.top, leg.ease, 0) for leg in legs] or [whole]:
            for k in range(SHARES):
                tops[first + k] = min(tops[first + k], top)
                eases[first + k] *= at_corners if k in (AT_START, AT_END) else ease

    def _way_of(self, chunk: Chunk, row: int, goal: list[float], context: Context) -> Travel:
        """The way of a row in the columns' machine coordinates."""
        moved, curve = [abs(b - a) for a, b in zip(self._on_path, goal, strict=True)], self._curve(chunk, row)
        if not curve:
            return Travel(moved)
        ccw = chunk.kind[row] in CCW_KINDS
        start, end = (work_of(place, context, self._geometry) for place in (self._on_path, goal))
        arc = arc_path(start, end, curve, self._geometry, ccw=ccw)
        plane = []
        for i, part in zip(self._geometry, arc.normal, strict=True):
            if i >= 0 and abs(part) < ACROSS:
                plane.append(i)
            elif i >= 0:
                moved[i] = abs(part * arc.lift)
        return Travel(moved, tuple(plane), arc.planar, arc.radius, ccw)

    def _carried(self, context: Context) -> list[float]:
        """Where the path goes on under another transformation: next to its pole in the direction of the rotary axis."""
        on_path = carried(self._on_path, self._context, context, self._geometry)
        pole = context.transformation.pole if context.transformation is not None else None
        if pole is None or not is_at(pole, work_of(on_path, context, self._geometry)):
            return on_path
        real = work_of(real_of(self._on_path, self._context, self._geometry), context, self._geometry)
        beside = machine_of(pole.axes_beside(real, RING_MM), context, self._geometry)
        return path_of(beside, context, self._geometry)

    def _legs(
        self, chunk: Chunk, row: int, start: list[float], end: list[float], context: Context
    ) -> list[PathLeg]:
        """The legs of a row that is at the pole somewhere, or at a kink of a curve that leads an axis."""
        assert context.transformation is not None
        pole, kind, own = context.transformation.pole, chunk.kind[row], slice(row, row + 1)
        if kind not in LEGGED or not runs_in_legs(context.transformation):
            return []
        curve, made = self._curve(chunk, row), context.transformation.geometry
        legs = []
        if pole is not None:
            legs = legs_of(pole, start, end, curve, made, ccw=kind in CCW_KINDS)
        if not legs:
            steps = slope_steps(self._axes, soft=self._is_soft(context))
            legs = kink_legs(context.transformation, steps, start, end, curve, ccw=kind in CCW_KINDS)
        found = []
        total = sum(leg.length for leg in legs)
        for leg in legs:
            shares = Shares(*(array("d", [free] * SHARES) for free in FREE_SHARE))
            angle = FULL if curve else 0.0
            self._shares(context, leg.path, leg.length, kind, angle, leg.rests).write(shares, 0)
            timed = context.feed_mode is FeedMode.INVERSE_TIME and leg.length > 0.0
            feed = array("d", [total / leg.length if timed else 1.0])
            rows = Rows(
                chunk.kind[own], chunk.context[own], feed, array("d", leg.end),
                array(chunk.curve.typecode, [0 if curve else -1]), NO_STOPS, *shares,
            )  # fmt: skip
            curves = array("d", [*curve[:6], 0.0, 0.0] if curve else [])
            found.append(PathLeg(leg.turn, rows, curves, machine_of(leg.end, context, self._geometry)))
        return found

    def turn(self, turn: Turn, context: Context, kind: int, row: float, slot: int) -> array[float]:
        """The planner's pieces of a turn at the pole."""
        axis = dict(self.axis_limits(context, rapid=kind in RAPID_KINDS))[turn.pole.rotary]
        return turn_records(
            turn, axis, context, self._geometry, soft=self._is_soft(context), row=row, slot=slot
        )

    def axis_limits(self, context: Context, *, rapid: bool) -> list[tuple[int, AxisLimits]]:
        """What the program leaves the machine's axes under a transformation, by their columns."""
        if self._left is None or self._left[0] is not context or self._left[1] is not rapid:
            self._left = context, rapid, axis_limits_of(context, self._axes, rapid=rapid)
        return self._left[2]

    def rates(self, on_path: Sequence[float], direction: Sequence[float], context: Context) -> list[float]:
        """Way of every real axis by the way of the path, at a position of it and in a direction."""
        before, after = (
            real_of([a + side * b for a, b in zip(on_path, direction, strict=True)], context, self._geometry)
            for side in (-0.5 * PATH_STEP, 0.5 * PATH_STEP)
        )
        ways = enumerate(b - a for a, b in zip(before, after, strict=True))
        turns = [(way + 180.0) % 360.0 - 180.0 if self._rotary(i) else way for i, way in ways]
        return [way / PATH_STEP for way in turns]

    def motion(self, moved: Moved, context: Context) -> Moved:
        """Position, velocity and acceleration of the real axes, (k, axes), for those of the columns."""
        if context.transformation is None:
            return moved
        import numpy as np

        position, velocity, acceleration = moved
        nearby = [position + velocity * t + acceleration * (0.5 * t * t) for t in (-SHORT_S, 0.0, SHORT_S)]
        before, now, after = (real_rows(on_path, context, self._geometry) for on_path in nearby)
        turning = np.array([self._rotary(i) for i in range(len(self._axes))])
        came, goes = (
            np.where(turning, (way + 180.0) % 360.0 - 180.0, way) for way in (now - before, after - now)
        )
        return now, (came + goes) / (2.0 * SHORT_S), (goes - came) / SHORT_S**2

    def _curve(self, chunk: Chunk, row: int) -> list[float]:
        """Curve parameters of an arc; empty for other rows."""
        at = chunk.curve[row] * CURVE_WIDTH
        return list(chunk.curves[at : at + CURVE_WIDTH]) if chunk.kind[row] in ARC_KINDS and at >= 0 else []

    def _path(
        self, chunk: Chunk, row: int, start: list[float], end: list[float], context: Context
    ) -> tuple[Path, float, float]:
        """The points of a row, its length, and by how much it turns: angle of an arc and rotary axes, radians."""
        assert context.transformation is not None
        curve, made = self._curve(chunk, row), context.transformation.geometry
        ways = enumerate(map(sub, end, start))
        turned = radians(sum(abs(way) for i, way in ways if self._rotary(i) and i not in made))
        if curve:
            arc = arc_path(start, end, curve, made, ccw=chunk.kind[row] in CCW_KINDS)
            beside = [0.0 if i in made else way for i, way in enumerate(self._counted(context, start, end))]
            return arc.at, hypot(arc.length, *beside), arc.angle + turned
        return line_path(start, end), self._length(context, start, end), turned

    def _shares(
        self,
        context: Context,
        path: Path,
        length: float,
        kind: int,
        angle: float,
        rests: tuple[bool, bool] = (False, False),
    ) -> RowShares:
        """The shares of a row; `angle`: by how much it turns, `rests`: the path begins or ends at the pole."""
        if length == 0.0:
            return RowShares([], Corner(), Corner())
        more, limits = reserve(context), self.limits(context)
        pulls, jerks = ([more * limit for limit in of] for of in (limits.acceleration, limits.jerk))
        axes, soft = self.axis_limits(context, rapid=kind in RAPID_KINDS), self._is_soft(context)
        assert context.transformation is not None
        way = Way(context.transformation, path, length, axes, self._turning, pulls, jerks, soft)
        return self._shares_of(context, way, kind, angle, rests).eased(more)

    def _shares_of(
        self, context: Context, way: Way, kind: int, angle: float, rests: tuple[bool, bool]
    ) -> RowShares:
        """The same, the columns' limits being those of the way."""
        count, length = looks_along(angle), way.length

        def look(place: float, *, lateral: bool) -> Demand:
            return between(way.demand(place, lateral=lateral), angle / count)

        looks = [look(k / count, lateral=True) for k in range(count + 1)]
        sizes = [max(look.pull, 1.0 / look.top) for look in looks]
        uneven = max(sizes) >= UNEVEN * min(sizes) or any(rests)
        places = [k / count for k in range(count + 1)]
        if not uneven:
            fastest = crest(looks)
            places += fastest
            looks += [look(place, lateral=True) for place in fastest]
        is_tip = len(self.limits(context).linkage) > 0
        even = not uneven or (is_tip and not any(rests))
        if kind in ARC_KINDS and even and self._may_reach(context):
            seen = looked_at(way)
            shares = shares_of(seen, length, angle, stops=context.stops)
            return self._corners(context, length, look, shares, rests)
        # Where the program limits single axes, an axis that stands in a line leaves that its whole acceleration.
        limited = kind in (Kind.RAPID, Kind.FEED) and context.pace is not None and not context.chords
        if (kind in ARC_KINDS or limited) and not uneven:
            inside = [look(place, lateral=False) for place in places]
            found = self._corners(context, length, look, [(1.0, *within(inside, length))], rests)
            # What holds at corners all along the row lets their averages reach as far as they like.
            top, ease = within(looks, length)
            return even_row(top, ease) if top > found.shares[0][1] else found
        if kind in (Kind.SPLINE, Kind.THREAD, Kind.TAP) or context.chords or not uneven:
            top, ease = within(looks, length)
            return even_row(top, ease)
        worst = way.worst(sizes.index(max(sizes)) / count)
        extent = way.extent(worst)
        if any(rests):
            worst, extent = (0.0 if rests[0] else 1.0), max(extent, NEAR_POLE / length)

        def demand(place: float, *, lateral: bool) -> Demand:
            step = 0.1 * hypot(extent, place - worst) * length
            return way.demand(place, step, lateral=lateral)

        shares, begin = [], 0.0
        for f in share_ends(worst, extent):
            places = [begin, f, 0.5 * (begin + f)]
            if begin <= worst <= f:
                places.append(worst)
                # Beside it a rotary axis changes its speed most.
                places += [begin + (f - begin) * k / WITHIN for k in range(1, WITHIN)]
            parts = looks_along(angle * (f - begin), 1)
            places += [begin + (f - begin) * k / parts for k in range(1, parts)]
            part = angle * (f - begin) / parts
            inside = [between(demand(place, lateral=False), part) for place in places]
            shares.append((f, *within(inside, (f - begin) * length)))
            begin = f
        return self._corners(context, length, demand, shares, rests)

    def _may_reach(self, context: Context) -> bool:
        """Whether acceleration alone bounds the speed, and corners have no averages that reach into a row."""
        return not self._is_soft(context) and not any(averages(context, self._machine, self._settings))

    def _corners(
        self,
        context: Context,
        length: float,
        demand: Callable[..., Demand],
        shares: list[tuple[float, float, float]],
        rests: tuple[bool, bool],
    ) -> RowShares:
        """Where a row meets others its columns may accelerate in any direction, as far as a corner's average reaches.

        `hold.py`: a corner passed at c reaches c·window/2. Without averages a corner is bent (`rounding.py`).
        """
        window, corners = sum(averages(context, self._machine, self._settings)), [Corner(), Corner()]
        for end, rest in enumerate(rests):
            if not rest:
                k = -end
                begin = shares[-2][0] if end and len(shares) > 1 else 0.0
                reach = CORNER_REACH * (shares[k][0] - begin)

                def beside(places: list[float], *, end: int = end) -> tuple[float, float]:
                    demands = [demand(abs(end - place), lateral=True) for place in places]
                    return within(demands, places[-1] * length)

                top, ease = beside([0.0, 0.5 * reach, reach])
                corners[end] = Corner(ease, reach)
                if window > 0.0:
                    top = min(top, 2.0 * reach * length / window)
                else:
                    corners[end] = farthest(beside, corners[end])
                shares[k] = (shares[k][0], min(top, shares[k][1]), shares[k][2])
        return RowShares(shares, *corners)

    def _length(self, context: Context, start: Sequence[float], end: Sequence[float]) -> float:
        """Length of a way, as the feed counts it."""
        counted = hypot(*self._counted(context, start, end))
        stands = counted < STANDS_MM and rotary_weight(context, self._settings) == 0.0
        return hypot(*map(sub, end, start)) if stands else counted

    def _counted(self, context: Context, start: Sequence[float], end: Sequence[float]) -> list[float]:
        """How far each column goes, as the feed counts it, mm."""
        assert context.transformation is not None
        made, weight = context.transformation.geometry, rotary_weight(context, self._settings)
        turned = [weight if self._rotary(i) and i not in made else 1.0 for i in range(len(start))]
        return [w * (b - a) for w, a, b in zip(turned, start, end, strict=True)]

    def _is_soft(self, context: Context) -> bool:
        return (context.acceleration or self._settings.acceleration) is AccelerationMode.JERK_LIMITED

    def _rotary(self, column: int) -> bool:
        axis = self._axes[column]
        return axis is not None and axis.rotary
