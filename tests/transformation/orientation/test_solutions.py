from __future__ import annotations

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from polycnc.machine import load_machine
from polycnc.machine.kinematics import Kinematics
from polycnc.machine.model import Joint
from polycnc.transformation.orientation.solutions import (
    Posture,
    angles_for,
    pole_angle,
    slopes,
    solutions_for,
)
from tests.transformation.kinds import angles, kinematics

FIVE_AXES = ("mill5-ac-table", "mill5-bc-head", "mill5-ca-head", "mill5-ab-head")
poses = st.fixed_dictionaries({"A": angles, "B": angles, "C": angles})


def of(name: str) -> Kinematics:
    return Kinematics.of(load_machine(name))


def nutating(tilt: str, turn: str) -> Kinematics:
    """A head whose second axis is inclined by 45 degrees: it tilts the tool by up to 90."""
    nothing = (0.0, 0.0, 0.0)
    joint = (
        Joint(turn, True, "tool", (0.0, 0.0, 1.0), nothing),
        Joint(tilt, True, "tool", (1.0, 0.0, 1.0), nothing),
    )
    return Kinematics(joint, ())


@given(kinematics, poses)
def test_a_direction_that_the_axes_can_take_is_found_again(
    machine: Kinematics, pose: dict[str, float]
) -> None:
    assume(machine.axes)
    direction = machine.tool_on_work(pose)
    assume(len(machine.axes) == 1 or pole_angle(machine, pose) > 0.01)
    found = angles_for(machine, direction, pose)
    assert found is not None
    assert found.keys() == set(machine.axes)
    assert machine.tool_on_work(found) == pytest.approx(direction, abs=2e-6)
    way = sum(abs(found[axis] - pose[axis]) for axis in machine.axes)
    assert way < 0.05 or pole_angle(machine, pose) < 1.0


@pytest.mark.parametrize("name", FIVE_AXES)
@given(angles, angles)
def test_from_anywhere_the_tool_is_stood_along_a_direction(name: str, first: float, second: float) -> None:
    machine = of(name)
    direction = machine.tool_on_work(dict(zip(machine.axes, (first, second), strict=True)))
    found = angles_for(machine, direction, dict.fromkeys(machine.axes, 0.0))
    assert found is not None
    assert machine.tool_on_work(found) == pytest.approx(direction, abs=1e-6)


def test_a_machine_with_one_table_reaches_only_its_own_directions() -> None:
    assert angles_for(of("mill4"), (0.0, 1.0, 1.0), {"A": 0.0}) is not None
    assert angles_for(of("mill4"), (1.0, 0.0, 1.0), {"A": 0.0}) is None


@given(kinematics, poses)
def test_the_slopes_of_the_direction_are_what_small_turns_give(
    machine: Kinematics, pose: dict[str, float]
) -> None:
    for axis, slope in slopes(machine, pose).items():
        ahead = machine.tool_on_work({**pose, axis: pose[axis] + 0.01})
        behind = machine.tool_on_work({**pose, axis: pose[axis] - 0.01})
        way = [(a - b) / 0.02 for a, b in zip(ahead, behind, strict=True)]
        assert slope == pytest.approx(way, abs=1e-7)


@pytest.mark.parametrize("name", FIVE_AXES)
def test_upright_the_tool_is_at_its_pole(name: str) -> None:
    machine = of(name)
    tilting = machine.axes[-1]
    upright = dict.fromkeys(machine.axes, 0.0)
    if name == "mill5-ab-head":  # its first axis is A: the pole lies along X
        upright[tilting] = 90.0
    assert pole_angle(machine, upright) == pytest.approx(0.0, abs=1e-9)
    assert pole_angle(machine, {**upright, tilting: upright[tilting] + 30.0}) == pytest.approx(30.0)


@pytest.mark.parametrize("turned", [0.0, 33.0, -150.0, 400.0])
def test_at_the_pole_the_first_axis_stays_where_it_is(turned: float) -> None:
    found = solutions_for(of("mill5-bc-head"), (0.0, 0.0, 1.0), {"B": 0.0, "C": turned})
    assert found
    assert all(solution == {"C": turned, "B": 0.0} for solution in found)


@pytest.mark.parametrize("near", [-700.0, -10.0, 355.0, 1000.0])
def test_solutions_lie_on_the_turns_next_to_where_the_axes_are(near: float) -> None:
    for found in solutions_for(of("mill5-ca-head"), (1.0, 2.0, 3.0), {"C": near, "A": 0.0}):
        assert abs(found["C"] - near) <= 180.0


@pytest.mark.parametrize(
    ("direction", "count"),
    [((0, 0, 1), 2), ((1, 0, 1), 2), ((0, 1, 0), 2), ((1, 1, -0.1), 0), ((0, 0, -1), 0)],
)
def test_a_nutating_head_reaches_the_upper_half(direction: tuple[float, float, float], count: int) -> None:
    assert len(solutions_for(nutating("B", "C"), direction, {"B": 0.0, "C": 0.0})) == count


def test_a_nutating_head_stands_where_its_formula_says() -> None:
    # Tilt t of the tool and turn b of an axis inclined by 45 degrees: cos t = (1 + cos b) / 2.
    found = angles_for(nutating("B", "C"), (0.5, 0.0, 0.75**0.5), {"B": 10.0, "C": -10.0})
    assert found is not None
    assert abs(found["B"]) == pytest.approx(42.9414, abs=1e-4)


def test_of_three_axes_the_one_that_is_not_needed_stays() -> None:
    found = angles_for(of("mill6-cac-head"), (0.0, -1.0, 1.0), {"C": 0.0, "A": 40.0, "B": 12.0})
    assert found == {"C": 0.0, "A": 45.0, "B": 12.0}


def test_without_rotary_axes_there_is_nothing_to_choose() -> None:
    assert solutions_for(Kinematics((), ()), (0.0, 0.0, 1.0), {}) == []
    assert pole_angle(Kinematics((), ()), {}) == 0.0


def test_a_posture_counts_positions_from_the_work_zero() -> None:
    posture = Posture(of("mill5-bc-head"), ("X", "B", "C"), (5.0, 60.0, 0.0))
    assert posture.tool_at([0.0, 30.0, 0.0]) == pytest.approx((1.0, 0.0, 0.0))
    assert posture.tool_at([0.0, -60.0, 0.0]) == (0.0, 0.0, 1.0)


def test_an_axis_along_the_tool_stays_where_it_is() -> None:
    nothing = (0.0, 0.0, 0.0)
    tilts, spins = (
        Joint("B", True, "tool", (0.0, 1.0, 0.0), nothing),
        Joint("C", True, "tool", (0.0, 0.0, 1.0), nothing),
    )
    machine = Kinematics((tilts, spins), ())
    direction = machine.tool_on_work({"B": 37.0})
    assert angles_for(machine, direction, {"C": 40.0}) == pytest.approx({"B": 37.0, "C": 40.0})
    assert angles_for(machine, (0.6, 0.1, 0.8), {"C": 40.0}) is None
