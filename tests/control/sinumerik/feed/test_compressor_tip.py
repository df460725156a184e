"""Compressors under transformations: which ends they move, by how much, and what stays as it is programmed."""

from __future__ import annotations

from math import cos, hypot, radians, sin
from random import Random
from typing import Any

import numpy as np
import pytest

import polycnc
from polycnc.session import open_session
from polycnc.toolpath import Kind, Row
from tests.language.bulk.both_ways import differences, scanned

TOLERANCE, TURN = 0.01, 0.05
MACHINE = "mill5-ca-head"
HEAD = f"G71 G90 G94 G642 CTOL={TOLERANCE} OTOL={TURN}\nT1 D1\nTRAORI\nG1 F6000 X0 Y0 Z0 A20 C0\nCOMPCAD\n"


def noise(count: int, *, beside: float = 0.003, turn: float = 0.01, vectors: bool = False) -> str:
    """Blocks of 0.2 mm along X while the tool turns, both with noise."""
    draw, lines = Random(1), []
    for k in range(1, count):
        a, c = (at + draw.uniform(-turn, turn) for at in (20.0 + 0.03 * k, 0.05 * k))
        place = f"X{0.2 * k:.4f} Y{draw.uniform(-beside, beside):.4f} Z{draw.uniform(-beside, beside):.4f}"
        told = f"A{a:.4f} C{c:.4f}"
        if vectors:
            tilt, round_z = radians(a), radians(c)
            x, y, z = sin(tilt) * sin(round_z), -sin(tilt) * cos(round_z), cos(tilt)
            told = f"A3={x:.6f} B3={y:.6f} C3={z:.6f}"
        lines.append(f"{place} {told}\n")
    return "".join(lines)


def rows_of(text: str, machine: str = MACHINE, **setup: Any) -> list[Row]:
    setup = {"tools": {1: {"length": 50.0}}, **setup}
    result = polycnc.run(text.encode(), control="sinumerik-840d", machine=machine, setup=setup)
    assert result.ok, result.alarms
    return [row for row in result.toolpath.rows() if row.kind is Kind.FEED]


def shift(row: Row) -> float:
    """How far the end of a row is moved."""
    return hypot(*row.curve[:3]) if row.curve else 0.0


def swing(row: Row) -> float:
    """How far a rotary axis is moved there."""
    return max(map(abs, row.curve[4:7])) if row.curve else 0.0


@pytest.mark.parametrize("vectors", [False, True])
@pytest.mark.parametrize("code", ["COMPON", "COMPCURV", "COMPCAD"])
def test_tip_and_direction_are_moved_within_their_tolerances_and_rows_stay(
    code: str, *, vectors: bool
) -> None:
    head = HEAD.replace("COMPCAD", code) + ("ORIVECT\n" if vectors else "")
    text = head + noise(80, vectors=vectors) + "M30\n"
    rows, plain = rows_of(text), rows_of(text.replace(code, "COMPOF"))
    assert [(row.end, row.line, row.feed) for row in rows] == [(row.end, row.line, row.feed) for row in plain]
    assert not any(row.curve for row in plain)
    assert sum(shift(row) > 1e-4 for row in rows) > 60
    assert max(map(shift, rows)) <= 0.8 * TOLERANCE
    assert 0.003 < max(map(swing, rows)) <= 0.8 * TURN / 2.0**0.5
    assert shift(rows[-1]) == swing(rows[-1]) == 0.0


@pytest.mark.parametrize(
    ("tolerance", "parameters", "most"),
    [
        ("ATOL[A]=0.02 ATOL[C]=0.03", {}, 0.02),
        ("", {"20482": 2, "42476": 0.04}, 0.04 / 2.0**0.5),
        ("", {"33100[A]": 0.015, "33100[C]": 0.5}, 0.015),
        ("OTOL=0.02 ATOL[A]=0.5", {}, 0.02 / 2.0**0.5),
    ],
)
def test_where_the_tolerance_of_the_direction_comes_from(
    tolerance: str, parameters: dict[str, float], most: float
) -> None:
    """Noise of A by just less than the fit may be moved: with a larger tolerance it is moved farther."""
    text = HEAD.replace(f"OTOL={TURN}", tolerance) + noise(80, turn=0.9 * most) + "M30\n"
    tilt = [abs(row.curve[5]) for row in rows_of(text, parameters=parameters) if row.curve]
    assert 0.3 * most < max(tilt) <= 0.8 * most


@pytest.mark.parametrize(("way", "moves"), [("ORIVECT", True), ("ORICONCW", False), ("ORICURVE", False)])
def test_directions_on_cones_and_curves_are_not_compressed(way: str, *, moves: bool) -> None:
    """6.6: only great circles, and ways of the rotary axes."""
    blocks = "".join(f"{line.split(' A')[0]}\n" for line in noise(60).splitlines())
    assert any(shift(row) > 0.0 for row in rows_of(f"{HEAD}{way}\n{blocks}M30\n")) is moves


def limited(axis: str, low: float, high: float, tmp_path: Any) -> str:
    """A machine whose axis has limits."""
    path = tmp_path / "limited.toml"
    path.write_text(f'base = "{MACHINE}"\n[axis.{axis}]\nlimit_minus = {low!r}\nlimit_plus = {high!r}\n')
    return str(path)


def sampled(text: str, machine: str) -> np.ndarray:
    """Machine positions."""
    given: list[Any] = []
    setup = {"tools": {1: {"length": 50.0}}}
    session = open_session(text.encode(), control="sinumerik-840d", machine=machine, setup=setup, keep=False)
    sampler = session.sample(0.0005, given.append)
    session.run().plan  # noqa: B018 - plans to the end
    sampler.close()
    return np.concatenate([samples.position for samples in given])


def extent(rows: list[Row], column: int) -> tuple[float, float]:
    """Where an axis of the machine is at the ends of rows."""
    places = [row.context.transformation.to_machine(list(row.end))[column] for row in rows]  # type: ignore[union-attr]
    return min(places), max(places)


def flattened(axis: str) -> str:
    """A flat bow of short lines, cut off at Y 0 or at 25 degrees of A: no parabola is as flat."""
    draw, lines = Random(1), [f"{HEAD.replace('A20', 'A-25' if axis == 'Y' else 'A25')}"]
    for k in range(1, 300):
        bow = min(0.006 - 0.00002 * (k - 150) ** 2 + draw.uniform(-0.001, 0.001), 0.0)
        lines.append(f"X{0.1 * k:.4f} Y{bow:.6f}\n" if axis == "Y" else f"X{0.1 * k:.4f} A{25.0 + bow:.6f}\n")
    return "".join([*lines, "M30\n"])


@pytest.mark.parametrize(("axis", "column"), [("Y", 1), ("A", 4)])
def test_no_axis_is_led_beyond_its_limit(axis: str, column: int, tmp_path: Any) -> None:
    """Ends that need all of the travel stay, others are moved; far from the limit all are."""
    text = flattened(axis)
    rows, free = rows_of(text), sampled(text, MACHINE)
    high = extent(rows, column)[1]
    assert free[:, column].max() > high + 1e-4
    machine = limited(axis, -1000.0, high + 1e-6, tmp_path)
    tight = rows_of(text, machine)
    assert 10 < sum(bool(row.curve) for row in tight) < sum(bool(row.curve) for row in rows) - 20
    assert sampled(text, machine)[:, column].max() <= high + 2e-6
    wide = rows_of(text, limited(axis, -1000.0, 1000.0, tmp_path))
    assert [row.curve for row in wide] == [row.curve for row in rows]


#: What stands in front of the program, and what switches it on under the transformation.
KEPT = {
    "area": ("$SA_WORKAREA_PLUS_ENABLE[Y]=1\nG26 X500 Y{edge!r} Z500\n", "WALIMON"),
    "area of the work": (
        "$P_WORKAREA_CS_PLUS_ENABLE[1,Y]=TRUE\n$P_WORKAREA_CS_LIMIT_PLUS[1,Y]={tip:.6f}\n",
        "WALCS1",
    ),
    "zone": (
        "DEF INT AB\nNPROTDEF(1,FALSE,0)\nG1 X-50 Y{edge!r} F1000\nX50\nY60\nX-50\nY{edge!r}\nEXECUTE(AB)\n",
        "NPROT(1,2)",
    ),
}


@pytest.mark.parametrize("kind", KEPT)
def test_working_areas_and_zones_are_kept_clear_of(kind: str) -> None:
    text, (begun, on) = flattened("Y"), KEPT[kind]
    high = extent(rows_of(text), 1)[1]
    near, far = (
        sum(
            bool(row.curve)
            for row in rows_of(
                begun.format(edge=high + beside, tip=beside) + text.replace("COMPCAD", f"{on}\nCOMPCAD")
            )
        )
        for beside in (1e-5, 10.0)
    )
    assert 10 < near < far - 20


@pytest.mark.parametrize(("distance", "moves"), [(0.2, False), (20.0, True)])
def test_near_the_centre_of_a_polar_plane_ends_stay(distance: float, *, moves: bool) -> None:
    draw = Random(3)
    head = f"G71 G90 G94 G642 CTOL={TOLERANCE}\nT1 D1\nG0 X60 Z5\nTRANSMIT\nG1 F1000 X{-5.0} Y{distance}\nCOMPCAD\n"
    blocks = "".join(
        f"X{0.1 * k - 5.0:.4f} Y{distance + draw.uniform(-0.003, 0.003):.4f}\n" for k in range(1, 100)
    )
    text = head + blocks + "COMPOF\nTRAFOOF\nG0 X80\nM30\n"
    rows = [row for row in rows_of(text, "lathe-c-transmit") if row.line > 6]
    near = [row for row in rows if hypot(row.end[0], distance) < 0.45]
    assert any(shift(row) > 0.0 for row in rows)
    assert any(shift(row) > 0.0 for row in near) is (moves and bool(near))


@pytest.mark.parametrize(("frame", "moves"), [("ROT Z30", True), ("SCALE X2 Y2 Z2", False)])
def test_where_a_frame_makes_lengths_others_ends_stay(frame: str, *, moves: bool) -> None:
    text = HEAD.replace("TRAORI\n", f"TRAORI\n{frame}\n") + noise(60) + "M30\n"
    assert any(row.curve for row in rows_of(text)) is moves


@pytest.mark.parametrize("vectors", [False, True])
@pytest.mark.parametrize("travel", [float("inf"), 500.0, 64.9])
def test_the_scanner_leads_them_as_the_interpreter_does(travel: float, *, vectors: bool) -> None:
    setup = {"machine": MACHINE, "tools": {1: {"length": 50.0}}}
    text = HEAD + ("ORIVECT\n" if vectors else "") + noise(300, vectors=vectors) + "M30\n"
    assert not differences(text, "sinumerik-840d", setup, travel=travel)


def test_the_scanner_takes_them() -> None:
    setup = {"machine": MACHINE, "tools": {1: {"length": 50.0}}}
    assert scanned(HEAD + noise(300) + "M30\n", "sinumerik-840d", setup) > 250


@pytest.mark.parametrize(("mode", "part"), [("BRISK", 0.65), ("SOFT", 0.4)])
def test_noise_within_the_tolerances_costs_no_time(mode: str, part: float) -> None:
    def seconds(code: str, **how: Any) -> float:
        text = HEAD.replace("COMPCAD", code).replace("G642", f"{mode} G642") + noise(300, **how) + "M30\n"
        result = polycnc.run(
            text.encode(), control="sinumerik-840d", machine=MACHINE, setup={"tools": {1: {"length": 50.0}}}
        )
        return result.time - 4.0  # the tool change

    smooth = seconds("COMPCAD", beside=0.0, turn=0.0)
    assert seconds("COMPCAD") < 1.2 * smooth
    assert seconds("COMPCAD") < part * seconds("COMPOF")
