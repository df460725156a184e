"""Points and pieces of moves."""

from __future__ import annotations

from math import hypot, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Move
from polycnc.toolpath import Kind
from polycnc.transformation.orientation.turning import Turning

GEOMETRY = (0, 1, 2)
coordinate = st.floats(-100.0, 100.0)
part = st.floats(0.0, 1.0)


def line(start: list[float], end: list[float]) -> MovePath:
    return MovePath(Move(Kind.FEED, start, end), GEOMETRY)


def arc(kind: Kind, start: list[float], end: list[float], turns: float = 0.0) -> MovePath:
    return MovePath(Move(kind, start, end, center=(0.0, 0.0, start[2]), turns=turns), GEOMETRY)


def test_a_quarter_counts_by_its_angle() -> None:
    way = arc(Kind.CCW, [10.0, 0.0, 0.0], [0.0, 10.0, 0.0])
    assert way.at(0.5) == pytest.approx([10 * 0.5**0.5, 10 * 0.5**0.5, 0.0])
    assert way.length == pytest.approx(5.0 * pi)
    assert way.direction(0.0) == pytest.approx((0.0, 1.0, 0.0))


def test_the_other_sense_goes_the_long_way_round() -> None:
    way = arc(Kind.CW, [10.0, 0.0, 0.0], [0.0, 10.0, 0.0])
    assert way.at(1.0 / 3.0) == pytest.approx([0.0, -10.0, 0.0], abs=1e-9)
    assert way.direction(0.0) == pytest.approx((0.0, -1.0, 0.0))


def test_a_full_circle_has_its_whole_length() -> None:
    assert arc(Kind.CCW, [10.0, 0.0, 0.0], [10.0, 0.0, 0.0]).length == pytest.approx(20.0 * pi)


def test_a_helix_rises_evenly_over_its_turns() -> None:
    way = arc(Kind.HELIX_CCW, [10.0, 0.0, 0.0], [10.0, 0.0, 8.0], turns=1.0)
    assert way.at(0.25) == pytest.approx([-10.0, 0.0, 2.0], abs=1e-9)
    assert way.until(0.75).turns == 1.0
    assert way.beyond(0.75).turns == 0.0


def test_a_position_is_found_where_the_way_first_reaches_it() -> None:
    way = arc(Kind.CW, [-50.0, 0.0, 0.0], [50.0, 0.0, 0.0])
    assert way.part_at({0: 0.0}) == pytest.approx(0.5)
    assert way.part_at({1: 30.0}) == pytest.approx(0.2048, abs=1e-4)
    assert way.part_at({0: 30.0, 1: 40.0}) == pytest.approx(0.7048, abs=1e-4)
    assert way.part_at({0: 60.0}) is None
    assert way.part_at({}) is None


def test_an_axis_that_stands_is_reached_at_once() -> None:
    assert line([5.0, 0.0, 0.0], [5.0, 9.0, 0.0]).part_at({0: 5.0}) == 0.0


def test_the_nearest_point_of_an_arc_lies_on_its_radius() -> None:
    way = arc(Kind.CCW, [10.0, 0.0, 0.0], [-10.0, 0.0, 0.0])
    assert way.nearest([0.0, 3.0, 0.0]) == pytest.approx(0.5, abs=1e-6)
    assert way.nearest([20.0, -1.0, 0.0]) == pytest.approx(0.0, abs=1e-6)


@given(st.tuples(coordinate, coordinate, coordinate), st.tuples(coordinate, coordinate, coordinate), part)
def test_the_pieces_of_a_line_join_where_it_was_cut(
    start: tuple[float, float, float], end: tuple[float, float, float], cut: float
) -> None:
    way = line(list(start), list(end))
    first, second = way.until(cut), way.beyond(cut)
    assert first.start == list(start)
    assert second.end == list(end)
    assert first.end == pytest.approx(second.start)


@given(st.floats(1.0, 100.0), st.floats(0.1, 6.2), part, st.booleans())
def test_every_point_of_an_arc_keeps_its_distance(radius: float, angle: float, at: float, ccw: bool) -> None:
    from math import cos, sin

    end = [radius * cos(angle), radius * sin(angle), 0.0]
    way = arc(Kind.CCW if ccw else Kind.CW, [radius, 0.0, 0.0], end)
    x, y, _ = way.at(at)
    assert hypot(x, y) == pytest.approx(radius)


def test_a_piece_turns_the_tool_by_its_own_part() -> None:
    turning = Turning((3,), (0.5, 1.0), ((10.0,), (40.0,)))
    move = Move(Kind.FEED, [0.0, 0.0, 0.0, 0.0], [20.0, 0.0, 0.0, 40.0], turning=turning)
    path = MovePath(move, GEOMETRY)
    assert path.at(0.75) == pytest.approx([15.0, 0.0, 0.0, 25.0])
    first, rest = path.until(0.75), path.beyond(0.75)
    assert first.end == rest.start == pytest.approx([15.0, 0.0, 0.0, 25.0])
    assert first.turning is not None
    assert first.turning.shares == pytest.approx((2.0 / 3.0, 1.0))
    assert first.turning.places == ((10.0,), (25.0,))
    assert rest.turning == Turning((3,), (1.0,), ((40.0,),))
