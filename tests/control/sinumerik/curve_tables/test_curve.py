from __future__ import annotations

import pytest

from polycnc.control.sinumerik.curve_tables.curve import ONCE, PERIODIC, PERIODIC_IN_BOTH, CurveTable, Segment


def table(period: int = ONCE, *, downwards: bool = False) -> CurveTable:
    """0 to 10 rises from 0 to 5, 10 to 30 goes on to 9 on a parabola; or the same from 30 to 0."""
    if downwards:
        return CurveTable(
            1, period, (Segment((30.0, -20.0), (9.0, -8.0, 4.0)), Segment((10.0, -10.0), (5.0, -5.0)))
        )
    return CurveTable(1, period, (Segment((0.0, 10.0), (0.0, 5.0)), Segment((10.0, 20.0), (5.0, 0.0, 4.0))))


@pytest.mark.parametrize("downwards", [False, True])
def test_values_and_slopes(downwards: bool) -> None:
    curve = table(downwards=downwards)
    assert curve.at(4.0) == pytest.approx((2.0, 0.5))
    assert curve.at(20.0) == pytest.approx((6.0, 0.2))
    assert curve.at(-3.0) == (0.0, 0.0)
    assert curve.at(99.0) == (9.0, 0.0)
    assert curve.domain == (0.0, 30.0)


def test_a_periodic_table_begins_again() -> None:
    assert table(PERIODIC).at(64.0).place == pytest.approx(2.0)
    assert table(PERIODIC).at(-10.0).place == pytest.approx(6.0)
    assert table(PERIODIC).at(30.0).place == 9.0


def test_a_table_periodic_in_both_goes_on_for_a_coupling() -> None:
    curve = table(PERIODIC_IN_BOTH)
    assert curve.at(34.0).place == pytest.approx(2.0)
    assert curve.followed(34.0).place == pytest.approx(11.0)
    assert curve.followed(-26.0).place == pytest.approx(-7.0)
    assert table(PERIODIC_IN_BOTH, downwards=True).followed(34.0).place == pytest.approx(11.0)


def test_the_inverse_is_the_nearest_and_never_beyond_the_table() -> None:
    curve = table()
    assert curve.inverse(2.0, 50.0) == pytest.approx((4.0, 0.5))
    assert curve.inverse(6.0, 0.0)[0] == pytest.approx(20.0)
    assert curve.inverse(77.0, 0.0)[0] == pytest.approx(30.0)
    assert table(PERIODIC).inverse(2.0, 63.0)[0] == pytest.approx(64.0)


def test_extremes_count_turns_within() -> None:
    hill = CurveTable(1, ONCE, (Segment((0.0, 10.0), (0.0, 8.0, -8.0)),))
    assert hill.extremes(0.0, 10.0) == pytest.approx((0.0, 2.0))
    assert hill.extremes(7.5, 10.0) == pytest.approx((0.0, 1.5))


def test_a_jump_takes_place_where_the_leading_axis_stands() -> None:
    steps = (Segment((0.0, 1.0), (2.0,)), Segment((1.0,), (2.0, 3.0)), Segment((1.0, 1.0), (5.0,)))
    curve = CurveTable(1, ONCE, steps)
    assert [curve.at(place).place for place in (0.99, 1.0, 1.5)] == [2.0, 5.0, 5.0]
    assert (steps[1].is_jump, steps[0].is_straight, steps[0].polynomials) == (True, True, 0)
