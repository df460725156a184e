from __future__ import annotations

from math import cos, degrees, hypot, radians, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.transformation.kinematic.polar import CLOSEST_MM, PolarPlane
from tests.transformation.kinds import angles, places

PLANE = PolarPlane(0, 2, (0, 2, 1))


def test_the_axes_follow_by_distance_and_direction() -> None:
    assert PLANE.to_machine([3.0, 5.0, 4.0]) == pytest.approx([5.0, 5.0, degrees(0.9272952180016122)])
    assert PLANE.to_work([5.0, 5.0, 90.0]) == pytest.approx([0.0, 5.0, 5.0])


@given(places, places, angles)
def test_on_the_negative_side_the_linear_axis_is_negative(x: float, y: float, start: float) -> None:
    axes = PolarPlane(0, 2, (0, 2, 1), start, side=-1.0).to_machine([x, 0.0, y])
    assert axes[0] <= 0.0
    angle = radians(axes[2] - start)
    assert (axes[0] * cos(angle), axes[0] * sin(angle)) == pytest.approx((x, y), abs=1e-9)


def test_the_pole_is_the_centre_of_rotation() -> None:
    plane = PolarPlane(0, 2, (0, 2, 1), eccentricity=(10.0, -4.0), side=-1.0)
    pole = plane.pole
    assert (pole.columns, pole.place, pole.linear, pole.rotary) == ((0, 2), (-10.0, 4.0), 0, 2)
    assert pole.distance([-7.0, 0.0, 8.0]) == 5.0
    assert plane.to_machine([-10.0, 0.0, 4.0])[0] == 0.0
    beside = pole.beside([-10.0, 1.0, 4.0], radians(30.0), 2.0)
    assert plane.to_machine(beside)[0] == pytest.approx(-2.0)


@given(angles, st.sampled_from([1.0, -1.0]))
def test_beside_the_pole_the_rotary_axis_keeps_its_direction(angle: float, side: float) -> None:
    plane = PolarPlane(0, 2, (0, 2, 1), 20.0, side=side)
    axes = plane.pole.axes_beside([0.0, 1.0, angle], 1e-4)
    again = plane.to_machine(plane.to_work(axes))
    assert again[0] == pytest.approx(side * 1e-4)
    assert (again[2] - angle + 180.0) % 360.0 - 180.0 == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_in_the_pole_the_rotary_axis_stands_where_it_is_told(side: float) -> None:
    plane = PolarPlane(0, 2, (0, 2, 1), 20.0, side=side, pole_deg=75.0)
    assert plane.to_machine([0.0, 3.0, 0.0]) == [0.0, 3.0, 75.0]
    table = plane.to_machine([np.array([0.0, 3.0]), np.array([1.0, 1.0]), np.array([0.0, 4.0])])
    assert table[2].tolist() == [75.0, plane.to_machine([3.0, 1.0, 4.0])[2]]


def test_near_the_pole_the_rotary_axis_is_asked_for_ever_more_but_never_for_endless_speed() -> None:
    def turn(distance: float) -> float:
        rotary = PLANE.jacobian([distance, 0.0, 0.0])[2]
        return hypot(rotary[0], rotary[2])

    assert turn(2.0) == pytest.approx(2.0 * turn(4.0))
    assert turn(0.0) == turn(0.5 * CLOSEST_MM) == pytest.approx(degrees(1.0 / CLOSEST_MM))


def test_the_other_solution_lies_across_the_centre() -> None:
    near, across = PLANE.solutions([3.0, 1.0, 4.0])
    assert across == [-near[0], 1.0, near[2] + 180.0]
    assert PLANE.to_work(across) == pytest.approx([3.0, 1.0, 4.0])


@given(places, places, angles)
def test_the_second_axis_may_have_a_column_of_its_own(x: float, y: float, start: float) -> None:
    own, shared = PolarPlane(0, 3, (0, 1, 2), start, virtual=1), PolarPlane(0, 3, (0, 3, 2), start)
    axes = own.to_machine([x, y, 7.0, 0.0])
    assert axes == shared.to_machine([x, 0.0, 7.0, y])
    assert own.to_work(axes) == pytest.approx([x, y, 7.0, 0.0], abs=1e-9)
    assert own.pole.columns == (0, 1)
    slopes = own.jacobian([x, y, 7.0, 0.0])
    assert [slopes[3][0], slopes[3][1]] == [shared.jacobian([x, 0.0, 7.0, y])[3][k] for k in (0, 3)]
    assert slopes[1] == [0.0, 0.0, 0.0, 1.0]


def test_an_axis_beside_the_plane_stands_where_it_is() -> None:
    plane = PolarPlane(0, 3, (0, 1, 2), virtual=1)
    assert plane.to_work([5.0, 2.0, 7.0, 90.0]) == pytest.approx([0.0, 5.0, 7.0, 2.0])
    assert plane.to_machine([0.0, 5.0, 7.0, 2.0]) == pytest.approx([5.0, 2.0, 7.0, 90.0])
