"""Tool directions of machines with rotary axes."""

from __future__ import annotations

import pytest

from polycnc.geometry.frames import rotation
from polycnc.machine import load_machine
from polycnc.machine.kinematics import Kinematics, turn_about

MACHINES = ("mill5-ac-table", "mill5-bc-head", "mill5-ca-head", "mill5-ab-head")


def kinematics(name: str) -> Kinematics:
    return Kinematics.of(load_machine(name))


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


def test_a_turn_about_any_direction_keeps_it() -> None:
    frame = turn_about((1, 1, 1), 120.0)
    assert frame.apply(1, 1, 1) == pytest.approx((1, 1, 1))
    assert frame.apply(1, 0, 0) == pytest.approx((0, 1, 0))


@pytest.mark.parametrize("angle", [90.0, -30.0, 77.7])
def test_a_turn_about_a_main_axis_is_exact(angle: float) -> None:
    assert turn_about((0.0, 0.0, -3.0), angle) == rotation(2, -angle)
    assert turn_about((5.0, 0.0, 0.0), angle) == rotation(0, angle)


@pytest.mark.parametrize(
    ("machine", "first"),
    [("mill5-ac-table", ("A", "C")), ("mill5-bc-head", ("C", "B")), ("mixed", ("B", "C"))],
)
def test_the_first_rotary_axis_carries_the_other_or_is_in_the_head(
    machine: str, first: tuple[str, ...]
) -> None:
    if machine == "mixed":
        head, table = (Kinematics.of(load_machine(each)) for each in ("mill5-bc-head", "mill5-ac-table"))
        assert Kinematics(head.tool[1:], table.work[1:]).ordered == first
    else:
        assert Kinematics.of(load_machine(machine)).ordered == first


def test_a_machine_file_says_where_the_nose_is_and_how_the_tool_points() -> None:
    machine = load_machine("tests/conformance/machines/mill5-bc-head-nose.toml")
    kinematics = Kinematics.of(machine)
    assert kinematics.nose == (0.0, 0.0, -150.0)
    assert kinematics.head_turn({"B": 90.0}).t == pytest.approx((20.0 - 150.0, 0.0, -20.0))
    assert Kinematics.of(load_machine("tests/conformance/machines/mill3-horizontal.toml")).along == (
        0.0,
        1.0,
        0.0,
    )
