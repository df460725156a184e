"""The least time of a path within speed, acceleration and jerk: a discretised optimum, independent of the planner.

The path is what the program says, rounded evenly within its tolerance: averaged over its length under a tent, as wide
as the tolerance allows. Along it the square x of the speed has one unknown for each of some hundred places. Speed and
acceleration bound it linearly. The jerk, `√x·d(q''·x + q'·x'/2)/ds <= j`, is linear but for `j/√x`, which is convex:
its tangent at the speeds found so far leaves the jerk within its limit (F. Debrouwere et al., "Time-Optimal Path
Following for Robots With Convex-Concave Constraints Using Sequential Convex Programming", IEEE T-RO 29, 2013). Linear
programmes one after another lead to the optimum.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from polycnc.machine import Machine

Numbers: TypeAlias = "NDArray[np.float64]"
#: Unknowns, linear programmes at most, part of the time below which another one is not worth its while.
PLACES, PROGRAMMES, GAIN = 320, 25, 0.002
#: Points of the path that derivatives are taken from, at most.
FINE = 24_000


def least_time(points: Numbers, tolerance: float, feed: float, machine: Machine) -> float:
    """Seconds from rest to rest along a path.

    Args:
        points: Of the path, (m, n), so close together that it is a row of lines.
        tolerance: How far it may be left, mm.
        feed: Highest speed along it, mm/s.
        machine: Its first n axes have the limits.
    """
    axes = machine.axes[: points.shape[1]]
    way, places, width = rounded(points, tolerance)
    nodes = _nodes(way, places, width)
    first = _derivative(places, way[1])
    second = _derivative(first, way[1])
    at = _Path(
        nodes,
        *(_between(way, values, nodes) for values in (first, second)),
        *(_between(way, values, 0.5 * (nodes[1:] + nodes[:-1])) for values in (first, second)),
    )
    tops = np.array([axis.max_feed for axis in axes])
    cap2 = np.min(
        np.append((tops / np.maximum(np.abs(at.first), 1e-9)) ** 2, np.full((len(nodes), 1), feed**2), 1), 1
    )
    pulls, jerks = np.array([axis.acceleration for axis in axes]), np.array([axis.jerk for axis in axes])
    return _optimum(at, cap2, pulls, jerks)


class _Path:
    """Derivatives by the way at places, and in the middles between them."""

    def __init__(
        self, way: Numbers, first: Numbers, second: Numbers, first_m: Numbers, second_m: Numbers
    ) -> None:
        self.way, self.step = way, np.diff(way)
        self.first, self.second, self.first_m, self.second_m = first, second, first_m, second_m


def rounded(points: Numbers, tolerance: float) -> tuple[Numbers, Numbers, float]:
    """Way, points at even distances on the path rounded within a tolerance, and half the width of the tent."""
    steps = np.sqrt((np.diff(points, axis=0) ** 2).sum(1))
    points = points[np.append(True, steps > 1e-9)]
    ways = np.append(0.0, np.cumsum(steps[steps > 1e-9]))
    low, high = 0.0, 0.25 * ways[-1]
    for _ in range(14):
        width = 0.5 * (low + high)
        way, path = _even(points, ways, width)
        off = np.sqrt(((_averaged(path, width / way[1]) - path) ** 2).sum(1)).max()
        low, high = (width, high) if off <= tolerance else (low, width)
    way, path = _even(points, ways, low)
    return way, _averaged(path, low / way[1]), low


def _even(points: Numbers, ways: Numbers, width: float) -> tuple[Numbers, Numbers]:
    count = int(np.clip(10.0 * ways[-1] / max(width, 1e-9), 2000, FINE))
    way = np.linspace(0.0, ways[-1], count + 1)
    return way, _between(ways, points, way)


def _averaged(path: Numbers, half: float) -> Numbers:
    """The average under a tent of `half` steps either way; beyond its ends the path goes on turned round."""
    reach = int(np.ceil(half))
    if reach < 1 or reach >= len(path):
        return path
    tent = np.maximum(half - np.abs(np.arange(-reach, reach + 1)), 0.0)
    tent /= tent.sum()
    before, behind = 2.0 * path[0] - path[reach:0:-1], 2.0 * path[-1] - path[-2 : -reach - 2 : -1]
    long = np.concatenate([before, path, behind])
    return np.stack([np.convolve(column, tent, "valid") for column in long.T], axis=1)


def _derivative(values: Numbers, step: float) -> Numbers:
    return np.gradient(values, step, axis=0)


def _between(way: Numbers, values: Numbers, places: Numbers) -> Numbers:
    return np.stack([np.interp(places, way, column) for column in values.T], axis=1)


def _nodes(way: Numbers, path: Numbers, width: float) -> Numbers:
    """Places of the unknowns: closer near both ends and where the path turns."""
    length = way[-1]
    turn = np.sqrt((np.gradient(np.gradient(path, way, axis=0), way, axis=0) ** 2).sum(1))
    reach = max(int(width / way[1]), 1)
    near = np.convolve(turn, np.ones(2 * reach + 1) / (2 * reach + 1), "same")
    near = np.sqrt(near)
    ends = 1.0 / np.sqrt(np.minimum(way, length - way) + 1e-3 * length)
    density = (
        0.3 / length + 0.5 * near / max(np.trapezoid(near, way), 1e-12) + 0.2 * ends / np.trapezoid(ends, way)
    )
    if near.max() < 1e-9:
        density = 0.6 / length + 0.4 * ends / np.trapezoid(ends, way)
    share = np.append(0.0, np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(way)))
    return np.interp(np.linspace(0.0, share[-1], PLACES + 1), share, way)


def _seconds(step: Numbers, x: Numbers) -> float:
    speed = np.sqrt(np.maximum(x, 0.0))
    return float(np.sum(2.0 * step / np.maximum(speed[1:] + speed[:-1], 1e-12)))


def _optimum(path: _Path, cap2: Numbers, pulls: Numbers, jerks: Numbers) -> float:
    from scipy.optimize import linprog
    from scipy.sparse import coo_matrix, vstack

    step, count = path.step, len(path.step)
    here = np.arange(count)

    def rows(columns: Sequence[tuple[NDArray[np.intp], Numbers]], number: int) -> coo_matrix:
        row = np.concatenate([np.arange(number) for _ in columns])
        return coo_matrix(
            (np.concatenate([value for _, value in columns]), (row, np.concatenate([c for c, _ in columns]))),
            shape=(number, count + 1),
        )

    fixed, jolts, inside = [], [], np.arange(1, count)
    span = 0.5 * (step[1:] + step[:-1])
    for i in range(path.first.shape[1]):
        push = path.first_m[:, i] / (2.0 * step)
        bend = 0.5 * path.second_m[:, i]
        accelerates = rows([(here, bend - push), (here + 1, bend + push)], count).tocsr()
        fixed += [accelerates / pulls[i], -accelerates / pulls[i]]
        jolt = (accelerates[1:] - accelerates[:-1]).multiply(1.0 / (jerks[i] * span[:, None]))
        jolts += [jolt, -jolt]
    best, idle, cap2 = np.inf, 0, cap2.copy()
    cap2[0] = cap2[-1] = 0.0
    # From rest the way grows with the third power of time.
    for end, nearest in ((0, 1), (-1, -2)):
        jerk = float(np.min(jerks / np.maximum(np.abs(path.first_m[end]), 1e-9)))
        cap2[nearest] = min(cap2[nearest], 0.25 * jerk**2 * (6.0 * step[end] / jerk) ** (4.0 / 3.0))
    scale = float(np.max(cap2))
    x = 1e-3 * np.minimum(cap2, scale) + 1e-9 * scale
    for _ in range(PROGRAMMES):
        inner = np.maximum(x[1:-1], 1e-6 * scale)
        tangent, slope = 1.5 / np.sqrt(inner), 0.5 / inner**1.5
        own = coo_matrix((slope / tangent, (inside - 1, inside)), shape=(count - 1, count + 1))
        bent = [jolt.multiply(1.0 / tangent[:, None]) + own for jolt in jolts]
        speed = np.sqrt(np.maximum(x, 1e-9 * scale))
        sums = (speed[1:] + speed[:-1]) ** 2
        worth = np.zeros(count + 1)
        worth[:-1] += step / sums / speed[:-1]
        worth[1:] += step / sums / speed[1:]
        solve = partial(
            linprog,
            -worth * scale,
            A_ub=vstack([*fixed, *bent]).tocsr() * scale,
            b_ub=np.ones(len(fixed) * count + len(bent) * (count - 1)),
            bounds=np.stack([np.zeros(count + 1), cap2 / scale], axis=1),
        )
        found = solve(method="highs-ipm")
        if found.status != 0:  # now and then the quick method finds nothing
            found = solve(method="highs-ds")
        assert found.status == 0, found.message
        aim = np.maximum(found.x * scale, 0.0)
        seconds, share = min((_seconds(step, x + share * (aim - x)), share) for share in (1.0, 0.6, 0.3))
        x = x + share * (aim - x)
        idle = idle + 1 if seconds > best * (1.0 - GAIN) else 0
        best = min(best, seconds)
        if idle == 2:
            break
    return best
