"""What group 34 and the compressors tell the planner."""

from __future__ import annotations

import pytest

import polycnc
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.modes import CornerMode


def context(text: str) -> Context:
    """The context of the last move of a program."""
    result = polycnc.run(
        f"F1000 X1\n{text}\nX50 A5\nM30\n", control="sinumerik-840d", machine="mill5-ca-head"
    )
    assert not result.alarms, result.alarms
    moves = [row for row in result.toolpath.rows() if row.kind is not Kind.EVENT]
    return moves[-1].context


@pytest.mark.parametrize(
    ("text", "tolerance", "distance"),
    [
        ("OSD G64 TRAORI", 0.0, 0.05),
        ("OST G64 TRAORI", 0.05, 0.0),
        ("OST G64 TRAORI OTOL=2", 2.0, 0.0),
        ("OST G64", 0.0, 0.0),
        ("OST G60 TRAORI", 0.0, 0.0),
        ("COMPON G64 TRAORI", 0.1, 0.0),
        ("COMPON G64 TRAORI ORICURVE", 0.0, 0.0),
        ("COMPON G64 TRAORI G0", 0.0, 0.0),
        ("COMPON G64 TRAORI G0\nX9\nG1 X10", 0.1, 0.0),
        ("OSD COMPON G64 TRAORI", 0.0, 0.05),
    ],
)
def test_rotary_axes_have_a_tolerance_of_their_own(text: str, tolerance: float, distance: float) -> None:
    found = context(text.replace(" TRAORI", "\nTRAORI\n"))
    assert (found.turn_tolerance_deg, found.turn_distance_mm) == (tolerance, distance)


@pytest.mark.parametrize(
    ("text", "mode", "tolerance"),
    [
        ("G64 COMPCAD", CornerMode.ROUNDED, 0.1),
        ("G64 COMPCAD CTOL=0.02", CornerMode.ROUNDED, 0.02),
        ("G642 COMPCAD CTOL=0.2", CornerMode.ROUNDED, 0.2),
        ("G641 ADIS=0.7 COMPCAD", CornerMode.ROUNDED_FROM, 0.7),
        ("G60 COMPCAD", CornerMode.EXACT_STOP, 0.0),
        ("G64 COMPOF", CornerMode.CONTINUOUS, 0.0),
    ],
)
def test_the_contour_has_that_of_the_compressor(text: str, mode: CornerMode, tolerance: float) -> None:
    found = context(text)
    assert (found.corner_mode, found.tolerance_mm) == (mode, tolerance)
