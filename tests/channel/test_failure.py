"""An alarm knows its place: file, line and column."""

from __future__ import annotations

import pytest

from polycnc.session import open_session

PLACES = [
    pytest.param(
        "fanuc-m", "O1\nN10 G1 X10.\nM30\n", "PS0011", (2, 5), id="the head of the block behind its N word"
    ),
    pytest.param("fanuc-m", "O1\n/2 N10 G1 X10.\nM30\n", "PS0011", (2, 8), id="behind the block skip"),
    pytest.param("fanuc-m", "O1\n  GOTO 99\nM30\n", "PS0128", (2, 8), id="a number that is quoted"),
    pytest.param(
        "sinumerik-840d", "N1 R1=1\nN20 GOTOF NIX\nM30\n", "14080", (2, 11), id="a label that is quoted"
    ),
    pytest.param(
        "sinumerik-840d", "R1=1\n N5 R2=SQRT(-1)\nM30\n", "14051", (2, 8), id="a function that is quoted"
    ),
    pytest.param("syntec-mill", "G0 X1.\nG65 P77\nM30\n", "COR-012", (2, 5), id="a word that is named"),
]


@pytest.mark.parametrize(("control", "program", "code", "place"), PLACES)
def test_an_alarm_points_at_its_word_or_at_the_head_of_its_block(
    control: str, program: str, code: str, place: tuple[int, int]
) -> None:
    alarm = open_session(program, control=control).run().alarms[0]
    assert (alarm.code, alarm.line, alarm.column) == (code, *place)


def test_what_the_end_of_the_text_finds_missing_has_no_column() -> None:
    alarm = open_session("O1\nM98 P2\nM30\n", control="fanuc-m", files={"O2": "O2\nG0 X1.\n"}).run().alarms[0]
    assert (alarm.code, alarm.program, alarm.line, alarm.column) == ("PS5010", "O0002", 3, 0)
