"""The keys of the machine: coolant, conveyor, magazine, door, light, alarms (Hartford manual, chapter 5)."""

from __future__ import annotations

import pytest

from polycnc.mainrun import CommandRefused

from .support import CONTROLS, codes, lit, panel_of, sounds


@pytest.mark.parametrize(
    ("key", "on", "off"), [("D1", "M8", "M9"), ("D2", "M50", "M9"), ("D5", "M68", "M69")]
)
def test_a_key_switches_on_and_off_and_the_program_takes_over(key: str, on: str, off: str) -> None:
    panel = panel_of(f"O1\n{on}\nG0 X1.\nG4 P100\n{off}\nG4 P900\nM30\n")
    panel.press(key)
    assert key in lit(panel)
    panel.press(key)
    assert key not in lit(panel)
    panel.press("START")
    panel.control.run_until(lambda control: control.active_block.line == 4)
    assert key in lit(panel)
    panel.control.run_until(lambda control: control.active_block.line == 6)
    assert key not in lit(panel)


def test_the_conveyor_runs_back_only_while_it_stands() -> None:
    panel = panel_of()
    panel.press("D6")
    assert "D6" in lit(panel)
    panel.release("D6")
    assert "D6" not in lit(panel)
    panel.press("D5")
    panel.press("D6")
    assert lit(panel) & {"D5", "D6"} == {"D5"}


def test_the_magazine_turns_by_a_pocket_for_each_press_in_jog_and_handle() -> None:
    panel = panel_of()
    with pytest.raises(CommandRefused):
        panel.press("C8", "D4")
    for mode, key, pocket in (("jog", "D4", 2), ("handle", "D4", 3), ("jog", "D3", 2)):
        panel.turn("mode", mode)
        panel.press("C8", key)
        assert panel.control.signals["MAGAZINE_POCKET"] == pocket
    panel.turn("mode", "rapid")
    with pytest.raises(CommandRefused):
        panel.press("C8", "D3")


def test_the_door_opens_in_manual_modes_and_at_the_program_end() -> None:
    panel = panel_of("O1\nG4 P500\nM30\n")
    panel.press("D9")
    assert "D9" not in lit(panel), "in memory mode the door stays shut"
    panel.turn("mode", "jog")
    panel.press("D9")
    assert "D9" in lit(panel)
    panel.press("D9")
    panel.turn("mode", "memory")
    panel.press("START")
    panel.control.run()
    panel.press("D9")
    assert "D9" in lit(panel)
    with pytest.raises(CommandRefused, match="1098"):
        panel.press("START")


def test_a_door_with_a_drive_opens_at_the_program_end() -> None:
    panel = panel_of("O1\nG0 X1.\nM30\n", setup={"switches": {"AUTO_DOOR": 1}})
    panel.press("START")
    panel.control.run()
    assert "D9" in lit(panel)


def test_light_and_nozzle_work_in_every_mode() -> None:
    panel = panel_of()
    for mode in panel.description.modes:
        panel.turn("mode", mode)
        panel.press("D10")
        assert "D10" in lit(panel)
        panel.press("D10")
        panel.press("D7")
        assert "D7" in lit(panel)
        panel.release("D7")
        assert not {"D7", "D10"} & lit(panel)


def test_the_buzzer_is_silenced_and_the_reset_key_clears_the_alarm_once_its_cause_is_gone() -> None:
    panel = panel_of()
    panel.control.signals["AIR_LOW"] = 1.0
    assert sounds(panel)
    assert {"D11", "D12", "E10", "E13"} <= lit(panel)
    panel.press("D11")
    assert not sounds(panel)
    assert "E10" in lit(panel)
    panel.press("D12")
    panel.control.run()
    assert codes(panel) == ["1051"]
    panel.control.signals["AIR_LOW"] = 0.0
    panel.press("D12")
    panel.control.run()
    assert codes(panel) == []
    assert not {"D11", "D12", "E10", "E13"} & lit(panel)


def test_overload_and_lubrication_have_their_lamps() -> None:
    for control in CONTROLS:
        panel = panel_of(control=control)
        panel.control.signals["COOLANT_OVERLOAD"] = 1.0
        panel.control.signals["LUBE_EMPTY"] = 1.0
        assert {"E11", "E12"} <= lit(panel)
        assert len(panel.alarm_lines("zh-TW")) == 2
