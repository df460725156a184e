"""What real axes allow on many straight rows at once, by columns: to the bits of what `transformed` finds row by row.

Most rows of a five-axis program are short lines on which this hardly changes: looks at a few places tell their speed
and acceleration. Every sum and product stands in the order in which `transformed` has it. Needs NumPy.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, NamedTuple

from polycnc.motion.kernels.columns import AT_START

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    import numpy.typing as npt

    from polycnc.machine.model import Axis
    from polycnc.motion.kernels.columns import Limits
    from polycnc.transformation.contract import Transformation

    Column = npt.NDArray[np.float64]
    Columns = Sequence[Column]

#: Part of the acceleration that is for the bend of the real axes' way; the rest is for changes of speed.
BEND = 0.5
#: Parts of the jerk: for the third derivative of the way; for bend and acceleration together.
TWIST, TURN = 0.2, 0.3
#: Derivatives along the path are differences over so many mm or degrees at most.
PATH_STEP = 5e-3
#: Derivatives below this count as none.
NOTHING = 1e-9
#: Places at which a row is looked at first; a change of the demand by more than UNEVEN is worth shares.
LOOKS, UNEVEN = 4, 1.3
#: Shares become shorter by this factor towards the worst place, or by a smaller one.
SHORTER = 0.5


class Demand(NamedTuple):
    """What the real axes allow at a place: numbers, or a column of them for as many rows.

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


class ManyDemands(NamedTuple):
    """The same of many rows; see `Demand`."""

    top: Column
    bend: Column
    pull: Column
    jerk: Column
    turn: Column
    along: Column


class Straights(NamedTuple):
    """Straight rows under one transformation.

    Attributes:
        transformation: That acts on them.
        start: Their points of the path, a column an axis; `end` likewise.
        length: As the feed counts it, none of them next to zero.
        rapid: Which of them are rapids.
        axes: The machine's axes by columns.
        limits: Of the columns.
        soft: The jerk is limited.
    """

    transformation: Transformation
    start: Columns
    end: Columns
    length: Column
    rapid: npt.NDArray[np.bool_]
    axes: Sequence[Axis | None]
    limits: Limits
    soft: bool


def even(rows: Straights) -> tuple[npt.NDArray[np.bool_], Column, Column]:
    """Which rows ask for much the same all along, and their speed and `ease`."""
    import numpy as np

    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        looks = [_demands(rows, k / LOOKS) for k in range(LOOKS + 1)]
        sizes = np.array([np.maximum(look.pull, 1.0 / look.top) for look in looks])
        is_even = ~(sizes.max(axis=0) >= UNEVEN * sizes.min(axis=0))
        worst = ManyDemands(
            np.min([look.top for look in looks], axis=0),
            *(np.max(values, axis=0) for values in list(zip(*looks, strict=True))[1:]),
        )
        return is_even, *_within(worst, rows.length)


def _demands(rows: Straights, share: float) -> ManyDemands:
    """What the real axes allow at one place of every row, whatever direction the columns accelerate in."""
    import numpy as np

    length, step, pulls = rows.length, PATH_STEP, rows.limits.acceleration
    reach = 1.5 * step / length
    held = np.minimum(np.maximum(share, reach), 1.0 - reach)
    middle = np.where(4.0 * step < length, held, share)
    nearby = [
        [
            a + (b - a) * (middle + (k - 1.5) * step / length)
            for a, b in zip(rows.start, rows.end, strict=True)
        ]
        for k in range(4)
    ]
    real = [rows.transformation.to_machine(point) for point in nearby]
    direction = [(b - a) / step for a, b in zip(nearby[1], nearby[2], strict=True)]
    along = _along(direction, pulls)
    here, there = (rows.transformation.jacobian(point) for point in nearby[1:3])
    made = rows.transformation.geometry
    used = [way != 0.0 if j not in made else np.ones(len(way), bool) for j, way in enumerate(direction)]
    size = len(length)
    top, bend, pull = np.full(size, inf), np.zeros(size), np.full(size, NOTHING)
    jerk, turn = np.zeros(size), np.zeros(size)
    for i, axis in enumerate(rows.axes):
        if axis is None:
            continue
        ways = [_way(axis, real[k + 1][i] - real[k][i]) / step for k in range(3)]
        bends = [(ways[k + 1] - ways[k]) / step for k in range(2)]
        velocity = np.where(rows.rapid, axis.rapid, axis.max_feed)
        fastest, steepest = np.abs(ways).max(axis=0), np.abs(bends).max(axis=0)
        bounds = (velocity != 0.0) & (fastest > 0.0)
        top = np.where(bounds, np.minimum(top, velocity / fastest), top)
        if axis.acceleration:
            bend = np.maximum(bend, steepest / axis.acceleration)
            pull = np.maximum(pull, _sum(here[i], pulls, used) / axis.acceleration)
        if rows.soft and axis.jerk:
            twist = np.abs(bends[1] - bends[0]) / step
            twisted = np.minimum(top, cube_root(TWIST * axis.jerk / np.where(twist > NOTHING, twist, 1.0)))
            top = np.where(twist > NOTHING, twisted, top)
            jerk = np.maximum(jerk, _sum(here[i], rows.limits.jerk, used) / axis.jerk)
            changes = [np.abs(np.subtract(b, a)) / step for a, b in zip(here[i], there[i], strict=True)]
            turn = np.maximum(turn, _sum(changes, pulls, used) / axis.jerk)
    return ManyDemands(top, bend, pull, jerk, turn, along)


def _along(direction: Columns, limits: Sequence[float]) -> Column:
    """What the columns can accelerate along the path; 0 where none moves."""
    import numpy as np

    least = np.full(len(direction[0]), inf)
    for limit, way in zip(limits, direction, strict=True):
        least = np.where(way != 0.0, np.minimum(least, limit / np.abs(way)), least)
    return np.where(least < inf, least, 0.0)


def _sum(
    slopes: Sequence[Column | float], limits: Sequence[float], used: Sequence[npt.NDArray[np.bool_]]
) -> Column:
    """How much of an axis the columns in use can ask for together."""
    import numpy as np

    total = np.zeros(len(used[0]))
    for slope, limit, is_used in zip(slopes, limits, used, strict=True):
        total = total + np.where(is_used, np.abs(slope) * limit, 0.0)
    return total


def _within(worst: ManyDemands, length: Column) -> tuple[Column, Column]:
    """Speed and `ease` that meet demands along a length; see `RealAxes._within`."""
    import numpy as np

    top = np.where(worst.bend > NOTHING, np.minimum(worst.top, np.sqrt(BEND / worst.bend)), worst.top)
    bent = np.where(top < inf, worst.bend * top * top, 0.0)
    ease = np.minimum(1.0, (1.0 - bent) / worst.pull)
    turns = worst.turn > NOTHING
    left = np.where(turns, 1.0 - TWIST - TURN, 1.0)
    ease = np.where(worst.jerk > 0.0, np.minimum(ease, left / worst.jerk), ease)
    turning = TURN / (3.0 * worst.turn)
    reached = cube_root(np.where(turns, turning * length * worst.along, 1.0))
    turned = np.minimum(top, np.maximum(turning / ease, reached))
    return np.where(turns, turned, top), np.where(turns, np.minimum(ease, turning / turned), ease)


def _way(axis: Axis, way: Column) -> Column:
    """The shorter way round of a rotary axis."""
    return (way + 180.0) % 360.0 - 180.0 if axis.rotary else way


def cube_root(values: Column) -> Column:
    """To the bits that Python's power has: NumPy has its own."""
    import numpy as np

    return np.array([value ** (1.0 / 3.0) for value in values.tolist()])


def share_ends(worst: float, extent: float) -> list[float]:
    """Where shares end that become shorter towards a place, down to its extent."""
    ends, most = {1.0}, AT_START // 2 - 1
    for span in (-worst, 1.0 - worst):
        if abs(span) > extent:
            shorter = min(SHORTER, (extent / abs(span)) ** (1.0 / most))
            parts = [span * shorter**k for k in range(1, most + 1)]
            ends.update(worst + part for part in parts if abs(part) >= 0.99 * extent)
    return sorted(ends)
