"""Formulas in words: the scanner calculates what the interpreter calculates, or leaves the block to it."""

from __future__ import annotations

from array import array
from math import cos, inf, nan, radians, sin

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.language.bulk.formulas.calculating import cosine, sine, variable
from polycnc.language.bulk.formulas.reading import read_token
from polycnc.language.bulk.layout import Token, new_state
from polycnc.language.bulk.settings import Bulk
from polycnc.language.word_address import functions
from tests.examples import examples
from tests.language.bulk.both_ways import PLAIN, differences, run, scanned

HEAD = (
    "O0001\nG21 G90 G54 G0 X0 Y0 Z5.\nG1 F500.\n#1=1.5\n#2=-0.01\n#7=0\n#100=33.3333\n#500=7.0005\n#33=90.\n"
)
SETUP = {"work_offsets": {"G54": {"X": 10, "Y": -3.3}}}


def read(text: str) -> tuple[int, int, float]:
    return read_token(array("B", text.encode() + b"   \n"), 0)


@pytest.mark.parametrize(
    ("text", "behind", "token", "value"),
    [
        ("1.25]", 4, Token.NUMBER, 1.25),
        ("#[1]", 1, Token.NUMBERED, 0.0),
        ("ATAN[", 4, Token.ATAN, 0.0),
        ("MOD7", 3, Token.MOD, 0.0),
        ("XOR#1", 3, Token.XOR, 0.0),
        (",2", 1, Token.COMMA, 0.0),
        (".5*", 2, Token.NUMBER, 0.5),
        ("#101+", 4, Token.VARIABLE, 101.0),
        ("#1", 2, Token.VARIABLE, 1.0),
        ("[", 1, Token.OPEN, 0.0),
        ("]", 1, Token.CLOSE, 0.0),
        ("+", 1, Token.PLUS, 0.0),
        ("-", 1, Token.MINUS, 0.0),
        ("*", 1, Token.TIMES, 0.0),
        ("/", 1, Token.DIVIDED, 0.0),
        ("SIN[", 3, Token.SIN, 0.0),
        ("COS[", 3, Token.COS, 0.0),
        ("SQRT[", 4, Token.SQRT, 0.0),
        ("ABS[", 3, Token.ABS, 0.0),
        ("FIX[", 3, Token.FIX, 0.0),
        ("FUP[", 3, Token.FUP, 0.0),
    ],
)
def test_tokens_are_read(text: str, behind: int, token: int, value: float) -> None:
    assert read(text) == (behind, token, value)


@pytest.mark.parametrize(
    "text",
    [
        "SI[",
        "SIN 5",
        "SQRT5",
        "LN[",
        "MODE[",
        "#",
        "#1.5",
        "#12345",
        "# 1",
        ".",
        "(A)",
        "GT1",
        "é",
        "1234567890123456",
    ],
)
def test_what_is_no_token_is_the_interpreters(text: str) -> None:
    assert read(text)[0] == -1


@settings(deadline=None)
@given(st.one_of(st.floats(-1e6, 1e6), st.integers(-5000, 5000).map(lambda n: n * 22.5)))
def test_sine_and_cosine_are_those_of_expressions(angle: float) -> None:
    assert sine(angle).hex() == functions.sin_(None, angle).hex()
    assert cosine(angle).hex() == functions.cos_(None, angle).hex()


def test_quarters_are_exact() -> None:
    assert [sine(90.0 * n) for n in range(-2, 5)] == [0.0, -1.0, 0.0, 1.0, 0.0, -1.0, 0.0]
    assert [cosine(90.0 * n) for n in range(-2, 5)] == [-1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 1.0]
    assert (sine(30.0), cosine(30.0)) == (sin(radians(30.0)), cos(radians(30.0)))


def test_a_variable_lies_where_a_number_or_nothing_is() -> None:
    state = new_state(0)
    state.scan.numbered = 3
    state.variables[:4] = array("d", (inf, 2.5, nan, 1.0))
    assert variable(state, 1.0) == (True, 2.5)
    assert variable(state, 2.0)[0]
    assert not variable(state, 0.0)[0]
    assert not variable(state, 3.0)[0]


NUMBERS = ("0", "1", "2.5", "0.001", ".5", "90", "100.", "1234567.", "0.333333", "45")
VARIABLES = ("#1", "#2", "#7", "#33", "#100", "#500", "#3", "#150", "#999", "#5041", "#0", "#1000", "#40")
FUNCTIONS = ("SIN", "COS", "SQRT", "ABS", "FIX", "FUP", "TAN", "ROUND", "ATAN", "SI", "EXP", "BIN")


def nested(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    operators = st.sampled_from(("+", "-", "*", "/", " + ", "*-", " MOD ", " AND ", "OR"))
    return st.one_of(
        st.tuples(inner, operators, inner).map("".join),
        inner.map(lambda text: f"[{text}]"),
        st.tuples(st.sampled_from(FUNCTIONS), inner).map(lambda parts: f"{parts[0]}[{parts[1]}]"),
        inner.map(lambda text: f"-{text}"),
    )


operands = st.one_of(st.sampled_from(NUMBERS), st.sampled_from(VARIABLES))
#: Formulas of all kinds, and some that every line of a program has with other numbers.
formula = st.recursive(operands, nested, max_leaves=6).map(lambda text: f"[{text}]")
written = st.one_of(
    st.sampled_from(("#1", "-#2", "#3", "+#7", "- #1", "# 1", "#[1]", "#1+1", "-[#1]", "[5]", "[]", "[#3]")),
    formula,
)


@st.composite
def blocks(draw: st.DrawFn) -> str:
    """Blocks of a few shapes, with numbers of their own, and statements in between."""
    lines = []
    for _ in range(draw(st.integers(1, 4))):
        letters = draw(st.lists(st.sampled_from("XYZXYZFSMRQ"), min_size=1, max_size=3, unique=True))
        code = draw(
            st.sampled_from(
                ("", "", "G1 ", "G0", "G91 ", "G90 G1 ", "N5 ", "G2 I5. ", "G20 ", "G21 ", "G95 ", "/")
            )
        )
        words = [f"{letter}{draw(written)}" for letter in letters]
        if draw(st.booleans()):
            words.append(f"Z{draw(st.sampled_from(('1.', '-.0005', '5', '0.00055')))}")
        line = (
            code
            + draw(st.sampled_from(("", " "))).join(words)
            + draw(st.sampled_from(("", "", ";", "(C)", "#1=2")))
        )
        lines += [
            line.replace("0.001", f"{i}.0{i}").replace("#1+", f"#{1 + i % 2}+")
            for i in range(draw(st.integers(1, 5)))
        ]
        lines.append(
            draw(
                st.sampled_from(
                    (
                        "",
                        "#1=#1+1.25",
                        "#3=2",
                        "#500=[#1*2]",
                        "G91",
                        "G90",
                        "#1=#0",
                        "X1. Y2.",
                        "G65 P2 A1. B2.",
                    )
                )
            )
        )
    return HEAD + "\n".join([*lines, "G90", "M30", "O0002", "X[#1] Y#2", "X[#1+0.5] Y#3", "M99", ""])


@settings(max_examples=examples(125), deadline=None)
@given(blocks(), st.sampled_from(("fanuc-m", "meldas-m", "syntec-mill")))
def test_formulas_give_the_same_both_ways(text: str, control_id: str) -> None:
    assert differences(text, control_id, SETUP, block_limit=200) == []


@settings(max_examples=examples(30), deadline=None)
@given(blocks())
def test_formulas_of_a_lathe_give_the_same_both_ways(text: str) -> None:
    assert (
        differences(text.replace("Y", "W").replace("G21 G90 ", "G21 "), "fanuc-0i-tf", block_limit=200) == []
    )


@settings(max_examples=examples(20), deadline=None)
@given(blocks())
def test_machine_code_gives_the_same(text: str) -> None:
    assert differences(text, "fanuc-m", SETUP, Bulk(fewest_lines=0, rooms=200, most_patience=1)) == []


def shapes_of(line: str) -> str:
    return HEAD + "".join(line.replace("@", str(i)) + "\n" for i in range(60)) + "M30\n"


@pytest.mark.parametrize(
    "line",
    [
        "X[#1+@*0.001] Y[SIN[#2*@]*10.+#1/[@+1]]", "X#1 Y-#2 Z@.", "X-[#100 - @] F[100+@]",
        "G1X[COS[@*45]]Y[FIX[@/3]](C)",
        "N@ Y[FUP[@/7]+SQRT[@] - ABS[-@]];", "X[#7+@]Y[#500*2.5]", "X[#3+@]", "G2 X[@*2] Y0 R[@+50]",
    ],
)  # fmt: skip
def test_blocks_with_formulas_are_scanned(line: str) -> None:
    text = shapes_of(line)
    assert scanned(text, "fanuc-m") >= 55
    assert differences(text, "fanuc-m") == []


@pytest.mark.parametrize(
    "line",
    [
        "X[#5041+@]",
        "X#3 Y@.",
        "X[ROUND[@]]",
        "M[@]",
        "X[1/#7+@]",
        "X[SQRT[-@-1]]",
        "X[LN[@+1]]",
        "X[POW[#1,@]]",
    ],
)
def test_other_blocks_are_the_interpreters(line: str) -> None:
    text = shapes_of(line)
    assert scanned(text, "fanuc-m") < 10
    assert differences(text, "fanuc-m") == []


def test_an_alarm_of_a_formula_stands_at_its_block() -> None:
    text = shapes_of("X[10/[30-@]]")
    (alarm,) = run(text, "fanuc-m", bulk=PLAIN).alarms
    assert alarm.line == HEAD.count("\n") + 31
    assert differences(text, "fanuc-m") == []


def test_variables_are_those_of_the_program_that_runs() -> None:
    body = "".join(f"X[#1+{i}.] Y#2\n" for i in range(30))
    text = f"{HEAD}G65 P2 A100. B5.\n{body}M30\nO0002\n{body}M99\n"
    assert scanned(text, "fanuc-m") >= 55
    assert differences(text, "fanuc-m") == []


@pytest.mark.parametrize(
    "line",
    [
        "X[TAN[@+1]]", "X[TAN[180*@-360]]", "X[ASIN[@/100]]", "X[ASIN[-@/100]]", "X[ACOS[@/-100]]", "X[ATAN[@]/[-#1]]",
        "X[ATAN[-@,#1]]", "X[ATAN[-@]]", "X[#1MOD[@+1]]", "X[-@ MOD 7]", "X[@ MOD -3]", "X[@.5 AND 12]", "X[@ OR 5]",
        "X[-@ XOR 9.5]", "X#[7*1]", "X[#[1.4]+@]", "X[#[33]*#[99.5]]",
    ],
)  # fmt: skip
def test_functions_and_operators_by_their_names(line: str) -> None:
    text = shapes_of(line)
    assert scanned(text, "fanuc-m") >= 50
    assert differences(text, "fanuc-m") == []


@pytest.mark.parametrize("signed", [0, 1])
def test_the_range_of_arc_functions_is_that_of_the_parameter(signed: int) -> None:
    text = shapes_of("X[ASIN[-@/100]+ATAN[-@]/[1]]")
    assert differences(text, "fanuc-m", {"parameters": {"6004": signed}}) == []


@pytest.mark.parametrize(
    "line",
    [
        "#1=@", "N@ #2 = #1 + @.5 (A)", "#100=ATAN[#1]/[@+1]", "#500=-#100", "#3=#0", "#7=#[@MOD3+1]", "#33=@;",
        "/#1=#1+@",
    ],
)  # fmt: skip
def test_assignments_in_the_text_are_scanned(line: str) -> None:
    text = shapes_of(f"{line}\nG1 X#1 Y[#2+#100]")
    if "#0" not in line:
        assert scanned(text, "fanuc-m") >= 110
    assert differences(text, "fanuc-m") == []


@pytest.mark.parametrize(
    "line", ["#3000=0", "#1=#5041", "#1=1#2=2", "#1=1;#2=@", "#1=1 X2", "#[1]=@", "#1", "#1 2=@"]
)
def test_other_statements_are_the_interpreters(line: str) -> None:
    assert differences(shapes_of(f"{line}\nX@"), "fanuc-m") == []


@pytest.mark.parametrize(
    "line", ["G2 R[#1+@+50] X[@*2] Y0 F[@+10]", "G2 R[@+60] X[@*2] Y0 F@1.", "G3 X[@*2] R#33 F7@."]
)
def test_a_radius_from_a_formula_is_a_word_like_others(line: str) -> None:
    text = shapes_of(line)
    assert scanned(text, "fanuc-m") >= 50
    assert differences(text, "fanuc-m") == []
