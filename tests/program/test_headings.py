"""What stands at the begin of a line is read sign by sign as a pattern would read it."""

from __future__ import annotations

import re

from hypothesis import given
from hypothesis import strategies as st

from polycnc.language.word_address.executable import _behind_head
from polycnc.machine.plc import is_word
from polycnc.program.split import _is_marked, _number

NUMBER = re.compile(r"\s*(?:%\s*)?(?:[oO]|:)[ \t]*(\d{1,9})(?![\d.])")
MARK = re.compile(r"\s*%")
HEAD = re.compile(r"[ \t]*(?:[O:][ \t]*\d+|<[^>]*>)?")
WORD = re.compile(r"M\d+|G\d+(?:\.\d+)?|[STB]_CODE|UNKNOWN_M|KEY_\w+|CYCLE_START|MODE_\w+|MOVE_\w+|HOME_\w+")
LINES = st.text(" \t%oO:0123.<>A\uff11\x1f", max_size=14)
PARTS = (
    "M",
    "G",
    "S",
    "_CODE",
    "UNKNOWN_M",
    "KEY",
    "MODE_",
    "MOVE_",
    "HOME_",
    "CYCLE_START",
    "_",
    "1",
    ".",
    "é",
    "[",
)


@given(LINES)
def test_numbers_of_programs(line: str) -> None:
    match = NUMBER.match(line)
    assert _number(line) == (int(match[1]) if match else None)
    assert _is_marked(line) is (MARK.match(line) is not None)


@given(LINES)
def test_heads_of_blocks(line: str) -> None:
    match = HEAD.match(line)
    assert match is not None
    assert _behind_head(line) == match.end()


@given(st.lists(st.sampled_from(PARTS), max_size=5))
def test_words_of_moments(parts: list[str]) -> None:
    signal = "".join(parts)
    assert is_word(signal) is (WORD.fullmatch(signal) is not None)
