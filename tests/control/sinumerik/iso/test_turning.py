"""ISO code on a lathe: what is refused there, beside the conformance cases."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, moves, run

START = ("G18 G90 DIAMON G94 F100 S500 M3", "G0 X50 Z5", "G291")


@pytest.mark.parametrize(
    "words",
    [
        "T3",
        "T0201 D1",
        "G92 X40",
        "G77 X40",
        "G77 X40 Z-5 G17",
        "G77 X40 Z-5 G1",
        "G33 Z-5",
        "G53 X0",
        "G71 P10 Q20",
        "G83 Z-20 R2",
        "G1 X40 R-2",
        "G32 Z-5 F1",
    ],
)
def test_what_is_refused(words: str) -> None:
    result = run(*START, words, machine="lathe2")
    assert codes(result) == [("PC0001", 4)]
    assert len(moves(result)) == 1


def test_an_increment_under_diam90_would_be_a_radius_and_is_refused() -> None:
    data = ("$MN_EXTERN_GCODE_SYSTEM=1", *START)
    own = run(*data, "G0 U-10", machine="lathe2")
    assert [to["X"] for _, to in moves(own)] == [50.0, 40.0]
    assert codes(run(*data[:-1], "DIAM90", "G291", "G0 U-10", machine="lathe2")) == [("PC0001", 6)]


def test_a_cycle_ends_with_g290() -> None:
    result = run(*START, "G77 X40 Z-5", "G290", "G1 X50 Z5", "G291", "X44 Z3", machine="lathe2")
    assert codes(result) == []
    assert [to for _, to in moves(result)][-2:] == [{"X": 50.0, "Z": 5.0}, {"X": 44.0, "Z": 3.0}]


def test_a_lead_ends_with_g290() -> None:
    assert codes(run(*START, "G33 Z-5 F2", "G290", "G291", "G33 Z-10", machine="lathe2")) == [("PC0001", 7)]


def test_code_a_does_not_begin_under_g91() -> None:
    assert codes(run("$MN_EXTERN_GCODE_SYSTEM=1", "G91", "G291", machine="lathe2")) == [("PC0001", 3)]
