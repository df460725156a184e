"""Frames of the ISO dialect against frames of the control."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, run


@pytest.mark.parametrize(
    ("iso", "own"),
    [
        ("G68 X3 Y-4 R30", "$P_PFRAME=CTRANS(X,3,Y,-4):CROT(Z,30):CTRANS(X,-3,Y,4)"),
        (
            "G51 X3 Y-4 Z1 P1500",
            "$P_PFRAME=CTRANS(X,3,Y,-4,Z,1):CSCALE(X,1.5,Y,1.5,Z,1.5):CTRANS(X,-3,Y,4,Z,-1)",
        ),
        ("G51.1 X3 Z2", "$P_PFRAME=CTRANS(X,6,Z,4):CMIRROR(X):CMIRROR(Z)"),
        ("G92 X3 Y-4", "$P_SETFRAME=CTRANS(X,-3,Y,4)"),
    ],
)
def test_a_frame_of_the_dialect_is_one_of_the_control(iso: str, own: str) -> None:
    points = ("G0 X10 Y20 Z5", "G2 X12 Y22 CR=5 F100")
    dialect = run("G291", iso, "G290", *points)
    assert codes(dialect) == []
    assert dialect.final["machine"] == pytest.approx(run(own, *points).final["machine"])


@pytest.mark.parametrize(
    "lines",
    [
        ("G91 G51 X0 Y0 P2000",),
        ("G51 X0",),
        ("G51 X0 P-2000",),
        ("G68 X0 Y0",),
        ("G68 X0 Y0 Z0 R30",),
        ("G51.1 X0", "G68 X0 Y0 R30"),
        ("G68 X0 Y0 R30", "G92 X0"),
        ("G51 X0 P2000", "G68 R30"),
        ("G50.1",),
        ("G92",),
    ],
)
def test_what_is_refused(lines: tuple[str, ...]) -> None:
    assert codes(run("G291", *lines, "G290")) == [("PC0001", 1 + len(lines))]


def test_a_reset_ends_the_frames_of_the_dialect() -> None:
    result = run("G291", "G68 X0 Y0 R30")
    assert codes(result) == []
    assert result.variables["$P_ISO2FRAME[X,TR]"] == 0.0
