"""Compressors and rotary axes that no transformation leads: each is moved within its own tolerance, ATOL or MD33100."""

from __future__ import annotations

from math import hypot
from random import Random
from typing import Any

import pytest

import polycnc
from polycnc.machine import load_machine
from polycnc.toolpath import Kind, Row

HEAD = "G71 G90 G17 BRISK G642 CTOL=0.01\nG1 F6000 COMPCAD\n"
#: Of a row's curve parameters: how far its rotary axis is moved, and the largest part of a tolerance by which one is.
TURN, PART = 4, 7


def noise(first: int, end: int, angle: float = 0.006, length: float = 0.003) -> str:
    """Blocks of 0.1 mm along X that turn A by 0.2 degrees each, beside both."""
    draw = Random(first)
    return "".join(
        f"X{k * 0.1:.4f} Y{draw.uniform(-length, length):.4f} A{10 + 0.2 * k + draw.uniform(-angle, angle):.4f}\n"
        for k in range(first, end)
    )


def run(text: str, machine: str = "mill4", **setup: Any) -> polycnc.Result:
    result = polycnc.run(text.encode(), control="sinumerik-840d", setup={"machine": machine, **setup})
    assert result.ok, result.alarms
    return result


def rows_of(text: str, machine: str = "mill4", **setup: Any) -> list[Row]:
    rows = run(text, machine, **setup).toolpath.rows()
    return [row for row in rows if row.kind is Kind.FEED]


def turned(rows: list[Row], column: int = TURN) -> list[float]:
    return [row.curve[column] if row.curve else 0.0 for row in rows]


@pytest.mark.parametrize(("code", "setup"), [("ATOL[A]=0.02", {}), ("", {"33100 A": 0.02})])
def test_a_rotary_axis_is_moved_within_its_own_tolerance(code: str, setup: dict[str, float]) -> None:
    rows = rows_of(f"{code}\n{HEAD}{noise(1, 120)}M30\n", parameters=setup)
    moved = [abs(by) for by in turned(rows)]
    assert sum(by > 1e-4 for by in moved) > 90
    assert 0.002 < max(moved) <= 0.8 * 0.02
    assert turned(rows)[-1] == 0.0
    parts = [max(before, own) / 0.02 for before, own in zip([0.0, *moved], moved, strict=False)]
    assert turned(rows, PART) == pytest.approx(parts, abs=1e-12)


def test_without_a_tolerance_it_keeps_to_its_way() -> None:
    rows = rows_of(f"ATOL[A]=0\n{HEAD}{noise(1, 120)}M30\n")
    assert not any(turned(rows))
    assert sum(hypot(*row.curve[:3]) > 1e-4 for row in rows if row.curve) > 90


def test_a_corner_of_its_way_is_one_of_the_path() -> None:
    """Where a rotary axis turns back the path keeps its ends too: they belong together."""
    text = (
        HEAD
        + "".join(f"X{k * 0.1:.4f} Y0 A{10 + 0.5 * min(k, 60 - k):.4f}\n" for k in range(1, 60))
        + "M30\n"
    )
    rows = rows_of(f"ATOL[A]=0.02\n{text}")
    assert not any(row.curve for row in rows)


def test_every_axis_has_its_own_tolerance() -> None:
    text = "".join(
        f"{line} C{30 + 0.2 * k:.4f}\n" for k, line in enumerate(noise(1, 120).replace("A", "B").splitlines())
    )
    machine = "mill5-bc-head"
    rows = rows_of(f"ATOL[B]=0.02 ATOL[C]=0.001\n{HEAD}{text}M30\n", machine)
    axes = load_machine(machine).channels[0].names
    rotary = [name for name in axes if name in "ABC"]
    assert max(map(abs, turned(rows, TURN + rotary.index("B")))) > 0.002
    assert max(map(abs, turned(rows, TURN + rotary.index("C")))) <= 0.8 * 0.001


def test_it_is_moved_beyond_no_limit() -> None:
    """A flat bow, cut off at 20 degrees."""
    draw = Random(1)
    ways = ((k, 20.012 - 0.000009 * (k - 80) ** 2 + draw.uniform(-0.002, 0.002)) for k in range(1, 160))
    text = "".join(f"X{0.1 * k:.4f} Y0 A{min(a, 20.0):.6f}\n" for k, a in ways)
    text = f"G0 A19.9\nATOL[A]=0.02\n{HEAD}{text}M30\n"

    def highest(rows: list[Row]) -> float:
        return max(row.end[3] + by for row, by in zip(rows, turned(rows), strict=True))

    assert highest(rows_of(text)) > 20.0001
    rows = rows_of("$MA_POS_LIMIT_PLUS[A]=20\nNEWCONF\n" + text)
    assert highest(rows) <= 20.0 + 1e-12
    assert sum(abs(by) > 1e-4 for by in turned(rows)) > 60


def test_noise_within_the_tolerances_costs_little_time() -> None:
    """What the smooth way takes."""
    smooth = run(f"ATOL[A]=0.02\n{HEAD}{noise(1, 300, 0.0, 0.0)}M30\n").time
    noisy = run(f"ATOL[A]=0.02\n{HEAD}{noise(1, 300)}M30\n").time
    plain = run(f"ATOL[A]=0.02\n{HEAD.replace('COMPCAD', 'COMPOF')}{noise(1, 300)}M30\n").time
    assert noisy < 1.15 * smooth < 0.7 * plain


def test_corners_leave_a_rotary_axis_what_it_is_allowed() -> None:
    """The wider its tolerance, the faster the corners of its way are passed; without a compressor CTOL counts."""
    text = HEAD + "".join(f"X{k:.1f} Y0 A{10 + 5 * (k % 2)}\n" for k in range(1, 20)) + "M30\n"
    times = [run(f"ATOL[A]={tolerance}\n{text}").time for tolerance in (0.5, 0.05, 0.001)]
    assert times[0] < 0.95 * times[1]
    assert times[1] < 0.995 * times[2]
