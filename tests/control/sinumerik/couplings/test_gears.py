from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, run
from tests.mainrun.support import power_on

DEFINITION = "EGDEF(Y,X,1)"


@pytest.mark.parametrize(
    "line",
    [
        "EGDEF(Z,X)", "EGDEF(Z,X,2)", "EGDEF(Z,X,1,X,1)", 'EGON(Y,"NOC",X,1)', 'EGON(Y,"NOC",X,1,1,X,1,1)', "EGDEL()",
        'EGONSYN(Y,"NOC",0,X,0,1)', "EGOFS()", "EGOFC(Y,X)",
    ],
)  # fmt: skip
def test_arguments_that_mean_nothing(line: str) -> None:
    assert codes(run(DEFINITION, line)) == [("14020", 2)]


def test_unknown_approach_and_axes_that_follow_already() -> None:
    assert codes(run(DEFINITION, 'EGONSYNE(Y,"NOC",0,"XYZ",X,0,1,1)')) == [("16795", 2)]
    assert codes(run("TRAILON(Y,X)", DEFINITION)) == [("16797", 2)]
    assert codes(run(DEFINITION, 'EGON(Y,"NOC",X,1,1)', 'EGON(Y,"NOC",X,1,1)')) == [("16797", 3)]


def test_a_gear_outlives_a_reset_and_a_new_program() -> None:
    control = power_on(f'{DEFINITION}\nEGON(Y,"NOC",X,3,1)\nG0 X2\nM30\n', "sinumerik-840d")
    control.cycle_start()
    control.run()
    control.reset()
    control.load("G0 X4\nM30\n")
    control.cycle_start()
    control.run()
    assert control.alarms == ()
    assert control.positions.machine["Y"] == pytest.approx(12.0)
    assert control.positions.work["Y"] == pytest.approx(12.0)
