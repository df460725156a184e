from __future__ import annotations

from itertools import pairwise
from math import cos, hypot, pi, sin, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.geometry.nurbs import nurbs_chords, nurbs_point

QUARTER = ([(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], [1.0, sqrt(0.5), 1.0])
CLAMPED = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]


def test_a_clamped_curve_of_order_three_is_a_bezier_curve() -> None:
    poles = [(0.0, 0.0), (0.0, 5.0), (5.0, 5.0)]
    assert nurbs_point(0.5, 3, CLAMPED, poles, [1.0, 1.0, 1.0]) == pytest.approx((1.25, 3.75))


@given(st.floats(0.0, 1.0))
def test_weights_make_an_exact_quarter_of_a_circle(u: float) -> None:
    poles, weights = QUARTER
    assert hypot(*nurbs_point(u, 3, CLAMPED, poles, weights)) == pytest.approx(1.0)


def test_order_two_is_the_polygon_of_the_poles() -> None:
    poles = [(0.0, 0.0), (4.0, 0.0), (4.0, 2.0)]
    knots = [0.0, 0.0, 1.0, 2.0, 2.0]
    assert list(nurbs_chords(2, knots, poles, [1.0, 1.0, 1.0], 0.001)) == poles


def test_chords_stay_within_their_tolerance_and_end_in_the_last_pole() -> None:
    poles, weights = QUARTER
    points = list(nurbs_chords(3, CLAMPED, poles, weights, 0.0001))
    assert points[0] == pytest.approx((1.0, 0.0))
    assert points[-1] == pytest.approx((0.0, 1.0))
    for a, b in pairwise(points):
        middle = hypot((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
        assert 1.0 - middle < 0.0002


def test_repeated_inner_knots_pass_through_their_pole() -> None:
    poles = [(cos(i * pi / 8), sin(i * pi / 8)) for i in range(5)]
    knots = [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0]
    assert nurbs_point(1.0, 3, knots, poles, [1.0] * 5) == pytest.approx(poles[2])
