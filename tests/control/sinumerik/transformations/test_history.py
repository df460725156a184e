"""ORISON: the tool stays within its tolerance, the tip where it is programmed, the ends as programmed."""

from __future__ import annotations

import random

import pytest

import polycnc
from polycnc.machine import load_machine
from polycnc.machine.kinematics import Kinematics
from polycnc.transformation.orientation.directions import angle_between

MACHINE = "mill5-ca-head"
HEAD = "G1 F2000 X0 Y0 Z0 C20 A30\nTRAORI\n"
TOLERANCE_DEG = 1.5


def rows(text: str) -> list[dict[str, float]]:
    result = polycnc.run(text, control="sinumerik-840d", machine=MACHINE)
    assert not result.alarms, result.alarms
    return [dict(move["to"]) for move in result.rows if "to" in move]


@pytest.mark.parametrize("seed", range(6))
def test_the_direction_leaves_its_course_by_no_more_than_the_tolerance(seed: int) -> None:
    random_ = random.Random(seed)
    blocks = "".join(
        f"X{3 * k} Y{random_.uniform(-2, 2):.3f} C{random_.uniform(0, 40):.3f} A{random_.uniform(20, 50):.3f}\n"
        for k in range(1, 30)
    )
    plain = rows(f"{HEAD}{blocks}M30\n")
    smooth = rows(f"{HEAD}ORISON\n$SC_ORISON_TOL={TOLERANCE_DEG}\n{blocks}ORISOF\nM30\n")
    assert len(plain) == len(smooth)
    kinematics = Kinematics.of(load_machine(MACHINE))
    offs = []
    for before, after in zip(plain, smooth, strict=True):
        assert [after[axis] for axis in "XYZ"] == [before[axis] for axis in "XYZ"]
        tools = [kinematics.tool_on_work({axis: row[axis] for axis in "CA"}) for row in (before, after)]
        offs.append(angle_between(*tools))
    assert max(offs) == pytest.approx(TOLERANCE_DEG * 0.017453292519943295, rel=0.02)
    assert offs[-1] == 0.0


def test_auxiliary_functions_interrupt_and_few_blocks_are_kept() -> None:
    text = "ORISON\n$SC_ORISON_TOL=9\nX5 A40\nX10 A30\nM8\nX15 A40\nX20 A30\nX25 A40\nORISOF\nM30\n"
    assert [row["A"] for row in rows(HEAD + text)][1:] == [35.0, 30.0, 35.0, 35.0, 40.0]


def test_stopping_preparation_ends_the_stretch() -> None:
    text = "ORISON\n$SC_ORISON_TOL=9\nX5 A40\nX10 A30\nSTOPRE\nX15 A40\nX20 A30\nM30\n"
    assert [row["A"] for row in rows(HEAD + text)][1:] == [35.0, 30.0, 35.0, 30.0]
