"""Lines as typed buffers."""

from __future__ import annotations

from array import array

from polycnc.view.lines import BYTES, FEED, KINDS, RAPID, WIDTH, Lines


def numbers(data: bytes) -> list[tuple[float, ...]]:
    """The points of a buffer, each as its five numbers."""
    found = array("f", data)
    return [tuple(found[i : i + WIDTH]) for i in range(0, len(found), WIDTH)]


def test_a_point_is_five_numbers_of_four_bytes() -> None:
    lines = Lines()
    red = lines.colour("T1")
    assert lines.colour("T2") == red + 1
    assert lines.colour("T1") == red
    lines.add((1.0, 2.0, 3.0), 600.0, FEED, 1)
    assert len(lines.part(0, 10)) == WIDTH * BYTES
    assert numbers(lines.part(0, 10)) == [(1.0, 2.0, 3.0, 600.0, FEED + KINDS)]
    assert lines.last() == (1.0, 2.0, 3.0)


def test_columns_are_added_as_points_one_by_one_are() -> None:
    one, many = Lines(), Lines()
    for i in range(5):
        one.add((i, 0.0, -i), 10.0 * i, RAPID, 2)
    values = [float(i) for i in range(5)]
    many.extend([values, None, [-v for v in values]], [10.0 * v for v in values], [RAPID + 2 * KINDS] * 5)
    assert numbers(many.part(0, 9)) == numbers(one.part(0, 9))
    assert numbers(many.part(3, 1)) == numbers(one.part(3, 1)) == [(3.0, 0.0, -3.0, 30.0, RAPID + 2 * KINDS)]


def test_where_too_many_points_come_the_older_half_goes_and_copies_are_void() -> None:
    lines = Lines(most=10)
    for i in range(11):
        lines.add((float(i), 0.0, 0.0), 0.0, FEED, 0)
    assert len(lines) == 6
    assert lines.era == 1
    assert numbers(lines.part(0, 1))[0][0] == 5.0
    lines.clear()
    assert (len(lines), lines.era, lines.last()) == (0, 2, ())
