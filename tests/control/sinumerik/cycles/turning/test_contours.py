"""CYCLE952 by its material: nothing of the contour or of its allowance is cut, no rapid goes through stock."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.control.sinumerik.cycles.turning.material import (
    FACE,
    INSIDE,
    NOWHERE,
    OUTSIDE,
    Edge,
    Point,
    Side,
    Stock,
    cut_all,
    gouge,
    height,
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


@settings(max_examples=5)
@given(PARTS, SIDES, NOSES, ALLOWANCES, st.sampled_from((1.5, 4.0)), st.sampled_from(("010", "210")))
def test_cuts_parallel_to_the_contour_keep_to_it(
    parts: list[tuple[int, int]], side: Side, radius: float, allowance: Point, depth: float, rest: str
) -> None:
    contour = contour_of(parts)
    digits = call(side, rest=rest, d=depth, allowance=allowance)
    kind = side.vari(1, rest)
    result = turn(side, contour, radius, digits.replace(kind, f"{kind[:-1]}3"))
    if codes(result):
        return
    edge, found = Edge(radius), ways(side, result, step=0.2)
    assert gouge(contour, edge, found, allowance) <= 1e-3
    assert cut_all(stock_of(contour), edge, found) <= GRID


def test_reliefs_are_bridged_or_cut() -> None:
    contour = [(0.0, 15.0), (-4.0, 15.0), (-8.0, 10.0), (-12.0, 10.0), (-12.0, 20.0)]
    for rest, left in (("010", 0.0), ("110", 0.0), ("210", 5.0)):
        stock = stock_of(contour)
        cut_all(stock, Edge(0.2), ways(OUTSIDE, turn(OUTSIDE, contour, 0.2, call(OUTSIDE, rest=rest))))
        middle = stock.heights[stock.places.index(min(stock.places, key=lambda a: abs(a + 9.5)))]
        assert middle == pytest.approx(10.0 + left, abs=0.01)


def twice(side: Side, contour: list[Point], first: str, second: str, radius: float = 0.4) -> Any:
    """A call that notes what it leaves, and one for what that was."""
    noted = call(side, rest=first).replace('"R","",""', '"R","","REST"')
    residual = (
        call(side, rest=second).replace('"R","",""', '"R","rest",""').replace(",12,1100000", ",112,1100000")
    )
    z, x = side.place((20.0, 40.0))
    away = f"G0 X{2 * x} Z{z}"
    return turn(side, contour, radius, f'{noted}\n{away}\nCYCLE62("",2,"AA","BB")\n{residual}')


@settings(max_examples=6)
@given(PARTS, SIDES)
def test_residual_material_is_cut_out_of_what_was_left(parts: list[tuple[int, int]], side: Side) -> None:
    contour = contour_of(parts)
    result = twice(side, contour, "210", "110")
    if codes(result):
        return
    found = ways(side, result)
    assert gouge(contour, Edge(0.4), found) <= 1e-3
    assert cut_all(stock_of(contour), Edge(0.4), found) <= GRID


@pytest.mark.parametrize("side", [OUTSIDE, INSIDE, FACE])
def test_residual_material_is_nothing_but_the_reliefs(side: Side) -> None:
    contour = [(0.0, 15.0), (-4.0, 15.0), (-8.0, 10.0), (-14.0, 10.0), (-14.0, 20.0)]
    result = twice(side, contour, "210", "110")
    assert codes(result) == []
    stock = stock_of(contour)
    assert cut_all(stock, Edge(0.4), ways(side, result)) <= GRID
    middle = stock.heights[min(range(len(stock.places)), key=lambda k: abs(stock.places[k] + 11.0))]
    assert middle == pytest.approx(10.0, abs=0.01)
    once = turn(side, contour, 0.4, call(side, rest="210"))
    cuts = [row for row in result.rows if row.get("type") == "feed"]
    before = [row for row in once.rows if row.get("type") == "feed"]
    depths = [side.point((row["to"]["Z"], row["to"]["X"] / 2.0))[1] for row in cuts[len(before) :]]
    # All that is cut again lies below the summit, but for the ways out of it.
    assert min(depths) == pytest.approx(10.0)
    assert sum(depth > 17.1 for depth in depths) == 0


def test_nothing_was_left_under_that_name() -> None:
    lost = call(OUTSIDE).replace('"R","",""', '"R","GONE",""')
    assert [code for code, _ in codes(turn(OUTSIDE, contour_of([(5, 0), (2, 3)]), 0.4, lost))] == ["14011"]


@pytest.mark.parametrize("side", [OUTSIDE, INSIDE, FACE])
@pytest.mark.parametrize("kind", ["as it is", "parallel"])
def test_a_blank_that_is_an_allowance_is_entered_in_front_of_it(side: Side, kind: str) -> None:
    contour = [(0.0, 15.0), (-8.0, 15.0), (-16.0, 20.0), (-20.0, 20.0)]
    _, xd = side.amounts(0.0, 2.0)
    zd, _ = side.amounts(0.0, 2.0)
    cylinder = call(side, d=1.5)
    vari = side.vari(1)
    start = cylinder.index(",0,1,")
    made = f"{cylinder[:start]},0,2,{xd},{zd},,,,,2,2,,,0,1,,0,12,1100000,1,0,0.1)"
    if kind == "parallel":
        made = made.replace(vari, f"{vari[:-1]}3")
    result = turn(side, contour, 0.8, made)
    assert codes(result) == []
    stock = stock_of(contour)
    stock.heights = [(height(contour, a) or NOWHERE) + 2.0 for a in stock.places]
    found = ways(side, result)
    assert gouge(contour, Edge(0.8), found) <= 1e-3
    assert cut_all(stock, Edge(0.8), found) <= GRID
    assert stock.left(contour[:-1]) <= 0.1
