"""What fields take: ranges, numbers as keys have them, inches; in every family, in both languages."""

from __future__ import annotations

from typing import Any

import pytest

from polycnc.messages.catalogue import LANGUAGES
from polycnc.panel.screens.tables import Table
from tests.panel.bench import Bench
from tests.panel.screens.test_journeys import both, soft

#: Controls with the machine's offset page, and how a program chooses inches.
OFFSETS = {"fanuc-m": "offset", "fanuc-0i-tf": "geometry", "meldas-m": "offset", "syntec-mill": "offset"}
MACHINES = {"fanuc-m": "hartford", "meldas-m": "hartford"}
INCH = {"syntec-mill": "G70"}


def bench_of(control: str, lang: str, **more: Any) -> Bench:
    return Bench(control, lang, machine=MACHINES.get(control), **more)


def field(bench: Bench) -> str:
    """The field at the cursor."""
    (cell,) = (cell for row in bench.window("table").rows for cell in row if cell.cursor)
    return cell.text


def in_inches(bench: Bench) -> None:
    bench.panel.turn("mode", "mdi")
    bench.control.mdi(INCH.get(bench.control.control.id, "G20"))
    bench.control.run()


@pytest.mark.parametrize(("control", "lang"), both(*OFFSETS))
@pytest.mark.parametrize("typed", ["nan", "inf", "1e3", "1_0", "٣", "--5", ".", "1.2.3"])
def test_a_field_takes_numbers_alone(control: str, lang: str, typed: str) -> None:
    bench = bench_of(control, lang)
    bench.screen.show(OFFSETS[control])
    bench.typed(typed, "INPUT")
    assert bench.message == bench.says(f"a number is wanted, not {typed}", f"需輸入數值，而非 {typed}")
    assert field(bench) == "0.000"


@pytest.mark.parametrize(("control", "lang"), both("fanuc-m", "meldas-m"))
@pytest.mark.parametrize(
    ("inch", "largest", "beyond"), [(False, "999.999", "1000."), (True, "99.9990", "99.9995")]
)
def test_an_offset_has_an_end(control: str, lang: str, inch: bool, largest: str, beyond: str) -> None:
    bench = bench_of(control, lang)
    if inch:
        in_inches(bench)
    bench.screen.show("offset")
    bench.typed(f"-{largest}", "INPUT")
    assert (bench.message, field(bench)) == ("", f"-{largest}")
    bench.typed(beyond, "INPUT")
    assert bench.message == bench.says("the value is out of range", "數值超出範圍")
    assert field(bench) == f"-{largest}"


@pytest.mark.parametrize("lang", LANGUAGES)
def test_numbered_fields_of_meldas_stand_in_the_key_in_line(lang: str) -> None:
    bench = bench_of("meldas-m", lang)
    bench.keys("TOOL/PARAM")
    assert bench.view.entry == "#(1)  DATA()"
    bench.typed("12", "RIGHT")
    assert (bench.message, bench.view.entry) == ("", "#(12)  DATA()")
    bench.typed("-1.5")
    assert bench.view.entry == "#(12)  DATA(-1.5)"
    bench.keys("INPUT")
    assert (bench.message, field(bench)) == ("", "-1.500")
    bench.typed("9999", "RIGHT")
    assert bench.message
    assert bench.view.entry == "#(12)  DATA(9999)"
    bench.keys("CAN", "CAN", "CAN", "CAN", "MONITOR")
    bench.typed("X1")
    assert bench.view.entry == "A>X1_"


@pytest.mark.parametrize(("control", "lang"), both("fanuc-m", "fanuc-0i-tf"))
@pytest.mark.parametrize("typed", ["nan", "inf", "2.5", "", "-1", "1000", "99999999999999999999"])
def test_a_number_that_is_not_there_is_not_found(control: str, lang: str, typed: str) -> None:
    bench = bench_of(control, lang)
    bench.keys("OFS/SET")
    soft(bench, "(OPRT)")
    bench.typed(typed)
    soft(bench, "NO.SRH")
    assert bench.message
    assert bench.screen.cursor == (1, 0)


@pytest.mark.parametrize(("control", "lang"), both(*OFFSETS))
def test_relative_positions_are_inches_where_the_program_has_them(control: str, lang: str) -> None:
    start = {"X": 50.8, "Z": -25.4}
    bench = bench_of(control, lang, setup={"start": start})
    assert bench.screen.positions(bench.control.snapshot, "relative")["X"] == 50.8
    in_inches(bench)
    shown = bench.screen.positions(bench.control.snapshot, "relative")
    assert (shown["X"], shown["Z"]) == pytest.approx((2.0, -1.0))
    assert bench.screen.position_text("X", "machine", 50.8) == "50.800"


@pytest.mark.feature("fan.scr_counter", control="fanuc-0i-tf")
@pytest.mark.parametrize("lang", LANGUAGES)
def test_counter_input_and_a_preset_origin_count_inches(lang: str) -> None:
    bench = bench_of("fanuc-0i-tf", lang, setup={"start": {"X": 50.8}})
    in_inches(bench)
    bench.keys("POS")
    soft(bench, "REL", "(OPRT)")
    bench.typed("U0.5")
    soft(bench, "ORIGIN")
    assert "U 0.5000" in bench.text
    bench.keys("OFS/SET")
    soft(bench, "GEOM", "(OPRT)")
    bench.typed("X")
    soft(bench, "INP.C.")
    assert (bench.message, field(bench)) == ("", "0.5000")


@pytest.mark.feature("fan.scr_second_geom", control="fanuc-0i-tf")
@pytest.mark.parametrize("lang", LANGUAGES)
def test_switch_keeps_the_number_at_the_cursor(lang: str) -> None:
    bench = bench_of("fanuc-0i-tf", lang, setup={"parameters": {"3290#5": 1}})
    bench.keys("OFS/SET")
    soft(bench, "2ND GEOM", "(OPRT)")
    bench.typed("9")
    soft(bench, "NO.SRH", "SWITCH")
    assert bench.screen.cursor == (9, 0)


#: Pages whose fields are typed in for what they do, not for what they keep; or are shown alone.
NOT_KEPT = {"work-shift", "chuck", "tailstock", "conditions-default"}
ALL = {**MACHINES, "fanuc-0i-tf": "lathe-yab", "sinumerik-840d": None, "syntec-mill": None}


@pytest.mark.parametrize("control", ALL)
def test_every_field_of_a_table_keeps_what_is_typed(control: str) -> None:
    further = {"3290#5": 1, "5044": 4, "5045": 5} if control == "fanuc-0i-tf" else {}
    setup = {"tools": {1: {"length": 50.0}}, "parameters": further}
    bench = Bench(control, "en", machine=ALL[control], setup=setup)
    written = 0
    for page in sorted(bench.screen.family.pages.keys() - NOT_KEPT):
        bench.screen.show(page)
        if (table := bench.screen.table) is None:
            continue
        for place in ((table.first, column) for column in range(len(table.columns))):
            bench.screen.place(*place)
            bench.typed("1", "INPUT")
            kept = Table(bench.control, table).value(table.columns[place[1]], place[0])
            assert (bench.message, kept in (1, "1")) == ("", True), (page, place)
            written += 1
    assert written > 5


@pytest.mark.parametrize("lang", LANGUAGES)
def test_work_offsets_and_radii_of_syntec_are_typed_in_and_act(lang: str) -> None:
    program = "O1\nG55 G0 X0 Y0\nG41 D2 G1 X10. F600\nY40.\nG40 X0\nM30\n"
    bench = bench_of("syntec-mill", lang, program=program)
    bench.keys("OFF/SET")
    soft(bench, "Work offset")
    bench.keys("DOWN", "DOWN")
    bench.typed("12.5", "INPUT")
    bench.typed("0.5")
    soft(bench, "+Input")
    assert (bench.message, field(bench)) == ("", "13.000")
    soft(bench, "Tool set")
    bench.typed("2")
    soft(bench, "Search")
    bench.keys("RIGHT", "RIGHT")
    bench.typed("4.", "INPUT")
    bench.keys("RIGHT")
    bench.typed("-0.25", "INPUT")
    assert (bench.message, field(bench)) == ("", "-0.250")
    bench.press("START")
    while bench.control.positions.machine["Y"] < 20.0:
        bench.passes(0.1)
    assert bench.control.positions.machine["X"] == pytest.approx(13.0 + 10.0 - 3.75)
