"""Hands on the operator panel: modes, safety key, protection, power (Hartford manual, chapter 5)."""

from __future__ import annotations

import pytest

from polycnc.control.registry import ids
from polycnc.mainrun import CommandRefused, State, VirtualControl
from polycnc.panel import Panel

from .support import lit, panel_of, state_of


@pytest.mark.parametrize("control", ids())
def test_every_control_has_a_panel(control: str) -> None:
    panel = Panel(VirtualControl(control))
    assert {"START", "HOLD", "RESET", "EMERGENCY"} <= panel.description.keys.keys()
    panel.press("EMERGENCY")
    assert panel.control.state is State.EMERGENCY
    panel.release("EMERGENCY")
    panel.press("RESET")
    panel.turn("mode", "jog")
    panel.press("X+")
    panel.control.step(0.3)
    panel.release("X+")
    assert panel.control.positions.machine["X"] > 0.0


@pytest.mark.parametrize("key", ["B1", "B3", "B4", "C1", "C7", "D3", "D4"])
def test_listed_keys_want_the_safety_key(key: str) -> None:
    panel = panel_of()
    panel.turn("mode", "handle")
    with pytest.raises(CommandRefused, match="C8"):
        panel.press(key)
    panel.press("C8", key)


def test_the_safety_key_may_be_held() -> None:
    panel = panel_of()
    panel.press("C8")
    panel.press("C1")
    panel.press("C2")
    panel.release("C8")
    assert (panel.control.switches.single_block, panel.control.switches.optional_stop) == ("SBL1", True)
    with pytest.raises(CommandRefused, match="C8"):
        panel.press("C1")


def test_the_mode_switch_holds_the_program_until_it_is_back() -> None:
    panel = panel_of()
    panel.press("START")
    panel.control.step(0.3)
    panel.turn("mode", "jog")
    panel.control.run()
    assert state_of(panel) is State.HOLD
    with pytest.raises(CommandRefused):
        panel.press("START")
    panel.turn("mode", "mdi")
    with pytest.raises(CommandRefused):
        panel.press("START")
    panel.turn("mode", "memory")
    panel.press("START")
    assert panel.control.run() is State.READY
    assert panel.control.parts == 1


def test_edit_mode_pauses_too_and_runs_nothing() -> None:
    panel = panel_of()
    panel.press("START")
    panel.control.step(0.3)
    panel.turn("mode", "edit")
    panel.control.run()
    assert state_of(panel) is State.HOLD
    with pytest.raises(CommandRefused):
        panel.press("START")


def test_dnc_and_tape_run_what_comes_from_outside() -> None:
    for control, mode in (("fanuc-m", "dnc"), ("meldas-m", "tape")):
        panel = panel_of(control=control)
        panel.turn("mode", mode)
        with pytest.raises(CommandRefused):
            panel.press("START")
        panel.control.load_tape("O5\nG0 Y5.\nM30\n")
        panel.press("START")
        panel.control.run()
        assert panel.control.machine_position[:2] == [0.0, 5.0]


def test_edit_protection_locks_programs_and_offsets() -> None:
    panel = panel_of()
    with pytest.raises(CommandRefused):
        panel.store("O2\nM30\n")
    panel.turn("mode", "edit")
    panel.turn("edit_protect", "on")
    with pytest.raises(CommandRefused, match="protection"):
        panel.store("O2\nM30\n")
    with pytest.raises(CommandRefused, match="protection"):
        panel.write("#500", 1.0)
    panel.turn("edit_protect", "off")
    panel.store("O2\nM30\n")
    panel.write("#500", 4.0)
    assert panel.control.program == "O0002"
    assert panel.control.read_variable("#500") == 4.0
    with pytest.raises(CommandRefused):
        panel.write("#99999", 4.0)


def test_auto_power_off_comes_ten_seconds_behind_the_program_end() -> None:
    panel = panel_of("O1\nG0 X1.\nM02\n")
    panel.press("C8", "C7")
    panel.press("START")
    panel.control.run()
    panel.control.step(9.9)
    assert state_of(panel) is State.READY
    panel.control.step(0.2)
    assert state_of(panel) is State.OFF
    assert not lit(panel)
    with pytest.raises(CommandRefused):
        panel.press("D10")
    panel.press("POWER_ON")
    panel.control.run()
    assert state_of(panel) is State.READY
    panel.control.step(20.0)
    assert state_of(panel) is State.READY


def test_a_start_within_the_ten_seconds_keeps_the_power_on() -> None:
    panel = panel_of("O1\nG0 X1.\nG4 P30000\nM30\n")
    panel.press("C8", "C7")
    panel.press("START")
    panel.control.run()
    panel.control.step(5.0)
    panel.press("START")
    panel.control.step(20.0)
    assert state_of(panel) is State.RUNNING


def test_power_off_is_held_for_three_seconds_and_not_while_a_program_runs() -> None:
    panel = panel_of("O1\nG4 P60000\nM30\n")
    panel.press("POWER_OFF")
    panel.control.step(2.0)
    panel.release("POWER_OFF")
    panel.control.step(5.0)
    assert state_of(panel) is State.READY
    panel.press("START")
    panel.press("POWER_OFF")
    panel.control.step(5.0)
    assert state_of(panel) is State.RUNNING
    panel.press("RESET")
    panel.control.step(3.5)
    assert state_of(panel) is State.OFF


def test_what_is_not_on_the_panel_is_told() -> None:
    panel = panel_of()
    with pytest.raises(CommandRefused):
        panel.press("D99")
    for switch, position in (("volume", 3), ("feed", 55), ("mode", "tape"), ("handle_axis", "Q")):
        with pytest.raises(CommandRefused):
            panel.turn(switch, position)


def test_a_key_that_cannot_act_now_says_why_before_it_is_pressed() -> None:
    panel = panel_of()
    assert panel.why_not("START") is None
    assert panel.why_not("C1") is None, "it acts, with C8"
    for key in ("B3", "D3", "A8", "HOLD", "POWER_ON"):
        assert panel.why_not(key) is not None
        with pytest.raises(CommandRefused):
            panel.press("C8", key)
    panel.turn("mode", "jog")
    assert panel.why_not("B3") is panel.why_not("D3") is panel.why_not("A8") is None
    refusal = panel.why_not("START")
    assert refusal is not None
    assert refusal.text("zh-TW") != refusal.text("en")
