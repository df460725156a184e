"""G28 and G30 of the ISO dialect."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, moves, run


def test_only_named_axes_go_and_the_motion_function_stays() -> None:
    result = run("G0 X10 Y20 Z30", "G1 F100", "G291", "G90 G28 X5", "Y21", "G290")
    assert codes(result) == []
    assert [(kind, to["X"], to["Y"]) for kind, to in moves(result)][1:] == [
        ("rapid", 5.0, 20.0),
        ("ref", 0.0, 20.0),
        ("feed", 0.0, 21.0),
    ]


@pytest.mark.parametrize("block", ["G28", "G30 P5 X1", "G30 P2.5 X1", "G30 P2", "G28 P2 X1"])
def test_what_is_refused(block: str) -> None:
    assert codes(run("G0 X10", "G291", block)) == [("PC0001", 3)]


def test_not_beside_a_contour() -> None:
    lines = ("T1 D1", "F100", "G291", "G41 G1 X10 Y10", "G28 Z0")
    assert codes(run(*lines, tools={1: {"radius": 2.0}})) == [("PC0001", 5)]
