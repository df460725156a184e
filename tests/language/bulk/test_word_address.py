# ruff: noqa: E501 - programs stand as they are written
"""The scanner and the interpreter give one result on the word-address controls."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.language.bulk.settings import Bulk
from polycnc.toolpath import Toolpath
from tests.examples import examples
from tests.language.bulk.both_ways import PLAIN, differences, machine, plain_scan, scanned
from tests.language.bulk.programs import CODES, REPEATED, REPEATED_LATHE, any_arc, arc, number, plain, program

FANUC_COMMENTS = (" (PASS 2)", "(a;b", ";", " ; (X)", ";  ", "(1)(2)")
FANUC_OTHERS = st.sampled_from(
    (
        "", "  ", "(ONLY A COMMENT)", ";", "N100", "/G1 X5.", "M3 S1000", "S1200", "M5", "T2 M6", "G4 X0.1", "G54", "G55",
        "G54.1 P1", "G92 X0 Y0", "G52 X10. Y-5.", "G17", "G18", "G19", "G17 G1 X1.", "G20", "G21", "G94 F900", "G95 F0.2",
        "G94 F800", "G43 H1", "G43 H2 Z5.", "G49", "H3", "G68 X0 Y0 R33.3", "G69", "G51 X0 Y0 P2.", "G51 X1. I2. J1. K-1.",
        "G50", "G51.1 X5.", "G50.1 X0", "G16 G0 X5. Y30.", "G15", "G17 G0 G41 D1 X9.", "G40 G0 X0 Y0", "G40 G1 X99. F80",
        "G90 G1 X20. ,R2.", "G81 X1. Y2. R2. Z-3. F100", "G83 R1. Z-9. Q2. F90", "G80", "G53 Z0", "G28 Z0", "G28 G91 Z0",
        "#1=#1+1", "#100=[#5001]", "IF[#1GT5]GOTO9999", "G1 X#1", "G1 X[#1+2.5] F#2", "g1 x5. (lower case)", "G61", "G64",
        "M0", "M1", "G67", "X 5.", "G10 L2 P1 X1.", "G31 X5.", "M97", "G1 F1000.",
    )
)  # fmt: skip
FANUC_WRONG = st.one_of(
    any_arc(),
    st.sampled_from(
        (
            "G42 D2 G1 X50.", "G1 Y30. ,C1.", "G5.1 Q1", "M98 P9999", "G66 P9999", "X123456789", "G1 Q5.", "G12345",
            "G1.5 X1.", "X1..2", "N5 N6 X1.", "O7", "%", "G65 P9999", "U5.", "X1.Y2.Z3.A4.", "WHILE[#1LT3]DO1", "END1",
            "G93", "G94", "G95", "G96 S100", "M96 P10", "F0", "G4", "G1 X-.", "G1 X+-5.", "X99999.", "G1 Z99999999",
            "G1 X1. X2.", "G1 F", "G1 X1.;Y2.", "G1 X1. (a) ; (b", ")", "é", "G1 X1.\tY2.", "G0001 X1.", "N X1.",
        )
    ),
)  # fmt: skip
#: Only loops are scanned, once they have run for long.
LOOPS = replace(PLAIN, fewest_lines=500)
SETUP = {
    "work_offsets": {"G54": {"X": 10, "Y": -3.3, "Z": 0.1}, "G55": {"X": 1}, "G54.1 P1": {"Z": 7.7}},
    "tools": {1: {"length": 50.05, "radius": 3}, 2: {"length": 33.3, "radius": 1.5}, 3: {"length": 1}},
    "start": {"X": 1.5, "Z": 300},
}
LATHE_SETUP = {"tools": {1: {"x": 5, "z": 3, "radius": 0.8, "tip": 3}}}
FANUC = program(
    st.one_of(
        plain("XYZ", FANUC_COMMENTS), plain("XYZ", FANUC_COMMENTS, CODES + REPEATED), arc(FANUC_COMMENTS)
    ),
    FANUC_OTHERS,
    FANUC_WRONG,
    "O0001\nG90 G54 G1 F1000.",
    "N9999 M30",
)


def test_no_block_behind_a_full_chunk_is_the_interpreters(monkeypatch: pytest.MonkeyPatch) -> None:
    """It would be looked up in its page, line by line."""
    for module in ("channel.channel", "language.bulk.scanner"):
        monkeypatch.setattr(f"polycnc.{module}.CHUNK_ROWS", 50)
    toolpath = Toolpath(machine("mill3").channel_axes(1), chunk_rows=50)
    text = "\n".join(["G90 G54 G1 F1000.", *(f"X{i}." for i in range(1, 301)), "M30"])
    assert scanned(text, "fanuc-m", toolpath=toolpath) >= 300
    assert [len(chunk) for chunk in toolpath.chunks[:6]] == [50] * 6


def test_no_pass_of_a_loop_behind_a_full_chunk_is_the_interpreters(monkeypatch: pytest.MonkeyPatch) -> None:
    text = "O1\nG90 G54 G1 F1000.\n#1=0\nWHILE[#1LT5000]DO1\nX#1\n#1=#1+1\nEND1\nM30\n"
    whole = scanned(text, "fanuc-m", bulk=LOOPS)
    for module in ("channel.channel", "language.bulk.scanner", "language.expressions.hot_loop"):
        monkeypatch.setattr(f"polycnc.{module}.CHUNK_ROWS", 500)
    toolpath = Toolpath(machine("mill3").channel_axes(1), chunk_rows=500)
    assert scanned(text, "fanuc-m", bulk=LOOPS, toolpath=toolpath) > whole - 100 > 10_000


@settings(max_examples=examples(30), deadline=None)
@given(FANUC, st.sampled_from(("fanuc-m", "meldas-m")))
def test_milling_programs_give_the_same_both_ways(text: str, control_id: str) -> None:
    assert differences(text, control_id, SETUP) == []


@settings(max_examples=examples(12), deadline=None)
@given(FANUC, st.sampled_from(({3401: 1}, {5003: 1}, {3410: 0.5})))
def test_parameters_count_both_ways(text: str, parameters: dict[int, float]) -> None:
    assert differences(text, "fanuc-m", {**SETUP, "parameters": parameters}) == []


@settings(max_examples=examples(30), deadline=None)
@given(FANUC, st.integers(1, 100), st.integers(1, 7))
def test_block_limits_and_rooms_of_any_size_give_the_same(text: str, limit: int, rooms: int) -> None:
    bulk = Bulk(fewest_lines=0, scan=plain_scan, rooms=rooms, most_patience=1)
    assert differences(text, "fanuc-m", SETUP, bulk, block_limit=limit) == []


@settings(max_examples=examples(30), deadline=None)
@given(FANUC, st.sampled_from((400.0, 310.0)), st.sampled_from(("fanuc-m", "meldas-m")))
def test_axes_with_limits_give_the_same(text: str, travel: float, control_id: str) -> None:
    assert differences(text, control_id, SETUP, travel=travel) == []


@settings(max_examples=examples(15), deadline=None)
@given(FANUC)
def test_a_machine_with_rotary_axes_gives_the_same(text: str) -> None:
    assert differences(text, "fanuc-m", {**SETUP, "machine": "mill5-ac-table"}) == []


SYNTEC_COMMENTS = (" (PASS 2)", " // X5", ";", " ; ", "(1) (2)")
SYNTEC = program(
    st.one_of(plain("XYZ", SYNTEC_COMMENTS), plain("XYZ", SYNTEC_COMMENTS, CODES + REPEATED), arc(SYNTEC_COMMENTS)),
    st.sampled_from(
        (
            "", "  ", "(ONLY A COMMENT)", "// COMMENT", "N100", "/G1 X5.", "M3 S1000", "M5", "T2 M6", "G4 X0.1", "G54", "G55",
            "G92 X0 Y0", "G52 X10. Y-5.", "G17", "G18", "G19", "G70", "G71", "G94", "G95 F0.2", "G43 H1", "G43 H2 Z5.",
            "G49", "H3", "G68 X0 Y0 R33.3", "G69", "G51 X0 Y0 P2.", "G51 X1. I2. J1. K-1.", "G50", "G51.1 X5.", "G50.1 X0",
            "G15", "G17 G0 G41 D1 X9.", "G40 G0 X0 Y0", "G81 X1. Y2. R2. Z-3. F100", "G80", "G53 Z0", "G28 Z0",
            "@1:=5", "@2=#1850", "G1 X@1", "g1 x5.", "G61", "G64", "M0", "M1", "X 5.", "X1 0.", "G1 F1000.", "G94 F700",
        )
    ),
    st.one_of(FANUC_WRONG, st.sampled_from(("G2.4 X5. Y5.", "G93", "G93 F2.", "G1 X5. F2", "L3", "(open", "G2 I5. L3"))),
    "G90 G54 G1 F1000.",
    "M30",
)  # fmt: skip


@settings(max_examples=examples(30), deadline=None)
@given(SYNTEC)
def test_syntec_programs_give_the_same_both_ways(text: str) -> None:
    assert differences(text, "syntec-mill", SETUP) == []


LATHE = program(
    plain("XZUW", FANUC_COMMENTS, ("G1 ", "G01", "G0 ", "G00", "G1", *REPEATED_LATHE)),
    st.sampled_from(
        (
            "", "(ONLY A COMMENT)", "N100", "M3 S1000", "M5", "T0101", "T0202", "T0100", "G4 X0.1", "G54", "G55", "G50 S2000",
            "G96 S100", "G97 S500", "G98 F100.", "G99 F0.2", "G20", "G21", "G28 U0", "G53 X0", "#1=#5001", "G1 X#1 F#1",
            "G0 G42 X30.", "G40 G0 X50. Z9.", "G92 X20. Z-5. F1.", "G90 X30. Z-5. F80.", "G0 X40.", "G32 Z-5. F1.", "M1",
            "G98 G1 F120.",
        )
    ),
    st.one_of(FANUC_WRONG, st.sampled_from(("G70 P1 Q2", "G1 X1. A30.", "G98", "G99", "G1 X9. U1."))),
    "O0001\nG98 G1 F100.",
    "M30",
)  # fmt: skip


@settings(max_examples=examples(25), deadline=None)
@given(LATHE)
def test_lathe_programs_give_the_same_both_ways(text: str) -> None:
    assert differences(text, "fanuc-0i-tf", LATHE_SETUP) == []


@pytest.mark.parametrize("digits", ["0.1", "123456.78", "-.0004", "00000000012.5", "99999.999", "1.0050"])
def test_numbers_are_read_alike(digits: str) -> None:
    text = f"O1\nG90 G1 F1000.\nX{digits} Y{digits}\nG91\nX{digits}\nM30\n"
    assert differences(text, "fanuc-m") == []


@settings(max_examples=examples(30), deadline=None)
@given(st.lists(number(999), min_size=1, max_size=20))
def test_coordinates_are_rounded_alike(numbers: list[str]) -> None:
    text = "\n".join(("O1", "G90 G1 F1000.", *(f"X{value}" for value in numbers), "M30", ""))
    assert differences(text, "syntec-mill") == []
