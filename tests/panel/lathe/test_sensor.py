"""Direct input of measured values B: the sensor writes offsets and the work shift (0i-TF Plus III.2.1.3)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.panel.bench import Bench

    Make = Callable[..., Bench]

pytestmark = pytest.mark.feature("fan.scr_measure_b", control="fanuc-0i-tf")
#: The faces of the sensor: +X, -X, +Z, -Z.
FACES = {"5015": 20.0, "5016": 10.0, "5017": -5.0, "5018": -15.0}


def signal(panel: Bench, name: str, *, on: bool = True) -> None:
    panel.control.signals[name] = float(on)


def measuring(bench: Make) -> Bench:
    panel = bench(setup={"start": {"X": 70.0, "Z": 12.5}, "parameters": FACES})
    panel.turn("mode", "jog")
    signal(panel, "GOQSM")
    return panel


def blinks(panel: Bench) -> str:
    return " ".join(cell.text for cell in panel.view.status if cell.style == "blink")


def geometry(panel: Bench, number: int) -> list[str]:
    row = next(cells for cells in panel.window("table").rows if cells[0].text == f"G {number:03}")
    return [cell.text for cell in row[1:3]]


def test_the_page_comes_by_itself_and_a_touch_writes_the_number_of_the_cursor(bench: Make) -> None:
    panel = measuring(bench)
    assert panel.view.title == panel.says("OFFSET / GEOMETRY", "工具補正 / 形狀")
    assert blinks(panel) == panel.says("OFST", "偏移")
    panel.keys("DOWN", "DOWN")
    panel.press("X-")
    panel.passes(0.5)
    touched = panel.control.positions.machine["X"]
    signal(panel, "-MIT1")
    panel.control.run()
    assert panel.control.feed == 0.0, "the axis stops"
    assert geometry(panel, 3) == [f"{touched - 10.0:.3f}", "0.000"]
    panel.release("X-")
    panel.press("X-")
    assert panel.message == panel.says(
        "X- is locked: the tool touches the sensor", "X- 被鎖住：刀具正接觸檢出器"
    )
    panel.press("X+")
    assert panel.message == "", "away from it the axis may go"
    panel.release("X+")
    signal(panel, "-MIT1", on=False)
    signal(panel, "+MIT2")
    assert geometry(panel, 3)[1] == "17.500"
    assert panel.control.signals["S1MES"]
    signal(panel, "GOQSM", on=False)
    assert blinks(panel) == ""
    assert not panel.control.signals["S1MES"]


def test_signals_lead_the_cursor_by_qni(bench: Make) -> None:
    panel = measuring(bench)
    panel.control.write_parameter("5005#5", 1.0)
    signal(panel, "OFN2")
    panel.keys("DOWN")
    assert panel.screen.cursor[0] == 5, "keys do not move it"
    signal(panel, "+MIT1")
    assert geometry(panel, 5)[0] == "50.000"


def test_nothing_is_measured_before_the_writing_mode_or_out_of_manual_modes(bench: Make) -> None:
    panel = bench(setup={"start": {"X": 70.0}, "parameters": FACES})
    signal(panel, "GOQSM")
    assert blinks(panel) == ""
    signal(panel, "+MIT1")
    assert panel.message
    panel.keys("OFS/SET")
    assert geometry(panel, 1)[0] == "0.000"


def test_woset_shifts_the_work_coordinates_by_the_touched_face(bench: Make) -> None:
    panel = bench(setup={"start": {"Z": 50.0}, "parameters": {"5020": 4}, "tools": {4: {"z": 12.0}}})
    panel.turn("mode", "handle")
    signal(panel, "WOQSM")
    assert panel.view.title == panel.says("WORK COORDINATE SHIFT", "工件座標系偏移")
    assert blinks(panel) == panel.says("WSFT", "工件偏移")
    signal(panel, "WOSET")
    assert "38.000" in panel.window("table").text
    signal(panel, "WOQSM", on=False)
    assert blinks(panel) == ""


def test_the_second_spindle_is_chosen_before(bench: Make) -> None:
    panel = bench()
    panel.turn("mode", "handle")
    signal(panel, "S2TLS")
    signal(panel, "GOQSM")
    signal(panel, "S2TLS", on=False)
    assert (panel.control.signals["S1MES"], panel.control.signals["S2MES"]) == (0.0, 1.0)
    assert blinks(panel) == panel.says("OFST", "偏移")
