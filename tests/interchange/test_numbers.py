"""Numbers as text."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.interchange.numbers import Unit, expression, plain


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_plain_number_has_a_point_and_no_exponent_and_is_the_same(value: float) -> None:
    written = plain(value, 3)
    assert re.fullmatch(r"-?\d+\.\d{3,}", written)
    assert float(written) == value


@given(st.floats(allow_nan=False, allow_infinity=False, min_value=-1e30, max_value=1e30))
def test_an_expression_is_the_same_number(value: float) -> None:
    written = expression(value)
    assert eval(written.replace("[", "(").replace("]", ")")) == value
    assert all(len(digits) <= 10 for digits in re.findall(r"\d+", written))


@pytest.mark.parametrize(
    ("value", "written"),
    [
        (0.0, "0"),
        (12.345, "12.345"),
        (-5.0, "-5"),
        (1 / 3, "[[[21*65536+21845]*65536+21845]*65536+21845]/134217728/134217728"),
    ],
)
def test_what_has_few_digits_is_written_as_it_is(value: float, written: str) -> None:
    assert expression(value) == written


@given(st.integers(-999999, 999999))
def test_a_length_in_inches_is_the_shortest_text_that_gives_it(tenths: int) -> None:
    unit = Unit(25.4, 4)
    kept = tenths / 1e4 * 25.4
    assert float(unit.text(kept)) * 25.4 == kept
    assert len(unit.text(kept).partition(".")[2]) == 4


def test_zero_has_no_sign() -> None:
    assert Unit(1.0, 3).text(-0.0) == "0.000"
