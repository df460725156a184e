"""CYCLE62 and CYCLE63 around their contours: what the program finds afterwards, and what a reset leaves."""

from __future__ import annotations

import pytest

from polycnc.channel.states.state import Lifetime, end_of
from polycnc.control.sinumerik.cycles.contours.reading import ChosenContour
from polycnc.session import open_session

BOX = {"BOX.SPF": "G90 G0 X0 Y0\nG1 X40\nG91 Y20\nX-40\nG90 Y0\nM17\n"}
START = "G17 G90 G94 T1 D1 M6\nS1000 M3 F200\nG0 X1 Y2 Z50\n"
CALL = 'CYCLE63("",11,50,0,2,-4,400,100,5)\n'
SETUP = {"tools": {1: {"radius": 5.0}}}


def test_modes_and_feed_of_the_caller_are_in_force_again() -> None:
    program = f'{START}G91 G1\nCYCLE62("BOX",0)\n{CALL}X1\nM30\n'
    session = open_session(program, control="sinumerik-840d", setup=SETUP, files=BOX)
    result = session.run()
    assert not result.alarms
    rows = [row for row in result.rows if "to" in row]
    last, before = rows[-1], rows[-2]
    assert last["type"] == "feed"
    assert last["feed"] == pytest.approx(200.0)
    assert last["to"]["X"] == pytest.approx(before["to"]["X"] + 1.0)


def test_a_reset_forgets_contours_that_no_cycle_has_taken() -> None:
    session = open_session(f'{START}CYCLE62("BOX",0)\nM0\n', control="sinumerik-840d", setup=SETUP, files=BOX)
    session.run()
    channel = session.channel
    ChosenContour.of(channel).places.append(ChosenContour.of(channel).places[0])
    end_of(channel, Lifetime.RESET)
    assert ChosenContour.of(channel).places == []


def test_single_block_halts_behind_the_cycle_and_not_in_its_contour() -> None:
    setup = {**SETUP, "switches": {"single_block": "SBL1"}}
    program = f'{START}CYCLE62("BOX",0)\n{CALL}M30\n'
    result = open_session(program, control="sinumerik-840d", setup=setup, files=BOX).run()
    plain = open_session(program, control="sinumerik-840d", setup=SETUP, files=BOX).run()
    assert [row["to"] for row in result.rows if "to" in row] == [
        row["to"] for row in plain.rows if "to" in row
    ]


def test_two_calls_in_a_row_need_two_contours() -> None:
    program = f'{START}CYCLE62("BOX",0)\n{CALL}{CALL}M30\n'
    result = open_session(program, control="sinumerik-840d", setup=SETUP, files=BOX).run()
    assert [(alarm.code, alarm.line) for alarm in result.alarms] == [("61605", 6)]
