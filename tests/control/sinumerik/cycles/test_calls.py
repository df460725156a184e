"""Cycles as programs: levels, single block, what is restored, what MCALL does."""

from __future__ import annotations

import pytest

from polycnc.session import Result, open_session
from tests.control.sinumerik.support import codes, moves, run

START = ("G17 G90 G94 T1 D1 M6", "S1000 M3 F200")
TOOLS = {1: {"radius": 5.0, "length": 0.0}}


def levels(result: Result) -> list[float]:
    """Z of every move."""
    return [to["Z"] for _, to in moves(result)]


def test_an_alarm_stands_at_the_call_in_the_calling_program() -> None:
    result = run(*START, "G0 X1", "  CYCLE81(-5,0,2,-20)", tools=TOOLS)
    alarm = result.alarms[0]
    assert (alarm.code, alarm.line, alarm.column) == ("61101", 4, 3)


def test_rows_of_a_cycle_belong_to_the_line_of_its_call() -> None:
    result = run(*START, "G0 Z20", "CYCLE81(10,0,2,-5)", tools=TOOLS)
    assert [row["line"] for row in result.rows if "to" in row] == [3, 4, 4, 4]


def test_inch_programs_give_inch_cycles() -> None:
    result = run("G700 T1 D1 M6", "S1000 M3 F10", "CYCLE85(1,0,0.1,-0.5,,,5,20)", tools=TOOLS)
    assert levels(result) == pytest.approx([2.54, -12.7, 2.54, 25.4])
    feeds = [row["feed"] for row in result.rows if row["type"] == "feed"]
    assert feeds == pytest.approx([5 * 25.4, 20 * 25.4])


def test_a_mirrored_frame_mirrors_the_holes() -> None:
    result = run(
        *START, "MIRROR X0", "MCALL CYCLE81(10,0,2,-5)", "HOLES1(0,0,0,10,5,1)", "MCALL", tools=TOOLS
    )
    machine = [row["machine"]["X"] for row in result.rows if "machine" in row]
    assert machine[-1] == pytest.approx(-10.0)


def test_radius_compensation_must_be_off() -> None:
    result = run(*START, "G41 G1 X10", "X20", "CYCLE81(10,0,2,-5)", tools=TOOLS)
    assert codes(result) == [("61815", 5)]


def test_a_cycle_takes_one_program_level() -> None:
    deep = {f"L{i}.SPF": f"L{i + 1}\nM17\n" for i in range(1, 15)}
    fits = {**deep, "L15.SPF": "M17\n"}
    full = {**deep, "L15.SPF": "CYCLE81(10,0,2,-5)\nM17\n"}
    assert codes_with_files("L1", fits) == []
    assert codes_with_files("L1", full) == ["14012"]


def codes_with_files(line: str, files: dict[str, str]) -> list[str]:
    session = open_session(f"F200\n{line}\nM30\n", control="sinumerik-840d", files=files)
    return [alarm.code for alarm in session.run().alarms]


def test_a_modal_pattern_does_not_call_itself() -> None:
    result = run(*START, "MCALL HOLES1(0,0,0,10,5,2)", "G0 X1", "MCALL", tools=TOOLS)
    assert codes(result) == []
    assert [to["X"] for _, to in moves(result)] == [1.0, 10.0, 15.0]


def test_a_pocket_called_modally_lies_where_the_position_is() -> None:
    lines = ("MCALL POCKET4(10,0,2,-4,9,0,0,4,0,0,500,100,2,11)", "G0 X100 Y50", "MCALL")
    result = run(*START, *lines, tools=TOOLS)
    plunge = next(to for kind, to in moves(result) if kind == "feed")
    assert (plunge["X"], plunge["Y"]) == (100.0, 50.0)


def test_reading_a_contour_leaves_everything_as_it_was() -> None:
    lines = (
        "G0 X1 Y2 Z30",
        'CYCLE72("BEG:FIN",10,0,2,-4,4,0,0,500,100,1,42,1,8,900,1,8)',
        "R1=$P_GG[14] R2=$P_GG[1]",
        "GOTOF OUT",
        "BEG: G1 G91 X0 Y0 F77",
        "X25 RND=3",
        "FIN: Y30",
        "OUT: G0 Z50",
    )
    session = open_session(
        "\n".join((*START, *lines, "M30")) + "\n", control="sinumerik-840d", setup={"tools": TOOLS}
    )
    result = session.run()
    assert codes(result) == []
    assert all(row["feed"] in (100.0, 500.0) for row in result.rows if row["type"] == "feed")
    assert [row["line"] for row in result.rows if "to" in row][-1] == 10
