"""Modes and frames in which plain blocks are not plain: both ways give the same."""

from __future__ import annotations

import pytest

from tests.language.bulk.both_ways import PLAIN, outcome, run

BODY = "G1 X1. F100\nX2. Y1.\nX3.\nG2 X5. Y3. R2.\nG3 X7. Y5. I2.\nG1 Y7.\nX9. Z-1.\n"


@pytest.mark.parametrize(
    ("before", "machine", "control"),
    [
        ("G7.1 A30.\n", "mill4", "fanuc-m"),
        ("G12.1\n", "mill4-xyzc", "fanuc-m"),
        ("G41.1\n", "mill4-c-head", "fanuc-m"),
        ("G7 Y0\n", "mill3", "meldas-m"),
        ("G51.1 Z0\n", "mill3", "fanuc-m"),
        ("G51.1 X0 Z0\n", "mill3", "fanuc-m"),
        ("G51 X0 Y0 I2. J1. K1.\n", "mill3", "fanuc-m"),
        ("G51 X0 Y0 P2.\n", "mill3", "fanuc-m"),
        ("G68 X0 Y0 R30.\n", "mill3", "meldas-m"),
        ("M73\nG63\n", "mill3", "fanuc-m"),
    ],
)
def test_plain_blocks_of_a_mode_are_the_same_both_ways(before: str, machine: str, control: str) -> None:
    text = f"G1 X0 F100\n{before}{BODY * 3}M30\n"
    setup = {"machine": machine}
    assert outcome(run(text, control, setup, PLAIN)) == outcome(run(text, control, setup))


@pytest.mark.parametrize("limit", [0, 0.01, 5])
def test_an_arc_that_ends_beside_its_circle_is_the_same_both_ways(limit: float) -> None:
    text = "G1 X0 F100\n" + "G2 X10.02 Y0 I5.\nG1 X0\nG2 X10. Y0.5 I5.\nG1 X0 Y0\n" * 3 + "M30\n"
    setup = {"parameters": {"3410": limit}}
    assert outcome(run(text, "fanuc-m", setup, PLAIN)) == outcome(run(text, "fanuc-m", setup))
