"""Through the centre of turning under TRANSMIT: sides, pieces, and the end of programs."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import run

LATHE = "lathe-c-transmit"
START = ("G0 X40", "TRANSMIT", "G1 X20 Y0 F1000")


def places(*lines: str, **parameters: float) -> list[tuple[float, float]]:
    """Infeed and rotary axis at the end of every move behind the start."""
    result = run(*START, *lines, machine=LATHE, parameters=parameters)
    assert not result.alarms
    rows = [row["machine"] for row in result.rows if "machine" in row][2:]
    return [(round(row["X"], 6) + 0.0, round(row["C"], 6) + 0.0) for row in rows]


def test_a_line_past_the_centre_turns_the_rotary_axis() -> None:
    (place,) = places("X-20 Y1")
    assert place == pytest.approx((20.024984, 177.137595))


def test_a_helix_goes_through_the_centre_in_every_turn() -> None:
    once, twice = (places(f"G2 X20 Y0 Z-5 I-10 J0 TURN={n}")[-1][0] for n in (0, 1))
    assert (once, twice) == (-20.0, 20.0)


def test_the_centre_is_where_the_frame_puts_it() -> None:
    assert places("TRANS X5 Y3", "AROT RPL=40", "X15 Y2", "X0 Y0", "X-5 Y-3")[-1][0] > 0.0
    through = places("TRANS X5", "X15", "X-20")
    assert through == [(-15.0, 0.0)]


def test_a_way_along_the_spindle_in_the_centre_changes_nothing() -> None:
    assert places("X0", "Z-5", "Y4") == [(0.0, 0.0), (0.0, 0.0), (4.0, 90.0)]


def test_held_back_moves_get_the_side_of_the_path_in_front_of_them() -> None:
    rounded = places("X-20 RND=2", "Y10", "X-30")
    assert all(infeed < 0.0 for infeed, _ in rounded)


def test_the_first_move_out_of_the_centre_turns_the_rotary_axis_least() -> None:
    result = run("G0 X0 C30", "TRANSMIT", "G1 X-20 Y-20 F1000", machine=LATHE)
    assert [row["machine"]["X"] for row in result.rows if "machine" in row][-1] == pytest.approx(-28.284271)


def test_the_next_transformation_begins_where_the_infeed_axis_stands() -> None:
    again = places("X-20", "TRANSMIT", "X-10 Y10")
    assert again[-1] == pytest.approx((-14.142136, -45.0))
