"""Drilling cycles of the ISO dialect: levels, and what they share with the cycles of the control."""

from __future__ import annotations

import pytest

from polycnc.control.sinumerik.iso.holes import BACK_BORING, KINDS, hole_of
from polycnc.control.sinumerik.iso.running import Datum, HoleCycle
from polycnc.messages import AlarmError
from tests.control.sinumerik.support import codes, moves, run


def test_levels_under_g90_and_g91() -> None:
    absolute = HoleCycle("G81", 50.0, Datum(3.0, False), Datum(-10.0, False))
    counted = HoleCycle("G81", 50.0, Datum(-47.0, True), Datum(-13.0, True))
    assert hole_of(absolute, to_r=False) == hole_of(counted, to_r=False)
    assert hole_of(absolute, to_r=True).back == 3.0


@pytest.mark.parametrize(
    ("cycle", "code"),
    [
        (HoleCycle("G81", 50.0, None, Datum(-10.0, False)), "61101"),
        (HoleCycle("G81", 50.0, Datum(3.0, False), None), "61808"),
        (HoleCycle("G83", 50.0, Datum(3.0, False), Datum(-10.0, False)), "61808"),
    ],
)
def test_a_level_that_is_missing(cycle: HoleCycle, code: str) -> None:
    with pytest.raises(AlarmError) as error:
        hole_of(cycle, to_r=False)
    assert error.value.code == code


@pytest.mark.parametrize(
    ("iso", "own"),
    [
        ("G82 X5 R2 Z-9 P300", "CYCLE82(20,2,0,-9,,0.3)"),
        ("G85 X5 R2 Z-9", "CYCLE85(20,2,0,-9)"),
        ("G89 X5 R2 Z-9 P300", "CYCLE89(20,2,0,-9,,0.3)"),
        ("G83 X5 R2 Z-9 Q11", "CYCLE83(20,2,0,-9,,,11,,,,,1)"),
    ],
)
def test_cycles_that_the_control_has_too(iso: str, own: str) -> None:
    start = ("S500 M3 F200", "G0 Z20")
    dialect = run(*start, "G291", f"G90 G98 {iso}", "G290")
    assert moves(dialect) == moves(run(*start, "X5", own))


@pytest.mark.parametrize("code", sorted(KINDS.keys() - {BACK_BORING}))
def test_every_cycle_drills_and_comes_back(code: str) -> None:
    result = run(
        "S500 M3 F200",
        "G0 Z20",
        "G291",
        f"G99 {code} X5 R2 Z-9 {'Q4' if 'Q' in KINDS[code].words else ''}",
        "G290",
    )
    assert codes(result) == []
    levels = [to["Z"] for _, to in moves(result)]
    assert min(levels) == -9.0
    assert levels[-1] == 2.0


@pytest.mark.parametrize(
    ("first", "last"),
    [
        (("G51 X0 Y0 Z0 P2000", "G81 X1 R1 Z-1 F100", "G50"), "X5"),
        (("G81 X1 R1 Z-1 F100", "G51.1 Z0"), "X5 R-1 Z1"),
        (("G51.1 Z0", "G81 X1 R-1 Z1 F100", "G50.1 Z0"), "X5 R1 Z-1"),
        (("G81 X1 R1 Z-1 F100", "G52 Z3"), "X5 R-2 Z-4"),
        (("G81 X1 R1 Z-1 F100", "G92 Z0"), "X5 R-9 Z-11"),
    ],
)
def test_the_initial_level_is_a_place_in_whatever_frame(first: tuple[str, ...], last: str) -> None:
    result = run("G0 Z10", "G291", *first, last)
    assert result.alarms == []
    heights = [
        round(row["machine"]["Z"], 6) for row in result.rows if "to" in row and row["line"] == 3 + len(first)
    ]
    assert heights == [10.0, 1.0, -1.0, 10.0]


def test_levels_of_one_axis_are_none_of_another() -> None:
    lines = ("G0 Y20 Z10", "G291", "G81 X1 R1 Z-1 F100")
    result = run(*lines, "G18 X5 R2 Y-3")
    assert codes(result) == []
    assert [to["Y"] for _, to in moves(result)[-4:]] == [20.0, 2.0, -3.0, 20.0]
    assert codes(run(*lines, "G18 X5")) == [("61101", 4)]


def test_a_hole_has_no_corner() -> None:
    assert codes(run("G1 X1 F100", "G291", "G81 X5 R2 Z-9 ,R1")) == [("PC0001", 3)]
    assert codes(run("G0 X1", "G291", "X5 ,R1")) == [("PC0001", 3)]
    assert codes(run("G1 X1 F100", "G291", "X5 ,C-1")) == [("PC0001", 3)]
