"""SINUMERIK and SYNTEC screens: alarms, messages, modes, the state while a channel waits."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest

from polycnc.mainrun import CommandRefused, State, VirtualControl
from polycnc.panel.panel import Light, Panel
from polycnc.panel.screens.screen import Screen
from tests.panel.screens.test_screen import press

NOON = datetime(2026, 3, 1, 12, 0, 7, tzinfo=UTC)
WORDS = {"en": ("Date, time", "Cancelled by"), "zh-TW": ("日期時間", "取消條件")}


def sinumerik(text: str = "") -> Screen:
    screen = Screen(VirtualControl("sinumerik-840d"))
    screen.clock = lambda: NOON
    if text:
        runs(screen, text)
    return screen


def runs(screen: Screen, text: str) -> None:
    screen.control.load(text)
    screen.control.cycle_start()
    screen.control.run()
    screen.follow()


@pytest.mark.feature("sie.b.alarm_display", control="sinumerik-840d")
@pytest.mark.parametrize("lang", ["en", "zh-TW"])
def test_alarms_have_date_time_and_what_cancels_them_and_stand_apart_from_messages(lang: str) -> None:
    screen = sinumerik('MSG("FACE MILLING")\nG4 F1\nG1 X5 F100\nSETAL(65000,"LOW OIL")\nG4 F1\nM30\n')
    press(screen, "ALARM")
    view = screen.view(lang)
    assert "2026-03-01 12:00:07" in view.text
    assert "65000" in view.text
    assert "RESET //" in view.text
    assert all(word in view.text for word in WORDS[lang])
    assert "FACE MILLING" not in view.text
    assert view.alarm.startswith("65000")
    assert view.note == "FACE MILLING"
    press(screen, "Messages")
    assert "FACE MILLING" in screen.view(lang).text
    assert "65000" not in screen.view(lang).windows[0].text
    screen.press("RESET")
    screen.follow()
    press(screen, "Alarm list")
    assert screen.view(lang).text == screen.view(lang).alarm == ""
    press(screen, "Alarm log")
    assert "65000" in screen.view(lang).text


def test_an_alarm_keeps_the_moment_at_which_it_came_and_comes_anew() -> None:
    screen = sinumerik("SETAL(65000)\nG4 F1\nM30\n")
    screen.show("alarms")
    later = NOON.replace(hour=13)
    screen.clock = lambda: later
    screen.follow()
    assert "12:00:07" in screen.view("en").text
    screen.press("RESET")
    screen.follow()
    runs(screen, "SETAL(65000)\nG4 F1\nM30\n")
    assert "13:00:07" in screen.view("en").text


@pytest.mark.feature("sie.b.msg", "sie.msg_expr", control="sinumerik-840d")
@pytest.mark.parametrize("lang", ["en", "zh-TW"])
def test_a_message_of_expressions_stands_in_its_line_until_it_is_taken_back(lang: str) -> None:
    screen = sinumerik(
        'DEF INT PIECE=7\nMSG("PART "<<PIECE<<" DONE")\nG4 F0.1\nM0\nMSG()\nG4 F0.1\nM0\nM30\n'
    )
    for page in screen.family.pages:
        screen.show(page)
        assert screen.view(lang).note == "PART 7 DONE"
        assert screen.view(lang).alarm == ""
    screen.control.cycle_start()
    screen.control.run()
    screen.follow()
    screen.show("messages")
    assert screen.view(lang).note == ""
    assert screen.view(lang).windows[0].text == ""
    assert "PART 7 DONE" in screen.view(lang).windows[1].text


@pytest.mark.feature("sie.b.modes", control="sinumerik-840d")
@pytest.mark.parametrize("lang", ["en", "zh-TW"])
def test_modes_move_axes_run_typed_blocks_and_run_programs(lang: str) -> None:
    screen = sinumerik()
    control, panel = screen.control, Panel(screen.control)

    def mode() -> str:
        return screen.view(lang).status[0].text

    panel.turn("mode", "jog")
    assert mode() == "JOG"
    panel.press("X+")
    control.step(0.5)
    panel.release("X+")
    control.run()
    assert control.positions.machine["X"] > 0.0
    with pytest.raises(CommandRefused):
        panel.press("START")
    panel.turn("mode", "zero")
    assert mode() == "REF"
    panel.press("X+")
    control.run()
    assert control.positions.machine["X"] == pytest.approx(0.0, abs=1e-9)
    panel.turn("mode", "mdi")
    assert mode() == "MDA"
    screen.press("MACHINE")
    press(screen, "MDA")
    screen.type("G0 X12.5")
    screen.press("INPUT")
    assert "G0 X12.5" in screen.view(lang).text
    assert screen.takes_start()
    control.run()
    assert "12.500" in screen.view(lang).text
    panel.turn("mode", "auto")
    assert mode() == "AUTO"
    control.load("G0 X1\nX2\nM30\n")
    panel.press("START")
    assert control.run() is State.READY
    assert control.positions.work["X"] == pytest.approx(2.0)


@pytest.mark.feature("sie.b.modes", control="sinumerik-840d")
@pytest.mark.parametrize("lang", ["en", "zh-TW"])
def test_repos_leads_axes_back_to_the_interruption_and_no_farther(lang: str) -> None:
    screen = sinumerik()
    control, panel = screen.control, Panel(screen.control)
    assert panel.description.modes["repos"].name[lang] == {"en": "Repos", "zh-TW": "重新定位"}[lang]
    control.load("G0 X10\nM0\nG1 X20 F1000\nM30\n")
    control.cycle_start()
    assert control.run() is State.STOPPED
    panel.turn("mode", "jog")
    panel.press("X+")
    control.step(0.5)
    panel.release("X+")
    control.run()
    assert control.positions.machine["X"] > 12.0
    panel.turn("mode", "repos")
    for key in ("X+", "Y-"):
        with pytest.raises(CommandRefused, match=key[0]):
            panel.press(key)
    panel.press("X-")
    control.step(0.1)
    panel.release("X-")
    control.run()
    assert control.positions.machine["X"] > 10.0
    panel.press("X-")
    control.run()
    assert control.positions.machine["X"] == pytest.approx(10.0)
    panel.release("X-")
    panel.turn("mode", "auto")
    panel.press("START")
    assert control.run() is State.READY
    assert control.positions.machine["X"] == pytest.approx(20.0)
    panel.turn("mode", "jog")
    panel.press("X+")
    control.step(0.2)
    panel.release("X+")


@pytest.mark.feature("sie.b.keyswitch", control="sinumerik-840d")
@pytest.mark.parametrize("lang", ["en", "zh-TW"])
@pytest.mark.parametrize("needed", [7, 6, 5, 4, 3])
def test_each_position_of_the_key_switch_has_its_rights(needed: int, lang: str) -> None:
    files = {"_N_MGUD_DEF": f"DEF NCK INT APWP {needed} SECRET=4\nM30\n"}
    screen = Screen(VirtualControl("sinumerik-840d", files=files))
    control, panel = screen.control, Panel(screen.control)
    control.load("SECRET=SECRET+1\nG4 F0.1\nM30\n")
    for position, level in (("0", 7), ("3", 4), ("1", 6), ("2", 5), ("0", 7)):
        panel.turn("key_switch", position)
        assert panel.positions["key_switch"] == position
        control.cycle_start()
        control.run()
        allowed = level <= needed
        assert (control.state is State.READY) is allowed, position
        press(screen, "ALARM")
        view = screen.view(lang)
        assert ("17070" in view.text) is not allowed
        assert ("SECRET" in view.alarm) is not allowed
        screen.press("RESET")


def test_the_key_switch_keeps_its_position_without_power() -> None:
    files = {"_N_MGUD_DEF": "DEF NCK INT APWP 4 SECRET=4\nM30\n"}
    control = VirtualControl("sinumerik-840d", files=files)
    panel = Panel(control)
    panel.turn("edit_protect", "on")
    panel.turn("key_switch", "0")
    panel.turn("edit_protect", "off")
    control.power_off()
    panel.press("POWER_ON")
    control.load("SECRET=5\nG4 F0.1\nM30\n")
    control.cycle_start()
    control.run()
    assert [alarm.code for alarm in control.alarms] == ["17070"]


def test_before_the_key_switch_is_turned_a_program_has_the_rights_of_a_run() -> None:
    files = {"_N_MGUD_DEF": "DEF NCK INT APWP 2 SECRET=4\nM30\n"}
    control = VirtualControl("sinumerik-840d", files=files)
    panel = Panel(control)
    control.load("SECRET=5\nG4 F0.1\nM30\n")
    for _ in range(2):
        panel.press("START")
        assert control.run() is State.READY
        control.power_off()
        panel.press("POWER_ON")
    panel.turn("key_switch", "3")
    panel.press("START")
    assert control.run() is State.ALARM
    assert [alarm.code for alarm in control.alarms] == ["17070"]


TRAORI = "T1 D1\nM6\nG0 X0 Y0 Z50\nTRAORI\nG0 X10 Y20 Z30\nM0\nM30\n"


@pytest.mark.feature("sie.ori_jog", control="sinumerik-840d")
@pytest.mark.parametrize("lang", ["en", "zh-TW"])
def test_geometry_axes_by_hand_follow_the_system_that_is_chosen(lang: str) -> None:
    screen = Screen(VirtualControl("sinumerik-840d"))
    control, panel = screen.control, Panel(screen.control)
    runs(screen, "G54 G0 X10 Y0 Z0\nROT Z90\nM0\nM30\n")
    panel.turn("mode", "jog")
    for key, moves in (("WCS", "Y"), ("TCS", "X"), ("MCS", "X")):
        panel.press(key)
        assert panel.lamps()[key] is Light.ON
        before = control.positions.machine
        panel.press("X+")
        control.step(0.5)
        panel.release("X+")
        control.run()
        after = control.positions.machine
        assert [axis for axis in after if abs(after[axis] - before[axis]) > 1e-6] == [moves]
    screen.press("MACHINE")
    shown = {row[0].text: row[1].text for row in screen.view(lang).windows[0].rows}
    assert float(shown["X"]) == pytest.approx(control.positions.work["X"], abs=1e-3)


@pytest.mark.feature("sie.ori_jog", control="sinumerik-840d")
@pytest.mark.parametrize("lang", ["en", "zh-TW"])
def test_a_rotary_axis_by_hand_turns_the_tool_about_its_tip(lang: str) -> None:
    setup = {"tools": {1: {"length": 100.0}}}
    screen = Screen(VirtualControl("sinumerik-840d", machine="mill5-bc-head", setup=setup))
    control, panel = screen.control, Panel(screen.control)
    runs(screen, TRAORI)

    def shown() -> list[list[str]]:
        return [[cell.text for cell in row] for row in screen.view(lang).windows[0].rows]

    screen.press("MACHINE")
    panel.turn("mode", "jog")
    panel.press("B+")
    for _ in range(10):
        control.step(0.1)
        assert shown()[:3] == [["X", "10.000"], ["Y", "20.000"], ["Z", "30.000"]]
    with pytest.raises(CommandRefused):
        panel.press("C+")
    panel.release("B+")
    control.run()
    assert shown()[3] != ["B", "0.000"]
    press(screen, "Act. values MCS")
    assert shown()[0] != ["X", "10.000"]  # the linear axes have followed
    panel.press("MCS")
    assert panel.lamps()["MCS"] is Light.ON
    linear = shown()[:3]
    panel.press("C+")
    control.step(0.5)
    panel.release("C+")
    control.run()
    assert shown()[:3] == linear  # each axis by itself


TWO = "$1\nG00 X0. Y0.\nG04.1 P1\nM30\n$2\nG00 X0. Y0.\nG00 Y50.\nG04.1 P1\nM99\n"
STATES = {"en": ("Block stop", "Machining.."), "zh-TW": ("單節停止", "加工中..")}


@pytest.mark.feature("syn.g04_1_status", control="syntec-mill")
@pytest.mark.parametrize("lang", ["en", "zh-TW"])
def test_a_channel_that_waits_is_shown_as_machining(lang: str) -> None:
    control = VirtualControl("syntec-mill", machine="mill2-2ch")
    screen = Screen(control)
    press(screen, "PROG")
    control.load(TWO)
    control.set_switches(single_block=True)
    stands, machines = STATES[lang]
    control.cycle_start()
    control.run()
    assert stands in screen.view(lang).text
    assert screen.view(lang).status[1].text == "B-STOP"
    control.cycle_start()  # $1 waits for $2, which stands behind its own block
    control.run(limit_s=30.0)
    assert control.channels[1].waits
    assert machines in screen.view(lang).text
    assert stands not in screen.view(lang).text
    assert screen.view(lang).status[1].text == "BUSY"


BLANKS = {
    '"BOX",112,0,-50,-80,-60,-60,60,60': "BOX ZA 0 ZI -50 ZB -80 X0 -60 Y0 -60 X1 60 Y1 60",
    '"BOX",64,0,50,-80,10,0,100.5,100': "BOX ZA 0 ZI 50 ZB -80 X0 10 Y0 0 X1 110.5 Y1 100",
    '"BOX",32,5,-50,-80,-60,-60,60,60': "BOX ZA 5 ZI -45 ZB -75 X0 -60 Y0 -60 X1 0 Y1 60",
    '"CYLINDER",192,2,-100,-80,90': "CYLINDER ZA 2 ZI -100 ZB -80 XA 90",
    '"CYLINDER",0,2,-100,-80,90': "CYLINDER ZA 2 ZI -98 ZB -78 XA 90",
    '"PIPE",192,0,-40,-30,90,60': "PIPE ZA 0 ZI -40 ZB -30 XA 90 XI 60",
    '"PIPE",448,0,-40,-30,90,5': "PIPE ZA 0 ZI -40 ZB -30 XA 90 XI 80",
    '"RECTANGLE",64,1,-20,0,100,80': "RECTANGLE ZA 1 ZI -20 ZB 1 W 100 L 80",
    '"N_CORNER",64,1,-20,0,6,50': "N_CORNER ZA 1 ZI -20 ZB 1 N 6 SW 50",
}


@pytest.mark.feature("sie.c.workpiece", control="sinumerik-840d")
@pytest.mark.parametrize(("lang", "word"), [("en", "Blank"), ("zh-TW", "毛胚")])
@pytest.mark.parametrize("given", BLANKS)
def test_the_blank_stands_beside_the_picture_until_it_is_taken_back(given: str, lang: str, word: str) -> None:
    screen = sinumerik(f'G0 X3\nWORKPIECE(,"",,{given})\nG4 F0.1\nM0\nWORKPIECE()\nG4 F0.1\nM0\nM30\n')
    press(screen, "MENU SELECT")
    press(screen, "Machine")
    press(screen, "Simult. view")
    shown = screen.view(lang).windows[1].text.split()
    values = [
        cell if not cell.replace(".", "").strip("-").isdigit() else f"{float(cell):g}" for cell in shown
    ]
    assert " ".join(values) == f"{word} {BLANKS[given]}"
    assert screen.control.positions.work == pytest.approx({"X": 3.0, "Y": 0.0, "Z": 0.0})
    screen.control.cycle_start()
    screen.control.run()
    assert screen.view(lang).windows[1].text == ""
