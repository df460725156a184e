from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import assume, given

from polycnc.geometry.frames import IDENTITY, Frame, rotation
from polycnc.geometry.vectors import dot
from polycnc.machine import load_machine
from polycnc.machine.kinematics import Kinematics
from polycnc.transformation.orientation.solutions import angles_for
from polycnc.transformation.planes import tilted
from tests.transformation.kinds import angles, offsets

FIVE_AXES = ("mill5-ac-table", "mill5-bc-head", "mill5-ca-head", "mill5-ab-head")


def of(name: str) -> Kinematics:
    return Kinematics.of(load_machine(name))


def numbers_of(frame: Frame) -> list[float]:
    return [*(number for row in frame.m for number in row), *frame.t]


@given(angles, angles, angles)
def test_an_order_about_fixed_axes_is_the_other_order_about_own_ones(a: float, b: float, c: float) -> None:
    fixed = tilted.by_fixed_axes((0, 1, 2), (a, b, c))
    own = tilted.by_own_axes(((2, c), (1, b), (0, a)))
    assert numbers_of(fixed) == pytest.approx(numbers_of(own))


@given(angles, angles, angles)
def test_euler_angles_lean_z_by_the_second_one(i: float, j: float, k: float) -> None:
    plane = tilted.by_euler(i, j, k)
    assert plane.direct(0.0, 0.0, 1.0) == pytest.approx(
        rotation(2, i).direct(*rotation(0, j).direct(0.0, 0.0, 1.0))
    )
    assert numbers_of(tilted.by_euler(i, 0.0, k)) == pytest.approx(numbers_of(rotation(2, i + k)))


def test_a_solid_angle_leans_towards_a_direction() -> None:
    assert tilted.by_solid_angle(90.0, 30.0).direct(0.0, 0.0, 1.0) == pytest.approx((0.0, 0.5, 0.75**0.5))


@given(offsets, offsets, offsets)
def test_three_points_lie_on_their_plane(
    origin: tuple[float, float, float], along: tuple[float, float, float], beside: tuple[float, float, float]
) -> None:
    plane = tilted.by_points(origin, along, beside)
    if plane is None:
        return
    assert plane.apply(0.0, 0.0, 0.0) == origin
    x, y, z = plane.inverse().apply(*along)
    assert (y, z) == pytest.approx((0.0, 0.0), abs=1e-3)
    assert x >= 0.0
    assert plane.inverse().apply(*beside)[2] == pytest.approx(0.0, abs=1e-3)
    assert plane.inverse().apply(*beside)[1] >= -1e-6
    assert not plane.mirrors


def test_points_on_a_line_and_parallel_directions_are_no_plane() -> None:
    zero, x = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)
    assert tilted.by_points(zero, x, (2.0, 0.0, 0.0)) is None
    assert tilted.by_points(zero, zero, x) is None
    assert tilted.by_directions(zero, x, (-3.0, 0.0, 0.0)) is None
    assert tilted.by_directions(zero, zero, x) is None


def test_the_second_direction_need_not_be_square_on_the_first_one() -> None:
    plane = tilted.by_directions((1.0, 2.0, 3.0), (0.0, 5.0, 0.0), (0.0, 7.0, 9.0))
    assert plane is not None
    assert plane.apply(1.0, 0.0, 0.0) == pytest.approx((1.0, 3.0, 3.0))
    assert plane.direct(0.0, 0.0, 1.0) == pytest.approx((0.0, 0.0, 1.0))


@pytest.mark.parametrize("tool", [(0.0, 0.0, 1.0), (0.6, 0.0, 0.8), (0.0, -1.0, 0.0)])
def test_a_plane_across_the_tool_has_its_x_level(tool: tuple[float, float, float]) -> None:
    plane = tilted.square_on(tool)
    assert plane.direct(0.0, 0.0, 1.0) == pytest.approx(tool)
    assert dot(plane.direct(1.0, 0.0, 0.0), (0.0, 0.0, 1.0)) == pytest.approx(0.0)
    assert numbers_of(plane.inverse() @ plane) == pytest.approx(numbers_of(IDENTITY))
    assert [dot(row, row) for row in plane.m] == pytest.approx([1.0, 1.0, 1.0])


@pytest.mark.parametrize("name", FIVE_AXES)
@given(angles, angles)
def test_a_plane_told_by_the_rotary_axes_is_one_that_the_tool_stands_on(
    name: str, a: float, b: float
) -> None:
    kinematics = of(name)
    pose = dict(zip(kinematics.axes, (a, b), strict=True))
    plane = tilted.by_rotary_axes(kinematics, pose)
    assert plane.direct(0.0, 0.0, 1.0) == pytest.approx(kinematics.tool_on_work(pose), abs=1e-9)


@pytest.mark.parametrize("name", FIVE_AXES)
@given(angles, angles, angles)
def test_aligned_the_tool_points_along_z_of_the_plane_as_the_table_has_turned_it(
    name: str, i: float, j: float, k: float
) -> None:
    kinematics, plane = of(name), tilted.by_euler(i, j, k)
    found = angles_for(kinematics, plane.direct(0.0, 0.0, 1.0), dict.fromkeys(kinematics.axes, 0.0))
    assume(found is not None)
    assert found is not None
    turned = tilted.table_turn(kinematics, found, (10.0, -20.0, 30.0)) @ plane
    assert kinematics.tool_on_machine(found) == pytest.approx(turned.direct(0.0, 0.0, 1.0), abs=1e-5)


def test_a_head_that_turns_takes_the_tool_along() -> None:
    kinematics = of("mill5-bc-head")
    assert tilted.tool_carrier(kinematics, {}).is_identity
    assert tilted.tool_carrier(kinematics, {"B": 90.0, "C": 0.0}).direct(0.0, 0.0, 1.0) == (1.0, 0.0, 0.0)
    assert tilted.table_turn(kinematics, {"B": 90.0}, (1.0, 2.0, 3.0)) == IDENTITY


def test_a_head_with_a_nose_away_from_its_axis_takes_the_tool_away() -> None:
    kinematics = replace(of("mill5-bc-head"), nose=(0.0, 0.0, -150.0))
    assert tilted.tool_carrier(kinematics, {}).is_identity
    # The nose swings from (0, 0, -150) to (-150, 0, 0) about the axis of B: the linear axes make it good.
    assert tilted.tool_carrier(kinematics, {"B": 90.0}).t == pytest.approx((150.0, 0.0, -150.0))
