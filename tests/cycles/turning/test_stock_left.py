"""What stock removal leaves: the material is a height over every place along the cuts, and every cut lowers it."""

from __future__ import annotations

from itertools import pairwise

from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.cycles.turning.contour import Contour
from polycnc.cycles.turning.stock_removal import Removal, remove
from polycnc.toolpath import Kind
from tests.cycles.turning.test_contour import lines

#: Where between two whole mm the stock is looked at: no cut ends there.
PLACE = 0.4371828
#: Parts of a contour as (way along the cuts, way up), in whole mm.
UP = st.tuples(st.integers(0, 5), st.integers(0, 4)).filter(any)
RELIEF = st.tuples(st.integers(1, 3), st.integers(-3, -1))
WAYS = st.lists(UP, min_size=2, max_size=6)
WAYS_WITH_RELIEFS = st.lists(st.one_of(UP, RELIEF), min_size=2, max_size=8)


def contour_of(ways: list[tuple[int, int]]) -> Contour | None:
    corners = [(0.0, 20.0)]
    for along, up in [*ways, (3, 0), (0, 30)]:
        a, b = corners[-1]
        corners.append((a - along, max(b + up, 1.0)))
    return lines(*corners) if corners[0][0] > corners[-1][0] else None


def height(contour: Contour, a: float) -> float:
    """Of the contour at a place."""
    for piece in contour:
        (a0, b0), (a1, b1) = piece.edge.start, piece.edge.end
        if a1 < a < a0:
            return b0 + (b1 - b0) * (a - a0) / (a1 - a0)
    raise AssertionError(a)


def cut(contour: Contour, depth: float) -> list[tuple[float, float]]:
    """Contour and stock after all cuts, at places in the direction of the cuts.

    On the way rapids stay above the stock, cuts above the contour.
    """
    end = contour[-1].edge.end
    places = [k + PLACE for k in range(-1, int(end[0]) - 1, -1)]
    part = [height(contour, a) for a in places]
    stock = [end[1]] * len(places)
    strokes = [each.stroke for each in remove(contour, Removal(depth, 1.0, -1.0))]
    for before, stroke in pairwise(strokes):
        (a0, b0), (a1, b1) = before.end, stroke.end
        for number, a in enumerate(places):
            if min(a0, a1) < a < max(a0, a1):
                level = b0 + (b1 - b0) * (a - a0) / (a1 - a0)
                if stroke.kind is Kind.RAPID:
                    assert level >= stock[number] - 1e-6
                else:
                    assert level >= part[number] - 1e-6
                    stock[number] = min(stock[number], level)
    return list(zip(part, stock, strict=True))


@settings(max_examples=40)
@given(WAYS, st.sampled_from((0.7, 1.3, 2.0, 5.0)))
def test_nothing_stays_on_a_contour_that_rises(ways: list[tuple[int, int]], depth: float) -> None:
    contour = contour_of(ways)
    if contour is not None:
        assert all(stock - part <= 1e-6 for part, stock in cut(contour, depth))


@settings(max_examples=40)
@given(WAYS_WITH_RELIEFS, st.sampled_from((0.7, 1.3, 2.0, 5.0)))
def test_nothing_stands_over_the_summits_of_reliefs(ways: list[tuple[int, int]], depth: float) -> None:
    """On the flank by which a relief is entered steps stay; they are no higher than the summit in front of it."""
    contour = contour_of(ways)
    if contour is not None:
        summit = 20.0
        for (part, stock), ahead in zip(cut(contour, depth), _summits(contour), strict=True):
            summit = max(summit, part, ahead)
            assert stock <= summit + 1e-6


def _summits(contour: Contour) -> list[float]:
    """The highest corner in front of every place."""
    end = int(contour[-1].edge.end[0])
    corners = [contour[0].edge.start, *(piece.edge.end for piece in contour)]
    return [max(b for a, b in corners if a >= k + PLACE) for k in range(-1, end - 1, -1)]
