"""Stock removal by parallel strokes."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.cycles.turning.cuts import Roughing
from polycnc.cycles.turning.rough import rough
from polycnc.toolpath import Kind
from tests.cycles.turning.test_contour import POCKET, lines

STEP = lines((2.0, 25.0), (2.0, 10.0), (-10.0, 10.0), (-25.0, 25.0))


def test_every_stroke_ends_on_the_shape_and_leaves_at_45_degrees() -> None:
    strokes = list(rough(STEP, Roughing(5.0, 1.0)))
    ends = [stroke.end for stroke in strokes]
    i = ends.index((-20.0, 20.0))
    assert ends[i + 1] == (-19.0, 21.0)
    assert ends[i + 2] == (2.0, 21.0)
    assert [stroke.kind for stroke in strokes[i : i + 3]] == [Kind.FEED, Kind.FEED, Kind.RAPID]


def test_the_shape_is_followed_to_its_end_and_then_the_tool_goes_home() -> None:
    ends = [stroke.end for stroke in rough(STEP, Roughing(5.0, 1.0))]
    assert ends[-4:] == [(2.0, 10.0), (-10.0, 10.0), (-25.0, 25.0), (2.0, 25.0)]


def test_without_rough_finishing_the_bottom_gets_a_stroke_of_its_own() -> None:
    ends = [stroke.end for stroke in rough(STEP, Roughing(5.0, 1.0, finishes=False))]
    assert ends[-4:] == [(-10.0, 10.0), (-9.0, 11.0), (2.0, 11.0), (2.0, 25.0)]


def test_allowances_shift_all_strokes() -> None:
    ends = [stroke.end for stroke in rough(STEP, Roughing(5.0, 1.0, allowance=(0.1, 0.2)))]
    assert ends[0] == pytest.approx((2.1, 25.2))
    assert any(end == pytest.approx((-19.9, 20.2)) for end in ends)
    assert ends[-1] == (2.0, 25.0)


def test_infeed_at_feed_where_the_shape_begins_with_a_feed() -> None:
    strokes = list(rough(STEP, Roughing(5.0, 1.0, infeed_rapid=False)))
    assert strokes[1].end == (2.0, 20.0)
    assert strokes[1].kind is Kind.FEED


def test_returns_may_be_merged_or_straight() -> None:
    merged = [stroke.end for stroke in rough(STEP, Roughing(5.0, 1.0, returns_merged=True))]
    assert merged.count((2.0, 20.0)) == 1
    straight = [stroke.end for stroke in rough(STEP, Roughing(5.0, 1.0, returns_straight=True))]
    assert (2.0, 21.0) not in straight


def test_a_pocket_is_cut_down_to_its_bottom() -> None:
    ends = [stroke.end for stroke in rough(POCKET, Roughing(3.0, 0.5, pockets=True))]
    assert any(end == pytest.approx((-20.0, 10.0), abs=1e-6) for end in ends)
    assert ends[-1] == (2.0, 25.0)


@given(st.floats(0.3, 9.0), st.floats(0.0, 0.5))
def test_no_stroke_goes_below_the_shape(depth: float, escape: float) -> None:
    for stroke in rough(POCKET, Roughing(depth, escape, pockets=True)):
        a, b = stroke.end
        bottom = 15.0 if a > -10.0 else max(10.0, 15.0 - (-10.0 - a)) if a > -20.0 else 10.0 + (-20.0 - a)
        if -25.0 < a < 2.0:
            assert b >= bottom - 1e-5
