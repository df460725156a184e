"""How far apart knots may be: by the tent moment of the turning."""

from __future__ import annotations

from array import array
from math import pi

import pytest

from polycnc.motion.third_order.bends.stretches import curve_lines
from polycnc.motion.third_order.bends.turning import FULL, SHARE, Turning, measure, reach, sum_turning
from polycnc.motion.third_order.parts import turning_for
from tests.motion.third_order.programmed import Bounds
from tests.motion.third_order.programmed_paths import Drawn


def turning_of(drawn: Drawn) -> Turning:
    path, smooth = drawn.path.path, array("q", bytes(8 * len(drawn.path.path.way)))
    turning = turning_for(len(path.form))
    curve_lines(path, 4, smooth)
    measure(path, 4, smooth, turning)
    sum_turning(path, turning)
    return turning


@pytest.mark.parametrize("guess", [0.001, 0.1, 10.0])
def test_a_corner_by_its_turn(guess: float) -> None:
    drawn = Drawn()
    drawn.line(10.0, 0.0, 0.0, 0.0, Bounds(0.01))
    drawn.line(10.0, 0.1, 0.0, 0.0, Bounds(0.02))
    h = reach(drawn.path.path, turning_of(drawn), 1, 10.0, guess, 20.0)
    assert h == pytest.approx(FULL * SHARE * 0.01 / 0.1, rel=0.01)


def test_an_arc_by_its_curvature() -> None:
    drawn = Drawn()
    drawn.arc(20.0, pi, 0.0, 0.0, 0.0, Bounds(0.01))
    h = reach(drawn.path.path, turning_of(drawn), 12, 31.0, 1.0, 60.0)
    assert h == pytest.approx((FULL * SHARE * 0.01 * 20.0) ** 0.5, rel=0.02)


def test_a_straight_line_allows_any_distance() -> None:
    drawn = Drawn()
    for _ in range(3):
        drawn.line(10.0, 0.0, 0.0, 0.0, Bounds(0.01))
    assert reach(drawn.path.path, turning_of(drawn), 1, 15.0, 0.1, 30.0) == 30.0


def test_rotary_axes_count_by_their_own_tolerance() -> None:
    drawn = Drawn()
    drawn.line(10.0, 0.0, 0.0, 0.0, Bounds(0.01, turn_tolerance=0.5))
    drawn.line(10.0, 0.0, 0.0, 20.0, Bounds(0.01, turn_tolerance=0.5))
    h = reach(drawn.path.path, turning_of(drawn), 1, 10.0, 1.0, 20.0)
    assert h == pytest.approx(FULL * SHARE * 0.5 / 2.0, rel=0.01)


def test_a_sharp_corner_far_off_does_not_hide_one_nearby() -> None:
    """Newton's steps are short on the steep side of the far one."""
    drawn = Drawn()
    drawn.line(1.0, 0.0, 0.0, 0.0, Bounds(0.001))
    drawn.line(6.0, 0.1, 0.0, 0.0, Bounds(0.001))
    drawn.line(1.0, 0.0, 0.0, 500.0, Bounds(0.001))
    # From the first end the corner at 1 mm turns by 100 tolerances.
    assert reach(drawn.path.path, turning_of(drawn), 0, 0.0, 7.03, 8.0) == pytest.approx(
        1.0 + FULL * SHARE / 100.0, rel=0.01
    )
