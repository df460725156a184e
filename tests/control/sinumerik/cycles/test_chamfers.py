"""Chamfers: what they refuse, and that the cone meets the wall where the chamfer ends."""

from __future__ import annotations

from typing import Any

import pytest

from tests.control.sinumerik.support import codes, moves, run

POCKET = "POCKET4(20,0,2,-6,10,0,0,4,0,0,500,100,0,5,0,0,0,0,0,0,{},{},0,0,{})"
MILL: dict[str, Any] = {"radius": 0.5}
DRILL: dict[str, Any] = {"type": 220, "radius": 2.0}


def alarms(call: str, tool: dict[str, Any], *before: str) -> list[str]:
    return [code for code, _ in codes(run("G17 G94", *before, "T1 D1 M6", "S1000 M3", call, tools={1: tool}))]


@pytest.mark.parametrize(
    ("width", "tip", "amode", "alarm"),
    [
        (1, 3, 100, []),
        (1, -3, 0, []),
        (0, 3, 100, ["61118"]),
        (1, 0.5, 100, ["61101"]),  # the tip lies above the chamfer's foot
        (1, 3, 0, ["61101"]),  # absolute, above the face
        (1, 7, 100, ["61101"]),  # below the base
        (1, 6, 100, []),
        (0.1, 10.5, 100, ["61101"]),
    ],
)
def test_sizes(width: float, tip: float, amode: int, alarm: list[str]) -> None:
    assert alarms(POCKET.format(width, tip, amode), MILL) == alarm


@pytest.mark.parametrize(
    ("tool", "angles", "alarm"),
    [
        ({"radius": 0.0}, "", []),
        ({"radius": -1.0}, "", ["61112"]),
        ({"radius": 9.0}, "", ["61105"]),
        (DRILL, "$TC_DP24[1,1]=90", ["61105"]),  # its cone is 2 mm long
        (DRILL | {"radius": 3.0}, "$TC_DP24[1,1]=90", []),
        (DRILL | {"radius": 3.0}, "$TC_DP24[1,1]=118", ["PC0001"]),
        (DRILL | {"radius": 3.0}, "", ["PC0001"]),
        ({"type": 155, "radius": 1.0}, "$TC_DP11[1,1]=45", []),
        ({"type": 155, "radius": 1.0}, "$TC_DP11[1,1]=30", ["PC0001"]),
    ],
)
def test_tools(tool: dict[str, Any], angles: str, alarm: list[str]) -> None:
    assert alarms(POCKET.format(1, 3, 100), tool, angles) == alarm


def test_a_path_needs_a_side() -> None:
    call = 'CYCLE72("CON",20,0,2,-6,4,0,0,500,100,5,40,1,3,0,1,3,0,1,3,0,0,100)'
    assert alarms(call, MILL) == ["61114"]


def test_the_tool_is_not_scaled() -> None:
    assert alarms(POCKET.format(1, 3, 100), MILL, "SCALE X2 Y2") == ["61011"]


def test_a_turned_and_mirrored_slot_is_chamfered_where_it_lies() -> None:
    slot = "SLOT1(20,0,2,-6,,1,40,12,0,0,20,0,0,100,500,4,3,0,5,0,0,0,0,0,0,0,1,3,0,0,100)"
    lines = ("G17 G94", "T1 D1 M6", "S1000 M3", "TRANS X10", "AROT Z90", "AMIRROR Y0", slot)
    rows = [
        row["machine"] for row in run(*lines, tools={1: MILL}).rows if row["type"] in ("feed", "cw", "ccw")
    ]
    # (26, -3.5) to (54, 3.5) of the slot: mirrored across, turned to Y, shifted along X.
    assert [(round(row["X"], 6), round(row["Y"], 6)) for row in rows[1:4]] == [
        (6.5, 26),
        (6.5, 54),
        (13.5, 54),
    ]


def test_the_deeper_the_tip_the_farther_it_keeps_from_the_wall() -> None:
    for tip in (1.0, 2.0, 5.0):
        lines = ("G17 G94", "T1 D1 M6", "S1000 M3", POCKET.format(1, tip, 100))
        found = [end for kind, end in moves(run(*lines, tools={1: MILL})) if kind == "ccw"]
        # The circle of radius 10 less the cone's radius at the foot of the chamfer, 1 mm below the face.
        assert found[0]["X"] == pytest.approx(10.0 - (0.5 + tip - 1.0))
