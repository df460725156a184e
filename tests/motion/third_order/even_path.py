"""A simple bent path to compare with: the whole path rounded evenly, as wide as its worst place allows."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from polycnc.motion.third_order.bent_path import BentPath

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from polycnc.machine import Machine

Numbers: TypeAlias = "NDArray[np.float64]"


def even_path(points: Numbers, tolerance: float, feed: float, machine: Machine) -> BentPath:
    """Points (m, n) of a path, close together, as a cubic B-spline with even knots whose control points lie on it."""
    steps = np.sqrt((np.diff(points, axis=0) ** 2).sum(1))
    points = points[np.append(True, steps > 1e-9)]
    ways = np.append(0.0, np.cumsum(steps[steps > 1e-9]))
    low, high = 4, 40_000  # numbers of pieces
    while high > low + max(low // 50, 1):
        count = (low + high) // 2
        low, high = (low, count) if _off(ways, points, count) <= tolerance else (count, high)
    return _bent(ways, points, high, feed, machine)


def _between(way: Numbers, values: Numbers, places: Numbers) -> Numbers:
    return np.stack([np.interp(places, way, column) for column in values.T], axis=1)


def _off(ways: Numbers, points: Numbers, count: int) -> float:
    """How far the path is left at most, looked at between the knots too."""
    path = _bent(ways, points, count, 1.0, None)
    fine = np.unique(np.concatenate([ways, np.linspace(0.0, ways[-1], 4 * count + 1)]))
    return float(np.sqrt(((path.at(fine)[0] - _between(ways, points, fine)) ** 2).sum(1)).max())


def _bent(ways: Numbers, points: Numbers, count: int, feed: float, machine: Machine | None) -> BentPath:
    way = np.linspace(0.0, ways[-1], count + 1)
    knots = np.concatenate([np.zeros(3), way, np.full(3, ways[-1])])
    greville = (knots[1:-3] + knots[2:-2] + knots[3:-1]) / 3.0
    controls = _between(ways, points, greville)
    slopes = np.diff(controls, axis=0) / np.diff(greville)[:, None]
    middles = 0.5 * (knots[2:-3] + knots[3:-2])
    second = np.diff(slopes, axis=0) / np.diff(middles)[:, None]
    step = np.diff(way)[:, None]
    growth = 0.5 * step * (second[1:] + second[:-1])
    first = slopes[0] + np.concatenate([np.zeros_like(second[:1]), np.cumsum(growth, axis=0)])
    moves = step * (first[:-1] + step * (second[:-1] / 3.0 + second[1:] / 6.0))
    place = controls[0] + np.concatenate([np.zeros_like(second[:1]), np.cumsum(moves, axis=0)])
    cap2 = np.full(count, feed**2)
    if machine is not None:
        tops = np.array([axis.max_feed for axis in machine.axes[: points.shape[1]]])
        most = np.maximum(np.abs(first[1:]), np.abs(first[:-1]))
        cap2 = np.minimum(cap2, ((tops / np.maximum(most, 1e-9)) ** 2).min(1))
    row = np.zeros(count, np.int64)
    return BentPath(way, place, first, second, cap2, np.ones(count), row, np.zeros(1, np.int64), ways[-1:])
