"""Expressions in words of the NC language are read token by token."""

from __future__ import annotations

from array import array

import pytest

from polycnc.language.bulk.formulas.reading import begins_expression, read_expression_token
from polycnc.language.bulk.layout import Token


def text(written: str) -> array[int]:
    return array("B", written.encode() + b"\n")


@pytest.mark.parametrize(
    ("written", "behind", "token", "value"),
    [
        ("12*", 2, Token.NUMBER, 12.0),
        ("1.5)", 3, Token.DECIMAL, 1.5),
        ("R12+", 3, Token.VARIABLE, 12.0),
        ("SIN(R1)", 4, Token.SIN, 0.0),
        ("TRUNC(", 6, Token.TRUNC, 0.0),
        ("(", 1, Token.OPEN, 0.0),
        (")", 1, Token.CLOSE, 0.0),
        ("/", 1, Token.DIVIDED, 0.0),
    ],
)
def test_tokens_are_read(written: str, behind: int, token: int, value: float) -> None:
    assert read_expression_token(text(written), 0) == (behind, token, value)


@pytest.mark.parametrize(
    "written", ["SINUS(", "SIN 5", "SI(", "R", "R1.5", "R12345", "1234567890", "DIV", "[", "#1", "ATAN2("]
)
def test_others_are_the_interpreters(written: str) -> None:
    assert read_expression_token(text(written), 0)[0] < 0


@pytest.mark.parametrize(
    ("written", "is_one"),
    [
        ("5", False),
        ("-5.5", False),
        (" 5 ", False),
        ("5*2", True),
        ("5 - 3", True),
        ("R1", True),
        ("(5)", True),
    ],
)
def test_more_than_a_number_is_an_expression(written: str, is_one: bool) -> None:
    assert begins_expression(text(written), 0) is is_one
