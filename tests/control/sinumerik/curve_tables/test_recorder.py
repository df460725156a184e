from __future__ import annotations

from math import sqrt

import pytest

from polycnc.control.sinumerik.curve_tables.curve import CurveTable
from polycnc.session import open_session


def defined(*lines: str) -> CurveTable:
    """The table that blocks define, of Y over X."""
    text = "\n".join(("CTABDEF(Y,X,1,0)", *lines, "CTABEND", "M30", ""))
    session = open_session(text, control="sinumerik-840d")
    assert session.run().alarms == []
    table: CurveTable = session.channel.retained.table("curve tables", 0)[1]
    return table


def test_arcs_are_followed_to_a_fraction_of_a_micrometre() -> None:
    table = defined("G1 X-100 Y0", "G2 X0 Y100 CR=100")
    for x in (-99.9, -80.0, -31.0, -0.1):
        assert table.at(x).place == pytest.approx(sqrt(1e4 - x * x), abs=1e-5)


def test_a_polynomial_with_a_denominator_is_followed() -> None:
    table = defined("G1 X0 Y10", "POLY PO[X]=(10,0.25) PO[Y]=(0,-10) PO[]=(2,1)")
    assert table.end[1].place == pytest.approx(0.0)


def test_a_rounded_corner_is_part_of_the_curve() -> None:
    table = defined("G1 X0 Y0", "X10 Y0 RND=2", "X20 Y10")
    assert 0.1 < table.at(10.0).place < 1.0


def test_axes_beside_the_two_do_not_count() -> None:
    assert len(defined("G1 Z5", "X0 Y0", "Z10", "X4 Y4").segments) == 1
