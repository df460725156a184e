"""SINUMERIK's forms: user cycles (1.25.4), dialogs of the program (14.7), the step view (2.3)."""

from __future__ import annotations

import pytest

from polycnc.mainrun import State
from polycnc.panel.screens.masks import filled, masks_of, overview_of
from tests.panel.bench import Bench

LANGS = ["en", "zh-TW"]
COV = (
    "%_N_COV_COM\n;$PATH=/_N_CUS_DIR\n;V1 overview\nC25 (MY_CYCLE_1) usercycle_1\nC26 (SPECIAL CYCLE)\nM17\n"
)
UC = """;$PATH=/_N_CUS_DIR
//C25 (MY_CYCLE_1) usercycle_1
(R/-1000.001 123.456 / 100 /Parameter_2 of cycle)
(I/0 999999 / 1 / Integer value)
(C/"A" / Character parameter)
(S//Subprogram name)
//C26 (SPECIALCYCLE)
(R//Entire length)
(I/*123456/3/Machining type)
M17
"""
CYCLES = {"/_N_CUS_DIR/_N_COV_COM": COV, "/_N_CUS_DIR/_N_UC_COM": UC}


def bench_of(lang: str, program: str = "", **files: str) -> Bench:
    return Bench("sinumerik-840d", lang, program, files={**CYCLES, **files})


def side(bench: Bench, *texts: str) -> None:
    """A soft key at the side, by its text in each language."""
    bench.screen.side([key.text for key in bench.view.side_keys].index(bench.says(*texts)))


# ---- masks -------------------------------------------------------------------------------------------------------


def test_a_description_says_type_limits_preset_and_label_of_every_field() -> None:
    first, second = masks_of(UC.splitlines())
    assert [(each.kind, each.limits, each.preset, each.label) for each in first.fields] == [
        ("R", (-1000.001, 123.456), "100", "Parameter_2 of cycle"),
        ("I", (0.0, 999999.0), "1", "Integer value"),
        ("C", None, "A", "Character parameter"),
        ("S", None, "", "Subprogram name"),
    ]
    assert second.fields[0].limits is None
    assert second.fields[1].choices == tuple("123456")
    assert filled(first).call == 'MY_CYCLE_1(100,1,"A")'
    assert filled(second).call == "SPECIALCYCLE(,3)"
    assert [(each.number, each.name, each.comment) for each in overview_of(COV.splitlines())] == [
        ("25", "MY_CYCLE_1", "usercycle_1"),
        ("26", "SPECIAL CYCLE", ""),
    ]


def test_a_label_has_fifty_characters() -> None:
    (mask,) = masks_of(["//C1 (LONG) x", f"(R/1 2/1/{'a' * 60})"])
    assert mask.fields[0].label == "a" * 50


# ---- user cycles -------------------------------------------------------------------------------------------------


@pytest.mark.feature("sie.cyc.user-menus", control="sinumerik-840d")
@pytest.mark.parametrize("lang", LANGS)
def test_a_cycle_of_the_user_is_chosen_filled_in_and_called(lang: str) -> None:
    cycle = "PROC MY_CYCLE_1(REAL A,INT B,CHAR C,STRING[10] D)\nR1=A R2=B\nM17\n"
    bench = bench_of(lang, "G0 X0\nM30\n", **{"/_N_CUS_DIR/_N_MY_CYCLE_1_SPF": cycle})
    bench.keys("PROGRAM")
    bench.soft("User cycles", "使用者循環")
    assert "C25 MY_CYCLE_1 usercycle_1" in bench.text
    assert "C26 SPECIAL CYCLE" in bench.text
    side(bench, "Open", "開啟")
    assert "Parameter_2 of cycle 100" in bench.text
    bench.typed("200", "INPUT")  # beyond 123.456
    assert bench.message
    assert "Parameter_2 of cycle 100" in bench.text
    bench.screen.buffer = ""
    bench.typed("12.5", "INPUT", "DOWN")
    bench.typed("7.5", "INPUT")  # not a whole number
    assert bench.message
    bench.screen.buffer = ""
    bench.typed("7")
    side(bench, "Input", "輸入")
    bench.keys("DOWN")
    bench.typed("XY", "INPUT")  # two characters
    assert bench.message
    bench.screen.buffer = ""
    bench.keys("DOWN")
    bench.typed("SUB", "INPUT")
    side(bench, "OK", "確認")
    assert bench.view.page == "program"
    assert 'MY_CYCLE_1(12.5,7,"A","SUB")' in bench.text
    assert bench.control.program_lines(bench.control.program)[1] == 'MY_CYCLE_1(12.5,7,"A","SUB")'
    assert bench.start() is State.READY
    assert (bench.control.read_variable("R1"), bench.control.read_variable("R2")) == (12.5, 7.0)


@pytest.mark.parametrize("lang", LANGS)
def test_the_toggle_key_offers_the_values_of_the_list_alone(lang: str) -> None:
    bench = bench_of(lang, "M30\n")
    bench.keys("PROGRAM")
    bench.soft("User cycles", "使用者循環")
    bench.keys("DOWN")
    side(bench, "Open", "開啟")
    bench.keys("DOWN", "SELECT")
    assert "Machining type 4" in bench.text
    side(bench, "Select", "選擇")
    bench.keys("SELECT", "SELECT")
    assert "Machining type 1" in bench.text  # 6 is the last one
    bench.typed("7", "INPUT")
    assert bench.message
    bench.screen.buffer = ""
    bench.keys("UP", "SELECT")
    assert bench.message
    side(bench, "Cancel", "取消")
    assert bench.view.page == "cycles"
    assert list(bench.control.program_lines(bench.control.program)) == ["M30"]


def test_without_files_there_is_nothing_to_open() -> None:
    bench = Bench("sinumerik-840d", "en", "M30\n")
    bench.keys("PROGRAM")
    bench.soft("User cycles", "使用者循環")
    side(bench, "Open", "開啟")
    assert "COV.COM" in bench.message


# ---- dialogs -----------------------------------------------------------------------------------------------------

COM = """;$PATH=/_N_CUS_DIR
//C1 (BILD) Load the part
(R/0 50/5/Depth/R5)
(I/*123/1/Side)
M17
"""
FILES = {
    "/_N_CUS_DIR/_N_T_SK_COM": COM,
    "_N_MGUD_DEF": 'DEF NCK STRING[20] LINE1="CLAMP"\nDEF NCK INT TEST_1\nM30\n',
}
CALL = 'MMC("CYCLES,PICTURE_ON,T_SK.COM,BILD,MGUD.DEF,BILD_3.AWB,TEST_1,LINE1","{}")\n'


@pytest.mark.feature("sie.mmc", control="sinumerik-840d")
@pytest.mark.parametrize("lang", LANGS)
def test_a_program_shows_a_dialog_and_waits_for_ok(lang: str) -> None:
    bench = bench_of(lang, "G1 X5 F1000\n" + CALL.format("S") + "X=R5 F5000\nM30\n", **FILES)
    bench.keys("MACHINE")
    bench.press("START")
    bench.passes(0.1)
    assert bench.view.page == "machine"  # the axes are not there yet
    bench.control.run()
    bench.passes(0.1)
    assert bench.view.page == "dialog"
    for said in ("T_SK.COM", "BILD", "CLAMP", "BILD_3.AWB", "Depth", "Side 1"):
        assert said in bench.text
    assert bench.says("acknowledge with OK", "請以「確認」鍵確認") in bench.text
    bench.typed("60", "INPUT")
    assert bench.message
    bench.screen.buffer = ""
    bench.typed("42", "INPUT")
    assert bench.control.read_variable("R5") == 42.0
    assert bench.control.state is State.STOPPED
    side(bench, "OK", "確認")
    assert bench.view.page == "machine"
    assert bench.control.run() is State.READY
    assert bench.control.positions.work["X"] == 42.0
    assert bench.control.read_variable("TEST_1") == 1


@pytest.mark.parametrize("lang", LANGS)
def test_a_dialog_that_nobody_waits_for_goes_with_picture_off_or_its_time(lang: str) -> None:
    off = 'MMC("CYCLES,PICTURE_OFF","N")\n'
    bench = bench_of(lang, CALL.format("N") + "G4 F5\n" + off + "G4 F5\nM30\n", **FILES)
    bench.keys("ALARM")
    bench.press("START")
    bench.passes(1.0)
    assert bench.view.page == "dialog"
    side(bench, "OK", "確認")
    assert bench.message
    bench.passes(5.0)
    assert bench.view.page == "alarms"
    bench.control.run()
    shown = CALL.replace("TEST_1", "2").format("N")
    bench.control.load(shown + "G4 F9\nM30\n")
    bench.press("START")
    bench.passes(1.0)
    assert bench.view.page == "dialog"
    bench.passes(2.1)
    bench.passes(0.1)
    assert bench.view.page == "alarms"


def test_an_asynchronous_acknowledgement_sets_its_variable_while_the_program_runs() -> None:
    bench = bench_of("en", CALL.format("A") + "G4 F2\nR1=TEST_1\nG4 F1\nM30\n", **FILES)
    bench.press("START")
    bench.passes(1.0)
    assert bench.control.read_variable("TEST_1") == 0
    side(bench, "OK", "確認")
    bench.control.run()
    assert bench.control.read_variable("TEST_1") == 1


def test_a_dialog_without_its_file_says_so_and_a_reset_takes_it_away() -> None:
    bench = Bench("sinumerik-840d", "en", 'MMC("CYCLES,PICTURE_ON,X.COM,B","S")\nM30\n')
    bench.press("START")
    bench.control.run()
    bench.passes(0.1)
    assert "X.COM is not in the cycle directory" in bench.text
    bench.keys("RESET")
    bench.passes(0.1)
    assert bench.view.page == "machine"


@pytest.mark.parametrize(
    ("call", "code"),
    [
        ('MMC("CYCLES,PICTURE_ON,T_SK.COM","S")', "14020"),
        ('MMC("CYCLES,PICTURE_UP,T_SK.COM,BILD","S")', "14020"),
        ('MMC("CYCLES,PICTURE_ON,T_SK.COM,BILD","X")', "14020"),
        ("MMC()", "14020"),
        ('MMC("POPUPDLG,PICTURE_ON,T_SK.COM,BILD","S")', "PC0001"),
    ],
)
def test_what_is_no_dialog_alarms(call: str, code: str) -> None:
    bench = bench_of("en", f"{call}\nM30\n", **FILES)
    bench.start()
    assert bench.alarms() == [code]


# ---- the step view -----------------------------------------------------------------------------------------------

STEPS = """SEFORM("ROUGHING",0,"")
G1 X5 F1000
N20 SEFORM("Pocket 1",1,"ICON")
X10
SEFORM("FINISHING",0,"")
X20
M30
"""


@pytest.mark.feature("sie.lang.seform", control="sinumerik-840d")
@pytest.mark.parametrize("lang", LANGS)
def test_sections_stand_in_the_step_view_by_level_with_the_one_that_runs(lang: str) -> None:
    bench = bench_of(lang, STEPS)
    bench.keys("PROGRAM")
    bench.soft("Steps", "步驟")
    rows = [[cell.text for cell in row] for row in bench.window("steps").rows]
    assert rows == [["1", "ROUGHING"], ["3", "    Pocket 1"], ["5", "FINISHING"]]
    bench.press("START")
    bench.passes(0.1)
    assert bench.window("steps").rows[0][1].text == "ROUGHING"  # prepared is more, but the axes are here
    while bench.control.positions.work["X"] < 7.0:
        bench.passes(0.05)
    assert bench.window("steps").rows[0][1].text == "Pocket 1"
    assert [row[1].style for row in bench.window("steps").rows[1:]] == ["code", "active", "code"]
    bench.control.run()
    assert len(bench.window("steps").rows) == 3  # the end of the program takes the name away
    bench.keys("DOWN", "DOWN")
    side(bench, "Go to", "前往")
    assert bench.view.page == "program"
    assert bench.screen.program_row == 4
