"""Single cycles, pattern repeating, pecking and grinding as strokes."""

from __future__ import annotations

import pytest

from polycnc.cycles.turning.grinding import Grinding, oscillate, traverse
from polycnc.cycles.turning.pattern import repeat_pattern
from polycnc.cycles.turning.peck import Pecks, peck_columns
from polycnc.cycles.turning.single import facing, longitudinal
from polycnc.toolpath import Kind
from tests.cycles.turning.test_contour import lines


def test_a_single_cycle_goes_round_the_corner_and_back() -> None:
    strokes = list(longitudinal((5.0, 30.0), (-20.0, 25.0), -2.0))
    assert [stroke.end for stroke in strokes] == [(5.0, 23.0), (-20.0, 25.0), (-20.0, 30.0), (5.0, 30.0)]
    assert [stroke.kind for stroke in strokes] == [Kind.RAPID, Kind.FEED, Kind.FEED, Kind.RAPID]


def test_facing_tapers_along_the_first_axis() -> None:
    assert next(iter(facing((5.0, 30.0), (-5.0, 10.0), -1.0))).end == (-6.0, 30.0)


def test_pattern_passes_come_nearer_evenly() -> None:
    contour = lines((0.0, 50.0), (0.0, 30.0), (-10.0, 30.0))
    strokes = list(repeat_pattern(contour, (4.0, 6.0), 3, (1.0, 2.0)))
    assert [s.end for s in strokes[::3]] == [(5.0, 58.0), (3.0, 55.0), (1.0, 52.0), (0.0, 50.0)]


def test_one_pass_is_the_last_one() -> None:
    contour = lines((0.0, 50.0), (0.0, 30.0))
    assert next(iter(repeat_pattern(contour, (4.0, 6.0), 1, (1.0, 2.0)))).end == (1.0, 52.0)


def test_pecks_end_exactly_at_the_bottom_and_columns_exactly_at_the_corner() -> None:
    strokes = list(peck_columns((0.0, 0.0), (-10.0, -7.0), Pecks(peck=4.0, back=1.0, step=3.0)))
    feeds = [stroke.end for stroke in strokes if stroke.kind is Kind.FEED]
    assert feeds[:3] == [(-4.0, 0.0), (-8.0, 0.0), (-10.0, 0.0)]
    assert sorted({b for _, b in feeds}) == [-7.0, -6.0, -3.0, 0.0]
    assert strokes[-1].end == (0.0, 0.0)


def test_relief_leads_off_the_wall_before_the_way_back() -> None:
    strokes = list(peck_columns((0.0, 0.0), (-10.0, 0.0), Pecks(peck=0.0, back=0.0, relief=0.5)))
    assert [stroke.end for stroke in strokes] == [(-10.0, 0.0), (-10.0, 0.5), (0.0, 0.5), (0.0, 0.0)]


def test_grinding_without_infeed_only_strokes() -> None:
    strokes = list(traverse(Grinding(0.0, 0.0, -10.0, 0.0)))
    assert [s.along for s in strokes if s.along] == [-10.0, 10.0]
    assert not any(s.infeed for s in strokes)


def test_oscillation_infeeds_with_the_stroke() -> None:
    strokes = [s for s in oscillate(Grinding(-0.2, -0.1, -10.0, 1.0, 2)) if not s.dwell_s]
    assert [(s.infeed, s.along) for s in strokes] == [
        pytest.approx(p) for p in [(-0.2, -10.0), (-0.1, 10.0)] * 2
    ]
