"""Hands on the operator panel: what keys and switches do, what lamps show (Hartford manual, chapter 5)."""

from __future__ import annotations

from typing import Any

import pytest

from polycnc.mainrun import CommandRefused, State, VirtualControl
from polycnc.panel import Light, Panel

RUN = "O1\nM3 S1000\nG1 X100. F6000\nG0 X0\nM30\n"
CONTROLS = ("fanuc-m", "meldas-m")


def panel_of(text: str = RUN, control: str = "fanuc-m", **more: Any) -> Panel:
    virtual = VirtualControl(control, **more)
    virtual.load(text)
    return Panel(virtual)


def codes(panel: Panel) -> list[str]:
    return [alarm.code for alarm in panel.control.alarms]


def state_of(panel: Panel) -> State:
    return panel.control.state


def sounds(panel: Panel) -> bool:
    return panel.buzzer


def lit(panel: Panel) -> set[str]:
    return {name for name, light in panel.lamps().items() if light is Light.ON}


def test_only_the_two_machining_centres_have_a_panel() -> None:
    with pytest.raises(CommandRefused):
        Panel(VirtualControl("sinumerik-840d"))


# ---- safety key, modes ---------------------------------------------------------------------------------------


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


# ---- axes ----------------------------------------------------------------------------------------------------


def test_zero_return_goes_on_by_itself_and_lights_the_reference_lamp() -> None:
    panel = panel_of(setup={"start": {"X": -200, "Y": -100, "Z": -50}})
    assert not lit(panel) & {"E1", "E2", "E3"}
    panel.turn("mode", "zero")
    panel.press("X+")
    panel.release()
    panel.control.run()
    assert panel.control.machine_position == [0.0, -100.0, -50.0]
    assert lit(panel) & {"E1", "E2", "E3"} == {"E1"}
    with pytest.raises(CommandRefused):
        panel.press("X-")


def test_jog_moves_while_the_key_is_held_at_the_rate_of_its_table() -> None:
    panel = panel_of()
    panel.turn("mode", "jog")
    panel.turn("feed", 150)
    panel.press("Y-")
    panel.control.step(2.0)
    assert panel.control.feed == pytest.approx(1500.0)
    panel.release("Y-")
    panel.control.run()
    assert panel.control.feed == 0.0
    assert panel.control.machine_position[1] < -45.0


def test_rapid_mode_follows_the_rapid_override() -> None:
    speeds = []
    for position in ("100", "50", "F0"):
        panel = panel_of()
        panel.turn("mode", "rapid")
        panel.turn("rapid", position)
        panel.press("X+")
        panel.control.step(3.0)
        speeds.append(panel.control.feed)
    assert speeds == pytest.approx([24000.0, 12000.0, 400.0])


@pytest.mark.parametrize(("step", "way"), [("x1", 0.005), ("x10", 0.05), ("x100", 0.5)])
def test_the_handwheel_moves_the_chosen_axis_by_its_step(step: str, way: float) -> None:
    panel = panel_of()
    with pytest.raises(CommandRefused):
        panel.wheel(5)
    panel.turn("mode", "handle")
    panel.turn("handle_axis", "Z")
    panel.turn("handle_step", step)
    panel.wheel(-5)
    panel.control.run()
    assert panel.control.machine_position[2] == pytest.approx(-way)


def test_only_one_axis_is_jogged_with_an_open_door() -> None:
    panel = panel_of(setup={"switches": {"DOOR_OPEN": 1}})
    panel.turn("mode", "jog")
    panel.press("X+")
    panel.control.step(0.5)
    with pytest.raises(CommandRefused, match="1103"):
        panel.press("Y+")
    panel.control.run()
    assert codes(panel) == ["1103"]


def test_an_overtravel_is_left_with_the_release_key_in_jog_mode() -> None:
    panel = panel_of()
    panel.control.signals["OVERTRAVEL"] = 1.0
    assert codes(panel) == ["1001"]
    assert {"E13", "E14"} <= lit(panel)
    with pytest.raises(CommandRefused, match="A8"):
        panel.press("A8")
    panel.turn("mode", "jog")
    with pytest.raises(CommandRefused):
        panel.press("X-")
    panel.press("A8")
    panel.press("D12")
    panel.press("X-")
    panel.control.step(1.0)
    panel.control.signals["OVERTRAVEL"] = 0.0
    panel.release()
    panel.control.run()
    assert panel.control.machine_position[0] < -5.0
    assert codes(panel) == []
    assert "E14" not in lit(panel)


def test_without_the_release_key_the_overtravel_comes_back() -> None:
    panel = panel_of()
    panel.turn("mode", "jog")
    panel.control.signals["OVERTRAVEL"] = 1.0
    panel.press("A8")
    panel.press("D12")
    assert codes(panel) == []
    panel.release("A8")
    assert codes(panel) == ["1001"]


# ---- spindle and tool ----------------------------------------------------------------------------------------


def test_the_spindle_keys_turn_stop_and_orient_in_manual_modes() -> None:
    panel = panel_of("O1\nS700\nM0\nM30\n")
    panel.press("START")
    panel.control.run()
    with pytest.raises(CommandRefused):
        panel.press("C8", "B3")
    panel.turn("mode", "jog")
    panel.press("C8", "B1")
    assert lit(panel) & {"B1", "B3", "B4"} == {"B1"}
    panel.press("C8", "B3")
    assert lit(panel) & {"B1", "B3", "B4"} == {"B3"}
    panel.press("B2")
    assert not lit(panel) & {"B1", "B3", "B4"}
    panel.press("C8", "B4")
    assert lit(panel) & {"B1", "B3", "B4"} == {"B4"}


def test_a_setting_stops_the_spindle_when_a_manual_mode_is_chosen() -> None:
    for setting, lamps in ((0, {"B3"}), (1, set())):
        panel = panel_of("O1\nM3 S100\nG4 P60000\nM30\n", "meldas-m")
        panel.control.signals["SPINDLE_STOPS_WITH_MODE"] = setting
        panel.press("START")
        panel.control.step(1.0)
        panel.turn("mode", "jog")
        assert lit(panel) & {"B1", "B3"} == lamps


@pytest.mark.parametrize(
    ("control", "key", "code"),
    [
        *(("fanuc-m", "B1", "1095"), ("fanuc-m", "B3", "1095"), ("fanuc-m", "B4", "1094")),
        *(("meldas-m", "B1", "3009"), ("meldas-m", "B3", "3009"), ("meldas-m", "B4", "3009")),
    ],
)
def test_the_spindle_stands_while_the_tool_is_loose(control: str, key: str, code: str) -> None:
    panel = panel_of(control=control)
    panel.turn("mode", "handle")
    panel.press("UNCLAMP")
    assert "E9" in lit(panel)
    with pytest.raises(CommandRefused, match=code):
        panel.press("C8", key)
    assert codes(panel) == [code]
    panel.release("UNCLAMP")
    panel.press("RESET")
    assert "E9" not in lit(panel)
    panel.press("C8", key)


def test_the_unclamp_button_is_refused_while_the_spindle_turns() -> None:
    panel = panel_of()
    panel.turn("mode", "jog")
    panel.press("C8", "B3")
    with pytest.raises(CommandRefused, match="1104"):
        panel.press("UNCLAMP")
    assert "E9" not in lit(panel)


def test_the_unclamp_button_wants_a_manual_mode() -> None:
    with pytest.raises(CommandRefused):
        panel_of().press("UNCLAMP")


def test_meldas_orients_no_turning_spindle() -> None:
    panel = panel_of(control="meldas-m")
    panel.turn("mode", "jog")
    panel.press("C8", "B3")
    with pytest.raises(CommandRefused, match="3011"):
        panel.press("C8", "B4")


def test_a_door_that_is_open_keeps_the_spindle_still() -> None:
    for control, code in (("fanuc-m", "1102"), ("meldas-m", "3006")):
        panel = panel_of(control=control, setup={"switches": {"DOOR_OPEN": 1}})
        panel.turn("mode", "jog")
        with pytest.raises(CommandRefused, match=code):
            panel.press("C8", "B4")


def test_the_tool_display_shows_the_waiting_tool_on_the_left() -> None:
    panel = panel_of("O1\nT4 M6\nT9\nM0\nM30\n")
    panel.press("START")
    panel.control.run()
    assert panel.tool_display == (9, 4)


def test_a_refused_tool_change_lights_the_changer_lamp() -> None:
    for control in CONTROLS:
        panel = panel_of("O1\nT1\nG0 Z-5.\nM6\nM30\n", control)
        panel.press("START")
        panel.control.run()
        assert {"E13", "E15"} <= lit(panel)
        panel.press("D12")
        panel.control.run()
        assert not {"E13", "E15"} & lit(panel)


# ---- cycle control -------------------------------------------------------------------------------------------


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


# ---- restart -------------------------------------------------------------------------------------------------


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


# ---- machine keys --------------------------------------------------------------------------------------------


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


# ---- protection and power ------------------------------------------------------------------------------------


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
