"""Cycles of the lathe where a conformance case cannot say it."""

from __future__ import annotations

from polycnc.messages import text
from polycnc.session import open_session
from tests.control.fanuc.lathe.support import alarms, moves, run


def test_a_cycle_of_more_strokes_than_anyone_waits_for_is_an_alarm() -> None:
    program = "G0 X5000. Z0\nG76 X1. Z-5. P2400000 Q1 F1.\nM30"
    assert alarms(run(program, switches={"thread_chamfer": False})) == ["PC0002"]


def test_threads_run_through_in_single_block_operation() -> None:
    program = "N1 G0 X40. Z5.\nN2 G32 Z-5. F2.\nN3 Z-10.\nN4 G0 X50.\nN5 Z5.\nM30\n"
    session = open_session(program, control="fanuc-0i-tf", setup={"switches": {"single_block": True}})
    assert session.run().stops == ["N1", "N4", "N5", "6"]


def test_a_word_of_the_other_format_is_refused_with_a_hint() -> None:
    result = run("G0 X40. Z2.\nG71 P1 Q2 U0.4 D4000 F0.2\nN1 G0 X30.\nN2 G1 Z-10.\nM30")
    assert alarms(result) == ["PS0009"]
    assert text("hint.series-15") in result.alarm_text(result.alarms[0])


def test_all_moves_of_a_cycle_carry_its_line() -> None:
    result = run("G0 X40. Z2.\nG90 X30. Z-5. F0.2\nM30")
    assert {row["line"] for row in result.rows if "to" in row} == {1, 2}


def test_the_modal_feed_of_a_cycle_stays() -> None:
    assert moves(run("G0 X40. Z2.\nG90 X30. Z-5. F0.2\nG1 X20.\nM30"))[-1] == ("feed", 20.0, 2.0)
