"""A run by law: undisturbed it is the plan's; disturbed it brakes, slows down, rests and leads on within the limits."""

from __future__ import annotations

from math import cos, sin

import numpy as np
import pytest

from polycnc.mainrun.motion.law_run import LawRun, State
from tests.motion.third_order.laws import AXES
from tests.motion.third_order.long_runs import chunks
from tests.motion.third_order.programmed import Bounds, ProgrammedPath

FEED, PERIOD = 80.0, 0.001
PULL, JERK = min(AXES.pull), min(AXES.jerk)


class Speeds:
    """What is asked for: may change at any moment."""

    def __init__(self) -> None:
        self.asked = FEED

    def __call__(self, begin: float, end: float, *, asked: bool) -> float:
        return self.asked**2 if asked else 200.0**2


def facets(count: int, speeds: Speeds, time: float = 5.0) -> LawRun:
    """A run along a circle in lines of about 0.5 mm."""
    path = ProgrammedPath([0.0] * 3, AXES.speed)
    for k in range(1, count + 1):
        path.line([50.0 * sin(k / 100), 50.0 - 50.0 * cos(k / 100), 0.0], k, Bounds(0.01, FEED))
    run, left = LawRun(AXES, time, speeds), len(path.path.form)
    for chunk in chunks(path.path, [64] * (left // 64 + 1)):
        left -= len(chunk.form)
        run.take(chunk, closed=left == 0)
    return run


def used(run: LawRun, begin: float) -> float:
    """The largest part of acceleration and jerk that any axis uses, by differences of its places."""
    places = np.array([run.place(run.law.at(t)) for t in np.arange(begin, run.end_time + 0.01, PERIOD)])
    pull = np.abs(np.diff(places, 2, axis=0)).max(axis=0) / PERIOD**2 / np.array(AXES.pull)
    jerk = np.abs(np.diff(places, 3, axis=0)).max(axis=0) / PERIOD**3 / np.array(AXES.jerk)
    return float(max(pull.max(), jerk.max()))


def test_undisturbed_it_leads_to_the_end() -> None:
    run = facets(300, Speeds())
    assert run.is_planned
    assert run.is_closed
    assert run.end_way == pytest.approx(run.known_way)
    assert run.place(run.known_way) == pytest.approx([50 * sin(3.0), 50 - 50 * cos(3.0), 0.0], abs=1e-6)


@pytest.mark.parametrize("after", [0.02, 0.05, 0.1, 0.5, 1.0])
def test_it_brakes_as_soon_as_the_axes_can(after: float) -> None:
    run = facets(300, Speeds())
    time = 5.0 + after
    speed, pull = run.law.speed(time), run.law.pull(time)
    assert run.brake(time)
    assert not run.is_planned
    high = speed + 0.5 * pull * abs(pull) / JERK
    ramp = high / PULL + PULL / JERK if high * JERK > PULL**2 else 2.0 * (high / JERK) ** 0.5
    assert run.end_time - time <= 1.2 * (ramp + pull / JERK)
    assert used(run, 5.0) < 1.001


@pytest.mark.parametrize("share", [0.9, 0.5, 0.1])
def test_a_lower_speed_is_reached_from_above(share: float) -> None:
    speeds = Speeds()
    run = facets(400, speeds)
    speeds.asked = share * FEED
    assert run.lead_to(6.0)
    found = [run.law.speed(6.0 + 0.01 * k) for k in range(60)]
    assert max(found[40:]) <= 1.001 * speeds.asked
    assert min(found) > speeds.asked - 0.05 * FEED
    assert used(run, 5.0) < 1.001


def test_it_rests_where_it_shall_and_goes_on() -> None:
    run = facets(400, Speeds())
    stop = run.law.at(6.0) + 30.0
    assert run.lead_to(6.0, stop)
    assert run.end_way == pytest.approx(stop)
    assert not run.is_short
    assert run.lead_to(run.end_time + 1.0)
    assert run.end_way == pytest.approx(run.known_way)
    assert used(run, 5.0) < 1.001


def test_a_stop_that_is_too_near_gives_no_law() -> None:
    run = facets(400, Speeds())
    end = run.end_way
    assert not run.lead_to(6.0, run.law.at(6.0) + 0.5)
    assert run.end_way == end
    assert run.is_planned


def test_a_law_that_ends_ahead_is_led_farther() -> None:
    run = facets(400, Speeds())
    far = run.law.at(6.0) + 40.0
    assert run.lead_to(6.0, far=far)
    found = [(run.end_way, run.is_short)]
    run.lead_farther(6.1, far + 30.0, far + 60.0)
    found.append((run.end_way, run.is_short))
    assert [way for way, _ in found] == pytest.approx([far, far + 30.0])
    assert [short for _, short in found] == [True, False]
    assert used(run, 5.0) < 1.001


def test_what_lies_behind_is_forgotten() -> None:
    run = facets(5000, Speeds())
    way = 0.8 * run.known_way
    time = run.law.when(way)
    places, phases, parts = [run.place(way + k) for k in range(50)], run.law.phases, len(run._parts)
    run.forget(way, time)
    assert len(run._parts) < parts
    assert run.law.phases < phases
    assert [run.place(way + k) for k in range(50)] == places
    assert run.law.when(way) == time


@pytest.mark.parametrize("before", [0.03, 0.02, 0.012, 0.006, 1e-3, 3e-4, 1e-5])
def test_a_motion_that_is_about_to_rest_goes_on_within_the_limits_or_rests(before: float) -> None:
    speeds = Speeds()
    run = facets(300, speeds)
    run.brake(6.0)
    speeds.asked = 0.5 * FEED
    run.lead_to(run.end_time - before)
    assert used(run, 5.0) < 1.001


def test_from_nearly_at_rest_there_is_a_law_or_none_but_none_that_misses_its_nodes() -> None:
    run = facets(300, Speeds())
    for share in np.linspace(0.1, 1.2, 45):
        pull = -900.0
        found = run._to_rest(State(20.0, pull * pull / (2.0 * JERK) / share, pull), 60.0)
        if found is not None:
            assert 20.0 + sum(phase.way for phase in found) == pytest.approx(60.0, abs=1e-6)
