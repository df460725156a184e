"""Corners without limited jerk: the samples pass them within the tolerance and the acceleration of the axes."""

from __future__ import annotations

import itertools
from math import cos, hypot, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.motion import Settings
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.modes import CornerMode
from tests.motion.paths import MILL4, Build, mill
from tests.motion.test_jerk import runs
from tests.motion.test_limits import UNEVEN, arc, build, line, spiral

#: Second differences of positions over a millisecond; sums of many terms.
PERIOD, SLACK = 0.001, 1.0 + 1e-5
BRISK = Settings()
MILL4_AXES = tuple(axis.name for axis in MILL4.axes)
contexts = st.sampled_from(
    [
        Context(corner_mode=CornerMode.CONTINUOUS),
        Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.005),
        Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.2),
        Context(corner_mode=CornerMode.ROUNDED_FROM, tolerance_mm=1.0),
    ]
)


@settings(max_examples=2000 if settings.get_current_profile_name() == "explore" else 60, deadline=None)
@given(st.lists(st.one_of(line, arc, spiral), min_size=2, max_size=6), contexts)
def test_axes_keep_their_acceleration_at_every_sample(
    steps: list[tuple[str, float, float, float, float]], context: Context
) -> None:
    total, found = runs(build(steps, context), UNEVEN, BRISK)
    assert sum(run.seconds for run in found) == pytest.approx(total, rel=1e-6)
    for run in found:
        places = run.at(np.arange(0.0, min(run.seconds, 20.0), PERIOD))[0]
        for i, axis in enumerate(UNEVEN.axes):
            most = np.abs(np.diff(places[:, i], 2)).max(initial=0.0)
            assert most <= axis.acceleration * PERIOD**2 * SLACK


@pytest.mark.parametrize("turn", [0.05, 0.8, 1.6, 3.0])
def test_two_lines_leave_their_corner_by_the_tolerance(turn: float) -> None:
    tolerance = 0.05
    rows = Build(context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=tolerance))
    rows.feed(20.0, 0.0, 0.0).feed(20.0 + 20.0 * cos(turn), 20.0 * sin(turn), 0.0)
    (run,) = runs(rows, mill(), BRISK)[1]
    places = run.at(np.linspace(0.0, run.seconds, 200_000))[0]
    assert np.hypot(places[:, 0] - 20.0, places[:, 1]).min() == pytest.approx(tolerance, rel=1e-3)


def test_a_rotary_axis_leaves_its_way_by_as_many_degrees_as_the_tolerance_has_mm() -> None:
    """X goes straight on, and the pace of the rotary axis steps by 1.5 degrees for each mm."""
    tolerance = 0.05
    rows = Build(axes=MILL4_AXES, context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=tolerance))
    rows.feed(20.0, 0.0, 0.0, 0.0, feed=50.0).feed(40.0, 0.0, 0.0, 30.0, feed=50.0)
    (run,) = runs(rows, MILL4, Settings(rotary_in_feed=False))[1]
    places = run.at(np.linspace(0.0, run.seconds, 200_000))[0]
    off = np.abs(places[:, 3] - 1.5 * np.maximum(places[:, 0] - 20.0, 0.0))
    assert off.max() == pytest.approx(tolerance, rel=1e-3)


@pytest.mark.parametrize("part", [0.0, 0.5, 0.8])
@pytest.mark.parametrize("moved", [0, 1])
def test_a_rotary_axis_with_a_tolerance_of_its_own_bends_by_what_a_moved_end_leaves_of_it(
    part: float, moved: int
) -> None:
    """A function that leads axes beside their ends has used a part of the tolerance before or behind the corner."""
    context = Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=1.0, turn_tolerance_deg=0.05)
    rows = Build(MILL4_AXES, context)
    for k, end in enumerate(((20.0, 0.0, 0.0, 0.0), (40.0, 0.0, 0.0, 30.0))):
        rows.row(Kind.FEED, *end, curve=(0.0,) * 7 + (part if k == moved else 0.0,))
    (run,) = runs(rows, MILL4, Settings(rotary_in_feed=False))[1]
    places = run.at(np.linspace(0.0, run.seconds, 200_000))[0]
    off = places[:, 3] - 1.5 * np.maximum(places[:, 0] - 20.0, 0.0)
    assert off.max() == pytest.approx((1.0 - part) * 0.05, rel=1e-3)


def test_no_more_than_half_of_a_line_is_bent() -> None:
    rows = Build(context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=5.0))
    ways = [(1.0, 0.0), (1.0, 1.0), (3.0, 1.0), (3.0, 2.0)]
    for x, y in ways:
        rows.feed(x, y, 0.0)
    (run,) = runs(rows, mill(), BRISK)[1]
    places = run.at(np.linspace(0.0, run.seconds, 20_000))[0]
    middles = [((a + c) / 2, (b + d) / 2) for (a, b), (c, d) in itertools.pairwise([(0.0, 0.0), *ways])]
    for x, y in middles[1:-1]:
        assert min(hypot(px - x, py - y) for px, py, _ in places.tolist()) < 1e-3


def test_a_row_keeps_its_length() -> None:
    rows = Build(context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.1))
    rows.feed(10.0, 0.0, 0.0).feed(10.0, 7.0, 0.0).arc(10.0, 17.0, 0.0, center=(10.0, 12.0))
    assert rows.plan(mill()).row_mm[:2] == pytest.approx([10.0, 7.0])


def test_an_axis_at_rest_beside_an_arc_is_no_reason_to_stop_on_its_bend() -> None:
    """Where the bend begins Z has no way yet, and just the acceleration that the bend takes of it."""
    steps = [
        ("arc", 8.297882638390691, 4.676912163340483, 4.598668699082221, 5000.0),
        ("line", -6.554, -4.342, 1.336, 5000.0),
        ("line", -31.134, 38.732, -36.68, 5000.0),
    ]
    rows = build(steps, Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.005))
    assert len(runs(rows, UNEVEN, BRISK)[1]) == 1


def test_a_spiral_keeps_the_acceleration_where_it_grows_fast() -> None:
    """Its direction turns by more than its angle."""
    (run,) = runs(build([("spiral", 29.7, 3.76, 0.5144, 200.0)], Context()), UNEVEN, BRISK)[1]
    places = run.at(np.arange(0.0, run.seconds, PERIOD))[0]
    for i, axis in enumerate(UNEVEN.axes):
        assert np.abs(np.diff(places[:, i], 2)).max() <= axis.acceleration * PERIOD**2 * SLACK
