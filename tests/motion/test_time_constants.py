"""Acceleration by time constants: rapids, cuts that are planned ahead, cuts that follow the interpolator."""

from __future__ import annotations

from dataclasses import replace
from math import sqrt
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from polycnc.motion import Settings
from polycnc.motion.time_constants import SHORTEST_S
from polycnc.toolpath import Kind
from polycnc.toolpath.modes import AccelerationMode, CornerMode
from polycnc.toolpath.motion_settings import Ramp
from tests.motion.paths import MILL, Build
from tests.motion.sampling.test_samples import sampled

if TYPE_CHECKING:
    from polycnc.machine import Machine

RAPID, FEED = MILL.axes[0].rapid, MILL.axes[0].max_feed
SOFT = Settings(
    keeps_corners=False,
    acceleration=AccelerationMode.JERK_LIMITED,
    rapid_by_axis=True,
    after_interpolation=True,
)
ON_A_LINE = replace(SOFT, rapid_by_axis=False)
T = 0.064


def mill(**times: Any) -> Machine:
    """The mill with time constants of all axes."""
    return replace(MILL, axes=tuple(replace(axis, **times) for axis in MILL.axes))


def seconds(rows: Build, machine: Machine, settings: Settings = SOFT) -> float:
    return rows.plan(machine, settings=settings).total_s


def square(side: float, feed: float, **context: Any) -> Build:
    rows = Build().set(**context)
    for x, y in ((side, 0.0), (side, side), (0.0, side), (0.0, 0.0)):
        rows.feed(x, y, 0.0, feed=feed)
    return rows


@pytest.mark.parametrize("settings", [SOFT, ON_A_LINE])
@pytest.mark.parametrize(("bell", "more"), [(0.04, 0.04), (0.0, SHORTEST_S)])
def test_a_long_rapid_takes_both_time_constants_more(settings: Settings, bell: float, more: float) -> None:
    machine = mill(rapid_time_s=0.1, rapid_bell_s=bell)
    assert seconds(Build().rapid(300.0, 0.0, 0.0), machine, settings) == pytest.approx(
        300.0 / RAPID + 0.1 + more
    )


def test_a_short_rapid_has_the_acceleration_of_a_long_one() -> None:
    machine = mill(rapid_time_s=0.1, rapid_bell_s=0.0)
    expected = 2.0 * sqrt(4.0 * 0.1 / RAPID)
    assert seconds(Build().rapid(4.0, 0.0, 0.0), machine) == pytest.approx(expected, abs=1.5 * SHORTEST_S)


def test_time_constants_of_rapids_leave_cuts_alone() -> None:
    rows, machine = square(20.0, 50.0), mill(rapid_time_s=0.3, rapid_bell_s=0.1)
    assert seconds(rows, machine) == seconds(rows, MILL)


def test_parameters_come_before_the_machine_file() -> None:
    machine = mill(rapid_time_s=0.3, rapid_bell_s=0.1)
    settings = replace(SOFT, rapid_ramps={"X": Ramp(0.1, 0.05)})
    rows = Build().rapid(300.0, 0.0, 0.0)
    assert seconds(rows, machine, settings) == pytest.approx(300.0 / RAPID + 0.15)
    assert seconds(rows, machine, replace(settings, rapid_caps={"X": 100.0})) == pytest.approx(3.15)
    assert seconds(Build().rapid(0.0, 300.0, 0.0), machine, settings) == pytest.approx(300.0 / RAPID + 0.4)


def test_cuts_that_are_planned_ahead_have_time_constants_up_to_the_highest_feed() -> None:
    settings = replace(SOFT, after_interpolation=False, cut_ramps={"X": Ramp(0.2, 0.04)})
    rows = Build().set(corner_mode=CornerMode.EXACT_STOP).feed(300.0, 0.0, 0.0, feed=0.5 * FEED)
    # Half the feed is reached in half the time.
    assert seconds(rows, MILL, settings) == pytest.approx(600.0 / FEED + 0.1 + 0.04, abs=1e-6)
    by_acceleration = replace(settings, cut_ramps={"X": Ramp(bell_s=0.04, acceleration=FEED / 0.2)})
    assert seconds(rows, MILL, by_acceleration) == seconds(rows, MILL, settings)


@pytest.mark.parametrize("feed", [10.0, 50.0, 200.0])
def test_after_the_interpolation_a_path_takes_the_time_constant_more_whatever_the_feed(feed: float) -> None:
    rows = square(20.0, feed)
    assert seconds(rows, mill(after_interpolation_s=T)) == pytest.approx(80.0 / feed + T, abs=1e-5)


def test_an_exact_stop_costs_the_time_constant_at_every_corner() -> None:
    rows = square(20.0, 50.0, corner_mode=CornerMode.EXACT_STOP)
    assert seconds(rows, mill(after_interpolation_s=T)) == pytest.approx(80.0 / 50.0 + 4.0 * T, abs=1e-5)


def test_short_blocks_and_arcs_are_no_slower_than_their_feed() -> None:
    rows = Build()
    for k in range(1, 201):
        rows.feed(0.1 * k, 0.05 * (k % 2), 0.0, feed=100.0)
    way = 200.0 * sqrt(0.1**2 + 0.05**2)
    assert seconds(rows, mill(after_interpolation_s=T)) == pytest.approx(way / 100.0 + T, abs=1e-4)
    circle = Build().arc(0.0, 0.0, 0.0, center=(5.0, 0.0), feed=100.0)
    expected = 10.0 * np.pi / 100.0 + T
    assert seconds(circle, mill(after_interpolation_s=T)) == pytest.approx(expected, abs=1e-5)


def test_the_corner_is_rounded_by_what_the_time_constant_takes_off() -> None:
    total, samples = sampled(square(20.0, 50.0), mill(after_interpolation_s=T), lead=SOFT)
    assert samples.time[-1] == pytest.approx(total, abs=0.0011)
    off = np.hypot(samples.position[:, 0] - 20.0, samples.position[:, 1])
    # At the corner the average under a tent of half width T/2 is off by v·(T/2)/6 along both lines.
    assert off.min() == pytest.approx(sqrt(2.0) * 50.0 * 0.5 * T / 6.0, rel=0.02)
    # The acceleration is the step of the speed over half the time, at its peak.
    assert np.abs(samples.acceleration).max() == pytest.approx(50.0 / (0.5 * T), rel=0.05)


def test_a_circle_shrinks_by_what_the_time_constant_takes_off() -> None:
    circle = Build().arc(0.0, 0.0, 0.0, center=(10.0, 0.0), feed=100.0)
    _, samples = sampled(circle, mill(after_interpolation_s=T), lead=SOFT)
    radius = np.hypot(samples.position[:, 0] - 10.0, samples.position[:, 1])
    blend = 0.5 * (T - SHORTEST_S)
    assert 10.0 - radius.min() == pytest.approx(blend**2 / 12.0 * 100.0**2 / 10.0, rel=0.01)


def test_look_ahead_has_the_limits_of_the_machine() -> None:
    machine = mill(after_interpolation_s=T)
    rows = square(20.0, 50.0, acceleration=AccelerationMode.JERK_LIMITED)
    assert seconds(rows, machine) == seconds(square(20.0, 50.0), MILL)


def test_where_look_ahead_begins_the_axes_rest() -> None:
    machine = mill(after_interpolation_s=T)
    rows = Build().feed(20.0, 0.0, 0.0, feed=50.0).set(acceleration=AccelerationMode.JERK_LIMITED)
    rows.feed(40.0, 0.0, 0.0, feed=50.0)
    apart = seconds(Build().feed(20.0, 0.0, 0.0, feed=50.0), machine) + seconds(
        Build().feed(20.0, 0.0, 0.0, feed=50.0), MILL
    )
    assert seconds(rows, machine) == pytest.approx(apart, abs=1e-6)


def test_taps_keep_the_acceleration_of_their_spindle_and_axis() -> None:
    rows = Build().set(spindle_rpm=600.0, spindle_direction=1).rapid(0.0, 0.0, 1.0)
    rows.row(Kind.TAP, 0.0, 0.0, -20.0, curve=(1.0, 0.0))
    rapids = mill(rapid_time_s=MILL.axes[2].rapid / MILL.axes[2].acceleration, rapid_bell_s=0.06)
    machine = replace(rapids, axes=tuple(replace(axis, after_interpolation_s=T) for axis in rapids.axes))
    assert seconds(rows, machine) == pytest.approx(seconds(rows, MILL), abs=1e-6)


def test_chunks_do_not_matter() -> None:
    def rows(chunk: int) -> Build:
        rows = Build(chunk_rows=chunk).rapid(50.0, 20.0, 5.0)
        for k in range(40):
            rows.feed(50.0 + k % 3, 20.0, 5.0 - k, feed=40.0)
            if k % 7 == 0:
                rows.rapid(0.0, 20.0, 5.0)
        return rows

    machine = mill(rapid_time_s=0.1, rapid_bell_s=0.03, after_interpolation_s=T)
    assert seconds(rows(1), machine) == seconds(rows(65_536), machine)
