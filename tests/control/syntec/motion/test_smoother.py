"""G05 and G05.1 Q1: which cuts they lead beside their ends, by how much, and what stays as it is programmed."""

from __future__ import annotations

from math import hypot
from random import Random

import pytest

import polycnc
from polycnc.machine import parse_setup
from polycnc.toolpath import Kind, Row
from tests.mainrun.support import power_on
from tests.support import run

FILTER, FIT = "G05.1 Q1 E0.01", "G05 P10000"
HEAD = "G71 G90 G94 G01 F6000.\n"
SETUP = {"parameters": {"407": 10}}


def noise(first: int, end: int, offset: float = 0.0) -> str:
    """Blocks of 0.1 mm along X, 3 µm beside it."""
    draw = Random(first)
    return "".join(f"X{k * 0.1:.4f} Y{offset + draw.uniform(-0.003, 0.003):.4f}\n" for k in range(first, end))


def rows_of(text: str, **setup: object) -> list[Row]:
    result = polycnc.run(text.encode(), control="syntec-mill", setup={**SETUP, **setup})
    assert result.ok, result.alarms
    return [row for row in result.toolpath.rows() if row.kind is not Kind.EVENT]


def shift(row: Row) -> float:
    """How far the end of a row is moved."""
    return hypot(*row.curve[:3]) if row.curve and row.kind is Kind.FEED else 0.0


def moves(rows: list[Row]) -> bool:
    return sum(shift(row) > 1e-4 for row in rows) > len(rows) // 2


@pytest.mark.parametrize("code", [FILTER, FIT, "G05 E0.01"])
def test_ends_are_moved_within_the_tolerance_and_rows_stay(code: str) -> None:
    rows, plain = (rows_of(HEAD + on + noise(1, 80) + "M30\n") for on in (code + "\n", "G64\n"))
    assert [(row.end, row.line, row.feed) for row in rows] == [(row.end, row.line, row.feed) for row in plain]
    assert not any(row.curve for row in plain)
    assert moves(rows)
    assert max(map(shift, rows)) <= 0.008
    assert shift(rows[-1]) == 0.0


@pytest.mark.parametrize(
    ("code", "parameters"),
    [
        ("G05.1 Q2 E0.01", {}),
        ("G05.1 Q5 E0.01", {}),
        (FIT, {"407": 0}),
        (FILTER, {"3809": 1}),
        (FIT, {"407": 10, "3809": 1}),
    ],
)
def test_other_modes_and_a_mode_without_a_tolerance_keep_all_points(
    code: str, parameters: dict[str, int]
) -> None:
    assert not any(row.curve for row in rows_of(f"{HEAD}{code}\n{noise(1, 80)}M30\n", parameters=parameters))


@pytest.mark.parametrize("code", [FILTER, FIT])
@pytest.mark.parametrize(
    "between",
    [
        "M8",
        "X3. M8",
        "G04 P10",
        "G00 X3.\nG01",
        "X25.",
        "G02 X3.2 Y0 R0.5\nG01",
        "G61 X3.\nG64",
        "G68 R1.",
        "Z1. A1.",
    ],
)
def test_whatever_is_no_plain_cut_ends_a_run(code: str, between: str) -> None:
    text = f"{HEAD}{code}\n{noise(1, 30)}{between}\n{noise(31, 80)}M30\n"
    rows = rows_of(text, machine="mill4")
    last = max(k for k, row in enumerate(rows) if row.line <= 31)
    assert any(shift(row) > 0.0 for row in rows[: last - 2])
    assert any(shift(row) > 0.0 for row in rows[-20:])
    assert shift(rows[last]) == 0.0


@pytest.mark.parametrize("between", ["G61", "G63"])
def test_exact_stop_and_tapping_mode_suspend_it(between: str) -> None:
    rows = rows_of(f"{HEAD}{FILTER}\n{between}\n{noise(1, 40)}G64\n{noise(40, 80)}M30\n")
    assert not any(map(shift, rows[:39]))
    assert moves(rows[39:])


def test_g05_moves_the_axes_that_it_names() -> None:
    rows = rows_of(f"{HEAD}G05 P10000 X0 Y0\n{noise(1, 40)}Z1.\n{noise(40, 80)}M30\n")
    assert moves(rows)
    rows = rows_of(f"{HEAD}G05 P10000 X0 Z0\n{noise(1, 40)}M30\n")
    assert not any(map(shift, rows))


def test_g05_may_be_on_from_the_start() -> None:
    text = HEAD + noise(1, 60) + "M30\n"
    assert moves(rows_of(text, parameters={"407": 10, "3802": 2}))
    assert not any(row.curve for row in rows_of(text, parameters={"407": 10, "3802": 1}))
    rows = rows_of(HEAD + "G05 P0\n" + noise(1, 60) + "M30\n", parameters={"407": 10, "3802": 2})
    assert not any(row.curve for row in rows)
    without = {"407": 10, "3802": 2, "OPTION11": 0}
    assert not any(row.curve for row in rows_of(text, parameters=without))


def test_a_reset_ends_it() -> None:
    channel = run(f"{FILTER}\nG01 X1. F100\nM30\n", "syntec-mill")
    assert not channel.path.is_idle
    channel.control.reset(channel)
    assert channel.path.is_idle


def test_single_block_ends_every_block_where_it_is_programmed() -> None:
    text = f"{HEAD}{FILTER}\n{noise(1, 40)}M30\n"
    virtual = power_on(text, "syntec-mill", setup=parse_setup({}))
    virtual.set_switches(single_block=True)
    ends: list[float] = []
    for _ in range(25):
        virtual.cycle_start()
        virtual.run(limit_s=10.0)
        ends.append(virtual.machine_position[1])
    assert ends[2:] == pytest.approx([row.end[1] for row in rows_of(text)][: len(ends) - 2], abs=1e-9)


# ---- limits


def flattened() -> str:
    """A flat bow of short lines, cut off at Y 0: no parabola is as flat."""
    draw = Random(1)
    places = (
        (0.1 * k, 0.006 - 0.0000045 * (k - 80) ** 2 + draw.uniform(-0.001, 0.001)) for k in range(1, 160)
    )
    return "".join(f"X{x:.4f} Y{min(y, 0.0):.6f}\n" for x, y in places)


def highest(rows: list[Row]) -> float:
    return max(row.end[1] + (row.curve[1] if row.curve else 0.0) for row in rows)


def test_no_end_is_moved_out_of_the_range_that_is_allowed() -> None:
    """Pr2542 = 0: what lies outside of the range of G22 is forbidden."""
    text = f"{HEAD}{FILTER}\n{flattened()}M30\n"
    assert highest(rows_of(text)) > 5e-5
    rows = rows_of("G22 X500. Y0. Z500. I-500. J-500. K-500.\n" + text)
    assert highest(rows) <= 1e-12
    assert sum(shift(row) > 1e-4 for row in rows) > 60


def test_beside_a_range_that_is_forbidden_ends_stay() -> None:
    """Pr2542 = 1: what lies inside of the range of G22 is forbidden; it ends 1 µm below the noise."""
    text = f"G22 X6. Y-0.004 I2. J-5.\n{HEAD}{FILTER}\n{noise(1, 120)}M30\n"
    parameters = {"2542": 1}
    rows = rows_of(text, parameters=parameters)
    assert not any(shift(row) for row in rows if 1.9 < row.end[0] < 6.1)
    assert moves([row for row in rows if row.end[0] > 7.6])
    rows = rows_of(text.replace("Y-0.004", "Y-0.02"), parameters=parameters)
    assert moves(rows)


# ---- rotary axes


def turning(angle: float = 0.006, length: float = 0.003) -> str:
    """Blocks along a bow that turn A to and fro, beside both."""
    draw = Random(1)
    return "".join(
        f"X{k * 0.1:.4f} Y{0.0001 * k * k + draw.uniform(-length, length):.4f} "
        f"A{5.0 + 0.05 * k + draw.uniform(-angle, angle):.4f}\n"
        for k in range(1, 200)
    )


def test_g05_moves_rotary_axes_that_it_names_within_their_words() -> None:
    head = HEAD + "G00 A5.\nG05 P10000 X0 Y0 Z0 A0.02\nG01\n"
    setup = {**SETUP, "machine": "mill4"}
    noisy = polycnc.run(f"{head}{turning()}M30\n".encode(), control="syntec-mill", setup=setup)
    turned = [abs(row.curve[4]) for row in noisy.toolpath.rows() if row.kind is Kind.FEED and row.curve]
    assert sum(by > 1e-4 for by in turned) > 150
    assert 0.002 < max(turned) <= 0.8 * 0.02
    without = f"{head.replace(' A0.02', '')}{turning()}M30\n"
    plain = polycnc.run(without.encode(), control="syntec-mill", setup=setup)
    assert not any(row.curve for row in plain.toolpath.rows() if row.kind is Kind.FEED)
    assert noisy.time < 0.5 * plain.time


TIP = {"machine": "mill5-ac-table", "tools": {1: {"length": 50.0}}}


@pytest.mark.parametrize(
    ("code", "moved"), [(FILTER, True), ("G05.1 Q2 E0.01", False), ("G05.1 Q5 E0.01", False), ("G64", False)]
)
def test_under_tip_control_the_filter_leads_the_tip_beside_its_ends(code: str, *, moved: bool) -> None:
    """Its direction stays as programmed: E names no angle."""
    blocks = "".join(
        f"{line} A{20.0 + 0.1 * k:.1f} C{0.2 * k:.1f}\n" for k, line in enumerate(noise(1, 80).splitlines())
    )
    text = f"G71 G90\nG43.4 H1\n{code}\nG01 F6000. X0 Y0 Z0 A20. C0\n{blocks}G49\nM30\n"
    rows = [row for row in rows_of(text, **TIP) if row.kind is Kind.FEED]
    assert moves(rows) is moved
    assert max(map(shift, rows)) <= 0.008
    assert not any(any(row.curve[4:7]) for row in rows if row.curve)
