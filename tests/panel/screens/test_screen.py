"""Screens of every family: keys in, what they show out."""

from __future__ import annotations

from typing import Any

import pytest

from polycnc.control.registry import ids
from polycnc.mainrun import CommandRefused, Mode, State, VirtualControl
from polycnc.panel.screens.screen import Screen

TOOLS = {"tools": {1: {"length": 50.0, "radius": 5.0, "wear": {"length": 0.5}}, 3: {"length": 10.0}}}


def screen_of(control: str, **setup: Any) -> Screen:
    return Screen(VirtualControl(control, setup=setup or TOOLS))


def keyed(screen: Screen, typed: str, *keys: str) -> Screen:
    """Type something, then press keys of the MDI unit, or soft keys by their English text."""
    screen.type(typed)
    for key in keys:
        press(screen, key)
    return screen


def press(screen: Screen, key: str) -> None:
    view = screen.view("en")
    below, side = ([soft.text for soft in each] for each in (view.soft_keys, view.side_keys))
    if key in below:
        screen.soft(below.index(key))
    elif key in side:
        screen.side(side.index(key))
    else:
        screen.press(key)


def goes(control: VirtualControl, text: str) -> None:
    control.load(text)
    control.select_mode("auto")
    control.cycle_start()
    assert control.run() is State.READY


# ---- every family ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("lang", ["en", "zh-TW"])
@pytest.mark.parametrize("control", ids())
def test_every_page_can_be_shown_and_every_soft_key_leads_somewhere(control: str, lang: str) -> None:
    screen = screen_of(control)
    family = screen.family
    for page in family.pages:
        screen.show(page)
        view = screen.view(lang)
        assert view.title
        assert len(view.soft_keys) == family.rows
    menus = {**family.menus}
    for keys in (*family.menus.values(), *family.side.values()):
        for key in keys:
            assert not key.page or key.page in family.pages, key
            assert not key.menu or key.menu in menus, key
            assert bool(key.text) == bool(
                key.page or key.menu or key.action or key.switch or key.signal or key.search
            ), key
    assert set(family.keys.values()) <= set(family.pages)


@pytest.mark.parametrize("control", ids())
def test_a_page_is_in_the_language_that_is_asked_for(control: str) -> None:
    screen = screen_of(control)
    shown, translated = set(), set()
    for page in screen.family.pages:
        screen.show(page)
        shown.add(screen.view("en").title)
        translated.add(screen.view("zh-TW").title)
    assert any(ord(letter) > 0x3000 for title in translated for letter in title)
    assert not any(ord(letter) > 0x3000 for title in shown for letter in title)


@pytest.mark.parametrize(
    ("control", "digits"), [("fanuc-m", "12.500"), ("syntec-mill", "12.500"), ("sinumerik-840d", "12.500")]
)
def test_positions_and_the_block_in_execution_are_shown(control: str, digits: str) -> None:
    screen = screen_of(control)
    run = screen.control
    run.load("N1 G0 X12.5 Y3.\nN2 M0\nN3 X0.\nN4 M30\n")
    run.cycle_start()
    run.run()
    view = screen.view("en")
    assert digits in view.text
    active = [
        cell.text for window in view.windows for row in window.rows for cell in row if cell.style == "active"
    ]
    assert active == ["N2 M0"]


@pytest.mark.parametrize("control", ids())
def test_an_alarm_is_in_sight_on_every_page_and_in_the_history_after_reset(control: str) -> None:
    screen = screen_of(control)
    screen.control.load("G1 X1. F100.\nG1 X2. QQQ=1\nM30\n")
    screen.control.cycle_start()
    screen.control.run()
    (alarm,) = screen.control.alarms
    for page in screen.family.pages:
        screen.show(page)
        assert alarm.code in screen.view("en").alarm
    assert any(cell.text == "ALM" for cell in screen.view("en").status)
    screen.press("RESET")
    assert not screen.view("en").alarm
    assert not screen.control.alarms
    pages = [
        page for page, spec in screen.family.pages.items() if any(w.kind == "history" for w in spec.windows)
    ]
    screen.show(pages[0])
    assert alarm.code in screen.view("en").text


@pytest.mark.parametrize(
    ("control", "keys"),
    [
        ("fanuc-m", ["OFS/SET"]), ("meldas-m", ["TOOL/PARAM"]), ("syntec-mill", ["OFF/SET"]),
        ("fanuc-0i-tf", ["OFS/SET"]), ("sinumerik-840d", ["OFFSET", "RIGHT", "RIGHT"]),
    ],
)  # fmt: skip
def test_an_offset_is_set_and_lasts(control: str, keys: list[str], tmp_path: Any) -> None:
    path = tmp_path / "memory.db"
    first = VirtualControl(control, setup=TOOLS, retained=path)
    screen = Screen(first)
    for key in keys:
        screen.press(key)
    keyed(screen, "7.25", "INPUT")
    assert screen.message == ""
    assert "7.250" in screen.view("en").text
    first.close()
    again = Screen(VirtualControl(control, retained=path))
    for key in keys:
        again.press(key)
    assert "7.250" in again.view("en").text
    again.control.close()


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m", "syntec-mill", "sinumerik-840d", "fanuc-0i-tf"])
def test_what_is_typed_at_mdi_runs_at_cycle_start(control: str) -> None:
    screen = screen_of(control)
    screen.control.select_mode("mdi")
    page = next(
        name for name, each in screen.family.pages.items() if any(w.kind == "mdi" for w in each.windows)
    )
    screen.show(page)
    keyed(screen, "G0 X3.5", "INSERT")
    assert "G0 X3.5" in screen.view("en").text
    assert screen.takes_start()
    screen.control.run()
    assert screen.control.positions.work["X"] == pytest.approx(3.5, abs=1e-6)
    screen.press("DELETE")
    assert screen.mdi_text == ""


def test_a_program_of_the_memory_is_selected_and_deleted() -> None:
    screen = screen_of("fanuc-m")
    screen.control.store_program("O0100", "O0100\nG0 X1.\nM30\n")
    screen.control.store_program("O0200", "O0200\nG0 X2.\nM30\n")
    for key in ("PROG", "FOLDER", "DOWN"):
        press(screen, key)
    assert "O0200" in screen.view("en").text
    press(screen, "PRGRM")
    press(screen, "(OPRT)")
    keyed(screen, "200", "O SRH")
    assert screen.message == ""
    assert screen.view("en").program == "O0200"
    keyed(screen, "O0100", "DELETE")
    assert screen.message == "this is done in mode EDIT"
    screen.control.select_mode(Mode.EDIT)
    screen.press("DELETE")
    assert [each.name for each in screen.control.programs] == ["O0200"]
    keyed(screen, "O0300", "O SRH")
    assert "O0300" in screen.message


def test_a_parameter_is_written_only_with_parameter_write() -> None:
    screen = screen_of("fanuc-m")
    screen.press("SYSTEM")
    press(screen, "(OPRT)")
    keyed(screen, "5114", "NO.SRH")
    keyed(screen, "3.5", "INPUT")
    assert "WRITE" in screen.message
    screen.buffer = ""
    screen.press("SYSTEM")
    press(screen, "PWE")
    keyed(screen, "3.5", "INPUT")
    assert screen.message == ""
    assert screen.control.read_parameter("5114") == 3.5


def test_edit_protection_refuses_what_is_typed() -> None:
    screen = screen_of("fanuc-m")
    screen.control.signals["EDIT_PROTECT"] = 1.0
    screen.press("OFS/SET")
    keyed(screen, "1.", "INPUT")
    assert "protection" in screen.message
    assert "50.000" in screen.view("en").text


def test_the_relative_display_starts_where_the_operator_says() -> None:
    screen = screen_of("fanuc-m")
    goes(screen.control, "G0 X10. Y4.\nM30\n")
    press(screen, "REL")
    screen.menu = "pos-oprt"
    keyed(screen, "X", "ORIGIN")
    assert screen.positions(screen.control.snapshot, "relative")["X"] == 0.0
    assert screen.positions(screen.control.snapshot, "relative")["Y"] == 4.0
    assert "U 0.000" in screen.view("en").text


def test_a_wrong_number_and_a_page_without_fields_are_refused_with_a_text() -> None:
    screen = screen_of("fanuc-m")
    keyed(screen, "1.", "INPUT")
    assert screen.message
    screen.buffer = ""
    screen.press("OFS/SET")
    keyed(screen, "1.2.3", "INPUT")
    assert "1.2.3" in screen.message
    screen.press("CAN")
    assert screen.buffer == "1.2."


@pytest.mark.parametrize("control", ["fanuc-m", "fanuc-0i-tf"])
def test_a_measured_edge_sets_the_work_offset_of_its_row(control: str) -> None:
    screen = screen_of(control, start={"X": 50.0, "Z": -20.0}, work_offsets={"G54": {"X": 5.0}})
    for key in ("OFS/SET", "WORK", "(OPRT)"):
        press(screen, key)
    keyed(screen, "2", "NO.SRH")
    keyed(screen, "X12.5", "MEASUR")
    keyed(screen, "Z0", "MEASUR")
    assert screen.message == ""
    assert (read(screen, "#5241"), read(screen, "#5221")) == (pytest.approx(37.5), 5.0)
    screen.control.load("G55\nM0\nM30\n")
    screen.control.cycle_start()
    screen.control.run()
    assert screen.control.positions.work["X"] == pytest.approx(12.5)
    assert screen.control.positions.work["Z"] == pytest.approx(0.0)


@pytest.mark.parametrize(
    ("control", "shown"), [("fanuc-m", "N00020"), ("fanuc-0i-tf", "N00020"), ("meldas-m", "N20")]
)
def test_the_title_line_has_the_number_of_the_block_and_codes_have_two_digits(
    control: str, shown: str
) -> None:
    screen = screen_of(control)
    screen.control.load("O7\nN10 G1 X1. F100.\n/N20 X2.\nM0\nN30 M30\n")
    assert screen.view("en").sequence == ("N00000" if "f" in control else "N0")
    screen.control.cycle_start()
    screen.control.run()
    view = screen.view("en")
    assert (view.program, view.sequence) == ("O0007", shown)
    (codes, *_) = [window.text for window in view.windows if window.kind == "modal"]
    assert "G01" in codes.split()
    assert all(code.startswith("G") and code[1:3].isdigit() for code in codes.split())


@pytest.mark.parametrize("control", ["fanuc-m", "fanuc-0i-tf"])
def test_a_parameter_of_axes_has_a_row_for_each_of_them(control: str) -> None:
    screen = screen_of(control)
    screen.press("SYSTEM")
    press(screen, "PWE")
    press(screen, "(OPRT)")
    keyed(screen, "1240", "NO.SRH")
    screen.press("DOWN")
    axis = screen.control.channel.axes[1]
    keyed(screen, "12.5", "INPUT")
    assert screen.message == ""
    assert f"1240 {axis} 12.5 mm" in screen.view("en").text
    assert screen.control.read_parameter("1240 X") is None
    goes(screen.control, f"G28 {axis}0\nM30\n")
    assert screen.control.machine_position[1] == 12.5
    for number in ("99999", "1240 X Y", "?"):
        with pytest.raises(CommandRefused):
            screen.control.write_parameter(number, 1.0)


# ---- the lathe's offset screens: sequences of the manual with their results (III.2.1) ------------------------


@pytest.fixture
def lathe() -> Screen:
    return screen_of("fanuc-0i-tf", start={"X": 70.0, "Z": 12.5}, parameters={"5004#1": 0})


def opened(screen: Screen, *keys: str) -> Screen:
    for key in ("OFS/SET", *keys):
        press(screen, key)
    return screen


def write(screen: Screen, variable: str, value: float) -> None:
    screen.control.write_variable(variable, value)


def read(screen: Screen, variable: str) -> object:
    return screen.control.read_variable(variable)


def test_measured_value_becomes_the_geometry_and_wear_is_zero(lathe: Screen) -> None:
    write(lathe, "#2702", 5.0)
    write(lathe, "#2002", 0.3)
    opened(lathe, "GEOM", "DOWN", "(OPRT)")
    keyed(lathe, "X69.0", "MEASUR")
    assert lathe.message == ""
    assert read(lathe, "#2702") == pytest.approx(1.0, abs=1e-9)
    assert read(lathe, "#2002") == 0.0


def test_counter_input_takes_the_relative_coordinate_and_leaves_the_wear(lathe: Screen) -> None:
    write(lathe, "#2005", 0.1)
    lathe.origins["X"] = lathe.control.positions.machine["X"] + 3.25
    opened(lathe, "GEOM", "DOWN", "DOWN", "DOWN", "DOWN", "(OPRT)")
    keyed(lathe, "X", "INP.C.")
    assert lathe.message == ""
    assert read(lathe, "#2705") == pytest.approx(-3.25, abs=1e-9)
    assert read(lathe, "#2005") == pytest.approx(0.1)


def test_plus_input_adds(lathe: Screen) -> None:
    write(lathe, "#2003", 0.2)
    opened(lathe, "WEAR", "(OPRT)")
    keyed(lathe, "3", "NO.SRH")
    keyed(lathe, "-0.050", "+INPUT")
    assert read(lathe, "#2003") == pytest.approx(0.15)


def test_the_work_shift_moves_the_display_at_once(lathe: Screen) -> None:
    machine = dict(lathe.control.positions.machine)
    opened(lathe, "MENU", "W.SHFT")
    keyed(lathe, "1.0", "INPUT")
    lathe.press("RIGHT")
    keyed(lathe, "-1.0", "INPUT")
    assert lathe.message == ""
    assert lathe.control.positions.work == pytest.approx({"X": 69.0, "Z": 13.5})
    assert lathe.control.positions.machine == machine


def test_a_measured_face_reads_what_was_typed(lathe: Screen) -> None:
    opened(lathe, "MENU", "W.SHFT", "DOWN", "RIGHT")
    keyed(lathe, "10.0", "INPUT")
    assert lathe.control.positions.work["Z"] == pytest.approx(10.0)
    assert read(lathe, "#2601") == pytest.approx(2.5)


@pytest.mark.parametrize(("page", "bit"), [("GEOM", "3290#1"), ("WEAR", "3290#0")])
def test_input_is_inhibited_by_its_parameter(page: str, bit: str) -> None:
    screen = screen_of("fanuc-0i-tf", parameters={bit: 1})
    opened(screen, page)
    keyed(screen, "1.", "INPUT")
    assert screen.message
    assert read(screen, "#2701") == read(screen, "#2001") == 0.0


def test_second_geometry_is_typed_in_only_with_its_parameter() -> None:
    for allowed in (0, 1):
        screen = screen_of("fanuc-0i-tf", parameters={"3290#5": allowed})
        opened(screen, "MENU", "2ND GEOM")
        keyed(screen, "4.", "INPUT")
        assert bool(screen.message) is not bool(allowed)
        assert ("4.000" in screen.view("en").text) is bool(allowed)


def test_the_barrier_is_set_in_state_g23() -> None:
    screen = screen_of("fanuc-0i-tf")
    opened(screen, "MENU", "MENU", "CHUCK TAIL", "DOWN", "DOWN")
    keyed(screen, "-100.", "INPUT")
    assert screen.message == "" or "G23" in screen.message
    if screen.message:
        screen.buffer = ""
        goes(screen.control, "G23\nM30\n")
        opened(screen, "MENU", "MENU", "CHUCK TAIL")
        keyed(screen, "-100.", "INPUT")
    assert "-100.000" in screen.view("en").text
