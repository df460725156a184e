from __future__ import annotations

from math import cos, hypot, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.geometry.zones import area, first_contact, is_convex, moved, overlaps

SQUARE = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0), (0.0, 0.0)]
CIRCLE = [(2.0 * cos(2.0 * pi * k / 360), 2.0 * sin(2.0 * pi * k / 360)) for k in range(361)]
OUTSIDE = SQUARE[::-1]


def test_an_outline_counts_counter_clockwise_as_positive() -> None:
    assert area(SQUARE) == 100.0
    assert area(OUTSIDE) == -100.0
    assert is_convex(SQUARE)
    assert not is_convex([(0.0, 0.0), (10.0, 0.0), (5.0, 2.0), (0.0, 10.0), (0.0, 0.0)])


def test_touching_outlines_do_not_overlap() -> None:
    assert not overlaps(moved(SQUARE, (10.0, 0.0)), SQUARE)
    assert overlaps(moved(SQUARE, (9.99, 0.0)), SQUARE)
    assert overlaps(SQUARE, SQUARE)
    assert overlaps(
        moved(SQUARE, (0.0, 0.0)), [(-5.0, -5.0), (50.0, -5.0), (50.0, 50.0), (-5.0, 50.0), (-5.0, -5.0)]
    )


def test_what_a_clockwise_outline_protects_lies_outside_it() -> None:
    assert not overlaps([(5.0, 5.0)], OUTSIDE)
    assert overlaps([(11.0, 5.0)], OUTSIDE)
    assert first_contact([(5.0, 5.0)], OUTSIDE, (10.0, 0.0)) == pytest.approx(0.5)


def test_a_circle_meets_a_corner_where_its_radius_ends() -> None:
    part = first_contact(CIRCLE, moved(SQUARE, (10.0, 5.0)), (35.0, 20.0))
    assert part is not None
    assert hypot(10.0 - 35.0 * part, 5.0 - 20.0 * part) == pytest.approx(2.0, abs=1e-3)


def test_sliding_along_a_border_is_no_contact() -> None:
    assert first_contact([(-5.0, 10.0)], SQUARE, (30.0, 0.0)) is None
    assert first_contact(moved(SQUARE, (-20.0, 10.0)), SQUARE, (60.0, 0.0)) is None


@given(
    st.floats(-30.0, 30.0),
    st.floats(-30.0, 30.0),
    st.floats(-1.0, 1.0).filter(lambda x: abs(x) > 0.05),
    st.floats(-1.0, 1.0),
)
def test_before_the_first_contact_nothing_overlaps(u: float, v: float, du: float, dv: float) -> None:
    tool = moved(CIRCLE[::30], (u, v))
    way = (60.0 * du, 60.0 * dv)
    part = first_contact(tool, SQUARE, way)
    last = 1.0 if part is None else min(part, 1.0)
    for k in range(20):
        share = last * k / 20.0
        if part is None or share < part - 1e-3:
            assert not overlaps(moved(tool, (way[0] * share, way[1] * share)), SQUARE) or part == 0.0
