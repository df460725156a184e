from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.program import ProgramFileError
from polycnc.program.text import MAX_LINE, split_lines

LINE = st.text(st.characters(exclude_characters="\r\n"), max_size=20)


@given(st.lists(LINE), st.sampled_from(["\n", "\r\n", "\r", "\n\r\r"]))
def test_every_line_end_counts_as_one(lines: list[str], line_end: str) -> None:
    assert split_lines("".join(line + line_end for line in lines)) == lines


@given(st.lists(LINE.filter(bool), min_size=1), st.sampled_from(["\n", "\r\n", "\r", "\n\r\r"]))
def test_the_last_end_of_block_may_be_missing(lines: list[str], line_end: str) -> None:
    assert split_lines(line_end.join(lines)) == lines


def test_line_ends_may_be_mixed() -> None:
    assert split_lines("A\r\nB\nC\rD\n\nE") == ["A", "B", "C", "D", "", "E"]


def test_blank_lines_of_a_tape_stay_lines() -> None:
    assert split_lines("A\n\r\r\n\r\rB\n\r\r") == ["A", "", "B"]


def test_a_stray_return_in_a_crlf_file_is_a_line_as_in_an_editor() -> None:
    assert split_lines("A\r\n\r\r\nB") == ["A", "", "", "B"]


def test_only_returns_and_line_feeds_end_a_line() -> None:
    assert split_lines("(A\u2028B\x85C\x0bD\x0cE)\nM30") == ["(A\u2028B\x85C\x0bD\x0cE)", "M30"]


def test_a_line_of_megabytes_is_refused_with_its_number() -> None:
    with pytest.raises(ProgramFileError) as error:
        split_lines("M0\n" + "X" * (MAX_LINE + 1) + "\nM30", "PART.NC")
    assert error.value.args_by_name == {
        "path": "PART.NC",
        "line": 2,
        "limit": MAX_LINE,
    }
    assert "PART.NC" in str(error.value)


def test_the_longest_line_allowed_is_read() -> None:
    assert split_lines("M0\n" + "X" * MAX_LINE) == ["M0", "X" * MAX_LINE]
