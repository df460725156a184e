"""Compressors: which blocks they lead beside their ends, by how much, and what stays as it is programmed."""

from __future__ import annotations

from itertools import pairwise
from math import cos, hypot, sin
from random import Random
from typing import Any

import pytest

import polycnc
from polycnc.machine import parse_setup
from polycnc.mainrun import State
from polycnc.toolpath import Kind, Row
from tests.language.bulk.both_ways import run
from tests.mainrun.support import power_on

TOLERANCE = 0.01
HEAD = f"G71 G90 G17 G642 CTOL={TOLERANCE}\nG1 F6000 COMPCAD\n"


def noise(first: int, end: int, offset: float = 0.0) -> str:
    """Blocks of 0.1 mm along X, 3 µm beside it."""
    draw = Random(first)
    return "".join(f"X{k * 0.1:.4f} Y{offset + draw.uniform(-0.003, 0.003):.4f}\n" for k in range(first, end))


def rows_of(text: str, **setup: Any) -> list[Row]:
    result = polycnc.run(text.encode(), control="sinumerik-840d", setup=setup)
    return [row for row in result.toolpath.rows() if row.kind is not Kind.EVENT]


def shift(row: Row) -> float:
    """How far the end of a row is moved."""
    return hypot(*row.curve[:3]) if row.curve and row.kind is Kind.FEED else 0.0


@pytest.mark.parametrize("code", ["COMPON", "COMPCURV", "COMPCAD"])
def test_ends_are_moved_within_the_tolerance_and_rows_stay(code: str) -> None:
    text = HEAD.replace("COMPCAD", code) + noise(1, 80) + "M30\n"
    rows, plain = rows_of(text), rows_of(text.replace(code, "COMPOF"))
    assert [(row.end, row.line, row.feed) for row in rows] == [(row.end, row.line, row.feed) for row in plain]
    assert not any(row.curve for row in plain)
    assert sum(shift(row) > 1e-4 for row in rows) > 60
    assert max(map(shift, rows)) <= 0.8 * TOLERANCE
    assert shift(rows[-1]) == 0.0


@pytest.mark.parametrize(
    "between",
    [
        "M8", "X3 M8", "G4 F0.1", "G0 X3\nG1", "X25", "G2 X3.2 Y0 CR=0.5\nG1", 'MSG("A")', "STOPRE", "CTOL=0.02",
        "COMPON", "G9 X3", "ROT RPL=0\nTRANS X1", "X3.05 CHF=0.01\nY1", "S500 M3",
    ],
)  # fmt: skip
def test_whatever_is_no_plain_cut_ends_a_run(between: str) -> None:
    rows = rows_of(HEAD + noise(1, 30) + between + "\n" + noise(31, 60) + "M30\n")
    last = max(k for k, row in enumerate(rows) if row.line <= 31)
    assert any(shift(row) > 0.0 for row in rows[: last - 2])
    assert any(shift(row) > 0.0 for row in rows[-20:])
    assert shift(rows[last]) == 0.0


@pytest.mark.parametrize("line", ["R1=R1+1", "R2=SIN(30)*2", "; a comment", "", "N100"])
def test_blocks_that_only_calculate_do_not_end_it(line: str) -> None:
    text = HEAD + noise(1, 30) + line + "\n" + noise(30, 60) + "M30\n"
    last = max(k for k, row in enumerate(rows_of(text)) if row.line <= 31)
    assert shift(rows_of(text)[last]) > 0.0


def test_a_corner_stays_with_its_whole_tolerance() -> None:
    side = "".join(f"X3 Y{k * 0.1:.4f}\n" for k in range(1, 30))
    rows = rows_of(HEAD + "".join(f"X{k * 0.1:.4f} Y0\n" for k in range(1, 31)) + side + "M30\n")
    assert not any(row.curve for row in rows)


def test_points_of_a_circle_stay_on_it() -> None:
    points = [(20.0 * cos(k * 0.01), 20.0 * sin(k * 0.01)) for k in range(1, 300)]
    text = HEAD + "G0 X20 Y0\nG1\n" + "".join(f"X{x:.5f} Y{y:.5f}\n" for x, y in points) + "M30\n"
    assert max(map(shift, rows_of(text))) < 3e-5


def test_what_a_curve_needs_of_the_tolerance_is_not_for_its_ends() -> None:
    draw = Random(1)
    points = [(cos(k * 0.4) + draw.uniform(-0.003, 0.003), sin(k * 0.4)) for k in range(1, 60)]
    text = HEAD + "G0 X1 Y0\nG1\n" + "".join(f"X{x:.4f} Y{y:.4f}\n" for x, y in points) + "M30\n"
    assert max(map(shift, rows_of(text))) == 0.0


@pytest.mark.parametrize(("longest", "moves"), [(0.05, False), (0.2, True)])
def test_blocks_longer_than_the_machine_datum_stay(longest: float, *, moves: bool) -> None:
    rows = rows_of(HEAD + noise(1, 60) + "M30\n", parameters={"20170": longest})
    assert any(shift(row) > 0.0 for row in rows) is moves


@pytest.mark.parametrize(
    ("before", "setup"),
    [
        ("CYCLE832(0.01,1)\n", {}),
        ("", {"parameters": {"20150[29]": 4}}),
    ],
)
def test_a_compressor_may_be_switched_on_by_a_cycle_or_a_machine_datum(
    before: str, setup: dict[str, Any]
) -> None:
    text = f"G71 G90 G642 CTOL={TOLERANCE}\n{before}G1 F6000\n{noise(1, 60)}M30\n"
    assert any(shift(row) > 0.0 for row in rows_of(text, **setup))


def test_a_frame_turns_what_ends_are_moved_by() -> None:
    """The shift is that of the axes: along Y of the work, which is X of the machine."""
    rows = rows_of("G71 G90 G17 ROT RPL=90\n" + HEAD + noise(1, 60) + "M30\n")
    moved = [row.curve for row in rows if shift(row) > 1e-4]
    assert moved
    assert all(abs(x) > abs(y) for x, y, *_ in moved)


@pytest.mark.parametrize("wrong", ["X99999", "X4 FOO", "G1 Q=R1"])
def test_an_alarm_leaves_the_rows_in_front_of_it(wrong: str) -> None:
    text = HEAD + noise(1, 40) + wrong + "\n" + noise(41, 50) + "M30\n"
    channel = run(text, "sinumerik-840d", travel=500.0)
    assert len(channel.alarms) == 1
    assert [kind for chunk in channel.toolpath.chunks for kind in chunk.kind].count(Kind.FEED) == 39


def test_single_block_ends_every_block_where_it_is_programmed() -> None:
    virtual = power_on(HEAD + noise(1, 60) + "M30\n", "sinumerik-840d")
    virtual.set_switches(single_block=True)
    ends: list[float] = []
    for _ in range(30):
        virtual.cycle_start()
        virtual.run(limit_s=10.0)
        ends.append(virtual.machine_position[1])
    programmed = [row.end[1] for row in rows_of(HEAD + noise(1, 60) + "M30\n")]
    assert ends[2:] == pytest.approx(programmed[: len(ends) - 2], abs=1e-9)


def test_single_block_halts_in_every_turn_of_a_loop() -> None:
    """Blocks that are prepared already are blocks of their own, though they have one line."""
    loop = "FOR R1=1 TO 40\nX=R1*0.1 Y=0.003*((R1*7) MOD 5-2)/2\nENDFOR\nM30\n"
    virtual = power_on(HEAD + loop, "sinumerik-840d")
    virtual.cycle_start()
    virtual.step(0.03)
    virtual.set_switches(single_block=True)
    places: list[float] = []
    for _ in range(4):
        assert virtual.run(limit_s=10.0) is not State.READY
        places.append(virtual.machine_position[0])
        virtual.cycle_start()
    steps = [b - a for a, b in pairwise(places)]
    assert steps == pytest.approx([0.1] * 3, abs=0.02)


def test_plan_and_main_run_take_the_same_time_in_a_loop() -> None:
    text = HEAD + "FOR R1=1 TO 100\nX=R1*0.1 Y=0.003*((R1*7) MOD 5-2)/2\nENDFOR\nX11 Y0\nM30\n"
    virtual = power_on(text, "sinumerik-840d", setup=parse_setup({}))
    virtual.cycle_start()
    virtual.run(limit_s=100.0)
    assert polycnc.run(text.encode(), control="sinumerik-840d").time == pytest.approx(virtual.time, abs=0.005)


@pytest.mark.parametrize(("before", "moves"), [("", True), ("GEOAX(3,Z2)\n", False)])
def test_with_other_geometry_axes_ends_stay(before: str, *, moves: bool) -> None:
    rows = rows_of(before + HEAD + noise(1, 60) + "M30\n", machine="mill4-x1-y1-z1-z2")
    assert any(shift(row) > 0.0 for row in rows) is moves
