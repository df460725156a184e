from __future__ import annotations

from math import pi

import pytest

from polycnc.toolpath.row_path import arc_path, line_path
from polycnc.transformation.kinematic.polar import PolarPlane
from polycnc.transformation.pole import POLE_MM, Pole, is_at, shares_at_pole
from polycnc.transformation.seated import Seated

POLE = Pole((0, 1), (10.0, 0.0), 0, 2)
GEOMETRY = (0, 1, -1)


def shares(start: list[float], end: list[float]) -> list[float]:
    return shares_at_pole(POLE, line_path(start, end), None, start, end)


def test_a_point_is_at_the_pole_within_a_micrometre() -> None:
    assert is_at(POLE, [10.0, 0.5 * POLE_MM, 7.0])
    assert not is_at(POLE, [10.0, 2.0 * POLE_MM, 7.0])


@pytest.mark.parametrize(
    ("end", "found"),
    [([30.0, 0.0, 0.0], [0.25]), ([10.0, 0.0, 0.0], [1.0]), ([30.0, 1.0, 0.0], []), ([5.0, 0.0, 0.0], [])],
)
def test_a_line_is_at_the_pole_once(end: list[float], found: list[float]) -> None:
    assert shares([4.0, 0.0, 0.0] if end[0] == 30.0 else [0.0, 0.0, 0.0], end) == pytest.approx(
        [6.0 / 26.0] if found == [0.25] else found
    )


def test_a_line_in_the_pole_is_there_at_both_ends() -> None:
    assert shares([10.0, 0.0, 0.0], [10.0, 0.0, 9.0]) == [0.0, 1.0]


def test_an_arc_of_several_turns_comes_to_the_pole_in_each() -> None:
    start = [20.0, 0.0, 0.0]
    arc = arc_path(start, start, (15.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0), GEOMETRY, ccw=True)
    assert arc.angle == pytest.approx(4.0 * pi)
    assert shares_at_pole(POLE, arc.at, arc, start, start) == pytest.approx([0.25, 0.75])


def test_a_tool_along_the_linear_axis_lies_between_it_and_the_pole() -> None:
    plane = Seated(PolarPlane(0, 2, (0, 2, 1), side=-1.0), offsets=(4.0, 0.0, 0.0))
    pole = plane.pole
    assert pole is not None
    assert pole.axes_beside([4.0, 0.0, 30.0], 0.1) == pytest.approx([3.9, 0.0, 30.0])
    assert pole.distance(plane.to_work(pole.axes_beside([4.0, 0.0, 30.0], 0.1))) == pytest.approx(0.1)
