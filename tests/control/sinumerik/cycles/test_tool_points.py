"""61608: turning cycles refuse a nose that would be reckoned with on the wrong side."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, run

START = ("G18 G90 G95 DIAMON", "T1 D1", "S500 M3 F0.1")
SECOND_EDGE = "$TC_DP1[1,2]=520 $TC_DP2[1,2]=4 $TC_DP4[1,2]=3 $TC_DP6[1,2]=0.4"
#: A contour behind the program's end, lengthwise towards the chuck.
CONTOUR = ("M30", "AA: G1 X40 Z0", "Z-20", "BB: X50")
OUTSIDE = ("G0 X80 Z10", 'CYCLE95("AA:BB",2,0,0,0,0.3,0.2,0.1,{})', *CONTOUR)
OF_MASK = 'CYCLE952("R","","",{},0.3,0.15,0,4,0,0,0,0,0,0,1,60,2,,,,,2,2,,,0,1,,0,12,0,1,0)'
CORNER = ("G0 X80 Z10", "CYCLE951(60,0,40,-20,40,-20,1,2,0,0,{},0,0,0,1,0.2,0,0,0)")
GROOVE = ("G0 X80 Z10", SECOND_EDGE, "CYCLE93({},-20,8,4,0,0,0,0,0,0,0,0,0,2,0,{})")


def alarms(lines: tuple[str, ...], tip: int, radius: float = 0.4) -> list[str]:
    tools = {1: {"type": 500, "radius": radius, "tip": tip}}
    return [code for code, _ in codes(run(*START, *lines, machine="lathe2", tools=tools))]


def filled(lines: tuple[str, ...], *values: object) -> tuple[str, ...]:
    return tuple(line.format(*values) if "CYCLE" in line else line for line in lines)


def of_mask(vari: int) -> tuple[str, ...]:
    return ("G0 X80 Z10", 'CYCLE62("",2,"AA","BB")', OF_MASK.format(vari), *CONTOUR)


@pytest.mark.parametrize(
    ("lines", "right", "wrong"),
    [
        (filled(OUTSIDE, 1), (3, 7, 9), (1, 2, 4)),
        # Finishing may draw the tool along the contour.
        (filled(OUTSIDE, 5), (3, 4), (1, 2)),
        (of_mask(101311), (3,), (1, 2, 4)),
        (of_mask(101321), (3, 4), (1, 2)),
        (filled(CORNER, 11), (3,), (1, 2, 4)),
        (filled(CORNER, 21), (3, 4), (1, 2)),
        (filled(GROOVE, 60, 5), (3,), (1, 2, 4, 8)),
        (filled(GROOVE, 60, 7), (2,), (1, 3, 4, 6)),
    ],
)
def test_the_point_looks_at_the_work(
    lines: tuple[str, ...], right: tuple[int, ...], wrong: tuple[int, ...]
) -> None:
    assert {tip: alarms(lines, tip) for tip in right} == {tip: [] for tip in right}
    assert {tip: alarms(lines, tip) for tip in wrong} == {tip: ["61608"] for tip in wrong}


def test_without_a_nose_the_point_is_where_it_is_told() -> None:
    assert alarms(filled(OUTSIDE, 1), 1, radius=0.0) == []
