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
