"""What controls add to the acceleration: strokes of a drilling cycle that overlap, time constants of threads."""

from __future__ import annotations

import numpy as np
import pytest

from polycnc.motion.sampling.samples import Samples
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.context import NO_OVERLAP, OVERLAPS, STROKE
from tests.motion.paths import LATHE, Build
from tests.motion.sampling.test_samples import SOFT, sampled


def pecks(kind: float, last: float = STROKE) -> Build:
    """Over a hole, in by 6 mm, out by 1, in by 3, out."""
    rows = Build(("X", "Z")).set(overlap=kind)
    rows.rapid(10.0, 0.0).feed(10.0, -6.0, feed=20.0).rapid(10.0, -5.0).feed(10.0, -8.0, feed=20.0)
    return rows.set(overlap=last).rapid(10.0, 5.0)


def motion(rows: Build) -> tuple[float, Samples]:
    return sampled(rows, LATHE, lead=SOFT)


def test_strokes_that_overlap_take_less_time() -> None:
    assert motion(pecks(OVERLAPS))[0] < motion(pecks(STROKE))[0] - 0.05
    assert motion(pecks(STROKE))[0] == pytest.approx(motion(pecks(NO_OVERLAP, NO_OVERLAP))[0])


def test_the_samples_of_overlapping_strokes_last_as_long_as_the_plan() -> None:
    total, samples = motion(pecks(OVERLAPS))
    assert samples.time[-1] == pytest.approx(total, abs=0.0011)
    assert np.allclose(samples.position[-1], (10.0, 5.0), atol=1e-3)


def test_overlapping_strokes_keep_the_limits_of_the_axes() -> None:
    _, samples = motion(pecks(OVERLAPS))
    axis = LATHE.axes[0]
    assert np.abs(samples.acceleration).max() <= axis.acceleration * (1.0 + 1e-6)
    jerk = np.diff(samples.acceleration, axis=0) / 0.001
    assert np.abs(jerk).max() <= axis.jerk * (1.0 + 1e-6)


def test_a_peck_that_overlaps_its_retract_falls_short_of_its_depth() -> None:
    def first_peck(kind: float) -> float:
        z = motion(pecks(kind))[1].position[:, 1]
        return float(
            next(here for before, here, after in zip(z, z[1:], z[2:], strict=False) if before > here < after)
        )

    assert -6.0 + 1e-3 < first_peck(OVERLAPS) < -5.9
    assert first_peck(STROKE) == pytest.approx(-6.0, abs=1e-6)


def test_a_stroke_waits_where_the_next_move_is_none_of_the_cycle() -> None:
    assert motion(pecks(OVERLAPS, NO_OVERLAP))[0] > motion(pecks(OVERLAPS, STROKE))[0] + 0.015


@pytest.mark.parametrize("way", [0.01, 0.1, 0.5])
def test_a_rapid_begins_so_far_before_the_end_of_the_last(way: float) -> None:
    rows = Build(("X", "Z")).set(rapid_overlap=way).rapid(100.0, 0.0).rapid(100.0, 80.0)
    total, samples = motion(rows)
    x, z = samples.position[:, 0], samples.position[:, 1]
    begun = int(np.argmax(z > 1e-6))
    assert 0.0 < 100.0 - x[begun] < way
    assert total < motion(Build(("X", "Z")).rapid(100.0, 0.0).rapid(100.0, 80.0))[0] - 0.01
    assert samples.time[-1] == pytest.approx(total, abs=0.0011)


def test_a_cut_behind_a_rapid_that_overlaps_waits() -> None:
    def cut(way: float) -> float:
        rows = Build(("X", "Z")).set(rapid_overlap=way).rapid(100.0, 0.0).feed(100.0, 80.0)
        return motion(rows.rapid(0.0, 80.0))[0]

    assert cut(1.0) == pytest.approx(cut(0.0))


def test_a_dwell_between_two_strokes_keeps_them_apart() -> None:
    def cut(kind: float) -> float:
        rows = Build(("X", "Z")).set(overlap=kind).feed(0.0, -6.0).dwell(1.0)
        return motion(rows.rapid(0.0, 0.0))[0]

    assert cut(OVERLAPS) == pytest.approx(cut(STROKE))


def test_a_thread_has_its_lead_behind_the_way_in_which_its_time_constant_lets_it_get_up_to_speed() -> None:
    turning = Context(spindle_rpm=600.0, spindle_direction=1, lag_s=0.1)
    rows = Build(("X", "Z"), context=turning)
    rows.row(Kind.THREAD, 0.0, -40.0, feed=2.0, curve=(2.0, 0.0))
    _, samples = motion(rows)
    z = -samples.position[:, 1]
    away = np.abs(np.gradient(z, samples.time) - 20.0)
    # 20 mm/s are reached over 0.2 s, on 2 mm; averages over 0.08 s add to that.
    assert away[(z > 0.1) & (z < 0.5)].min() > 5.0
    assert away[(z > 4.5) & (z < 36.0)].max() < 1e-3
