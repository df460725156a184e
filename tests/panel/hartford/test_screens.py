"""Displays, messages and maintenance (Hartford 5.1, list of operation messages, maintenance schedule)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.support import HARTFORD_MILL4

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from tests.panel.bench import Bench

    Make = Callable[..., Bench]


@pytest.mark.parametrize("control", ["fanuc-m"])
@pytest.mark.feature("har.panel_mdikeys")
@pytest.mark.parametrize(
    ("unit", "name", "soft_keys"),
    [
        ("lcd-8.4", ("8.4 inch LCD with MDI keys", "8.4 吋 LCD／MDI 鍵盤"), 5),
        ("lcd-10.4", ("10.4 inch LCD with standard MDI keys", "10.4 吋 LCD／標準 MDI 鍵盤"), 10),
    ],
)
def test_both_fanuc_displays_lead_to_every_chapter(
    unit: str, name: tuple[str, str], soft_keys: int, bench: Make
) -> None:
    panel = bench()
    panel.unit = unit
    (row,) = (each for each in panel.panel.description.mdi_units if each.id == unit)
    assert row.name[panel.lang] == panel.says(*name)
    titles = {
        "POS": ("ACTUAL POSITION (ABSOLUTE)", "現在位置（絕對座標）"),
        "PROG": ("PROGRAM", "程式"),
        "OFS/SET": ("OFFSET", "刀具補正"),
        "SYSTEM": ("PARAMETER", "參數"),
        "MESSAGE": ("ALARM MESSAGE", "警示訊息"),
        "CSTM/GR": ("PATH GRAPHIC", "路徑圖形"),
    }
    for key, title in titles.items():
        assert key in row.keys
        panel.keys(key)
        assert panel.view.title == panel.says(*title)
        assert len(panel.view.soft_keys) == soft_keys
    panel.keys("OFS/SET")
    panel.typed("12.5")
    panel.keys("CAN", "7", "INPUT")
    assert "12.700" in panel.text
    panel.keys("RIGHT", "DOWN", "PAGE_DOWN", "PAGE_UP", "UP", "LEFT", "RESET")
    assert panel.message == ""
    panel.keys("O", "SHIFT", "O", "SHIFT", "EOB", "SHIFT", "2", "EOB", "SHIFT", "-", "-")
    assert panel.view.buffer == "OPE#;+-"


@pytest.mark.parametrize("control", ["fanuc-m"])
@pytest.mark.feature("har.panel_mdikeys")
def test_help_tells_why_an_alarm_has_come_and_what_to_do(bench: Make) -> None:
    panel = bench()
    panel.control.signals["OVERTRAVEL"] = 1.0
    panel.keys("HELP")
    assert panel.view.title == panel.says("HELP (ALARM DETAIL)", "說明（警示內容）")
    assert panel.says("A hardware stroke limit switch has been reached", "碰到硬體行程極限開關") in panel.text
    assert panel.says("An axis ran onto the dog", "軸碰到行程極限擋塊") in panel.text
    assert panel.says("→ Hold the stroke release key", "→ 按住行程解除鍵") in panel.text


@pytest.mark.parametrize("control", ["meldas-m"])
@pytest.mark.feature("har.panel_mdikeys")
def test_the_full_keyboard_of_meldas_leads_to_every_chapter(bench: Make) -> None:
    panel = bench()
    (unit,) = panel.panel.description.mdi_units
    assert unit.name[panel.lang] == panel.says("Full keyboard of the ABC type", "全鍵式鍵盤（ABC 型式）")
    titles = {
        "MONITOR": ("POSITION", "位置"),
        "TOOL/PARAM": ("TOOL OFFSET", "刀具補正"),
        "EDIT/MDI": ("PROGRAM", "程式"),
        "DIAGN/IN-OUT": ("ALARM MESSAGE", "警示訊息"),
        "SFG": ("GRAPHIC TRACE", "路徑描繪"),
        "F0": ("SOFT SWITCHES", "軟體開關"),
    }
    for key, title in titles.items():
        assert key in unit.keys
        panel.keys(key)
        assert panel.view.title == panel.says(*title)
        assert len(panel.view.soft_keys) == 5
    panel.keys("TOOL/PARAM", "7", "5", ".", "DELETE/INS", "2", "INPUT/CALC")
    assert "752.000" in panel.text
    panel.typed("1+10*2-9/3", "SHIFT", "INPUT/CALC", "INPUT/CALC")
    assert "18.000" in panel.text
    panel.typed("1/0", "SHIFT", "INPUT/CALC")
    assert "1/0" in panel.message
    panel.keys("C.B/CAN")
    assert panel.view.buffer == ""
    panel.turn("mode", "mdi")
    panel.keys("EDIT/MDI")
    panel.soft("MDI", "MDI")
    panel.typed("M8", "SHIFT", "DELETE/INS")
    assert panel.window("mdi").text == "M8"
    panel.keys("DELETE/INS")
    assert panel.window("mdi").text == ""
    for key in unit.keys:
        panel.keys(*(("SHIFT", "SHIFT") if key == "SHIFT" else ("1", key) if key == "INPUT/CALC" else (key,)))
        assert panel.message == "" or key == "INPUT/CALC"
    letters = " ".join(panel.screen.family.letters).split()
    assert {*"ABCDFGHIJKLMNOPQRSTUVWXYZ", *"0123456789"} <= set(letters)


@pytest.mark.feature("har.panel_mdikeys")
def test_the_display_that_was_chosen_lasts(bench: Make, tmp_path: Path) -> None:
    panel = bench(retained=tmp_path / "memory.db")
    unit = panel.panel.description.mdi_units[0]
    panel.unit = unit.id
    panel.turn("feed", "90")
    panel.control.reset()
    panel.control.close()
    again = bench(retained=tmp_path / "memory.db")
    assert len(again.view.soft_keys) == unit.soft_keys
    again.control.close()


#: What is on while each message of the list stands there: sensors, keep relays, states of the machine.
LASTING = {
    "1000": ("POCKET_DOWN",),
    "1001": ("MAINTENANCE",),
    "1002": ("ARM_OUT",),
    "1005": ("PALLET_DOOR_OPEN",),
    "1008": ("TOOL_LIFE_OVER",),
    "1010": ("CHANGE_UNFINISHED",),
    "1011": ("MAGAZINE_RIGHT", "SPINDLE_FAULT"),
    "1012": ("TOOL_UNCLAMPED", "SPINDLE_FAULT"),
    "1014": ("PLC_SWITCH_32",),
    "1015": ("MAGAZINE_MANUAL",),
    "1016": ("PLC_SWITCH_1_6",),
    "1017": ("Y_IN_CHANGE_ZONE",),
    "1018": ("WORK_SET_IGNORED",),
    "1019": ("CHANGER_SETTING_WRONG",),
    "1020": ("PALLET_SETTING_WRONG",),
    "1021": ("TOOL_TABLE_WRONG",),
    "1023": ("CTS_FILTER_DIRTY",),
}
#: Messages with which the machine refuses something: what is on, and what is refused then.
REFUSING = {"1006": ("NOT_REFERENCED_X", "START"), "1022": ("NOZZLE_NOT_ZEROED", "D7")}
#: A machine whose axes have ends: X can stand beyond its reference point.
WITH_ENDS = 'base = "hartford"\n[axis.X]\nlimit_minus = -600\nlimit_plus = 20\n'


def on_alarm_page(panel: Bench, code: str) -> bool:
    """Whether a message stands there, with its text."""
    return f"{code} {panel.control.catalogue.text(code, panel.lang)}" in panel.text


@pytest.mark.parametrize("control", ["meldas-m"])
@pytest.mark.feature("har.message_list_meldas")
@pytest.mark.parametrize("code", LASTING)
def test_a_message_stands_on_the_alarm_page_while_its_cause_lasts(code: str, bench: Make) -> None:
    panel = bench()
    panel.keys("DIAGN/IN-OUT")
    assert code not in panel.text
    for signal in LASTING[code]:
        panel.control.signals[signal] = 1.0
    assert on_alarm_page(panel, code)
    panel.control.signals[LASTING[code][0]] = 0.0
    assert not on_alarm_page(panel, code)


@pytest.mark.parametrize("control", ["meldas-m"])
@pytest.mark.feature("har.message_list_meldas")
@pytest.mark.parametrize("code", REFUSING)
def test_a_message_says_what_the_machine_refuses(code: str, bench: Make) -> None:
    panel = bench("O1\nG0 X1.\nM30\n")
    signal, key = REFUSING[code]
    panel.control.signals[signal] = 1.0
    panel.press(key)
    assert f"{code} {panel.control.catalogue.text(code, panel.lang)}" in panel.message
    panel.keys("DIAGN/IN-OUT")
    assert on_alarm_page(panel, code)


@pytest.mark.parametrize("control", ["meldas-m"])
@pytest.mark.feature("har.message_list_meldas")
def test_no_zero_return_from_beyond_the_reference_point(bench: Make, tmp_path: Path) -> None:
    machine = tmp_path / "ends.toml"
    machine.write_text(WITH_ENDS)
    panel = bench(machine=machine, setup={"start": {"X": 5.0}})
    panel.turn("mode", "zero")
    panel.press("X+")
    assert f"1003 {panel.control.catalogue.text('1003', panel.lang)}" in panel.message
    panel.press("Y+")
    assert panel.message == ""


@pytest.mark.parametrize("control", ["meldas-m"])
@pytest.mark.feature("har.message_list_meldas")
def test_the_arm_out_at_feed_hold_wants_cycle_start(bench: Make) -> None:
    panel = bench("O1\nG1 X300. F1000\nM30\n")
    panel.press("START")
    panel.passes(0.5)
    panel.press("HOLD")
    panel.control.run()
    panel.control.signals["ARM_OUT"] = 1.0
    panel.keys("DIAGN/IN-OUT")
    assert on_alarm_page(panel, "1009")


@pytest.mark.parametrize("control", ["meldas-m"])
@pytest.mark.feature("har.message_list_meldas")
@pytest.mark.parametrize(("code", "word"), [("1004", "M60"), ("1013", "M28"), ("1007", "M24")])
def test_a_message_comes_with_its_m_code(code: str, word: str, bench: Make) -> None:
    panel = bench(f"O1\nG0 X1.\n{word}\nG4 P60000\nM30\n", machine=HARTFORD_MILL4)
    panel.keys("DIAGN/IN-OUT")
    panel.press("START")
    panel.passes(5.0)
    assert on_alarm_page(panel, code)


def open_maintenance(panel: Bench) -> None:
    if panel.control.control.id == "fanuc-m":
        panel.keys("MESSAGE")
    else:
        panel.keys("DIAGN/IN-OUT")
        panel.soft("MENU", "選單")
    panel.soft("MAINTE", "保養")


@pytest.mark.feature("har.maint")
def test_the_maintenance_schedule_has_a_period_and_a_work_for_every_task(bench: Make) -> None:
    panel = bench()
    open_maintenance(panel)
    assert panel.view.title == panel.says("MAINTENANCE SCHEDULE", "定期保養計劃")
    rows = panel.window("maintenance").text.splitlines()
    panel.keys("PAGE_DOWN")
    *more, legend = panel.window("maintenance").text.splitlines()
    assert panel.says("1 Spindle taper daily D", "1 主軸錐孔 每日 D") in rows[0]
    assert panel.says("daily E, 3 months A", "每日 E, 三個月 A") in rows[10]
    assert panel.says("3 Spindle belt 6 months B", "3 主軸皮帶 六個月 B") in rows[2]
    assert (
        panel.says(
            "19 Chains of the Z counterweight monthly E, 6 months A", "19 Z 軸配重鍊條 每月 E, 六個月 A"
        )
        in more[4]
    )
    assert panel.says("28 Battery of the control 2 years C", "28 控制器電池 二年 C") in more[-2]
    assert panel.says("D: clean", "D: 清潔") in legend
    numbers = [int(row.split()[0]) for row in (*rows[:-1], *more)]
    assert numbers == [number for number in range(1, 30) if number != 23], "the manual has no NO. 23"


@pytest.mark.feature("har.maint")
def test_a_task_that_is_done_counts_its_running_hours_anew(bench: Make) -> None:
    panel = bench("O1\nG4 P60000\nM30\n")
    panel.start()
    open_maintenance(panel)
    assert panel.window("maintenance").text.splitlines()[1].endswith("0H 1M 0S")
    panel.keys("DOWN")
    panel.soft("DONE", "完成")
    panel.press("RESET")
    panel.start()
    panel.start()
    rows = panel.window("maintenance").text.splitlines()
    assert rows[1].endswith("0H 2M 0S")
    assert rows[0].endswith("0H 3M 0S")
