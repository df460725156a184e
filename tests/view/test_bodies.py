"""The axes of a machine as bodies."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.machine.load import load_machine
from polycnc.mainrun import VirtualControl
from polycnc.panel.course import Course
from polycnc.view.bodies import HALF, MachineBodies

if TYPE_CHECKING:
    from pathlib import Path


def bodies_of(machine: str) -> MachineBodies:
    return MachineBodies(load_machine(machine))


def test_every_linear_axis_is_a_rail_with_a_carriage_that_the_ones_before_carry() -> None:
    made = [body for body in bodies_of("mill3").bodies if body.role in ("rail", "carriage")]
    assert [(body.axis, body.role, body.moves) for body in made] == [
        ("Y", "rail", (0.0, 0.0, 0.0)), ("Y", "carriage", (0.0, 1.0, 0.0)),
        ("X", "rail", (0.0, 1.0, 0.0)), ("X", "carriage", (1.0, 1.0, 0.0)),
        ("Z", "rail", (1.0, 1.0, 0.0)), ("Z", "carriage", (1.0, 1.0, 1.0)),
    ]  # fmt: skip
    lathe = [body.axis for body in bodies_of("lathe2").bodies if body.role == "rail"]
    assert lathe == ["Z", "X"]


def test_a_rail_is_as_long_as_the_travel(tmp_path: Path) -> None:
    file = tmp_path / "shop.toml"
    file.write_text('base = "mill3"\n[axis.X]\nlimit_minus = -650\nlimit_plus = 0\n', encoding="utf-8")
    machine = load_machine(file)
    rail = next(body for body in MachineBodies(machine).bodies if body.role == "rail" and body.axis == "X")
    assert rail.size[0] == pytest.approx(650.0 + 2 * HALF)
    assert rail.at[0] == pytest.approx(-325.0)


def test_rotary_axes_are_discs_that_turn() -> None:
    discs = [body for body in bodies_of("mill5-ac-table").bodies if body.role == "disc"]
    assert [(disc.turns, disc.direction) for disc in discs] == [("A", (1, 0, 0)), ("C", (0, 0, 1))]


def test_a_pose_has_the_tool_as_the_work_sees_it() -> None:
    made = bodies_of("mill5-ac-table")
    pose = made.pose((1.0, 2.0, 3.0), [10.0, 20.0, 30.0, 90.0, 0.0])
    assert (pose.point, pose.machine) == ((1.0, 2.0, 3.0), (10.0, 20.0, 30.0))
    assert pose.angles == {"A": 90.0, "C": 0.0}
    assert pose.along == pytest.approx((0.0, 1.0, 0.0), abs=1e-9)
    assert bodies_of("lathe2").pose((0.0, 0.0, 0.0), [5.0, 7.0]).machine == (5.0, 0.0, 7.0)


def test_the_tool_of_a_lathe_stands_along_x_unless_a_head_turns_it() -> None:
    assert bodies_of("lathe-c").pose((0.0, 0.0, 0.0), [5.0, 7.0, 90.0]).along == (1.0, 0.0, 0.0)
    head = MachineBodies(load_machine("tests/conformance/machines/lathe-b-head.toml"))
    assert head.pose((0.0, 0.0, 0.0), [5.0, 7.0, 0.0, 0.0]).along == pytest.approx((0.0, 0.0, 1.0))
    assert head.pose((0.0, 0.0, 0.0), [5.0, 7.0, 0.0, 90.0]).along == pytest.approx((1.0, 0.0, 0.0))


def test_a_head_with_a_nose_holds_the_tool_there() -> None:
    machine = load_machine("tests/conformance/machines/mill5-bc-head-nose.toml")
    made = MachineBodies(machine)
    pose = made.pose((0.0, 0.0, 0.0), [1.0, 2.0, 3.0, 0.0, 0.0])
    assert pose.nose == pytest.approx((1.0, 2.0, 3.0))
    # B lies (20, 0, -20) from C, the nose 150 below B: B90 leads it to (-150, 0, 0) from there.
    pose = made.pose((0.0, 0.0, 0.0), [1.0, 2.0, 3.0, 90.0, 90.0])
    assert pose.along == pytest.approx((0.0, 1.0, 0.0), abs=1e-9)
    assert pose.nose == pytest.approx((1.0 - 20.0, 2.0 - 130.0, 3.0 + 150.0))
    places, directions = zip(*(pose.head[axis] for axis in "CB"), strict=True)
    assert places == (pytest.approx((-19.0, 2.0, 173.0)), pytest.approx((-19.0, 22.0, 153.0)))
    assert directions == ((0, 0, 1), pytest.approx((-1.0, 0.0, 0.0), abs=1e-9))


@pytest.mark.parametrize(
    ("control", "machine", "parameters", "program", "along"),
    [
        ("syntec-mill", "mill5-bc-head", {"3002": 1}, "M00\nM30\n", (1.0, 0.0, 0.0)),
        ("syntec-mill", "mill5-bc-head", {"3002": 1}, "G00 C90.\nM00\nM30\n", (0.0, 1.0, 0.0)),
        ("fanuc-m", "mill5-bc-head", {"19697": 2}, "M00\nM30\n", (0.0, 1.0, 0.0)),
        ("fanuc-m", "tests/conformance/machines/mill3-horizontal.toml", {}, "M00\nM30\n", (0.0, 1.0, 0.0)),
        ("meldas-m", "mill5-bc-head", {}, "G00 B90.\nM00\nM30\n", (1.0, 0.0, 0.0)),
        ("sinumerik-840d", "mill3", {}, "G18\nG0 X1\nM0\nM30\n", (0.0, 1.0, 0.0)),
        ("sinumerik-840d", "mill3", {}, "G19\nG0 X1\nM0\nM30\n", (1.0, 0.0, 0.0)),
        ("sinumerik-840d", "mill5-bc-head", {}, "G19\nG0 B90\nM0\nM30\n", (1.0, 0.0, 0.0)),
        ("sinumerik-840d", "mill5-bc-head", {}, "TRAORI(1,0,1,0)\nG0 X1\nM0\nM30\n", (0.0, 1.0, 0.0)),
    ],
)
def test_the_picture_has_the_tool_as_the_control_stands_it(
    control: str, machine: str, parameters: dict[str, int], program: str, along: tuple[float, float, float]
) -> None:
    virtual = VirtualControl(control, machine=machine, setup={"parameters": parameters})
    course = Course(virtual)
    virtual.load(program)
    virtual.cycle_start()
    virtual.run()
    assert course.pose.along == pytest.approx(along, abs=1e-9)
