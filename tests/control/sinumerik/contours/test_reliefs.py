from __future__ import annotations

from itertools import count, pairwise

from hypothesis import given
from hypothesis import strategies as st

from polycnc.control.sinumerik.contours.elements import Element, Side
from polycnc.control.sinumerik.contours.reliefs import END, Linked, link
from polycnc.geometry import offset

OUTSIDE = Side(across=False, sign=1.0)


def linked(*heights: float) -> Linked:
    """A contour that goes 10 mm to the left for each height."""
    points = [(-10.0 * k, height) for k, height in enumerate(heights)]
    elements = [Element(offset.line(a, b), 10) for a, b in pairwise(points)]
    return link(elements, OUTSIDE, 1, count(len(elements) + 1))


def marks(found: Linked) -> dict[int, int]:
    """Column 7 by row, without those that are 0."""
    return {row.number: row.mark for row in found.rows if row.mark}


def test_a_contour_without_relief_ends_its_list_in_the_first_row() -> None:
    found = linked(10, 10, 20, 20, 30)
    assert found.reliefs == 0
    assert marks(found) == {1: END}


def test_turning_points_are_chained() -> None:
    found = linked(0, 30, 10, 40, 20, 50)
    assert found.reliefs == 2
    assert marks(found) == {1: -2, 2: 3, 3: -4, 4: 5, 5: END}
    assert [row.number for row in found.rows] == [1, 2, 3, 6, 4, 5, 7]


def test_the_element_that_rises_past_a_relief_is_divided_there() -> None:
    found = linked(20, 10, 12, 40)
    rows = {row.number: row for row in found.rows}
    assert rows[3].element.edge.end[1] == 20
    assert rows[4].element.edge.start == rows[3].element.edge.end
    assert (rows[3].behind, rows[4].before, rows[4].behind) == (4, 3, 0)


def test_a_contour_that_ends_low_is_closed_to_its_greatest_height() -> None:
    found = linked(30, 10, 20, 5)
    assert found.reliefs == 2
    assert found.rows[-1].element.edge.end == (-30.0, 30.0)
    assert found.rows[-2].element.edge.end == (-30.0, 20.0)


@given(st.lists(st.integers(0, 8), min_size=2, max_size=12))
def test_rows_are_one_way_through_the_contour(heights: list[int]) -> None:
    found = linked(*map(float, heights))
    assert sorted(row.number for row in found.rows) == list(range(1, len(found.rows) + 1))
    for before, behind in pairwise(found.rows):
        assert before.behind == behind.number
        assert behind.before == before.number
        assert before.element.edge.end == behind.element.edge.start
    assert found.reliefs == sum(row.mark > 0 for row in found.rows)
    assert sum(row.mark == END for row in found.rows) == 1
