"""Jerk laws: limits of every axis at every moment, the time from one end to the other, both ways to run the kernels."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.motion.third_order.bend import bend
from polycnc.motion.third_order.law import quickest_law
from polycnc.motion.third_order.laws import compiled
from polycnc.motion.third_order.laws.courses import Nodes, Phase, Stencil
from polycnc.motion.third_order.laws.phases import PAIR, lay_phases, leads_on
from polycnc.motion.third_order.laws.quickest import NoLawError, Room, course_of, numbers, quickest
from polycnc.motion.third_order.laws.stencils import lay_stencils
from tests.kernels.strict import strict
from tests.motion.jerk_paths import jerk_paths
from tests.motion.optimum import least_time
from tests.motion.paths import MILL
from tests.motion.third_order.laws import AXES, bow, line, used, wild

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.motion.third_order.bent_path import BentPath

#: What a limit may be exceeded by: a part in a million.
KEPT = 1.0 + 1e-6
#: Times over the least time: the median, and the worst path.
MEDIAN, WORST = 1.12, 1.27


def test_paths_are_run_close_to_the_least_time_and_within_all_limits() -> None:
    pytest.importorskip("scipy", reason="scipy, which solves the linear programmes, is not installed")
    ratios = {}
    for path in jerk_paths():
        bent = bend(path.programmed.path)
        laws = [quickest_law(leg, AXES) for leg in bent]
        assert max(used(leg, law).max() for leg, law in zip(bent, laws, strict=True)) <= KEPT, path.name
        least = least_time(np.array(path.points), path.tolerance, path.feed, MILL)
        ratios[path.name] = sum(law.seconds for law in laws) / least
    assert len(ratios) == 30
    assert float(np.median(list(ratios.values()))) <= MEDIAN, ratios
    assert max(ratios.values()) <= WORST, ratios


@pytest.mark.parametrize("length", [0.01, 1.0, 20.0, 100.0, 2000.0, 50000.0])
def test_a_line_takes_little_more_than_seven_phases(length: float) -> None:
    speed, pull, jerk = AXES.speed[0], AXES.pull[0], AXES.jerk[0]
    least = length / speed + speed / pull + pull / jerk
    if speed * (speed / pull + pull / jerk) > length:  # it does not reach the speed
        reached = 0.5 * (((pull / jerk) ** 2 + 4.0 * length / pull) ** 0.5 - pull / jerk) * pull
        least = length / reached + reached / pull + pull / jerk
        if reached < pull**2 / jerk:  # nor the acceleration
            least = (32.0 * length / jerk) ** (1.0 / 3.0)
    law = quickest_law(line(length), AXES)
    assert least <= law.seconds <= 1.065 * least


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 60))
def test_random_paths_keep_every_limit(seed: int, count: int) -> None:
    path = wild(seed, count)
    law = quickest_law(path, AXES)
    assert used(path, law).max() <= KEPT
    ends = np.array([0.0, law.seconds])
    way, speed, *_ = law.at(ends)
    assert np.abs(way - [0.0, path.way[-1]]).max() <= 1e-9 * path.way[-1]
    assert np.abs(speed).max() <= 1e-6
    # phases go over into each other, and on
    parts = np.diff(np.append(law.start, law.seconds))
    there = law.way + parts * (law.speed + parts * (0.5 * law.pull + parts * law.jerk / 6.0))
    fast = law.speed + parts * (law.pull + 0.5 * parts * law.jerk)
    assert np.all(parts > 0.0)
    assert np.all(np.diff(law.way) > 0.0)
    assert np.abs(there[:-1] - law.way[1:]).max() <= 1e-9 * path.way[-1]
    assert np.abs(fast[:-1] - law.speed[1:]).max() <= 1e-6 * max(1.0, float(law.speed.max()))
    assert np.abs((law.pull + parts * law.jerk)[:-1] - law.pull[1:]).max() <= 1e-5 * max(AXES.pull)


def test_differences_of_positions_keep_the_limits() -> None:
    path = bow(12.0, 5.0)
    law, step = quickest_law(path, AXES), 1e-3
    times = np.arange(-4.0 * step, law.seconds + 4.0 * step, step)
    place = path.at(law.at(times)[0])[0]
    for order, limit in ((1, AXES.speed), (2, AXES.pull), (3, AXES.jerk)):
        assert np.abs(np.diff(place, order, axis=0) / step**order / np.array(limit)).max() <= 1.0 + 1e-5


def test_the_time_of_a_place_is_that_at_which_it_is_reached() -> None:
    path = wild(5, 20)
    law = quickest_law(path, AXES)
    ways = np.linspace(0.0, path.way[-1], 400)
    times = law.times_at(ways)
    assert np.all(np.diff(times) > 0.0)
    assert np.abs(law.at(times)[0] - ways).max() <= 1e-9 * path.way[-1]
    assert times[-1] == law.seconds


def test_a_law_from_a_motion_goes_on_with_it() -> None:
    path = bow(30.0, 4.0, feed=80.0)
    whole = quickest_law(path, AXES)
    _, speed, pull, _ = (float(values[0]) for values in whole.at(np.array([0.06])))
    rest = quickest_law(path, AXES, start=(speed, pull))
    assert rest.speed[0] == pytest.approx(speed)
    assert rest.pull[0] == pytest.approx(pull)
    assert used(path, rest).max() <= KEPT
    assert rest.seconds < whole.seconds
    to = quickest_law(path, AXES, end=(60.0, 0.0))
    assert float(to.at(np.array([to.seconds]))[1][0]) == pytest.approx(60.0)
    assert used(path, to).max() <= KEPT


@pytest.mark.parametrize(
    ("length", "speed"), [(2e-4, 1e-3), (2e-4, 1e-5), (2.0, 1e-1), (2.0, 1e-5), (2.0, 1e-6)]
)
def test_at_a_slow_feed_the_way_to_its_speed_is_no_sliver(speed: float, length: float) -> None:
    least = length / speed + 2.0 * (speed / AXES.jerk[0]) ** 0.5
    path = line(length, speed)
    law = quickest_law(path, AXES)
    assert least <= law.seconds <= 1.3 * least
    assert used(path, law).max() <= KEPT


@given(st.integers(0, 2**32 - 1), st.booleans())
def test_phases_lead_from_each_node_to_the_next_however_the_speed_falls(seed: int, moves: bool) -> None:
    rng = np.random.default_rng(seed)
    count = 12
    way = array("d", np.append(0.0, np.cumsum(10.0 ** rng.uniform(-4.0, 0.0, count - 1))))
    squares = array("d", 10.0 ** rng.uniform(-12.0, 4.0, count))
    first = float(squares[0]) ** 0.5 if moves else 0.0
    squares[0], squares[-1] = first * first, 0.0
    nodes = Nodes(way, squares, numbers(count), numbers(count), array("d"), numbers(count * Stencil.SIZE))
    phases = numbers(PAIR * (count - 1) * Phase.SIZE)
    lay_stencils(nodes, array("d", (first, 0.0, 0.0, 0.0)))
    lay_phases(nodes, phases, 0, count - 1)
    assert all(leads_on(nodes, phases, k) for k in range(1 if moves else 0, count - 1))
    table = np.array(phases).reshape(-1, Phase.SIZE)
    assert table[:, Phase.TIME].min() >= 0.0
    assert np.isfinite(table).all()


def test_what_a_law_leaves_in_a_room_changes_no_other_one() -> None:
    room, axes = Room(), AXES._replace(jerk=array("d", (AXES.jerk[0], 0.1 * AXES.jerk[1], AXES.jerk[2])))
    for path in (wild(3, 60), line(40.0), bow(30.0, 2.0), line(2.0), wild(4, 20), wild(3, 60)):
        found = []
        for where in (room, None):
            flat = (np.ravel(values) for values in (path.way, path.first, path.second, path.cap2, path.ease))
            course = course_of(*(array("d", values) for values in flat))
            found.append(quickest(course, axes, array("d", (0.0, 0.0, 0.0, 0.0)), room=where))
        assert found[0] == found[1] is not None


def test_a_motion_that_cannot_come_to_rest_has_no_law() -> None:
    with pytest.raises(NoLawError):
        quickest_law(line(1.0), AXES, start=(200.0, 0.0))


@pytest.mark.skipif(compiled.LIBRARY.lack is not None, reason="no machine code")
@pytest.mark.parametrize(
    "made",
    [lambda: wild(3, 12), lambda: bend(jerk_paths()[5].programmed.path)[0]],
    ids=["wild", "zigzag"],
)
def test_both_ways_to_run_the_kernels_give_the_same_bits(
    made: Callable[[], BentPath], monkeypatch: pytest.MonkeyPatch
) -> None:
    path = made()
    quick = quickest_law(path, AXES)
    plain = compiled.Kernels._make(map(strict, compiled.plain()))
    monkeypatch.setattr("polycnc.motion.third_order.laws.quickest.kernels", lambda: plain)
    slow = quickest_law(path, AXES)
    for name in ("start", "way", "speed", "pull", "jerk"):
        assert array("d", getattr(quick, name).tobytes()) == array("d", getattr(slow, name).tobytes())
