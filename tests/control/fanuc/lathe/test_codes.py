"""The G table of the three systems."""

from __future__ import annotations

import pytest

from polycnc.control import registry
from polycnc.control.fanuc.lathe.codes import POWER_ON, ROWS, g_table, written_codes
from tests.control.fanuc.lathe.support import alarms, run

PLAIN = {"circular_thread": False, "grinding": False, "series_15": False, "balance": False}


@pytest.mark.parametrize(
    ("written", "names"),
    [
        ("G32", ("G32", None, None)),
        ("G33", (None, "G32", "G32")),
        ("G50", ("G50", None, None)),
        ("G92", ("G92", "G50", "G50")),
        ("G77", (None, "G90", "G75")),
        ("G20", ("G20", "G20", "G90")),
        ("G24", (None, None, "G94")),
        ("G70", ("G70", "G70", "G20")),
        ("G78", (None, "G92", "G76")),
        ("G95", (None, "G99", "G99")),
        ("G98", ("G98", "G98", "G98")),
    ],
)
def test_a_code_means_what_its_system_says(written: str, names: tuple[str | None, ...]) -> None:
    found = [g_table(system, **PLAIN).get(written) for system in "ABC"]
    assert tuple(row.code if row else None for row in found) == names


def test_g98_is_the_feed_unit_in_a_and_the_return_level_in_b_and_c() -> None:
    assert [g_table(system, **PLAIN)["G98"].group for system in "ABC"] == ["feed", "return", "return"]


@pytest.mark.parametrize("system", "ABC")
def test_every_power_on_code_is_in_the_table_or_fixed_by_the_system(system: str) -> None:
    written = written_codes(system)
    fixed = {("distance", "G90"), ("return", "G98")} if system == "A" else set()
    own = {("cylinder", ""), ("rigid", "off"), ("calls", "GMTB"), ("data_input", "G11")}
    assert {pair for pair in POWER_ON.items() if pair not in written} <= fixed | own


def test_every_alarm_of_the_lathe_is_in_the_catalogue_in_both_languages() -> None:
    control = registry.control("fanuc-0i-tf")
    for code in set(control.alarms.values()):  # type: ignore[attr-defined]
        assert control.catalogue.text(code, "en", word="X", axis="X", code="G1", number=1)
        assert control.catalogue.text(code, "zh-TW", word="X", axis="X", code="G1", number=1)


def test_a_code_that_is_not_executed_yet_says_so() -> None:
    waiting = {row.code.code for row in ROWS if row.code.not_yet}
    assert "G31.8" in waiting
    for code in sorted(waiting):
        assert alarms(run(code + "\nM30")) == ["PC0001"]


def test_grinding_takes_the_place_of_the_turning_cycles() -> None:
    table = g_table("A", circular_thread=False, grinding=True, series_15=False, balance=False)
    assert table["G71"].group == "motion"
    assert table["G75"].code == "G75"
