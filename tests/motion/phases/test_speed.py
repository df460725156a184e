"""Phases of constant acceleration."""

from __future__ import annotations

from array import array
from math import cos, inf, radians, sin, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.motion.kernels.columns import Form, PathLimits, PieceRecord, piece_width
from polycnc.motion.kernels.columns import Limits as MachineLimits
from polycnc.motion.kernels.speeds import bound2, curved_time
from polycnc.motion.phases.speed import Profile, curved_profile, limits_of, straight_profile

WAYS = st.floats(0.01, 1000.0)
SQUARES = st.floats(0.0, 1e5)
PULLS = st.floats(10.0, 1e4)


def check(profile: Profile, length: float, start2: float, pull: float) -> None:
    """Phases fit together, arrive or rest, and keep to the acceleration."""
    speed = sqrt(start2)
    for phase in profile.phases:
        assert phase.speed == pytest.approx(speed, rel=1e-6, abs=1e-3)
        assert abs(phase.pull) <= pull * (1.0 + 1e-6)
        speed = phase.speed + phase.pull * phase.seconds
    way = sum(phase.way for phase in profile.phases)
    if profile.arrives:
        assert way == pytest.approx(length, rel=1e-9)
        assert speed == pytest.approx(sqrt(profile.end2), rel=1e-6, abs=1e-3)
    else:
        assert way <= length * (1.0 + 1e-9)
        assert profile.end2 == 0.0


@given(WAYS, SQUARES, SQUARES, SQUARES, PULLS)
def test_straight_phases_fit_together(
    length: float, start2: float, aim2: float, cap2: float, pull: float
) -> None:
    profile = straight_profile(length, start2, aim2, cap2, pull)
    check(profile, length, start2, pull)
    fastest = max(start2, cap2)
    for k in range(11):
        _, speed = profile.after(profile.seconds * k / 10.0)
        assert speed * speed <= fastest * (1.0 + 1e-6) + 1e-6


def test_a_trapezoid_takes_its_time() -> None:
    profile = straight_profile(100.0, 0.0, 0.0, 100.0, 50.0)
    assert profile.seconds == pytest.approx(10.0 / 50.0 + 100.0 / 10.0)
    assert profile.after(0.1)[0] == pytest.approx(0.25)


def test_where_nothing_is_allowed_the_axes_come_to_rest() -> None:
    profile = straight_profile(100.0, 100.0, 50.0, 0.0, 50.0)
    assert not profile.arrives
    assert sum(phase.way for phase in profile.phases) == pytest.approx(1.0)


def test_too_fast_for_the_way_left_the_axes_brake_over_all_of_it() -> None:
    profile = straight_profile(0.5, 100.0, 0.0, 0.0, 50.0)
    assert profile.arrives
    assert profile.end2 == pytest.approx(50.0)


#: Two axes with 1000 mm/s².
MACHINE = MachineLimits(
    top_rapid=array("d", [100.0, 100.0]),
    top_feed=array("d", [100.0, 100.0]),
    acceleration=array("d", [1000.0, 1000.0]),
    jump=array("d", [0.0, 0.0]),
    step=array("d", [0.0, 0.0]),
    arc=array("d", [0.0, 0.0]),
    bend=array("d", [0.0, 0.0]),
    rotary=array("d", [0.0, 0.0]),
    jerk=array("d", [0.0, 0.0]),
    geometry=array("q", [0, 1, -1]),
    path=PathLimits(),
    linkage=array("d"),
)


def circle(length: float, path_pull: float = 900.0) -> array[float]:
    """The record of 7.5° of a circle of 10 mm at 20°."""
    record = array("d", bytes(8 * piece_width(2)))
    record[PieceRecord.LENGTH], record[PieceRecord.FORM] = length, Form.CURVED
    record[PieceRecord.PULL] = record[PieceRecord.PATH_PULL] = path_pull
    first, last = radians(20.0), radians(27.5)
    record[PieceRecord.VECTORS : PieceRecord.VECTORS + 8] = array(
        "d",
        [
            -sin(first), cos(first), -sin(last), cos(last),
            -cos(first) / 10.0, -sin(first) / 10.0, -cos(last) / 10.0, -sin(last) / 10.0,
        ],
    )  # fmt: skip
    return record


@given(st.floats(0.0, 9000.0), st.floats(0.0, 9000.0), st.floats(0.05, 1.3))
def test_on_a_curve_the_axes_keep_their_acceleration(start2: float, aim2: float, length: float) -> None:
    record = circle(length)
    limits = limits_of(record, 2, MACHINE)
    profile = curved_profile(record, start2, aim2, 9000.0, 2, MACHINE)
    check(profile, length, start2, inf)
    x2 = start2
    for phase in profile.phases:
        end2 = (phase.speed + phase.pull * phase.seconds) ** 2
        for q, b, q_end, b_end, a in zip(*limits, strict=True):
            assert abs(b * x2 + q * phase.pull) <= a * 1.001 or phase.way < 1e-9
            assert abs(b_end * end2 + q_end * phase.pull) <= a * 1.001 or phase.way < 1e-9
        x2 = end2


@given(st.floats(0.0, 9000.0), st.floats(0.05, 1.3))
def test_on_a_curve_a_hold_brakes(start2: float, length: float) -> None:
    profile = curved_profile(circle(length), start2, 0.0, 0.0, 2, MACHINE)
    check(profile, length, start2, inf)
    assert profile.end2 <= start2


@given(st.floats(0.0, 4000.0), st.floats(0.05, 1.3), st.floats(50.0, 900.0))
def test_undisturbed_a_curve_takes_the_time_of_the_plan(start2: float, length: float, pull: float) -> None:
    record = circle(length, pull)
    record[PieceRecord.CAP2] = 9000.0
    end2 = min(bound2(record, 0, 2, MACHINE, start2, False)[0], 9000.0)
    planned, _, _ = curved_time(record, 0, 2, MACHINE, start2, end2)
    profile = curved_profile(record, start2, 9000.0, 9000.0, 2, MACHINE)
    assert profile.end2 == pytest.approx(end2)
    assert profile.seconds == pytest.approx(planned, rel=1e-6)
    assert all(abs(phase.pull) <= pull * 1.001 or phase.way < 1e-9 for phase in profile.phases)
