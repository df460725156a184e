from __future__ import annotations

import pytest

from polycnc.session import open_session
from tests.control.sinumerik.support import codes, run
from tests.mainrun.support import power_on

PROGRAM = "TRAILON(V,Y,2)\nG1 Y10 F1000\nG3 X-10 Y20 I-10 J0\nTRAILOF(V)\nG0 V0\nM30\n"


@pytest.mark.parametrize(
    "line", ["TRAILON(X)", "TRAILON(,X)", "TRAILOF()", "TRAILON(X,Y,1,2)", "TRAILOF(X,Y,Z,X)"]
)
def test_arguments_that_mean_nothing(line: str) -> None:
    assert codes(run(line)) == [("14020", 1)]


def test_compensation_is_refused() -> None:
    result = run("T1 D1", "G1 G41 X10 F100", "TRAILON(Z,X)", tools={1: {"radius": 5, "type": 120}})
    assert codes(result) == [("PC0001", 3)]


def test_switching_off_what_is_not_on_is_no_mistake() -> None:
    assert codes(run("TRAILOF(X)", "TRAILOF(X,Y)")) == []


def test_the_virtual_control_leads_the_axis_in_the_same_time() -> None:
    planned = open_session(PROGRAM, control="sinumerik-840d", setup={"machine": "mill5-xyzvw"}).run()
    control = power_on(PROGRAM, "sinumerik-840d", machine="mill5-xyzvw")
    highest = 0.0
    control.cycle_start()
    while control.is_busy:
        control.step()
        highest = max(highest, control.positions.real["V"])
    assert highest == pytest.approx(40.0)
    assert control.time == pytest.approx(planned.time, abs=0.01)
