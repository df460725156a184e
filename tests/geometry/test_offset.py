"""Parallel edges: where they meet, and when they run backwards."""

from __future__ import annotations

import itertools
from math import atan2, cos, degrees, hypot, pi, radians, sin
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.geometry import offset
from polycnc.geometry.offset import Edge, Joint, Outer

if TYPE_CHECKING:
    from polycnc.geometry.arcs import Point

ALONG = offset.line((-10, 0), (0, 0))
UP = offset.line((0, 0), (0, 10))
ROUND = offset.arc((0, 0), (-10, 10), (-10, 0), True)


@pytest.mark.parametrize(
    ("a", "b", "turn"), [(ALONG, UP, 90), (UP, offset.line((0, 10), (5, 10)), -90), (ALONG, ROUND, 90)]
)
def test_turns(a: Edge, b: Edge, turn: float) -> None:
    assert degrees(offset.turn(a, b)) == pytest.approx(turn)


@pytest.mark.parametrize(
    ("a", "b", "left_a", "left_b", "point"),
    [
        (ALONG, UP, 2, 2, (-2, 2)),
        (ALONG, UP, -2, -2, (2, -2)),
        (ALONG, UP, 2, -3, (3, 2)),
        (ALONG, offset.line((0, 0), (5, 0)), 2, 2, (0, 2)),
        (ALONG, offset.line((0, 0), (5, 0)), 2, -2, None),
        (ALONG, offset.line((0, 0), (-5, 0)), 2, 2, None),
        # y = 2 and the circle of 8 about (-10, 0).
        (ALONG, ROUND, 2, 2, (-10 + 60**0.5, 2)),
        (offset.line((0, 10), (0, 0)), offset.arc((0, 0), (10, 0), (5, 0), True), -12, -10, None),
    ],
)
def test_where_parallels_meet(a: Edge, b: Edge, left_a: float, left_b: float, point: Point | None) -> None:
    met = offset.meet(a, b, left_a, left_b)
    assert met == (None if point is None else pytest.approx(point))


def test_of_two_intersections_the_one_by_the_corner_is_meant() -> None:
    a = offset.arc((-20, 0), (12, 16), (0, 0), False)
    b = offset.arc((12, 16), (44, 0), (24, 0), False)
    met = offset.meet(a, b, 5, 5)
    assert met == pytest.approx((12, (625 - 144) ** 0.5))


@pytest.mark.parametrize(
    ("edge", "first", "last", "reversed_"),
    [
        (offset.line((0, 0), (10, 0)), (4, 5), (-4, 5), False),
        (offset.line((0, 0), (10, 0)), (6, 5), (-6, 5), True),
        (offset.arc((10, 0), (0, 10), (0, 0), True), (-2, 1), (1, -2), False),
        (offset.arc((10, 0), (0, 10), (0, 0), True), (-6, 6), (6, -6), True),
        # 330 degrees, cut by 10 at either end: the chord changes much, the arc runs on.
        (offset.arc((10, 0), (8.660254, -5), (0, 0), True), (-0.15, 1.7), (-0.7, -1.4), False),
        (offset.arc((10, 0), (10, 0), (0, 0), False), (-2, 0), (-2, 0), False),
    ],
)
def test_when_a_parallel_runs_backwards(edge: Edge, first: Point, last: Point, reversed_: bool) -> None:
    assert offset.reverses(edge, first, last) == reversed_


@pytest.mark.parametrize(
    ("center", "radius", "meets"),
    [(10.1, 0.1, True), (10.1005, 0.1, True), (10.102, 0.1, False), (9.9, 0.1, True), (9.898, 0.1, False)],
)
def test_a_small_circle_beside_a_large_one_meets_it_by_its_gap(
    center: float, radius: float, *, meets: bool
) -> None:
    large = offset.arc((0.0, -10.0), (10.0, 0.0), (0.0, 0.0), ccw=True)
    small = offset.arc((center - radius, 0.0), (center + radius, 0.0), (center, 0.0), ccw=True)
    assert bool(offset.crossings(large, small, 0.0, 0.0)) is meets


def test_no_vector_for_an_inner_corner_that_does_not_exist() -> None:
    # Two bows of radius 8, centres 12 apart, meet in a dent that a tool of 5 does not reach.
    height = (64 - 36) ** 0.5
    one = offset.arc((-14, 0), (0, height), (-6, 0), True)
    two = offset.arc((0, height), (14, 0), (6, 0), True)
    assert offset.corner(one, two, 1, Outer()) is not None
    assert offset.corner(one, two, 5, Outer()) is None


def test_smooth_transitions_have_one_vector() -> None:
    corner = offset.corner(ALONG, offset.arc((0, 0), (10, 10), (0, 10), True), 3, Outer())
    assert corner is not None
    assert corner.vectors == [(0, 3)]


def test_turning_back_is_an_outer_corner_on_both_sides() -> None:
    back = offset.line((0, 0), (-10, 0))
    for distance in (2, -2):
        corner = offset.corner(ALONG, back, distance, Outer())
        assert corner is not None
        assert corner.vectors[0] == pytest.approx((2, distance))
        assert corner.vectors[1] == pytest.approx((2, -distance))


@given(st.floats(1, 175), st.floats(0.1, 50), st.floats(-180, 180))
def test_every_vector_is_at_least_the_offset_away_from_the_corner(
    turn: float, radius: float, heading: float
) -> None:
    a, b = radians(heading), radians(heading - turn)
    first = offset.line((-200 * cos(a), -200 * sin(a)), (0, 0))
    second = offset.line((0, 0), (200 * cos(b), 200 * sin(b)))
    for outer in (
        Outer(),
        Outer(0.0, Joint.ARC),
        Outer(100.0, Joint.ARC),
        Outer(0.0, Joint.ARC, False, 40.0),
    ):
        corner = offset.corner(first, second, radius, outer)
        assert corner is not None
        for u, v in corner.vectors:
            assert hypot(u, v) >= radius - 1e-9
            # The distance from both straight lines is the offset or more.
            assert -u * sin(a) + v * cos(a) <= radius + 1e-9
        angles = [atan2(v, u) for u, v in corner.vectors]
        steps = [(y - x + pi) % (2 * pi) - pi for x, y in itertools.pairwise(angles)]
        assert all(step <= 1e-9 for step in steps)
