"""The pages of the chuck and tailstock barrier (0i-TF Plus III.2.1.9)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.panel.bench import Bench

    Make = Callable[..., Bench]

pytestmark = pytest.mark.feature("fan.barrier_screen", control="fanuc-0i-tf")
OPRT = ("(OPRT)", "(操作)")
CHUCK, TAIL = ("BARRIER (CHUCK)", "夾爪屏障"), ("BARRIER (TAIL)", "尾架屏障")
#: Symbols of both pages with their parameters.
CHUCK_PARAMETERS = {
    "TY": "1330",
    "CX": "1335",
    "CZ": "1336",
    "L": "1331",
    "W": "1332",
    "L1": "1333",
    "W1": "1334",
}
TAIL_PARAMETERS = {
    "TZ": "1348", "L": "1341", "D": "1342", "L1": "1343", "D1": "1344", "L2": "1345", "D2": "1346", "D3": "1347",
}  # fmt: skip


def opened(bench: Make, mode: str = "G23") -> Bench:
    """The chuck's page, in a state of the stroke check."""
    panel = bench(f"O1\n{mode}\nM30\n", setup={"start": {"X": 120.0, "Z": -35.5}})
    panel.start()
    panel.keys("OFS/SET")
    panel.soft("CHUCK TAIL", "夾爪-尾架")
    return panel


def symbols(panel: Bench) -> dict[str, str]:
    return {cells[0].text: cells[1].text for cells in panel.window("table").rows[1:]}


def test_the_page_keys_turn_from_the_chuck_to_the_tailstock_and_back(bench: Make) -> None:
    panel = opened(bench)
    for key in ("PAGE_DOWN", "PAGE_UP", "PAGE_DOWN", "PAGE_DOWN"):
        assert panel.view.title == panel.says(*CHUCK)
        assert list(symbols(panel)) == list(CHUCK_PARAMETERS)
        panel.keys(key)
        assert panel.view.title == panel.says(*TAIL)
        assert list(symbols(panel)) == list(TAIL_PARAMETERS)
        panel.keys(key)


def test_every_symbol_is_its_parameter(bench: Make) -> None:
    panel = opened(bench)
    for parameters in (CHUCK_PARAMETERS, TAIL_PARAMETERS):
        for place, (symbol, number) in enumerate(parameters.items()):
            value = 1.0 if symbol == "TY" else 10.5 + place
            panel.typed(f"{value}", "INPUT")
            assert panel.message == ""
            assert panel.control.read_parameter(number) == value
            panel.control.write_parameter(number, 0.0 if symbol == "TY" else value + 1.0)
            assert float(symbols(panel)[symbol]) == (0.0 if symbol == "TY" else value + 1.0)
            panel.keys("DOWN")
        panel.keys("PAGE_DOWN")


def test_plus_input_adds_and_set_takes_the_position_where_it_may(bench: Make) -> None:
    panel = opened(bench)
    panel.soft(*OPRT)
    panel.keys("DOWN")
    panel.soft("SET", "設定")
    panel.keys("DOWN")
    panel.soft("SET", "設定")
    assert (symbols(panel)["CX"], symbols(panel)["CZ"]) == ("120.000", "-35.500")
    panel.typed("-0.5")
    panel.soft("+INPUT", "+輸入")
    assert symbols(panel)["CZ"] == "-36.000"
    panel.keys("DOWN")
    panel.soft("SET", "設定")
    assert panel.message
    assert symbols(panel)["L"] == "0.000"
    panel.keys("PAGE_UP")
    panel.soft(*OPRT)
    panel.soft("SET", "設定")
    assert symbols(panel)["TZ"] == "-35.500"


def test_nothing_is_set_in_the_state_g22(bench: Make) -> None:
    panel = opened(bench, "G22")
    panel.keys("DOWN")
    panel.typed("50.", "INPUT")
    assert "G23" in panel.message
    assert panel.says("barrier", "屏障") in panel.message.lower()
    assert symbols(panel)["CX"] == "0.000"
