"""What stands in front of a block."""

from __future__ import annotations

import pytest

from polycnc.program import Program
from polycnc.program.heads import after_head, sequence_number


@pytest.mark.parametrize(
    ("line", "number", "rest"),
    [
        ("N50 G1 X2", "N50", "G1 X2"),
        ("n5G0", "N5", "G0"),
        ("  /2 N10 M8", "N10", "M8"),
        (":3 G0", ":3", "G0"),
        ("G1 N50", "", "G1 N50"),
        ("N= 5", "", "N= 5"),
        ("/ ", "", ""),
    ],
)
def test_skip_and_sequence_number_stand_in_front_of_a_block(line: str, number: str, rest: str) -> None:
    assert sequence_number(line) == number
    assert line[after_head(line) :] == rest


def test_a_block_is_named_by_its_number_or_its_line_of_the_file() -> None:
    program = Program("MAIN", ["N10 G0", "/2 N0020 G0", "G0"], first_line=5)
    assert [program.block_name(line) for line in (5, 6, 7, 99)] == ["N10", "N0020", "7", "99"]
