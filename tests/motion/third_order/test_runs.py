"""Runs in windows: like the whole run in one piece, the same however they come, within all limits across seams."""

from __future__ import annotations

import tracemalloc
from array import array
from copy import deepcopy
from itertools import repeat
from math import cos, sin
from random import Random
from typing import TYPE_CHECKING

import numpy as np
import pytest

from polycnc.motion.third_order import compiled, parts, runs
from polycnc.motion.third_order import windows as windows_module
from polycnc.motion.third_order.bend import as_path, bend, legs
from polycnc.motion.third_order.law import law_of, quickest_law
from polycnc.motion.third_order.laws import compiled as laws_compiled
from polycnc.motion.third_order.laws import quickest as quickest_module
from polycnc.motion.third_order.laws.quickest import NoLawError
from polycnc.motion.third_order.runs import Passing, RunPlanner, Sizes
from tests.examples import examples
from tests.motion.jerk_paths import jerk_paths
from tests.motion.third_order.laws import AXES
from tests.motion.third_order.long_runs import (
    SHORT,
    behind_one_another,
    gaps,
    legs_of,
    most_used,
    part_of,
    positions,
    seconds_of,
    windows_of,
)
from tests.motion.third_order.programmed import Bounds, ProgrammedPath
from tests.motion.third_order.programmed_paths import parts_of_leg

if TYPE_CHECKING:
    from polycnc.motion.third_order.bends.stretches import Stretches
    from polycnc.motion.third_order.windows import Window

#: Windows of a few tenths of a second cost so much time.
SLOWER = 0.04
KEPT = 1.0 + 1e-6


def lines(seed: int, count: int, turn: float, tolerance: float = 0.01, *, eased: bool = False) -> Stretches:
    """Short lines in random directions."""
    random, path = Random(seed), ProgrammedPath([0.0] * 3, AXES.speed)
    place, heading = [0.0] * 3, 0.0
    for k in range(count):
        heading += random.uniform(-turn, turn)
        length = random.uniform(0.2, 1.0)
        place = [place[0] + length * cos(heading), place[1] + length * sin(heading), place[2]]
        ease = 0.5 if eased and k // 50 % 2 else 1.0
        path.line(place, k, Bounds(tolerance, 80.0, ease=ease))
    return path.path


def long_runs() -> list[Stretches]:
    """The thirty paths, each so often behind itself that there are several windows, and all behind one another."""
    alone = []
    for path in jerk_paths():
        stretches = path.programmed.path
        alone.append(behind_one_another(repeat(stretches, 1 + 600 // len(stretches.form))))
    return [*alone, behind_one_another(path.programmed.path for path in jerk_paths())]


def within(path: Stretches, windows: list[Window]) -> float:
    """The largest part of the tolerance that they use."""
    return max(parts_of_leg(leg, bent, 8)[0] for leg, bent in zip(legs(path), legs_of(windows), strict=True))


@pytest.mark.parametrize("number", range(31)[:: 31 // examples(31)])  # of every sort of path, however few
def test_windows_are_run_like_the_whole(number: int) -> None:
    path = long_runs()[number]
    windows = windows_of(deepcopy(path))
    assert len(windows) >= 2
    assert within(deepcopy(path), windows) <= KEPT
    whole = sum(quickest_law(leg, AXES).seconds for leg in bend(path))
    assert seconds_of(windows) == pytest.approx(whole, rel=SLOWER)
    assert most_used(windows) <= KEPT
    assert (gaps(windows) <= [1e-8, 1e-8, 1e-6, 1e-6, 1e-3]).all(), gaps(windows)
    assert [row for w in windows for row in w.part.rows] == list(dict.fromkeys(path.row))


@pytest.mark.parametrize("number", [5, 10, 12, 17, 20, 25][: examples(6)])
def test_windows_of_the_usual_size_take_no_longer(number: int) -> None:
    stretches = jerk_paths()[number].programmed.path
    path = behind_one_another(repeat(stretches, 1 + 3500 // len(stretches.form)))
    windows = windows_of(deepcopy(path), Sizes())
    assert len(windows) >= 3
    whole = sum(quickest_law(leg, AXES).seconds for leg in bend(path))
    assert seconds_of(windows) == pytest.approx(whole, rel=1e-3)


@pytest.mark.parametrize("turn", [0.03, 0.3, 2.0])
def test_the_same_bits_whatever_the_chunks(turn: float) -> None:
    path, random = lines(3, 1500, turn), Random(1)
    whole = windows_of(path)
    assert len(whole) > 5
    for counts in ((1,) * 1500, [random.randrange(400) for _ in range(99)]):
        assert windows_of(path, counts=counts) == whole


def test_differences_of_positions_keep_the_limits_across_seams() -> None:
    windows = windows_of(lines(5, 1000, 0.4))
    step = 1e-3
    assert len(windows) > 5
    places = positions(windows, step)
    for order, limit in ((1, AXES.speed), (2, AXES.pull), (3, AXES.jerk)):
        assert np.abs(np.diff(places, order, axis=0) / step**order / np.array(limit)).max() <= 1.0 + 1e-5


def test_what_the_program_eases_is_eased() -> None:
    path = lines(7, 600, 0.3, eased=True)
    windows = windows_of(path)
    assert len(windows) > 3
    for window in windows:
        bent, law = as_path(window.part), law_of(window.phases, window.part.way[-1])
        middles = law.start + 0.5 * np.diff(np.append(law.start, law.seconds))
        way, speed, pull, jerk = law.at(middles)
        piece = bent.piece_at(way)
        _, first, second = bent.at(way)
        v, u, j, ease = speed[:, None], pull[:, None], jerk[:, None], bent.ease[piece][:, None]
        assert (np.abs(first * u + second * v**2) <= ease * np.array(AXES.pull) * KEPT).all()
        jolt = first * j + 3.0 * second * v * u + bent.third[piece] * v**3
        assert (np.abs(jolt) <= ease * np.array(AXES.jerk) * KEPT).all()
        assert set(np.unique(bent.ease)) <= {0.5, 1.0}
    assert seconds_of(windows) > 1.1 * seconds_of(windows_of(lines(7, 600, 0.3)))


def test_memory_is_that_of_windows() -> None:
    def peak(count: int) -> int:
        """Of a run of so many lines, which come one after another."""
        planner, place, heading = RunPlanner(AXES, lambda _: None, sizes=SHORT), [0.0, 0.0, 0.0], 0.0
        tracemalloc.start()
        for k in range(count):
            lead = ProgrammedPath(place, AXES.speed)
            heading += 0.1 * (-1.0) ** (k // 3)
            place = [place[0] + 0.5 * cos(heading), place[1] + 0.5 * sin(heading), 0.0]
            lead.line(place, k, Bounds(0.01, 80.0))
            lead.path.way[:] = array("d", (0.5 * k, 0.5 * k + 0.5))
            planner.take(lead.path)
        planner.finish()
        most = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return most

    peak(2400)  # calls of compiled kernels are written out once they are many
    assert peak(2400) < 1.1 * peak(800)


def test_rests_within_a_run_end_windows() -> None:
    path = ProgrammedPath([0.0] * 3, AXES.speed)
    for k in range(4):
        path.line([10.0 * ((k + 1) % 2), 0.0, 0.0], k, Bounds(0.01, 80.0))
    windows = windows_of(path.path)
    assert [(list(w.part.rows), w.stops) for w in windows] == [([k], True) for k in range(4)]


def test_a_rest_behind_a_seam_is_not_passed() -> None:
    path = lines(4, 200, 0.1)
    back = lines(5, 200, 0.1)
    back = back._replace(place=array("d", [-place for place in back.place]))
    back = back._replace(leave=array("d", [-slope for slope in back.leave]))
    back = back._replace(arrive=array("d", [-slope for slope in back.arrive]))
    windows = windows_of(behind_one_another((path, back)))
    rows = [row for w in windows for row in w.part.rows]
    assert rows == list(range(400))
    ends = [w.part.rows[-1] for w in windows if w.stops]
    assert ends[-1] == 399
    assert len(windows) > len(ends) == len(list(legs(behind_one_another((path, back)))))


def test_a_run_can_begin_and_end_in_motion() -> None:
    """The parts of a run that are planned apart from each other make the whole one again."""
    path = ProgrammedPath([0.0] * 3, AXES.speed)
    for k in range(1, 401):
        angle = 0.005 * k
        path.line([100.0 * sin(angle), 100.0 * (1.0 - cos(angle)), 0.0], k, Bounds(0.01, 40.0))
    whole, seam = path.path, Passing(path.path.way[200], 0.4, 39.96)
    made: list[Window] = []
    before = RunPlanner(AXES, made.append, sizes=SHORT)
    before.take(part_of(whole, 3, 0, 210))
    before.finish(seam)
    split = len(made)
    behind = RunPlanner(AXES, made.append, start=seam, sizes=SHORT)
    behind.take(part_of(whole, 3, 190, 195))
    behind.take(part_of(whole, 3, 195, 400))
    behind.finish()
    assert [w.stops for w in made] == [False] * (len(made) - 1) + [True]
    assert 0 < split < len(made)
    assert most_used(made) <= KEPT
    assert (gaps(made) <= [1e-8, 1e-8, 1e-6, 1e-6, 1e-3]).all(), gaps(made)
    assert [row for w in made for row in w.part.rows] == list(range(1, 401))
    law = law_of(made[split - 1].phases, made[split - 1].part.way[-1])
    assert law.at(np.array([law.seconds]))[1][0] == pytest.approx(39.96)
    assert seconds_of(made) == pytest.approx(seconds_of(windows_of(whole)), rel=5e-3)


def test_from_a_motion_that_cannot_be_no_law_leads() -> None:
    path = lines(1, 40, 0.1)
    planner = RunPlanner(AXES, lambda _: None, start=Passing(path.way[20], 0.01, 249.0))
    planner.take(path)
    with pytest.raises(NoLawError):
        planner.finish()


@pytest.mark.skipif(compiled.LIBRARY.lack is not None, reason="no machine code")
def test_both_ways_to_run_the_kernels_give_the_same_bits(monkeypatch: pytest.MonkeyPatch) -> None:
    quick = windows_of(lines(2, 400, 0.2))
    for module in (runs, parts, windows_module):
        name = "bending" if module is windows_module else "kernels"
        monkeypatch.setattr(module, name, compiled.plain)
    for module in (windows_module, quickest_module):
        monkeypatch.setattr(module, "kernels", laws_compiled.plain)
    assert windows_of(lines(2, 400, 0.2)) == quick
