"""Stock removal with pockets: what is cut, in which order, and that rapids stay out of the material."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.cycles.turning.contour import Contour, Piece
from polycnc.cycles.turning.cuts import Roughing
from polycnc.cycles.turning.rough import rough
from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.geometry import offset
from polycnc.toolpath import Kind
from tests.cycles.turning.test_contour import lines

TWO_POCKETS = lines(
    (2.0, 30.0), (2.0, 25.0), (-5.0, 25.0), (-10.0, 15.0), (-20.0, 15.0), (-25.0, 25.0), (-30.0, 25.0),
    (-32.0, 20.0), (-40.0, 20.0), (-45.0, 30.0),
)  # fmt: skip


def cuts(contour: Contour, **words: float | bool) -> list[PlaneStroke]:
    """Type II with an infeed of 5 and an escape of 1."""
    return list(rough(contour, Roughing(5.0, 1.0, pockets=True, **words)))  # type: ignore[arg-type]


def test_both_pockets_are_cut_to_their_bottoms_the_near_one_first() -> None:
    ends = [stroke.end for stroke in cuts(TWO_POCKETS)]
    assert ends.index((-20.0, 15.0)) < ends.index((-40.0, 20.0))


def test_from_a_bottom_the_tool_leaves_at_45_degrees_goes_to_the_next_pocket_s_height_and_feeds_in() -> None:
    strokes = cuts(TWO_POCKETS, clearance=0.5)
    ends = [stroke.end for stroke in strokes]
    i = ends.index((-20.0, 15.0))
    assert ends[i + 1 : i + 6] == [(-19.0, 16.0), (-19.0, 25.0), (-29.5, 25.0), (-30.0, 25.0), (-32.0, 20.0)]
    kinds = [stroke.kind for stroke in strokes[i + 1 : i + 6]]
    assert kinds == [Kind.FEED, Kind.RAPID, Kind.RAPID, Kind.FEED, Kind.FEED]


def test_after_a_stroke_the_shape_is_followed_to_the_height_of_the_stroke_before() -> None:
    ends = [stroke.end for stroke in cuts(TWO_POCKETS)]
    i = ends.index((-22.5, 20.0))
    assert ends[i + 1 : i + 3] == [(-25.0, 25.0), (-25.0, 26.0)]


def test_a_flat_behind_a_stroke_is_followed_only_where_that_is_asked() -> None:
    steps = lines((2.0, 30.0), (2.0, 19.0), (-10.0, 19.0), (-12.0, 22.0), (-20.0, 22.0), (-24.0, 30.0))
    ends = [stroke.end for stroke in cuts(steps)]
    i = ends.index((-12.0, 22.0))
    assert ends[i - 1] == pytest.approx((-10.667, 20.0), abs=1e-3)
    assert ends[i + 1] == (-12.0, 23.0)
    ends = [stroke.end for stroke in cuts(steps, follows_flats=True)]
    assert ends[i + 1 : i + 4] == [(-20.0, 22.0), (-21.5, 25.0), (-21.5, 26.0)]


def test_bottoms_may_be_left_to_the_pass_along_the_shape() -> None:
    ends = [stroke.end for stroke in cuts(TWO_POCKETS, skips_bottoms=True)]
    assert ends.count((-20.0, 15.0)) == 1
    assert [stroke.end for stroke in cuts(TWO_POCKETS)].count((-20.0, 15.0)) == 2


def test_a_way_home_over_a_shape_as_high_as_the_start_is_raised_by_one_depth() -> None:
    ends = [stroke.end for stroke in cuts(TWO_POCKETS)]
    assert ends[-2:] == [(-45.0, 35.0), (2.0, 30.0)]


def test_a_sloped_infeed_is_the_line_on_which_strokes_begin() -> None:
    ramp = lines((2.0, 30.0), (0.0, 20.0), (-10.0, 20.0), (-20.0, 30.0))
    ends = [stroke.end for stroke in cuts(ramp)]
    assert ends[1:3] == [(1.0, 25.0), (-15.0, 25.0)]
    i = ends.index((0.0, 20.0))
    assert ends[i - 2 : i] == [(1.0, 31.0), (1.0, 25.0)]


heights = st.lists(st.integers(5, 29), min_size=2, max_size=7)


@given(heights, st.floats(1.0, 8.0), st.sampled_from([0.0, 0.5]), st.booleans(), st.sampled_from([0.0, 4.0]))
def test_no_rapid_runs_through_material_and_no_stroke_below_the_shape(
    bottoms: list[int], depth: float, clearance: float, steep: bool, flat: float
) -> None:
    """Flats or points at random heights, joined by slopes or by walls; columns every quarter millimetre are watched."""
    points: list[tuple[float, float]] = [(2.0, 30.0), (2.0, float(bottoms[0]))]
    for number, bottom in enumerate(bottoms):
        points.append((-8.0 * number, float(bottom)) if number else (0.0, float(bottom)))
        points.append((-8.0 * number - flat, float(bottom)))
        if steep and number + 1 < len(bottoms):
            points.append((-8.0 * number - 8.0, float(bottom)))
    points.append((-8.0 * len(bottoms), 30.0))
    contour = lines(*dict.fromkeys(points))
    columns = [a / 4.0 + 0.01 for a in range(-8 * 4 * len(bottoms) + 1, 8)]
    shape = [_height(points, a) for a in columns]
    stock = [30.0] * len(columns)
    at = (2.0, 30.0)
    for stroke in rough(contour, Roughing(depth, 0.5, pockets=True, clearance=clearance)):
        for i, a in enumerate(columns):
            reached = _on_line(at, stroke.end, a)
            if reached is None:
                continue
            assert reached >= shape[i] - 1e-3
            if stroke.kind is Kind.RAPID and stroke.end != (2.0, 30.0):
                assert reached >= stock[i] - 1e-3
            stock[i] = min(stock[i], reached)
        at = stroke.end
    assert stock == pytest.approx(shape, abs=1e-3)


def _height(points: list[tuple[float, float]], a: float) -> float:
    for (a0, b0), (a1, b1) in pairwise(points):
        if a1 <= a <= a0 and a1 != a0:
            return b0 + (a - a0) / (a1 - a0) * (b1 - b0)
    raise AssertionError


def _on_line(start: tuple[float, float], end: tuple[float, float], a: float) -> float | None:
    """The lower `b` of a line at a column; None where it does not pass it."""
    low, high = sorted((start[0], end[0]))
    if not low <= a <= high or low == high:
        return None
    return start[1] + (a - start[0]) / (end[0] - start[0]) * (end[1] - start[1])


@pytest.mark.parametrize("depth", [1.0, 3.0, 5.0, 20.0])
def test_a_pocket_without_a_flat_is_cut_down_to_where_a_stroke_would_be_a_point(depth: float) -> None:
    vee = lines((2.0, 30.0), (2.0, 25.0), (-5.0, 25.0), (-10.0, 15.0), (-15.0, 25.0), (-20.0, 30.0))
    strokes = [stroke.end for stroke in rough(vee, Roughing(depth, 1.0, pockets=True))]
    assert len(strokes) < 200
    assert strokes.count((-10.0, 15.0)) == 1, "only the pass along the shape comes to the point"


def test_an_arc_is_a_pocket_too_and_is_followed_as_an_arc() -> None:
    bowl = lines((2.0, 30.0), (2.0, 25.0), (-10.0, 25.0))
    bowl += [Piece(offset.arc((-10.0, 25.0), (-30.0, 25.0), (-20.0, 36.18034), ccw=False))]
    bowl += [Piece(piece.edge) for piece in lines((-30.0, 25.0), (-34.0, 30.0))]
    strokes = list(rough(bowl, Roughing(3.0, 0.5, pockets=True)))
    arcs = [stroke for stroke in strokes if stroke.center is not None]
    assert [stroke.kind for stroke in arcs[:2]] == [Kind.CW, Kind.CW]
    assert len(arcs) == 3


def test_inside_turning_is_the_mirror_image_of_outside_turning() -> None:
    inside = lines(*((a, 60.0 - b) for a, b in _corners(TWO_POCKETS)))
    mirrored = [(stroke.end[0], 60.0 - stroke.end[1]) for stroke in cuts(inside)]
    for stroke, end in zip(cuts(TWO_POCKETS), mirrored, strict=True):
        assert stroke.end == pytest.approx(end)


def _corners(contour: Contour) -> list[tuple[float, float]]:
    return [contour[0].edge.start, *(piece.edge.end for piece in contour)]
