"""Passes of a thread and the run-out at their end."""

from __future__ import annotations

from math import sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.cycles.turning.thread import (
    Runout,
    ThreadCuts,
    depths,
    thread_pass,
    thread_passes,
    thread_strokes,
)
from polycnc.toolpath import Kind


def test_equal_material_each_pass_means_the_square_root_of_the_pass_number() -> None:
    assert list(depths(ThreadCuts(1.0, 0.5, finishing=1)))[:3] == pytest.approx(
        [0.5, 0.5 * sqrt(2), 0.5 * sqrt(3)]
    )


def test_no_pass_adds_less_than_the_least_depth() -> None:
    found = list(depths(ThreadCuts(1.0, 0.5, least=0.25, finishing=0)))
    assert found == pytest.approx([0.5, 0.75, 1.0])


def test_the_last_rough_pass_leaves_the_allowance_and_finishing_repeats() -> None:
    found = list(depths(ThreadCuts(1.0, 0.4, allowance=0.1, finishing=3)))
    assert found[-4:] == pytest.approx([0.9, 1.0, 1.0, 1.0])


def test_constant_depth_grows_evenly() -> None:
    assert list(depths(ThreadCuts(1.0, 0.3, finishing=1, constant_depth=True))) == pytest.approx(
        [0.3, 0.6, 0.9, 1.0, 1.0]
    )


@given(st.floats(0.1, 5.0), st.floats(0.01, 1.0), st.floats(0.0, 0.2), st.floats(0.0, 0.09))
def test_depths_never_shrink_and_end_at_full_depth(
    height: float, first: float, least: float, allowance: float
) -> None:
    found = list(depths(ThreadCuts(height, min(first, height), max(least, 0.01), allowance, 1)))
    assert found == sorted(found)
    assert found[-1] == height


def test_a_run_out_is_a_second_stroke_at_its_angle() -> None:
    strokes = list(thread_strokes((5.0, 10.0), (-20.0, 10.0), 15.0, Runout(2.0, 45.0)))
    assert [stroke.kind for stroke in strokes] == [Kind.THREAD, Kind.THREAD]
    assert strokes[0].end == pytest.approx((-18.0, 10.0))
    assert strokes[1].end == pytest.approx((-20.0, 12.0))


def test_an_internal_thread_runs_out_towards_the_axis() -> None:
    last = list(thread_strokes((5.0, 10.0), (-20.0, 10.0), 8.0, Runout(2.0, 45.0)))[-1]
    assert last.end == pytest.approx((-20.0, 8.0))


def test_a_run_out_longer_than_the_thread_is_all_of_it() -> None:
    (only,) = thread_strokes((5.0, 10.0), (0.0, 10.0), 30.0, Runout(20.0, 45.0))
    assert only.end == pytest.approx((0.0, 15.0))


def test_taper_moves_the_start_of_every_pass() -> None:
    cuts = ThreadCuts(1.0, 1.0, finishing=0)
    ((begin, last),) = thread_passes((5.0, 20.0), (-20.0, 10.0), -2.0, cuts)
    strokes = list(thread_pass((5.0, 20.0), begin, last, Runout()))
    assert strokes[0].end == pytest.approx((5.0, 8.0))
    assert strokes[1].end == pytest.approx((-20.0, 10.0))
    assert strokes[-1].end == (5.0, 20.0)


def test_flank_infeed_moves_the_start_along_with_the_depth_and_zigzag_along_both_flanks() -> None:
    cuts = ThreadCuts(1.0, 0.4, finishing=1, constant_depth=True)
    passes = thread_passes((5.0, 20.0), (-20.0, 10.0), 0.0, cuts, half_angle_deg=45.0, zigzag=True)
    starts = [begin[0] for begin, _ in passes]
    assert starts == pytest.approx([4.6, 3.8, 4.0, 4.0])
