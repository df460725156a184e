"""Points of hole patterns."""

from __future__ import annotations

from itertools import pairwise
from math import hypot

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.cycles.drilling import patterns

COUNTS = st.integers(1, 40)
NUMBERS = st.floats(-500.0, 500.0)


@given(NUMBERS, NUMBERS, st.floats(0.1, 300.0), NUMBERS, COUNTS)
def test_a_circle_is_evenly_spaced(x: float, y: float, radius: float, start: float, count: int) -> None:
    points = list(patterns.circle((x, y), radius, start, count))
    assert len(points) == count
    assert all(hypot(px - x, py - y) == pytest.approx(radius, abs=1e-6) for px, py in points)
    assert (sum(p[0] for p in points) / count, sum(p[1] for p in points) / count) == pytest.approx(
        (x, y) if count > 1 else points[0], abs=1e-6
    )


@given(st.floats(0.1, 300.0), NUMBERS, st.integers(2, 40))
def test_a_negative_count_goes_round_the_other_way(radius: float, start: float, count: int) -> None:
    there = list(patterns.circle((0.0, 0.0), radius, start, count))
    back = list(patterns.circle((0.0, 0.0), radius, start, -count))
    assert back[0] == there[0]
    for a, b in zip(back[1:], reversed(there[1:]), strict=True):
        assert a == pytest.approx(b, abs=1e-6)


def test_a_line_runs_along_its_angle() -> None:
    points = list(patterns.line((1.0, 2.0), 5.0, 90.0, 3))
    assert points == [(1.0, 2.0), (1.0, 7.0), (1.0, 12.0)]


def test_an_arc_goes_on_by_its_pitch() -> None:
    points = list(patterns.arc((0.0, 0.0), 2.0, 0.0, -90.0, 3))
    assert points == [(2.0, 0.0), (0.0, -2.0), (-2.0, 0.0)]


@given(st.integers(1, 9), st.integers(1, 9))
def test_a_grid_visits_every_point_once_by_single_steps(columns: int, rows: int) -> None:
    points = list(patterns.grid((0.0, 0.0), (3.0, 4.0), columns, rows))
    assert sorted(points) == sorted((3.0 * i, 4.0 * j) for i in range(columns) for j in range(rows))
    steps = [hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(points)]
    assert set(steps) <= {3.0, 4.0}
