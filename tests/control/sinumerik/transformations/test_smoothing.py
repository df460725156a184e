"""What group 34 and the compressors tell the planner."""

from __future__ import annotations

from math import cos, degrees, radians, sin
from random import Random

import pytest

import polycnc
from polycnc.control.sinumerik.transformations.smoothing import together
from polycnc.machine.kinematics import Kinematics
from polycnc.machine.model import Joint
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.modes import CornerMode
from polycnc.transformation.orientation.directions import angle_between


def context(text: str) -> Context:
    """The context of the last move of a program."""
    result = polycnc.run(
        f"F1000 X1\n{text}\nX50 A5\nM30\n", control="sinumerik-840d", machine="mill5-ca-head"
    )
    assert not result.alarms, result.alarms
    moves = [row for row in result.toolpath.rows() if row.kind is not Kind.EVENT]
    return moves[-1].context


@pytest.mark.parametrize(
    ("text", "tolerance", "distance"),
    [
        ("OSD G64 TRAORI", 0.0, 0.05),
        ("OST G64 TRAORI", 0.05, 0.0),
        ("OST G64 TRAORI OTOL=2", 2.0, 0.0),
        ("OST G64", 0.0, 0.0),
        ("OST G60 TRAORI", 0.0, 0.0),
        ("COMPON G64 TRAORI", 0.1, 0.0),
        ("COMPON G64 TRAORI ORICURVE", 0.0, 0.0),
        ("COMPON G64 TRAORI G0", 0.0, 0.0),
        ("COMPON G64 TRAORI G0\nX9\nG1 X10", 0.1, 0.0),
        ("OSD COMPON G64 TRAORI", 0.0, 0.05),
    ],
)
def test_rotary_axes_have_a_tolerance_of_their_own(text: str, tolerance: float, distance: float) -> None:
    found = context(text.replace(" TRAORI", "\nTRAORI\n"))
    assert (found.turn_tolerance_deg, found.turn_distance_mm) == (tolerance, distance)


@pytest.mark.parametrize(
    ("text", "mode", "tolerance"),
    [
        ("G64 COMPCAD", CornerMode.ROUNDED, 0.1),
        ("G64 COMPCAD CTOL=0.02", CornerMode.ROUNDED, 0.02),
        ("G642 COMPCAD CTOL=0.2", CornerMode.ROUNDED, 0.2),
        ("G641 ADIS=0.7 COMPCAD", CornerMode.ROUNDED_FROM, 0.7),
        ("G60 COMPCAD", CornerMode.EXACT_STOP, 0.0),
        ("G64 COMPOF", CornerMode.CONTINUOUS, 0.0),
    ],
)
def test_the_contour_has_that_of_the_compressor(text: str, mode: CornerMode, tolerance: float) -> None:
    found = context(text)
    assert (found.corner_mode, found.tolerance_mm) == (mode, tolerance)


@pytest.mark.parametrize(
    ("text", "each"),
    [
        ("COMPON G64 TRAORI OTOL=2", 2.0 / 2.0**0.5),
        ("COMPON G64 TRAORI ATOL[A]=0.3 ATOL[C]=0.2", 0.2),
        ("COMPON G64 TRAORI OTOL=2 ATOL[A]=0.3", 2.0 / 2.0**0.5),
    ],
)
def test_corners_leave_each_axis_its_part_of_the_direction(text: str, each: float) -> None:
    assert context(text.replace(" TRAORI", "\nTRAORI\n")).turn_tolerance_deg == pytest.approx(each)


@pytest.mark.parametrize("carries", ["tool tool", "work work", "work tool"])
@pytest.mark.parametrize("apart", [90.0, 45.0, 10.0])
def test_axes_that_turn_by_their_part_turn_the_direction_by_no_more_than_all(
    carries: str, apart: float
) -> None:
    draw = Random(carries)
    first, second = (0.0, 0.0, 1.0), (0.0, sin(radians(apart)), cos(radians(apart)))
    joints = [
        Joint(
            name,
            rotary=True,
            carries="tool" if who == "tool" else "work",
            direction=along,
            offset=(0.0, 0.0, 0.0),
        )
        for name, who, along in zip("AC", carries.split(), (first, second), strict=True)
    ]
    kinematics = Kinematics(
        tuple(joint for joint in joints if joint.carries == "tool"),
        tuple(joint for joint in joints if joint.carries == "work"),
    )
    part, largest = 0.1 / together(kinematics), 0.0
    for _ in range(300):
        angles = {axis: draw.uniform(-180.0, 180.0) for axis in "AC"}
        moved = {axis: angle + draw.choice((-part, part)) for axis, angle in angles.items()}
        off = degrees(angle_between(kinematics.tool_on_work(angles), kinematics.tool_on_work(moved)))
        largest = max(largest, off)
    assert 0.0 < largest <= 0.1 * 1.001
