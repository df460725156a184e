"""Averages over time of a motion in phases."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.motion.averaging import (
    area_after,
    average,
    tent_acceleration,
    under_tent,
    way_after,
)
from polycnc.motion.sampling.tents import under_tents

if TYPE_CHECKING:
    from numpy.typing import NDArray


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


def test_under_a_tent_a_steady_motion_stays_where_it_is() -> None:
    assert under_tent(lambda time: [3.0 + 2.0 * time], 0.5, 0.1, [0.45]) == pytest.approx([4.0])


def test_under_a_tent_a_corner_is_rounded_by_a_sixth_of_its_jump() -> None:
    """A jump of velocity in the middle: half of the tent's first moment on one side, `Δv·blend/6`."""
    assert under_tent(lambda time: [max(time, 0.0)], 0.0, 0.1, [0.0]) == pytest.approx([0.1 / 6.0])


@given(st.lists(st.floats(0.0, 1.0), max_size=4), st.floats(0.01, 0.3))
def test_one_moment_and_many_have_the_same_average(edges: list[float], blend: float) -> None:
    edges = sorted(edges)

    def place(times: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.stack([times**3 + sum(np.maximum(times - edge, 0.0) for edge in edges), times**9], axis=1)

    times = np.linspace(0.1, 0.9, 9)
    many, speed, _ = under_tents(place, times, blend, np.array(edges))
    for k, time in enumerate(times.tolist()):
        within = [edge for edge in edges if abs(edge - time) < blend]
        one = under_tent(lambda moment: place(np.array([moment]))[0].tolist(), time, blend, within)
        assert one == pytest.approx(many[k].tolist(), abs=1e-12)
    later = under_tents(place, times + 1e-6, blend, np.array(edges))[0]
    assert (later - many) / 1e-6 == pytest.approx(speed, abs=1e-3)


def test_under_a_tent_a_parabola_keeps_its_acceleration() -> None:
    places = 0.5 * 12.0 * np.linspace(-0.1, 0.1, 3) ** 2
    assert tent_acceleration(places[0], places[1], places[2], 0.1) == pytest.approx(12.0)
