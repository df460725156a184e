"""Compressors lead no cut beyond a limit that it keeps to as it is programmed, and raise no alarm for one."""

from __future__ import annotations

from math import cos, hypot, radians, sin
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polycnc
from polycnc.geometry.zones import area, grown, is_convex
from polycnc.session import open_session
from polycnc.toolpath import Kind, Row
from tests.examples import examples
from tests.language.bulk.both_ways import differences, run

HEAD = "G71 G90 G17 BRISK G642 CTOL=0.01\nG1 F6000 COMPCAD\n"


def flattened(turn: float = 0.0) -> str:
    """A flat bow of short lines, cut off at Y 0: no parabola is as flat. Turned about Z, degrees."""
    draw, lines = Random(1), []
    c, s = cos(radians(turn)), sin(radians(turn))
    for k in range(1, 160):
        x, y = 0.1 * k, min(0.006 - 0.0000045 * (k - 80) ** 2 + draw.uniform(-0.001, 0.001), 0.0)
        lines.append(f"X{c * x - s * y:.6f} Y{s * x + c * y:.6f}\n")
    return "".join(lines)


def rows_of(text: str, **setup: object) -> list[Row]:
    result = polycnc.run(text.encode(), control="sinumerik-840d", setup=setup)
    assert result.ok, result.alarms
    return [row for row in result.toolpath.rows() if row.kind is Kind.FEED]


def moved(rows: list[Row]) -> int:
    return sum(hypot(*row.curve[:3]) > 1e-4 for row in rows if row.curve)


def highest(rows: list[Row], axis: int = 1) -> float:
    """The largest machine position of an axis to which a row is led, with frames that do not turn."""
    return max(row.end[axis] + (row.curve[axis] if row.curve else 0.0) for row in rows)


def sampled(text: str) -> np.ndarray:
    given: list[np.ndarray] = []
    session = open_session(text.encode(), control="sinumerik-840d", keep=False)
    sampler = session.sample(0.0002, lambda samples: given.append(samples.position))
    session.run().plan  # noqa: B018 - plans to the end
    sampler.close()
    return np.concatenate(given)


AREA = "$SA_WORKAREA_PLUS_ENABLE[Y]=1\nG26 X500 Y0 Z500\nWALIMON\n"
GROUP = (
    "$P_WORKAREA_CS_PLUS_ENABLE[1,Y]=TRUE\n$P_WORKAREA_CS_LIMIT_PLUS[1,Y]=0\n$P_WORKAREA_CS_COORD_SYSTEM[1]=1\n"
    "WALCS1\n"
)


def test_without_a_limit_the_path_is_led_beyond_it() -> None:
    assert highest(rows_of(HEAD + flattened() + "M30\n")) > 5e-5


@pytest.mark.parametrize("limit", ["$MA_POS_LIMIT_PLUS[Y]=0\nNEWCONF\n", AREA, GROUP])
def test_no_end_is_moved_beyond_a_limit(limit: str) -> None:
    rows = rows_of(limit + HEAD + flattened() + "M30\n")
    assert highest(rows) <= 1e-12
    assert moved(rows) > 60


def test_nor_does_the_path_between_them() -> None:
    assert sampled(AREA + HEAD + flattened() + "M30\n")[:, 1].max() <= 1e-9


@pytest.mark.parametrize(
    ("before", "limit", "setup"),
    [
        ("G54\n", "$MA_POS_LIMIT_PLUS[Y]=7\nNEWCONF\n", {"work_offsets": {"G54": {"Y": 7.0}}}),
        ("T1 D1 G18\n", "$MA_POS_LIMIT_PLUS[Y]=2\nNEWCONF\n", {"tools": {1: {"length": 2.0}}}),
        ("TRANS Y3\n", GROUP, {}),
    ],
)
def test_offsets_tools_and_frames_count(before: str, limit: str, setup: dict[str, object]) -> None:
    rows = rows_of(limit + before + HEAD.replace("G17 ", "") + flattened() + "M30\n", **setup)
    assert highest(rows) <= 1e-12
    assert moved(rows) > 60


@pytest.mark.parametrize("turn", [90.0, 37.0])
def test_a_turned_frame_turns_what_ends_are_moved_by(turn: float) -> None:
    """The bow lies along a limit of the machine; the program that writes it, in a system that is turned."""
    text = HEAD.replace("G642", f"ROT RPL={turn} G642") + flattened(-turn) + "M30\n"
    rows = rows_of("$MA_POS_LIMIT_PLUS[Y]=0.0000006\nNEWCONF\n" + text)
    c, s = cos(radians(turn)), sin(radians(turn))
    tops = [s * row.end[0] + c * row.end[1] + (row.curve[1] if row.curve else 0.0) for row in rows]
    assert max(tops) <= 6.1e-7
    assert moved(rows) > 60


def test_the_radius_of_the_tool_belongs_to_it() -> None:
    limit = "$MC_WORKAREA_WITH_TOOL_RADIUS=1\nNEWCONF\n" + AREA.replace("Y0", "Y4")
    rows = rows_of("T1 D1\n" + limit + HEAD + flattened() + "M30\n", tools={1: {"radius": 4.0}})
    assert highest(rows) <= 1e-12
    assert moved(rows) > 60


def test_a_limit_that_changes_ends_a_run() -> None:
    """What is held back keeps to the limit of its block, what follows to its own."""
    lines = flattened().splitlines(keepends=True)
    text = "".join([AREA, HEAD, *lines[:80], "$SA_WORKAREA_LIMIT_PLUS[Y]=1\n", *lines[80:], "M30\n"])
    rows = rows_of(text)
    assert highest(rows[:80]) <= 1e-12
    assert highest(rows[80:]) > 5e-5
    assert not rows[79].curve or hypot(*rows[79].curve[:3]) == 0.0


ZONE = "{kind}PROTDEF(1,FALSE,0)\nG1 X2 Y-5 F1000\nX6\nY-0.004\nX2\nY-5\nEXECUTE(NU)\n{kind}PROT(1,2,0,0,0)\n"


def noise(first: int, end: int) -> str:
    draw = Random(first)
    return "".join(f"X{k * 0.1:.4f} Y{draw.uniform(-0.003, 0.003):.4f}\n" for k in range(first, end))


@pytest.mark.parametrize("kind", ["N", "C"])
@pytest.mark.parametrize("tool", [False, True])
def test_beside_a_protection_zone_ends_stay(kind: str, *, tool: bool) -> None:
    """The zone ends 1 µm below the noise; that of the tool reaches 1 mm below its tip, and lies as much higher."""
    zone = ZONE.format(kind=kind)
    if tool:
        zone = zone.replace("PROT(1,2,0,0,0)", "PROT(1,2,0,-1,0)")
        own = f"{kind}PROTDEF(2,TRUE,0)\nG1 X-0.5 Y-1\nX0.5\nY1\nX-0.5\nY-1\nEXECUTE(NU)\n{kind}PROT(2,2,0,0,0)\n"
        zone = own + zone
    rows = rows_of("DEF INT NU\nG71 G90 G17\n" + zone + HEAD + noise(1, 120) + "M30\n")
    near = [row for row in rows if 1.4 < row.end[0] < 6.6]
    assert not any(row.curve and hypot(*row.curve[:3]) for row in near if 1.9 < row.end[0] < 6.1)
    assert moved([row for row in rows if row.end[0] > 7.6]) > 30


@settings(max_examples=examples(20), deadline=None)
@given(st.lists(st.tuples(st.floats(-9, 9), st.floats(-9, 9)), min_size=3, max_size=6), st.floats(0.001, 2.0))
def test_a_grown_outline_holds_all_squares(points: list[tuple[float, float]], by: float) -> None:
    found = grown([*points, points[0]], by)
    assert found[0] == found[-1]
    assert is_convex(found)
    assert area(found) >= 4.0 * by * by - 1e-9


@settings(max_examples=examples(20), deadline=None)
@given(st.integers(0, 10**6), st.floats(0.0, 0.004), st.sampled_from(("COMPON", "COMPCURV", "COMPCAD")))
def test_random_noise_keeps_to_a_limit_that_it_touches_both_ways(seed: int, room: float, code: str) -> None:
    """All that are programmed are legal: no alarm, no place beyond; the scanner does what the interpreter does."""
    draw, lines = Random(seed), []
    bow = draw.uniform(-0.0001, 0.0001)
    for k in range(1, 60):
        y = min(bow * (k - 30) ** 2 / 10.0 + draw.uniform(-0.004, 0.004), room)
        lines.append(f"X{0.1 * k:.4f} Y{y:.6f}\n")
    limit = AREA.replace("Y0", f"Y{room + 1e-6:.6f}")
    text = limit + HEAD.replace("COMPCAD", code) + "".join(lines) + "M30\n"
    assert highest(rows_of(text)) <= room + 1.6e-6
    assert differences(text, "sinumerik-840d") == []


def test_limits_of_the_machine_itself_count() -> None:
    """Travel ends at X 8: the bow lies along Y there."""
    places = (line.split() for line in flattened().splitlines())
    text = "".join(f"X{8.0 + float(y[1:]):.6f} Y{float(x[1:]):.4f}\n" for x, y in places)
    channel = run("G0 X7\n" + HEAD + text.replace("Y15.9", "Y7.9") + "M30\n", "sinumerik-840d", travel=16.0)
    free = [row for row in channel.toolpath.rows() if row.kind is Kind.FEED]
    assert highest(free, 0) > 8.00005
    channel = run("G0 X7 Y-8\nTRANS Y-8\n" + HEAD + text + "M30\n", "sinumerik-840d", travel=8.0)
    assert not channel.alarms
    rows = [row for row in channel.toolpath.rows() if row.kind is Kind.FEED]
    assert highest(rows, 0) <= 8.0 + 1e-12
    assert moved(rows) > 60
