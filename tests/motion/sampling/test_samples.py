"""Samples of planned motion: even in time, in step with the plan, the spindle in step with the axes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from polycnc.machine import Machine
from polycnc.motion import Settings, planner
from polycnc.motion.planner import Planner
from polycnc.motion.sampling.samples import Sampler, Samples
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.modes import AccelerationMode
from tests.motion.paths import LATHE, MILL, Build

SOFT = Settings(acceleration=AccelerationMode.JERK_LIMITED, rapid_by_axis=True)


def sampled(
    rows: Build, machine: Machine = MILL, period: float = 0.001, lead: Settings = SOFT
) -> tuple[float, Samples]:
    """Planned time, and all samples in one."""
    given: list[Samples] = []
    planner = Planner(rows.toolpath, machine, settings=lead, compiled=False)
    sampler = Sampler(rows.toolpath, machine, planner, lead, period, given.append)
    for chunk in rows.toolpath.chunks:
        sampler.take(chunk)
    total = planner.finish().total_s
    sampler.close()
    columns: Any = (np.concatenate(column) for column in zip(*given, strict=True))
    return total, Samples(*columns)


def program() -> Build:
    rows = Build(context=Context(spindle_rpm=600.0, spindle_direction=1))
    rows.rapid(30.0, 10.0, 0.0).feed(50.0, 10.0, 0.0).arc(50.0, 30.0, 0.0, center=(50.0, 20.0))
    return rows.dwell(0.3).feed(10.0, 30.0, -5.0).rapid(0.0, 0.0, 20.0)


def test_samples_are_even_in_time_and_last_as_long_as_the_plan() -> None:
    total, samples = sampled(program())
    assert samples.time[0] == 0.0
    assert np.allclose(np.diff(samples.time), 0.001, atol=1e-9)
    assert samples.time[-1] == pytest.approx(total, abs=0.0011)


@pytest.mark.parametrize("acceleration", [AccelerationMode.CONSTANT, AccelerationMode.JERK_LIMITED])
def test_the_derivatives_of_the_samples_fit_each_other(acceleration: AccelerationMode) -> None:
    _, samples = sampled(program(), lead=Settings(acceleration=acceleration))
    # Trapezoidal sums of velocity give the positions, those of acceleration the velocity.
    way = np.cumsum(0.5 * (samples.velocity[1:] + samples.velocity[:-1]) * 0.001, axis=0)
    assert np.abs(way - (samples.position[1:] - samples.position[0])).max() < 0.02


def test_the_samples_begin_and_end_where_the_program_does() -> None:
    _, samples = sampled(program())
    assert np.allclose(samples.position[0], 0.0, atol=1e-9)
    assert np.allclose(samples.position[-1], (0.0, 0.0, 20.0), atol=1e-3)


def test_a_longer_period_takes_some_of_the_same_samples() -> None:
    fine, coarse = sampled(program())[1], sampled(program(), period=0.004)[1]
    assert np.allclose(fine.position[::4][: len(coarse.time)], coarse.position, atol=1e-9)


@pytest.mark.parametrize("lead", [SOFT, Settings()], ids=["soft", "brisk"])
@pytest.mark.parametrize("period", [40, 300, 5_000])
def test_a_single_move_begins_at_rest_whatever_the_period(lead: Settings, period: int) -> None:
    fine = sampled(Build().feed(5.0, 2.0, 0.0), lead=lead)[1]
    coarse = sampled(Build().feed(5.0, 2.0, 0.0), period=0.001 * period, lead=lead)[1]
    assert coarse.position[0].tolist() == [0.0, 0.0, 0.0]
    for values, some in zip(fine, coarse, strict=True):
        assert np.allclose(values[::period], some, atol=1e-6)


def test_every_sample_knows_its_line() -> None:
    _, samples = sampled(program())
    assert sorted(set(samples.line.tolist())) == [1, 2, 3, 4, 5, 6]
    assert np.all(np.diff(samples.line) >= 0)


def test_axes_of_a_rapid_arrive_one_after_the_other() -> None:
    _, samples = sampled(Build().rapid(100.0, 10.0, 0.0))
    moving_x, moving_y = (np.abs(samples.velocity[:, i]) > 1e-6 for i in (0, 1))
    assert moving_y.sum() < 0.7 * moving_x.sum()


def test_in_a_dwell_the_axes_rest_and_the_spindle_turns() -> None:
    _, samples = sampled(program())
    rest = samples.line == 4
    assert np.abs(samples.velocity[rest]).max() == 0.0
    assert np.allclose(np.diff(samples.spindle_angle[rest]), 600.0 * 6.0 * 0.001)


def test_the_spindle_runs_up_before_the_first_cut() -> None:
    total, samples = sampled(program())
    assert samples.spindle_rpm[0] == 0.0
    assert samples.spindle_rpm[-1] == 600.0
    assert np.all(np.diff(samples.spindle_rpm) >= 0.0)
    assert total > 600.0 / MILL.spindle[1].acceleration_rpm_s


def thread(z: float, lead: float, start_angle: float, rpm: float = 800.0) -> Build:
    """Two cuts of a thread on the same way."""
    rows = Build(axes=("X", "Z"), context=Context(spindle_rpm=rpm, spindle_direction=1))
    for depth in (19.0, 18.5):
        rows.rapid(depth, 5.0).row(Kind.THREAD, depth, z, curve=(lead, start_angle)).rapid(25.0, z)
        rows.rapid(25.0, 5.0)
    return rows


def test_a_tap_turns_the_spindle_by_its_lead_in_and_out() -> None:
    lead = 1.5
    rows = Build(context=Context(spindle_rpm=500.0, spindle_direction=1))
    rows.rapid(0.0, 0.0, 2.0).row(Kind.TAP, 0.0, 0.0, -10.0, curve=(lead, 0.0))
    rows.row(Kind.TAP, 0.0, 0.0, 2.0, curve=(lead, 0.0))
    _, samples = sampled(rows)
    tapping = np.isin(samples.line, (2, 3)) & (np.abs(samples.velocity[:, 2]) > 1e-9)
    z, angle = samples.position[tapping, 2], samples.spindle_angle[tapping]
    turned = angle - 360.0 * (2.0 - z) / lead
    assert np.ptp(turned) < 1e-6
    assert np.ptp(z) > 11.9


def contour(corners: int) -> Build:
    """A way of many lines and arcs that nothing stops on."""
    rows = Build(context=Context(spindle_rpm=600.0, spindle_direction=1))
    rows.rapid(0.0, 0.0, 0.0)
    for k in range(corners):
        y = 0.3 * (k % 3)
        rows.feed(k + 0.5, y, 0.0).arc(k + 1.0, y, 0.0, center=(k + 0.75, y))
    return rows


@pytest.mark.parametrize("lead", [Settings(), SOFT, Settings(acceleration=AccelerationMode.JERK_LIMITED)])
def test_a_run_that_is_followed_gives_what_it_gives_as_a_whole(
    lead: Settings, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(planner, "FULL_ROOM", 64)
    kept: list[int] = []
    follow = Sampler._follow

    def watched(sampler: Sampler) -> None:
        follow(sampler)
        if sampler._followed is not None:
            kept.append(len(sampler._followed.run.rows))

    monkeypatch.setattr(Sampler, "_follow", watched)
    _, followed = sampled(contour(150), lead=lead)
    assert len(kept) > 3
    assert max(kept) < 150  # of 300 rows with some pieces each
    monkeypatch.setattr(Sampler, "_follow", lambda _: None)
    _, whole = sampled(contour(150), lead=lead)
    for one, other, slack in zip(followed, whole, (0.0, 1e-9, 1e-6, 1e-2, 0.0, 1e-9, 0.0, 0.0), strict=True):
        assert np.allclose(one, other, rtol=0.0, atol=slack)


def test_what_a_thread_does_is_known_at_its_end(monkeypatch: pytest.MonkeyPatch) -> None:
    _, whole = sampled(thread(-40.0, 2.0, 90.0), LATHE)
    monkeypatch.setattr(planner, "FULL_ROOM", 1)
    _, followed = sampled(thread(-40.0, 2.0, 90.0), LATHE)
    assert np.allclose(followed.spindle_angle, whole.spindle_angle, atol=1e-9)
    assert np.allclose(followed.position, whole.position, atol=1e-9)
