"""Arcs of a tool's tip: what their axes need for the bend of the way, and what is left to get fast."""

from __future__ import annotations

from math import sqrt
from statistics import median
from typing import Any

import numpy as np
import pytest

from polycnc.motion import Settings
from polycnc.motion.kernels.columns import piece_width
from polycnc.motion.planner import Planner
from polycnc.motion.reach import AT_JOINT, LEAST_LEFT, Place, between, ease_at, largest2, shares_of
from polycnc.motion.sampling.run import Run
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.modes import AccelerationMode, CornerMode
from tests.examples import examples
from tests.motion.five_axes import TipArc, least_time_of_arc, random_arcs
from tests.motion.paths import Build
from tests.motion.test_transformed import SLACK, real_motion

BRISK = Settings(acceleration=AccelerationMode.CONSTANT)
#: One axis bends by 1/50 mm, another one goes along the path; 1000 mm/s² for both.
EVEN = Place(1e6, 1000.0, [(1.0 / 50_000.0, 0.0), (0.0, 1.0)])
#: One axis does both.
SHARED = Place(1e6, 1000.0, [(1.0 / 50_000.0, 1.0)])


def laid(arc: TipArc, corners: CornerMode) -> tuple[float, Run, Context]:
    """Seconds of an arc, and what the axes do."""
    context = Context(transformation=arc.axes.tip, corner_mode=corners)
    build, found = Build(arc.axes.tip.axes, context), list[Any]()
    start, end = arc.at(np.array([0.0, 1.0]))
    build.row(Kind.FEED, *start, feed=arc.feed)
    kind = Kind.HELIX_CCW if arc.lift else Kind.CCW
    build.row(kind, *end, feed=arc.feed, curve=(*arc.center, 0.0, 0.0, 1.0, 0.0))

    def keep(pieces: Any, count: int) -> None:
        found.append(np.array(pieces[: count * piece_width(5)]))

    plan = Planner(
        build.toolpath,
        arc.axes.machine,
        settings=BRISK,
        start=arc.axes.tip.to_machine(list(start)),
        on_pieces=keep,
    ).finish()
    run = Run(np.concatenate(found).reshape(-1, piece_width(5))[1:], 5)
    return float(plan.row_s[1]), run, context


def test_arcs_of_a_tip_take_little_longer_than_their_axes_need() -> None:
    pytest.importorskip("scipy", reason="scipy, which solves the linear programmes, is not installed")
    arcs = random_arcs(examples(18), seed=5)
    ratios = [laid(arc, CornerMode.EXACT_STOP)[0] / least_time_of_arc(arc) for arc in arcs]
    assert median(ratios) <= 1.05
    assert max(ratios) <= 1.1
    assert min(ratios) >= 0.995


@pytest.mark.parametrize("corners", [CornerMode.EXACT_STOP, CornerMode.CONTINUOUS])
def test_at_every_sample_of_an_arc_axes_keep_their_limits(corners: CornerMode) -> None:
    for arc in random_arcs(15, seed=9):
        _, run, context = laid(arc, corners)
        times = np.linspace(0.0, run.seconds, 800)
        _, velocity, acceleration = real_motion(run, context, times, arc.axes.machine)
        for i, name in enumerate(arc.axes.tip.axes):
            axis = arc.axes.machine.axis[name]
            assert np.abs(velocity[:, i]).max() <= axis.max_feed * SLACK, (arc.name, name)
            assert np.abs(acceleration[:, i]).max() <= axis.acceleration * SLACK, (arc.name, name)


def test_axes_of_their_own_for_bend_and_speed_have_all_of_both() -> None:
    assert ease_at(EVEN, largest2(EVEN)) == pytest.approx(1.0)
    assert ease_at(SHARED, 0.25 * largest2(SHARED)) == pytest.approx(0.75)


def test_what_a_place_allows_ends_at_the_lower_of_both() -> None:
    assert largest2(SHARED) == pytest.approx(50_000.0)
    assert largest2(SHARED._replace(top2=10.0)) == 10.0
    assert ease_at(Place(1.0, 1.0, []), 1.0) == 1.0


def test_between_two_places_an_axis_may_be_asked_for_more_than_at_both() -> None:
    middle = between(EVEN, EVEN, 1.0)
    assert middle.asks[0][0] > EVEN.asks[0][0]
    assert middle.top2 < EVEN.top2


def test_a_row_from_rest_begins_with_the_whole_acceleration() -> None:
    shares = shares_of([SHARED] * 29, 200.0, 0.0, stops=True)
    eases = [ease for _, _, ease in shares]
    assert eases[0] > 0.7 > eases[5] >= LEAST_LEFT
    assert max(top for _, top, _ in shares) == pytest.approx(sqrt(50_000.0), rel=0.02)
    assert [end for end, _, _ in shares][-1] == 1.0


def test_a_short_row_from_rest_keeps_its_acceleration() -> None:
    shares = shares_of([SHARED] * 29, 1.0, 0.0, stops=True)
    assert min(ease for _, _, ease in shares) > 0.95


def test_a_row_that_may_be_entered_at_speed_has_the_same_all_along() -> None:
    shares = shares_of([SHARED] * 29, 1000.0, 0.0, stops=False)
    assert {round(ease, 9) for _, _, ease in shares} == {round(1.0 - AT_JOINT, 9)}
