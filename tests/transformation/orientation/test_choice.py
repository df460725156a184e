from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.transformation.orientation import choice

turns = st.floats(-2000.0, 2000.0)


@given(turns, turns)
def test_the_nearest_turn_is_no_more_than_half_a_round_away(angle: float, near: float) -> None:
    found = choice.on_nearest_turn(angle, near)
    assert abs(found - near) <= 180.0 + 1e-9
    assert (found - angle) / 360.0 == pytest.approx(round((found - angle) / 360.0), abs=1e-9)


@given(turns)
def test_a_signed_angle_is_the_same_direction(angle: float) -> None:
    assert -180.0 <= choice.signed(angle) < 180.0
    assert (choice.signed(angle) - angle) / 360.0 == pytest.approx(
        round((choice.signed(angle) - angle) / 360.0), abs=1e-9
    )


def test_the_shortest_way_wins_and_of_equal_ones_the_first() -> None:
    a, b, c = {"B": 30.0, "C": 10.0}, {"B": -30.0, "C": 190.0}, {"B": -30.0, "C": -10.0}
    assert choice.nearest([b, a, c], {}) is a
    assert choice.nearest([b, c, a], {"C": 180.0}) is b
    assert choice.nearest([], {}) is None


def test_by_the_way_of_one_axis_noise_does_not_decide() -> None:
    near = {"B": 0.0, "C": 0.0}
    far, close = {"B": 10.0 - 1e-8, "C": 50.0}, {"B": -10.0, "C": 5.0}
    assert choice.by_way_of([far, close], near, "B") == [close, far]
    assert choice.by_way_of([far, {"B": 2.0, "C": 170.0}], near, "B")[0]["B"] == 2.0


@pytest.mark.parametrize(("sense", "found"), [(0, -10.0), (1, 350.0), (-1, -10.0)])
def test_an_axis_is_led_in_a_direction(sense: int, found: float) -> None:
    assert choice.led({"B": 5.0, "C": -10.0}, {"C": 0.0}, "C", sense) == {"B": 5.0, "C": found}


@pytest.mark.parametrize(
    ("low", "high", "found"),
    [(-180.0, 180.0, -80.0), (0.0, 360.0, 280.0), (-500.0, -400.0, -440.0), (0.0, 90.0, None)],
)
def test_an_angle_is_taken_on_a_turn_within_reach(low: float, high: float, found: float | None) -> None:
    assert choice.on_reachable_turn(-80.0, low, high) == found


def test_axes_with_ranges_take_the_turn_that_is_nearest_within() -> None:
    near = {"A": 0.0, "C": 350.0}
    assert choice.on_turns_within({"A": 10.0, "C": 370.0}, near, {"C": (0.0, 355.0)}) == {
        "A": 10.0,
        "C": 10.0,
    }
    assert choice.on_turns_within({"A": 10.0, "C": 370.0}, near, {"C": (0.0, 720.0)}) == {
        "A": 10.0,
        "C": 370.0,
    }
    assert choice.on_turns_within({"A": 10.0, "C": 370.0}, near, {"A": (-5.0, 5.0)}) is None
    assert choice.all_within({"A": 10.0}, {"A": (0.0, 10.0), "B": (1.0, 2.0)})
    assert not choice.all_within({"A": 10.1}, {"A": (0.0, 10.0)})
