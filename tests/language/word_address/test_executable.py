"""Programs as steps: skip marks, sequence numbers, loops, columns."""

from __future__ import annotations

from typing import Any
from unittest.mock import patch

import pytest

from polycnc.control.registry import control
from polycnc.language.expressions.joined import MOST_JOINS
from polycnc.language.word_address import WordAddressProgram
from polycnc.language.word_address.joining import join
from polycnc.messages import AlarmError
from polycnc.program import ProgramStore
from tests.support import codes, ends, run


def program(text: str) -> WordAddressProgram:
    chosen: Any = control("fanuc-m")
    return WordAddressProgram(ProgramStore().add_text("MAIN", text), chosen.grammar)


def test_a_sequence_number_is_searched_forward_then_from_the_top() -> None:
    steps = program("N10 X1\nN20 X2\nN10 X3\nN30 X4\n")
    assert steps.find_sequence(10, 0) == 2
    assert steps.find_sequence(10, 2) == 0
    assert steps.find_sequence(30, 3) == 3


def test_a_missing_sequence_number_is_an_alarm() -> None:
    with pytest.raises(AlarmError) as caught:
        program("N10 X1\n").find_sequence(99, 0)
    assert caught.value.code == "PS0128"


def test_a_skip_mark_may_stand_in_front_of_a_sequence_number() -> None:
    assert program("/2 N15 X1\nN20\n").find_sequence(15, 0) == 0


def test_the_sequence_number_of_a_line_is_the_last_one_above() -> None:
    steps = program("N10 X1\nX2\nN20 X3\n")
    assert [steps.sequence(i) for i in range(3)] == [10, 10, 20]


def test_an_end_belongs_to_its_own_do() -> None:
    steps = program("DO1\nDO2\nEND2\nDO2\nEND2\nEND1\n")
    assert steps.loop_end(0, 1) == 5
    assert steps.loop_end(3, 2) == 4


@pytest.mark.parametrize("text", ["DO1\nDO2\nEND1\nEND2\n", "DO1\nDO1\nEND1\nEND1\n", "DO1\nX1\n"])
def test_loops_that_cross_or_never_end_are_an_alarm(text: str) -> None:
    with pytest.raises(AlarmError) as caught:
        program(text).loop_end(0, 1)
    assert caught.value.code == "PS0124"


def test_the_column_of_a_code_and_of_an_address() -> None:
    steps = program("N1 (G41) G041 X1. ,R2.\n")
    assert steps.column(0, "G41") == 10
    assert steps.column(0, ",R") == 19
    assert steps.column(1, "G41") == 0, "what the end of the program finds missing stands in no line"


def test_several_blocks_in_a_line_run_one_by_one() -> None:
    assert ends(run("G0 X1.; Y2.; M99 P5\nX9.\nN5 M30\n")) == [(1, 0, 0), (1, 2, 0)]


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("X", "PS0005"),
        ("X--5", "PS0006"),
        ("G-1", "PS0006"),
        ("X1.2.3", "PS0007"),
        ("X1234567890", "PS0003"),
        ("X[1", "PS1132"),
        ("$5", "PS0009"),
        ("G0 X1. #1=2", "PS0127"),
        ("#1 2", "PS1133"),
        ("IF [1 EQ 1] X5", "PS1137"),
        ("WHILE [1 EQ 1] GOTO 5", "PS1138"),
        ("DO4", "PS0126"),
        ("SETVN 5", "PS1139"),
        ("DPRNT[#1[99]]", "PS1143"),
        ("G0 X1. IF [1 EQ 1] GOTO 5", "PS0127"),
        ("G0 " + "X[1]" * 1100, "PS0003"),
    ],
)
def test_text_that_is_no_block_has_its_own_alarm(line: str, code: str) -> None:
    assert codes(run(line + "\nM30\n")) == [code]


def test_an_alarm_names_the_column_of_what_it_means() -> None:
    channel = run("G0 X1. Q5.\nM30\n")
    assert [(alarm.code, alarm.line, alarm.column) for alarm in channel.alarms] == [("PS0009", 1, 8)]


def test_a_program_called_by_a_name_that_is_not_there() -> None:
    channel = run("M98 <SIDE-2>\nM30\n")
    assert codes(channel) == ["PS0076"]


def joins(text: str, **how: bool) -> int:
    """How many functions are made where every step of a program is asked for again and again."""
    steps = program(text)
    with patch("polycnc.language.word_address.executable.join", wraps=join) as joined:
        for _ in range(20):
            for index in range(len(steps.lines)):
                if steps.steps[index] is None:
                    steps.step(index, **how)
    made: list[int] = [len(call.args[1]) for call in joined.call_args_list]
    return sum(made)


def test_what_runs_block_by_block_is_joined_with_nothing() -> None:
    assert joins("G1 X1.\n" * 40, alone=True) == 0


def test_a_block_that_is_entered_at_every_step_is_joined_some_times_only() -> None:
    blocks = 40
    assert 0 < joins("G1 X1.\n" * blocks) <= blocks * (1 + MOST_JOINS)
