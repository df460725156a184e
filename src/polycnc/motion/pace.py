"""What a program says about speeds beside F: its overrides, the length that F is for, the edge or centre of the tool.

A row's feed is multiplied by a factor, its speed bounded, and the accelerations that its axes may use shrink or grow by
another factor: the same that rows under a transformation have (`transformed.py`).
"""

from __future__ import annotations

from math import hypot, inf, sqrt
from operator import mul
from typing import TYPE_CHECKING

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.toolpath.modes import FeedMode
from polycnc.transformation.orientation.linkage import STANDS_MM

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.motion.kernels.columns import Limits
    from polycnc.toolpath import Context
    from polycnc.toolpath.context import Pace
    from polycnc.toolpath.row_path import Path

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
    context: Context, way: Travel, weights: Sequence[float], limits: Limits, *, rapid: bool
) -> tuple[float, float, float, float]:
    """What a row's pace makes of it.

    Args:
        context: Context of the row, with a pace.
        way: How far its columns go.
        weights: What each column counts in the length that the planner's path speed is of.
        limits: The machine, as the kernels take it.
        rapid: The row is a rapid.

    Returns:
        Factor on its feed; highest path speed, mm/s; factor on what the axes may accelerate, and on that at its
        corners, where each of them may have to.
    """
    pace, n, made = context.pace, len(way.moved), context.transformation is not None
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
    return (
        feed,
        _top(pace, way, length, moving, limits, rapid=rapid, made=made),
        _ease(pace, way, length, moving, limits, made=made),
        min(
            (factors[i] for factors in (_pulls(pace, made=made), pace.jerk) if factors for i in moving),
            default=1.0,
        ),
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
    pace: Pace, way: Travel, length: float, moving: Sequence[int], limits: Limits, *, rapid: bool, made: bool
) -> float:
    """The path speed at which no axis passes its velocity, and at which an arc keeps the accelerations."""
    top, tops = inf, limits.top_rapid if rapid else limits.top_feed
    pulls = _pulls(pace, made=made)
    for i in moving:
        share = way.share(i, length)
        if pace.velocity:
            factor = pace.velocity[i] * (pace.rapid if rapid else 1.0)
            top = min(top, tops[i] * factor / share)
        if pace.reach:
            top = min(top, pace.reach[i] * (pace.rapid if rapid else 1.0) / share)
        if pace.left and not made:
            top = min(top, pace.left[i] / share)
        if pace.top and not rapid:
            top = min(top, pace.top[i] / share)
        if pulls and i in way.plane:
            top = min(top, sqrt(pulls[i] * limits.acceleration[i] * way.radius))
    return top


def left_of(context: Context, axis: int, velocity: float, acceleration: float) -> tuple[float, float]:
    """What motions over a real axis leave of its limits to the path under a transformation."""
    pace = context.pace
    if pace is None or not pace.left:
        return velocity, acceleration
    return min(velocity or inf, pace.left[axis]), acceleration * pace.left_pull[axis]


def _pulls(pace: Pace, *, made: bool) -> tuple[float, ...]:
    """Factors on the accelerations of the columns; `made`: those that are left of real axes are no such."""
    if not pace.left_pull or made:
        return pace.acceleration
    return tuple(map(mul, pace.acceleration, pace.left_pull)) if pace.acceleration else pace.left_pull


def _ease(
    pace: Pace, way: Travel, length: float, moving: Sequence[int], limits: Limits, *, made: bool
) -> float:
    """The factor on the limits of all columns at which the row keeps those of its axes."""
    ease = inf
    for own, factors in ((limits.acceleration, _pulls(pace, made=made)), (limits.jerk, pace.jerk)):
        if not factors or not moving:
            continue
        if way.plane:
            ease = min(ease, *(factors[i] for i in moving))
        else:
            pulls = [own[i] / way.share(i, length) for i in moving]
            ease = min(ease, min(p * factors[i] for p, i in zip(pulls, moving, strict=True)) / min(pulls))
    return ease if ease < inf else 1.0


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
