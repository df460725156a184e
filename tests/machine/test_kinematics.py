"""Tool directions of machines with rotary axes, there and back."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.machine import load_machine
from polycnc.machine.kinematics import Kinematics, turn_about
from polycnc.transformation.orientation import angles_for

MACHINES = ("mill5-ac-table", "mill5-bc-head", "mill5-ca-head", "mill5-ab-head")
ANGLES = st.floats(-179.0, 179.0)


def kinematics(name: str) -> Kinematics:
    return Kinematics.of(load_machine(name))


@pytest.mark.parametrize("name", MACHINES)
@given(ANGLES, ANGLES)
def test_the_angles_of_a_direction_stand_the_tool_along_it(name: str, first: float, second: float) -> None:
    machine = kinematics(name)
    angles = dict(zip(machine.axes, (first, second), strict=True))
    direction = machine.tool_on_work(angles)
    found = angles_for(machine, direction, dict.fromkeys(machine.axes, 0.0))
    assert found is not None
    assert machine.tool_on_work(found) == pytest.approx(direction, abs=1e-6)


@pytest.mark.parametrize("name", MACHINES)
@given(ANGLES, ANGLES)
def test_of_two_solutions_the_near_one_is_taken(name: str, first: float, second: float) -> None:
    machine = kinematics(name)
    angles = dict(zip(machine.axes, (first, second), strict=True))
    found = angles_for(machine, machine.tool_on_work(angles), angles)
    assert found is not None
    assert sum(abs(found[a] - angles[a]) for a in angles) <= 1e-4


@pytest.mark.parametrize("name", MACHINES)
def test_at_zero_the_tool_stands_along_z(name: str) -> None:
    assert kinematics(name).tool_on_work({}) == pytest.approx((0, 0, 1))
    assert kinematics(name).tool_on_machine({}) == pytest.approx((0, 0, 1))


def test_a_table_turns_the_work_under_the_tool() -> None:
    machine = kinematics("mill5-ac-table")
    assert machine.work_turn({"C": 90.0}).apply(1, 0, 0) == pytest.approx((0, 1, 0))
    assert machine.work_turn({"A": 90.0}).apply(0, 0, 1) == pytest.approx((0, -1, 0))
    assert machine.tool_on_work({"A": 90.0}) == pytest.approx((0, 1, 0))


def test_a_head_turns_the_tool() -> None:
    machine = kinematics("mill5-bc-head")
    assert machine.tool_on_work({"B": 90.0}) == pytest.approx((1, 0, 0))
    assert machine.tool_on_work({"B": 90.0, "C": 90.0}) == pytest.approx((0, 1, 0))


def test_a_machine_with_one_table_reaches_only_its_own_directions() -> None:
    machine = kinematics("mill4")
    assert angles_for(machine, (0, 1, 1), {"A": 0.0}) is not None
    assert angles_for(machine, (1, 0, 1), {"A": 0.0}) is None


def test_a_machine_without_rotary_axes_reaches_nothing() -> None:
    assert angles_for(kinematics("mill3"), (0, 0, 1), {}) is None


def test_a_turn_about_any_direction_keeps_it() -> None:
    frame = turn_about((1, 1, 1), 120.0)
    assert frame.apply(1, 1, 1) == pytest.approx((1, 1, 1))
    assert frame.apply(1, 0, 0) == pytest.approx((0, 1, 0))
