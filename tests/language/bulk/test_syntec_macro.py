# ruff: noqa: E501 - programs stand as they are written
"""The scanner and the interpreter give one result on SYNTEC files in the macro language."""

from __future__ import annotations

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from polycnc.language.bulk.settings import Bulk
from tests.examples import examples
from tests.language.bulk.both_ways import PLAIN, differences, plain_scan, run, scanned
from tests.language.bulk.programs import CODES, REPEATED, any_arc, arc, plain, program
from tests.language.bulk.test_word_address import SETUP

CONTROL = "syntec-mill"
NO_COMMENTS = ("",)
#: How blocks end: most with their semicolon, some with comments, blanks or the next block of the line behind it.
ENDS = st.sampled_from(
    (*[";"] * 12, " ;", "; // X5", "; (* PASS *)", " (* a *) ;", " (* a ) X7. *);", ";;", "; X3.;", "", ";\n", "; (*\nX9.;\n*)", "; (*)\nX8.; *)", "; // (a\n")
)  # fmt: skip


def ended(blocks: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    """Every line of some blocks with an end of its own."""
    return st.tuples(blocks, ENDS, ENDS).map(
        lambda parts: "\n".join(line + parts[1 + i % 2] for i, line in enumerate(parts[0].split("\n")))
    )


BLOCKS = st.one_of(
    plain("XYZ", NO_COMMENTS),
    plain("XYZ", NO_COMMENTS, CODES + REPEATED),
    plain("XYZ", NO_COMMENTS),
    arc(NO_COMMENTS),
)
STATEMENTS = st.sampled_from(
    (
        "", "// X5.;", "(* X5.;\nX6.; *)", "#1 := #1 + 1;", "@5 := 2.5;", "X#1;", "G1 X[#1 + 2.5] F(500 + #1);", "IF #1 > 2 THEN\nX9.;\nY1.;\nELSE\nX8.;\nEND_IF;",
        "FOR #2 := 1 TO 3 DO\nG91 X1.;\nG91 Y-1.;\nX2. Y2.;\nEND_FOR;", "#3 := 0;\nWHILE #3 < 3 DO G91 X1.;\nX0.5;\n#3 := #3 + 1;\nEND_WHILE;",
        "CASE #1 OF\n0: X1.;\n1:\nX2.;\nY2.;\nELSE X3.;\nEND_CASE;", "#4 := 0;\nREPEAT\nX1.;\nY1.; #4 := #4 + 1;\nUNTIL #4 > 2 END_REPEAT;", "IF #1 <\n3 THEN X7.;\nEND_IF;", "X1.\nY2.;",
        "X1. Y2.; X3.;", "/X5.;", "/2 X6.;", "N77 X1.;", "N78;", "#9 := #9 + 1;\nIF #9 < 3 THEN GOTO 77; END_IF;", "M3 S1000;", "S1200;", "G54;", "G55;", "G92 X0 Y0;", "G17;", "G18;", "G70;", "G71;",
        "G94;", "G95 F0.2;", "G94 F900;", "G43 H1;", "G49;", "G68 X0 Y0 R33.3;", "G69;", "G51 X0 Y0 P2.;", "G50;", "G41 D1 X9.;", "G40 G0 X0 Y0;", "G81 X1. Y2. R2. Z-3. F100;", "G80;", "G28 Z0;",
        "#1 := #1850;", "M0;", "x1. y2.;", "X 5.;", "X0X10;", "X=5.;", "SLEEP();", "G1 F1000.;", ";", ";;;",
    )
)  # fmt: skip
WRONG = st.one_of(
    any_arc().map("{};".format),
    st.sampled_from(
        ("G12345;", "X1..2;", "Q5;", "X;", "END_IF;", "IF #1 THEN", "X1. X2.;", "GOTO 12345;", "X99999.;", "(X5.);", "X(5.);", "(*", "%", "é;", "#1 = ;", "F0;\nX1.;", "G1 F;", "G65 P9999;", "N5 N6 X1.;", "X1234567890123456.;")
    ),
)  # fmt: skip
PROGRAMS = program(ended(BLOCKS), STATEMENTS, WRONG, "%@MACRO\nG90 G54 G1 F1000.;", "M30;")


@settings(max_examples=examples(40), deadline=None)
@example("%@MACRO\nG90 G1 F1000.;\nX1.; (*\nX9.;\n*)\nX2.;\nX3. (* a ) X7. *);\nM30;\n")
@given(PROGRAMS)
def test_macro_programs_give_the_same_both_ways(text: str) -> None:
    assert differences(text, CONTROL, SETUP, block_limit=20_000) == []


@settings(max_examples=examples(20), deadline=None)
@given(PROGRAMS, st.integers(1, 100), st.integers(1, 7))
def test_block_limits_and_rooms_of_any_size_give_the_same(text: str, limit: int, rooms: int) -> None:
    bulk = Bulk(fewest_lines=0, scan=plain_scan, rooms=rooms, most_patience=1)
    assert differences(text, CONTROL, SETUP, bulk, block_limit=limit) == []


@settings(max_examples=examples(20), deadline=None)
@given(PROGRAMS)
def test_block_skip_gives_the_same(text: str) -> None:
    assert differences(text, CONTROL, {**SETUP, "switches": {"block_skip": True}}, block_limit=20_000) == []


def test_blocks_between_statements_are_scanned() -> None:
    stretch = [f"N{i} G1 X{i}. Y-0.{i};" for i in range(1, 20)]
    text = "\n".join(
        (
            "%@MACRO", "G90 G54 G1 F1000.;", *stretch, "#1 := 5;", "IF #1 > 2 THEN", *stretch, "END_IF; // done", "", *stretch,
            "FOR #2 := 1 TO 2 DO", *stretch, "END_FOR;", "M30;", "",
        )
    )  # fmt: skip
    assert differences(text, CONTROL) == []
    assert scanned(text, CONTROL) >= 5 * (len(stretch) - 1)


def test_a_mistake_in_a_run_of_plain_blocks_alarms_in_its_line() -> None:
    text = "\n".join(
        ("%@MACRO", "G90 G1 F100.;", *(f"X{i}.;" for i in range(30)), "X1. Q5.;", "X2.;", "M30;", "")
    )
    (alarm,) = run(text, CONTROL, bulk=PLAIN).alarms
    assert alarm.line == 33
    assert differences(text, CONTROL) == []


@pytest.mark.parametrize(
    "line", ["X1.; X2.;", "X1.\n;", "IF #1 = 0 THEN X1.; END_IF;", "X(1.);", "(* a\nX1.; *)"]
)
def test_lines_that_are_more_or_less_than_a_block_are_not_scanned(line: str) -> None:
    text = f"%@MACRO\nG90 G1 F100.;\n#1 := 0;\n{line}\nM30;\n"
    assert differences(text, CONTROL) == []
    assert scanned(text, CONTROL) <= 1
