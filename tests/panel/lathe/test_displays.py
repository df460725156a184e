"""The displays of 15 and 19 inches: pages at the side, operations below (0i-TF Plus III.1, III.2)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from tests.panel.bench import Bench

    Make = Callable[..., Bench]

OFFSET, GEOM, WEAR = ("OFFSET", "補正"), ("GEOM", "形狀"), ("WEAR", "磨耗")
SEARCH, COUNTER, SWITCH = ("NO.SRH", "NO.SRH"), ("INP.C.", "C輸入"), ("SWITCH", "切換")
ADD, INPUT, EXEC = ("+INPUT", "+輸入"), ("INPUT", "輸入"), ("EXEC", "執行")
FURTHER = {"5044": 4, "5045": 5}


@pytest.fixture(params=["lcd-15", "lcd-19"])
def wide(request: pytest.FixtureRequest, bench: Make) -> Make:
    """Makes a bench with one of the displays."""

    def make(*given: object, **more: object) -> Bench:
        panel = bench(*given, **more)
        panel.unit = request.param
        return panel

    return make


def keyed(panel: Bench, text: str, key: tuple[str, str]) -> None:
    panel.typed(text)
    panel.soft(*key)


def row(panel: Bench, name: str) -> list[str]:
    found = next(cells for cells in panel.window("table").rows if cells[0].text == name)
    return [cell.text for cell in found[1:]]


@pytest.mark.feature("fan.scr_tool_offset", "fan.scr_measure", "fan.scr_counter", control="fanuc-0i-tf")
def test_a_tool_is_measured_with_the_chapter_at_the_side(wide: Make) -> None:
    panel = wide(setup={"start": {"X": 70.0, "Z": 12.5}})
    panel.keys("OFS/SET")
    panel.side(*OFFSET)
    panel.side(*GEOM)
    assert panel.view.title == panel.says("OFFSET / GEOMETRY", "工具補正 / 形狀")
    below = [key.text for key in panel.view.soft_keys]
    assert panel.says("(OPRT)", "(操作)") not in below
    assert len(below) == 10
    keyed(panel, "2", SEARCH)
    keyed(panel, "X69.0", ("MEASURE", "測量"))
    assert row(panel, "G 002")[0] == "1.000"
    keyed(panel, "0.5", ADD)
    assert row(panel, "G 002")[0] == "1.500"
    keyed(panel, "Z", COUNTER)
    assert row(panel, "G 002")[1] == "12.500"
    panel.side(*WEAR)
    keyed(panel, "2", SEARCH)
    keyed(panel, "-.1", INPUT)
    assert row(panel, "W 002")[0] == "-0.100"


@pytest.mark.feature("fan.scr_work_shift", "fan.scr_second_geom", "fan.barrier_screen", control="fanuc-0i-tf")
def test_next_page_leads_to_the_other_pages_of_the_chapter(wide: Make) -> None:
    panel = wide("O1\nG23\nM30\n", setup={"parameters": {"3290#5": 1}})
    panel.start()
    panel.keys("OFS/SET")
    assert panel.view.side_keys[-1].text == panel.says("NEXT PAGE", "下一頁")
    panel.side("W.SHFT", "工件偏移")
    keyed(panel, "1.", INPUT)
    assert row(panel, "SHIFT")[0] == "1.000"
    panel.side("2ND GEOM", "第2形狀")
    keyed(panel, "3", SEARCH)
    keyed(panel, "4.", INPUT)
    assert row(panel, "G 03")[0] == "4.000"
    panel.side("CHUCK TAIL", "夾爪-尾架")
    panel.keys("DOWN")
    keyed(panel, "50.", INPUT)
    assert panel.message == ""
    assert row(panel, "CX")[0] == "50.000"
    panel.keys("PAGE_DOWN")
    assert panel.view.title == panel.says("BARRIER (TAIL)", "尾架屏障")


@pytest.mark.feature("fan.scr_y_offset", control="fanuc-0i-tf")
def test_y_offsets_switch_between_geometry_and_wear(wide: Make) -> None:
    panel = wide()
    panel.keys("OFS/SET")
    panel.side("OFST.2", "刀偏.2")
    panel.soft(*SWITCH)
    keyed(panel, "3", SEARCH)
    keyed(panel, "1.5", INPUT)
    assert row(panel, "G 003") == ["1.500"]
    panel.soft(*SWITCH)
    assert row(panel, "W 003") == ["0.000"]


@pytest.mark.feature("fan.scr_axis45", control="fanuc-0i-tf")
def test_clear_waits_for_exec(wide: Make) -> None:
    panel = wide(setup={"parameters": FURTHER})
    panel.keys("OFS/SET")
    panel.side("EXT.OFFSET", "擴展偏移")
    panel.side(*WEAR)
    keyed(panel, "1.", INPUT)
    panel.side(*GEOM)
    keyed(panel, "7.", INPUT)
    for key, left in ((("CAN", "取消"), "7.000"), (EXEC, "0.000")):
        panel.soft("CLEAR", "清除")
        panel.soft(*GEOM)
        assert row(panel, "G 001")[0] == "7.000"
        panel.soft(*key)
        assert row(panel, "G 001")[0] == left
    panel.side(*WEAR)
    assert row(panel, "W 001")[0] == "1.000"


@pytest.mark.feature("fan.io_y_offset", "fan.io_all_io", control="fanuc-0i-tf")
def test_data_go_to_the_card_and_come_back(wide: Make, tmp_path: Path) -> None:
    panel = wide(card=tmp_path)
    panel.keys("OFS/SET")
    panel.side("OFST.2", "刀偏.2")
    keyed(panel, "1.5", INPUT)
    panel.turn("mode", "edit")
    panel.soft("PUNCH", "輸出")
    panel.soft(*EXEC)
    panel.passes(5.0)
    assert "G10 P01 Y1.500 ;" in (tmp_path / "TOOLOFST.TXT").read_text()
    panel.keys("SYSTEM")
    panel.side("ALL IO", "所有 IO")
    panel.side("2ND GEOM", "第2形狀")
    assert panel.view.title == panel.says("ALL IO / 2ND GEOMETRY", "所有 IO / 第 2 形狀")
    panel.side("Y OFFSET", "Y軸補正")
    panel.soft("PUNCH", "輸出")
    panel.typed("OWN.TXT")
    panel.soft("F NAME", "F 名稱")
    panel.soft(*EXEC)
    assert panel.view.status[-1].text == "OUTPUT"
    panel.passes(5.0)
    assert (tmp_path / "OWN.TXT").read_text() == (tmp_path / "TOOLOFST.TXT").read_text()
    panel.soft("N INPUT", "N 輸入")
    panel.soft(*EXEC)
    assert panel.view.status[-1].text == "INPUT"
    panel.passes(5.0)
    assert panel.message == ""


def test_the_status_line_has_the_time_of_day_and_the_path(wide: Make) -> None:
    panel = wide()
    *_, clock, path = panel.view.status
    assert [len(part) for part in clock.text.split(":")] == [2, 2, 2]
    assert path.text == "PATH1"


def test_the_display_that_was_chosen_lasts(bench: Make, tmp_path: Path) -> None:
    panel = bench(retained=tmp_path / "memory.db")
    panel.unit = "lcd-15"
    panel.turn("feed", "90")
    panel.control.reset()
    panel.control.close()
    again = bench(retained=tmp_path / "memory.db")
    assert again.unit == "lcd-15"
    assert again.view.side_keys
    again.control.close()
