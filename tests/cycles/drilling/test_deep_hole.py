"""Deep holes: how the depth is divided, and the strokes."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from polycnc.cycles.drilling.deep_hole import automatic_limit, degressive_depths, peck, tap_in_steps
from polycnc.cycles.drilling.holes import Action

SIZES = st.floats(0.5, 200.0)


@pytest.mark.parametrize(
    ("first", "total", "by", "shortest", "expected"),
    [
        (12.0, 29.0, 4.0, 0.0, [12, 20, 24, 26.5, 29]),
        (12.0, 30.0, 4.0, 0.0, [12, 20, 24, 27, 30]),
        (16.0, 40.0, -0.5, 5.0, [16, 24, 29, 34, 37, 40]),
        (10.0, 25.0, 0.0, 0.0, [10, 17.5, 25]),
        (10.0, 30.0, 0.0, 0.0, [10, 20, 30]),
        (50.0, 30.0, 4.0, 0.0, [30]),
    ],
)
def test_strokes_become_shorter_as_told(
    first: float, total: float, by: float, shortest: float, expected: list[float]
) -> None:
    assert degressive_depths(first, total, by, shortest) == pytest.approx(expected)


@given(SIZES, SIZES, st.floats(0.2, 20.0) | st.floats(-1.0, -0.01) | st.just(0.0), st.floats(0.0, 10.0))
@example(0.5, 0.5000000000000001, 0.0, 0.0)
def test_strokes_go_down_to_exactly_the_depth(first: float, total: float, by: float, shortest: float) -> None:
    depths = degressive_depths(first, total, by, shortest)
    assert depths[-1] == total
    assert all(a < b for a, b in pairwise(depths))


@given(SIZES, SIZES, st.floats(0.2, 20.0))
def test_no_stroke_is_longer_than_the_one_before(first: float, total: float, by: float) -> None:
    depths = [0.0, *degressive_depths(first, total, by)]
    strokes = [b - a for a, b in pairwise(depths)]
    longest = max(first, by)
    assert all(stroke <= longest + 1e-6 for stroke in strokes)


def test_the_rapid_return_stops_further_away_in_a_deep_hole() -> None:
    assert [automatic_limit(depth) for depth in (10.0, 30.0, 100.0, 1000.0)] == [0.6, 0.6, 2.0, 7.0]


def strokes(generator: object) -> list[tuple[Action, float]]:
    return [(s.action, s.value) for s in generator if s.action is not Action.DWELL]  # type: ignore[attr-defined]


def test_breaking_chips_goes_back_by_the_retract_and_clearing_them_to_the_clearance() -> None:
    breaking = strokes(peck([-5.0, -9.0], 2.0, 20.0, retract=1.5))
    assert breaking[2] == (Action.FEED, -3.5)
    clearing = strokes(peck([-5.0, -9.0], 2.0, 20.0, limits=[0.6, 0.6]))
    assert clearing[2:4] == [(Action.RAPID, 2.0), (Action.RAPID, -4.4)]


def test_only_the_first_stroke_has_the_factor_on_its_feed() -> None:
    factors = [
        s.factor
        for s in peck([-5.0, -9.0], 2.0, 20.0, retract=1.0, first_factor=0.5)
        if s.action is Action.FEED
    ]
    assert factors == [0.5, 1.0, 1.0]


def test_a_tap_that_clears_chips_comes_out_and_goes_back_in_front_of_the_depth() -> None:
    made = [
        value
        for action, value in strokes(tap_in_steps([-5.0, -8.0], 2.0, 20.0, limit=1.0))
        if action is Action.TAP
    ]
    assert made == [-5.0, 2.0, -4.0, -8.0, 2.0]
