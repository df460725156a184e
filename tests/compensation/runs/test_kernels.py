"""The kernel of compensation finds the vectors of `geometry.offset`, and ends where there is not one alone."""

from __future__ import annotations

from array import array
from math import cos, radians, sin

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.compensation.runs import kernels
from polycnc.compensation.runs.kernels import RAPID, STRAIGHT, Offset
from polycnc.geometry import offset
from polycnc.geometry.offset import Outer
from polycnc.toolpath.kinds import Kind
from tests.kernels.strict import strict

OUTER = Outer()
corner, lead, measure = strict(kernels.corner), strict(kernels.lead), strict(kernels.measure)


def at(distance: float, window: int = 2, checks: bool = True) -> Offset:
    return Offset(
        2, 0, 1, window, distance, 0.0, 0.0, -9.0, 0.0, 0.0, distance, OUTER.intersection_limit_deg, checks
    )


def two_lines(turn: float, way: float) -> array[float]:
    angle = radians(turn)
    return array("d", (1.25, 0.0, 1.25 + way * cos(angle), way * sin(angle)))


@settings(deadline=None)
@given(st.floats(-89.0, 130.0), st.floats(0.1, 30.0), st.sampled_from((0.2, 5.0)))
def test_a_corner_is_that_of_two_edges(turn: float, way: float, distance: float) -> None:
    ends, ways = two_lines(turn, way), array("d", bytes(48))
    how, kinds = at(distance), array("B", (STRAIGHT, RAPID))
    assert measure(how, kinds, ends, ways, 0)
    assert measure(how, kinds, ends, ways, 1)
    middle, last = (ends[0], ends[1]), (ends[2], ends[3])
    expected = offset.corner(offset.line((-9.0, 0.0), middle), offset.line(middle, last), distance, OUTER)
    found, u, v = corner(how, ends, ways, 1)
    assert found
    assert expected is not None
    assert [(u.hex(), v.hex())] == [(a.hex(), b.hex()) for a, b in expected.vectors]


@pytest.mark.parametrize("turn", [-91.0, -150.0, 180.0])
def test_a_corner_with_several_vectors_or_none_is_the_stages(turn: float) -> None:
    ends, ways = two_lines(turn, 5.0), array("d", bytes(48))
    for i in range(2):
        assert measure(at(1.0), array("B", (STRAIGHT, STRAIGHT)), ends, ways, i)
    assert not corner(at(1.0), ends, ways, 1)[0]


@pytest.mark.parametrize("kind", [Kind.CW, Kind.EVENT, Kind.SPLINE])
def test_what_is_no_line_is_the_stages(kind: Kind) -> None:
    ends, ways = two_lines(0.0, 5.0), array("d", bytes(48))
    assert not measure(at(1.0), array("B", (kind, kind)), ends, ways, 0)


@pytest.mark.parametrize(("distance", "checks", "read"), [(-5.0, True, 3), (-5.0, False, 6), (5.0, True, 6)])
def test_a_run_ends_in_front_of_a_notch_smaller_than_the_tool(
    distance: float, checks: bool, read: int
) -> None:
    points = (0.0, 0.0, 5.0, 0.0, 10.0, 0.0, 10.5, 3.0, 11.0, 3.0, 11.5, 0.0, 16.0, 0.0, 20.0, 0.0)
    count = len(points) // 2
    how, rows, ways = at(distance, checks=checks), array("d", points), array("d", bytes(24 * count))
    vectors, kinds = array("d", (0.0, distance) * count), array("B", (STRAIGHT,)) * count
    assert lead(how, kinds, array("d", points), ways, vectors, rows) == read
    moved = [rows[2 * i : 2 * i + 2] != array("d", points[2 * i : 2 * i + 2]) for i in range(count)]
    assert moved == [i < read for i in range(count)]
