"""Targets of rotary axes, and what stays true of them for any angle."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.control.sinumerik.block.positions import AxisTerm, Dimension, _rotary_target

ANGLES = st.floats(0.0, 359.999)
PLACES = st.floats(-5000.0, 5000.0)


def reached(now: float, value: float, way: Dimension) -> float:
    return _rotary_target(now, value, AxisTerm(0, 0, way, 1.0))


@given(
    PLACES,
    ANGLES,
    st.sampled_from([Dimension.SHORTEST, Dimension.POSITIVE, Dimension.NEGATIVE, Dimension.MODULO]),
)
def test_every_way_leads_to_the_angle(now: float, angle: float, way: Dimension) -> None:
    difference = (reached(now, angle, way) - angle) % 360.0
    assert min(difference, 360.0 - difference) < 1e-6


@given(PLACES, ANGLES)
def test_each_way_goes_its_direction(now: float, angle: float) -> None:
    assert abs(reached(now, angle, Dimension.SHORTEST) - now) <= 180.0 + 1e-6
    assert -1e-6 <= reached(now, angle, Dimension.POSITIVE) - now < 360.0 + 1e-6
    assert -360.0 - 1e-6 < reached(now, angle, Dimension.NEGATIVE) - now <= 1e-6


@pytest.mark.parametrize(
    ("now", "angle", "target"), [(350.0, 10.0, 10.0), (370.0, 350.0, 710.0), (-10.0, 20.0, -340.0)]
)
def test_a_plain_angle_stays_within_the_turn(now: float, angle: float, target: float) -> None:
    assert reached(now, angle, Dimension.MODULO) == pytest.approx(target)
