"""Plunges, cuts between walls and along them."""

from __future__ import annotations

from polycnc.cycles.plunging.cuts import Stroke, Use, Work, follow, plunge, turn, ways_down
from polycnc.cycles.plunging.profile import level, of_tool, profile
from tests.cycles.plunging.test_profile import GROOVE, Point, lines


def work(*corners: Point, width: float = 3.0) -> Work:
    floor = of_tool(profile(lines(*corners), 10.0), 0.0, width)
    return Work(floor, level(10.0, corners[0][0], corners[-1][0] - width + 1e-5), 1.0, 12.0)


def ends(strokes: list[Stroke], use: Use) -> list[Point]:
    return [(round(s.end[0], 3), round(s.end[1], 3)) for s in strokes if s.use is use]


def test_plunges_go_from_the_middle_outwards_in_equal_infeeds() -> None:
    strokes = list(plunge(work(*GROOVE), 2.5, 3.0))
    plunges = ends(strokes, Use.PLUNGE)
    assert plunges[1::2] == [(4.333, 5.0), (6.667, 5.0), (2.0, 5.0), (9.0, 5.0)]
    assert [h for _, h in plunges[::2]] == [7.5] * 4
    assert [s.end[1] for s in strokes if s.use is Use.RAPID][:4] == [12.0, 11.0, 8.5, 12.0]


def test_one_plunge_where_the_tool_is_as_wide_as_the_groove() -> None:
    assert ends(list(plunge(work(*GROOVE[1:5], width=10.0), 8.0, 0.0)), Use.PLUNGE) == [(2.0, 5.0)]
    assert ends(list(turn(work(*GROOVE[1:5], width=10.0), 5.0)), Use.PLUNGE) == [(2.0, 5.0)]


def test_cuts_run_to_and_fro_from_level_to_level() -> None:
    strokes = list(turn(work(*GROOVE), 2.5))
    assert ends(strokes, Use.TURN) == [(9.0, 7.5), (2.0, 5.0)]
    assert ends(strokes, Use.PLUNGE) == [(2.0, 7.5), (9.0, 5.0)]


def test_a_pocket_is_cut_to_its_bottom_before_the_next_one() -> None:
    two = ((0.0, 10.0), (0.0, 4.0), (6.0, 4.0), (6.0, 7.0), (8.0, 7.0), (8.0, 4.0), (14.0, 4.0), (14.0, 10.0))
    strokes = list(turn(work(*two), 2.0))
    assert ends(strokes, Use.TURN) == [(11.0, 8.0), (0.0, 6.0), (3.0, 4.0), (11.0, 6.0), (8.0, 4.0)]
    heights = [s.end[1] for s in strokes if s.use is Use.RAPID]
    # Past the bump between them the tool rises to the cut that has passed over it.
    assert 9.0 in heights


def test_walls_are_followed_down_from_both_sides_to_the_middle_of_the_base() -> None:
    leaning = ((0.0, 10.0), (4.0, 4.0), (12.0, 4.0), (16.0, 10.0))
    followed = ends(list(follow(work(*leaning))), Use.FOLLOW)
    assert followed == [
        (0.0, 10.0), (4.0, 4.0), (6.5, 4.0), (13.0, 10.0), (9.0, 4.0), (6.5, 4.0),
    ]  # fmt: skip


def test_upright_walls_are_followed_too() -> None:
    followed = ends(list(follow(work(*GROOVE))), Use.FOLLOW)
    assert followed == [(2.0, 10.0), (2.0, 5.0), (5.5, 5.0), (9.0, 10.0), (9.0, 5.0), (5.5, 5.0)]


def test_no_rapid_goes_down_to_a_summit_on_which_stock_may_stand() -> None:
    valleys = ((0.0, 10.0), (2.0, 4.0), (5.0, 4.0), (7.0, 7.0), (9.0, 4.0), (12.0, 4.0), (14.0, 10.0))
    found = list(follow(work(*valleys, width=1.0)))
    assert {s.end[1] for s in found if s.use is Use.RAPID} == {12.0, 11.0}


def test_ways_down_never_rise() -> None:
    wave = lines((0.0, 5.0), (1.0, 3.0), (2.0, 6.0), (3.0, 6.0), (4.0, 2.0), (5.0, 4.0))
    ways = ways_down(wave)
    assert [way[0].edge.start for way in ways] == [(0.0, 5.0), (3.0, 6.0), (3.0, 6.0), (5.0, 4.0)]
    assert all(piece.edge.end[1] <= piece.edge.start[1] for way in ways for piece in way)
