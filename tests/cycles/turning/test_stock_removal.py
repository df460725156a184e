"""Stock removal along contours, parallel contours, and threads in several cuts."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.cycles.turning import thread_chain
from polycnc.cycles.turning.contour import Contour, Piece, parallel, turned_round
from polycnc.cycles.turning.stock_removal import Cut, Removal, blank, is_clear, remove, sections, way_clear
from polycnc.cycles.turning.thread_chain import Thread
from polycnc.geometry import arcs, offset
from polycnc.toolpath import Kind


def lines(*corners: tuple[float, float]) -> Contour:
    return [Piece(offset.line(a, b)) for a, b in pairwise(corners)]


SHAFT = lines((0.0, 20.0), (-20.0, 20.0), (-20.0, 25.0), (-40.0, 25.0), (-40.0, 30.0))
GROOVED = lines((0.0, 20.0), (-10.0, 20.0), (-15.0, 15.0), (-20.0, 15.0), (-20.0, 25.0))
OUTSIDE = Removal(3.0, 1.0, -1.0)


def straight(cuts: list[Cut]) -> list[tuple[float, float]]:
    return rounded(cut.stroke.end for cut in cuts if cut.is_straight)


def rounded(points: Iterable[tuple[float, float]]) -> list[tuple[float, float]]:
    return [(round(a, 6) + 0.0, round(b, 6) + 0.0) for a, b in points]


def test_cuts_are_equal_and_end_on_the_contour() -> None:
    ends = straight(list(remove(SHAFT, OUTSIDE)))
    assert ends == [(-40.0, 27.5), (-40.0, 25.0), (-20.0, 22.5), (-20.0, 20.0)]


def test_a_relief_is_a_section_of_its_own_below_the_summit_in_front() -> None:
    found = sections(GROOVED, -1.0)
    assert [(s.bottom, s.top) for s in found] == [(20.0, 25.0), (15.0, 20.0)]
    summit = lines((0.0, 20.0), (-10.0, 22.0), (-15.0, 15.0), (-20.0, 15.0), (-20.0, 25.0))
    found = sections(summit, -1.0)
    assert [(s.bottom, s.top) for s in found] == [(20.0, 25.0), (15.0, 22.0)]


def test_relief_cuts_enter_at_their_own_feed() -> None:
    summit = lines((0.0, 20.0), (-10.0, 22.0), (-15.0, 15.0), (-20.0, 15.0), (-20.0, 25.0))
    cuts = list(remove(summit, OUTSIDE))
    relief = [cut.stroke.end for cut in cuts if cut.is_relief]
    assert len(relief) == 3
    assert relief[-1] == pytest.approx((-15.0, 15.0), abs=1e-5)


@given(
    st.lists(st.tuples(st.floats(1.0, 20.0), st.floats(10.0, 40.0)), min_size=2, max_size=8),
    st.floats(0.5, 10.0),
)
def test_no_cut_goes_below_the_contour(steps: list[tuple[float, float]], depth: float) -> None:
    corners, a = [(0.0, steps[0][1])], 0.0
    for length, height in steps:
        a -= length
        corners.append((a, height))
    contour = lines(*corners)
    at = None
    for cut in remove(contour, Removal(depth, 1.0, -1.0)):
        end = cut.stroke.end
        if cut.stroke.kind is Kind.FEED and at is not None:
            for k in range(11):
                point = tuple(s + k / 10.0 * (e - s) for s, e in zip(at, end, strict=True))
                assert point[1] >= _height(corners, point[0]) - 1e-4
        at = end


def _height(corners: list[tuple[float, float]], a: float) -> float:
    """Height of a polyline at a place; nothing in front of it or behind it."""
    for (a0, b0), (a1, b1) in pairwise(corners):
        if a1 <= a <= a0 and a0 != a1:
            return b0 + (a - a0) / (a1 - a0) * (b1 - b0)
    return -1e9


def test_cuts_may_end_without_following_the_contour() -> None:
    plain = list(remove(SHAFT, Removal(3.0, 1.0, -1.0, follows=False)))
    assert len(plain) < len(list(remove(SHAFT, OUTSIDE)))


def test_a_parallel_contour_goes_round_outer_corners_on_arcs() -> None:
    path = parallel(lines((0.0, 0.0), (10.0, 0.0), (10.0, -10.0)), 2.0)
    assert rounded(piece.edge.end for piece in path) == [(10.0, 2.0), (12.0, 0.0), (12.0, -10.0)]
    assert path[1].edge.center == (10.0, 0.0)
    assert arcs.radius_of((10.0, 0.0), path[1].edge.start) == pytest.approx(2.0)


def test_a_parallel_contour_meets_itself_in_inner_corners() -> None:
    path = parallel(lines((0.0, 0.0), (10.0, 0.0), (10.0, -10.0)), -2.0)
    assert rounded(piece.edge.end for piece in path) == [(8.0, -2.0), (8.0, -10.0)]


def test_a_contour_too_narrow_for_the_distance_is_refused() -> None:
    with pytest.raises(ValueError, match=r"short|narrow"):
        parallel(lines((0.0, 0.0), (10.0, 0.0), (10.0, -1.0), (20.0, -1.0), (20.0, 10.0)), 20.0)


def test_a_contour_turned_round_twice_is_itself() -> None:
    curved = [*SHAFT, Piece(offset.arc((-40.0, 30.0), (-45.0, 35.0), (-40.0, 35.0), ccw=False))]
    assert turned_round(turned_round(curved)) == curved


def thread(**changes: object) -> Thread:
    values = {
        "corners": [(0.0, 12.0), (-30.0, 12.0)], "leads": [2.0], "run_in": 6.0, "run_out": 0.0, "depth": 1.2,
        "allowance": 0.0, "cuts": 4, "idle": 0, "inside": False, "degressive": False, "flank_deg": 0.0,
        "start_angle_deg": 0.0, "starts": 1, "lift": 1.0, **changes,
    }  # fmt: skip
    return Thread(**values)  # type: ignore[arg-type]


def test_cuts_of_equal_area_grow_with_the_root() -> None:
    assert thread_chain.depths(thread(degressive=True)) == pytest.approx([0.6, 0.848528, 1.039230, 1.2])


def test_the_allowance_is_one_cut_and_idle_cuts_follow_it() -> None:
    assert thread_chain.depths(thread(allowance=0.2, idle=2)) == pytest.approx(
        [0.25, 0.5, 0.75, 1.0, 1.2, 1.2, 1.2]
    )


def test_every_start_has_its_own_angle() -> None:
    angles = [
        s.start_angle_deg
        for s in thread_chain.strokes(thread(starts=3, cuts=1, start_angle_deg=300.0))
        if s.lead
    ]
    assert angles == pytest.approx([300.0, 60.0, 180.0])


def test_run_in_and_run_out_go_on_along_a_taper() -> None:
    taper = thread(corners=[(0.0, 12.0), (-30.0, 15.0)], run_out=10.0, cuts=1, depth=0.0)
    cut = next(s for s in thread_chain.strokes(taper) if s.lead)
    assert cut.end == pytest.approx((-40.0, 16.0))


def rounded_corner(radius: float) -> Contour:
    """A cylinder that runs into a shoulder over a rounding."""
    return [
        Piece(offset.line((0.0, 20.0), (radius - 30.0, 20.0))),
        Piece(
            offset.arc(
                (radius - 30.0, 20.0), (-30.0, 20.0 + radius), (radius - 30.0, 20.0 + radius), ccw=False
            )
        ),
        Piece(offset.line((-30.0, 20.0 + radius), (-30.0, 40.0))),
    ]


def test_a_nose_as_large_as_a_rounding_rests_in_it() -> None:
    path = parallel(rounded_corner(0.4), -0.4)
    assert rounded(piece.edge.end for piece in path) == [(-29.6, 20.4), (-29.6, 40.0)]


def test_a_nose_larger_than_a_rounding_is_refused_where_it_must_fit() -> None:
    with pytest.raises(ValueError, match="too short"):
        parallel(rounded_corner(0.4), -0.5)


def test_roughing_leaves_stock_in_a_rounding_that_is_too_narrow() -> None:
    path = parallel(rounded_corner(0.4), -0.5, leaves_fillets=True)
    assert rounded(piece.edge.end for piece in path) == [(-29.5, 20.5), (-29.5, 40.0)]


def test_the_way_back_from_under_an_overhang_goes_along_first() -> None:
    overhang = lines(
        (10.0, 0.0), (10.0, -5.0), (20.0, -5.0), (20.0, -15.0), (18.0, -18.0), (18.0, -24.0), (22.0, -24.0)
    )
    start, home = (18.5, -23.0), (28.0, 4.0)
    way = way_clear(overhang, start, home, towards=-1.0, lift=1.0)
    assert [stroke.end for stroke in way] == [(28.0, -23.0)]
    closed = [*overhang, *lines((22.0, -24.0), (22.0, -10.0))]
    with pytest.raises(ValueError, match="no way out"):
        way_clear(closed, start, home, towards=-1.0, lift=1.0)


def test_a_way_from_behind_passes_over_the_blank() -> None:
    shaft = lines((0.0, 8.0), (-2.0, 5.0), (-7.0, 11.0), (-12.0, 11.0))
    start, end = (-18.0, 19.0), (1.0, 8.0)
    assert not way_clear(shaft, start, end, towards=-1.0, lift=1.0)
    over = way_clear(blank(shaft, -1.0), start, end, towards=-1.0, lift=1.0)
    assert rounded(stroke.end for stroke in over) == [(1.0, 19.0)]


def test_the_lift_off_under_an_overhang_goes_along_the_cut() -> None:
    overhang = lines((0.0, 20.0), (-10.0, 20.0), (-8.0, 24.0), (-20.0, 26.0))
    for cut in remove(overhang, Removal(2.0, 1.0, -1.0, follows=False)):
        assert cut.stroke.center is None
        a, b = cut.stroke.end
        # The wall leans to the front: at height b it stands at -10 + (b - 20) / 2.
        assert not (20.0 < b < 24.0 and a < -10.0 + (b - 20.0) / 2.0 - 1e-3)


def test_no_way_leads_out_through_the_front_under_the_begin() -> None:
    bore = lines((0.0, 13.0), (-4.0, 13.0), (-4.0, 17.0), (-16.0, 17.0), (-27.0, 12.0))
    start, end = (-4.0 - 1e-7, 14.6), (4.0, 9.5)
    assert not is_clear(bore, [start, (4.0, 14.6), end], 1.0)
    way = way_clear(bore, start, end, towards=1.0, lift=1.0)
    assert rounded(stroke.end for stroke in way) == [(-4.0, 9.5)]


def test_a_contour_that_begins_with_a_chamfer_is_cut_down_to_its_cylinder() -> None:
    """The deepest point is the begin of the chamfer: no cut fits there, but the way up does."""
    part = lines((0.0, 18.0), (-2.0, 20.0), (-30.0, 20.0), (-30.0, 30.0))
    ends = [cut.stroke.end for cut in remove(part, Removal(3.0, 1.0, -1.0))]
    assert ends[-7:-2] == [(1.0, 18.0), (0.0, 18.0), (-2.0, 20.0), (-30.0, 20.0), (-30.0, 21.0)]
