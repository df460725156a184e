"""What a control counts and says beyond power-off."""

from __future__ import annotations

from typing import TYPE_CHECKING

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
