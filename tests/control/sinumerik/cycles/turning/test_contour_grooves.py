"""CYCLE952, grooving and plunge turning, by their material: the tool keeps clear of the contour, rapids of stock."""

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

GROOVING, PLUNGE_TURNING = 2, 3
GRID = 0.05
SIDES = st.sampled_from((OUTSIDE, INSIDE, FACE))
TECHNOLOGIES = st.sampled_from((GROOVING, PLUNGE_TURNING))
#: Ways of a groove along the cuts and up, in whole mm, from its rim on.
PARTS = st.lists(st.tuples(st.integers(0, 7), st.integers(-6, 4)).filter(any), min_size=1, max_size=5)
NARROW = [(0.0, 20.0), (0.0, 12.0), (-3.0, 12.0), (-3.0, 20.0)]
GROOVE = [(0.0, 20.0), (-2.0, 12.0), (-10.0, 12.0), (-10.0, 20.0)]


def groove_of(parts: list[tuple[int, int]]) -> list[Point]:
    corners = [(0.0, 20.0), (-1.0, 14.0)]
    for along, up in parts:
        a, b = corners[-1]
        corners.append((a - along, min(max(b + up, 4.0), 20.0)))
    corners.append((corners[-1][0] - 4.0, corners[-1][1]))
    if corners[-1][1] < 20.0:
        corners.append((corners[-1][0], 20.0))
    return [point for number, point in enumerate(corners) if not number or point != corners[number - 1]]


def call(
    side: Side, technology: int, *, stage: int = 1, rest: str = "10", d: float = 2.0, **values: Any
) -> str:
    uz, ux = side.amounts(*values.get("allowance", (0.0, 0.0)))
    _, xd = side.amounts(0.0, 1.0)
    zd, _ = side.amounts(0.0, 1.0)
    row = values.get("row", ",")
    return (
        f'CYCLE952("G","","",{side.vari(stage, rest)},0.1,0.2,0,{d},0,0,{ux},{uz},{values.get("u", 0)},0,1,{xd},{zd}'
        f",,,,,2,2,{row},0,1,,0,{technology}2,1100000,1,0,0.05)"
    )


def run(side: Side, contour: list[Point], edge: Edge, call_: str) -> Any:
    length = "$TC_DP3" if side.kind == 2 else "$TC_DP4"
    second = f"$TC_DP1[1,2]=520 $TC_DP2[1,2]=4 {length}[1,2]={edge.width} $TC_DP6[1,2]={edge.radius}"
    return turn(side, contour, edge.radius, call_, second)


@settings(max_examples=4)
@given(
    PARTS,
    SIDES,
    TECHNOLOGIES,
    st.sampled_from(((0.0, 0.0), (0.3, 0.1), (0.1, 0.4))),
    st.sampled_from((1.5, 4.0)),
)
def test_roughing_keeps_to_the_allowances(
    parts: list[tuple[int, int]], side: Side, technology: int, allowance: Point, depth: float
) -> None:
    contour, edge = groove_of(parts), Edge(0.2, 1.5)
    result = run(side, contour, edge, call(side, technology, d=depth, allowance=allowance))
    if codes(result):
        return
    found = ways(side, result, step=0.4)
    # Walls on both sides keep the allowance.
    for along in (allowance[0], -allowance[0]):
        assert gouge(contour, edge, found, (along, allowance[1])) <= 1e-3
    stock = Stock(contour[-1][0], 0.0, 21.0)
    assert cut_all(stock, edge, found) <= GRID


@settings(max_examples=4)
@given(PARTS, SIDES, TECHNOLOGIES)
def test_roughing_and_finishing_leave_the_contour(
    parts: list[tuple[int, int]], side: Side, technology: int
) -> None:
    contour, edge = groove_of(parts), Edge(0.0, 1.5)
    result = run(side, contour, edge, call(side, technology, stage=3, allowance=(0.2, 0.2)))
    if codes(result):
        return
    found = ways(side, result, step=0.4)
    assert gouge(contour, edge, found) <= 1e-3
    assert cut_all(Stock(contour[-1][0], 0.0, 21.0), edge, found) <= GRID


@pytest.mark.parametrize("side", [OUTSIDE, INSIDE, FACE])
@pytest.mark.parametrize("technology", [GROOVING, PLUNGE_TURNING])
def test_nothing_is_left_where_the_tool_fits(side: Side, technology: int) -> None:
    edge = Edge(0.0, 3.0)
    result = run(side, GROOVE, edge, call(side, technology, stage=3, allowance=(0.2, 0.3)))
    assert codes(result) == []
    stock = Stock(-10.0, 0.0, 21.0)
    assert cut_all(stock, edge, ways(side, result, step=0.05)) <= GRID
    assert stock.left(GROOVE) <= 0.25  # a grid of 0.1 beside a wall of 4 : 1


def test_an_even_allowance_stays_all_round() -> None:
    edge = Edge(0.2, 3.0)
    found = ways(OUTSIDE, run(OUTSIDE, GROOVE, edge, call(OUTSIDE, GROOVING, rest="11", u=0.4)))
    assert gouge(GROOVE, edge, found, even=0.4) == pytest.approx(0.0, abs=1e-3)


def test_grooves_stand_in_a_row() -> None:
    one = run(OUTSIDE, GROOVE, Edge(0.2, 3.0), call(OUTSIDE, GROOVING))
    two = run(OUTSIDE, GROOVE, Edge(0.2, 3.0), call(OUTSIDE, GROOVING, row="2,-15"))
    first = [row["to"] for row in one.rows if "to" in row][2:-1]
    both = [row["to"] for row in two.rows if "to" in row][2:-1]
    assert len(both) == 2 * len(first)
    for before, after in zip(first, both[len(first) :], strict=True):
        assert after["Z"] == pytest.approx(before["Z"] - 15.0)
        assert after["X"] == pytest.approx(before["X"])


@pytest.mark.parametrize(
    ("contour", "edge", "call_", "alarm"),
    [
        # Wider than the contour; than what the allowances leave of it; noses without an edge between them.
        (GROOVE, Edge(0.2, 11.0), call(OUTSIDE, GROOVING), "61602"),
        (NARROW, Edge(0.0, 3.0), call(OUTSIDE, GROOVING, allowance=(0.2, 0.0)), "61602"),
        (GROOVE, Edge(0.5, 1.0), call(OUTSIDE, GROOVING), "61602"),
        ([(0.0, 20.0), (-4.0, 12.0), (-2.0, 10.0), (-12.0, 20.0)], Edge(0.0, 2.0), call(OUTSIDE, GROOVING), "61606"),
        (GROOVE, Edge(0.2, 3.0), call(OUTSIDE, PLUNGE_TURNING, d=0.0), "61610"),
        (GROOVE, Edge(0.2, 3.0), call(OUTSIDE, GROOVING, row="2,0"), "PC0001"),
    ],
)  # fmt: skip
def test_what_cannot_be_turned(contour: list[Point], edge: Edge, call_: str, alarm: str) -> None:
    result = run(OUTSIDE, contour, edge, call_)
    assert [code for code, _ in codes(result)] == [alarm]


def test_the_point_looks_at_the_base_and_to_smaller_places() -> None:
    second = "$TC_DP1[1,2]=520 $TC_DP2[1,2]=3 $TC_DP4[1,2]=3 $TC_DP6[1,2]=0.2"
    tools = {1: {"type": 520, "radius": 0.2, "tip": 4}}
    wrong = turn(OUTSIDE, GROOVE, 0.2, call(OUTSIDE, GROOVING), second, tools=tools)
    assert [code for code, _ in codes(wrong)] == ["61608"]


def test_plunge_turning_has_a_feed_along_each_axis() -> None:
    result = run(OUTSIDE, GROOVE, Edge(0.0, 3.0), call(OUTSIDE, PLUNGE_TURNING, rest="20"))
    cuts = [row for row in result.rows if row.get("type") == "feed"]
    before = None
    for row in result.rows:
        if "to" not in row:
            continue
        if row in cuts and before is not None:
            along_z = abs(row["to"]["Z"] - before["Z"]) > 1e-6
            assert row["feed"] == pytest.approx(0.2 if along_z else 0.1)
        before = row["to"]
