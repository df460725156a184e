"""Numbers read from bytes are those that Python reads."""

from __future__ import annotations

from array import array

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.language.bulk.numerals import read_number


def text(line: str) -> array[int]:
    return array("B", line.encode() + b"\n")


@settings(deadline=None)
@given(
    st.sampled_from(("", "+", "-")), st.from_regex(r"\A([0-9]{1,9}\.[0-9]{0,6}|\.[0-9]{1,9}|[0-9]{1,15})\Z")
)
def test_a_number_is_the_one_that_python_reads(sign: str, digits: str) -> None:
    place, value, decimals = read_number(text(sign + digits + " "), 0, 15)
    assert value.hex() == float(sign + digits).hex()
    assert place == len(sign + digits)
    assert decimals == (len(digits.partition(".")[2]) if "." in digits else -1)


@pytest.mark.parametrize("wrong", ["", "-", "+-1", ".", "1234567890123456", "0000000012345678.9"])
def test_what_is_no_number_or_too_long_is_not_plain(wrong: str) -> None:
    assert read_number(text(wrong), 0, 15)[0] == -1


def test_zeros_in_front_do_not_count_as_digits() -> None:
    assert read_number(text("0000012.5"), 0, 3)[1] == 12.5
    assert read_number(text("0000012.55"), 0, 3)[0] == -1
