"""Keys and lamps of the machine (Hartford 5.2.4.4, 5.2.4.8 h to 5.2.4.16, 5.3)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.panel import Light

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.panel.bench import Bench

    Make = Callable[..., Bench]

CCW = ("Spindle counter-clockwise", "主軸逆轉")
CW = ("Spindle clockwise", "主軸正轉")
ORIENTED = ("Spindle orientation", "主軸定位")
COOLANT = ("Coolant pump", "切削液泵")
AIR = ("Spindle side air", "主軸側吹")
FORWARD = ("Chip conveyor forward", "排屑機正轉")
REVERSE = ("Chip conveyor reverse", "排屑機逆轉")
DOOR = ("Safety door", "安全門")
NC_ALARM = ("Alarm of the control", "NC 警示")


def page(panel: Bench, chapter: str) -> str:
    """What the page of a chapter shows: alarms or positions."""
    keys = {
        "alarms": {"fanuc-m": "MESSAGE", "meldas-m": "DIAGN/IN-OUT"},
        "positions": {"fanuc-m": "POS", "meldas-m": "MONITOR"},
    }
    panel.keys(keys[chapter][panel.control.control.id])
    return panel.text


@pytest.mark.feature("har.panel_spindle")
def test_the_spindle_keys_turn_stop_and_orient(bench: Make) -> None:
    panel = bench("O1\nS700\nM30\n")
    panel.start()
    panel.turn("mode", "jog")
    panel.press("C8", "B1")
    panel.passes(3.0)
    assert [panel.is_lit(*name) for name in (CCW, CW, ORIENTED)] == [True, False, False]
    assert panel.control.spindle.direction == -1
    assert "700" in page(panel, "positions")
    panel.turn("spindle", "50")
    panel.passes(3.0)
    assert panel.control.spindle.rpm == pytest.approx(350.0)
    panel.press("C8", "B3")
    assert [panel.is_lit(*name) for name in (CCW, CW, ORIENTED)] == [False, True, False]
    panel.press("B2")
    assert not any(panel.is_lit(*name) for name in (CCW, CW, ORIENTED))
    panel.press("C8", "B4")
    assert [panel.is_lit(*name) for name in (CCW, CW, ORIENTED)] == [False, False, True]
    panel.turn("mode", "memory")
    panel.press("C8", "B3")
    assert panel.says("acts only in mode", "模式有效") in panel.message


WITH_C8 = ("B1", "B3", "B4", "C1", "C2", "C3", "C4", "C5", "C6", "C7", "D3", "D4")


@pytest.mark.feature("har.panel_safety")
@pytest.mark.parametrize("key", WITH_C8)
def test_a_listed_key_does_nothing_without_the_safety_key(key: str, bench: Make) -> None:
    panel = bench()
    panel.turn("mode", "jog")
    before = panel.panel.lamps()
    panel.press(key)
    assert panel.message == panel.says(
        f"{key} acts only together with the safety key C8", f"{key} 須與安全鍵 C8 同時按下"
    )
    assert panel.panel.lamps() == before
    panel.press("C8")
    panel.press(key)
    assert panel.message == ""
    panel.release("C8")
    panel.press(key)
    assert "C8" in panel.message


@pytest.mark.feature("har.panel_safety")
def test_the_spindle_is_stopped_without_the_safety_key(bench: Make) -> None:
    panel = bench()
    panel.turn("mode", "jog")
    panel.press("C8", "B3")
    panel.press("B2")
    assert panel.message == ""
    assert not panel.is_lit(*CW)


SWITCHED = {
    "D1": (COOLANT, "M8", "M9"),
    "D2": (AIR, "M50", "M9"),
    "D5": (FORWARD, "M68", "M69"),
}


@pytest.mark.parametrize(
    "key",
    [
        pytest.param("D1", marks=pytest.mark.feature("har.panel_coolant")),
        pytest.param("D2", marks=pytest.mark.feature("har.panel_air")),
        pytest.param("D5", marks=pytest.mark.feature("har.panel_chip")),
    ],
)
def test_a_key_switches_and_the_program_takes_over(key: str, bench: Make) -> None:
    lamp, on, off = SWITCHED[key]
    panel = bench(f"O1\n{on}\nM0\n{off}\nM0\nM30\n")
    panel.press(key)
    assert panel.is_lit(*lamp)
    panel.press(key)
    assert not panel.is_lit(*lamp)
    panel.start()
    assert panel.is_lit(*lamp) is (key != "D1"), "M00 stops the coolant until cycle start"
    panel.start()
    assert not panel.is_lit(*lamp)


@pytest.mark.feature("har.panel_chip")
def test_the_conveyor_runs_back_while_its_key_is_held_and_it_stands(bench: Make) -> None:
    panel = bench()
    panel.press("D6")
    assert panel.is_lit(*REVERSE)
    panel.release("D6")
    assert not panel.is_lit(*REVERSE)
    panel.press("D5")
    panel.press("D6")
    assert (panel.is_lit(*FORWARD), panel.is_lit(*REVERSE)) == (True, False)


@pytest.mark.feature("har.panel_mag")
def test_the_magazine_turns_by_a_pocket_for_a_press_in_jog_and_handle(bench: Make) -> None:
    panel = bench()
    pocket = panel.control.signals["MAGAZINE_POCKET"] or 1.0
    panel.press("C8", "D4")
    assert "jog" in panel.message
    for mode, key, step in (("jog", "D4", 1), ("jog", "D4", 2), ("handle", "D3", 1), ("handle", "D3", 0)):
        panel.turn("mode", mode)
        panel.press("C8", key)
        assert panel.message == ""
        assert panel.control.signals["MAGAZINE_POCKET"] == pocket + step
    assert panel.panel.description.keys["D3"].name[panel.lang] == panel.says(
        "Magazine counter-clockwise", "刀庫逆轉"
    )


@pytest.mark.feature("har.panel_nozzle")
def test_the_nozzle_moves_while_its_key_is_held(bench: Make) -> None:
    panel = bench()
    for key, name in (("D7", ("Nozzle up", "噴嘴上")), ("D8", ("Nozzle down", "噴嘴下"))):
        panel.press(key)
        assert panel.is_lit(*name)
        panel.release(key)
        assert not panel.is_lit(*name)


@pytest.mark.feature("har.panel_door")
def test_the_door_opens_in_manual_modes_and_behind_the_program_end(bench: Make) -> None:
    panel = bench("O1\nG4 P500\nM02\n")
    panel.press("D9")
    assert not panel.is_lit(*DOOR)
    for mode in ("zero", "rapid", "jog", "handle"):
        panel.turn("mode", mode)
        panel.press("D9")
        assert panel.is_lit(*DOOR)
        panel.press("D9")
        assert not panel.is_lit(*DOOR)
    panel.turn("mode", "memory")
    panel.start()
    panel.press("D9")
    assert panel.is_lit(*DOOR)


@pytest.mark.feature("har.panel_light")
def test_the_work_light_is_switched_in_every_mode(bench: Make) -> None:
    panel = bench("O1\nG4 P60000\nM30\n")
    for mode in panel.panel.description.modes:
        panel.turn("mode", mode)
        panel.press("D10")
        assert panel.is_lit("Work light", "工作燈")
        panel.press("D10")
        assert not panel.is_lit("Work light", "工作燈")
    panel.turn("mode", "memory")
    panel.press("START")
    panel.press("D10")
    assert panel.is_lit("Work light", "工作燈")


@pytest.mark.feature("har.panel_buzzer")
def test_the_buzzer_is_silenced_and_the_alarm_reset_once_its_cause_is_gone(bench: Make) -> None:
    panel = bench()
    panel.control.signals["AIR_LOW"] = 1.0
    assert panel.sounds()
    assert panel.is_lit("Buzzer off", "蜂鳴器解除")
    assert panel.is_lit("External reset", "外部解除")
    panel.press("D11")
    assert not panel.sounds()
    (alarm,) = panel.control.alarms
    assert alarm.code in page(panel, "alarms")
    assert panel.control.catalogue.text(alarm.code, panel.lang) in panel.text
    panel.press("D12")
    panel.control.run()
    assert alarm.code in panel.text, "its cause is still there"
    panel.control.signals["AIR_LOW"] = 0.0
    panel.press("D12")
    panel.control.run()
    assert alarm.code not in panel.window("alarms").text
    assert not panel.is_lit("External reset", "外部解除")


@pytest.mark.feature("har.panel_release")
def test_an_overtravel_is_left_with_the_release_key_in_jog_or_handle(bench: Make) -> None:
    panel = bench(setup={"start": {"X": -100.0}})
    panel.control.signals["OVERTRAVEL"] = 1.0
    assert panel.is_lit("Overtravel", "過行程")
    assert panel.view.alarm
    panel.press("A8")
    assert panel.message == panel.says(
        "A8 acts only in mode jog, handle", "A8 僅在 jog, handle 模式有效"
    ) or ("jog" in panel.message)
    for mode in ("handle", "jog"):
        panel.turn("mode", mode)
        panel.press("X-")
        assert panel.message, "the axis cannot move"
        panel.press("A8")
        panel.press("D12")
        assert panel.alarms() == []
        panel.release("A8")
        assert panel.alarms(), "it comes back without the key"
    panel.press("A8")
    panel.press("D12")
    panel.press("X-")
    panel.passes(0.5)
    panel.control.signals["OVERTRAVEL"] = 0.0
    panel.release("X-")
    panel.release("A8")
    panel.control.run()
    assert panel.control.positions.machine["X"] < -101.0
    assert not panel.is_lit("Overtravel", "過行程")


@pytest.mark.feature("har.panel_unclamp")
def test_the_button_at_the_head_releases_the_tool_while_it_is_pressed(bench: Make) -> None:
    panel = bench()
    name = ("Tool unclamped", "主軸鬆刀")
    panel.press("UNCLAMP")
    assert "jog" in panel.message
    panel.turn("mode", "jog")
    panel.press("UNCLAMP")
    assert panel.is_lit(*name)
    panel.press("C8", "B3")
    (alarm,) = panel.control.alarms
    assert alarm.code in panel.message
    assert panel.control.catalogue.text(alarm.code, panel.lang) in panel.message
    panel.release("UNCLAMP")
    assert not panel.is_lit(*name)
    panel.press("RESET")
    panel.press("C8", "B3")
    assert panel.is_lit(*CW)
    panel.press("UNCLAMP")
    assert bool(panel.message) is (panel.control.control.id == "fanuc-m"), "1104; MELDAS has no number for it"
    assert not panel.is_lit(*name)


LAMPS = {
    ("Air pressure low", "風壓不足"): "AIR_LOW",
    ("Motor overload", "馬達過載"): "COOLANT_OVERLOAD",
    ("Way lubrication low", "軌道油不足"): "LUBE_EMPTY",
    ("Overtravel", "過行程"): "OVERTRAVEL",
}


@pytest.mark.feature("har.panel_lamps")
@pytest.mark.parametrize("names", LAMPS)
def test_a_fault_of_the_machine_has_its_lamp(names: tuple[str, str], bench: Make) -> None:
    panel = bench()
    assert panel.light(*names) is Light.OFF
    panel.control.signals[LAMPS[names]] = 1.0
    assert panel.light(*names) is Light.ON
    assert panel.light(*NC_ALARM) is Light.ON
    panel.control.signals[LAMPS[names]] = 0.0
    assert panel.light(*names) is Light.OFF
    panel.press("D12")
    panel.control.run()
    assert panel.light(*NC_ALARM) is Light.OFF


@pytest.mark.feature("har.panel_lamps")
def test_a_tool_change_that_cannot_be_done_lights_its_lamp(bench: Make) -> None:
    panel = bench("O1\nT1\nG0 Z-5.\nM6\nM30\n")
    panel.start()
    assert panel.is_lit("Tool changer alarm", "自動換刀警示")
    assert panel.is_lit(*NC_ALARM)


@pytest.mark.feature("har.panel_lamps")
@pytest.mark.parametrize(("word", "light"), [("M00", Light.BLINKING), ("M01", Light.ON)])
def test_the_lamp_of_stops_blinks_at_m00_and_is_steady_at_m01(word: str, light: Light, bench: Make) -> None:
    panel = bench(f"O1\nG0 X1.\n{word}\nM30\n")
    panel.press("C8", "C2")
    panel.start()
    assert panel.light("Stop M00, M01", "停止 M00、M01") is light
    panel.start()
    assert panel.light("Stop M00, M01", "停止 M00、M01") is Light.OFF


@pytest.mark.feature("har.panel_lamps", "har.panel_cycle_end")
@pytest.mark.parametrize(("word", "light"), [("M02", Light.BLINKING), ("M30", Light.ON)])
def test_the_lamps_of_the_program_end(word: str, light: Light, bench: Make) -> None:
    panel = bench(f"O1\nG0 X1.\n{word}\n")
    assert panel.light("Cycle end", "循環結束") is Light.OFF
    panel.start()
    assert panel.light("Program end M02, M30", "程式結束 M02、M30") is light
    assert panel.light("Cycle end", "循環結束") is Light.ON
    panel.press("RESET")
    panel.press("START")
    assert panel.light("Program end M02, M30", "程式結束 M02、M30") is Light.OFF
    assert panel.light("Cycle end", "循環結束") is Light.OFF


@pytest.mark.feature("har.panel_tool")
def test_the_tool_display_has_the_waiting_tool_at_the_left(bench: Make) -> None:
    panel = bench("O1\nT4 M6\nT9\nM0\nM6\nM0\nM30\n")
    panel.start()
    assert panel.panel.tool_text(panel.lang) == panel.says(
        "waiting T 9 | spindle T 4", "待刀 T 9 | 主軸刀 T 4"
    )
    panel.start()
    assert panel.panel.tool_display[1] == 9
