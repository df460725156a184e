"""Straight rows of a tool's tip take little longer than the axes need at least, and the tip stays on them."""

from __future__ import annotations

from itertools import pairwise
from math import radians
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from polycnc.motion import Settings
from polycnc.motion.demand import looks_along
from polycnc.motion.kernels.columns import PieceRecord, piece_width
from polycnc.motion.kernels.demands import MOST_LOOKS
from polycnc.motion.planner import Planner
from polycnc.motion.sampling.run import Run
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.modes import AccelerationMode, CornerMode
from tests.examples import examples
from tests.motion.five_axes import TipPath, least_time, machines, random_paths
from tests.motion.paths import Build
from tests.motion.test_transformed import SLACK, real_motion

if TYPE_CHECKING:
    from tests.motion.five_axes import Numbers

BRISK = Settings(acceleration=AccelerationMode.CONSTANT)
SOFT = Settings(acceleration=AccelerationMode.JERK_LIMITED, rotary_in_feed=False)
#: Planned time over the least one, of the slowest path; the bound is found at so many places that it is this exact.
WORST, COARSE = 1.05, 0.995


def planned(path: TipPath, **options: Any) -> float:
    """Seconds that the planner gives the rows of a path, each from rest to rest."""
    build = Build(
        path.axes.tip.axes, Context(transformation=path.axes.tip, corner_mode=CornerMode.EXACT_STOP)
    )
    for point in path.points:
        build.row(Kind.FEED, *point, feed=path.feed)
    start = path.axes.tip.to_machine(path.points[0])
    plan = Planner(build.toolpath, path.axes.machine, settings=BRISK, start=start, **options).finish()
    return float(np.sum(plan.row_s[1:]))


def test_rows_of_a_tip_take_little_longer_than_their_axes_need() -> None:
    pytest.importorskip("scipy", reason="scipy, which solves the linear programmes, is not installed")
    ratios = {path.name: planned(path) / least_time(path) for path in random_paths(examples(200), seed=5)}
    assert len(ratios) == examples(200)
    assert max(ratios.values()) <= WORST, ratios
    assert min(ratios.values()) >= COARSE, ratios


@pytest.mark.parametrize("corners", [CornerMode.EXACT_STOP, CornerMode.CONTINUOUS, CornerMode.ROUNDED])
def test_at_every_sample_axes_keep_their_limits_and_the_tip_is_on_its_lines(corners: CornerMode) -> None:
    for path in random_paths(12, seed=7):
        tip, tolerance = path.axes.tip, 0.0 if corners is CornerMode.EXACT_STOP else 0.05
        context = Context(transformation=tip, corner_mode=corners, tolerance_mm=tolerance)
        run = run_of(path, context)
        times = np.linspace(0.0, run.seconds, 4000)
        places, velocity, acceleration = real_motion(run, context, times, path.axes.machine)
        for i, name in enumerate(tip.axes):
            axis = path.axes.machine.axis[name]
            assert np.abs(velocity[:, i]).max() <= axis.max_feed * SLACK, (path.name, name)
            assert np.abs(acceleration[:, i]).max() <= axis.acceleration * SLACK, (path.name, name)
        tips = np.stack(tip.to_work(list(places.T)), axis=1)[:, :3]
        assert off_lines(tips, np.array(path.points)[:, :3]).max() <= tolerance + 1e-3, path.name


def test_the_feed_of_an_arc_is_that_of_the_tip_whatever_turns_along() -> None:
    for name, axes in machines().items():
        build = Build(axes.tip.axes, Context(transformation=axes.tip, corner_mode=CornerMode.EXACT_STOP))
        start, end = [20.0, 0.0, 5.0, -5.0, 4.0], [0.0, 20.0, 5.0, 5.0, -4.0]
        build.row(Kind.FEED, *start, feed=20.0)
        build.row(Kind.CCW, *end, feed=20.0, curve=(0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0))
        plan = Planner(
            build.toolpath, axes.machine, settings=BRISK, start=axes.tip.to_machine(start)
        ).finish()
        asked = 10.0 * np.pi / 20.0
        assert asked <= plan.row_s[1] <= 1.2 * asked, name


def test_axes_keep_their_velocity_all_round_a_circle() -> None:
    """A table turned by 45 degrees: its axes are fastest half-way between the quarters of the circle."""
    for name, axes in machines().items():
        context = Context(transformation=axes.tip, corner_mode=CornerMode.EXACT_STOP)
        build, found = Build(axes.tip.axes, context), list[Any]()
        start, n = [150.0, 0.0, 5.0, 0.0, 45.0], len(axes.tip.axes)
        build.row(Kind.FEED, *start, feed=1000.0)
        build.row(Kind.CCW, *start, feed=1000.0, curve=(0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 2.0))

        def keep(pieces: Any, count: int, found: list[Any] = found) -> None:
            found.append(np.array(pieces[: count * piece_width(5)]))

        Planner(
            build.toolpath,
            axes.machine,
            settings=BRISK,
            start=axes.tip.to_machine(start),
            on_pieces=keep,
        ).finish()
        run = Run(np.concatenate(found).reshape(-1, piece_width(n))[1:], n)
        _, velocity, _ = real_motion(run, context, np.linspace(0.0, run.seconds, 2000), axes.machine)
        for i, axis in enumerate(axes.tip.axes[:3]):
            assert np.abs(velocity[:, i]).max() <= axes.machine.axis[axis].max_feed * SLACK, (name, axis)


@pytest.mark.parametrize("turn", [90.0, 360.0, 720.0, 21600.0])
def test_with_limited_jerk_axes_keep_their_velocity_while_the_work_turns_round(turn: float) -> None:
    for name, axes in machines().items():
        points = [[150.0, 0.0, 0.0, 0.0, 45.0], [690.0, 841.0, 0.0, 20.0, 45.0 + turn]]
        context = Context(transformation=axes.tip, corner_mode=CornerMode.EXACT_STOP)
        run = run_of(TipPath(name, axes, points, 1000.0), context, SOFT)
        times = np.linspace(0.0, run.seconds, 2000)
        _, velocity, _ = real_motion(run, context, times, axes.machine)
        for i, axis in enumerate(axes.tip.axes):
            assert np.abs(velocity[:, i]).max() <= axes.machine.axis[axis].max_feed * SLACK, (name, axis)


def test_a_row_of_millions_of_turns_is_looked_at_in_so_many_places_at_most() -> None:
    turn = 360.0 * 2.0**24
    for name, axes in machines().items():
        path = TipPath(
            name, axes, [[150.0, 0.0, 0.0, 0.0, 45.0], [690.0, 841.0, 0.0, 20.0, 45.0 + turn]], 1000.0
        )
        fastest = max(axes.machine.axis[axis].max_feed for axis in axes.tip.axes)
        assert planned(path) > turn / fastest  # as long as it takes, and told at once
    assert looks_along(radians(turn)) == MOST_LOOKS


def run_of(path: TipPath, context: Context, settings: Settings = BRISK) -> Run:
    """What the axes do along a path, behind the standing piece at its start."""
    found, n = list[Any](), len(path.axes.tip.axes)
    build, width = Build(path.axes.tip.axes, context), piece_width(n)
    for point in path.points:
        build.row(Kind.FEED, *point, feed=path.feed)
    Planner(
        build.toolpath,
        path.axes.machine,
        settings=settings,
        start=path.axes.tip.to_machine(path.points[0]),
        on_pieces=lambda pieces, count: found.append(np.array(pieces[: count * width]).reshape(count, width)),
    ).finish()
    pieces = np.concatenate(found)
    return Run(pieces[pieces[:, PieceRecord.LENGTH] > 0.0], n)


def off_lines(tips: Numbers, points: Numbers) -> Numbers:
    """How far each of some points is from the nearest of the lines between others, mm."""
    distances = []
    for a, b in pairwise(points):
        way = b - a
        share = np.clip((tips - a) @ way / max(float(way @ way), 1e-12), 0.0, 1.0)
        distances.append(np.linalg.norm(tips - a - share[:, None] * way, axis=1))
    return np.asarray(np.min(distances, axis=0))
