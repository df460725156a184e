"""Contours that are only read: what they have changed is put back, also by a reset in their midst."""

from __future__ import annotations

import pytest

import polycnc
from polycnc.control.sinumerik.motion.contour_reading import Readings
from tests.control.sinumerik.support import run

HEAD = ("G90 G54 G17 T1 D1 M6", "G0 X3 Y4 Z20 S800 M3 F300")
CYCLE = 'CYCLE72("CON",10,0,2,-4,4,0,0,500,100,1,42,1,8,900,1,8)'
ZONE = ("G1 X10 Y0", "X20", "Y10", "X10", "Y0")
TOOLS = {1: {"radius": 2.0}}


@pytest.mark.parametrize(
    "lines",
    [
        (*HEAD, CYCLE, "M30", "%_N_CON_SPF", "G1 X20 Y0", "G18", "X40", "R1=SQRT(-1)", "M17"),
        (*HEAD, "CPROTDEF(1,0,0)", "G1 X10 Y0", "X20", "R1=SQRT(-1)", "EXECUTE(NU)"),
    ],
)
def test_after_an_alarm_in_a_contour_a_reset_has_the_tool_where_it_stands(lines: tuple[str, ...]) -> None:
    text = "\n".join(("%_N_MAIN_MPF", *lines, "M30", ""))
    result = polycnc.run(text, control="sinumerik-840d", setup={"tools": TOOLS})
    channel = result.channel
    assert [alarm.line for alarm in result.alarms] == [text.splitlines().index("R1=SQRT(-1)") + 1]
    assert len(Readings.of(channel).open) == 1
    channel.control.reset(channel)
    assert Readings.of(channel).open == []
    assert channel.path.is_idle
    assert channel.coordinates.machine[:2] == [3.0, 4.0]
    assert channel.mode["plane"] == "G17"


def test_a_tangent_goes_on_from_the_move_before_a_zone_was_defined() -> None:
    before, behind = ("DEF INT NU", *HEAD, "G1 X10 Y4"), ("CT X20 Y14",)
    with_a_zone = run(*before, "CPROTDEF(1,FALSE,0)", *ZONE, "EXECUTE(NU)", *behind, tools=TOOLS)
    assert not with_a_zone.alarms
    arcs = [
        [(row["to"], row["center"]) for row in result.rows if "center" in row]
        for result in (with_a_zone, run(*before, *behind, tools=TOOLS))
    ]
    assert arcs[0] == arcs[1]
    assert len(arcs[0]) == 1
