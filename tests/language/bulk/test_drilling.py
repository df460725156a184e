"""Holes of drilling cycles give the same whether the scanner drills them or the interpreter."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.control.word_address.auxiliary.functions import Clocks
from polycnc.language.bulk.layout import MOST_STROKES
from tests.language.bulk.both_ways import PLAIN, differences, run, scanned, variables
from tests.language.bulk.programs import words

CYCLES = (
    "G98 G81 X0 Y0 Z-10. R2. F200.",
    "G99 G81 Z-10. R2. F200.",
    "G83 X5. Z-9. R1. Q2. F90",
    "G99 G73 Z-7.5 R0 Q1.5 F90",
    "G82 Z-5. R2. P100 F100",
    "G82 Z-5. R2. P0 F100",
    "G89 Z-5. R2. P250 F100",
    "G84 Z-5. R2. F100",
    "G85 Z-3. R1. F50",
    "G76 Z-3. R1. Q0.1 F50",
    "G91 G81 X1. Z-3. R-1. F70",
    "G81 Z-3. R12. F70",
)
BLOCKS = st.one_of(
    words("XY", 60),
    words("XY", 60),
    st.sampled_from(
        (
            "", "G90", "G91", "X5. Z-6.", "X1. F80.", "Y2. R1.", "X1. L3", "X1. K2", "X3. L0", "G80", "G0 X5.",
            "G1 Z9. F100", "M5", "M3 S300", "G98", "G99 X7.", "G99", "Z-4.", "G55", "G54", "G68 X0 Y0 R30.", "G69",
            "G16 X5. Y30.", "G15", "G81", "G81 X2.", "G18", "G17", "X5. Q1.", "F0", "G95 F0.1", "G43 H1", "G49", "#1=5",
            "X#1", "Y[#1+2]", "G41 D1", "G98 X2.", "G90 Y5.",
        )
    ),
    st.sampled_from(CYCLES),
)  # fmt: skip
SETUP = {"work_offsets": {"G55": {"X": 3.3, "Z": -2}}, "tools": {1: {"length": 5, "radius": 1}}}


@st.composite
def programs(draw: st.DrawFn) -> str:
    lines = ["O1", "G90 G54 G0 X0 Y0 Z10.", "M3 S500", "#1=2"]
    for _ in range(draw(st.integers(1, 3))):
        lines.append(draw(st.sampled_from(CYCLES)))
        lines += draw(st.lists(words("XY", 60), min_size=2, max_size=5))
        lines += draw(st.lists(BLOCKS, max_size=8))
    return "\n".join([*lines, "G80", "M30", ""])


@settings(max_examples=30, deadline=None)
@given(
    programs(), st.sampled_from(("fanuc-m", "meldas-m")), st.sampled_from((12.0, 1e4)), st.integers(3, 300)
)
def test_holes_give_the_same_both_ways(text: str, control_id: str, travel: float, rooms: int) -> None:
    assert differences(text, control_id, SETUP, replace(PLAIN, rooms=rooms), travel=travel) == []


@settings(max_examples=12, deadline=None)
@given(programs())
def test_holes_of_a_lathe_give_the_same_both_ways(text: str) -> None:
    turned = text.replace("G81", "G83").replace("G73", "G87").replace("Y", "C").replace("G54", "G54 G98")
    assert differences(turned, "fanuc-0i-tf", SETUP) == []


@pytest.mark.parametrize(
    "cycle", ["G98 G81 Z-10. R2. F200.", "G99 G83 Z-10. R2. Q2. F200.", "G73 Z-9. R1. Q2. F80"]
)
def test_the_scanner_drills_plain_holes(cycle: str) -> None:
    holes = "\n".join(f"X{i}. Y{i % 3}." for i in range(40))
    text = f"O1\nG90 G54 G0 X0 Y0 Z10.\n{cycle}\n{holes}\nG80\nM30\n"
    assert scanned(text, "fanuc-m") >= 40 - 2
    assert differences(text, "fanuc-m") == []


def test_another_drilling_axis_is_not_that_of_the_holes_before() -> None:
    holes = "\n".join(f"X{i}." for i in range(5))
    text = f"O1\nG90 G54 G0 X0 Y0 Z10.\nG81 Z1. R2. F200.\n{holes}\nG18\n{holes}\nG17\n{holes}\nG80\nM30\n"
    assert differences(text, "fanuc-m") == []


def test_a_hole_with_more_strokes_than_have_room_is_the_interpreters() -> None:
    holes = "\n".join(f"X{i}." for i in range(5))
    text = f"O1\nG90 G54 G0 X0 Y0 Z10.\nG83 Z-{MOST_STROKES}. R2. Q1. F200.\n{holes}\nG80\nM30\n"
    assert differences(text, "fanuc-m") == []


@pytest.mark.parametrize("cycle", ["G98 G81 X0 Y0 Z-10. R2. F200.", "G83 X5. Z-9. R1. Q2. F90"])
def test_no_hole_is_the_interpreters_where_the_room_ends(cycle: str) -> None:
    lines = [
        "O1",
        "G90 G54 G0 X0 Y0 Z10.",
        "G1 F200",
        cycle,
        *(f"X{i}." for i in range(300)),
        "G80",
        "M30",
        "",
    ]
    wide, narrow = (
        scanned("\n".join(lines), "fanuc-m", bulk=replace(PLAIN, rooms=rooms)) for rooms in (16_384, 50)
    )
    assert narrow == wide >= 300


@pytest.mark.parametrize("cycle", ["G82 Z-5. R2. P100 F100", "G89 Z-5. R2. P100 F100"])
@pytest.mark.parametrize("control_id", ["fanuc-m", "meldas-m"])
def test_holes_with_a_dwell_are_scanned(cycle: str, control_id: str) -> None:
    holes = "".join(f"X{i}. Y1.\n" for i in range(200))
    text = f"O1\nG90 G54 G0 X0 Y0 Z10.\nM3 S500\n{cycle}\n{holes}G80\n#1=#3001-#3001\nG2 X5. Y1. R900.\nM30\n"
    assert scanned(text, control_id) >= 190
    assert differences(text, control_id) == []


def test_the_clock_counts_dwells_of_holes() -> None:
    """As #3001 does, milliseconds."""
    holes = "".join(f"X{i}.\n" for i in range(200))
    text = f"O1\nG90 G54 G0 X0 Y0 Z10.\nM3 S500\nG82 Z-5. R2. P100 F100\n{holes}G80\n#100=#3001\nM30\n"
    one, other = (run(text, "fanuc-m", bulk=bulk) for bulk in (None, PLAIN))
    assert variables(one) == variables(other)
    assert Clocks.of(other).seconds == Clocks.of(one).seconds > 20.0
