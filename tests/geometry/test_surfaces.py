"""Where a straight way first touches a surface."""

from __future__ import annotations

from math import dist, hypot

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from polycnc.geometry.surfaces import Surface, first_touch

Point = tuple[float, float, float]
numbers = st.floats(-50.0, 50.0)
points = st.tuples(numbers, numbers, numbers)
START: Point = (0.0, 0.0, 0.0)


def along(start: Point, end: Point, share: float) -> Point:
    x, y, z = (a + (b - a) * share for a, b in zip(start, end, strict=True))
    return x, y, z


def test_a_plane_is_touched_from_outside_only() -> None:
    plane = Surface((10.0, 0.0, 0.0), direction=(-2.0, 0.0, 0.0), tip=1.0)
    assert plane.touched(START, (20.0, 5.0, 0.0)) == pytest.approx(9.0 / 20.0)
    assert plane.touched((20.0, 0.0, 0.0), START) is None
    assert plane.touched(START, (8.9, 0.0, 0.0)) is None


def test_a_bore_is_touched_from_inside() -> None:
    bore = Surface(START, direction=(0.0, 0.0, 1.0), radius=20.0, inside=True, tip=2.0)
    assert bore.touched(START, (0.0, 36.0, 7.0)) == pytest.approx(0.5)
    assert bore.touched(START, (10.0, 10.0, 90.0)) is None


def test_leaving_a_surface_does_not_touch_it() -> None:
    ball = Surface(START, radius=10.0)
    assert ball.touched((10.0, 0.0, 0.0), (30.0, 0.0, 0.0)) is None
    assert ball.touched((10.0, 0.0, 0.0), (-30.0, 0.0, 0.0)) == pytest.approx(0.0, abs=1e-9)


def test_the_first_of_several_surfaces_counts() -> None:
    near, far = (Surface((x, 0.0, 0.0), direction=(-1.0, 0.0, 0.0)) for x in (5.0, 8.0))
    assert first_touch((far, near), START, (10.0, 0.0, 0.0)) == pytest.approx(0.5)
    assert first_touch((), START, (10.0, 0.0, 0.0)) is None


@given(points, points, points, st.floats(1.0, 30.0), st.floats(0.0, 5.0))
def test_the_tip_lies_against_the_ball_where_it_touches(
    start: Point, end: Point, center: Point, radius: float, tip: float
) -> None:
    assume(dist(start, end) > 1e-3 and dist(start, center) > radius + tip + 1e-3)
    share = Surface(center, radius=radius, tip=tip).touched(start, end)
    steps = [along(start, end, k / 500.0) for k in range(501)]
    if share is None:
        assert all(dist(point, center) > radius + tip - 1e-6 for point in steps)
    else:
        assert dist(along(start, end, share), center) == pytest.approx(radius + tip, abs=1e-6)
        before = [along(start, end, share * k / 500.0) for k in range(500)]
        assert all(dist(point, center) > radius + tip - 1e-6 for point in before)


@given(points, points, st.floats(0.001, 20.0))
def test_the_tip_stays_inside_a_bore_until_it_touches(start: Point, end: Point, room: float) -> None:
    radius = hypot(start[0], start[1]) + 0.01 + room
    assume(hypot(end[0] - start[0], end[1] - start[1]) > 1e-3)
    share = Surface(START, direction=(0.0, 0.0, 1.0), radius=radius, inside=True).touched(start, end)
    if share is None:
        assert hypot(end[0], end[1]) < radius + 1e-6
    else:
        assert hypot(*along(start, end, share)[:2]) == pytest.approx(radius, abs=1e-6)
