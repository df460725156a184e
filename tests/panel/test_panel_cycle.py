"""Cycle start and what changes a run: single block, stops, overrides, restart (Hartford manual, chapter 5)."""

from __future__ import annotations

import pytest

from polycnc.mainrun import CommandRefused, State
from polycnc.panel import Light

from .support import codes, lit, panel_of, sounds


def test_single_block_wants_a_start_for_every_block() -> None:
    panel = panel_of("O1\nG0 X1.\nG0 X2.\nM30\n")
    panel.press("C8", "C1")
    assert "C1" in lit(panel)
    places = []
    panel.press("START")
    while panel.control.run() is State.STOPPED:
        places.append(panel.control.machine_position[0])
        panel.press("START")
    assert places[:2] == [1.0, 2.0]


def test_optional_stop_and_its_lamps() -> None:
    panel = panel_of("O1\nM3 S50\nM8\nG0 X7. M01\nM00\nM30\n")
    panel.press("C8", "C2")
    panel.press("START")
    panel.control.run()
    assert panel.control.machine_position[0] == 7.0, "the motion of the block comes first"
    assert panel.lamps()["E8"] is Light.ON
    assert "D1" not in lit(panel)
    panel.press("START")
    panel.control.run()
    assert panel.lamps()["E8"] is Light.BLINKING
    panel.press("START")
    panel.control.run()
    assert panel.lamps()["E8"] is Light.OFF


@pytest.mark.parametrize(("end", "light"), [("M02", Light.BLINKING), ("M30", Light.ON)])
def test_the_program_end_lamps(end: str, light: Light) -> None:
    panel = panel_of(f"O1\nG0 X1.\n{end}\n")
    panel.press("START")
    assert panel.lamps()["START"] is Light.ON
    panel.control.run()
    assert (panel.lamps()["E7"], panel.lamps()["CYCLE_END"]) == (light, Light.ON)
    assert panel.lamps()["START"] is Light.OFF
    panel.press("RESET")
    panel.press("START")
    assert (panel.lamps()["E7"], panel.lamps()["CYCLE_END"]) == (Light.OFF, Light.OFF)


def test_block_delete_dry_run_and_machine_lock() -> None:
    panel = panel_of("O1\n/G0 Y5.\nG1 X100. F6000\nM30\n")
    for key in ("C3", "C4", "C5"):
        panel.press("C8", key)
    panel.turn("feed", 50)
    panel.press("START")
    panel.control.step(1.0)
    assert panel.control.feed == pytest.approx(500.0), "the jog rate instead of F"
    panel.control.run()
    assert (panel.control.positions.machine["X"], panel.control.positions.real["X"]) == (100.0, 0.0)
    assert panel.control.positions.machine["Y"] == 0.0
    assert {"C3", "C4", "C5"} <= lit(panel)


def test_feed_hold_lights_until_the_start_and_zero_override_stands_still() -> None:
    panel = panel_of()
    panel.press("START")
    panel.control.step(0.3)
    panel.press("HOLD")
    panel.control.run()
    assert (panel.lamps()["HOLD"], panel.lamps()["START"], panel.control.feed) == (Light.ON, Light.OFF, 0.0)
    assert panel.alarm_lines("en")[0].startswith("2021 ")
    panel.press("START")
    assert panel.lamps()["HOLD"] is Light.OFF
    panel.turn("feed", 0)
    panel.control.step(2.0)
    assert (panel.control.state, panel.control.feed) == (State.RUNNING, 0.0)
    panel.turn("feed", 200)
    panel.control.step(0.2)
    assert panel.control.feed > 6000.0


def test_the_soft_key_holds_the_feed_at_100_percent() -> None:
    panel = panel_of()
    panel.turn("feed", 50)
    panel.press("F100")
    panel.press("START")
    panel.control.step(0.7)
    assert panel.control.feed == pytest.approx(6000.0)
    assert {"OVC", "F100"} & lit(panel) == {"OVC"}
    panel.press("F100")
    panel.control.step(0.3)
    assert panel.control.feed == pytest.approx(3000.0)


def test_soft_keys_have_their_lamps() -> None:
    panel = panel_of()
    for key, lamp, at_first in (
        ("Z_LOCK", "ZNG", False),
        ("MST_LOCK", "AFL", False),
        ("ABSOLUTE", "ABS", True),
    ):
        assert (lamp in lit(panel)) == at_first
        panel.press(key)
        assert (lamp in lit(panel)) != at_first
        panel.press(key)
        assert (lamp in lit(panel)) == at_first


def test_the_emergency_stop_begins_the_program_anew() -> None:
    panel = panel_of()
    panel.press("START")
    panel.control.step(0.4)
    panel.press("EMERGENCY")
    panel.control.run()
    assert (panel.control.state, codes(panel), sounds(panel)) == (State.EMERGENCY, ["1007"], True)
    stopped_at = panel.control.machine_position[0]
    assert 0.0 < stopped_at < 100.0
    panel.release("EMERGENCY")
    panel.control.run()
    assert (panel.control.state, sounds(panel)) == (State.READY, False)
    panel.press("START")
    panel.control.step(0.1)
    assert panel.control.active_block.line in (2, 3)
    assert panel.control.run() is State.READY


def test_program_restart_wants_the_axes_back_by_hand() -> None:
    panel = panel_of("O1\nG0 X10.\nN7 G1 X50. F6000\nM30\n")
    with pytest.raises(CommandRefused):
        panel.search("N7")
    panel.press("C8", "C6")
    panel.search("N7")
    assert panel.restart_lines()[0] == ("X", 10.0, "", 10.0)
    panel.turn("mode", "handle")
    panel.turn("handle_step", "x100")
    panel.wheel(100)
    panel.control.run()
    assert panel.restart_lines()[0] == ("X", 10.0, "RP", 0.0)
    panel.turn("mode", "memory")
    with pytest.raises(CommandRefused):
        panel.press("START")
    panel.press("C8", "C6")
    panel.press("START")
    assert panel.control.run() is State.READY
    assert panel.control.machine_position[0] == 50.0


def test_program_restart_away_from_its_position_is_refused_unless_it_is_automatic() -> None:
    panel = panel_of("O1\nG0 X10.\nN7 G1 X50. F6000\nM30\n")
    panel.press("C8", "C6")
    panel.search("N7")
    panel.press("C8", "C6")
    with pytest.raises(CommandRefused):
        panel.press("START")
    panel.control.signals["RESTART_AUTOMATIC"] = 1.0
    panel.press("START")
    panel.control.step(0.2)
    assert panel.control.feed == pytest.approx(1000.0), "at the rate of the dry run"
    assert panel.control.run() is State.READY
