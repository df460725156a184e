"""Moves that are scanned for radius compensation are compensated as those of the interpreter."""

from __future__ import annotations

from math import cos, inf, radians, sin
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.channel.moves.path import Move
from polycnc.compensation.cutter import CutterCompensation
from tests.examples import examples
from tests.language.bulk.both_ways import PLAIN, differences, run, scanned
from tests.language.bulk.programs import arc
from tests.mainrun.motion.random_programs import Compressed, Smoothed

CONTROLS = ("fanuc-m", "meldas-m", "syntec-mill")
SETUP = {
    "work_offsets": {"G54": {"X": 10, "Y": -3.3}},
    "tools": {1: {"length": 50, "radius": 3}, 2: {"length": 30, "radius": 0.5}},
    "start": {"X": -20, "Y": -20, "Z": 100},
}
#: What stands between the moves of a contour, and may end a run of them.
BETWEEN = (
    "", "", "", "(COMMENT)", ";", "N7", "F800.", "S1200", "M8", "G4 X0.1", "#1=#1+1", "G90", "G91", "G1", "G0", "D2",
    "D1", "Z-2.", "G1 X0 Y0", "G91 X0 Y0", "G41", "G42 D1", "G40 X0 Y0", "G17", "G68 X0 Y0 R10.", "G69", "G39", "M1",
    "G38 X1. Y1.", "G64", "G61", "X5. Y5. S900", "G90 G1 X99999. F100", "G2 X10. Y0 R20.", "G3 X3. Y3. I5. J5.",
    "X1. Y#1", "X5. ,R1.", "M99",
)  # fmt: skip


@st.composite
def contour(draw: st.DrawFn) -> str:
    """Many short moves, now and then something else."""
    size = draw(st.sampled_from((0.4, 3.0, 40.0)))
    lines = [
        "O0001",
        "G21 G90 G54 G0 X-10. Y-10. Z5.",
        draw(st.sampled_from(("G41", "G42"))) + " D1 G1 X0 Y0 F500.",
    ]
    for _ in range(draw(st.integers(2, 12))):
        for _ in range(draw(st.integers(1, 6))):
            words = [
                f"{axis}{draw(st.floats(-size, size)):.{draw(st.sampled_from((1, 3, 4)))}f}"
                for axis in draw(st.sampled_from(("XY", "X", "Y", "XYZ")))
            ]
            lines.append("".join(words) + draw(st.sampled_from(("", "", "", " F300.", "(C)", ";"))))
        lines.append(draw(st.sampled_from(BETWEEN)))
        if draw(st.integers(0, 2)) == 0:
            lines += [f"G91 {draw(arc(('(C)',)))}", draw(st.sampled_from(("", "G90")))]
    return "\n".join([*lines, "G90 G40 G1 X-20. Y-20.", "M30", ""])


@settings(max_examples=examples(75), deadline=None)
@given(contour(), st.sampled_from(CONTROLS), st.sampled_from((30.0, 400.0)))
def test_contours_give_the_same_both_ways(text: str, control_id: str, travel: float) -> None:
    assert differences(text, control_id, SETUP, travel=travel, block_limit=500) == []


@settings(max_examples=examples(20), deadline=None)
@given(contour(), st.integers(3, 60))
def test_a_limit_of_blocks_is_exact_within_a_run(text: str, limit: int) -> None:
    assert differences(text, "fanuc-m", SETUP, block_limit=limit) == []


@st.composite
def smooth(draw: st.DrawFn) -> str:
    """Chords of a curve, as CAM systems write them: most of them are handed over many at once."""
    lines = [
        "O0001",
        "G21 G90 G54 G0 X-10. Y-10. Z5.",
        f"{draw(st.sampled_from(('G41', 'G42')))} D1 G1 X0 Y0 F500.",
    ]
    angle, x, y = 0.0, 0.0, 0.0
    for _ in range(draw(st.integers(1, 4))):
        bend = draw(st.floats(-25.0, 25.0))
        for _ in range(draw(st.integers(4, 30))):
            angle += bend
            x, y = x + 4.0 * cos(radians(angle)), y + 4.0 * sin(radians(angle))
            lines.append(f"G90 G1 X{x:.3f} Y{y:.3f}{draw(st.sampled_from(('', '', ' F300.', ' Z-1.')))}")
        lines.append(draw(st.sampled_from(BETWEEN)))
    return "\n".join([*lines, "G90 G40 G1 X-20. Y-20.", "M30", ""])


@settings(max_examples=examples(50), deadline=None)
@given(
    smooth(), st.sampled_from(CONTROLS), st.sampled_from((30.0, 90.0, inf)), st.sampled_from((20, 70, 500))
)
def test_chords_of_curves_give_the_same_both_ways(
    text: str, control_id: str, travel: float, limit: int
) -> None:
    assert differences(text, control_id, SETUP, travel=travel, block_limit=limit) == []


@pytest.mark.parametrize("control_id", CONTROLS)
def test_most_moves_of_a_contour_are_handed_over_at_once(
    control_id: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    single: list[Move] = []

    def move(stage: CutterCompensation, move: Move) -> None:
        single.append(move)
        one(stage, move)

    one = CutterCompensation.move
    monkeypatch.setattr(CutterCompensation, "move", move)
    points = "\n".join(f"X{50 * cos(i / 90):.3f} Y{50 * sin(i / 90):.3f}" for i in range(1, 500))
    text = f"O0001\nG90 G54 G0 X10. Y0 Z5.\nG41 D1 G1 X50. Y0 F500.\n{points}\nG40 X-20.\nM30\n"
    run(text, control_id, SETUP, PLAIN)
    assert len(single) < 20
    assert differences(text, control_id, SETUP) == []


def test_a_limit_of_travel_is_kept_by_the_way_of_the_tool() -> None:
    """The contour ends at X 99 of 100; the tool, 3 mm beside it, would pass the limit."""
    points = "\n".join(f"X{99 * sin(i / 90):.3f} Y{80 * cos(i / 90):.3f}" for i in range(1, 180))
    text = f"O0001\nG90 G54 G0 X0 Y10. Z5.\nG41 D1 G1 X0 Y80. F500.\n{points}\nG40 X0 Y0\nM30\n"
    setup = {"tools": SETUP["tools"]}
    (alarm,) = run(text, "fanuc-m", setup, PLAIN, travel=100.0).alarms
    assert 100 < alarm.line < 150
    assert not run(text.replace("G41", "G42"), "fanuc-m", setup, PLAIN, travel=100.0).alarms
    assert differences(text, "fanuc-m", setup, travel=100.0) == []


@pytest.mark.parametrize("control_id", CONTROLS)
def test_a_contour_is_scanned(control_id: str) -> None:
    points = "\n".join(f"X{10 + i % 7}.{i % 10} Y{i}.5" for i in range(40))
    text = f"O0001\nG90 G54 G0 X-10. Y-10. Z5.\nG42 D1 G1 X0 Y0 F500.\n{points}\nG40 X-20.\nM30\n"
    assert scanned(text, control_id, SETUP) >= 35
    assert differences(text, control_id, SETUP) == []


@st.composite
def turned(draw: st.DrawFn) -> str:
    """A contour of a lathe under nose radius compensation."""
    size = draw(st.sampled_from((0.4, 3.0, 40.0)))
    side = draw(st.sampled_from(("G41", "G42")))
    lines = ["O0001", "G21 G18 G98 T0101", "G0 X60. Z5.", f"{side} G1 X50. Z0 F500."]
    for _ in range(draw(st.integers(2, 10))):
        for _ in range(draw(st.integers(1, 6))):
            words = [
                f"{axis}{draw(st.floats(-size, size)):.{draw(st.sampled_from((1, 3)))}f}"
                for axis in draw(st.sampled_from(("UW", "XZ", "U", "W", "XW")))
            ]
            lines.append("".join(words) + draw(st.sampled_from(("", "", "", " F300.", "(C)"))))
        between = ("", "G1", "U0 W0", "G3 U2. W-1. R1.", "S900", "G42", "T0202", "G40 U0", "M8", "F200.", ";")
        lines.append(draw(st.sampled_from(between)))
    return "\n".join([*lines, "G40 G1 X80. Z10.", "M30", ""])


@settings(max_examples=examples(40), deadline=None)
@given(turned())
def test_turned_contours_give_the_same_both_ways(text: str) -> None:
    tools = {n: {"x": 5, "z": 3, "radius": 0.8 / n, "tip": 3} for n in (1, 2)}
    assert differences(text, "fanuc-0i-tf", {"tools": tools}, block_limit=500) == []


SINUMERIK_BETWEEN = (
    "", "", "; COMMENT", "N7", "F800", "S1200", "M8", "G4 F0.1", "R1=R1+1", "G90", "G91", "G0", "Z-2", "G1 X0 Y0",
    "G41", "G42", "G40 X0 Y0", "ROT RPL=10", "ROT", "NORM", "KONT", "G450", "G451", "M1", "G64", "G60", "X5 Y5 S900",
    "CUTCONON", "CUTCONOF", "X=R1 Y3", "RND=1 X5", "STOPRE", "CDON", "CDOF", "DISC=50", "OFFN=0.5", "TRANS X1",
    "RNDM=1", "G2 X10 Y0 CR=20", "G3 X3 Y3 I5 J5", 'MSG("A")', "FB=300 X3", "G461", "REPEAT A B P1", "M17",
)  # fmt: skip


@st.composite
def sinumerik_contour(draw: st.DrawFn) -> str:
    """A contour of SINUMERIK with what acts on its compensation in between."""
    corner = draw(st.sampled_from(("G450", "G451", "NORM", "KONT", "CDON")))
    side = draw(st.sampled_from(("G41", "G42")))
    lines = ["G71 G90 G54 T1 D1", "G0 X-10 Y-10 Z5", corner, f"{side} G1 X0 Y0 F500"]
    for _ in range(draw(st.integers(2, 10))):
        for _ in range(draw(st.integers(1, 6))):
            words = [
                f"{axis}{draw(st.floats(-30.0, 30.0)):.{draw(st.sampled_from((1, 3)))}f}"
                for axis in draw(st.sampled_from(("XY", "X", "Y", "XYZ")))
            ]
            lines.append(" ".join(words) + draw(st.sampled_from(("", "", " F300", " ;C"))))
        lines.append(draw(st.sampled_from(SINUMERIK_BETWEEN)))
        if draw(st.integers(0, 2)) == 0:
            size = draw(st.integers(1, 20))
            lines += [f"G91 G{draw(st.integers(2, 3))} X{size} Y{size} CR={size + 9}", "G1 G90"]
    return "\n".join([*lines, "G90 G40 G1 X-20 Y-20", "M30", ""])


@settings(max_examples=examples(40), deadline=None)
@given(sinumerik_contour(), st.sampled_from((0.3, 3.0)))
def test_sinumerik_contours_give_the_same_both_ways(text: str, radius: float) -> None:
    setup = {**SETUP, "tools": {1: {"length": 50, "radius": radius}}}
    assert differences(text, "sinumerik-840d", setup, block_limit=500) == []


def test_a_contour_of_sinumerik_is_scanned() -> None:
    points = "\n".join(f"X{10 + i % 7}.{i % 10} Y{i}.5" for i in range(40))
    text = f"T1 D1\nG90 G54 G0 X-10 Y-10 Z5\nG42 G1 X0 Y0 F500\n{points}\nG40 X-20\nM30\n"
    assert scanned(text, "sinumerik-840d", SETUP) >= 35


def test_an_alarm_within_a_run_stops_at_its_block() -> None:
    """The tool is far larger than the notch that the contour runs into."""
    text = (
        "O0001\nG90 G54 G0 X-10. Y-10. Z5.\nG41 D1 G1 X0 Y0 F500.\nX10.\nX20.\nX20.5 Y-8.\nX21. Y-8.\nX21.5 Y0\n"
        "X30.\nX40.\nX50. F600.\nX60.\nG40 X-20.\nM30\n"
    )
    assert run(text, "fanuc-m", SETUP).alarms
    assert differences(text, "fanuc-m", SETUP) == []


@pytest.mark.parametrize("control_id", ["fanuc-m", "meldas-m"])
def test_a_block_left_out_in_front_of_compensation_changes_nothing(control_id: str) -> None:
    text = "G90G54G1F500.\n/X5.\nG41D1X9.Y1.\n;\n;\nX20.\nX20.Y20.\nG40X0Y0\nM30\n"
    setup = {**SETUP, "switches": {"block_skip": True}}
    assert differences(text, control_id, setup) == []
    ways = [
        [row.end for row in run(each, control_id, setup).toolpath.rows()]
        for each in (text, text.replace("/X5.\n", ""))
    ]
    assert ways[0] == ways[1]


@settings(max_examples=examples(30), deadline=None)
@given(
    st.integers(0, 10**6), st.sampled_from(("", "STOPRE", "M8", "R1=1", "G0 Z1\nG1", 'MSG("A")', "X1 Y1 M8"))
)
def test_cuts_that_a_compressor_takes_are_the_same_both_ways(seed: int, between: str) -> None:
    assert (
        differences(_with(Compressed(Random(seed), "sinumerik-840d"), between, seed), "sinumerik-840d") == []
    )


@settings(max_examples=examples(30), deadline=None)
@given(
    st.integers(0, 10**6),
    st.sampled_from(("", "G04 P1", "M8", "#1=1", "G0 Z1.\nG1", "G61", "X1. Y1. M8", "Y1. A2.")),
)
def test_cuts_that_syntec_smooths_are_the_same_both_ways(seed: int, between: str) -> None:
    writer = Smoothed(Random(seed), "syntec-mill")
    setup = {**writer.setup, "machine": "mill4"}
    assert differences(_with(writer, between, seed), "syntec-mill", setup) == []


def _with(writer: Compressed, between: str, seed: int) -> str:
    """A program with a line in the middle of it, somewhere."""
    lines = writer.program().split("\n")
    middle = 1 + seed % max(len(lines) - 2, 1)
    return "\n".join((*lines[:middle], between, *lines[middle:]))
