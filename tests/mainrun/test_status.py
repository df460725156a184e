"""What a control counts and says beyond power-off."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc import VirtualControl

if TYPE_CHECKING:
    from pathlib import Path


def test_counters_and_messages_last(tmp_path: Path) -> None:
    path = tmp_path / "a.db"
    for _ in range(2):
        control = VirtualControl("sinumerik-840d", retained=path)
        control.load('MSG("CHECK THE CHUCK")\nG4 F2\nM30\n')
        control.cycle_start()
        control.run()
        control.close()
    control = VirtualControl("sinumerik-840d", retained=path)
    assert control.parts == 0
    assert control.counters.parts == 2
    assert 4.0 <= control.counters.running_s < 5.0
    assert control.message_history == ("CHECK THE CHUCK",) * 2
    control.close()


def test_mdi_makes_no_part() -> None:
    control = VirtualControl("fanuc-m")
    control.select_mode("mdi")
    control.mdi("M30\n")
    control.run()
    assert control.counters.parts == 0


def test_old_messages_are_forgotten() -> None:
    control = VirtualControl("sinumerik-840d")
    control.load("FOR R1=1 TO 120\nMSG(<<R1)\nENDFOR\nM30\n")
    control.cycle_start()
    control.run()
    assert control.message_history[0] == "120"
    assert len(control.message_history) == 100


def test_a_snapshot_brings_counters_back() -> None:
    control = VirtualControl("fanuc-m")
    control.load("G4 X2.\nM00\nG4 X2.\nM30\n")
    control.cycle_start()
    control.run()
    checkpoint = control.checkpoint()
    control.cycle_start()
    control.run()
    assert control.counters.parts == 1
    checkpoint.restore()
    assert control.counters.parts == 0
    control.cycle_start()
    control.run()
    assert control.counters.parts == 1


def test_run_time_counts_on_while_a_program_runs_and_cycle_time_begins_anew_with_every_run() -> None:
    control = VirtualControl("fanuc-m")
    control.load("G4 P4000\nM0\nG4 P2000\nM30\n")
    for before in (0.0, 6.0):
        control.cycle_start()
        control.step(3.0)
        assert control.counters.running_s == pytest.approx(before + 3.0, abs=0.01)
        assert control.counters.cycle_s == pytest.approx(3.0, abs=0.01)
        control.run()
        control.step(10.0)  # it waits at M00
        control.cycle_start()
        control.run()
        assert control.counters.cycle_s == pytest.approx(6.0, abs=0.05)
        control.step(5.0)
    assert control.counters.running_s == pytest.approx(12.0, abs=0.1)
    saved = control.checkpoint()
    control.cycle_start()
    control.step(1.0)
    saved.restore()
    assert control.counters.cycle_s == pytest.approx(6.0, abs=0.05)
