"""Levels across a contour."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.cycles.turning.contour import Contour, Piece, climb, crossings, gaps, reversal, shifted, swapped
from polycnc.geometry import offset

if TYPE_CHECKING:
    from polycnc.geometry.arcs import Point


def lines(*points: Point) -> Contour:
    return [Piece(offset.line(a, b)) for a, b in itertools.pairwise(points)]


POCKET = lines(
    (2.0, 25.0), (2.0, 15.0), (-10.0, 15.0), (-15.0, 10.0), (-20.0, 10.0), (-25.0, 15.0), (-25.0, 24.0)
)


def test_a_level_above_a_pocket_is_one_gap_and_one_within_it_another() -> None:
    assert [(g.start, g.end) for g in gaps(POCKET, 20.0, -1.0)] == [(2.0, -25.0)]
    assert [(g.start, g.end) for g in gaps(POCKET, 12.0, -1.0)] == [(-13.0, -22.0)]


def test_a_level_that_the_contour_never_comes_up_to_ends_with_the_contour() -> None:
    (gap,) = gaps(lines((2.0, 25.0), (2.0, 15.0), (-10.0, 15.0)), 20.0, -1.0)
    assert (gap.end, gap.piece) == (-10.0, 2)


def test_a_run_along_the_level_is_no_gap() -> None:
    assert gaps(POCKET, 10.0, -1.0) == []


def test_an_arc_is_crossed_where_its_circle_is() -> None:
    edge = offset.arc((0.0, 0.0), (-5.0, 5.0), (-5.0, 0.0), ccw=True)
    (point,) = crossings(edge, 3.0)
    assert point == pytest.approx((-1.0, 3.0))


def test_reversal_counts_the_bulge_of_an_arc() -> None:
    bulge = [Piece(offset.arc((0.0, 0.0), (0.0, 6.0), (-4.0, 3.0), ccw=True))]
    assert reversal(bulge, 0, -1.0) == pytest.approx(1.0)
    assert reversal(bulge, 1, 1.0) == 0.0


def test_climbing_leads_up_to_the_level_above() -> None:
    (gap,) = gaps(POCKET, 12.0, -1.0)
    path = climb(POCKET, gap, 12.0, 14.0, -1.0)
    assert [piece.edge.end for piece in path] == [pytest.approx((-24.0, 14.0))]


def test_climbing_goes_on_where_the_contour_runs_level() -> None:
    """Up to the level above there is stock on it."""
    contour = lines((2.0, 25.0), (2.0, 10.0), (-5.0, 10.0), (-8.0, 13.0), (-20.0, 13.0), (-20.0, 30.0))
    (gap,) = gaps(contour, 11.0, -1.0)
    ends = [piece.edge.end for piece in climb(contour, gap, 11.0, 20.0, -1.0)]
    assert ends == [(-8.0, 13.0), (-20.0, 13.0), (-20.0, 20.0)]
    assert climb(contour, gap, 11.0, 13.0, -1.0)[-1].edge.end == (-8.0, 13.0)


def test_climbing_stops_where_the_contour_turns_down() -> None:
    contour = lines((2.0, 25.0), (2.0, 10.0), (-5.0, 10.0), (-8.0, 13.0), (-20.0, 13.0), (-22.0, 11.0))
    (gap,) = gaps(contour, 11.0, -1.0)
    assert climb(contour, gap, 11.0, 20.0, -1.0)[-1].edge.end == (-20.0, 13.0)


@given(st.floats(10.5, 14.5))
def test_swapping_twice_and_shifting_back_changes_nothing(level: float) -> None:
    again = shifted(shifted(swapped(swapped(POCKET)), 1.5, -2.5), -1.5, 2.5)
    before, after = gaps(POCKET, level, -1.0), gaps(again, level, -1.0)
    assert [(g.start, g.end) for g in after] == [pytest.approx((g.start, g.end)) for g in before]
