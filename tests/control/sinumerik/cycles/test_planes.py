"""A cycle does in G18 and G19 what it does in G17, with its axes exchanged."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import pytest

from polycnc.session import open_session

if TYPE_CHECKING:
    from collections.abc import Mapping

#: What X, Y and Z of a program in G17 are called in the other planes.
NAMES = {"G18": {"X": "Z", "Y": "X", "Z": "Y"}, "G19": {"X": "Y", "Y": "Z", "Z": "X"}}
CONTOUR = "G0 X0 Y0\nG1 X60\nG3 X60 Y40 CR=20\nG1 X0 RND=7\nY0\nM17\n"
CALLS = [
    "POCKET3(50,0,2,-12,70,40,8,10,20,-33,5,0.3,0.2,400,90,0,21,6,0,0,0,3,1.5)",
    "POCKET4(50,0,2,-12,30,10,20,5,0.3,0.2,400,90,1,12)",
    "SLOT1(50,0,2,-12,,3,30,12,10,20,25,-40,70,90,400,5,2,0.3,30,3,200,900,0.2,5)",
    "SLOT2(50,0,2,-12,,3,30,12,10,20,25,-40,70,90,400,5,2,0.3,10,3,200,900,300)",
    "LONGHOLE(50,0,2,-12,,3,30,10,20,25,-40,70,90,400,5)",
    "CYCLE71(50,6,2,0,10,20,-100,60,15,3,7,2,1,400,22,5)",
    'CYCLE72("CON",50,0,2,-7,3,0.3,0.2,400,90,10102,42,12,6,300,1,5)',
    "CYCLE76(50,0,2,-12,,60,30,6,10,20,-25,5,0.4,0.2,400,90,0,1,80,50)",
    "CYCLE79(50,0,2,-12,5,20,10,20,-12,3,70,4,5,0.4,0.2,400,0,1)",
    "CYCLE899(50,0,2,-12,50,16,10,20,-75,8,3,0.3,0.2,400,0,11)",
    "CYCLE90(50,0,2,-12,,30,26,1.5,400,2,0,10,20)",
    "CYCLE70(50,0,2,-12,30,1.2,0.1,2,3,0.5,400,0,10,20,30,121)",
    "SLOT1(50,0,2,-12,,3,30,20,10,20,25,-40,70,90,400,5,2,0.3,5,3,200,900,0.2,5,0,0,1,4,0,0,100)",
    "CYCLE78(50,0,2,-12,1,5,2,20,2,1,70,1,11000,0,3,400,90,300)",
    'CYCLE62("CON",0)\nCYCLE63("",21,50,0,2,-6,400,100,3,3,0.2,0.5,0,0,0,2,1,0,0,0,"",1,0,0,100,0)',
    "MCALL CYCLE86(50,0,2,-12,,1,4,-1,2,0.5,30)\nHOLES1(10,20,-70,5,10,3)\nMCALL",
    "MCALL CYCLE83(50,0,2,-12,,-3,,1,0.5,0.2,0.5,1)\nCYCLE801(10,20,-70,5,10,2,2)\nMCALL",
]


def exchanged(text: str, names: Mapping[str, str]) -> str:
    return re.sub(r"\b([XYZ])(?=[-\d])", lambda found: names[found[1]], text)


def rows(call: str, plane: str) -> list[dict[str, Any]]:
    """Moves of a call in a plane, as if it were G17."""
    names = NAMES.get(plane, {axis: axis for axis in "XYZ"})
    start = exchanged("G0 X3 Y-4 Z60", names)
    text = f"{plane} G90 G94\nT1 D1 M6\nS1000 M3 F200\n{start}\n{call}\nM30\n"
    result = open_session(
        text,
        control="sinumerik-840d",
        setup={"tools": {1: {"radius": 5.0}}},
        files={"CON.SPF": exchanged(CONTOUR, names)},
    ).run()
    assert [alarm.code for alarm in result.alarms] == []
    back = {own: axis for axis, own in names.items()}
    found = []
    for row in result.rows:
        places = {
            key: {back[axis]: round(value, 6) + 0.0 for axis, value in row[key].items()}
            for key in ("to", "center")
            if row.get(key)
        }
        found.append({"type": row["type"], "feed": row.get("feed"), **places})
    return found


@pytest.mark.parametrize("call", CALLS, ids=lambda call: call.split("(")[0].split()[-1])
def test_a_cycle_is_the_same_in_every_plane(call: str) -> None:
    first = rows(call, "G17")
    assert len(first) > 10
    assert rows(call, "G18") == first
    assert rows(call, "G19") == first
