"""Blocks that become several rows, on every control: exact stop at the end alone, and under inverse time one time."""

from __future__ import annotations

from typing import NamedTuple

import pytest

from polycnc.session import open_session
from polycnc.toolpath import Kind, Row
from polycnc.toolpath.kinds import ARC_KINDS

#: F in revolutions of the block a minute: a block takes two seconds.
RATE, SECONDS = 30, 2.0
NURBS = """G6.2 P4 K0 X0 Y0 R1. F{f}
K0 X10. Y20. R1.
K0 X20. Y20. R1.
K0 X30. Y0. R1.
K1.
K1.
K1.
K1.
G1 X40. F{f}"""
TOOL = {1: {"type": 110, "radius": 5, "length": 0}}


class Motion(NamedTuple):
    """Blocks, of which the one behind `>` becomes several rows; `timed` where inverse time counts its way."""

    control: str
    program: str
    setup: dict[str, object] | None = None
    timed: bool = True


def nurbs(control: str) -> Motion:
    """A curve of G06.2, which its last block writes."""
    return Motion(control, NURBS.replace("K1.\nG1", ">K1.\nG1"), timed=control != "syntec-mill")


def sinumerik(*blocks: str, machine: str = "mill3", timed: bool = True, **setup: object) -> Motion:
    """Blocks of SINUMERIK."""
    return Motion("sinumerik-840d", "\n".join(blocks), {"machine": machine, "tools": TOOL, **setup}, timed)


HEAD = "mill5-ca-head"
MOTIONS = {
    "polynomial": sinumerik(">POLY PO[X]=(20,3) PO[Y]=(5,8) F{f}"),
    "scaled arc": sinumerik("SCALE X2", ">G2 X20 Y0 CR=10 F{f}"),
    "involute": sinumerik("G1 X10 Y0 F{f}", ">INVCCW X32.77 Y32.77 CR=5 I-10 J0 F{f}"),
    "akima spline": sinumerik("ASPLINE X10 Y5 F{f}", ">X20 Y0 F{f}", "X30 Y5 F{f}", "G1 X40 F{f}"),
    "cubic spline": sinumerik("CSPLINE X10 Y5 F{f}", ">X20 Y0 F{f}", "X30 Y5 F{f}", "G1 X40 F{f}"),
    "B spline": sinumerik("BSPLINE X10 Y5 F{f}", ">X20 Y0 F{f}", "X30 Y5 F{f}", "G1 X40 F{f}"),
    "lead KONTT": sinumerik("T1 D1 KONTT", ">G41 G1 X40 Y0 F{f}", "X80 F{f}", start={"Y": 30}),
    "great circle": sinumerik(
        "TRAORI", "ORIVECT", "G1 X0 Y0 Z0 A3=1 B3=0 C3=1 F{f}", ">X20 A3=0 B3=1 C3=1 F{f}", machine=HEAD
    ),
    "tool that turns beside its path": sinumerik(
        "T1 D1 TRAORI", "CUT3DC", "G41 G1 X10 Y0 A3=0 B3=0 C3=1 F{f}", ">X40 A3=0 B3=1 C3=3 F{f}", "X60 F{f}",
        "G40 Y-20 F{f}", machine=HEAD,
    ),
    "face": sinumerik(
        "T1 D1", "CUT3DFS", "G41 G1 X5 A5=0 B5=0 C5=1 F{f}",
        ">X30 A4=0 B4=0 C4=1 A5=0 B5=1 C5=3 F{f}", "G40 X60 F{f}",
    ),
    "arc with a straight rest": Motion(
        "fanuc-m", "G51 X0 Y0 I2. J1.\nG1 X10. F{f}\n>G2 X20. Y-10. I0 J-10. F{f}", None, False
    ),
    "hypothetical axis": Motion(
        "meldas-m", "G17 G1 X10. F{f}\nG7 Y0\n>G3 X-10. Y0 I-10. J0 Z-5. F{f}\nG7 Y1", None, False
    ),
    "NURBS of FANUC": nurbs("fanuc-m"),
    "NURBS of MELDAS": nurbs("meldas-m"),
    "NURBS of SYNTEC": nurbs("syntec-mill"),
    "arc through three points": Motion(
        "syntec-mill", "G1 X0 Y0 F{f}\nG2.4 X10. Y10. C10.\n>X20. Y0 C20.", {"machine": "mill4-c-head"}, False
    ),
}  # fmt: skip


def rows_of(motion: Motion, modes: str) -> list[Row]:
    """The rows of the block in question."""
    text = f"{modes}\n{motion.program}\nM30\n".replace("{f}", str(RATE) + "." * (motion.control[0] != "si"))
    lines = text.split("\n")
    line = next(i for i, each in enumerate(lines, 1) if each.startswith(">"))
    result = open_session(
        text.replace(">", ""), control=motion.control, setup=motion.setup, timed=False
    ).run()
    assert not result.alarms, result.alarms
    return [row for row in result.toolpath.rows() if row.line == line and row.kind is not Kind.EVENT]


@pytest.mark.parametrize("name", MOTIONS)
def test_an_exact_stop_is_at_the_end_alone(name: str) -> None:
    motion = MOTIONS[name]
    rows = rows_of(motion, "G60" if motion.control[:2] == "si" else "G61")
    assert len(rows) > 1
    assert [row.context.stops for row in rows] == [False] * (len(rows) - 1) + [True]
    assert [row.context.knot for row in rows] == [True] * (len(rows) - 1) + [False]


@pytest.mark.parametrize("name", [name for name, motion in MOTIONS.items() if motion.timed])
def test_inverse_time_counts_once(name: str) -> None:
    rows = rows_of(MOTIONS[name], "G93")
    assert len(rows) > 1
    assert not any(row.kind in ARC_KINDS for row in rows)
    assert sum(1.0 / row.feed for row in rows) == pytest.approx(SECONDS)
    assert [60.0 * row.feed * row.context.share for row in rows] == pytest.approx([RATE] * len(rows))
