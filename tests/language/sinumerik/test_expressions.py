from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.language.sinumerik.running import alarm, run, value, values


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("2+3*4", 14),
        ("(2+3)*4", 20),
        ("10-4-3", 3),
        ("3/4", 0.75),
        ("3 DIV 4", 0),
        ("-7 DIV 2", -3),
        ("7.5 DIV 2", 3),
        ("7 MOD 4", 3),
        ("-7 MOD 4", -3),
        ("'B1100' B_AND 'B1010'", 8),
        ("'B1100' B_OR 'B1010'", 14),
        ("'B1100' B_XOR 'B1010'", 6),
        ("B_NOT 0", -1),
        ("-POT(3)", -9),
        ("- -4", 4),
        ("5*-2", -10),
        ("1 XOR 1", 0),
        ("NOT 0", 1),
    ],
)
def test_operators_give_what_the_manual_says(expression: str, expected: float) -> None:
    assert value(f"R1={expression}") == pytest.approx(expected)


def test_comparison_is_the_weakest_operator() -> None:
    # R1==1 AND R2==2 is R1==(1 AND R2)==2 (1.7)
    assert value("R1=1 R2=2\nR3=R1==1 AND R2==2", "R3") == 0
    assert value("R2=3\nR1=R2==3 OR 0") == 0
    assert value("R2=3\nR1=(R2==3) OR 0") == 1


def test_bit_operators_bind_in_the_order_and_xor_or() -> None:
    assert value("R1='B1' B_OR 'B10' B_XOR 'B11' B_AND 'B1'") == 1 | (2 ^ (3 & 1))


def test_concatenation_is_stronger_than_comparison() -> None:
    assert value('DEF INT IDX=2\nR1="Index: 2"=="Index: "<<IDX') == 1


def test_equality_is_relative_to_one_part_in_1e12() -> None:
    assert value("R1=1+1EX-13\nR2=R1==1", "R2") == 1
    assert value("R1=1+1EX-11\nR2=R1==1", "R2") == 0
    assert value("R1=1EX9+1EX-4\nR2=R1==1EX9", "R2") == 1


def test_order_is_relative_unless_machine_data_say_otherwise() -> None:
    program = "R1=1+1EX-13\nR2=R1>1"
    assert value(program, "R2") == 0
    assert value(program, "R2", setup={"parameters": {"10280": 1}}) == 1


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("SIN(30)", 0.5),
        ("COS(60)", 0.5),
        ("TAN(45)", 1),
        ("ASIN(0.5)", 30),
        ("ACOS(0.5)", 60),
        ("ATAN2(1,-1)", 135),
        ("SQRT(2)", math.sqrt(2)),
        ("ABS(-3)", 3),
        ("TRUNC(-2.7)", -2),
        ("ROUND(2.5)", 3),
        ("ROUNDUP(-3.1)", -3),
        ("LN(EXP(2))", 2),
        ("MINVAL(3,5)", 3),
        ("MAXVAL(3,5.5)", 5.5),
        ("BOUND(1,3,7)", 3),
        ('NUMBER("-1.5EX2")', -150),
        ('ISNUMBER("1234.9876Ex-7")', 1),
        ('ISNUMBER("1234XYZ")', 0),
        ('STRLEN("abc")', 3),
        ('INDEX("abcb","b")', 1),
        ('RINDEX("abcb","b")', 3),
        ('INDEX("abc","x")', -1),
        ('MINDEX("/_N_MPF","M,N,O,P")', 2),
        ('MATCH("abcabc","ca")', 2),
        ('STRLEN(SUBSTR("abc",5))', 0),
    ],
)
def test_functions_give_what_the_manual_says(expression: str, expected: float) -> None:
    assert value(f"R1={expression}") == pytest.approx(expected)


def test_multiples_of_90_degrees_are_exact() -> None:
    assert values("R1=SIN(180) R2=COS(-270) R3=TAN(180)", "R1", "R2", "R3") == [0, 0, 0]


@pytest.mark.parametrize(
    "expression", ["1/0", "1 DIV 0", "1 MOD 0", "SQRT(-1)", "LN(0)", "ASIN(2)", "TAN(90)", "EXP(1000)"]
)
def test_what_has_no_value_is_an_arithmetic_alarm(expression: str) -> None:
    assert alarm(f"R2=1\nR1={expression}")[:2] == ("14051", 2)


@pytest.mark.parametrize(
    ("line", "code", "column"),
    [
        ("R1=5+", "12080", 6),
        ("R1=(5", "12080", 6),
        ("R1=5)", "12080", 5),
        ("R1=FOO", "12550", 4),
        ("R1=SIN(1,2)", "12080", 9),
        ("R1=SUBSTR(1,2,3)", "12150", 11),
        ("R1=SQRT", "12080", 8),
        ("R1=ATAN2(1)", "14020", 4),
        ('R1="abc"', "12150", 4),
        ('R1="a"+1', "12150", 7),
        ("R1=X", "12150", 4),
        ("R9999=1", "12290", 1),
        ("R1=$FOO", "12550", 4),
    ],
)
def test_a_wrong_expression_alarms_at_its_column(line: str, code: str, column: int) -> None:
    assert alarm(line) == (code, 1, column)


@pytest.mark.parametrize("expression", ["+".join(["1"] * 400), "(" * 220 + "1" + ")" * 220, "-" * 2000 + "1"])
def test_an_expression_beyond_all_measure_is_refused(expression: str) -> None:
    assert alarm(f"R1={expression}")[0] in ("12540", "PC0003")


def test_the_alarm_of_a_wrong_block_comes_before_any_of_it_acts() -> None:
    assert run("R1=5 R2=FOO").variables["R1"] == 0


def test_real_becomes_text_with_ten_decimals_and_no_trailing_zeros() -> None:
    rows = run('R10=100\nMSG("N"<<R10<<" "<<9.654<<" "<<1/3<<TRUE)').rows
    assert [row["text"] for row in rows] == ["N100 9.654 0.33333333331"]


def test_strings_longer_than_a_string_may_be_alarm() -> None:
    assert alarm('DEF STRING[200] AA\nAA="' + "x" * 150 + '"\nMSG(AA<<AA)')[:2] == ("14099", 3)


def test_conversions_round_a_half_up_and_check_ranges() -> None:
    assert values("DEF INT II\nII=2.5", "II") == [3]
    assert values("DEF INT II\nII=-2.6", "II") == [-3]
    assert alarm("DEF INT II\nII=3EX9")[:2] == ("12160", 2)
    assert alarm("DEF INT II=2147483647\nII=II+1")[:2] == ("12160", 2)
    assert alarm("DEF CHAR CC\nCC=256")[:2] == ("12160", 2)


def test_a_char_is_a_code_and_a_character() -> None:
    program = 'DEF CHAR CC="A"\nDEF STRING[9] SS\nR1=CC\nSS="x"<<CC\nR2=CC=="A"\nR3=SS=="xA"'
    assert values(program, "R1", "R2", "R3") == [65, 1, 1]


def test_frames_chain_and_have_components() -> None:
    program = "DEF FRAME FF\nFF=CTRANS(X,10):CROT(Z,90):CTRANS(X,5)\nR1=FF[X,TR] R2=FF[Y,TR] R3=FF[Z,RT]"
    assert values(program, "R1", "R2", "R3") == pytest.approx([10, 5, 90])


OPERATORS = st.sampled_from(["+", "-", "*"])


@st.composite
def sums(draw: st.DrawFn) -> str:
    parts = [str(draw(st.integers(0, 99)))]
    for _ in range(draw(st.integers(1, 6))):
        parts += [draw(OPERATORS), draw(st.integers(0, 99).map(lambda n: f"({n}-50)"))]
    return "".join(parts)


@settings(max_examples=30, deadline=None)
@given(sums())
def test_integer_arithmetic_is_that_of_integers(expression: str) -> None:
    assert value(f"R1={expression}") == eval(expression)
