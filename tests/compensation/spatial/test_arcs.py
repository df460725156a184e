"""Arcs across the tool: where their parallels meet others."""

from __future__ import annotations

import pytest

from polycnc.channel.moves.path import Move
from polycnc.compensation.spatial.arcs import is_across, meeting, turns_left
from polycnc.geometry.vectors import dot
from polycnc.toolpath.kinds import Kind

GEOMETRY = (0, 1, 2)
UP, DOWN = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)
ARC = Move(Kind.CCW, [30.0, 0.0, 5.0], [50.0, 20.0, 5.0], center=(30.0, 20.0, 5.0))
BACK = Move(Kind.FEED, [50.0, 20.0, 5.0], [20.0, 20.0, 5.0])


def test_an_arc_lies_across_a_tool_that_is_square_on_its_plane() -> None:
    assert is_across(ARC, UP)
    assert is_across(ARC, DOWN)
    assert not is_across(ARC, (0.0, 0.6, 0.8))


def test_the_side_is_seen_from_the_holder() -> None:
    assert turns_left(ARC, UP)
    assert not turns_left(ARC, DOWN)


@pytest.mark.parametrize("tool", [UP, DOWN])
def test_an_arc_and_a_line_meet_as_far_from_both(tool: tuple[float, float, float]) -> None:
    left = 5.0 if tool is UP else -5.0  # the same side in space
    shift = meeting(ARC, BACK, tool, (left, left), GEOMETRY)
    assert shift is not None
    assert dot(shift, tool) == pytest.approx(0.0)
    x, y = 50.0 + shift[0], 20.0 + shift[1]
    assert y == pytest.approx(15.0)
    assert (x - 30.0) ** 2 + (y - 20.0) ** 2 == pytest.approx(15.0**2)


def test_parallels_that_miss_each_other_have_no_point() -> None:
    line = Move(Kind.FEED, [0.0, 0.0, 5.0], [30.0, 0.0, 5.0])
    away = Move(Kind.CCW, [30.0, 0.0, 5.0], [40.0, 0.0, 5.0], center=(35.0, 0.0, 5.0))
    assert meeting(line, away, UP, (5.0, 5.0), GEOMETRY) is None
