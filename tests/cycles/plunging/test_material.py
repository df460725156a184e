"""What cuts leave of a stock."""

from __future__ import annotations

import pytest

from polycnc.cycles.plunging.material import Edges, left_by
from polycnc.cycles.plunging.profile import level
from polycnc.geometry import offset

STOCK = level(10.0, 0.0, 20.0)


def test_a_point_takes_what_it_passes_over() -> None:
    left = left_by(STOCK, [offset.line((4.0, 8.0), (12.0, 6.0))], Edges(0.0, 0.0, (0.0, 0.0)))
    assert [left.height(a) for a in (3.0, 8.0, 13.0)] == pytest.approx([10.0, 7.0, 10.0])


def test_a_nose_leaves_its_radius_in_a_corner() -> None:
    ways = [offset.line((20.0, 6.0), (4.0, 6.0)), offset.line((4.0, 6.0), (4.0, 11.0))]
    left = left_by(STOCK, ways, Edges(1.0, 0.0, (1.0, 1.0)))
    assert left.height(10.0) == pytest.approx(6.0)
    assert left.height(5.0 - 0.6) == pytest.approx(7.0 - 0.8, abs=1e-4)
    assert left.height(3.9) == pytest.approx(10.0)


def test_a_plunge_is_as_wide_as_the_tool() -> None:
    left = left_by(STOCK, [offset.line((5.0, 12.0), (5.0, 4.0))], Edges(0.2, 3.0, (0.2, 0.2)))
    assert [left.height(a) for a in (4.9, 6.5, 8.1)] == pytest.approx([10.0, 4.0, 10.0])


def test_no_cut_puts_anything_on() -> None:
    ways = [offset.line((2.0, 5.0), (9.0, 5.0)), offset.line((0.0, 8.0), (20.0, 8.0))]
    left = left_by(STOCK, ways, Edges(0.0, 0.0, (0.0, 0.0)))
    assert [left.height(a) for a in (1.0, 5.0, 15.0)] == pytest.approx([8.0, 5.0, 8.0])


def test_an_arc_is_cut_as_an_arc() -> None:
    bowl = offset.arc((4.0, 10.0), (16.0, 10.0), (10.0, 10.0), True)
    left = left_by(STOCK, [bowl], Edges(0.0, 0.0, (0.0, 0.0)))
    assert left.height(10.0) == pytest.approx(4.0)
    assert any(curve.center is not None for curve in left.curves)
