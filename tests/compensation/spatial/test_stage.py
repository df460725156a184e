"""Radius compensation across a tool that tilts: where the tip goes at starts, corners and turns of the tool."""

from __future__ import annotations

from itertools import pairwise
from math import cos, radians, sin
from typing import TYPE_CHECKING

import pytest

from polycnc.channel.moves.path import Move, Recorder
from polycnc.compensation.spatial.rules import (
    ARC_FIRST,
    INTERSECTION_FIRST,
    TURNS_ALONG,
    TURNS_BEFORE,
    Corners,
    Rules,
)
from polycnc.compensation.spatial.stage import SpatialStage
from polycnc.messages import AlarmError
from polycnc.toolpath.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.geometry.frames import Vector

RULES = Rules(no_corner="1", changes="2", square_start=True)


class AboutX:
    """A head whose one rotary axis, in the fourth column, turns the tool about X."""

    def tool_at(self, position: Sequence[float]) -> Vector:
        angle = radians(position[3])
        return (0.0, -sin(angle), cos(angle))


def led(
    points: list[list[float]], *, turns: int = TURNS_BEFORE, way: int = ARC_FIRST, depth: float = 0.0
) -> list[Move]:
    """What becomes of straight moves from point to point to the left of which the tool stands by 10 mm."""
    corners = Corners(way, 80.0)
    rules = Rules(RULES.no_corner, RULES.changes, square_start=True, turns=turns)
    stage, recorder = SpatialStage((0, 1, 2), AboutX(), 10.0, 1, corners, rules), Recorder()
    stage.depth = depth
    stage.after = recorder
    for start, end in pairwise(points):
        stage.move(Move(Kind.FEED, start, end))
    stage.flush()
    return recorder.moves


UP = [[0.0, -20.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 40.0, 0.0, 0.0]]


def test_the_first_block_leads_square_onto_the_second_one() -> None:
    moves = led([*UP, [40.0, 40.0, 0.0, 0.0]])
    assert moves[0].end == pytest.approx([-10, 0, 0, 0])


def test_an_outer_corner_has_an_arc_across_the_tool() -> None:
    _, first, arc, last = led([*UP, [40.0, 40.0, 0.0, 0.0]])
    assert first.end == pytest.approx([-10, 40, 0, 0])
    assert arc.kind is Kind.CW
    assert arc.center == pytest.approx((0, 40, 0))
    assert arc.end == pytest.approx([0, 50, 0, 0])
    assert last.end == pytest.approx([40, 50, 0, 0])


def test_an_intersection_takes_the_place_of_the_arc_where_the_corner_is_wide() -> None:
    _, first, last = led([*UP, [40.0, 40.0, 0.0, 0.0]], way=INTERSECTION_FIRST)
    assert first.end == pytest.approx([-10, 50, 0, 0])
    assert last.end == pytest.approx([40, 50, 0, 0])


def test_a_sharp_corner_is_cut_off_by_a_line() -> None:
    corners = Corners(INTERSECTION_FIRST, 90.0, cut_off=True)
    stage, recorder = SpatialStage((0, 1, 2), AboutX(), 10.0, 1, corners, RULES), Recorder()
    stage.after = recorder
    for start, end in pairwise([*UP, [20.0, 20.0, 0.0, 0.0]]):
        stage.move(Move(Kind.FEED, start, end))
    stage.flush()
    _, first, line, last = recorder.moves
    assert first.end == pytest.approx([-10, 50, 0, 0])
    assert line.end == pytest.approx([0, 40 + 14.142136, 0, 0])
    assert last.end == pytest.approx([27.071068, 27.071068, 0, 0])


def through_a_slot(reverses: str) -> None:
    """15 mm wide, for a radius of 10 mm."""
    rules = Rules("1", square_start=True, reverses=reverses)
    stage = SpatialStage((0, 1, 2), AboutX(), 10.0, 1, Corners(), rules)
    stage.after = Recorder()
    for start, end in pairwise([*UP, [-15.0, 40.0, 0.0, 0.0], [-15.0, 0.0, 0.0, 0.0]]):
        stage.move(Move(Kind.FEED, start, end))
    stage.flush()


def test_a_block_that_leads_backwards_is_an_alarm_where_the_control_looks_for_it() -> None:
    through_a_slot("")
    with pytest.raises(AlarmError) as alarm:
        through_a_slot("3")
    assert alarm.value.code == "3"


def test_an_inner_corner_is_the_intersection() -> None:
    _, first, _ = led([*UP, [-40.0, 40.0, 0.0, 0.0]])
    assert first.end == pytest.approx([-10, 30, 0, 0])


def test_the_tip_lies_deeper_along_the_tool() -> None:
    leaning = [[0.0, -20.0, 0.0, 30.0], [0.0, 0.0, 0.0, 30.0], [30.0, 0.0, 0.0, 30.0]]
    moves = led(leaning, depth=4.0)
    assert moves[-1].end == pytest.approx([30, 8.660254 + 2, 5 - 3.464102, 30])


def test_a_turn_before_the_arc_leaves_the_arc_to_the_turned_tool() -> None:
    _, first, turn, arc, last = led([*UP, [0.0, 40.0, 0.0, 30.0], [40.0, 40.0, 0.0, 30.0]])
    assert first.end == pytest.approx([-10, 40, 0, 0])
    assert turn.end == pytest.approx([-10, 40, 0, 30])
    assert arc.normal == pytest.approx((0, -0.5, 0.8660254))
    assert last.end == pytest.approx([40, 48.660254, 5, 30])


def test_a_turn_along_the_arc_is_spread_over_it_by_its_angles() -> None:
    turning = [[0.0, 40.0, 0.0, 10.0], [0.0, 40.0, 0.0, 30.0], [40.0, 40.0, 0.0, 30.0]]
    moves = led([*UP, *turning], turns=TURNS_ALONG)
    chords = [move.end for move in moves if move.kind is Kind.SPLINE]
    (third,) = [end for end in chords if end[3] == pytest.approx(10.0)]
    assert third == pytest.approx([-8.660254, 44.330127, 2.5, 10])
    assert chords[-1] == pytest.approx([0, 48.660254, 5, 30])


def test_a_corner_that_changes_its_kind_is_an_alarm() -> None:
    rising = [[0.0, -20.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 40.0, 5.0, 0.0], [0.0, 40.0, 5.0, 100.0]]
    with pytest.raises(AlarmError) as alarm:
        led([*rising, [40.0, 40.0, 5.0, 100.0]])
    assert alarm.value.code == "2"


def test_a_path_that_turns_back_is_an_alarm() -> None:
    with pytest.raises(AlarmError) as alarm:
        led([*UP, [0.0, 0.0, 0.0, 0.0]])
    assert alarm.value.code == "1"


def test_a_tool_that_turns_along_a_block_stays_as_far_beside_it() -> None:
    moves = led([UP[0], [0.0, 0.0, 0.0, 0.0], [60.0, 0.0, 0.0, 70.0], [90.0, 0.0, 0.0, 70.0]])
    along = [move for move in moves if move.end[0] > 0.0]
    assert len(along) > 10
    for move in along:
        half = [0.5 * (a + b) for a, b in zip(move.start, move.end, strict=True)]
        for _, y, z, a in (move.end, half):
            beside = (10.0 * cos(radians(a)), 10.0 * sin(radians(a)))
            assert (y, z) == pytest.approx(beside, abs=2e-3)
