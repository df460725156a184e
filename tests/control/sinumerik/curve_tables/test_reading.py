from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, run

TABLE = ("DEF REAL GRAD", "CTABDEF(Y,X,1,0)", "G1 X0 Y0", "X10 Y5", "CTABEND")


@pytest.mark.parametrize("line", ["R1=CTABTMIN(1,2)", "R1=CTABTMIN(1,8,2)", "R1=CTAB(5,1)"])
def test_arguments_that_mean_nothing(line: str) -> None:
    assert codes(run(*TABLE, line)) == [("14020", 6)]


def test_an_action_reads_a_table() -> None:
    result = run(
        *TABLE,
        "ID=1 DO $AC_PARAM[1]=CTAB($AA_IM[X],1,$AC_PARAM[2])",
        "G1 X8 F1000",
        "R1=$AC_PARAM[1] R2=$AC_PARAM[2]",
    )
    assert codes(result) == []
    assert (result.variables["R1"], result.variables["R2"]) == pytest.approx((4.0, 0.5))


def test_an_action_hands_a_slope_to_a_variable_of_its_own() -> None:
    assert codes(run(*TABLE, "ID=1 DO $AC_PARAM[1]=CTAB($AA_IM[X],1,GRAD)")) == [("12580", 6)]
