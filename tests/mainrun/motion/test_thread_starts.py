"""In the main run too every cut of a thread meets the groove, whatever an operator does between two cuts."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.mainrun import State
from tests.mainrun.support import power_on

if TYPE_CHECKING:
    from polycnc.mainrun import VirtualControl

RPM, CYCLE_S = 300.0, 0.004
FANUC = "O1\nG99 G97 S300 M3\nG0 X20. Z5.\nG32 Z-20. F2.\nG0 X30.\nZ5.\nG4 P2000\nX20.\nG32 Z-20. F2.\nG0 X30.\nM30\n"
SIEMENS = "G90 G95 S300 M3 SOFT\nG0 X20 Z5\nG33 Z-20 K2\nG0 X30\nZ5\nG4 F2\nX20\nG33 Z-20 K2\nG0 X30\nM30\n"


def passes(virtual: VirtualControl) -> float:
    """When Z passes -5 on the thread that comes next, s: between two cycles it goes evenly."""
    virtual.run_until(lambda control: control.machine_position[1] > -4.0)
    assert virtual.run_until(lambda control: control.machine_position[1] < -5.0)
    first, here = virtual.time, virtual.machine_position[1]
    virtual.step(CYCLE_S)
    speed = (virtual.machine_position[1] - here) / (virtual.time - first)
    assert speed == pytest.approx(-2.0 * RPM / 60.0, rel=1e-6)
    return first + (-5.0 - here) / speed


def is_whole(turns: float) -> bool:
    return abs(turns - round(turns)) < 1e-5


@pytest.mark.parametrize(("text", "control"), [(FANUC, "fanuc-0i-tf"), (SIEMENS, "sinumerik-840d")])
@pytest.mark.parametrize("late", [0.0, 0.037, 0.123])
def test_a_hold_between_two_cuts_keeps_the_groove(text: str, control: str, late: float) -> None:
    virtual = power_on(text, control, machine="lathe2")
    virtual.cycle_start()
    first = passes(virtual)
    virtual.run_until(lambda control: control.machine_position[1] > 4.999)
    virtual.feed_hold()
    virtual.step(0.5 + late)
    virtual.cycle_start()
    second = passes(virtual)
    assert is_whole((second - first) * RPM / 60.0)
    assert virtual.run(limit_s=100.0) is State.READY


def test_who_is_held_while_the_spindle_comes_waits_for_it_again() -> None:
    text = SIEMENS.replace("S300", "S12").replace("Z-20 K2", "Z-1 K2")
    virtual = power_on(text, "sinumerik-840d", machine="lathe2")
    virtual.cycle_start()

    def start() -> float:
        virtual.run_until(lambda control: control.machine_position[1] > 4.999999)
        virtual.run_until(lambda control: control.machine_position[1] < 4.0)
        return virtual.time

    first = start()
    virtual.run_until(lambda control: control.machine_position[0] < 20.000001)
    virtual.run_until(lambda control: control.machine_position[0] > 29.9)
    virtual.run_until(lambda control: control.machine_position[0] < 20.000001)
    virtual.step(0.2)
    virtual.feed_hold()
    virtual.step(7.3)
    assert virtual.machine_position == pytest.approx([20.0, 5.0])
    virtual.cycle_start()
    turns = (start() - first) * 12.0 / 60.0
    assert abs(turns - round(turns)) < 2.0 * CYCLE_S * 12.0 / 60.0


def test_a_spindle_override_between_two_cuts_counts() -> None:
    virtual = power_on(FANUC, "fanuc-0i-tf", machine="lathe2")
    virtual.cycle_start()
    first = passes(virtual)
    virtual.run_until(lambda control: control.machine_position[1] > 4.999)
    virtual.step(0.5)
    virtual.override(spindle=0.5)
    virtual.step(0.732)
    virtual.override(spindle=1.0)
    second = passes(virtual)
    assert is_whole((second - first - 0.5 * 0.732) * RPM / 60.0)
