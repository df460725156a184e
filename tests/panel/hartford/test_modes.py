"""The positions of the mode switch (Hartford 5.2.4.1 to 5.2.4.6)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.mainrun import State
from polycnc.panel import Light
from tests.panel.bench import Bench

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    Make = Callable[..., Bench]

#: Below the reference point on every axis, with more than 100 mm to the dog.
AWAY = {"start": {"X": -300.0, "Y": -200.0, "Z": -150.0}}
LONG = "O1\nG90 G1 X400. F2000\nM30\n"


@pytest.mark.feature("har.panel_power")
def test_power_goes_off_when_its_button_is_held_for_three_seconds(bench: Make) -> None:
    panel = bench(LONG)
    panel.press("D10")
    panel.press("POWER_OFF")
    panel.passes(2.8)
    panel.release("POWER_OFF")
    panel.passes(2.0)
    assert panel.is_lit("Work light", "工作燈")
    panel.press("POWER_OFF")
    panel.passes(3.1)
    panel.release("POWER_OFF")
    assert panel.state() is State.OFF
    assert set(panel.panel.lamps().values()) == {Light.OFF}
    panel.press("START")
    assert panel.says("power is off", "電源已關閉") in panel.message
    panel.press("POWER_ON")
    panel.control.run()
    assert panel.state() is State.READY
    assert panel.control.program, "programs outlive the power"
    assert panel.message == ""


@pytest.mark.feature("har.panel_power")
def test_power_stays_while_a_program_runs(bench: Make) -> None:
    panel = bench(LONG)
    panel.press("START")
    panel.press("POWER_OFF")
    panel.passes(4.0)
    assert panel.state() is State.RUNNING
    assert panel.is_lit("Cycle start (SW4)", "循環啟動 (SW4)")


POSITIONS = {
    "fanuc-m": [
        *("Zero return|原點復歸|REF", "Rapid|快速進給|JOG", "Jog|寸動|JOG", "Handle|手輪|HND"),
        *("MDI|MDI|MDI", "Memory|記憶|MEM", "DNC|DNC|RMT", "Edit|編輯|EDIT"),
    ],
    "meldas-m": [
        *("Zero return|原點復歸|ZRN", "Rapid|快速進給|JOG", "Jog|寸動|JOG", "Handle|手輪|HANDLE"),
        *("MDI|MDI|MDI", "Memory|記憶|MEMORY", "Tape|紙帶|TAPE"),
    ],
}


@pytest.mark.feature("har.panel_modes")
def test_the_mode_switch_has_its_positions_and_the_screen_shows_them(control: str, bench: Make) -> None:
    panel = bench()
    shown = []
    for mode in panel.panel.description.modes.values():
        panel.turn("mode", mode.id)
        assert panel.message == ""
        shown.append((mode.name[panel.lang], panel.view.status[0].text))
    wanted = [row.split("|") for row in POSITIONS[control]]
    assert shown == [(panel.says(english, chinese), status) for english, chinese, status in wanted]


@pytest.mark.feature("har.panel_modes")
def test_another_mode_holds_the_program_and_the_way_back_goes_on(bench: Make) -> None:
    panel = bench(LONG)
    panel.press("START")
    panel.passes(2.0)
    panel.turn("mode", "handle")
    panel.control.run()
    held = panel.control.positions.work["X"]
    assert panel.state() is State.HOLD
    assert not panel.is_lit("Cycle start (SW4)", "循環啟動 (SW4)")
    panel.press("START")
    assert panel.message
    panel.turn("mode", "memory")
    assert panel.start() is State.READY
    assert 0.0 < held < 400.0
    assert "400.000" in panel.text


@pytest.mark.feature("har.panel_zero", "har.panel_ref_lamps")
def test_every_axis_returns_in_plus_at_rapid_and_lights_its_lamp(bench: Make) -> None:
    panel = bench(setup=AWAY)
    panel.press("X+")
    assert panel.message, "in memory mode axis keys do nothing"
    panel.turn("mode", "zero")
    panel.press("Y-")
    assert "zero (+)" in panel.message
    lamps = {
        "X": ("Axis 1 at its reference point", "第 1 軸原點"),
        "Y": ("Axis 2 at its reference point", "第 2 軸原點"),
        "Z": ("Axis 3 at its reference point", "第 3 軸原點"),
    }
    for axis, names in lamps.items():
        assert panel.light(*names) is Light.OFF
        panel.press(f"{axis}+")
        panel.passes(0.4)
        assert panel.control.feed > 5000.0, "at rapid"
        panel.control.run()
        assert panel.light(*names) is Light.ON
        assert panel.control.positions.machine[axis] == 0.0
    assert panel.text.count("0.000") >= 3


@pytest.mark.feature("har.panel_ref_lamps")
def test_a_lamp_goes_out_with_its_axis(bench: Make) -> None:
    panel = bench()
    assert panel.is_lit("Axis 1 at its reference point", "第 1 軸原點")
    panel.turn("mode", "handle")
    panel.turn("handle_step", "x100")
    panel.wheel(-1)
    panel.control.run()
    assert not panel.is_lit("Axis 1 at its reference point", "第 1 軸原點")
    assert panel.is_lit("Axis 2 at its reference point", "第 2 軸原點")


@pytest.mark.feature("har.panel_rapid")
def test_rapid_by_hand_follows_its_switch_from_f0_to_100_percent(bench: Make) -> None:
    panel = bench()
    switch = panel.panel.description.switches["rapid"]
    assert switch.positions == ("F0", *(str(10 * step) for step in range(1, 11)))
    assert switch.name[panel.lang] == panel.says("Rapid override (SW8)", "快速進給倍率 (SW8)")
    panel.turn("mode", "rapid")
    fastest = 60.0 * panel.control.channel.axis_data[0].rapid
    for position, speed in (("100", fastest), ("30", 0.3 * fastest), ("F0", 400.0)):
        panel.turn("rapid", position)
        panel.press("X-")
        panel.passes(1.5)
        assert panel.control.feed == pytest.approx(speed, rel=1e-6)
        panel.release("X-")
        panel.control.run()
    assert panel.control.feed == 0.0
    panel.turn("rapid", "55")
    assert "55" in panel.message


@pytest.mark.feature("har.panel_jog")
def test_jog_runs_at_ten_millimetres_a_minute_for_every_percent(bench: Make) -> None:
    panel = bench()
    name = panel.panel.description.switches["feed"].name[panel.lang]
    assert name == panel.says("Feed and jog override (SW6)", "進給與寸動倍率 (SW6)")
    panel.turn("mode", "jog")
    panel.press("X-")
    for percent in range(0, 210, 10):
        panel.turn("feed", str(percent))
        panel.passes(0.4)
        assert panel.control.feed == pytest.approx(10.0 * percent, abs=1e-6)
    panel.release("X-")
    panel.control.run()
    stood = panel.control.positions.machine["X"]
    assert stood < 0.0
    panel.press("X+")
    panel.passes(0.5)
    panel.release("X+")
    panel.control.run()
    assert panel.control.positions.machine["X"] > stood


@pytest.mark.feature("har.panel_handle")
def test_a_notch_of_the_handwheel_is_a_step_of_its_switch(bench: Make) -> None:
    panel = bench(setup=AWAY)
    panel.wheel(1)
    assert "handle" in panel.message
    panel.turn("mode", "handle")
    at = -200.0
    panel.turn("handle_axis", "Y")
    for step, size in (("x1", 0.001), ("x10", 0.01), ("x100", 0.1)):
        panel.turn("handle_step", step)
        for notches in (7, -3):  # clockwise is plus
            panel.wheel(notches)
            panel.control.run()
            at += notches * size
            assert panel.control.positions.machine["Y"] == pytest.approx(at, abs=1e-9)
    assert f"{at:.3f}" in panel.text
    assert panel.control.positions.machine["X"] == -300.0


@pytest.mark.feature("har.panel_mdi")
def test_what_is_typed_in_at_mdi_runs_with_cycle_start(control: str, bench: Make) -> None:
    panel = bench()
    panel.turn("mode", "mdi")
    if control == "fanuc-m":
        panel.keys("PROG")
        panel.soft("MDI", "MDI")
    else:
        panel.keys("EDIT/MDI")
        panel.soft("MDI", "MDI")
    panel.typed("G90 G1 X-12.5 F2000", "EOB", "INSERT")
    panel.typed("M8", "EOB", "INPUT")
    assert panel.window("mdi").text == "G90 G1 X-12.5 F2000\nM8"
    assert panel.view.title == panel.says(
        *(("PROGRAM (MDI)", "程式（MDI）") if control == "fanuc-m" else ("MDI", "MDI"))
    )
    assert panel.start() is State.READY
    assert panel.control.positions.work["X"] == pytest.approx(-12.5)
    assert panel.is_lit("Coolant pump", "切削液泵")


@pytest.mark.feature("har.panel_memory")
def test_memory_mode_runs_the_program_that_is_stored_and_shows_its_block(bench: Make) -> None:
    panel = bench("O12\nG0 X7.\nM0\nG0 X9.\nM30\n")
    panel.turn("mode", "memory")
    panel.press("START")
    assert panel.light("Cycle start (SW4)", "循環啟動 (SW4)") is Light.ON
    panel.control.run()
    assert panel.state() is State.STOPPED
    panel.keys("PROG" if panel.control.control.id == "fanuc-m" else "EDIT/MDI")
    active = [cell.text for row in panel.window("program").rows for cell in row if cell.style == "active"]
    assert active == ["M0"]
    assert panel.view.title == panel.says("PROGRAM", "程式")
    assert panel.start() is State.READY
    assert panel.control.positions.work["X"] == 9.0


@pytest.mark.parametrize("control", ["fanuc-m"])
@pytest.mark.feature("har.panel_dnc")
def test_dnc_runs_a_file_of_the_memory_card(bench: Make, tmp_path: Path) -> None:
    (tmp_path / "A.NC").write_text("%\nO7\nG0 X3.\nM30\n%\n")
    (tmp_path / "LONG.NC").write_text("%\nO8\nG0 Y-4.\nM30\n%\n")
    panel = bench("O1\nG0 X99.\nM30\n", card=tmp_path)
    panel.turn("mode", "dnc")
    panel.press("START")
    assert panel.says("no program", "程式") in panel.message
    panel.keys("PROG")
    panel.soft("DNC-CD", "DNC-CD")
    assert panel.view.title == panel.says("DNC OPERATION (MEMORY CARD)", "DNC 運轉（記憶卡）")
    assert [row[0].text for row in panel.window("card").rows] == ["A.NC", "LONG.NC"]
    panel.keys("DOWN")
    panel.soft("(OPRT)", "(操作)")
    panel.soft("DNC-ST", "DNC-ST")
    assert panel.message == ""
    assert panel.view.status[0].text == "RMT"
    assert panel.start() is State.READY
    assert (panel.control.positions.work["X"], panel.control.positions.work["Y"]) == (0.0, -4.0)
    panel.typed("NONE.NC")
    panel.soft("DNC-ST", "DNC-ST")
    assert panel.says("the card has no file NONE.NC", "記憶卡上沒有可讀寫的檔案 NONE.NC") in panel.message


@pytest.mark.parametrize("control", ["meldas-m"])
@pytest.mark.feature("har.panel_tape")
def test_tape_mode_runs_what_comes_in(bench: Make, tmp_path: Path) -> None:
    (tmp_path / "TAPE.NC").write_text("%\nO7\nG0 Y-3.\nM30\n%\n")
    panel = bench(card=tmp_path)
    panel.turn("mode", "tape")
    panel.press("START")
    assert panel.message
    panel.keys("DIAGN/IN-OUT")
    panel.soft("IN/OUT", "輸出入")
    assert panel.view.title == panel.says("DATA IN/OUT", "資料輸出入")
    panel.soft("TAPE", "紙帶")
    assert panel.message == ""
    assert panel.view.status[0].text == "TAPE"
    assert panel.start() is State.READY
    assert panel.control.positions.work["Y"] == -3.0


@pytest.mark.parametrize("control", ["fanuc-m"])
@pytest.mark.feature("har.panel_edit")
def test_edit_mode_transfers_and_deletes_programs_and_runs_none(bench: Make, tmp_path: Path) -> None:
    (tmp_path / "PART.NC").write_text("%\nO0042\nG0 X3.\nM30\n%\n")
    panel = bench("O1\nG0 X1.\nM30\n", card=tmp_path)
    panel.keys("PROG")
    panel.soft("FOLDER", "目錄")
    panel.soft("(OPRT)", "(操作)")
    panel.soft("READ", "讀入")
    assert panel.message == panel.says("this is done in mode EDIT", "此操作須在 EDIT 模式進行")
    panel.turn("mode", "edit")
    panel.press("START")
    assert panel.message
    panel.soft("READ", "讀入")
    panel.typed("PART.NC")
    panel.soft("EXEC", "執行")
    assert panel.view.status[-1].text == "INPUT"
    panel.passes(1.0)
    assert panel.message == ""
    assert panel.view.status[-1].text != "INPUT"
    assert "O0042" in panel.text
    assert panel.control.program_lines("O0042")
    panel.keys("DOWN")
    panel.soft("PUNCH", "輸出")
    panel.typed("BACK.NC")
    panel.soft("EXEC", "執行")
    assert panel.view.status[-1].text == "OUTPUT"
    panel.passes(1.0)
    assert (tmp_path / "BACK.NC").read_text().split() == ["%", "O0042", "G0", "X3.", "M30", "%"]
    panel.typed("O0042", "DELETE")
    assert "O0042" not in panel.text


def words(panel: Bench) -> list[str]:
    """The rows of the program under edit; the word at the cursor is in brackets."""
    return [
        " ".join(f"<{cell.text}>" if cell.cursor else cell.text for cell in row)
        for row in panel.window("program").rows
    ]


@pytest.mark.parametrize("control", ["fanuc-m", "fanuc-0i-tf"])
@pytest.mark.feature("har.panel_edit", control="fanuc-m")
def test_edit_mode_writes_a_program_word_by_word(control: str, lang: str) -> None:
    panel = Bench(control, lang)
    panel.keys("PROG")
    panel.typed("O0012", "INSERT")
    assert panel.message == panel.says("this is done in mode EDIT", "此操作須在 EDIT 模式進行")
    panel.turn("mode", "edit")
    panel.keys("INSERT", "EOB", "INSERT")
    panel.typed("G0 X10.;", "INSERT")
    panel.typed("M30;", "INSERT")
    assert panel.message == ""
    assert words(panel) == ["O0012 ;", "G0 X10. ;", "M30 <;>"]
    panel.keys("UP", "RIGHT")
    panel.typed("X-2.5", "ALTER")
    panel.typed("Z1.", "INSERT")
    assert words(panel)[1] == "G0 X-2.5 <Z1.> ;"
    panel.keys("DELETE", "RESET")
    assert words(panel)[0] == "<O0012> ;"
    panel.typed("M30", "DOWN")
    assert words(panel) == ["O0012 ;", "G0 X-2.5 ;", "<M30> ;"]
    panel.keys("CAN", "CAN", "CAN")
    panel.typed("O0012", "INSERT")
    assert panel.message == panel.says("the memory has a program O0012 already", "記憶體中已有程式 O0012")
    panel.screen.buffer = ""
    panel.keys("UP", "EOB", "DELETE")
    assert words(panel) == ["O0012 ;", "<M30> ;"]
    panel.keys("UP", "RIGHT")
    panel.typed("G0 X-4.;", "INSERT")
    panel.turn("edit_protect", "on")
    panel.keys("DELETE")
    assert panel.message == panel.says("edit protection is on", "編輯保護已開啟")
    panel.turn("mode", "memory" if control == "fanuc-m" else "auto")
    assert panel.start() is State.READY
    assert panel.control.positions.work["X"] == -4.0


@pytest.mark.parametrize("control", ["fanuc-m"])
@pytest.mark.feature("har.panel_edit")
def test_a_program_is_found_by_its_number_and_the_cursor_down(bench: Make) -> None:
    panel = bench("O1\nG0 X1.\nM30\nO2\nG0 X2.\nM30\n")
    panel.turn("mode", "edit")
    panel.keys("PROG")
    panel.typed("O2", "DOWN")
    assert panel.message == ""
    assert words(panel)[1] == "G0 X2. ;"
    panel.soft("(OPRT)", "(操作)")
    panel.soft("REWIND", "返回開頭")
    assert words(panel)[0].startswith("<")
