"""Axes that move beside the path while a block is searched with program test."""

from __future__ import annotations

import pytest

from polycnc.mainrun.commands.states import State
from tests.mainrun.support import power_on

PROGRAM = "{}\nG1 X5 F1000\nX20\nG4 F1\nM30\n"


@pytest.mark.parametrize(
    "action", ["ID=1 DO POS[A]=30 FA[A]=3600", "ID=1 WHEN TRUE DO POS[A]=30 FA[A]=600", "POSA[A]=30 FA[A]=60"]
)
def test_they_stand_until_cycle_start_and_are_then_where_the_test_has_led_them(action: str) -> None:
    control = power_on(PROGRAM.format(action), "sinumerik-840d", machine="mill4")
    control.block_search(3, how="program-test")
    assert control.run(limit_s=600.0) is State.STOPPED
    control.step(1.0)
    assert control.positions.real["A"] == pytest.approx(0.0)
    control.cycle_start()
    control.run(limit_s=600.0)
    assert control.alarms == ()
    assert (control.positions.real["X"], control.positions.real["A"]) == pytest.approx((20.0, 30.0))


def test_an_endless_motion_goes_on_from_where_the_test_has_led_it() -> None:
    control = power_on(
        PROGRAM.format("ID=1 WHEN TRUE DO MOV[A]=1 FA[A]=600"), "sinumerik-840d", machine="mill4"
    )
    control.block_search(3, how="program-test")
    assert control.run(limit_s=600.0) is State.STOPPED
    assert control.positions.real["A"] == pytest.approx(0.0)
