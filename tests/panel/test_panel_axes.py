"""The keys that move axes by hand, the spindle and the tool (Hartford manual, chapter 5)."""

from __future__ import annotations

import pytest

from polycnc.mainrun import CommandRefused

from .support import CONTROLS, codes, lit, panel_of


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


@pytest.mark.parametrize(("control", "speed"), [("fanuc-m", 900.0), ("meldas-m", 400.0)])
def test_a_parameter_of_fanuc_says_the_lowest_rapid(control: str, speed: float) -> None:
    panel = panel_of(control=control, setup={"parameters": {"1421": 900}})
    panel.turn("mode", "rapid")
    panel.turn("rapid", "F0")
    panel.press("X+")
    panel.control.step(3.0)
    assert panel.control.feed == pytest.approx(speed)


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
