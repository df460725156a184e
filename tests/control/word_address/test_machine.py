"""Interlocks, interruptions, zones, offsets of moves: what stands beside plain motion."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.control.word_address.stroke_check import StrokeZone
from polycnc.toolpath import Kind
from tests.support import codes, ends, moves, run


@pytest.mark.parametrize(
    ("control_id", "block", "code"),
    [
        ("fanuc-m", "M3", "1095"),
        ("fanuc-m", "M14", "1095"),
        ("fanuc-m", "M19", "1094"),
        ("fanuc-m", "S5", "1105"),
        ("meldas-m", "M4", "3009"),
        ("meldas-m", "M19", "3009"),
        ("meldas-m", "S5", "3007"),
    ],
)
def test_a_loose_tool_keeps_the_spindle_still(control_id: str, block: str, code: str) -> None:
    assert codes(run(f"M11\n{block}\nM30\n", control_id)) == [code]
    assert codes(run(f"M11\nM10\n{block}\nM30\n", control_id)) == []


@pytest.mark.parametrize(("z", "refused"), [(0.0, False), (-20.0, False), (-20.5, True), (5.0, True)])
def test_the_tool_changes_at_a_reference_point_of_z(z: float, refused: bool) -> None:
    channel = run(f"G0 X7. Z{z}\nT1 M6\nM30\n", setup={"parameters": {"1241 Z": -20}})
    assert codes(channel) == (["1046"] if refused else [])


def box(inside: bool) -> StrokeZone:
    return StrokeZone((10.0, -5.0), (20.0, 5.0), (0, 1), inside)


@pytest.mark.parametrize(
    ("target", "refused"),
    [("X15. Y0", True), ("X30. Y0", True), ("X30. Y30.", False), ("X9.9 Y0", False), ("X0 Y40.", False)],
)
def test_a_forbidden_box_is_not_crossed(target: str, refused: bool) -> None:
    channel = run(f"G22 X20. Y5. Z5. I10. J-5. K-5.\nG0 {target}\nM30\n")
    assert bool(codes(channel)) == refused


def test_the_direction_of_a_zone_alarm_is_that_of_the_move() -> None:
    text = "G0 X30.\nG22 X20. Y5. Z5. I10. J-5. K-5.\nX15.\nM30\n"
    assert codes(run(text)) == ["OT0503"]


def test_a_box_that_must_not_be_left() -> None:
    channel = run("G22 X20. Y5. Z5. I-20. J-5. K-5.\nG0 X21.\nM30\n", setup={"parameters": {"1300#0": 1}})
    assert codes(channel) == ["OT0502"]


@given(st.integers(-50, 50).filter(bool), st.integers(1, 9))
def test_a_lengthened_move_is_undone_by_a_shortened_one(way: int, radius: int) -> None:
    setup = {"tools": {1: {"radius": radius}}}
    there = run(f"G91 G0 G45 X{way}. D1\nG45 X{-way}. D1\nM30\n", setup=setup)
    assert there.coordinates.position[0] == pytest.approx(0.0)
    longer = run(f"G91 G0 G45 X{way}. D1\nM30\n", setup=setup).coordinates.position[0]
    shorter = run(f"G91 G0 G46 X{way}. D1\nM30\n", setup=setup).coordinates.position[0]
    assert longer + shorter == pytest.approx(2.0 * way)
    assert abs(longer) - abs(way) == pytest.approx(radius)


def test_a_double_offset_counts_twice() -> None:
    setup = {"tools": {1: {"radius": 3}}}
    assert ends(run("G91 G0 G47 Y10. D1\nG48 Y10.\nM30\n", setup=setup)) == [(0, 16, 0), (0, 20, 0)]


@pytest.mark.parametrize("ending", ["X1. Y0", "X3. Y0"])
def test_one_way_positioning_always_ends_in_the_same_direction(ending: str) -> None:
    setup = {"parameters": {"5440 X": 0.5}}
    last = moves(run(f"G0 X2.\nG60 {ending}\nM30\n", setup=setup))[-2:]
    assert last[1].end[0] - last[0].end[0] == pytest.approx(0.5)


def test_circle_cutting_is_tangential_and_ends_where_it_began() -> None:
    rows = moves(run("G0 X4. Y4.\nG13 I10. D1 F100\nM30\n", "meldas-m", setup={"tools": {1: {"radius": 2}}}))
    assert [row.kind for row in rows[1:]] == [Kind.CCW] * 3
    assert rows[-1].end[:2] == rows[0].end[:2]
    assert rows[1].end[:2] == (12.0, 4.0)


def test_an_interruption_acts_once() -> None:
    setup = {"switches": {"interrupts": [{"input": 1, "line": 3, "at": {"X": 4}}]}}
    text = "O0001\nM96 P2\nN5 G1 X8. F100\nG0 X0\n#1=#1+1\nIF [#1 LT 2] GOTO 5\nM30\nO0002\nG0 Z1.\nM99\n"
    assert ends(run(text, setup=setup)) == [(4, 0, 0), (4, 0, 1), (0, 0, 1), (8, 0, 1), (0, 0, 1)]


def test_without_m96_an_input_interrupts_nothing() -> None:
    setup = {"switches": {"interrupts": [{"input": 1, "line": 1, "at": {"X": 4}}]}}
    assert ends(run("G1 X8. F100\nM30\n", setup=setup)) == [(8, 0, 0)]


def test_a_mirror_by_m_code_turns_arcs_round() -> None:
    kinds = [row.kind for row in moves(run("M71\nG2 X10. Y10. R10. F50\nM72\nG2 X20. Y0 R10.\nM30\n"))]
    assert kinds == [Kind.CCW, Kind.CW]
