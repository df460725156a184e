"""CYCLE95 by its material: nothing of the contour or of its allowances is cut, no rapid goes through stock."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.session import open_session
from tests.control.sinumerik.cycles.turning.material import (
    FACE,
    INSIDE,
    OUTSIDE,
    Edge,
    Point,
    Side,
    Stock,
    cut_all,
    gouge,
    ways,
)
from tests.control.sinumerik.cycles.turning.test_contours import (
    ALLOWANCES,
    GRID,
    NOSES,
    PARTS,
    SIDES,
    contour_of,
)
from tests.control.sinumerik.support import codes

ROUGHING, FINISHING, COMPLETE = 0, 1, 2
#: VARI of roughing by side.
NUMBERS = {OUTSIDE: 1, FACE: 2, INSIDE: 3}


def run(side: Side, contour: list[Point], radius: float, stage: int, rest: str, hundreds: int = 0) -> Any:
    """A call of CYCLE95 with these values; `rest` are MID to FAL."""
    z, x = side.place((20.0, 40.0))
    vari = NUMBERS[side] + 4 * stage + hundreds
    call = f'CYCLE95("AA:BB",{rest},0.3,0.2,0.1,{vari},0.1,3)'
    lines = ["G18 G90 DIAMON G95", "T1 D1", "S500 M3", f"G0 X{2 * x} Z{z}", call, "M30"]
    for number, point in enumerate(contour):
        z, x = side.place(point)
        label = "AA: G1 " if not number else "BB: " if number == len(contour) - 1 else ""
        lines.append(f"{label}X{2 * x} Z{z}")
    tools = {1: {"type": 500, "radius": radius, "tip": side.tip}}
    setup = {"machine": "lathe2", "tools": tools}
    return open_session("\n".join(lines) + "\n", control="sinumerik-840d", setup=setup).run()


@settings(max_examples=5)
@given(
    PARTS,
    SIDES,
    NOSES,
    ALLOWANCES,
    st.sampled_from((ROUGHING, COMPLETE)),
    st.sampled_from((0, 200)),
    st.booleans(),
)
def test_any_contour_is_roughed_and_finished(
    parts: list[tuple[int, int]],
    side: Side,
    radius: float,
    allowance: Point,
    stage: int,
    hundreds: int,
    is_turned: bool,
) -> None:
    contour = contour_of(parts)
    if contour[-1][1] <= contour[0][1]:
        return  # its open end is the other one
    along, into = side.amounts(*allowance)
    result = run(
        side, contour[::-1] if is_turned else contour, radius, stage, f"2,{along},{into},0", hundreds
    )
    if codes(result):
        return
    edge, found = Edge(radius), ways(side, result)
    left = allowance if stage == ROUGHING else (0.0, 0.0)
    assert gouge(contour, edge, found, left) <= 1e-3
    stock = Stock(contour[-1][0] - 3.0, 0.0, max(b for _, b in contour))
    assert cut_all(stock, edge, found) <= GRID


@pytest.mark.parametrize("side", [OUTSIDE, INSIDE, FACE])
def test_finishing_from_a_closed_end_below_a_summit_comes_straight_down_at_feed(side: Side) -> None:
    contour = [(0.0, 8.0), (-7.0, 10.0), (-15.0, 11.0), (-15.0, 17.0), (-18.0, 14.0), (-21.0, 14.0)]
    result = run(side, contour[::-1], 0.4, COMPLETE, "3,0.2,0.2,0")
    assert codes(result) == []
    stock = Stock(-24.0, 0.0, 17.0)
    assert cut_all(stock, Edge(0.4), ways(side, result)) <= GRID
