"""Segments of moves and the accelerations between strokes."""

from __future__ import annotations

import pytest

from polycnc.control.sinumerik.punching.strokes import Acceleration


@pytest.mark.parametrize(
    ("distance", "share"), [(0.5, 0.5), (2.0, 0.5), (6.0, 0.75), (10.0, 1.0), (40.0, 1.0)]
)
def test_the_acceleration_grows_with_the_distance(distance: float, share: float) -> None:
    assert Acceleration(2.0, 0.5, 10.0, 1.0).at(distance) == pytest.approx(share)


def test_it_may_shrink_as_well() -> None:
    assert Acceleration(2.0, 1.0, 10.0, 0.2).at(6.0) == pytest.approx(0.6)


def test_one_distance_for_both_is_a_step() -> None:
    acceleration = Acceleration(5.0, 0.5, 5.0, 1.0)
    assert (acceleration.at(5.0), acceleration.at(5.1)) == (0.5, 1.0)
