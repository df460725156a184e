from __future__ import annotations

from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.language.sinumerik.lexer import number_of, prefix_of, tokenize
from polycnc.messages import AlarmError


def texts(line: str) -> list[str]:
    return [token.text for token in tokenize(line)[:-1]]


def test_a_block_needs_no_blanks() -> None:
    assert texts("G1X10Y-5.5F100") == ["G1", "X10", "Y", "-", "5.5", "F100"]


def test_upper_and_lower_case_are_equal_but_in_strings() -> None:
    assert texts('msg("Abc")') == ["MSG", "(", "Abc", ")"]


def test_a_comment_ends_the_block_but_not_in_a_string() -> None:
    assert texts('MSG("a;b") ; c') == ["MSG", "(", "a;b", ")"]


@pytest.mark.parametrize(
    ("text", "value"),
    [("12", 12), (".5", 0.5), ("5.", 5.0), ("1.5EX-3", 0.0015), ("2EX+3", 2000.0), ("3000000000", 3e9)],
)
def test_numbers_have_the_values_that_are_written(text: str, value: float) -> None:
    assert number_of(text) == value
    assert type(number_of(text)) is type(value)


def test_literals_in_other_bases_are_integers() -> None:
    assert [token.value for token in tokenize("'HFF' 'B101' 'HFFFFFFFF'")[:-1]] == [255, 5, -1]


@pytest.mark.parametrize(
    ("line", "code", "column"),
    [
        ('MSG("abc', "12080", 5),
        ("R1=5 ? 3", "12080", 6),
        ("R1='B12'", "12080", 5),
        ("R1='HFFFFFFFFF'", "12230", 5),
        ("R1=1EX999", "12160", 4),
        ("X10 ü", "12080", 5),
    ],
)
def test_what_is_no_token_alarms_at_its_column(line: str, code: str, column: int) -> None:
    with pytest.raises(AlarmError) as raised:
        tokenize(line)
    assert (raised.value.code, raised.value.column) == (code, column)


def test_skip_level_number_and_label_stand_before_the_words() -> None:
    assert prefix_of("/3 N0100 Loop_1: X5")[:3] == (3, "N100", "LOOP_1")
    assert prefix_of("/N5 X1")[:3] == (0, "N5", "")
    assert prefix_of(":20 X1")[:3] == (-1, ":20", "")


def test_a_jump_to_a_main_block_is_no_label() -> None:
    assert prefix_of("GOTOF :20").label == ""


@given(st.floats(-1e6, 1e6).map(lambda x: round(x, 5)))
def test_a_decimal_number_is_read_back_exactly(x: float) -> None:
    text = f"{abs(x):.5f}"
    assert tokenize(f"X={text}")[2].value == float(text)


@given(st.text(max_size=60))
def test_no_line_breaks_the_lexer(line: str) -> None:
    tokens = []
    with suppress(AlarmError):
        tokens = tokenize(line, prefix_of(line).end)
    assert not tokens or tokens[-1].kind == "end"
