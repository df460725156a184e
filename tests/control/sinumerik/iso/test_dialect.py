"""What a block of the ISO dialect may hold."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, moves, run


@pytest.mark.parametrize(
    ("block", "code"),
    [
        ("G98 G99", "12060"),
        ("G80 G81 R1 Z-1", "12060"),
        ("G81 G82 R1 Z-1", "12060"),
        ("G69 G68 X0 Y0 R30", "12060"),
        ("G51 X1 Y1 P2000 G68 R30", "12060"),
        ("G92 X1 G52 X2", "12060"),
        ("G51 X0 X5 P2000", "12010"),
        ("G92 X1 X2", "12010"),
        ("G92 S100 S200", "12010"),
        ("G43 H1 H2", "12010"),
    ],
)
def test_one_of_a_kind(block: str, code: str) -> None:
    result = run("G291", "G0 X1", block)
    assert codes(result) == [(code, 3)]
    assert moves(result) == [("rapid", {"X": 1.0, "Y": 0.0, "Z": 0.0})]


@pytest.mark.parametrize("block", ["G69 G50 G80 X2", "M8 M3 S100 X2", "G80 G99 G40 X2"])
def test_of_several_kinds_all_act(block: str) -> None:
    result = run("G291", "G0 X1", block)
    assert codes(result) == []
    assert moves(result)[1:] == [("rapid", {"X": 2.0, "Y": 0.0, "Z": 0.0})]
