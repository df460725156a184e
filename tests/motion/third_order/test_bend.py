"""Bent paths of random programmed ones: tolerance, ends, continuity, rows, speeds; and of known ones."""

from __future__ import annotations

from itertools import pairwise
from math import pi, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.motion.third_order.bend import bend
from polycnc.motion.third_order.law import limits_of, quickest_law
from tests.motion.paths import MILL
from tests.motion.third_order.programmed import Bounds, ProgrammedPath
from tests.motion.third_order.programmed_paths import TOPS, Drawn, drawn_paths, parts_of_tolerance

SURELY = 1.0 + 1e-6
TOLERANCES = st.sampled_from((0.001, 0.01, 0.1))


@settings(max_examples=40, deadline=None)
@given(drawn_paths(TOLERANCES))
def test_random_paths_are_bent_within_their_tolerance(drawn: Drawn) -> None:
    path = drawn.path.path
    legs = bend(path)
    lines, turns = parts_of_tolerance(drawn, legs)
    assert lines <= SURELY
    assert turns <= SURELY
    assert legs[0].place[0].tolist() == list(path.place[:4])
    assert np.abs(legs[-1].place[-1] - drawn.path.position).max() < 1e-9
    for before, behind in pairwise(legs):
        assert np.abs(before.place[-1] - behind.place[0]).max() < 1e-9
    assert sum(leg.way[-1] for leg in legs) == pytest.approx(path.way[-1])


@settings(max_examples=40, deadline=None)
@given(drawn_paths(TOLERANCES))
def test_pieces_go_over_into_each_other(drawn: Drawn) -> None:
    for leg in bend(drawn.path.path):
        step, third = np.diff(leg.way)[:, None], leg.third
        assert (step > 0.0).all()
        second = leg.second[:-1] + step * third
        first = leg.first[:-1] + step * (leg.second[:-1] + 0.5 * step * third)
        place = leg.place[:-1] + step * (leg.first[:-1] + step * (0.5 * leg.second[:-1] + step * third / 6.0))
        assert np.abs(place - leg.place[1:]).max() < 1e-8
        assert (np.abs(first - leg.first[1:]) / (1.0 + np.abs(leg.first[1:]))).max() < 1e-7
        assert (np.abs(second - leg.second[1:]) / (1.0 + np.abs(leg.second[1:]))).max() < 1e-7


@settings(max_examples=40, deadline=None)
@given(drawn_paths(TOLERANCES))
def test_rows_and_speeds_are_known(drawn: Drawn) -> None:
    legs = bend(drawn.path.path)
    for leg in legs:
        assert (np.diff(leg.rows) > 0).all()
        assert (np.diff(leg.row_way) > 0.0).all()
        assert leg.row_way[-1] == pytest.approx(leg.way[-1])
        # A piece has the number of the row in which it begins.
        middle = leg.way[:-1] + 1e-9
        assert np.array_equal(leg.row, leg.rows[np.searchsorted(leg.row_way, middle, "right")])
        inner = np.linspace(leg.way[:-1], leg.way[1:], 9)
        v = np.sqrt(leg.cap2)
        fastest = np.array([drawn.bounds[row].speed for row in leg.row])
        for ways in inner:
            _, first, _ = leg.at(np.minimum(ways, leg.way[1:] * (1.0 - 1e-15)))
            assert (v * np.sqrt((first[:, :3] ** 2).sum(1)) <= fastest * 1.0001).all()
            assert (v[:, None] * np.abs(first) <= np.array(TOPS) * 1.0001).all()
    assert sum(len(leg.rows) for leg in legs) >= len(drawn.points)


def test_a_line_is_one_piece_by_its_length() -> None:
    path = ProgrammedPath([1.0, 2.0, 3.0], [250.0] * 3)
    path.line([4.0, 6.0, 3.0], 7, Bounds(0.01, 100.0))
    (bent,) = bend(path.path)
    assert bent.way.tolist() == [0.0, 5.0]
    assert np.abs(bent.at(np.array([2.5]))[0] - [2.5, 4.0, 3.0]).max() < 1e-14
    assert np.abs(bent.second).max() < 1e-14
    assert bent.row.tolist() == bent.rows.tolist() == [7]


def test_a_slow_row_on_a_line_slows_no_other_one() -> None:
    path = ProgrammedPath([0.0, 0.0, 0.0], [250.0] * 3)
    for row, (x, speed) in enumerate([(10.0, 50.0), (10.0001, 1.0), (11.0, 1.02), (50.0, 50.0)]):
        path.line([x, 0.0, 0.0], row, Bounds(0.01, speed))
    (bent,) = bend(path.path)
    assert np.sqrt(bent.cap2[np.searchsorted(bent.way, [9.0, 10.00005, 10.5, 12.0]) - 1]) == pytest.approx(
        [50.0, 1.0, 1.0, 50.0]
    )
    assert len(bent.cap2) == 3
    assert bent.row.tolist() == [0, 1, 3]
    assert np.abs(bent.place[:, 0] - bent.way).max() < 1e-12
    assert quickest_law(bent, limits_of(MILL.axes)).seconds < 3.0


def test_a_part_that_is_eased_eases_no_other_one() -> None:
    path = ProgrammedPath([0.0, 0.0, 0.0], [250.0] * 3)
    for row, (x, ease) in enumerate([(10.0, 1.0), (20.0, 0.1), (50.0, 1.0)]):
        path.line([x, 0.0, 0.0], row, Bounds(0.01, 100.0, ease=ease))
    (bent,) = bend(path.path)
    assert bent.way.tolist() == [0.0, 10.0, 20.0, 50.0]
    assert bent.ease.tolist() == [1.0, 0.1, 1.0]


@pytest.mark.parametrize("degrees", [20.0, 90.0, 150.0])
@pytest.mark.parametrize("tolerance", [0.001, 0.1])
def test_a_lone_corner_uses_its_tolerance_up(degrees: float, tolerance: float) -> None:
    turn = degrees * pi / 180.0
    drawn = Drawn()
    for heading in (0.0, turn):
        drawn.line(20.0, heading, 0.0, 0.0, Bounds(tolerance))
    (bent,) = bend(drawn.path.path)
    d = 2.0 * np.sin(turn / 2.0)
    away = bent.at(np.array([20.0]))[0][0] - [20.0, 0.0, 0.0, 0.0]
    assert 0.97 * tolerance <= sqrt(away @ away) <= tolerance
    # Half the width 6·tolerance/d of a triangle of q'' on either side: lines beyond.
    assert np.abs(np.diff(bent.way)[1:3] / (6.0 * tolerance / d) - 1.0).max() < 0.03
    assert sqrt((bent.second[2] ** 2).sum()) == pytest.approx(d * d / (6.0 * tolerance), rel=0.03)
    assert np.abs(bent.second[[0, 1, 3, 4]]).max() < 1e-12


def test_many_short_lines_are_few_pieces() -> None:
    drawn = Drawn()
    drawn.facets(20.0, 2.0 * pi, 1000, Bounds(0.01))
    (bent,) = bend(drawn.path.path)
    assert len(bent.row) < 150
    # Their curve bends evenly: what q'' changes by is what that of a circle does.
    inner = (bent.way > 5.0) & (bent.way < bent.way[-1] - 5.0)
    bow = np.sqrt((bent.second[inner] ** 2).sum(1))
    assert bow.max() / bow.min() < 1.02


def test_a_path_rests_where_it_turns_back_or_may_not_be_left() -> None:
    drawn = Drawn()
    drawn.line(10.0, 0.0, 0.0, 0.0, Bounds(0.1))
    drawn.line(10.0, pi, 0.0, 0.0, Bounds(0.1))
    drawn.line(10.0, 1.0, 0.0, 0.0, Bounds(0.0))
    drawn.line(10.0, 1.0, 0.0, 0.0, Bounds(0.1))
    legs = bend(drawn.path.path)
    assert [leg.rows.tolist() for leg in legs] == [[0], [1], [2], [3]]
    assert np.abs(legs[0].place[-1] - [10.0, 0.0, 0.0, 0.0]).max() < 1e-12


def test_a_path_rests_where_a_rotary_axis_turns_on_almost_no_way() -> None:
    for turn, count in ((90.0, 3), (0.5, 1)):
        path = ProgrammedPath([0.0, 0.0], [250.0, 100.0], [False, True], (0, -1, -1))
        for row, end in enumerate(([10.0, 0.0], [10.01, turn], [50.0, turn])):
            path.line(end, row, Bounds(0.01, 50.0))
        assert len(bend(path.path)) == count


def test_a_path_rests_beside_a_row_that_creeps() -> None:
    path = ProgrammedPath([0.0, 0.0, 0.0], [250.0] * 3)
    for row, (x, speed) in enumerate([(10.0, 50.0), (10.0001, 2e-4), (10.0002, 2e-4), (50.0, 50.0)]):
        path.line([x, 0.0, 0.0], row, Bounds(0.01, speed))
    legs = bend(path.path)
    assert [leg.rows.tolist() for leg in legs] == [[0], [1, 2], [3]]
    assert sum(quickest_law(leg, limits_of(MILL.axes)).seconds for leg in legs) < 2.3


def test_short_zigzags_become_flatter() -> None:
    drawn = Drawn()
    for k in range(60):
        drawn.line(0.5, 0.087 * (1 - 2 * (k % 2)) if k else 0.0435, 0.0, 0.0, Bounds(0.01))
    (bent,) = bend(drawn.path.path)
    inner = (bent.way > 5.0) & (bent.way < 25.0)
    assert np.abs(bent.second[inner]).max() < 0.6 * 0.087 / 0.5
    lines, _ = parts_of_tolerance(drawn, [bent])
    assert 0.85 < lines <= SURELY


def test_a_small_tolerance_is_kept_beside_a_large_one() -> None:
    drawn = Drawn()
    for tolerance in (0.001, 0.1, 0.001):
        drawn.line(1.0, 0.4, 0.0, 0.0, Bounds(tolerance))
        drawn.arc(0.5, 2.0, 0.0, 0.0, 0.0, Bounds(0.1))
    lines, _ = parts_of_tolerance(drawn, bend(drawn.path.path))
    assert lines <= SURELY


def test_what_cannot_be_met_raises() -> None:
    path = ProgrammedPath([1e13, 0.0, 0.0], [250.0] * 3)  # places are 0.002 mm apart there
    path.arc([1e13, 2.0, 0.0], (1e13, 1.0, 0.0), (0.0, 0.0, 1.0), pi, 3, Bounds(1e-4))
    with pytest.raises(ValueError, match="rows 3 to 3"):
        bend(path.path)
