"""Strokes of drilling, tapping and boring cycles."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.cycles.drilling import holes
from polycnc.cycles.drilling.holes import Action, Cycle, Hole


def strokes(cycle: Cycle, hole: Hole) -> list[tuple[str, float]]:
    """The strokes of a cycle as (action, value), without the spindle and without dwells of no time."""
    return [
        (stroke.action.name.lower(), stroke.value)
        for stroke in cycle(hole)
        if stroke.action not in (Action.SPINDLE, Action.ORIENT)
        and (stroke.action is not Action.DWELL or stroke.value)
    ]


def spindle(cycle: Cycle, hole: Hole) -> list[float]:
    return [stroke.value for stroke in cycle(hole) if stroke.action is Action.SPINDLE]


PLAIN = Hole(initial=50.0, r=2.0, bottom=-10.0, back=50.0)


def test_drilling_feeds_to_the_bottom_and_leaves_at_rapid_in_one_move() -> None:
    assert strokes(holes.drill, PLAIN) == [("rapid", 2.0), ("feed", -10.0), ("rapid", 50.0)]


def test_a_control_whose_retract_stops_at_r_makes_two_rapids() -> None:
    hole = Hole(50.0, 2.0, -10.0, 50.0, by_r=True)
    assert strokes(holes.drill, hole)[-2:] == [("rapid", 2.0), ("rapid", 50.0)]


def test_the_dwell_stands_between_the_bottom_and_the_way_out() -> None:
    hole = Hole(50.0, 2.0, -10.0, 2.0, dwell_s=0.5)
    expected = [("rapid", 2.0), ("feed", -10.0), ("dwell", 0.5), ("rapid", 2.0)]
    assert strokes(holes.drill, hole) == expected


def test_chip_breaking_retracts_by_the_relief_and_ends_exactly_at_the_bottom() -> None:
    hole = Hole(50.0, 2.0, -9.0, 2.0, peck=5.0, relief=1.0)
    assert strokes(holes.peck_breaking_chips, hole) == [
        ("rapid", 2.0),
        ("feed", -3.0),
        ("rapid", -2.0),
        ("feed", -8.0),
        ("rapid", -7.0),
        ("feed", -9.0),
        ("rapid", 2.0),
    ]


def test_chip_clearing_returns_to_r_and_to_the_clearance_above_the_last_depth() -> None:
    hole = Hole(50.0, 2.0, -6.0, 50.0, peck=5.0, relief=0.5)
    assert strokes(holes.peck_clearing_chips, hole) == [
        ("rapid", 2.0),
        ("feed", -3.0),
        ("rapid", 2.0),
        ("rapid", -2.5),
        ("feed", -6.0),
        ("rapid", 50.0),
    ]


def test_a_relief_larger_than_the_depth_does_not_leave_the_hole() -> None:
    hole = Hole(50.0, 2.0, -6.0, 2.0, peck=5.0, relief=20.0)
    assert ("rapid", 2.0) in strokes(holes.peck_breaking_chips, hole)[2:3]


def test_a_tap_reverses_at_the_bottom_and_again_at_r() -> None:
    hole = Hole(50.0, 2.0, -10.0, 50.0, dwell_s=1.0, dwell_out_s=0.25)
    assert strokes(holes.tap, hole) == [
        ("rapid", 2.0),
        ("tap", -10.0),
        ("dwell", 1.0),
        ("tap", 2.0),
        ("dwell", 0.25),
        ("rapid", 50.0),
    ]
    assert spindle(holes.tap, hole) == [-1.0, 1.0]


@pytest.mark.parametrize(("relief", "between"), [(0.0, 2.0), (0.5, -2.5)])
def test_a_pecking_tap_goes_back_to_r_or_by_the_relief(relief: float, between: float) -> None:
    hole = Hole(50.0, 2.0, -6.0, 2.0, peck=5.0, relief=relief)
    levels = [value for action, value in strokes(holes.tap, hole) if action == "tap"]
    assert levels == [-3.0, between, -6.0, 2.0]


def test_boring_leaves_at_feed_to_r_and_at_rapid_beyond() -> None:
    expected = [("rapid", 2.0), ("feed", -10.0), ("feed", 2.0), ("rapid", 50.0)]
    assert strokes(holes.bore, PLAIN) == expected


def test_boring_may_come_out_faster_than_it_went_in() -> None:
    factors = [stroke.factor for stroke in holes.bore(PLAIN, 2.0) if stroke.action is Action.FEED]
    assert factors == [1.0, 2.0]


def test_rough_boring_leaves_with_a_standing_spindle() -> None:
    assert spindle(holes.bore_and_stop, PLAIN) == [0.0, 1.0]
    assert strokes(holes.bore_and_stop, PLAIN) == strokes(holes.drill, PLAIN)


def test_fine_boring_shifts_off_the_wall_before_it_leaves() -> None:
    assert strokes(holes.bore_and_shift, PLAIN)[2:] == [("shift", 1.0), ("rapid", 50.0), ("shift", 0.0)]


def test_back_boring_goes_through_the_hole_shifted_and_feeds_up() -> None:
    hole = Hole(initial=50.0, r=-30.0, bottom=-20.0, back=-30.0)
    assert strokes(holes.bore_back, hole) == [
        ("shift", 1.0),
        ("rapid", -30.0),
        ("shift", 0.0),
        ("feed", -20.0),
        ("shift", 1.0),
        ("rapid", 50.0),
        ("shift", 0.0),
    ]


@pytest.mark.parametrize(("feeds_out", "levels"), [(False, [50.0]), (True, [2.0, 50.0])])
def test_manual_boring_waits_for_the_operator_at_the_bottom(feeds_out: bool, levels: list[float]) -> None:
    made = [(s.action, s.value) for s in holes.bore_and_halt(PLAIN, feeds_out=feeds_out)]
    halt = [action for action, _ in made].index(Action.HALT)
    assert [value for action, value in made[halt:] if action in (Action.RAPID, Action.FEED)] == levels


LEVELS = st.floats(-500.0, 500.0)


@given(r=LEVELS, bottom=LEVELS, peck=st.floats(0.5, 50.0))
def test_pecks_run_evenly_towards_the_bottom_and_end_there(r: float, bottom: float, peck: float) -> None:
    levels = list(holes.depths(Hole(r, r, bottom, r, peck=peck)))
    assert levels[-1] == bottom
    ways = [abs(b - a) for a, b in zip([r, *levels], levels, strict=False)]
    assert all(way <= peck + 1e-6 for way in ways)
    assert all(abs(way - peck) < 1e-6 for way in ways[:-1])
    assert abs(sum(ways) - abs(bottom - r)) < 1e-6


@given(r=LEVELS, bottom=LEVELS, peck=st.floats(0.5, 50.0), relief=st.floats(0.0, 60.0))
def test_no_stroke_in_the_hole_leaves_the_way_from_r_to_the_bottom(
    r: float, bottom: float, peck: float, relief: float
) -> None:
    hole = Hole(r, r, bottom, r, peck=peck, relief=relief)
    low, high = min(r, bottom) - 1e-6, max(r, bottom) + 1e-6
    for cycle in (holes.peck_breaking_chips, holes.peck_clearing_chips, holes.tap):
        assert all(low <= value <= high for action, value in strokes(cycle, hole) if action != "dwell")
