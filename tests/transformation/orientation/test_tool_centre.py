from __future__ import annotations

from math import hypot

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.geometry.vectors import minus
from polycnc.machine import load_machine
from polycnc.machine.kinematics import Kinematics
from polycnc.transformation.orientation.tool_centre import ToolCentrePoint
from tests.transformation.kinds import AXES, XYZ, points, tips

FIVE_AXES = ("mill5-ac-table", "mill5-bc-head", "mill5-ca-head", "mill5-ab-head")


def of_machine(name: str, length: float = 120.0) -> ToolCentrePoint:
    machine = load_machine(name)
    axes = machine.channel_axes(1)
    return ToolCentrePoint(Kinematics.of(machine), axes, XYZ, (0.0,) * len(axes), (0.0, 0.0, -length))


@given(tips, points)
def test_the_axes_are_those_of_the_chain_of_frames(
    following: ToolCentrePoint, point: tuple[float, ...]
) -> None:
    machine = [value + zero for value, zero in zip(point, following.zero, strict=True)]
    angles = dict(zip(AXES, machine, strict=True))
    kinematics = following.kinematics
    place = kinematics.work_turn(angles).apply(*machine[:3])
    # From the point that positions name: with all axes at zero it lies `to_nose` before the nose.
    named = minus(kinematics.head_turn({}).t, kinematics.to_nose)
    arm = minus(kinematics.head_turn(angles).apply(*following.tip), named)
    expected = [at - part - zero for at, part, zero in zip(place, arm, following.zero[:3], strict=True)]
    assert following.to_machine(point)[:3] == pytest.approx(expected, abs=1e-9)


@given(tips, points)
def test_the_direction_of_the_tool_is_that_of_the_chain_of_frames(
    following: ToolCentrePoint, point: tuple[float, ...]
) -> None:
    angles = {name: value + zero for name, value, zero in zip(AXES, point, following.zero, strict=True)}
    direction = following.orientation(point)
    assert direction == pytest.approx(following.kinematics.tool_on_work(angles), abs=1e-9)
    assert hypot(*direction) == pytest.approx(1.0)


@given(tips, points)
def test_the_linear_axes_never_lose_a_degree_of_freedom(
    following: ToolCentrePoint, point: tuple[float, ...]
) -> None:
    assert np.linalg.det(np.array(following.jacobian(point))) == pytest.approx(1.0, abs=1e-6)
    assert following.pole is None


@pytest.mark.parametrize("name", FIVE_AXES)
@given(
    st.tuples(*[st.floats(-300.0, 300.0)] * 3),
    st.floats(5.0, 80.0) | st.floats(-80.0, -5.0),
    st.floats(-170.0, 170.0),
)
def test_two_solutions_stand_the_tool_alike_on_the_same_place(
    name: str, tip: tuple[float, ...], tilt: float, turn: float
) -> None:
    following = of_machine(name)
    tilting = following.axes.index("B" if "B" in following.axes else "A")
    point = [*tip, turn, turn]
    point[tilting] = tilt
    found = [following.to_work(axes) for axes in following.solutions(point)]
    assert len(found) == 2
    for work in found:
        assert work[:3] == pytest.approx(list(tip), abs=1e-9)
        assert following.orientation(work) == pytest.approx(following.orientation(point), abs=1e-6)


@pytest.mark.parametrize("name", FIVE_AXES)
@given(st.tuples(*[st.floats(-300.0, 300.0)] * 3))
def test_with_the_rotary_axes_at_zero_only_the_length_counts(name: str, tip: tuple[float, ...]) -> None:
    axes = of_machine(name).to_machine([*tip, 0.0, 0.0])
    assert axes[:3] == pytest.approx([tip[0], tip[1], tip[2] + 120.0])


def test_an_axis_along_the_tool_leaves_the_linear_axes_where_they_are() -> None:
    following = of_machine("mill5-bc-head")
    assert following.to_machine([1.0, 2.0, 3.0, 0.0, 77.0])[:3] == [1.0, 2.0, 123.0]
