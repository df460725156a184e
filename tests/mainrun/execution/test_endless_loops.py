"""A program that never ends goes on in the main run until its time is over; the clock never stands still."""

from __future__ import annotations

from unittest.mock import patch

import pytest

from polycnc.mainrun.execution.execution import BLOCK_S, FREE_BLOCKS, Execution
from polycnc.mainrun.preparation.preprocessing import BLOCKS_A_CYCLE, MOST, Preprocessing
from tests.mainrun.support import power_on

LOOPS = [
    ("fanuc-m", "O1\nG90\nM99\n"),
    ("meldas-m", "O1\nG90 G54 G94 G1 X60. F600.\nM99\n"),
    ("syntec-mill", "G90 G54\nM99\n"),
    ("fanuc-0i-tf", "O1\nG98\nM99\n"),
    ("fanuc-m", "O1\nN1 #1=#1+1\nGOTO1\nM30\n"),
    ("fanuc-m", "O1\nM98 P2\nG1\nM99\nO2\nM99\n"),
    ("sinumerik-840d", "LOOP\nM8\nENDLOOP\n"),
    ("sinumerik-840d", 'N1 MSG("A")\nGOTOB N1\nM30\n'),
    ("sinumerik-840d", "N1 G4 F0.000001\nGOTOB N1\nM30\n"),
]


@pytest.mark.parametrize(("control", "program"), LOOPS)
def test_time_passes_in_a_loop_without_a_way(control: str, program: str) -> None:
    virtual = power_on(program, control)
    virtual.cycle_start()
    virtual.run(limit_s=4.0)
    assert virtual.time == pytest.approx(4.0, abs=0.005)
    assert not virtual.alarms
    virtual.reset()
    virtual.run(limit_s=1.0)
    assert virtual.time < 5.0


@pytest.mark.parametrize("blocks", ["G90\n", "#1=#1+1\n"])
def test_blocks_without_a_way_cost_no_time(blocks: str) -> None:
    virtual = power_on("O1\n" + blocks * 3000 + "G4 P1000\n" + blocks * 9000 + "M30\n")
    virtual.cycle_start()
    virtual.run()
    assert virtual.time == pytest.approx(1.0, abs=0.005)


def test_a_block_behind_very_many_without_a_way_costs_its_time() -> None:
    virtual = power_on("O1\nG90\nM99\n")
    virtual.cycle_start()
    with patch.object(Execution, "_enter", autospec=True, side_effect=Execution._enter) as entered:
        virtual.run(limit_s=4.0)
    assert (entered.call_count - FREE_BLOCKS) * BLOCK_S == pytest.approx(4.0, rel=0.01)


def test_speeds_are_planned_once_for_many_blocks_without_a_way() -> None:
    blocks = 3 * MOST
    virtual = power_on("O1\nG1 X60. F600.\n" + "G90\n" * blocks + "M30\n")
    virtual.cycle_start()
    with patch.object(Preprocessing, "revise", autospec=True, side_effect=Preprocessing.revise) as revised:
        virtual.run(limit_s=60.0)
    assert revised.call_count < 2 * blocks / BLOCKS_A_CYCLE
