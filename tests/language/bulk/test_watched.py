# ruff: noqa: E501 - programs stand as they are written
"""What watches or feeds a program from outside: interrupts, programs from elsewhere, zones; both ways give the same."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.examples import examples
from tests.language.bulk.both_ways import PLAIN, differences, run
from tests.language.bulk.programs import plain, program
from tests.language.bulk.test_sinumerik import COMMENTS as SINUMERIK_COMMENTS
from tests.language.bulk.test_word_address import FANUC_COMMENTS, FANUC_OTHERS, FANUC_WRONG, SYNTEC_COMMENTS

LINES = st.integers(2, 40)
PLACES = st.sampled_from((0.5, 3.0, 30.0, 101.0))


def interrupts(line: int, place: float) -> dict[str, object]:
    """A setup in which an input comes while a block moves X past a place."""
    return {"switches": {"interrupts": [{"input": 1, "line": line, "at": {"X": place}}]}}


FANUC = program(
    plain("XYZ", FANUC_COMMENTS),
    st.one_of(FANUC_OTHERS, st.sampled_from(("M96 P9100", "M97", "M96 P9100"))),
    FANUC_WRONG,
    "O0001\nG90 G54 G1 F1000.\nM96 P9100",
    "M30",
)


@settings(max_examples=examples(30), deadline=None)
@given(FANUC, LINES, PLACES, st.sampled_from(("G91 G0 Z20.\n", "", "X1.\nX2. S300\nG1 F50. Y7.\n")))
def test_an_interruption_macro_gives_the_same(text: str, line: int, place: float, body: str) -> None:
    macro = {"O9100": f"O9100\n#101=#5001\n{body}M99"}
    assert differences(text, "fanuc-m", interrupts(line, place), files=macro) == []


SINUMERIK = program(
    plain("XYZ", SINUMERIK_COMMENTS, equals=True),
    st.sampled_from(("DISABLE(1)", "ENABLE(1)", "R1=R1+1", "S500", "G54", "CLRINT(1)", "SETINT(1) ASUP")),
    st.just("GOTOF NIRGENDS"),
    "G90 G54 G1 F1000\nSETINT(1) ASUP",
    "M30",
)


@settings(max_examples=examples(30), deadline=None)
@given(SINUMERIK, LINES, PLACES, st.sampled_from(("G91 G0 Z20\n", "", "X1\nX2 S300\nG1 F50 Y7\n")))
def test_an_asynchronous_subprogram_gives_the_same(text: str, line: int, place: float, body: str) -> None:
    asup = {"ASUP.SPF": f"R9=R9+1\n{body}RET"}
    assert differences(text, "sinumerik-840d", interrupts(line, place), files=asup) == []


ZONES = (
    "G22 X150. Y150. Z150. I-150. J-150. K-150.",
    "G22 X60. Y60. Z60. I40. J40. K40.",
    "G23",
    "G22",
    "G23",
)


@settings(max_examples=examples(30), deadline=None)
@given(
    program(plain("XYZ", FANUC_COMMENTS), st.sampled_from(ZONES), FANUC_WRONG, "O1\nG90 G1 F1000.", "M30"),
    st.sampled_from(("fanuc-m", "meldas-m")),
    st.sampled_from((0, 1)),
)
def test_stored_stroke_limits_give_the_same(text: str, control_id: str, inside: int) -> None:
    assert differences(text, control_id, {"parameters": {1300: inside}}) == []


@settings(max_examples=examples(15), deadline=None)
@given(program(plain("XYZ", SYNTEC_COMMENTS), st.sampled_from(ZONES), FANUC_WRONG, "G90 G1 F1000.", "M30"))
def test_stroke_limits_of_syntec_give_the_same(text: str) -> None:
    assert differences(text, "syntec-mill") == []


@settings(max_examples=examples(15), deadline=None)
@given(st.data())
def test_programs_from_elsewhere_give_the_same(data: st.DataObject) -> None:
    block = plain("XYZ", FANUC_COMMENTS)
    outside = data.draw(program(block, FANUC_OTHERS, FANUC_WRONG, "O0700", "M99"))
    main = data.draw(
        program(
            block, st.sampled_from(("M198 P700", "M198 P700 L2")), st.just(""), "O1\nG90 G1 F1000.", "M30"
        )
    )
    assert differences(main, "fanuc-m", files={"external:O0700": outside}, block_limit=20_000) == []


@settings(max_examples=examples(15), deadline=None)
@given(st.data())
def test_external_subprograms_of_sinumerik_give_the_same(data: st.DataObject) -> None:
    block = plain("XYZ", SINUMERIK_COMMENTS, equals=True)
    outside = data.draw(
        program(block, st.sampled_from(("R1=R1+1", "S500", "G18")), st.just(""), "G91", "M17")
    )
    main = data.draw(program(block, st.just('EXTCALL("ROUGH")'), st.just(""), "G90 G1 F1000", "M30"))
    assert differences(main, "sinumerik-840d", files={"external:ROUGH.SPF": outside}) == []


@pytest.mark.parametrize(
    ("control_id", "text", "files"),
    [
        ("fanuc-m", "O1\nG90 G1 F100.\nM96 P9100\nX1.\nX80.\nX90.\nX95.\nM30\n", {"O9100": "O9100\n#101=#5001\nG91 G0 Z20.\nM99"}),
        ("sinumerik-840d", "G90 G1 F100\nSETINT(1) ASUP\nX1\nX2\nX80\nX90\nM30\n", {"ASUP.SPF": "R9=R9+1\nG91 G0 Z20\nRET"}),
    ],
)  # fmt: skip
def test_an_interrupt_within_a_run_of_plain_blocks_is_taken(
    control_id: str, text: str, files: dict[str, str]
) -> None:
    setup = interrupts(5, 30.0)
    channel = run(text, control_id, setup, PLAIN, files=files)
    assert any(row.end[:3] == (30.0, 0.0, 20.0) for row in channel.toolpath.rows())
    assert differences(text, control_id, setup, files=files) == []


def test_a_zone_within_a_run_of_plain_blocks_is_respected() -> None:
    text = "O1\nG90 G1 F100.\nG22 X60. Y10. Z10. I40. J-10. K-10.\nX1.\nX2.\nX50.\nX3.\nM30\n"
    (alarm,) = run(text, "fanuc-m", bulk=PLAIN).alarms
    assert alarm.line == 6
    assert differences(text, "fanuc-m") == []
