"""Blocks of the ISO dialect, told in the control's own words."""

from __future__ import annotations

import pytest

from polycnc.language.sinumerik.iso_dialect import parsed, region, switched
from polycnc.messages import AlarmError


@pytest.mark.parametrize(
    ("line", "motion", "told"),
    [
        ("N10 G00 X10. Y-.5", "G1", ["N10", "G0", "X10.", "Y-.5"]),
        ("/2 N5 g02x1y2r-3", "G1", ["/2", "N5", "G2", "X1", "Y2", "CR=-3"]),
        ("X1 R3", "G3", ["X1", "CR=3"]),
        ("G04 P1500", "G0", ["G4", "F1.5"]),
        ("G4 X.25", "G0", ["G4", "F0.25"]),
        ("G59 (G1) X3 ; Y4", "G0", ["G506", "X3"]),
        ("G21 G41", "G0", ["G710", "G41"]),
        ("G20 G1 X1", "G0", ["G700", "G1", "X1"]),
    ],
)
def test_words_and_their_counterparts(line: str, motion: str, told: list[str]) -> None:
    assert parsed(line).told(motion).split() == told


def test_words_keep_their_columns() -> None:
    assert parsed("N10 G01   X5").told("G0").index("X5") == 10


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("X1 R3", "PC0001"),
        ("G81 X1 Z-2 R1", "PC0001"),
        ("M98 P10", "PC0001"),
        ("#1=5", "PC0001"),
        ("G1 X[#1]", "PC0001"),
        ("G4 P100 X1 Y3", "PC0001"),
        ("X1 &", "12080"),
        ("D1", "PC0001"),
        ("G4", "PC0001"),
        ("G04 M8", "PC0001"),
    ],
)
def test_what_is_refused(line: str, code: str) -> None:
    with pytest.raises(AlarmError) as error:
        parsed(line).told("G1")
    assert error.value.code == code


def test_words_that_are_somebody_elses() -> None:
    block = parsed("N1 G99 G81 X1 R2 Z-3")
    assert block.codes == ("G99", "G81")
    assert [word.name for word in block.words if block.find(word.letter) == word] == [
        "G81",
        "X1",
        "R2",
        "Z-3",
    ]
    assert block.told("G0", [word for word in block.words if word.letter in "GRZ"]).split() == ["N1", "X1"]


def test_blocks_that_change_the_language() -> None:
    lines = ["N1 G291", "X1", "N2 G290 ; back", "X2", "/N3 g291", "X3"]
    assert [switched(line) for line in lines] == ["G291", "", "G290", "", "G291", ""]
    assert (region(lines, 1), region(lines, 5)) == (range(1, 2), range(5, 6))
    assert switched("G291 X1") == ""
