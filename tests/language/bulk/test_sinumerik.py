# ruff: noqa: E501 - programs stand as they are written
"""The scanner and the interpreter give one result on SINUMERIK."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.language.bulk.settings import Bulk
from tests.examples import examples
from tests.language.bulk.both_ways import PLAIN, differences, plain_scan, run
from tests.language.bulk.programs import CODES, REPEATED_SINUMERIK, number, plain, program, words

CONTROL = "sinumerik-840d"
COMMENTS = (" ; PASS 2", ";", " ;(X) G2", "; ;")
SETUP = {
    "work_offsets": {"G54": {"X": 10, "Y": -3.3, "Z": 0.1}, "G55": {"X": 1}},
    "tools": {1: {"length": 50.05, "radius": 3}, 2: {"length": 33.3, "radius": 1.5}},
    "start": {"X": 1.5, "Z": 300},
}


@st.composite
def arc(draw: st.DrawFn) -> str:
    """An arc whose end lies on its circle, then a straight line again."""
    code = draw(st.sampled_from(("G2 ", "G3 ", "G02", "G3")))
    size = draw(st.integers(1, 40))
    shape = draw(
        st.sampled_from(
            (
                f"G91 {code}X{size} Y{size} I{size} J0",
                f"G91 {code}X={2 * size} Y0 Z{draw(number(5))} I{size}",
                f"G91 {code}X{2 * size} Y0 Z0.0000000001 I{size}",
                f"{code}I{size} J-{size}.5",
                f"G91 {code}X{draw(number(20))} Y{draw(number(20))} CR={draw(st.sampled_from(('', '-')))}{20 + size}",
            )
        )
    )
    feed = draw(st.sampled_from(("", "", " F300", " F=300")))
    return (
        shape
        + feed
        + draw(st.sampled_from(("", *COMMENTS)))
        + draw(st.sampled_from(("\nG1", "\nG90 G1", "\nG0", "\nCT X9 Y9\nG1")))
    )


OTHERS = st.sampled_from(
    (
        "", "  ", "; ONLY A COMMENT", "N100", "N100 ; NUMBER ALONE", "/G1 X5", "/3 X7", "M3 S1000", "S1200", "M5", "T1 D1", "T2 M6", "D0",
        "G4 F0.1", "G54", "G55", "G500", "G17", "G18", "G19", "G17 G1 X1", "G70", "G71", "G700", "G710", "G94 F900", "G95 F0.2",
        "G94 F800", "TRANS X10 Y-5", "ATRANS Z1", "ROT RPL=33.3", "AROT Z10", "SCALE X2 Y2", "MIRROR X0", "TRANS",
        "G41 X9", "G40 G0 X0 Y0", "G1 X20 RND=2", "X25 CHF=1", "RNDM=1", "RNDM=0", "MCALL CYCLE81(10,0,2,-3)", "MCALL",
        "G153 Z0", "SUPA Z0", "G53 Z0", "G74 Z1=0", "G9 X3", "G60", "G64", "G641 ADIS=0.5", "G642", "SOFT", "BRISK",
        "R1=R1+1", "R2=$P_EP[X]", "R3=$AA_IM[Y]", "R4=$P_F", "IF R1>5 GOTOF ENDE", "G1 X=R1", "X=IC(2) Y=AC(3)", "G91 X=AC(1)", "X=R1+2.5 F=R2+500",
        "g1 x5", "x6 ; lower case", "X 5", "X - 5", "X=-5", "X=+5", "X = 5", "X=5*2", "X=.5", "M0", "M1", "CT X30 Y30", "CT Y-10", "CIP X10 Y10 I1=5 J1=9", "G110 X0 Y0", "AP=30 RP=20",
        "G1 AP=45", 'MSG("HELLO")', "STOPRE", "G25 X-500", "WALIMON", "WALIMOF", "G931 F5", "G94 F500", "ANG=30 X12", "X1=5", "POS[X]=3",
        "A:", "MARKE: X5", "FB=50 X3", "G1 X5 FB=30", "F0", "F-5", "G0 X4 F700", "G0 X5 F0", "X1EX2", "CFTCP", "L5", "G500 X0", "DIAMON", "G90", "G1", "SPOS=30", "G63 Z5",
    )
)  # fmt: skip
WRONG = st.one_of(
    st.tuples(st.sampled_from(("G2 ", "G90 G3 ")), words("XYZ", 50), words("IJ", 50), st.sampled_from(("", " CR=50", " CR=0", " K5"))).map("".join),
    st.sampled_from(
        (
            "G41 D9 X5", "X1 X2", "G1 G0 X5", "G1 G1 X5", "X1..2", "N5 N6 X1", "G12345", "G1.5 X1", "U5", "A5", "Q5", "WHILE R1<3", "ENDWHILE",
            "G93", "G96 S100", "X-", "X+-5", "X99999", "G1 Z99999999", "G1 X1 (A)", "%", "É", "X1.5.2", "CR5", "C5", "CR=", "G G1", "GOTO NIRGENDS",
            "NOPROGRAM", "X=A", "X==5", "F", "G1 X", ": X5", ":5 X5", "N X1", "X123456789012345678", "X1234567890123.5", "DEF REAL X", "G2 X5", "G331 Z5", "'",
        )
    ),
)  # fmt: skip
MILLING = program(
    st.one_of(
        plain("XYZ", COMMENTS, equals=True),
        plain("XYZ", COMMENTS, CODES + REPEATED_SINUMERIK, equals=True),
        arc(),
    ),
    OTHERS,
    WRONG,
    "G90 G17 G54 G1 F1000",
    "ENDE: M30",
)


@settings(max_examples=examples(60), deadline=None)
@given(MILLING)
def test_programs_give_the_same_both_ways(text: str) -> None:
    assert differences(text, CONTROL, SETUP) == []


@settings(max_examples=examples(30), deadline=None)
@given(MILLING, st.integers(1, 100), st.integers(1, 7))
def test_block_limits_and_rooms_of_any_size_give_the_same(text: str, limit: int, rooms: int) -> None:
    bulk = Bulk(fewest_lines=0, scan=plain_scan, rooms=rooms, most_patience=1)
    assert differences(text, CONTROL, SETUP, bulk, block_limit=limit) == []


@settings(max_examples=examples(20), deadline=None)
@given(MILLING, st.sampled_from((100, 30, 5)))
def test_limits_of_machine_data_give_the_same(text: str, travel: int) -> None:
    limits = {"$MA_POS_LIMIT_PLUS[X]": travel, "$MA_POS_LIMIT_MINUS[Y]": -travel}
    assert differences(text, CONTROL, {**SETUP, "parameters": limits}) == []


@settings(max_examples=examples(15), deadline=None)
@given(MILLING, st.sampled_from((400.0, 310.0)))
def test_axes_with_limits_give_the_same(text: str, travel: float) -> None:
    assert differences(text, CONTROL, SETUP, travel=travel) == []


@settings(max_examples=examples(20), deadline=None)
@given(MILLING)
def test_a_machine_with_rotary_axes_gives_the_same(text: str) -> None:
    assert differences(text, CONTROL, {**SETUP, "machine": "mill5-ac-table"}) == []


PLAIN_BLOCKS = """G90 G17 G1 F1000 X1
N10 X1.5 Y=-2 Z+3. ; COMMENT
; NO BLOCK

N20
N30 G0 X10 Y0
N40 G2 X20 I5 F300
G3 X10 CR=5
G91 X1 CR=12.5 Z1
G90 G01 X0 F0500.5
M30
"""


def test_plain_blocks_are_scanned_and_not_interpreted() -> None:
    bulk = Bulk(fewest_lines=0, scan=plain_scan, most_patience=1)
    channel = run(PLAIN_BLOCKS, CONTROL, bulk=bulk)
    interpreted = [i for i, reached in enumerate(channel.executable(channel.programs[0])._reached) if reached]
    assert differences(PLAIN_BLOCKS, CONTROL) == []
    # The first block opens the program, the last one ends it.
    assert interpreted == [0, 8]


@pytest.mark.parametrize(
    "digits",
    [
        "0.1",
        "123456.78",
        "-.0004",
        "00000000012.5",
        "99999.999",
        "1.0050",
        "=-0.3",
        "=-0",
        "=-0.",
        "-0",
        "=+5",
    ],
)
def test_numbers_are_read_alike(digits: str) -> None:
    text = f"G90 G1 F1000\nX0\nX{digits} Y{digits}\nG91\nX{digits}\nM30\n"
    assert differences(text, CONTROL) == []


def test_a_variable_named_like_an_address_is_assigned_in_its_program() -> None:
    text = "DEF REAL I\nG90 G17 G1 F100\nX0\nG2 X10 I=5\nX20 Y0 I=5\nI=7\nG1 X=I\nM30\n"
    assert differences(text, CONTROL) == []


def test_a_macro_stops_the_scan_of_what_it_replaces() -> None:
    text = "G90 G1 F100\nX1\nX2\nDEFINE G1 AS G0\nG1 X3\nG1 X4\nM30\n"
    assert differences(text, CONTROL) == []


def test_single_block_switches_the_scanner_off() -> None:
    text = "G90 G1 F100\nX1\nX2\nX3\nM30\n"
    assert differences(text, CONTROL, {"switches": {"single_block": True}}, PLAIN) == []
