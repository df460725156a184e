"""Journeys that came later: status line, diagnosis, handle, setting, background editing, units, PRESET, version."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import pytest

from polycnc.mainrun import Mode, State
from polycnc.messages.catalogue import LANGUAGES
from tests.panel.bench import Bench
from tests.panel.screens.test_journeys import FANUC, both, soft

if TYPE_CHECKING:
    from pathlib import Path

LATHE = "fanuc-0i-tf"


def status(bench: Bench) -> list[str]:
    """The status line without the time of day."""
    return [cell.text for cell in bench.view.status][:5]


def diagnosis(bench: Bench) -> set[str]:
    """The numbers of what is so now."""
    return {row[0].text for row in bench.window("diagnosis").rows if row[2].text == "1"}


#: What a block does, what the status line says of it, which diagnosis is 1.
DOES = {
    "G1 X40. F600": ("MTN", "***", {"0001"}),
    "G4 X2.": ("DWL", "***", {"0002"}),
    "M6": ("***", "FIN", {"0000"}),
}


@pytest.mark.parametrize(("block", "lang"), list(product(DOES, LANGUAGES)))
def test_status_line_and_diagnosis_tell_what_is_waited_for(block: str, lang: str) -> None:
    motion, fin, numbers = DOES[block]
    program = f"O1\nT2\n{block}\nM30\n"
    bench = Bench("fanuc-m", lang, program)
    bench.keys("SYSTEM")
    soft(bench, "DGNOS")
    assert diagnosis(bench) == set()
    bench.press("START")
    bench.passes(0.8)
    assert status(bench) == ["MEM", "STRT", motion, fin, "***"]
    assert diagnosis(bench) == numbers


@pytest.mark.parametrize(("control", "lang"), both(*FANUC))
def test_an_axis_that_is_moved_by_hand_is_motion_and_stands_on_the_handle_page(
    control: str, lang: str
) -> None:
    program = "O1\nG98 G1 X40. F600\nM30\n" if control == LATHE else "O1\nG1 X40. F600\nM30\n"
    bench = Bench(control, lang, program)
    bench.press("START")
    bench.passes(1.0)
    bench.press("HOLD")
    bench.control.run()
    bench.panel.turn("mode", "jog")
    bench.press("Z+")
    bench.passes(0.3)
    assert status(bench)[:3] == ["JOG", "HOLD", "MTN"]
    bench.release("Z+")
    bench.control.run()
    assert status(bench)[2] == "***"
    moved = bench.control.positions.work["Z"]
    assert moved > 1.0
    bench.keys("POS")
    soft(bench, "HNDL")
    rows = next(
        each for each in bench.view.windows if each.title == bench.says("MOVED BY HAND", "手動移動量")
    ).rows
    assert {row[0].text: row[1].text for row in rows}["Z"] == f"{moved:.3f}"


@pytest.mark.parametrize(("control", "lang"), both(*FANUC))
def test_parameter_write_is_set_on_the_setting_page(control: str, lang: str) -> None:
    bench = Bench(control, lang)
    bench.keys("OFS/SET")
    soft(bench, "SETING")
    bench.typed("1", "INPUT")
    assert bench.message
    assert not bench.control.switches.single_block
    bench.keys("CAN", *["DOWN"] * 9)
    bench.typed("2", "INPUT")
    assert bench.message
    bench.keys("CAN")
    bench.typed("1", "INPUT")
    assert bench.message == ""
    (row,) = (
        row
        for row in bench.window("switches").rows
        if row[0].text == bench.says("PARAMETER WRITE", "參數寫入")
    )
    assert (row[1].text, row[1].cursor) == ("1", True)
    bench.keys("SYSTEM")
    bench.screen.place(3, 0)
    bench.typed("1", "INPUT")
    assert bench.message == ""


@pytest.mark.parametrize("lang", LANGUAGES)
def test_program_control_of_sinumerik_turns_switches_over(lang: str) -> None:
    bench = Bench("sinumerik-840d", lang)
    bench.keys("MACHINE")
    soft(bench, "Prog. ctrl")
    bench.keys("DOWN", "SELECT")
    assert bench.control.switches.optional_stop
    bench.keys("SELECT")
    assert not bench.control.switches.optional_stop


# ---- background editing ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("control", "lang"), both(*FANUC))
def test_a_program_is_edited_while_another_one_runs(control: str, lang: str) -> None:
    program = "O1\nG98 G1 X40. F600\nM30\n" if control == LATHE else "O1\nG1 X40. F600\nM30\n"
    bench = Bench(control, lang, program)
    bench.control.store_program("O0002", "O2\nG0 X5.\nM30\n")
    bench.press("START")
    bench.passes(0.5)
    bench.keys("PROG")
    soft(bench, "(OPRT)")
    bench.typed("O1")
    soft(bench, "BG-EDT")
    assert bench.message, "the program that runs is not changed"
    bench.screen.buffer = "O2"
    soft(bench, "BG-EDT")
    assert bench.message == ""
    assert "(BG-EDIT)" in bench.view.title
    assert "G0" in bench.text
    bench.keys("DOWN", "RIGHT")
    bench.typed("X7.", "ALTER")
    bench.passes(0.2)
    bench.typed("F100", "INSERT")
    assert bench.message == ""
    assert bench.control.program_lines("O0002")[1] == "G0 X7. F100"
    assert bench.control.mode is Mode.AUTO
    assert bench.control.state is State.RUNNING
    bench.typed("O3", "INSERT")
    bench.typed(";", "INSERT")
    bench.typed("G0 X1.;", "INSERT")
    assert bench.control.program_lines("O0003")[:2] == ["O3", "G0 X1."]
    bench.keys("PROG")
    soft(bench, "(OPRT)", "BG-END")
    assert "(BG-EDIT)" not in bench.view.title
    assert "X40." in bench.text
    assert bench.control.run() is State.READY
    assert bench.control.program in ("O0001", "O1")
    if control == "fanuc-m":
        bench.panel.turn("edit_protect", "on")
        bench.screen.buffer = "O2"
        soft(bench, "BG-EDT")
        assert bench.message, "edit protection"


@pytest.mark.parametrize(("control", "lang"), list(product(("fanuc-m", "sinumerik-840d"), LANGUAGES)))
def test_a_subprogram_from_a_folder_is_shown_around_its_block(
    control: str, lang: str, tmp_path: Path
) -> None:
    name, call, end = ("O2.nc", "M98 P2", "M99") if control == "fanuc-m" else ("SUB.SPF", "SUB", "RET")
    head = "O2\n" if control == "fanuc-m" else ""
    (tmp_path / name).write_text(f"{head}N1 G1 X10. F600\nN2 X20.\nN3 X30.\n{end}\n", encoding="utf-8")
    main = f"O1\n{call}\nM30\n" if control == "fanuc-m" else f"{call}\nM30\n"
    bench = Bench(control, lang, main, search=[tmp_path])
    bench.press("START")
    assert bench.control.run_until(lambda each: each.active_block.text.startswith("N2"), limit_s=20.0)
    bench.keys("PROG" if control == "fanuc-m" else "MACHINE")
    shown = [(cell.text, cell.style) for row in bench.window("program").rows for cell in row]
    assert ("N2 X20.", "active") in shown
    assert ("N1 G1 X10. F600", "code") in shown
    assert ("N3 X30.", "code") in shown


# ---- units, PRESET, version ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("control", ["meldas-m", "fanuc-m"])
def test_units_of_parameters_are_told_in_the_language(control: str) -> None:
    shown = {}
    for lang in LANGUAGES:
        bench = Bench(control, lang)
        bench.screen.show("parameter")
        at = next(i for i, (_, each) in enumerate(bench.screen.parameters) if each.unit == "degrees/min")
        bench.screen.place(at, 0)
        (row,) = (row for row in bench.window("parameters").rows if row[1].cursor)
        shown[lang] = row[2].text
    assert shown == {"en": "degrees/min", "zh-TW": "度/min"}


@pytest.mark.feature("sie.b.modes", control="sinumerik-840d")
@pytest.mark.parametrize("lang", LANGUAGES)
def test_preset_on_the_machine_page(lang: str) -> None:
    bench = Bench("sinumerik-840d", lang)
    bench.keys("MACHINE")
    bench.typed("X=10")
    soft(bench, "Preset")
    assert bench.message, "in AUTO"
    bench.screen.buffer = ""
    bench.panel.turn("mode", "jog")
    bench.typed("X")
    soft(bench, "Preset")
    assert bench.message, "without a value"
    bench.typed("=10.5")
    soft(bench, "Preset")
    assert bench.message == ""
    assert bench.control.positions.machine["X"] == 10.5
    assert "10.500" in bench.text


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_version_page_names_control_and_machine(lang: str) -> None:
    bench = Bench("sinumerik-840d", lang)
    bench.keys("ALARM")
    soft(bench, "Version")
    assert "sinumerik-840d" in bench.text
    assert bench.control.machine.id in bench.text


# ---- programs block by block -----------------------------------------------------------------------------------------

BLOCKS = {
    "sinumerik-840d": ("N10 G0 X5\nN20 G0 X9\nM30\n", ("PROGRAM",), "G0 X7"),
    "syntec-mill": ("O1\nN10 G0 X5.\nN20 G0 X9.\nM30\n", ("PROG",), "G0 X7."),
    "meldas-m": ("O1\nN10 G0 X5.\nN20 G0 X9.\nM30\n", ("EDIT/MDI",), "G0 X7."),
}


@pytest.mark.parametrize(("control", "lang"), list(product(BLOCKS, LANGUAGES)))
def test_a_program_is_changed_block_by_block(control: str, lang: str) -> None:
    program, page, block = BLOCKS[control]
    bench = Bench(control, lang, program)
    bench.keys(*page)
    name = bench.control.program
    before = list(bench.control.program_lines(name))
    bench.typed("N20", "DOWN")
    bench.screen.buffer = ""
    bench.typed(block, "INPUT")
    assert bench.message == ""
    lines = list(bench.control.program_lines(name))
    at = before.index(next(each for each in before if each.startswith("N20")))
    assert lines[at + 1].startswith(block)
    assert len(lines) == len(before) + 1
    assert bench.start() is State.READY
    assert bench.control.positions.work["X"] == 7.0
    bench.typed(block, "DOWN")
    bench.screen.buffer = ""
    bench.keys("RUBOUT" if control == "meldas-m" else "DELETE")
    assert bench.message == ""
    assert list(bench.control.program_lines(name)) == before
    assert bench.start() is State.READY
    assert bench.control.positions.work["X"] == 9.0
    if control != "sinumerik-840d":
        bench.typed("O7", "INPUT")
        assert bench.message, "no further program"
    bench.screen.buffer = ""
    bench.press("START")
    bench.passes(0.05)
    bench.typed(block, "INPUT")
    assert bench.message, "a program that runs is not changed"
    assert list(bench.control.program_lines(name)) == before


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_magazine_page_tells_the_tools(lang: str) -> None:
    bench = Bench("sinumerik-840d", lang, "T3\nM30\n", setup={"tools": {3: {"length": 1.0}}})
    bench.start()
    bench.keys("OFFSET")
    soft(bench, "Magazine")
    rows = {row[0].text: row[1].text for row in bench.window("magazine").rows}
    assert rows[bench.says("Spindle", "主軸")] == "3"
    assert int(rows[bench.says("Places", "刀套數")]) > 0


# ---- increments, teach-in, DRF ---------------------------------------------------------------------------------------

PLAIN = {"fanuc-0i-tf": "PROG", "sinumerik-840d": "PROGRAM", "syntec-mill": "PROG"}


@pytest.mark.parametrize(("control", "lang"), list(product(PLAIN, LANGUAGES)))
def test_axis_keys_go_by_steps_in_increment_mode(control: str, lang: str) -> None:
    bench = Bench(control, lang)
    bench.turn("mode", "increment")
    bench.turn("handle_step", "x100")
    for _ in range(3):
        bench.press("Z-")
        bench.control.run()
    assert bench.control.positions.machine["Z"] == pytest.approx(-0.3)
    assert bench.message == ""
    bench.turn("mode", "auto")
    bench.press("Z-")
    assert bench.message


@pytest.mark.parametrize(("control", "lang"), list(product(PLAIN, LANGUAGES)))
def test_positions_are_taught_into_the_program(control: str, lang: str) -> None:
    bench = Bench(control, lang, "G0 X1\nM30\n" if control == "sinumerik-840d" else "O1\nG0 X1.\n")
    bench.turn("mode", "teach")
    bench.keys(PLAIN[control])
    bench.press("X+")
    bench.passes(0.5)
    bench.release("X+")
    bench.control.run()
    at = bench.control.positions.work["X"]
    bench.typed("G1", "INSERT")
    assert bench.message == ""
    taught = [each for each in bench.control.program_lines(bench.control.program) if each.startswith("G1")]
    assert len(taught) == 1
    assert f"X{at:.4f}".rstrip("0") in taught[0]


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_handwheel_shifts_an_axis_beside_the_program(lang: str) -> None:
    bench = Bench("sinumerik-840d", lang, "G1 X40 F600\nM30\n")
    bench.keys("MACHINE")
    soft(bench, "Prog. ctrl")
    bench.wheel(1)
    assert bench.message, "neither DRF nor the mode of the handwheel"
    bench.keys(*["DOWN"] * 9, "SELECT")
    assert bench.control.switches.drf
    (row,) = (row for row in bench.window("switches").rows if row[0].text.endswith("(DRF)"))
    assert row[1].text == "1"
    bench.press("START")
    bench.passes(0.5)
    bench.turn("handle_axis", "Z")
    bench.turn("handle_step", "x100")
    bench.wheel(10)
    assert bench.message == ""
    assert bench.control.run() is State.READY
    assert bench.control.positions.work["Z"] == 0.0
    assert bench.control.positions.machine["Z"] == pytest.approx(1.0)
