"""Stock on a contour along both axes: nothing of the contour is cut, walls of reliefs that look away stay."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.cycles.turning.allowance import with_stock
from polycnc.cycles.turning.contour import Contour, Piece, points, shifted, turned_round
from polycnc.geometry import offset

#: Outside, the tool comes from above (-1), the contour runs towards -a from its open end.
OUTSIDE = -1.0


def lines(*corners: tuple[float, float]) -> Contour:
    return [Piece(offset.line(a, b)) for a, b in pairwise(corners)]


def corners(contour: Contour) -> list[tuple[float, float]]:
    ends = [contour[0].edge.start, *(piece.edge.end for piece in contour)]
    return [(round(a, 6) + 0.0, round(b, 6) + 0.0) for a, b in ends]


RELIEF = lines((0.0, 20.0), (-10.0, 20.0), (-15.0, 15.0), (-20.0, 15.0), (-20.0, 25.0))


def test_steps_are_moved_as_they_are() -> None:
    steps = lines((0.0, 20.0), (-10.0, 20.0), (-10.0, 25.0), (-20.0, 25.0))
    assert with_stock(steps, (0.5, 0.2), OUTSIDE) == shifted(steps, 0.5, 0.2)
    assert with_stock(steps, (0.0, 0.0), OUTSIDE) == steps


def test_the_near_wall_of_a_relief_stays() -> None:
    found = corners(with_stock(RELIEF, (0.5, 0.0), OUTSIDE))
    assert found == [(0.5, 20.0), (-9.5, 20.0), (-10.0, 20.0), (-15.0, 15.0), (-19.5, 15.0), (-19.5, 25.0)]


def test_a_wall_that_looks_up_enough_is_moved() -> None:
    """Normal (-1, 1): 0.2 along a against 0.5 along b leaves the wall farther off."""
    assert with_stock(RELIEF, (0.2, 0.5), OUTSIDE) == shifted(RELIEF, 0.2, 0.5)


def test_base_and_wall_meet_where_both_allowances_lead() -> None:
    found = corners(with_stock(RELIEF, (0.5, 0.2), OUTSIDE))
    assert (-10.0, 20.0) in found
    assert (-14.8, 15.2) in found
    assert found[-2:] == [(-19.5, 15.2), (-19.5, 25.2)]


def test_both_directions_give_the_same() -> None:
    there = corners(with_stock(RELIEF, (0.5, 0.2), OUTSIDE))
    back = corners(with_stock(turned_round(RELIEF), (0.5, 0.2), OUTSIDE))
    assert back == there[::-1]


def test_a_relief_narrower_than_its_stock_has_no_base() -> None:
    narrow = lines((0.0, 20.0), (-10.0, 20.0), (-12.0, 18.0), (-12.2, 18.0), (-12.2, 25.0))
    found = corners(with_stock(narrow, (0.5, 0.0), OUTSIDE))
    assert found[-3:] == [(-10.0, 20.0), (-11.7, 18.3), (-11.7, 25.0)]


def test_arcs_are_parted_where_they_run_along_the_way() -> None:
    bowl = [
        Piece(offset.line((0.0, 20.0), (-10.0, 20.0))),
        Piece(offset.arc((-10.0, 20.0), (-20.0, 20.0), (-15.0, 20.0), False)),
        Piece(offset.line((-20.0, 20.0), (-30.0, 20.0))),
    ]
    found = with_stock(bowl, (1.0, 0.0), OUTSIDE)
    arcs = [piece.edge for piece in found if piece.edge.center is not None]
    assert [arc.center for arc in arcs] == [(-15.0, 20.0), (-14.0, 20.0)]
    assert arcs[0].end == pytest.approx(arcs[1].start)
    assert arcs[0].end == pytest.approx((-14.5, 20.0 - (25.0 - 0.25) ** 0.5))


@given(
    st.lists(st.tuples(st.floats(0.5, 6.0), st.floats(-6.0, 8.0)), min_size=3, max_size=8),
    st.floats(0.0, 0.4),
    st.floats(0.0, 0.4),
)
def test_nothing_of_the_contour_is_cut(ways: list[tuple[float, float]], along: float, up: float) -> None:
    ends = [(0.0, 30.0)]
    for da, db in ways:
        ends.append((ends[-1][0] - da, max(ends[-1][1] + db, 1.0)))
    contour = lines(*ends)
    try:
        found = with_stock(contour, (along, up), OUTSIDE)
    except ValueError:
        return
    for piece in found:
        for a, b in points(piece.edge):
            for before, after in pairwise(ends):
                if after[0] <= a <= before[0]:
                    part = (a - before[0]) / (after[0] - before[0])
                    assert b >= before[1] + part * (after[1] - before[1]) - 1e-6
