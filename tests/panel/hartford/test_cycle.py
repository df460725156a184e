"""What changes a run, and protection (Hartford 5.2.4.8, 5.2.4.10, 5.2.4.11, 5.2.4.13)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.mainrun import State
from polycnc.panel import Light

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from tests.panel.bench import Bench

    Make = Callable[..., Bench]

START = ("Cycle start (SW4)", "循環啟動 (SW4)")
SINGLE = ("Single block", "單節執行")


@pytest.mark.feature("har.panel_single")
def test_single_block_makes_one_block_with_every_start(bench: Make) -> None:
    panel = bench("O1\nG0 X1.\nG0 X2.\nG0 X3.\nM30\n")
    panel.press("C8", "C1")
    assert panel.is_lit(*SINGLE)
    for x in ("1.000", "2.000"):
        assert panel.start() is State.STOPPED
        assert x in panel.window("positions").text
    panel.press("C8", "C1")
    assert not panel.is_lit(*SINGLE)
    assert panel.start() is State.READY


RESTART = "O1\nG0 X10. Y-3.\nN7 G1 X-50. F6000\nM30\n"


def open_restart(panel: Bench) -> None:
    """The restart page, and the search for N7 from the page of the program."""
    if panel.control.control.id == "fanuc-m":
        panel.keys("PROG")
        panel.soft("(OPRT)", "(操作)")
        panel.typed("N7")
        panel.soft("N SRH", "N 檢索")
        panel.keys("PROG")
        panel.soft("RSTR", "再開始")
    else:
        panel.keys("MONITOR")
        panel.soft("MENU", "選單")
        panel.typed("N7")
        panel.soft("SEARCH", "檢索")
        panel.soft("RESTART", "再開始")


@pytest.mark.feature("har.panel_restart")
def test_restart_leads_back_by_hand_and_the_page_marks_the_axes(bench: Make) -> None:
    panel = bench(RESTART)
    panel.press("C6")
    assert "C8" in panel.message
    panel.press("C8", "C6")
    assert panel.is_lit("Program restart", "程式再啟動")
    open_restart(panel)
    assert panel.message == ""
    assert panel.view.title == panel.says("PROGRAM RESTART", "程式再開始")
    head, *rows = panel.window("restart").text.splitlines()
    assert head == panel.says("RESTART POSITION (G54) [REMAINING DISTANCE]", "再啟動位置 (G54) [剩餘距離]")
    assert rows == ["X 10.000 X 10.000", "Y -3.000 Y -3.000", "Z 0.000RP Z 0.000"]
    panel.press("START")
    assert panel.message == panel.says(
        "bring the axes to the restart position and switch program restart off first",
        "請先將各軸移至再啟動位置，並關閉程式再啟動",
    )
    panel.turn("mode", "handle")
    panel.turn("handle_step", "x100")
    for axis, notches in (("X", 100), ("Y", -30)):
        panel.turn("handle_axis", axis)
        panel.wheel(notches)
        panel.control.run()
    assert panel.window("restart").text.splitlines()[1:] == [
        *("X 10.000RP X 0.000", "Y -3.000RP Y 0.000", "Z 0.000RP Z 0.000")
    ]
    panel.turn("mode", "memory")
    panel.press("C8", "C6")
    assert panel.start() is State.READY
    assert panel.control.positions.work["X"] == -50.0


@pytest.mark.feature("har.panel_restart")
def test_a_setting_leads_the_axes_back_by_themselves_as_slowly_as_a_dry_run(bench: Make) -> None:
    panel = bench(RESTART)
    panel.press("C8", "C6")
    open_restart(panel)
    panel.press("C8", "C6")
    panel.press("START")
    assert panel.message == panel.says(
        "the axes are not at the restart position yet", "各軸尚未到達再啟動位置"
    )
    panel.control.signals["RESTART_AUTOMATIC"] = 1.0
    panel.press("START")
    panel.passes(0.3)
    assert panel.control.feed == pytest.approx(1000.0)
    assert panel.control.run() is State.READY


@pytest.mark.feature("har.panel_apo")
@pytest.mark.parametrize("end", ["M02", "M30"])
def test_the_power_goes_off_ten_seconds_behind_the_program_end(end: str, bench: Make) -> None:
    panel = bench(f"O1\nG0 X1.\n{end}\n")
    panel.press("C8", "C7")
    assert panel.is_lit("Auto power off", "自動關機")
    panel.passes(30.0)
    assert panel.state() is State.READY, "only behind a program end"
    panel.start()
    panel.passes(9.8)
    assert panel.state() is State.READY
    panel.passes(0.4)
    assert panel.state() is State.OFF
    assert panel.light("Auto power off", "自動關機") is Light.OFF
    assert panel.view.status[1].text == ""


@pytest.mark.feature("har.panel_softsw")
def test_the_soft_keys_of_the_builder_light_their_lamps(bench: Make) -> None:
    panel = bench("O1\nM8\nG90 G0 X5. Z-7.\nM0\nM30\n")
    if panel.control.control.id == "fanuc-m":
        panel.keys("OFS/SET")
        panel.soft("OPR", "操作盤")
        assert panel.view.title == panel.says("SOFTWARE OPERATOR'S PANEL", "軟體操作面板")
    else:
        panel.keys("MONITOR")
        panel.soft("MENU", "選單")
        panel.soft("SWITCH", "開關")
        assert panel.view.title == panel.says("SOFT SWITCHES", "軟體開關")
    assert panel.window("soft-switches").text.splitlines() == [
        *("Z-LOCK OFF", "MST LOCK OFF", "ABSOLUTE ON", "F=100% OFF")
    ]
    lamps = {
        "Z-LOCK": ("Z axis ignored", "Z 軸忽略"),
        "MST LOCK": ("M, S, T ignored", "M.S.T 忽略"),
        "ABSOLUTE": ("Manual absolute", "手動絕對值"),
        "F=100%": ("Feed held at 100 %", "進給固定 100%"),
    }
    for key, names in lamps.items():
        before = panel.is_lit(*names)
        panel.soft(key, key)
        assert panel.is_lit(*names) is not before
        active = [soft.text for soft in panel.view.soft_keys if soft.active]
        assert (key in active) is not before
        panel.soft(key, key)
        assert panel.is_lit(*names) is before
    panel.soft("Z-LOCK", "Z-LOCK")
    panel.soft("MST LOCK", "MST LOCK")
    panel.start()
    assert panel.control.positions.real["X"] == 5.0
    assert panel.control.positions.real["Z"] == 0.0
    assert not panel.is_lit("Coolant pump", "切削液泵")


@pytest.mark.feature("har.panel_softsw")
def test_f_100_holds_the_feed_whatever_its_switch_says(bench: Make) -> None:
    panel = bench("O1\nG90 G1 X-300. F1200\nM30\n")
    panel.turn("feed", "50")
    panel.press("START")
    panel.passes(1.0)
    assert panel.control.feed == pytest.approx(600.0)
    panel.press("F100")
    panel.passes(0.5)
    assert panel.is_lit("Feed held at 100 %", "進給固定 100%")
    assert panel.control.feed == pytest.approx(1200.0)


@pytest.mark.feature("har.panel_editkey")
def test_the_key_switch_locks_programs_and_tool_offsets(bench: Make, tmp_path: Path) -> None:
    (tmp_path / "A.NC").write_text("%\nO9\nM30\n%\n")
    panel = bench("O1\nG0 X1.\nM30\n", card=tmp_path)
    fanuc = panel.control.control.id == "fanuc-m"
    name = panel.panel.description.switches["edit_protect"].name[panel.lang]
    assert name == panel.says("Edit protection (SW1)", "編輯保護 (SW1)")
    panel.turn("edit_protect", "on")
    refused = panel.says("edit protection is on", "編輯保護已開啟")
    panel.keys("OFS/SET" if fanuc else "TOOL/PARAM")
    panel.typed("7.5", "INPUT")
    assert panel.message == refused
    assert "7.500" not in panel.text
    panel.turn("edit_protect", "off")
    panel.keys("INPUT")
    assert panel.message == ""
    assert "7.500" in panel.text
    panel.turn("edit_protect", "on")
    panel.keys("PROG" if fanuc else "EDIT/MDI")
    panel.typed("O0001", "DELETE")
    assert panel.message == refused
    if fanuc:
        panel.turn("mode", "edit")
        panel.soft("(OPRT)", "(操作)")
    else:
        panel.keys("DIAGN/IN-OUT")
        panel.soft("IN/OUT", "輸出入")
    panel.screen.buffer = ""
    panel.soft(*(("READ", "讀入") if fanuc else ("INPUT", "輸入")))
    panel.typed("A.NC")
    panel.soft("EXEC", "執行")
    panel.passes(1.0)
    assert panel.message == refused
    assert [each.name for each in panel.control.programs] == ["O0001"]
    panel.turn("mode", "memory")
    assert panel.start() is State.READY, "running is free"


@pytest.mark.feature("har.panel_start")
def test_the_lamp_of_cycle_start_goes_out_with_stop_reset_and_mode(bench: Make) -> None:
    panel = bench("O1\nG1 X-300. F1200\nM30\n")
    assert panel.light(*START) is Light.OFF
    panel.press("START")
    assert panel.light(*START) is Light.ON
    panel.passes(1.0)
    panel.press("HOLD")
    panel.control.run()
    assert panel.light(*START) is Light.OFF
    assert panel.is_lit("Feed hold (SW3)", "進給暫停 (SW3)")
    panel.press("START")
    assert panel.is_lit(*START)
    panel.turn("mode", "jog")
    panel.control.run()
    assert not panel.is_lit(*START)
    panel.press("X+")
    panel.passes(0.3)
    panel.release("X+")
    panel.control.run()
    panel.turn("mode", "memory")
    panel.press("START")
    assert panel.is_lit(*START)
    panel.passes(0.5)
    panel.press("RESET")
    panel.control.run()
    assert not panel.is_lit(*START)
    assert panel.state() is State.READY
    panel.turn("mode", "jog")
    panel.press("START")
    assert panel.message
