"""Cubic and Akima splines go through their points, smoothly, and are what their ends say."""

from __future__ import annotations

from itertools import pairwise
from math import cos, hypot, pi, sin
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.geometry.through_points import End, akima_tangents, chords, cubic_tangents, lengths

if TYPE_CHECKING:
    from numpy.typing import NDArray

coordinates = st.tuples(st.floats(-50.0, 50.0), st.floats(-50.0, 50.0))
polygons = st.lists(coordinates, min_size=3, max_size=12).filter(lambda points: min(lengths(points)) > 1.0)


@given(polygons, st.sampled_from(End), st.sampled_from(End))
def test_the_curvature_of_a_cubic_spline_does_not_jump(
    points: list[tuple[float, float]], start: End, end: End
) -> None:
    tangents, h = cubic_tangents(points, start, end), lengths(points)
    for i in range(1, len(points) - 1):
        for axis in range(2):
            before = (points[i][axis] - points[i - 1][axis]) / h[i - 1]
            after = (points[i + 1][axis] - points[i][axis]) / h[i]
            left = (2.0 * tangents[i - 1][axis] + 4.0 * tangents[i][axis] - 6.0 * before) / h[i - 1]
            right = (6.0 * after - 4.0 * tangents[i][axis] - 2.0 * tangents[i + 1][axis]) / h[i]
            assert left == pytest.approx(right, rel=1e-6, abs=1e-6)


@given(polygons)
def test_a_straight_end_has_no_curvature(points: list[tuple[float, float]]) -> None:
    for tangents in (
        cubic_tangents(points, End.STRAIGHT, End.STRAIGHT), akima_tangents(points, End.STRAIGHT, End.STRAIGHT)
    ):  # fmt: skip
        h = lengths(points)[0]
        for axis in range(2):
            slope = (points[1][axis] - points[0][axis]) / h
            assert 6.0 * slope - 4.0 * tangents[0][axis] - 2.0 * tangents[1][axis] == pytest.approx(
                0.0, abs=1e-6
            )


@pytest.mark.parametrize("make", [cubic_tangents, akima_tangents])
def test_a_tangent_that_is_given_is_kept(make: type) -> None:
    points = [(0.0, 0.0), (10.0, 10.0), (20.0, 0.0), (30.0, 10.0)]
    tangents = make(points, (1.0, 0.0), (0.0, 1.0))
    assert tangents[0] == [1.0, 0.0]
    assert tangents[-1] == [0.0, 1.0]


@pytest.mark.parametrize("make", [cubic_tangents, akima_tangents])
def test_points_on_a_line_give_the_line(make: type) -> None:
    points = [(float(k), 2.0 * k) for k in range(6)]
    for tangent in make(points, End.FREE, End.FREE):
        assert tangent == pytest.approx([1.0 / hypot(1.0, 2.0), 2.0 / hypot(1.0, 2.0)])


def test_a_free_end_is_near_the_circle_on_which_the_points_lie() -> None:
    points = [(10.0 * cos(k * pi / 8), 10.0 * sin(k * pi / 8)) for k in range(9)]
    tangents = cubic_tangents(points, End.FREE, End.FREE)
    for (a, b), (s, t) in zip(pairwise(points), pairwise(tangents), strict=True):
        for _, point in chords(a, b, s, t, 0.001):
            assert hypot(*point) == pytest.approx(10.0, abs=0.02)


@settings(max_examples=40)
@given(coordinates, coordinates, st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_chords_stay_within_their_tolerance(
    start: tuple[float, float], end: tuple[float, float], turn: float, back: float
) -> None:
    tangents = (cos(turn), sin(turn)), (cos(back), sin(back))
    coarse = np.array([start, *(point for _, point in chords(start, end, *tangents, 0.1))])
    fine = [point for _, point in chords(start, end, *tangents, 1e-3)]
    assert coarse[-1].tolist() == list(end)
    assert max(_off(np.array(point), coarse) for point in fine) < 0.101


def _off(point: NDArray[np.float64], polygon: NDArray[np.float64]) -> float:
    """How far a point is from a polygon."""
    start, way = polygon[:-1], np.diff(polygon, axis=0)
    along = ((point - start) * way).sum(axis=1) / np.maximum((way**2).sum(axis=1), 1e-300)
    nearest = start + np.clip(along, 0.0, 1.0)[:, None] * way
    return float(np.hypot(*(nearest - point).T).min())
