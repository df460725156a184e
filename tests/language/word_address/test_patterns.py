"""Lines of one pattern: what a line does is the same whether another one has been read in front of it or not."""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from polycnc.control.registry import control
from polycnc.language.word_address import WordAddressProgram, WordBlock
from polycnc.language.word_address.patterns import Patterns
from polycnc.program import ProgramStore
from tests.support import run

#: Lines with equal characters but for digits, in groups of which each line is to be told from the others.
GROUPS = [
    ("G1 X[#1+2.5] F900.", "G1 X[#2+3.5] F800.", "G0 X[#1+2.5] F900."),
    ("X-[#1*10.0]Y-5.5", "X-[#1*20.0]Y-6.5", "X-[#3*20.0]Y-0.0"),
    ("X#101", "X#501", "X#401", "X#102"),
    ("N10 X#1", "N20 X#2", "N30 X#4"),
    ("#1=5", "#2=7", "#3=0"),
    ("#101=#1", "#501=#2", "#102=#3"),
    ("#32=#33+1", "#33=#32+4", "#99=#33+1"),
    ("X[#1+10000000]Y00000001", "X[#1+20000000]Y10000000"),
    ("X[#1+1.]Y000000001", "X[#1+1.]Y100000000"),
    ("M[#1+3]", "M[#2+4]"),
    ("X[ROUND[1.5]]", "X[ROUND[2.5]]"),
    ("X#5021", "X#5022"),
    ("(1)X1.5", "(2)X2.5"),
]


def outcome(line: str) -> list[object]:
    """What a line does: rows, alarms, variables and positions behind it."""
    head = ("G90G54G1F100.", "#1=1.", "#2=2.", "#3=3.", "#33=4.", "#101=11.", "#102=12.", "#501=51.")
    channel = run("\n".join((*head, line, "M30")))
    memory: Any = channel.memory
    rows = [repr(row) for row in channel.toolpath.rows()]
    return [rows, list(memory.locals), dict(enumerate(memory.common)), repr(channel.alarms)]


@pytest.mark.parametrize("group", GROUPS, ids=str)
def test_a_line_does_the_same_whichever_of_its_pattern_was_read_first(
    group: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as alone:
        alone.setattr(Patterns, "step", lambda *_: None)
        expected = {line: outcome(line) for line in group}
    for order in itertools.permutations(group):
        grammar: Any = control("fanuc-m").grammar  # type: ignore[attr-defined]
        monkeypatch.setattr(grammar.patterns, "_patterns", {})
        for line in order:
            assert outcome(line) == expected[line]


def test_lines_that_differ_in_numbers_only_are_read_once() -> None:
    chosen: Any = control("fanuc-m")
    patterns = chosen.grammar.patterns
    program = WordAddressProgram(ProgramStore().add_text("MAIN", "X[#1*7.25]"), chosen.grammar)
    program.step(0)
    assert patterns.step("X[#2*3.75]") is not None
    assert patterns.step("Y[#2*3.75]") is None
    assert patterns.step("X[#401*3.75]") is None


def test_no_more_lines_are_kept_than_there_is_room_for() -> None:
    patterns = Patterns(3)
    block = WordBlock(("G1",), [])
    for number in range(10):
        patterns.learn(f"G{number}", block, [], ())
        assert patterns.step(f"G{number}") is not None
    assert sum(patterns.step(f"G{number}") is not None for number in range(10)) <= 3
