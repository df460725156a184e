"""The offset screens of the lathe (0i-TF Plus III.2.1.1 to III.2.1.8): keys of the manual with their results."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.mainrun import State

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.panel.bench import Bench

    Make = Callable[..., Bench]

OFFSET, GEOM, WEAR = ("OFFSET", "補正"), ("GEOM", "形狀"), ("WEAR", "磨耗")
SWITCH = ("SWITCH", "切換")
OPRT = ("(OPRT)", "(操作)")
SEARCH, MEASURE, COUNTER = ("NO.SRH", "NO.SRH"), ("MEASUR", "測定"), ("INP.C.", "C輸入")
ADD, INPUT = ("+INPUT", "+輸入"), ("INPUT", "輸入")
PROTECTED = ("this number is protected against input", "此編號禁止輸入")


def opened(panel: Bench, *keys: tuple[str, str]) -> Bench:
    """OFS/SET, then soft keys."""
    panel.keys("OFS/SET")
    for key in keys:
        panel.soft(*key)
    return panel


def keyed(panel: Bench, text: str, key: tuple[str, str]) -> None:
    """Type something and press a soft key."""
    panel.screen.buffer = ""
    panel.typed(text)
    panel.soft(*key)


def row(panel: Bench, name: str) -> list[str]:
    """The fields of a row of the table."""
    for cells in panel.window("table").rows:
        if cells[0].text == name:
            return [cell.text for cell in cells[1:]]
    raise AssertionError(name)


def heads(panel: Bench) -> list[str]:
    """What stands above the columns of the table."""
    return [cell.text for cell in panel.window("table").rows[0]]


# ---- tool offsets (III.2.1.1) ------------------------------------------------------------------------------


@pytest.mark.feature("fan.scr_tool_offset", control="fanuc-0i-tf")
def test_geometry_and_wear_have_a_page_each_with_positions_at_the_side(bench: Make) -> None:
    panel = opened(bench(setup={"start": {"X": 70.0, "Z": 12.5}}), OFFSET, GEOM)
    assert panel.view.title == panel.says("OFFSET / GEOMETRY", "工具補正 / 形狀")
    assert heads(panel)[1:] == panel.says("X Z RADIUS T", "X軸 Z軸 半徑 T").split()
    assert len(panel.window("table").rows) == 18, "17 numbers on a page"
    side = [window for window in panel.view.windows if window.kind == "positions"]
    assert [window.title for window in side] == [
        *panel.says("RELATIVE ABSOLUTE MACHINE", "相對座標 絕對座標 機械座標").split()
    ]
    assert [cells[0].text for cells in side[0].rows][:3] == ["U", "W", "V"]
    assert "X 70.000" in side[1].text
    assert "Z 12.500" in side[1].text
    panel.soft(*OPRT)
    keyed(panel, "12.5", INPUT)
    panel.keys("RIGHT")
    keyed(panel, "-3.", INPUT)
    panel.keys("RIGHT")
    keyed(panel, ".8", INPUT)
    panel.keys("RIGHT")
    keyed(panel, "3", INPUT)
    assert panel.message == ""
    assert row(panel, "G 001") == ["12.500", "-3.000", "0.800", "3"]
    opened(panel, WEAR)
    assert panel.view.title == panel.says("OFFSET / WEAR", "工具補正 / 磨耗")
    assert row(panel, "W 001") == ["0.000", "0.000", "0.000", "3"], "the tip is one for both"
    panel.soft(*OPRT)
    keyed(panel, "20", SEARCH)
    keyed(panel, "0.2", INPUT)
    keyed(panel, "-0.05", ADD)
    assert row(panel, "W 020")[0] == "0.150"
    keyed(panel, "999", SEARCH)
    assert panel.message == panel.says("nothing can be written here", "此處無法寫入")
    keyed(panel, "11", INPUT)
    panel.keys("RIGHT", "RIGHT", "RIGHT")
    keyed(panel, "11", INPUT)
    assert panel.message == panel.says("the value is out of range", "數值超出範圍")


@pytest.mark.feature("fan.scr_tool_offset", control="fanuc-0i-tf")
def test_one_list_in_the_place_of_geometry_and_wear(bench: Make) -> None:
    panel = bench(setup={"parameters": {"8136#6": 1, "5024": 64}})
    panel.keys("OFS/SET")
    assert panel.view.title == panel.says("OFFSET", "工具補正")
    assert panel.says("WEAR", "磨耗") not in [key.text for key in panel.view.soft_keys]
    panel.soft(*OFFSET)
    panel.soft(*OPRT)
    keyed(panel, "64", SEARCH)
    keyed(panel, "1.5", INPUT)
    assert row(panel, "064")[0] == "1.500"


@pytest.mark.feature("fan.scr_tool_offset", control="fanuc-0i-tf")
def test_radius_and_tip_are_shown_with_their_function_only(bench: Make) -> None:
    panel = opened(bench(setup={"parameters": {"8136#7": 1}}), GEOM)
    assert [cell.text for cell in panel.window("table").rows[0]] == panel.says(
        "NO. X Z", "編號 X軸 Z軸"
    ).split()


# ---- protection --------------------------------------------------------------------------------------------


@pytest.mark.feature("fan.scr_offset_protect", control="fanuc-0i-tf")
@pytest.mark.parametrize(
    ("bit", "locked", "name", "free"), [("3290#0", WEAR, "W", GEOM), ("3290#1", GEOM, "G", WEAR)]
)
def test_wof_and_gof_inhibit_their_page(
    bit: str, locked: tuple[str, str], name: str, free: tuple[str, str], bench: Make
) -> None:
    panel = opened(bench(setup={"parameters": {bit: 1}}), locked, OPRT)
    keyed(panel, "1.", INPUT)
    assert panel.message == panel.says(*PROTECTED)
    assert row(panel, f"{name} 001")[0] == "0.000"
    opened(panel, free, OPRT)
    keyed(panel, "1.", INPUT)
    assert panel.message == ""


@pytest.mark.feature("fan.scr_offset_protect", control="fanuc-0i-tf")
def test_consecutive_values_stop_in_front_of_the_protected_numbers(bench: Make) -> None:
    panel = opened(bench(setup={"parameters": {"3294": 10, "3295": 5}}), WEAR, OPRT)
    keyed(panel, "8", SEARCH)
    keyed(panel, "1.;2.;3.;4.;5.", INPUT)
    assert panel.message == panel.says(*PROTECTED)
    values = [row(panel, f"W {number:03}")[0] for number in range(8, 16)]
    assert values == ["1.000", "2.000", *["0.000"] * 6]
    keyed(panel, "12", SEARCH)
    keyed(panel, "1.;2.;3.;4.;5.", INPUT)
    assert panel.message == panel.says(*PROTECTED)
    assert [row(panel, f"W {number:03}")[0] for number in range(12, 17)] == ["0.000"] * 5
    keyed(panel, "15", SEARCH)
    keyed(panel, "7.;8.;", INPUT)
    assert panel.message == ""
    assert [row(panel, f"W {number:03}")[0] for number in (15, 16)] == ["7.000", "8.000"]


# ---- measured values (III.2.1.2), counter input (III.2.1.4) ---------------------------------------------------


@pytest.mark.feature("fan.scr_measure", control="fanuc-0i-tf")
def test_a_measured_diameter_becomes_the_geometry_and_wear_is_zero(bench: Make) -> None:
    panel = opened(bench(setup={"start": {"X": 70.0, "Z": 12.5}}), WEAR, OPRT)
    keyed(panel, "2", SEARCH)
    keyed(panel, "0.3", INPUT)
    opened(panel, GEOM, OPRT)
    keyed(panel, "2", SEARCH)
    keyed(panel, "5.", INPUT)
    keyed(panel, "X69.0", MEASURE)
    assert panel.message == ""
    assert row(panel, "G 002")[:2] == ["1.000", "0.000"]
    keyed(panel, "Z10.0", MEASURE)
    assert row(panel, "G 002")[:2] == ["1.000", "2.500"]
    opened(panel, WEAR)
    assert row(panel, "W 002")[:2] == ["0.000", "0.000"]
    panel.soft(*OPRT)
    keyed(panel, "69.0", MEASURE)
    assert panel.message == panel.says(
        "an axis of this page is wanted, with a value where the key needs one",
        "需輸入本頁的軸名，必要時加上數值",
    )


@pytest.mark.feature("fan.scr_measure", control="fanuc-0i-tf")
def test_orc_stores_the_offset_as_a_radius(bench: Make) -> None:
    panel = opened(bench(setup={"start": {"X": 70.0}, "parameters": {"5004#1": 1}}), GEOM, OPRT)
    keyed(panel, "X69.0", MEASURE)
    assert row(panel, "G 001")[0] == "0.500"


@pytest.mark.feature("fan.scr_measure", control="fanuc-0i-tf")
def test_prc_keeps_the_position_so_that_the_tool_can_go_away_on_both_axes(bench: Make) -> None:
    panel = bench(setup={"start": {"X": 70.0, "Z": 12.5}, "parameters": {"5005#2": 1}})
    opened(panel, GEOM, OPRT)
    keyed(panel, "X69.0", MEASURE)
    assert panel.message == panel.says(
        "no position has been kept yet: press the record button (PRC) at the measured face",
        "尚未記錄位置：請在量測面按下記錄按鍵 (PRC)",
    )
    panel.press("RECORD")
    panel.turn("mode", "jog")
    for key in ("X+", "Z+"):
        panel.press(key)
        panel.passes(1.0)
        panel.release(key)
        panel.control.run()
    assert panel.control.positions.work["X"] > 75.0
    keyed(panel, "X69.0", MEASURE)
    keyed(panel, "Z10.0", MEASURE)
    assert panel.message == ""
    assert row(panel, "G 001")[:2] == ["1.000", "2.500"]


@pytest.mark.feature("fan.scr_counter", control="fanuc-0i-tf")
@pytest.mark.parametrize(("page", "name", "other"), [(GEOM, "G", (WEAR, "W")), (WEAR, "W", (GEOM, "G"))])
def test_counter_input_takes_the_relative_coordinate_on_the_shown_page_only(
    page: tuple[str, str], name: str, other: tuple[tuple[str, str], str], bench: Make
) -> None:
    panel = opened(bench(), other[0], OPRT)
    keyed(panel, "5", SEARCH)
    keyed(panel, "0.1", INPUT)
    panel.keys("POS")
    panel.soft("REL", "相對")
    panel.soft(*OPRT)
    keyed(panel, "U", ("ORIGIN", "歸零"))
    panel.control.load("O1\nG0 X-3.25\nM30\n")
    assert panel.start() is State.READY
    panel.keys("POS")
    panel.soft("REL", "相對")
    assert "U -3.250" in panel.text
    opened(panel, page, OPRT)
    keyed(panel, "5", SEARCH)
    keyed(panel, "X", COUNTER)
    assert panel.message == ""
    assert row(panel, f"{name} 005")[0] == "-3.250"
    opened(panel, other[0])
    assert row(panel, f"{other[1]} 005")[0] == "0.100"


# ---- work shift (III.2.1.5) ----------------------------------------------------------------------------------


@pytest.mark.feature("fan.scr_work_shift", control="fanuc-0i-tf")
def test_the_work_shift_acts_on_the_display_at_once(bench: Make) -> None:
    panel = opened(bench(setup={"start": {"X": 121.0, "Z": 69.0}}), ("W.SHFT", "工件偏移"))
    assert panel.view.title == panel.says("WORK COORDINATE SHIFT", "工件座標系偏移")
    panel.typed("1.0", "INPUT", "RIGHT")
    panel.typed("-1.0", "INPUT")
    absolute = panel.view.windows[2].text
    assert absolute.splitlines()[:2] == ["X 120.000", "Z 70.000"]
    assert panel.view.windows[3].text.splitlines()[:2] == ["X 121.000", "Z 69.000"], "the machine stays"


@pytest.mark.feature("fan.scr_work_shift", control="fanuc-0i-tf")
@pytest.mark.parametrize("latches", [0, 1])
def test_a_measured_face_reads_what_was_programmed(latches: int, bench: Make) -> None:
    panel = bench(setup={"start": {"Z": 12.5}, "parameters": {"5005#2": latches}})
    if latches:
        panel.press("RECORD")
        panel.turn("mode", "jog")
        panel.press("Z+")
        panel.passes(1.0)
        panel.release("Z+")
        panel.control.run()
    away = panel.control.positions.work["Z"] - 12.5
    opened(panel, ("W.SHFT", "工件偏移"))
    panel.keys("DOWN", "RIGHT")
    panel.typed("10.0", "INPUT")
    assert panel.message == ""
    assert row(panel, "SHIFT")[1] == "2.500"
    assert panel.control.positions.work["Z"] == pytest.approx(10.0 + away)


# ---- second geometry (III.2.1.6), modal display ---------------------------------------------------------------


@pytest.mark.feature("fan.scr_second_geom", control="fanuc-0i-tf")
def test_second_geometry_is_typed_in_with_its_parameter(bench: Make) -> None:
    panel = opened(bench(setup={"parameters": {"3290#5": 1}}), ("2ND GEOM", "第2形狀"))
    assert panel.view.title == panel.says("OFFSET / 2ND GEOM", "刀具補正 / 第2形狀")
    assert [window.kind for window in panel.view.windows] == [
        *("positions", "rates", "modal", "table", "counters")
    ]
    assert heads(panel) == panel.says("NO. X Z", "編號 X軸 Z軸").split()
    assert len(panel.window("table").rows) == 12, "11 numbers on a page"
    panel.soft(*OPRT)
    keyed(panel, "9", SEARCH)
    keyed(panel, "4.", INPUT)
    keyed(panel, "0.5", ADD)
    panel.soft(*SWITCH)
    assert heads(panel) == panel.says("NO. Y", "編號 Y軸").split()
    keyed(panel, "9", SEARCH)
    panel.typed("-1.", "INPUT")
    assert panel.message == ""
    assert row(panel, "G 09") == ["-1.000"]
    panel.soft(*SWITCH)
    assert row(panel, "G 09") == ["4.500", "0.000"]


@pytest.mark.feature("fan.scr_second_geom", control="fanuc-0i-tf")
def test_second_geometry_is_refused_without_its_parameter(bench: Make) -> None:
    panel = opened(bench(), ("2ND GEOM", "第2形狀"), OPRT)
    for key in (INPUT, ADD):
        keyed(panel, "4.", key)
        assert panel.message == panel.says(*PROTECTED)
    assert row(panel, "G 01") == ["0.000"] * 2


@pytest.mark.feature("fan.modal_display", control="fanuc-0i-tf")
def test_the_modal_codes_stand_in_the_order_of_the_manual(bench: Make) -> None:
    panel = bench("O1\nG1 G99 X1. F0.5\nG41 G55 M0\nM30\n")
    panel.keys("POS")
    assert panel.view.title == panel.says("ACTUAL POSITION (ABSOLUTE)", "現在位置（絕對座標）")
    assert panel.window("modal").text.splitlines() == [
        *("G00 G80 G13.1", "G97 G67 G50.1", "G69 G54 G49", "G98 G64 G15"),
        *("G21 G18 G05.5", "G40 G69.1", "G25 G40.1 G80.5", "G22 G50.2 G80.4"),
    ]
    panel.start()
    assert panel.window("modal").text.splitlines()[0] == "G01 G80 G13.1"
    assert panel.window("modal").text.splitlines()[2:4] == ["G69 G55 G49", "G99 G64 G15"]
    assert panel.window("modal").text.splitlines()[5] == "G41 G69.1"


# ---- Y offset (III.2.1.7) --------------------------------------------------------------------------------------


OFST_2 = ("OFST.2", "刀偏.2")


@pytest.mark.feature("fan.scr_y_offset", control="fanuc-0i-tf")
def test_switch_leads_from_wear_to_geometry_and_back(bench: Make) -> None:
    panel = opened(bench(), OFST_2)
    assert panel.view.title == panel.says("OFFSET / Y WEAR", "工具補正 / Y 磨耗")
    panel.soft(*OPRT)
    panel.soft(*SWITCH)
    assert panel.view.title == panel.says("OFFSET / Y GEOMETRY", "工具補正 / Y 形狀")
    keyed(panel, "3", SEARCH)
    keyed(panel, "1.5", INPUT)
    assert row(panel, "G 003") == ["1.500"]
    panel.soft(*SWITCH)
    assert row(panel, "W 003") == ["0.000"]
    texts = [key.text for key in panel.screen.family.menus["offset-y-oprt"]]
    assert texts
    panel.keys("RETURN")
    assert panel.says("WORK", "座標系") in [key.text for key in panel.view.soft_keys]


@pytest.mark.feature("fan.scr_y_offset", control="fanuc-0i-tf")
def test_a_parameter_gives_wear_and_geometry_a_key_each(bench: Make) -> None:
    panel = opened(bench(setup={"parameters": {"11349#4": 1}}), OFST_2, OPRT, GEOM)
    assert panel.view.title == panel.says("OFFSET / Y GEOMETRY", "工具補正 / Y 形狀")
    panel.soft(*WEAR)
    assert panel.view.title == panel.says("OFFSET / Y WEAR", "工具補正 / Y 磨耗")
    with pytest.raises(AssertionError):
        panel.soft(*SWITCH)


@pytest.mark.feature("fan.scr_y_offset", control="fanuc-0i-tf")
def test_counter_input_of_y(bench: Make) -> None:
    panel = bench("O1\nG0 Y-2.5\nM30\n")
    panel.keys("POS")
    panel.soft("REL", "相對")
    panel.soft(*OPRT)
    keyed(panel, "V", ("ORIGIN", "歸零"))
    panel.start()
    opened(panel, OFST_2, OPRT)
    keyed(panel, "2", SEARCH)
    keyed(panel, "Y", COUNTER)
    assert panel.message == ""
    assert row(panel, "W 002") == ["-2.500"]


@pytest.mark.feature("fan.scr_y_offset", control="fanuc-0i-tf")
def test_one_list_of_y_without_geometry_and_wear(bench: Make) -> None:
    panel = opened(bench(setup={"parameters": {"8136#6": 1}}), OFST_2)
    assert panel.view.title == panel.says("OFFSET / Y", "工具補正 / Y")
    panel.typed("2.", "INPUT")
    assert row(panel, "001") == ["2.000"]


# ---- 4th and 5th axis (III.2.1.8) --------------------------------------------------------------------------------


EXT = ("EXT.OFFSET", "擴展偏移")
#: A is the 4th axis and B the 5th.
FURTHER = {"5044": 4, "5045": 5}
CLEAR = ("CLEAR", "清除")


@pytest.mark.feature("fan.scr_axis45", control="fanuc-0i-tf")
def test_the_axes_of_the_parameters_have_wear_and_geometry(bench: Make) -> None:
    panel = opened(bench(setup={"parameters": FURTHER}), EXT)
    assert panel.view.title == panel.says("OFFSET / WEAR", "工具補正 / 磨耗")
    assert heads(panel) == panel.says("NO. A B", "編號 A軸 B軸").split()
    panel.soft(*OPRT)
    keyed(panel, "3", SEARCH)
    keyed(panel, "1.5", INPUT)
    keyed(panel, "0.25", ADD)
    panel.keys("RIGHT")
    panel.typed("-2.", "INPUT")
    assert row(panel, "W 003") == ["1.750", "-2.000"]
    opened(panel, EXT, GEOM)
    assert panel.view.title == panel.says("OFFSET / GEOMETRY", "工具補正 / 形狀")
    assert row(panel, "G 003") == ["0.000", "0.000"]
    texts = [key.text for key in panel.screen.family.menus["ext-oprt"] if isinstance(key.text, dict)]
    assert not [text for text in texts if text["en"] in {"MEASUR", "INP.C."}]


@pytest.mark.feature("fan.scr_axis45", control="fanuc-0i-tf")
@pytest.mark.parametrize(
    ("chosen", "wear", "geometry"),
    [(WEAR, "0.000", "7.000"), (GEOM, "1.000", "0.000"), (("ALL", "全部"), "0.000", "0.000")],
)
def test_clear_makes_a_list_or_both_zero(
    chosen: tuple[str, str], wear: str, geometry: str, bench: Make
) -> None:
    panel = bench(setup={"parameters": FURTHER})
    for page, value in ((WEAR, "1."), (GEOM, "7.")):
        opened(panel, page)
        panel.typed("5.5", "INPUT")
        opened(panel, EXT, page, OPRT)
        keyed(panel, "4", SEARCH)
        keyed(panel, value, INPUT)
    panel.soft(*CLEAR)
    panel.soft("CAN", "取消")
    assert row(panel, "G 004")[0] == "7.000"
    panel.soft(*CLEAR)
    panel.soft(*chosen)
    assert panel.message == ""
    assert row(panel, "G 004")[0] == geometry
    opened(panel, EXT, WEAR)
    assert row(panel, "W 004")[0] == wear
    opened(panel, WEAR)
    assert row(panel, "W 001")[0] == "5.500", "X, Z and Y stay"


@pytest.mark.feature("fan.scr_axis45", control="fanuc-0i-tf")
def test_without_geometry_and_wear_there_is_one_page_and_all(bench: Make) -> None:
    panel = opened(bench(setup={"parameters": {**FURTHER, "8136#6": 1}}), EXT)
    assert panel.view.title == panel.says("OFFSET", "工具補正")
    panel.typed("3.", "INPUT")
    assert row(panel, "001")[0] == "3.000"
    panel.soft(*OPRT)
    panel.soft(*CLEAR)
    assert [key.text for key in panel.view.soft_keys if key.text] == [
        *panel.says("ALL CAN", "全部 取消").split()
    ]
    panel.soft("ALL", "全部")
    assert row(panel, "001")[0] == "0.000"
