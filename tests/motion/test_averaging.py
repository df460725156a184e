"""Averages over time of a motion in phases."""

from __future__ import annotations

import numpy as np
import pytest

from polycnc.motion.averaging import (
    HALF,
    PARTS,
    TENT,
    area_after,
    average,
    tent_acceleration,
    way_after,
)


def test_the_way_of_a_phase_is_the_area_below_its_speed() -> None:
    moments = np.linspace(0.0, 0.3, 3001)
    speed = 7.0 - 20.0 * moments
    assert way_after(0.3, 7.0, -20.0) == pytest.approx(np.trapezoid(speed, moments))


def test_the_area_of_a_phase_is_that_below_its_places() -> None:
    moments = np.linspace(0.0, 0.3, 3001)
    places = 2.0 + 7.0 * moments - 10.0 * moments**2
    assert area_after(0.3, 2.0, 7.0, -20.0) == pytest.approx(np.trapezoid(places, moments), rel=1e-7)


def test_an_average_over_a_steady_motion_is_its_middle() -> None:
    first, last = (area_after(seconds, 0.0, 5.0, 0.0) for seconds in (0.2, 0.6))
    assert average(first, last, 0.4) == pytest.approx(5.0 * 0.4)


def test_weights_leave_a_steady_motion_where_it_is() -> None:
    places = 3.0 + np.linspace(-1.0, 1.0, 2 * PARTS + 1)
    assert np.dot(TENT, places) == pytest.approx(3.0)
    assert np.dot(HALF, places[: PARTS + 1]) == pytest.approx(2.5)


def test_under_a_tent_a_parabola_keeps_its_acceleration() -> None:
    places = 0.5 * 12.0 * np.linspace(-0.1, 0.1, 2 * PARTS + 1) ** 2
    assert tent_acceleration(places[0], places[PARTS], places[-1], 0.1) == pytest.approx(12.0)
