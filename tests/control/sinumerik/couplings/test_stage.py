from __future__ import annotations

import pytest

from tests.control.sinumerik.support import moves, run

TABLE = ("CTABDEF(Y,X,1,0)", "G1 X0 Y0", "X10 Y10", "CTABEND")


def test_an_axis_waits_over_several_blocks_and_beside_other_moves() -> None:
    result = run(*TABLE, "LEADON(Y,X,1)", "G1 Z5 F1000", "X1", "G4 F0.1", "X2 Z6", "X5", start={"Y": 4})
    assert [to["Y"] for _, to in moves(result) if "Y" in to][-1] == pytest.approx(5.0)
    assert moves(result)[0][1]["Y"] == pytest.approx(4.0)


def test_a_move_that_ends_within_the_tolerance_begins_the_coupling() -> None:
    result = run(*TABLE, "LEADON(Y,X,1)", "G1 X3.5 F1000", "X3", start={"Y": 4})
    assert [to["Y"] for _, to in moves(result)] == pytest.approx([4.0, 3.0])


def test_two_axes_begin_on_one_move() -> None:
    result = run(*TABLE, "LEADON(Y,X,1)", "LEADON(Z,X,1)", "G1 X8 F1000", "X1", start={"Y": 4, "Z": 6})
    assert [(to["Y"], to["Z"]) for _, to in moves(result)] == [(8.0, 8.0), (1.0, 1.0)]
