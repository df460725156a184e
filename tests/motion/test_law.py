"""A place over time, and its averages: of numbers as of arrays."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.motion.law import Law, Phase
from polycnc.motion.phases.speed import ramp

ways = st.floats(0.1, 20.0)
speeds = st.floats(1.0, 100.0)
windows = st.one_of(st.just(0.0), st.floats(0.001, 0.5))


def phases_of(stations: list[tuple[float, float]]) -> list[Phase]:
    """Phases from rest to rest, over ways to squared speeds."""
    start2, found = 0.0, list[Phase]()
    for way, speed in stations:
        found.append(ramp(way, start2, speed * speed))
        start2 = speed * speed
    return [*found, ramp(5.0, start2, 0.0)]


def jerked(steps: list[tuple[float, float]]) -> list[Phase]:
    """Phases of constant jerk that never go back: seconds, and the speed at the end of each, which is up to it."""
    speed, pull, found = 0.0, 0.0, list[Phase]()
    for seconds, goal in steps:
        # Twice the mean acceleration less the first one, if the speed stays above zero in between.
        last = 2.0 * (goal - speed) / seconds - pull
        jerk = (last - pull) / seconds
        turn = -pull / jerk if jerk != 0.0 else 0.0
        if 0.0 < turn < seconds and speed + 0.5 * pull * turn < 0.0:
            continue
        way = seconds * (speed + seconds * (0.5 * pull + seconds * jerk / 6.0))
        found.append(Phase(seconds, way, speed, pull, jerk))
        speed, pull = goal, last
    return found


jerks = st.lists(st.tuples(st.floats(0.01, 0.3), st.floats(0.0, 100.0)), min_size=1, max_size=6)


def both(phases: list[Phase]) -> tuple[Law, Law]:
    """The law that grows phase by phase, and that of all phases at once."""
    law = Law(0.0, 0.0)
    law.run(0.0, 0.0, phases)
    columns = np.array(phases).reshape(-1, 5).T
    return law, Law.of(*(columns if columns[4].any() else columns[:3]))


@given(st.lists(st.tuples(ways, speeds), min_size=1, max_size=6), st.floats(0.001, 0.5))
def test_moment_by_moment_and_many_at_once_are_one_law(
    stations: list[tuple[float, float]], window: float
) -> None:
    law, whole = both(phases_of(stations))
    times = np.linspace(0.0, whole.seconds + window, 50)
    for one in (law, whole):
        assert [one.mean(time, window) for time in times.tolist()] == pytest.approx(whole.mean(times, window))
        assert [one.mean_speed(time, window) for time in times.tolist()] == pytest.approx(
            whole.mean_speed(times, window), abs=1e-6
        )


@given(st.lists(st.tuples(ways, speeds), min_size=1, max_size=6), st.floats(0.001, 0.5))
def test_an_average_is_the_mean_of_its_moments(stations: list[tuple[float, float]], window: float) -> None:
    law, whole = both(phases_of(stations))
    for time in np.linspace(0.0, whole.seconds + window, 7).tolist():
        moments = time - window * (np.arange(4000) + 0.5) / 4000
        assert law.mean(time, window) == pytest.approx(float(whole.at(moments).mean()), abs=1e-4)


@given(st.lists(st.tuples(ways, speeds), min_size=1, max_size=6), windows, st.floats(0.01, 0.99))
def test_the_time_of_a_place_is_when_the_average_is_there(
    stations: list[tuple[float, float]], window: float, share: float
) -> None:
    law, _ = both(phases_of(stations))
    assert law.mean(law.when_mean(share * law.end, window), window) == pytest.approx(
        share * law.end, abs=1e-9
    )


@given(jerks)
def test_under_a_jerk_the_way_is_the_integral_of_the_speed_and_that_of_the_acceleration(
    steps: list[tuple[float, float]],
) -> None:
    phases = jerked(steps)
    edges = np.cumsum([0.0, *(phase.seconds for phase in phases)])
    times = np.unique(np.concatenate([edges, np.linspace(0.0, edges[-1], 1000)]))
    middle, step = 0.5 * (times[1:] + times[:-1]), np.diff(times)
    inside = slice(1, -1)  # at its end a law stops at once
    for law in both(phases):
        assert law.speed(times)[inside] == pytest.approx(np.cumsum(law.pull(middle) * step)[:-1], abs=1e-6)
        assert law.at(times)[1:] == pytest.approx(np.cumsum(law.speed(middle) * step), abs=1e-3)
        of_one = [[value(time) for time in times.tolist()] for value in (law.at, law.speed, law.pull)]
        of_many = [value(times) for value in (law.at, law.speed, law.pull)]
        assert np.array(of_one) == pytest.approx(np.array(of_many), rel=1e-12, abs=1e-12)


@given(jerks, st.floats(0.001, 0.5))
def test_under_a_jerk_an_average_is_the_mean_of_its_moments(
    steps: list[tuple[float, float]], window: float
) -> None:
    law, whole = both(jerked(steps))
    for time in np.linspace(0.0, whole.seconds + window, 7).tolist():
        moments = time - window * (np.arange(4000) + 0.5) / 4000
        for one in (law, whole):
            assert one.mean(time, window) == pytest.approx(float(whole.at(moments).mean()), abs=1e-4)
            assert one.mean_speed(time, window) == pytest.approx(float(whole.speed(moments).mean()), abs=0.1)


@given(jerks, windows, st.floats(0.0, 1.0))
def test_under_a_jerk_the_time_of_a_place_is_when_the_average_is_there(
    steps: list[tuple[float, float]], window: float, share: float
) -> None:
    law, whole = both(jerked(steps))
    assert law.when(share * law.end) == pytest.approx(whole.when(share * whole.end), abs=1e-9)
    assert law.at(law.when(share * law.end)) == pytest.approx(share * law.end, abs=1e-12)
    time = law.when_mean(share * law.end, window)
    assert law.mean(time, window) == pytest.approx(share * law.end, abs=1e-9)


def test_what_is_forgotten_changes_no_average() -> None:
    phases = phases_of([(3.0, 20.0), (1.0, 5.0), (9.0, 40.0)])
    kept, forgetful = both(phases)[0], both(phases)[0]
    forgetful.forget(0.6)
    assert forgetful.phases < kept.phases
    for time in np.linspace(0.7, 2.0, 20).tolist():
        assert forgetful.mean(time, 0.1) == pytest.approx(kept.mean(time, 0.1), abs=1e-12)


def test_averages_of_a_long_run_are_as_exact_as_those_of_a_short_one() -> None:
    """A thousand seconds at 100 mm/s: third differences at 1 ms would show an error of a nanometre."""
    seconds = np.full(100_000, 0.01)
    law = Law.of(seconds, seconds * 100.0, np.full(100_000, 100.0))
    times = np.arange(990.0, 991.0, 0.001)
    jerk = np.diff(law.mean(times, 0.06), 3) / 1e-9
    assert np.abs(jerk).max() < 1.0


def test_what_comes_from_a_time_on_takes_the_place_of_what_was_said_before() -> None:
    law = Law(0.0, 0.0)
    law.run(0.0, 0.0, [Phase(10.0, 100.0, 10.0, 0.0)])
    law.run(2.0, 20.0, [Phase(1.0, 5.0, 10.0, -10.0)])
    assert (law.at(1.0), law.at(3.0), law.at(9.0)) == pytest.approx((10.0, 25.0, 25.0))
