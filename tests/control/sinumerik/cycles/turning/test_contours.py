"""CYCLE952 by its material: nothing of the contour or of its allowance is cut, no rapid goes through stock."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

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
    turn,
    ways,
)
from tests.control.sinumerik.support import codes

#: So near a grid of heights is to a slope.
GRID = 0.05
#: Parts of a contour as (way along the cuts, way up), in whole mm.
PARTS = st.lists(
    st.one_of(
        st.tuples(st.integers(0, 6), st.integers(0, 5)).filter(any),
        st.tuples(st.integers(1, 4), st.integers(-3, -1)),
    ),
    min_size=2,
    max_size=5,
)
SIDES = st.sampled_from((OUTSIDE, INSIDE, FACE))
NOSES = st.sampled_from((0.4, 0.8))
ALLOWANCES = st.sampled_from(((0.0, 0.0), (0.2, 0.3), (0.5, 0.1), (0.1, 0.5)))


def contour_of(parts: list[tuple[int, int]]) -> list[Point]:
    corners = [(0.0, 12.0)]
    for along, up in parts:
        a, b = corners[-1]
        corners.append((a - along, max(b + up, 2.0)))
    return [point for number, point in enumerate(corners) if not number or point != corners[number - 1]]


def call(side: Side, *, stage: int = 1, rest: str = "10", d: float = 2.0, **values: Any) -> str:
    """A call on a cylinder that is larger than the contour by 1 mm along the cuts and 2 mm against the infeed."""
    uz, ux = side.amounts(*values.get("allowance", (0.0, 0.0)))
    zd, xd = side.amounts(1.0, 2.0)
    return (
        f'CYCLE952("R","","",{side.vari(stage, rest)},0.3,0.15,0,{d},0,0,{ux},{uz},{values.get("u", 0)},0,1,{xd},{zd}'
        ",,,,,2,2,,,0,1,,0,12,1100000,1,0,0.1)"
    )


def stock_of(contour: list[Point]) -> Stock:
    return Stock(contour[-1][0], 1.0, max(b for _, b in contour) + 2.0)


@pytest.mark.parametrize("side", [OUTSIDE, INSIDE, FACE])
@pytest.mark.parametrize(
    ("end", "allowance"),
    [((-12.0, 20.0), (0.5, 0.2)), ((-16.0, 20.0), (0.6, 0.1)), ((-11.2, 24.0), (0.3, 0.3))],
)
def test_the_allowance_stays_at_the_end_of_a_slope(side: Side, end: Point, allowance: Point) -> None:
    contour = [(0.0, 11.0), (-5.0, 11.0), (-11.0, 15.0), end]
    found = ways(side, turn(side, contour, 0.8, call(side, allowance=allowance)), step=0.02)
    assert gouge(contour, Edge(0.8), found, allowance) == pytest.approx(0.0, abs=1e-3)


def test_the_allowance_stays_over_a_begin_from_which_the_contour_goes_down() -> None:
    contour = [(0.0, 13.0), (-3.0, 10.0), (-6.0, 15.0)]
    found = ways(OUTSIDE, turn(OUTSIDE, contour, 0.0, call(OUTSIDE, allowance=(0.5, 0.2))))
    assert gouge(contour, Edge(0.0), found, (0.5, 0.2)) == pytest.approx(0.0, abs=1e-3)


@settings(max_examples=6)
@given(PARTS, SIDES, NOSES, ALLOWANCES, st.sampled_from((1.1, 2.0, 6.0)))
def test_stock_removal_cuts_down_to_the_allowance(
    parts: list[tuple[int, int]], side: Side, radius: float, allowance: Point, depth: float
) -> None:
    contour = contour_of(parts)
    result = turn(side, contour, radius, call(side, d=depth, allowance=allowance))
    if codes(result):
        return
    edge, found = Edge(radius), ways(side, result)
    assert gouge(contour, edge, found, allowance) <= 1e-3
    assert cut_all(stock_of(contour), edge, found) <= GRID


@settings(max_examples=8)
@given(PARTS, SIDES, NOSES)
def test_an_even_allowance_stays_all_round(parts: list[tuple[int, int]], side: Side, radius: float) -> None:
    contour = contour_of(parts)
    result = turn(side, contour, radius, call(side, rest="11", u=0.4))
    if not codes(result):
        assert gouge(contour, Edge(radius), ways(side, result), even=0.4) <= 1e-3


@settings(max_examples=8)
@given(PARTS, SIDES, NOSES, ALLOWANCES)
def test_finishing_leaves_the_contour(
    parts: list[tuple[int, int]], side: Side, radius: float, allowance: Point
) -> None:
    contour = contour_of(parts)
    result = turn(side, contour, radius, call(side, stage=3, allowance=allowance))
    if codes(result):
        return
    edge, found = Edge(radius), ways(side, result)
    assert gouge(contour, edge, found) <= 1e-3
    assert cut_all(stock_of(contour), edge, found) <= GRID
