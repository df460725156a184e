"""Journeys through pages and keys that no other test goes: every family, in both languages.

Soft keys are named by their English text, and found in the language of the bench.
"""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import pytest

from polycnc.mainrun import State
from polycnc.messages.catalogue import LANGUAGES
from polycnc.panel.screens.pages import in_language
from tests.panel.bench import Bench

if TYPE_CHECKING:
    from polycnc.panel.screens.pages import SoftKey

FANUC = ("fanuc-m", "fanuc-0i-tf")
TOOLS = {"tools": {1: {"length": 50.0, "radius": 5.0}}}
PROGRAM = "O1\nN10 G0 X5.\nN20 G1 X40. F600\nN30 X60.\nM30\n"
LATHE = PROGRAM.replace("F600", "G98 F600")


def both(*controls: str) -> list[tuple[str, str]]:
    """Each of these controls in each language."""
    return list(product(controls, LANGUAGES))


def soft(bench: Bench, *texts: str) -> None:
    """Soft keys below or at the side by their English texts, one after the other."""
    screen = bench.screen
    for text in texts:
        for _ in range(6):
            below, side = screen._visible, screen.family.side.get(screen.menu, ())
            if (at := _place(below, text)) >= 0:
                screen.soft(at)
                break
            if (at := _place(side, text)) >= 0:
                screen.side(at)
                break
            screen.press("MENU")
        else:
            raise AssertionError(f"there is no soft key {text} on {screen.page.id}")
        shown = [key.text for key in (*bench.view.soft_keys, *bench.view.side_keys)]
        assert any(shown)


def _place(keys: tuple[SoftKey, ...], text: str) -> int:
    return next((at for at, key in enumerate(keys) if in_language(key.text, "en") == text), -1)


def runs_into(bench: Bench, x: float) -> None:
    """Start the program, and let it run until X is there."""
    bench.press("START")
    while bench.control.positions.work["X"] < x:
        bench.passes(0.05)
    bench.passes(0.05)


# ---- FANUC -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("control", "lang"), both(*FANUC))
def test_fanuc_monitor_and_check_follow_the_program(control: str, lang: str) -> None:
    bench = Bench(control, lang, LATHE if control == "fanuc-0i-tf" else PROGRAM)
    bench.keys("PROG")
    soft(bench, "CHECK")
    runs_into(bench, 20.0)
    assert "N20 G1 X40." in bench.text
    active = [cell.text for row in bench.window("program").rows for cell in row if cell.style == "active"]
    assert len(active) == 1
    assert active[0].startswith("N20")
    bench.keys("POS")
    soft(bench, "MONI")
    assert bench.view.page == "monitor"
    assert f"{bench.control.positions.work['X']:.3f}" in bench.text
    assert bench.control.run() is State.READY


@pytest.mark.parametrize(("control", "lang"), both(*FANUC))
def test_fanuc_parameters_want_the_write_enable(control: str, lang: str) -> None:
    bench = Bench(control, lang)
    bench.keys("SYSTEM")
    soft(bench, "PARAM")
    number = bench.screen.parameters[3][0].split("#")[0].split()[0]
    soft(bench, "(OPRT)")
    bench.typed(number)
    soft(bench, "NO.SRH")
    assert bench.message == ""
    cursor = bench.screen.cursor
    before = bench.text
    bench.typed("1", "INPUT")
    assert bench.message
    assert bench.text == before
    bench.screen.buffer = ""
    bench.screen.writes_parameters = True
    bench.keys("SYSTEM")
    bench.screen.place(*cursor)
    bench.typed("1", "INPUT")
    assert bench.message == ""
    assert float(str(bench.control.read_parameter(bench.screen.parameters[cursor[0]][0]))) == 1.0


@pytest.mark.parametrize(("control", "lang"), both(*FANUC))
def test_fanuc_macro_variables_setting_signals_messages_and_history(control: str, lang: str) -> None:
    bench = Bench(control, lang, "O1\n#3000=7(LOW OIL)\nM30\n")
    bench.keys("OFS/SET")
    soft(bench, "MACRO", "(OPRT)")
    bench.typed("500")
    soft(bench, "NO.SRH")
    bench.typed("12.5", "INPUT")
    assert bench.control.read_variable("#500") == 12.5
    bench.keys("OFS/SET")
    soft(bench, "SETING")
    assert "SINGLE BLOCK" in bench.text or bench.view.page == "setting"
    bench.keys("SYSTEM")
    soft(bench, "PMC")
    assert "MANUAL_ABSOLUTE" in bench.text
    bench.start()
    bench.screen.follow()
    bench.keys("MESSAGE")
    assert "LOW OIL" in bench.text
    soft(bench, "MSG")
    assert bench.view.page == "message"
    bench.keys("RESET")
    bench.keys("MESSAGE")
    soft(bench, "HISTRY")
    assert "3007" in bench.text


# ---- MELDAS ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("lang", LANGUAGES)
def test_meldas_pages(lang: str) -> None:
    bench = Bench("meldas-m", lang, PROGRAM, setup=TOOLS)
    for key in ("POSI", "COORDI", "COMMAND"):
        bench.keys("MONITOR")
        soft(bench, key)
        assert bench.view.title
        assert bench.text
    runs_into(bench, 20.0)
    assert "N20" in bench.text
    bench.control.run()
    bench.keys("TOOL/PARAM")
    soft(bench, "TOOL")
    bench.typed("51.5", "INPUT")
    assert "51.500" in bench.text
    soft(bench, "VARIABLE")
    assert bench.view.page == "variable"
    soft(bench, "PARAM")
    assert bench.view.page == "parameter"
    bench.keys("EDIT/MDI")
    soft(bench, "FILE")
    assert "1" in bench.text
    bench.keys("DIAGN/IN-OUT")
    soft(bench, "I/F")
    assert "MANUAL_ABSOLUTE" in bench.text
    bench.keys("DIAGN/IN-OUT")
    soft(bench, "HISTORY")
    assert bench.view.page == "history"


# ---- SINUMERIK ---------------------------------------------------------------------------------------------------

NC = "N10 G0 X5\nN20 G1 X40 F600\nN30 X60\nM30\n"


@pytest.mark.parametrize("lang", LANGUAGES)
def test_sinumerik_machine_area(lang: str) -> None:
    bench = Bench("sinumerik-840d", lang, NC, setup=TOOLS)
    bench.keys("MACHINE")
    runs_into(bench, 20.0)
    pages = {
        "G functions": "G1", "Auxiliary functions": "G1", "Basic blocks": "N20 G1 X40 F600",
        "Time / counter": "H", "Program levels": "N20 G1 X40 F600", "Act. values MCS": "X", "Act. values WCS": "N20",
        "Act.val. all": "X", "Prog. ctrl": "N20", "Prog. corr.": "N20 G1 X40 F600",
    }  # fmt: skip
    for key, said in pages.items():
        bench.keys("MACHINE")
        soft(bench, key)
        assert said in bench.text, key
    bench.control.run()
    bench.panel.turn("mode", "mdi")
    bench.keys("MACHINE")
    soft(bench, "Overstore")
    bench.typed("G0 X3", "INPUT")
    assert "G0 X3" in bench.text
    bench.press("START")
    bench.control.run()
    assert bench.control.positions.work["X"] == 3.0


@pytest.mark.parametrize("lang", LANGUAGES)
def test_sinumerik_parameter_area(lang: str) -> None:
    bench = Bench("sinumerik-840d", lang, NC, setup=TOOLS)
    bench.keys("MENU SELECT")
    soft(bench, "Parameter", "Tool list")
    assert "50.000" in bench.text
    bench.keys("RIGHT", "RIGHT")
    bench.typed("0.5")
    soft(bench, "Add")
    assert "50.500" in bench.text
    soft(bench, "Tool wear")
    assert bench.view.page == "wear"
    soft(bench, "Magazine")
    assert bench.view.page == "magazine"
    soft(bench, "User variable")
    bench.typed("7")
    soft(bench, "Search")
    bench.typed("1.5")
    soft(bench, "Input")
    assert bench.control.read_variable("R7") == 1.5
    soft(bench, "Setting data")
    bench.typed("42100")
    soft(bench, "Search")
    bench.typed("2500")
    soft(bench, "Input")
    assert bench.message == ""
    assert "2500" in bench.text
    assert bench.control.read_variable("$SC_DRY_RUN_FEED") == 2500.0
    bench.typed("20110")
    soft(bench, "Search")
    assert bench.message, "machine data stand elsewhere"
    bench.screen.buffer = ""
    soft(bench, "Work offset")
    bench.typed("X=-12")
    soft(bench, "Measure")
    assert bench.message == ""
    assert bench.control.read_variable("$P_UIFR[1,X,TR]") == pytest.approx(12.0)
    bench.control.load("G54\nG0 X1\nM0\nM30\n")
    bench.start()
    assert bench.control.positions.machine["X"] == pytest.approx(13.0)
    bench.keys("DOWN")
    bench.typed("X=-12")
    soft(bench, "Measure")  # G55, while G54 is chosen
    assert bench.control.read_variable("$P_UIFR[2,X,TR]") == pytest.approx(25.0)


@pytest.mark.parametrize("lang", LANGUAGES)
def test_sinumerik_programs_diagnostics_and_setup(lang: str) -> None:
    bench = Bench("sinumerik-840d", lang, NC)
    bench.control.store_program("OTHER.MPF", "G0 X7\nM30\n")
    bench.keys("MENU SELECT")
    soft(bench, "Program manager")
    assert "OTHER" in bench.text
    rows = bench.window("listing").rows
    at = next(i for i, row in enumerate(rows) if "OTHER" in row[0].text)
    bench.keys(*["DOWN"] * at)
    soft(bench, "Execute")
    assert bench.start() is State.READY
    assert bench.control.positions.work["X"] == 7.0
    soft(bench, "Delete")
    assert "OTHER" not in bench.text
    bench.keys("MENU SELECT")
    soft(bench, "Program", "Simulation")
    assert bench.view.page == "graph"
    bench.keys("PROGRAM")
    soft(bench, "Edit", "NC")
    assert bench.view.page == "manager"
    bench.keys("MENU SELECT")
    soft(bench, "Diagnostics", "NC/PLC variab.")
    assert "MANUAL_ABSOLUTE" in bench.text
    soft(bench, "Version")
    assert bench.view.page == "version"
    soft(bench, "Alarm log", "Delete log")
    assert bench.control.alarm_history == ()
    bench.keys("MENU SELECT")
    soft(bench, "Setup", "Machine data")
    bench.typed("1", "INPUT")
    assert bench.message
    bench.screen.buffer = ""
    soft(bench, "Password")
    bench.typed("20110")
    soft(bench, "Search")
    bench.typed("65")
    soft(bench, "Input")
    assert bench.message == ""
    assert bench.control.read_variable("$MC_RESET_MODE_MASK") == 65
    assert bench.control.read_parameter("20110") == 65
    assert "65" in bench.text
    bench.control.write_parameter("32020 Y", 1500.0)
    assert bench.control.read_variable("$MA_JOG_VELO[Y]") == 1500.0
    assert bench.control.read_parameter("32020 X") == bench.control.read_variable("$MA_JOG_VELO[X]") != 1500.0


@pytest.mark.parametrize("lang", LANGUAGES)
def test_sinumerik_search_page_finds_texts_and_the_top(lang: str) -> None:
    bench = Bench("sinumerik-840d", lang, NC)
    soft(bench, "Block search")
    bench.typed("X60")
    soft(bench, "Search text")
    assert bench.screen.program_row == 2
    soft(bench, "Go to top")
    assert bench.screen.program_row == 0


# ---- SYNTEC ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("lang", LANGUAGES)
def test_syntec_pages(lang: str) -> None:
    bench = Bench("syntec-mill", lang, PROGRAM, setup=TOOLS)
    soft(bench, "Relative", "Clear rel.", "All", "Absolute", "Back")
    assert bench.view.page == "coordinates"
    soft(bench, "Monitor")
    runs_into(bench, 20.0)
    assert "N20" in bench.text
    bench.control.run()
    bench.keys("COOR")
    soft(bench, "Back", "Next", "PLC state")
    assert "MANUAL_ABSOLUTE" in bench.text
    soft(bench, "Back", "Offset/Set", "Variables")
    bench.typed("7")
    soft(bench, "Search")
    bench.typed("3.5")
    soft(bench, "Input")
    assert float(str(bench.control.read_variable("@7"))) == 3.5
    soft(bench, "Tool set")
    assert "50.000" in bench.text
    soft(bench, "Back", "Program", "Files")
    assert "1" in bench.text
    soft(bench, "Back", "Diagnose", "Alarm", "History", "Clear", "Signals")
    assert bench.control.alarm_history == ()
    soft(bench, "Back", "Parameter")
    bench.typed("1", "INPUT")
    assert bench.message
    bench.screen.buffer = ""
    soft(bench, "Password")
    bench.typed("411")
    soft(bench, "Search")
    bench.typed("1", "INPUT")
    assert bench.control.read_parameter("411") == 1


@pytest.mark.parametrize("control", ["fanuc-0i-tf", "sinumerik-840d", "syntec-mill"])
def test_keys_of_the_plain_panel_are_switches_with_lamps(control: str) -> None:
    bench = Bench(control, "en", NC if control == "sinumerik-840d" else LATHE)
    for key, switch in (("SINGLE", "single_block"), ("DRY_RUN", "dry_run"), ("MACHINE_LOCK", "machine_lock")):
        bench.press(key)
        assert getattr(bench.control.switches, switch)
        bench.press(key)
        assert not getattr(bench.control.switches, switch)
    bench.press("MACHINE_LOCK")
    assert bench.start() is State.READY
    assert bench.control.positions.real["X"] == 0.0
