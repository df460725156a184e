"""Drilling cycles as programs see them: lifetimes of words, levels, what enters and ends the mode."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.toolpath import Kind
from tests.support import codes, ends, moves, run


def drilled(text: str, control_id: str = "fanuc-m") -> list[tuple[float, float, float]]:
    """Ends of the feed strokes."""
    return [(r.end[0], r.end[1], r.end[2]) for r in moves(run(text, control_id)) if r.kind is Kind.FEED]


@given(initial=st.integers(1, 90), r=st.integers(-20, 20), depth=st.integers(1, 60), x=st.integers(-99, 99))
def test_absolute_and_incremental_data_drill_the_same_hole(initial: int, r: int, depth: int, x: int) -> None:
    bottom = r - depth
    head = f"G0 Z{initial}. F100\n"
    absolute = run(f"{head}G90 G81 X{x}. R{r}. Z{bottom}.\nM30\n")
    incremental = run(f"{head}G91 G81 X{x}. R{r - initial}. Z{-depth}.\nM30\n")
    assert ends(absolute) == ends(incremental)


@given(st.integers(1, 8), st.integers(-9, 9), st.integers(-9, 9))
def test_repeats_are_evenly_spaced(count: int, dx: int, dy: int) -> None:
    found = drilled(f"G0 Z5. F100\nG91 G99 G81 X{dx}. Y{dy}. R-4. Z-2. K{count}\nM30\n")
    assert found == [(dx * k, dy * k, -1) for k in range(1, count + 1)]


def test_g99_leaves_the_initial_level_as_it_was() -> None:
    text = "G0 Z30. F100\nG99 G81 X1. R2. Z-1.\nX2.\nG98 X3.\nG80\nM30\n"
    assert ends(run(text))[-1] == (3, 0, 30)


def test_the_initial_level_is_taken_anew_behind_g80() -> None:
    text = "G0 Z30. F100\nG81 X1. R2. Z-1.\nG80 Z12.\nG81 X2. R2. Z-1.\nM30\n"
    assert ends(run(text))[-1] == (2, 0, 12)


@pytest.mark.parametrize("ending", ["G80", "G0", "G1", "G2", "G3", "G33"])
def test_the_data_of_a_cycle_end_with_it(ending: str) -> None:
    text = f"G0 Z30. F100\nG83 X1. R2. Z-1. Q5.\n{ending}\nG83 X2. R2. Z-1.\nM30\n"
    assert codes(run(text)) == ["PS0045"]


def test_a_block_without_axis_words_keeps_its_p_and_q_to_itself() -> None:
    text = "G0 Z30. F100\nG99 G82 X1. R2. Z-1. P100\nP900\nX2.\nM30\n"
    dwells = [row.curve[0] for row in moves(run(text)) if row.kind is Kind.DWELL]
    assert dwells == [0.1, 0.1]


def test_r_alone_drills_again_where_the_tool_stands() -> None:
    assert drilled("G0 Z30. F100\nG99 G81 X1. R2. Z-1.\nR4.\nM30\n") == [(1, 0, -1), (1, 0, -1)]


def test_a_work_system_changed_in_a_cycle_block_moves_the_hole() -> None:
    text = "G0 Z30. F100\nG99 G81 X1. R2. Z-1.\nG54.1 P2 X1.\nM30\n"
    channel = run(text, setup={"work_offsets": {"G54.1 P2": {"X": 100}}})
    assert channel.coordinates.machine[0] == 101


def test_the_words_of_a_call_do_not_belong_to_the_cycle() -> None:
    text = "O0001\nG0 Z30. F100\nG99 G82 X1. R2. Z-1. P100\nM98 P2 L1\nM30\nO0002\nX2.\nM99\n"
    assert drilled(text) == [(1, 0, -1), (2, 0, -1)]


def test_m_codes_of_a_block_are_sent_once_whatever_the_repeats() -> None:
    channel = run("G0 Z5. F100\nG91 G81 X1. R-4. Z-1. K3 M8\nM30\n")
    sent = [r.event.data["code"] for r in channel.toolpath.rows() if r.event and r.event.type == "m"]
    assert sent == [8, 30]


def test_a_drill_does_not_move_when_a_word_is_wrong() -> None:
    channel = run("G0 Z5. F100\nG81 X1. R1. Z-1. E5\nM30\n")
    assert codes(channel) == ["PS0009"]
    assert ends(channel) == [(0, 0, 5)]


def test_meldas_has_no_rigid_tapping_codes_of_fanuc() -> None:
    assert codes(run("G84.2 Z-5. R1. F1.\nM30\n", "meldas-m")) == ["P34"]


@pytest.mark.parametrize(
    ("control_id", "feed", "lead"), [("fanuc-m", "500", 1.25), ("meldas-m", "1.25", 1.25)]
)
def test_the_lead_of_a_tap(control_id: str, feed: str, lead: float) -> None:
    channel = run(f"S400 M3\nG0 Z5.\nG84 R1. Z-5. F{feed}\nM30\n", control_id)
    taps = [row.curve[0] for row in moves(channel) if row.kind is Kind.TAP]
    assert taps == pytest.approx([lead, lead])
