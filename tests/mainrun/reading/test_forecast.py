"""What a program will do, calculated beside the control."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.control.registry import ids
from polycnc.mainrun import CommandRefused, VirtualControl
from polycnc.mainrun.reading.forecast import SLICE

if TYPE_CHECKING:
    from polycnc.toolpath.table import Chunk

PROGRAM = {
    "sinumerik-840d": "R1=R1+1\nG0 X10\nG1 Y5 F100\nM30\n",
    "syntec-mill": "@400 := @400+1;\nG0 X10.\nG1 Y5. F100\nM30\n",
}
_WORD_ADDRESS = "#500=#500+1\nG0 X10.\nG1 Z-5. F100.\nM30\n"


def forecast_rows(control: VirtualControl) -> int:
    chunks: list[Chunk] = []
    forecast = control.forecast()
    forecast.take = chunks.append
    forecast.finish()
    assert forecast.is_complete
    assert forecast.alarms == ()
    return sum(map(len, chunks))


@pytest.mark.parametrize("control", ids())
def test_nothing_of_the_control_changes(control: str) -> None:
    virtual = VirtualControl(control)
    virtual.load(PROGRAM.get(control, _WORD_ADDRESS))
    before = virtual.checkpoint()
    snapshot = virtual.snapshot
    assert forecast_rows(virtual) == forecast_rows(virtual) > 1
    assert virtual.snapshot == snapshot
    before.restore()
    virtual.cycle_start()
    virtual.run()
    assert virtual.parts == 1


def test_data_of_the_control_count() -> None:
    control = VirtualControl("fanuc-m")
    control.load("O1\nIF [#500 EQ 7] GOTO 9\nG0 X5.\nN9 M30\n")
    rows = forecast_rows(control)
    control.write_variable("#500", 7.0)
    assert forecast_rows(control) == rows - 1


def test_it_hands_over_after_a_few_blocks() -> None:
    control = VirtualControl("fanuc-m")
    control.load("O1\nWHILE [1 EQ 1] DO 1\n#1=#1+1\nG4 P1\nEND 1\nM30\n")
    forecast = control.forecast(block_limit=10 * SLICE)
    slices = 1
    while forecast.go_on():
        slices += 1
    assert slices >= 5
    assert forecast.has_reached_limit


def test_it_ends_where_the_clock_is_needed() -> None:
    control = VirtualControl("sinumerik-840d")
    control.load("G0 X1\nID=1 WHENEVER $AA_IM[X]>10 DO $R1=1\nG1 X20 F1000\nM30\n")
    forecast = control.forecast()
    forecast.finish()
    assert forecast.is_over
    assert not forecast.is_complete


def test_a_program_that_is_not_there_is_refused() -> None:
    control = VirtualControl("fanuc-m")
    with pytest.raises(CommandRefused):
        control.forecast("O4711")
    with pytest.raises(CommandRefused):
        control.forecast()
