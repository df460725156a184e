"""What a spindle has turned is the integral of its speed, which it changes with its acceleration."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.mainrun.axes.spindle_turning import SpindleTurning


def test_a_steady_spindle_turns_six_degrees_a_second_for_each_rpm() -> None:
    assert SpindleTurning(-10.0, 100.0, 2.0).setpoint(5.0) == -180.0


def test_a_ramp_takes_its_time() -> None:
    spindle = SpindleTurning(0.0, 100.0, 0.0)
    spindle.turn_with(200.0, 1.0)
    assert spindle.setpoint(1.0) == 0.0
    assert spindle.setpoint(3.0) == pytest.approx(6.0 * 200.0)
    assert spindle.setpoint(4.0) == pytest.approx(6.0 * 400.0)


def test_a_spindle_without_acceleration_is_at_its_speed_at_once() -> None:
    spindle = SpindleTurning(0.0, 0.0, 0.0)
    spindle.turn_with(10.0, 1.0)
    assert spindle.setpoint(2.0) == 60.0


@given(st.lists(st.tuples(st.floats(-500, 500), st.floats(0.01, 3.0)), min_size=1, max_size=4))
def test_neither_angle_nor_speed_ever_steps(changes: list[tuple[float, float]]) -> None:
    spindle, time, step = SpindleTurning(0.0, 100.0, 0.0), 0.0, 8e-3
    last, speed = 0.0, 0.0
    for rpm, seconds in changes:
        spindle.turn_with(rpm, time)
        for _ in range(int(seconds / step)):
            time += step
            here = spindle.setpoint(time)
            now = (here - last) / step
            assert abs(now - speed) <= 6.0 * 100.0 * step * 1.001 + 1e-6
            last, speed = here, now
