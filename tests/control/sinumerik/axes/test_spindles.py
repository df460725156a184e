"""SPOS of spindles that are axes."""

from __future__ import annotations

import pytest

from polycnc.mainrun import State
from tests.control.sinumerik.support import codes, run
from tests.mainrun.support import power_on


def test_a_spindle_that_is_no_axis_leaves_all_axes() -> None:
    result = run("G0 X10", "SPOS=45", "G0 X20", machine="lathe2")
    assert [row["machine"] for row in result.rows if "machine" in row][-1] == {"X": 20.0, "Z": 0.0}


def test_the_axis_goes_along_with_its_spindle() -> None:
    result = run("SPOS=45 ", "G0 X10", "SPOSA=ACN(300)", "G0 X20", machine="lathe-c")
    assert [row["machine"]["C"] for row in result.rows if "machine" in row] == [45.0, 300.0]


def test_the_axis_is_shown_in_the_work_with_its_frame() -> None:
    result = run("TRANS C10", "SPOS=45 ", "G0 X10", machine="lathe-c")
    assert [(row["to"]["C"], row["machine"]["C"]) for row in result.rows if "machine" in row] == [
        (35.0, 45.0)
    ]


def test_an_axis_that_a_transformation_uses_up_is_not_positioned() -> None:
    assert codes(run("TRACYL(40)", "SPOS=0", machine="lathe-c-transmit")) == [("17610", 2)]


def test_a_program_that_is_executed_in_time_waits_for_the_axis() -> None:
    result = run("ID=1 WHEN $AA_IM[X]>1 DO $R9=1", "SPOS=45", "R1=$AA_IM[C]", "G0 X10", machine="lathe-c")
    assert result.variables["R1"] == 45.0


@pytest.mark.parametrize(("wait", "waits"), [("WAITS", True), ("WAITS(1)", True), ("", False)])
def test_waits_waits_for_the_axis_that_sposa_moves(wait: str, waits: bool) -> None:
    virtual = power_on(f"SPOSA=90\n{wait}\nG4 F1\nM30\n", "sinumerik-840d", machine="lathe-c")
    virtual.cycle_start()
    assert virtual.run_until(lambda control: control.active_block.line == 3, limit_s=10.0)
    assert (virtual.positions.machine["C"] == pytest.approx(90.0)) is waits
    assert virtual.run() is State.READY


@pytest.mark.parametrize("block", ["SPOS=90", "SPOSA=90", "POS[C]=90", "G0 C90"])
def test_a_transformation_begins_where_the_axis_stands(block: str) -> None:
    lines = ("G0 X40 C30", block, "TRANSMIT", "G1 X20 Y0 F1000")
    found = run(*lines, machine="lathe-c-transmit")
    there = run("G0 X40 C30", "G0 C90", *lines[2:], machine="lathe-c-transmit")
    last = len(found.plan.row_s) - 1
    moves_s = found.plan.row_s[last] - found.plan.row_waits.get(last, 0.0)
    assert moves_s == pytest.approx(there.plan.row_s[-1])
    virtual = power_on("\n".join((*lines, "M30")), "sinumerik-840d", machine="lathe-c-transmit")
    virtual.block_search(4)
    virtual.cycle_start()
    assert virtual.run_until(lambda control: control.active_block.line == 4, limit_s=10.0)
    assert virtual.positions.machine["C"] == pytest.approx(90.0, abs=2.0)
