"""Lines that are chords of a curve get its tangents; corners keep theirs."""

from __future__ import annotations

from array import array
from math import pi

from polycnc.motion.third_order.bends.stretches import curve_lines
from tests.motion.third_order.programmed import Bounds
from tests.motion.third_order.programmed_paths import Drawn


def smooth_ends(drawn: Drawn) -> list[int]:
    path = drawn.path.path
    smooth = array("q", bytes(8 * len(path.way)))
    curve_lines(path, 4, smooth)
    return list(smooth)


def test_facets_of_a_circle_are_a_curve_and_a_corner_is_none() -> None:
    drawn = Drawn()
    drawn.facets(10.0, 1.0, 50, Bounds(0.01))
    drawn.line(10.0, pi / 2.0, 0.0, 0.0, Bounds(0.01))
    smooth = smooth_ends(drawn)
    assert smooth[0] == smooth[50] == smooth[51] == 0
    assert all(smooth[2:49])
    path = drawn.path.path
    for e in range(2, 49):
        assert list(path.arrive[4 * e - 4 : 4 * e]) == list(path.leave[4 * e : 4 * e + 4])


def test_a_zigzag_is_none() -> None:
    drawn = Drawn()
    for k in range(10):
        drawn.line(1.0, 0.05 * (1 - 2 * (k % 2)), 0.0, 0.0, Bounds(0.01))
    assert not any(smooth_ends(drawn))


def test_lines_that_a_curve_would_leave_too_far_are_none() -> None:
    drawn = Drawn()
    drawn.facets(10.0, 1.0, 10, Bounds(0.01))  # 1 mm, 0.1 rad: 0.0125 mm
    assert not any(smooth_ends(drawn))


def test_chords_of_a_spline_are_a_curve_up_to_their_angle() -> None:
    drawn = Drawn()
    drawn.wave(20.0, 1.0, 20, Bounds(0.01))
    assert all(smooth_ends(drawn)[1:-1])
