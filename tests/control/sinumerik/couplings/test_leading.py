from __future__ import annotations

import pytest

from polycnc.session import open_session
from tests.control.sinumerik.support import codes, moves, run
from tests.mainrun.support import power_on

TABLE = ("CTABDEF(Y,X,1,0)", "G1 X0 Y0", "X10 Y10", "X20 Y0", "CTABEND")


@pytest.mark.parametrize("line", ["LEADON(Y,X)", "LEADON(Y,X,1,0)", "LEADOF()"])
def test_arguments_that_mean_nothing(line: str) -> None:
    assert codes(run(*TABLE, line)) == [("14020", 6)]


def test_an_axis_does_not_lead_itself() -> None:
    assert codes(run(*TABLE, "LEADON(X,X,1)")) == [("16785", 6)]
    assert codes(run(*TABLE, "LEADON(Y,X,1)", "LEADON(X,Y,1)")) == [("16778", 7)]


def test_the_virtual_control_leads_the_axis_through_the_extremes_of_the_table() -> None:
    text = "\n".join((*TABLE, "LEADON(Y,X,1)", "G1 X20 F1000", "M30", ""))
    planned = open_session(text, control="sinumerik-840d").run()
    control = power_on(text, "sinumerik-840d")
    highest = 0.0
    control.cycle_start()
    while control.is_busy:
        control.step()
        highest = max(highest, control.positions.real["Y"])
    assert highest == pytest.approx(10.0, abs=0.1)
    assert control.time == pytest.approx(planned.time, abs=0.01)


def test_a_reset_ends_the_coupling_and_frees_the_table() -> None:
    control = power_on("\n".join((*TABLE, "LEADON(Y,X,1)", "M30", "")), "sinumerik-840d")
    control.cycle_start()
    control.run()
    control.load("R1=$AA_COUP_ACT[Y] R2=CTABISLOCK(1)\nG0 X5\nM30\n")
    control.cycle_start()
    control.run()
    assert control.positions.machine["Y"] == pytest.approx(0.0)


def test_waiting_axes_see_arcs() -> None:
    result = run(*TABLE, "LEADON(Z,X,1)", "G3 X0 Y0 I5 J0 F1000", start={"Z": 3})
    assert codes(result) == [("PC0001", 7)]
    result = run(*TABLE, "LEADON(Z,X,1)", "G3 X8 Y0 I4 J0 F1000", start={"Z": 3})
    assert moves(result)[-1][1]["Z"] == pytest.approx(8.0)
