"""Block search and program restart on the pages of every family, in both languages."""

from __future__ import annotations

from itertools import product

import pytest

from polycnc.mainrun import CommandRefused, Record, State
from polycnc.messages.catalogue import LANGUAGES
from tests.panel.bench import Bench

PROGRAM = "O1\nM3 S500\nT2 M8\nG0 X10. Z-3.\nN7 G1 X50. F600\nG1 X60.\nM30\n"
SINUMERIK = "M3 S500\nT2 M8 D0\nG0 X10 Z-3\nN7 G1 X50 F600\nG1 X60\nM30\n"
LATHE = PROGRAM.replace("T2", "T0202").replace("F600", "F2.")
FAMILIES = ("fanuc-0i-tf", "sinumerik-840d", "syntec-mill")


def bench_of(control: str, lang: str) -> Bench:
    tools = {"tools": {2: {"length": 0.0}}} if control == "sinumerik-840d" else {}
    return Bench(
        control,
        lang,
        setup=tools,
        program={"sinumerik-840d": SINUMERIK, "fanuc-0i-tf": LATHE}.get(control, PROGRAM),
    )


def side(panel: Bench, *texts: str) -> None:
    """A soft key at the side of the screen."""
    wanted = panel.says(*texts)
    panel.screen.side([key.text for key in panel.view.side_keys].index(wanted))


def open_search(panel: Bench) -> None:
    """The page of the search."""
    match panel.control.control.id:
        case "sinumerik-840d":
            panel.soft("Block search", "單節搜尋")
        case "syntec-mill":
            panel.keys("PROG")
            panel.soft("Restart", "中斷點返回")
        case _:
            panel.keys("PROG")
            panel.soft("(OPRT)", "(操作)")


def search(panel: Bench, typed: str = "") -> None:
    """The search itself, and the page that tells what it has found."""
    panel.screen.type(typed)
    match panel.control.control.id:
        case "sinumerik-840d":
            side(panel, "Start search", "開始搜尋")
        case "syntec-mill":
            panel.soft("N search", "N 搜尋")
        case _:
            panel.soft("N SRH", "N 檢索")
            panel.keys("PROG")
            panel.soft("RSTR", "再開始")


@pytest.mark.parametrize(("control", "lang"), list(product(FAMILIES, LANGUAGES)))
def test_a_search_shows_where_and_with_what_the_program_goes_on(control: str, lang: str) -> None:
    panel = bench_of(control, lang)
    open_search(panel)
    search(panel, "N7")
    assert panel.message == ""
    shown = panel.window("restart").text
    tool = "T2"
    assert "X 10.000" in shown
    assert shown.splitlines()[-1] == f"{panel.says('PUT OUT AT START', '啟動時輸出')} M3 S500 {tool} M8"
    panel.press("START")
    panel.passes(0.5)
    assert panel.control.spindle.rpm > 0.0
    assert panel.control.run() is State.READY
    assert panel.control.positions.work["X"] == pytest.approx(60.0)
    assert panel.control.positions.work["Z"] == pytest.approx(-3.0)


@pytest.mark.parametrize(("control", "lang"), list(product(FAMILIES, LANGUAGES)))
def test_a_search_begins_at_the_cursor(control: str, lang: str) -> None:
    panel = bench_of(control, lang)
    open_search(panel)
    panel.typed("X60", "DOWN")
    assert panel.screen.program_row == panel.screen.shown_program[1].index(
        "G1 X60" if control == "sinumerik-840d" else "G1 X60."
    )
    panel.keys("CAN", "CAN", "CAN", "UP")
    (row,) = (row for row in panel.window("program").rows if row[0].cursor)
    assert row[0].text.startswith("N7")
    search(panel)
    assert panel.control.restart["X"][0] == pytest.approx(10.0)
    assert panel.screen.program_row is None


@pytest.mark.parametrize(("control", "lang"), list(product(("sinumerik-840d", "syntec-mill"), LANGUAGES)))
def test_after_a_reset_the_search_finds_the_point_of_interruption(control: str, lang: str) -> None:
    panel = bench_of(control, lang)
    panel.press("START")
    assert panel.control.run_until(lambda control: control.active_block.text[:2] == "N7", limit_s=60.0)
    panel.passes(0.5)
    panel.control.reset()
    panel.control.run()
    open_search(panel)
    if control == "sinumerik-840d":
        side(panel, "Interrupt. point", "中斷點")
    else:
        panel.soft("Break point", "中斷點")
    search(panel)
    assert panel.message == ""
    assert panel.control.restart["X"][0] == pytest.approx(10.0)


@pytest.mark.parametrize("lang", LANGUAGES)
def test_blocks_of_mdi_leave_the_point_of_interruption(lang: str) -> None:
    panel = bench_of("sinumerik-840d", lang)
    panel.press("START")
    assert panel.control.run_until(lambda control: control.active_block.text[:2] == "N7", limit_s=60.0)
    panel.control.reset()
    panel.control.run()
    panel.turn("mode", "mdi")
    panel.control.mdi("G0 Z50\nM30")
    assert panel.control.run() is State.READY
    panel.turn("mode", "auto")
    open_search(panel)
    side(panel, "Interrupt. point", "中斷點")
    assert panel.message == ""
    (row,) = (row for row in panel.window("program").rows if row[0].cursor)
    assert row[0].text.startswith("N7")


def test_another_program_is_shown_from_its_top() -> None:
    panel = bench_of("fanuc-0i-tf", "en")
    panel.control.store_program("O0002", "O2\nG0 X5.\nM30\n")
    panel.keys("PROG", "PAGE_DOWN")
    panel.soft("(OPRT)", "(操作)")
    panel.screen.type("O2")
    panel.soft("O SRH", "O 檢索")
    assert panel.message == ""
    assert panel.screen.program_row is None
    assert panel.window("program").rows[0][0].text == "O2"


def test_a_text_that_is_not_there_is_refused_and_the_cursor_stays() -> None:
    panel = bench_of("fanuc-0i-tf", "en")
    panel.keys("PROG", "DOWN", "DOWN")
    panel.typed("X99", "DOWN")
    assert panel.message == "X99 was not found"
    assert panel.screen.program_row == 2
    panel.keys("CAN", "CAN", "CAN", "PAGE_DOWN", "PAGE_DOWN")
    assert panel.screen.program_row == 6
    panel.press("START")
    panel.passes(0.1)
    assert panel.screen.program_row is None


# ---- kinds of search ---------------------------------------------------------------------------------------------

KINDS = {
    "contour": ("With calc. contour", "計算至輪廓"),
    "end-point": ("With calc. end point", "計算至終點"),
    "without-calculation": ("Without calculation", "不計算"),
}
#: Where cycle start leads the axes, whether the spindle then turns, the line that runs first, R1 at the end.
LED = {"contour": (10.0, 1, 5, 2.0), "end-point": (50.0, 1, 7, 2.0), "without-calculation": (3.0, 0, 5, 1.0)}
COUNTED = "DEF REAL WAY=60\nM3 S500\nR1=1\nG0 X10 Z-3\nN7 G1 X50 F600\nR1=R1+1\nN8 G1 X=WAY F600\nM30\n"


@pytest.mark.parametrize(("lang", "kind"), list(product(LANGUAGES, KINDS)))
def test_sinumerik_searches_to_the_contour_to_the_end_point_or_without_calculation(
    lang: str, kind: str
) -> None:
    panel = Bench("sinumerik-840d", lang, setup={"start": {"X": 3.0}}, program=COUNTED)
    control = panel.control
    panel.soft("Block search", "單節搜尋")
    side(panel, *KINDS[kind])
    chosen = [key.text for key in panel.view.side_keys if key.active]
    assert chosen == [panel.says(*KINDS[kind])]
    search(panel, "N7")
    assert control.state is State.STOPPED
    assert control.positions.machine["X"] == 3.0  # nothing has moved
    place, turns, line, counted = LED[kind]
    seen: list[tuple[int, float, int]] = []

    def look(record: Record) -> None:
        if record.what == "block":
            at = control.positions.machine["X"]
            seen.append((int(str(record.data["line"])), at, control.spindle.direction))

    control.listeners.append(look)
    panel.press("START")
    assert control.run() is State.READY
    assert (seen[0][0], seen[0][2]) == (line, turns)
    assert seen[0][1] == pytest.approx(place)
    assert control.positions.machine["X"] == pytest.approx(60.0)
    assert control.read_variable("R1") == counted


def test_a_search_beyond_the_program_is_refused_in_every_kind() -> None:
    panel = Bench("sinumerik-840d", "en", program=COUNTED)
    for kind in KINDS:
        with pytest.raises(CommandRefused):
            panel.control.block_search(99, how=kind)
        assert panel.control.state is State.READY
    with pytest.raises(CommandRefused):
        panel.control.block_search(2, how="serupro")


# ---- with program test -------------------------------------------------------------------------------------------

#: An action counts cycles, a wait lasts, a jump leads there: what a search with calculation does not see.
TESTED = (
    "R1=0\nID=1 EVERY $AA_IM[X]>4 DO $AC_MARKER[1]=7\nM3 S500\nM8\nT2 D0\nG0 X10 Z-3\n"
    "N7 G1 X50 F600\nG4 F1\nR1=R1+1 R2=$P_ISTEST\nN8 G1 X=60 F600\nSTOPRE\nR3=$P_ISTEST\nM30\n"
)


@pytest.mark.parametrize("lang", LANGUAGES)
def test_a_search_with_program_test_runs_the_program_while_the_axes_stand(lang: str) -> None:
    panel = Bench(
        "sinumerik-840d",
        lang,
        setup={"start": {"X": 3.0}, "tools": {2: {"length": 0.0}}},
        program=TESTED,
    )
    control = panel.control
    panel.soft("Block search", "單節搜尋")
    side(panel, "With prog. test", "程式測試")
    search(panel, "N8")
    assert control.state is State.RUNNING
    began = control.time
    assert control.run() is State.STOPPED
    assert control.time - began > 1.0, "the dwell lasts"
    assert (control.positions.real["X"], control.positions.machine["X"]) == (3.0, 3.0)
    assert (control.read_variable("R1"), control.read_variable("$AC_MARKER[1]")) == (1.0, 7)
    assert (control.signals["COOLANT_ON"], control.spindle.direction) == (0.0, 1)
    assert control.restart["X"] == pytest.approx((50.0, 47.0))
    assert control.collected == ("M3", "S500", "M8", "T2")
    assert control.active_block.text == "N8 G1 X=60 F600"
    panel.press("START")
    assert control.run() is State.READY
    assert control.positions.machine == pytest.approx({"X": 60.0, "Y": 0.0, "Z": -3.0})
    assert (control.read_variable("R1"), control.snapshot.parts) == (1.0, 1)
    assert (control.read_variable("R2"), control.read_variable("R3")) == (1.0, 0.0)


def test_a_program_knows_that_it_is_searched() -> None:
    panel = Bench("sinumerik-840d", "en", program="R1=$P_SEARCH\nN5 G0 X1\nSTOPRE\nR2=$P_SEARCH\nM30\n")
    panel.control.block_search("N5")
    panel.press("START")
    assert panel.control.run() is State.READY
    assert (panel.control.read_variable("R1"), panel.control.read_variable("R2")) == (1.0, 0.0)


def test_a_program_test_that_is_given_up_leaves_the_axes_where_they_stand() -> None:
    panel = Bench("sinumerik-840d", "en", setup={"start": {"X": 3.0}}, program=COUNTED)
    control = panel.control
    control.block_search("N8", how="program-test")
    panel.passes(0.5)
    control.reset()
    assert control.run() is State.READY
    assert control.positions.machine["X"] == 3.0
    assert control.snapshot.parts == 0
    panel.press("START")
    panel.passes(0.5)
    assert control.positions.real["X"] > 3.0, "the test is over"


def test_a_program_test_that_is_given_up_is_no_point_of_interruption() -> None:
    panel = Bench("sinumerik-840d", "en", program="N10 G1 X10 F600\nN20 X20\nN30 X30\nM30\n")
    control = panel.control
    panel.press("START")
    panel.passes(2.5)
    control.reset()
    control.run()
    assert control.snapshot.interruption == 3
    control.block_search("N30", how="program-test")
    panel.passes(0.05)
    control.reset()
    control.run()
    assert control.snapshot.interruption == 3
    control.block_search("N20", how="program-test")
    control.run()
    assert control.snapshot.interruption == 2


def test_a_block_that_the_program_does_not_come_to_is_told() -> None:
    program = "GOTOF ENDE\nN5 G0 X1\nENDE: G1 X5 F1000\nM30\n"
    panel = Bench("sinumerik-840d", "en", program=program)
    control = panel.control
    control.block_search("N5", how="program-test")
    assert control.run() is State.READY
    assert control.positions.machine["X"] == 0.0
    assert "N5" in panel.view.note
    assert control.snapshot.parts == 0


# ---- sections that no search enters --------------------------------------------------------------------------------

LOCKED = "N10 G1 X10 F600\nIPTRLOCK\nR1=1\nN20 G1 X20\nN30 G1 X30\nIPTRUNLOCK\nN40 G1 X40\nN50 G1 X50\nM30\n"


@pytest.mark.feature("sie.iptrlock", control="sinumerik-840d")
@pytest.mark.parametrize(
    ("given_up_at", "found"), [("N10", "N10"), ("N20", "N20"), ("N30", "N20"), ("N40", "N40"), ("N50", "N50")]
)
def test_a_search_goes_to_where_a_section_begins_in_which_it_was_given_up(
    given_up_at: str, found: str
) -> None:
    panel = Bench("sinumerik-840d", "en", program=LOCKED)
    control = panel.control
    panel.press("START")
    assert control.run_until(lambda control: control.active_block.text.startswith(given_up_at), limit_s=60.0)
    panel.passes(0.3)
    control.reset()
    control.run()
    panel.soft("Block search", "單節搜尋")
    side(panel, "Interrupt. point", "中斷點")
    assert panel.message == ""
    (row,) = (row for row in panel.window("program").rows if row[0].cursor)
    assert row[0].text.startswith(found)


def test_a_program_that_is_loaded_anew_has_no_point_of_interruption() -> None:
    panel = Bench("sinumerik-840d", "en", program=LOCKED)
    panel.press("START")
    panel.passes(0.5)
    panel.control.reset()
    panel.control.run()
    panel.control.load("G0 X1\nM30\n")
    panel.soft("Block search", "單節搜尋")
    side(panel, "Interrupt. point", "中斷點")
    assert panel.message


# ---- interrupted in a subprogram -------------------------------------------------------------------------------------

SUB = "N1 G1 X10. F600\nN2 X20.\nN3 X30.\n"
#: The program of each control that calls it twice, and where its subprogram stands.
NESTED = {
    "sinumerik-840d": (
        "N10 G0 X0\nN15 SUB\nN20 SUB\nN30 G1 X60 F600\nM30\n",
        {"SUB.SPF": SUB.replace(".", "") + "RET\n"},
    ),
}
NESTED |= {
    control: (f"O1\nN10 G0 X0.\nN15 M98 P2\nN20 M98 P2\nN30 G1 X60. F600\nM30\nO2\n{SUB}M99\n", {})
    for control in ("fanuc-m", "syntec-mill", "meldas-m", "fanuc-0i-tf")
}  # fmt: skip


def interrupted(control: str, lang: str = "en") -> Bench:
    """A control that was reset in the second call of the subprogram, in its block N2."""
    program, files = NESTED[control]
    if control == "fanuc-0i-tf":
        program = program.replace("N10", "N10 G98")
    panel = Bench(control, lang, program, files=files)
    control_ = panel.control
    panel.press("START")
    first = control_.run_until(lambda each: each.active_block.text.startswith("N3"), limit_s=20.0)
    second = control_.run_until(lambda each: each.active_block.text.startswith("N2"), limit_s=20.0)
    assert first
    assert second
    panel.passes(0.3)
    control_.reset()
    control_.run()
    return panel


@pytest.mark.parametrize("control", NESTED)
def test_a_program_given_up_in_a_subprogram_goes_on_there(control: str) -> None:
    panel = interrupted(control)
    control_ = panel.control
    (main, line), (sub, _) = control_.snapshot.interrupted
    assert control_.program_lines(main)[line - control_.first_line(main)].startswith("N20")
    assert control_.snapshot.interruption == line
    control_.block_search(control_.snapshot.interrupted)
    assert control_.restart["X"][0] == pytest.approx(10.0)
    panel.control.cycle_start()
    assert control_.run_until(lambda each: each.active_block.text.startswith("N2"), limit_s=20.0)
    assert control_.active_block.program == sub
    control_.run()
    assert control_.positions.work["X"] == 60.0
    with pytest.raises(CommandRefused):
        control_.block_search(((main, line), (sub, 9999)))


@pytest.mark.parametrize(("control", "lang"), list(product(("sinumerik-840d", "syntec-mill"), LANGUAGES)))
def test_the_key_of_the_interruption_shows_the_call_and_searches_in_the_subprogram(
    control: str, lang: str
) -> None:
    panel = interrupted(control, lang)
    open_search(panel)
    if control == "sinumerik-840d":
        side(panel, "Interrupt. point", "中斷點")
    else:
        panel.soft("Break point", "中斷點")
    (row,) = (row for row in panel.window("program").rows if row[0].cursor)
    assert row[0].text.startswith("N20")
    search(panel)
    assert panel.message == ""
    assert panel.control.restart["X"][0] == pytest.approx(10.0)


def test_a_cursor_that_has_moved_is_the_block_that_is_searched() -> None:
    panel = interrupted("sinumerik-840d")
    open_search(panel)
    side(panel, "Interrupt. point", "中斷點")
    panel.keys("DOWN", "UP")
    search(panel)
    assert panel.control.restart["X"][0] == pytest.approx(30.0), (
        "the call begins where the first one has ended"
    )


def test_a_program_test_goes_to_a_block_of_a_subprogram() -> None:
    control = interrupted("sinumerik-840d").control
    control.block_search(control.snapshot.interrupted, how="program-test")
    control.run()
    assert control.active_block.text == "N2 X20"
    assert control.restart["X"][0] == pytest.approx(10.0)
