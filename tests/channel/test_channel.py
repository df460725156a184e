from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.toolpath import Kind, Row
from polycnc.toolpath.events import Stop
from tests.support import codes, ends, moves, run


def table(rows: list[Row]) -> list[tuple[object, ...]]:
    return [(row.kind, row.line, row.end, repr(row.feed), row.curve, row.event) for row in rows]


PROGRAM = """O0001
G90 G54 G0 X0 Y0 Z10. S1000 M3
#1=0
WHILE [#1 LT 7] DO1
G1 X#1 Y[#1*#1] F200
G2 X[#1+4] Y[#1*#1] R2.
M8
#1=#1+1
END1
G0 Z50. M9
M30
"""


@pytest.mark.parametrize("rows", [1, 2, 3, 7, 65_536])
def test_the_size_of_chunks_changes_nothing(rows: int) -> None:
    assert table(list(run(PROGRAM, chunk_rows=rows).toolpath.rows())) == table(
        list(run(PROGRAM).toolpath.rows())
    )


def test_two_runs_are_the_same_bit_for_bit() -> None:
    assert table(list(run(PROGRAM).toolpath.rows())) == table(list(run(PROGRAM).toolpath.rows()))


def test_a_block_that_alarms_moves_nothing() -> None:
    channel = run("O1\nG90 G0 X5.\nG28 X7. Q3.\nM30\n")
    assert codes(channel) == ["PS0009"]
    assert ends(channel) == [(5.0, 0.0, 0.0)]
    assert channel.coordinates.position == [5.0, 0.0, 0.0]


def test_the_moves_of_a_block_that_alarms_midway_are_taken_back() -> None:
    program = "O1\nG90 G0 X5.\nG65 P2\nM30\nO2\nG0 X9.\nG81 X12. Z-5. R2.\nM99\n"
    channel = run(program)
    assert codes(channel) == ["PS0011"]
    assert ends(channel) == [(5.0, 0.0, 0.0), (9.0, 0.0, 0.0)]
    assert channel.coordinates.position == [9.0, 0.0, 0.0]


def test_a_check_behind_the_motion_of_a_block_keeps_it() -> None:
    channel = run("O1\nG90 G0 X9.\nG27 X1.\nM30\n")
    assert codes(channel) == ["PS0092"]
    assert ends(channel) == [(9.0, 0.0, 0.0), (1.0, 0.0, 0.0)]
    assert channel.coordinates.position == [1.0, 0.0, 0.0]


@pytest.mark.parametrize("chunk_rows", [1, 65_536])
def test_the_axes_stand_where_they_were_when_offsets_changed_before_an_alarm(chunk_rows: int) -> None:
    program = "O1\nG54 G90 G0 X10. Y10.\nG41 D1 G1 X20. F100.\nX30.\nG52 X3.\nX#[1/0]\nM30\n"
    setup = {"work_offsets": {"G54": {"X": 5}}, "tools": {1: {"radius": 2}}}
    channel = run(program, setup=setup, chunk_rows=chunk_rows)
    assert [alarm.code for alarm in channel.alarms] == ["PS0112"]
    assert channel.coordinates.machine == pytest.approx([35.0, 12.0, 0.0])
    assert channel.coordinates.position == pytest.approx([27.0, 12.0, 0.0])


def test_an_alarm_names_program_line_column_and_the_calls_that_led_there() -> None:
    channel = run("O1\nM98 P2\nM30\nO2\nG90\nG0 X5. Q1.\nM99\n")
    (alarm,) = channel.alarms
    assert (alarm.program, alarm.line, alarm.column) == ("O0002", 6, 8)
    assert alarm.call_chain == (("O0001", 2),)


def test_a_run_away_program_ends_with_a_clear_alarm() -> None:
    channel = run("O1\nN10 GOTO 10\nM30\n", block_limit=50_000)
    assert codes(channel) == ["PC0002"]


def test_a_run_away_loop_of_moves_ends_too() -> None:
    channel = run("O1\nG91 G1 F100.\nDO1\nX1.\nEND1\nM30\n", block_limit=5_000)
    assert codes(channel) == ["PC0002"]
    assert len(moves(channel)) < 10_000


@pytest.mark.parametrize("limit", [12, 17, 29])
def test_the_limit_is_exact_behind_blocks_that_count_for_several(limit: int) -> None:
    holes = "G83 X1. R1. Z-9. Q2.\n#1=#1+1\nG81 X2. R2. Z-3. K3\n#1=#1+1\n"
    counts = "#1=#1+1\n" * 30
    channel = run(f"O1\nG90 G54 G0 Z5. F90\n{holes}G80\n{counts}M30\n", block_limit=limit)
    assert codes(channel) == ["PC0002"]
    assert channel.blocks == limit


def test_a_programmed_stop_hands_over_and_goes_on() -> None:
    channel = run("O1\nG0 X1.\nM0\nX2.\nM30\n")
    assert ends(channel) == [(1.0, 0.0, 0.0), (2.0, 0.0, 0.0)]
    stops = [row.event.code for row in channel.toolpath.rows() if isinstance(row.event, Stop)]
    assert stops == ["M00"]


def test_a_move_without_way_gives_no_row_but_a_full_circle_does() -> None:
    channel = run("O1\nG0 X0\nG1 X0 F100.\nG2 I5.\nM30\n")
    assert [row.kind for row in moves(channel)] == [Kind.CW]


def test_events_keep_their_place_between_moves_that_compensation_holds_back() -> None:
    program = "O1\nG90 G17 G0 X0 Y0\nG41 G1 X10. D1 F100\nY20.\nM8\nX40.\nM9\nG40 X60. Y40.\nM30\n"
    channel = run(program, setup={"tools": {1: {"radius": 2}}})
    order = [row.event.data.get("code") if row.event else row.line for row in channel.toolpath.rows()]
    assert order == [3, 4, 8, 6, 9, 8, 30]


@settings(max_examples=40, deadline=None)
@given(st.lists(st.tuples(st.integers(-50, 50), st.integers(-50, 50)), min_size=1, max_size=12))
def test_incremental_and_absolute_programs_end_at_the_same_points(steps: list[tuple[int, int]]) -> None:
    x = y = 0
    absolute, incremental = ["O1", "G90 G1 F100"], ["O1", "G91 G1 F100"]
    for dx, dy in steps:
        x, y = x + dx, y + dy
        absolute.append(f"X{x}. Y{y}.")
        incremental.append(f"X{dx}. Y{dy}.")
    assert ends(run("\n".join([*absolute, "M30", ""]))) == ends(run("\n".join([*incremental, "M30", ""])))
