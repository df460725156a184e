"""Signatures of blocks: keys of codes and words, blocks whose words hold expressions."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.language.word_address.words import code_key, is_fixed_code, word_key
from tests.support import ends, run


@pytest.mark.parametrize(
    ("letter", "number", "key"),
    [
        ("G", "01", "G1"),
        ("G", "0", "G0"),
        ("G", "00", "G0"),
        ("G", "54.10", "G54.10"),
        ("M", "003", "M3"),
        ("G", "1.0", "G1"),
    ],
)
def test_a_code_loses_its_leading_zeros(letter: str, number: str, key: str) -> None:
    assert code_key(letter, number) == key


@pytest.mark.parametrize(
    ("number", "key"),
    [("5", "X"), ("5.", "X."), (".5", "X."), ("1.234", "X."), ("1.2345", "X:"), ("1.23456", "X;")],
)
def test_a_key_tells_how_its_number_was_written(number: str, key: str) -> None:
    assert word_key("X", number) == key


def test_codes_and_program_names_have_no_value() -> None:
    assert is_fixed_code("G1")
    assert is_fixed_code("<PART>")
    assert not is_fixed_code("X.")
    assert not is_fixed_code("G")


@given(st.lists(st.tuples(st.sampled_from("XYZ"), st.integers(-99_999, 99_999)), min_size=1, max_size=6))
def test_a_word_from_an_expression_moves_as_the_typed_one(words: list[tuple[str, int]]) -> None:
    typed = "".join(f"{letter}{thousandths / 1000.0:.3f}" for letter, thousandths in words)
    computed = "".join(f"{letter}[{thousandths}/1000]" for letter, thousandths in words).replace("[-", "[0-")
    assert ends(run(f"G0 {typed}\nM30\n")) == ends(run(f"G0 {computed}\nM30\n"))


def test_a_computed_code_is_the_code() -> None:
    assert ends(run("#1=91\n#2=54.1\nG#1 G0 X5.\nG#2 P1 X5.\nM30\n")) == [(5, 0, 0), (10, 0, 0)]
