"""What a program says about speeds beside F: its overrides, the length that F is for, the edge or centre of the tool.

A row's feed is multiplied by a factor, its speed bounded, and the accelerations that its axes may use shrink or grow by
another factor: the same that rows under a transformation have (`transformed.py`).

Limits of single axes are those of the machine's axes (SINUMERIK job planning 8.7). Under a transformation these are
others than the columns: `axis_limits_of` says what each of them has left. What an axis goes by itself that follows
others is a column all the same.
"""

from __future__ import annotations

from math import hypot, inf, sqrt
from operator import mul

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.kernels.columns import FACTOR
from polycnc.toolpath.kinds import CURVE_WIDTH, Kind
from polycnc.toolpath.modes import FeedMode
from polycnc.transformation.orientation.linkage import STANDS_MM

if TYPE_CHECKING:
    from array import array
    from collections.abc import Sequence

    from polycnc.machine.model import Axis
    from polycnc.motion.kernels.columns import Limits
    from polycnc.toolpath import Context
    from polycnc.toolpath.context import Pace
    from polycnc.toolpath.row_path import Path
    from polycnc.toolpath.table import Chunk
    from polycnc.transformation.contract import Transformation

#: Parts of a length up to which a degree is still a millimetre: on a radius of 57.296 mm, as programs write it.
NOMINAL = 1e-5
#: A contour radius below this part of the tool's is a corner, about which the tool turns at F.
CORNER = 1e-6
#: Places along a row at which the linear axes are looked at that follow its rotary ones.
LOOKS = 16


class Travel(NamedTuple):
    """How far the columns of a toolpath go in a row.

    Attributes:
        moved: By column, mm or degrees; of an arc those outside its plane count.
        plane: Columns that an arc is made of; none for lines.
        planar: Length of the arc in its plane, mm.
        radius: Of the arc, mm.
        ccw: The arc is counter-clockwise.
    """

    moved: list[float]
    plane: tuple[int, ...] = ()
    planar: float = 0.0
    radius: float = 0.0
    ccw: bool = False

    def length(self, weights: Sequence[float]) -> float:
        """Length of the way where each column counts with a weight."""
        square = sum(
            (w * way) ** 2
            for i, (w, way) in enumerate(zip(weights, self.moved, strict=True))
            if i not in self.plane
        )
        return sqrt(square + (self.planar * max((weights[i] for i in self.plane), default=0.0)) ** 2)

    def share(self, column: int, length: float) -> float:
        """The largest part of the path speed that a column takes."""
        return (self.planar if column in self.plane else self.moved[column]) / length


def pace_of(
    context: Context,
    way: Travel,
    weights: Sequence[float],
    limits: Limits,
    *,
    rapid: bool,
    soft: bool,
    curved: bool = False,
    by_way: bool = False,
) -> tuple[float, float, float, float]:
    """What a row's pace makes of it.

    Args:
        context: Context of the row, with a pace.
        way: How far its columns go.
        weights: What each column counts in the length that the planner's path speed is of.
        limits: The machine, as the kernels take it.
        rapid: The row is a rapid.
        soft: The jerk is limited.
        curved: The row is a chord of a curve, which moves its axes as the chord does not.
        by_way: Its run is bent by its way: corners use little acceleration there, but all the jerk.

    Returns:
        Factor on its feed; highest path speed, mm/s; factor on what the axes may accelerate, and on that at its
        corners, where each of them may have to.
    """
    pace, n = context.pace, len(way.moved)
    assert pace is not None
    length = way.length(weights)
    turns = length < STANDS_MM
    if turns:
        length = way.length([1.0] * n)
    if length == 0.0:
        return 1.0, inf, 1.0, 1.0
    moving = [i for i in range(n) if way.share(i, length) > 0.0]
    feed = pace.feed * edge_factor(pace, context, way)
    if context.feed_mode is not FeedMode.INVERSE_TIME:
        counted = _counted(pace, way, turns=turns) or length
        feed *= length / counted
        if turns and abs(counted - length) > NOMINAL * length:
            feed *= context.degree_mm
    made, bound = context.transformation is not None, moving
    if made:  # their factors are for the axes of the machine (`axis_limits_of`)
        own = own_columns(context.transformation)
        bound = [i for i in moving if i in own]
    shrinking = _shrinking(pace, n, made=made, soft=soft)
    together = min((factors[i] for factors in shrinking for i in bound), default=1.0)
    ease = _ease(shrinking, way, length, (moving, bound), limits, made=made)
    jerks = [pace.jerk] if pace.jerk else []
    at_corners = min((factors[i] for factors in (jerks if by_way else shrinking) for i in bound), default=1.0)
    return (
        feed,
        _top(pace, way, length, (moving, bound), limits, rapid=rapid, made=made),
        min(ease, together) if curved else ease,
        at_corners,
    )


def _counted(pace: Pace, way: Travel, *, turns: bool) -> float:
    """Length that F is for, mm: of the axes of its group, else of rotary ones on the circles that they have; 0: all."""
    counted = way.length(pace.weights) if pace.weights else 0.0
    return way.length(pace.turning) if turns and pace.turning and not counted else counted


def edge_factor(pace: Pace, context: Context, way: Travel) -> float:
    """How much faster than the edge of the tool its centre moves on an arc, where F is the speed of the edge.

    A time has no edge: the block takes as long as F says.
    """
    if pace.edge == "never" or not way.plane or context.side == 0:
        return 1.0
    if context.feed_mode is FeedMode.INVERSE_TIME:
        return 1.0
    inside = (context.side > 0) == way.ccw
    contour = way.radius + (context.radius_mm if inside else -context.radius_mm)
    if contour <= CORNER * abs(context.radius_mm):
        return 1.0
    factor = way.radius / contour
    return factor if factor < 1.0 or pace.edge == "always" else 1.0


def _top(
    pace: Pace,
    way: Travel,
    length: float,
    columns: tuple[Sequence[int], Sequence[int]],
    limits: Limits,
    *,
    rapid: bool,
    made: bool,
) -> float:
    """The path speed at which no axis passes its velocity, and at which an arc keeps the accelerations.

    `columns` are those that move, and those of them for which the pace's limits of axes are.
    """
    top, tops = inf, limits.top_rapid if rapid else limits.top_feed
    pulls, faster = _pulls(pace, made=made), pace.rapid if rapid else 1.0
    moving, bound = columns
    for i in moving:
        if pace.top and not rapid:
            top = min(top, pace.top[i] / way.share(i, length))
    for i in bound:
        share = way.share(i, length)
        if pace.velocity:
            top = min(top, tops[i] * pace.velocity[i] * faster / share)
        if pace.reach:
            top = min(top, pace.reach[i] * faster / share)
        if pace.left and not made:
            top = min(top, pace.left[i] / share)
        if pulls and i in way.plane:
            top = min(top, sqrt(pulls[i] * limits.acceleration[i] * way.radius))
    return top


class AxisLimits(NamedTuple):
    """What an axis of the machine may do: velocity, acceleration and jerk, mm or degrees and seconds; 0 for any."""

    velocity: float
    acceleration: float
    jerk: float


def axis_limits_of(
    context: Context, axes: Sequence[Axis | None], *, rapid: bool
) -> list[tuple[int, AxisLimits]]:
    """What the program leaves the machine's axes under a transformation, by their columns.

    Those are the factors of the pace and its highest velocities, and what motions over an axis leave to the path. An
    axis that follows others has them for what it goes by itself, which is its column.
    """
    pace, made = context.pace, context.transformation
    found = []
    for column, axis in enumerate(axes):
        if axis is not None:
            own = AxisLimits(axis.rapid if rapid else axis.max_feed, axis.acceleration, axis.jerk)
            found.append((column, own))
    if pace is None:
        return found
    by_itself = own_columns(made)
    return [
        (column, _left(pace, column, own, rapid=rapid, named=column not in by_itself))
        for column, own in found
    ]


def own_columns(transformation: Transformation | None) -> frozenset[int]:
    """Columns of axes that follow others, for which a pace's limits of axes are those of the column."""
    if transformation is None:
        return frozenset()
    from polycnc.transformation.couplings.acting import following  # for paths under a transformation

    return following(transformation)


def _left(pace: Pace, i: int, own: AxisLimits, *, rapid: bool, named: bool) -> AxisLimits:
    """What is left of an axis; `named`: factors for axes are for this one, not for what it goes by itself."""
    velocity, acceleration, jerk = own
    faster = pace.rapid if rapid else 1.0
    velocity *= faster
    if named:
        velocity *= pace.velocity[i] if pace.velocity else 1.0
        acceleration *= pace.acceleration[i] if pace.acceleration else 1.0
        jerk *= pace.jerk[i] if pace.jerk else 1.0
        if pace.reach:
            velocity = _least(velocity, faster * pace.reach[i])
    if pace.left:
        velocity = _least(velocity, pace.left[i])
        acceleration *= pace.left_pull[i]
    return AxisLimits(velocity, acceleration, jerk)


def _least(velocity: float, top: float) -> float:
    """The lower one of two velocities, of which 0 and infinity stand for any."""
    return min(velocity or inf, top) if top < inf else velocity


def reserve(context: Context) -> float:
    """How much more than a column the machine's axes can accelerate under a transformation: more than 1 for `ACC`.

    What is left of each of them bounds the path; the columns' own acceleration is no limit of the machine.
    """
    pace = context.pace
    return max(1.0, *pace.acceleration) if pace is not None and pace.acceleration else 1.0


def _pulls(pace: Pace, *, made: bool) -> tuple[float, ...]:
    """Factors on the accelerations of the columns; `made`: those that are left of real axes are no such."""
    if not pace.left_pull or made:
        return pace.acceleration
    return tuple(map(mul, pace.acceleration, pace.left_pull)) if pace.acceleration else pace.left_pull


def _shrinking(pace: Pace, n: int, *, made: bool, soft: bool) -> list[tuple[float, ...]]:
    """Factors on the accelerations of the columns, and on their jerks where these are limited; none where all are 1.

    One factor shrinks both, so both have a say: what more acceleration there is, the jerk may not follow.
    """
    pulls = _pulls(pace, made=made)
    if not pulls and not pace.jerk:
        return []
    even = (1.0,) * n
    return [pulls or even, pace.jerk or even] if soft else [pulls or even]


def _ease(
    shrinking: list[tuple[float, ...]],
    way: Travel,
    length: float,
    columns: tuple[Sequence[int], Sequence[int]],
    limits: Limits,
    *,
    made: bool,
) -> float:
    """The factor on the limits of all columns at which the row keeps those of its axes; `columns` as for `_top`."""
    ease, (moving, bound) = inf, columns
    if not bound:
        return 1.0
    for own, factors in zip((limits.acceleration, limits.jerk), shrinking, strict=False):
        if way.plane:
            ease = min(ease, *(factors[i] for i in bound))
        else:
            least = min(own[i] / way.share(i, length) for i in moving)
            ease = min(ease, *(own[i] / way.share(i, length) * factors[i] / least for i in bound))
    return min(ease, 1.0) if made else ease if ease < inf else 1.0


def following_top(context: Context, path: Path, length: float, *, rapid: bool) -> float:
    """The path speed at which linear axes follow the turns of rotary ones no faster than the pace allows, mm/s.

    What they follow is their speed with the tip held where it is: derivatives by the rotary columns alone, along the
    row. `length` is the row's, as the planner's path speed is of it. Rapids are bounded by their axes alone.
    """
    pace, transformation = context.pace, context.transformation
    if pace is None or transformation is None or pace.following == inf or rapid or length == 0.0:
        return inf
    made = transformation.geometry
    turned = {
        column: (end - start) / length
        for column, (start, end) in enumerate(zip(path(0.0), path(1.0), strict=True))
        if column not in made and end != start
    }
    fastest = 0.0
    for look in range(LOOKS + 1) if turned else ():
        slopes = transformation.jacobian(path(look / LOOKS))
        ways = (sum(slopes[axis][j] * turn for j, turn in turned.items()) for axis in made)
        fastest = max(fastest, hypot(*ways))
    return pace.following / fastest if fastest > 0.0 else inf


def taps_as_overridden(chunk: Chunk) -> array[float]:
    """Curve parameters of a chunk where the feed override acts on taps: at 100 % they come out as they go in."""
    curves = chunk.curves[:]
    for kind, place in zip(chunk.kind, chunk.curve, strict=True):
        if kind == Kind.TAP and place >= 0:
            curves[place * CURVE_WIDTH + FACTOR] = 1.0
    return curves
