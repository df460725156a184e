"""The sampled spindle goes from speed to speed by its ramp, and its angle is the integral of its speed."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.motion.sampling.spindle import SpindleCourse
from tests.motion.paths import LATHE, MILL, Build
from tests.motion.sampling.test_samples import sampled
from tests.motion.standing.test_beside import approach, waiting

RAMP = MILL.spindles[0].acceleration_rpm_s


@pytest.mark.parametrize("kind", ["cut", "never", "block"])
@pytest.mark.parametrize("rapids", [1, 3])
def test_a_spindle_runs_up_beside_rapids_by_its_ramp(kind: str, rapids: int) -> None:
    _, samples = sampled(approach(rapids=rapids), waiting(kind))
    expected = np.minimum(RAMP * samples.time, 3000.0)
    assert samples.spindle_rpm == pytest.approx(expected, abs=1e-6)
    at_speed = 3000.0 / RAMP
    turned = np.where(
        samples.time < at_speed,
        3.0 * RAMP * samples.time**2,
        6.0 * 3000.0 * (samples.time - 0.5 * at_speed),
    )
    assert samples.spindle_angle == pytest.approx(turned, abs=1e-6)


def test_it_runs_on_through_a_dwell_and_turns_back_by_the_same_ramp() -> None:
    rows = Build().set(spindle_rpm=3000.0, spindle_direction=1).rapid(50.0, 0.0, 0.0).dwell(0.01)
    rows.set(spindle_rpm=3000.0, spindle_direction=-1).rapid(0.0, 0.0, 0.0).dwell(5.0)
    _, samples = sampled(rows, waiting("never"))
    steps = np.abs(np.diff(samples.spindle_rpm)) / 0.001
    assert steps.max() <= RAMP * 1.000001
    assert samples.spindle_rpm[-1] == -3000.0
    assert samples.spindle_rpm.max() < 3000.0  # it had no time to come to speed


def test_under_constant_surface_speed_it_goes_to_the_speed_at_the_end_of_a_rapid() -> None:
    lathe = replace(LATHE, spindles=tuple(replace(s, speed_wait="cut") for s in LATHE.spindles))
    ramp = lathe.spindles[0].acceleration_rpm_s
    rows = Build(axes=("X", "Z")).set(spindle_rpm=200.0, spindle_direction=1, surface_speed=True)
    rows.rapid(50.0, 0.0).feed(50.0, -10.0, feed=20.0).rapid(10.0, -10.0).feed(10.0, -20.0, feed=20.0)
    plan_s, samples = sampled(rows, lathe)
    fast, slow = (200_000.0 / (2.0 * np.pi * radius) for radius in (10.0, 50.0))
    fast = min(fast, lathe.spindles[0].max_rpm)
    assert np.abs(np.diff(samples.spindle_rpm)).max() <= ramp * 0.001 * 1.000001
    first_cut, last_cut = (samples.line == line for line in (2, 4))
    moves = np.abs(samples.velocity).max(axis=1) > 1e-9
    assert samples.spindle_rpm[first_cut & moves] == pytest.approx(slow, abs=1e-6)
    assert samples.spindle_rpm[last_cut & moves] == pytest.approx(fast, abs=1e-6)
    assert plan_s == pytest.approx(samples.time[-1], abs=0.0011)


@given(st.lists(st.tuples(st.floats(0.001, 2.0), st.floats(-6000.0, 6000.0)), min_size=1, max_size=6))
def test_the_angle_is_the_integral_of_the_speed(steps: list[tuple[float, float]]) -> None:
    course, time = SpindleCourse(), 0.0
    rpm: Any
    angle: Any
    for wait, aim in steps:
        time += wait
        course.go_to(time, aim, 4000.0)
    times = np.linspace(0.0, time + 4.0, 4001)
    rpm, angle = course.at(times)
    assert rpm[-1] == pytest.approx(steps[-1][1], abs=1e-6)
    assert np.abs(np.diff(rpm)).max() <= 4000.0 * (times[1] - times[0]) * 1.000001
    turned = 3.0 * (rpm[1:] + rpm[:-1]) * np.diff(times)
    assert np.abs(np.diff(angle) - turned).max() < 0.1  # a ramp may end between two of them
    course.forget(0.5 * time)
    for one, other in zip(course.at(times[2500:]), (rpm[2500:], angle[2500:]), strict=True):
        assert one == pytest.approx(other)
