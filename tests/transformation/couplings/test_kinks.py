from __future__ import annotations

from itertools import pairwise
from math import cos, pi

import pytest

from polycnc.control.sinumerik.curve_tables.curve import ONCE, PERIODIC, CurveTable, Segment
from polycnc.geometry.frames import IDENTITY
from polycnc.transformation.couplings.coupled import Coupled
from polycnc.transformation.couplings.kinks import has_kinks, kinks
from polycnc.transformation.couplings.laws import ByCurve, Ratio
from polycnc.transformation.kinematic.parallel import ParallelAxes
from polycnc.transformation.seated import Seated


def table(*points: tuple[float, float], period: int = ONCE) -> CurveTable:
    """Lines from point to point."""
    pairs = pairwise(points)
    return CurveTable(1, period, tuple(Segment((a, c - a), (b, d - b)) for (a, b), (c, d) in pairs))


def led(curve: CurveTable, from_place: float | None = None) -> Coupled:
    """Column 1 follows column 0."""
    return Coupled.of({1: [ByCurve(0, curve, from_place=from_place)]}, (0, -1, -1))


@pytest.mark.parametrize(
    ("first", "last", "expected"),
    [
        (0.0, 20.0, [0.5, 1.0]),
        (20.0, 0.0, [0.5, 1.0]),
        (2.0, 8.0, []),
        (10.0, 15.0, []),
        (-10.0, 10.0, [0.5, 1.0]),
        (15.0, 40.0, [0.2]),
    ],
)
def test_a_row_passes_kinks_within_it_and_at_its_end(
    first: float, last: float, expected: list[float]
) -> None:
    curve = table((0.0, 0.0), (10.0, 5.0), (20.0, 5.0 - 1e-3 * 10.0))
    found = kinks(led(curve), lambda f: [first + (last - first) * f, 0.0], lambda *_: 1e-4)
    assert found == pytest.approx(expected)


def test_a_small_kink_counts_as_none() -> None:
    curve = table((0.0, 0.0), (10.0, 5.0), (20.0, 10.5), (30.0, 10.0))

    def path(f: float) -> list[float]:
        return [1.0 + 28.0 * f, 0.0]

    assert len(kinks(led(curve), path, lambda *_: 0.01)) == 2
    assert kinks(led(curve), path, lambda *_: 0.1) == pytest.approx([19.0 / 28.0])


def test_a_periodic_table_has_its_kinks_in_every_period() -> None:
    curve = table((0.0, 0.0), (5.0, 5.0), (10.0, 0.0), period=PERIODIC)
    found = kinks(led(curve), lambda f: [-12.0 + 24.0 * f, 0.0], lambda *_: 0.01)
    assert [-12.0 + 24.0 * f for f in found] == pytest.approx([-10.0, -5.0, 0.0, 5.0, 10.0])


def test_on_an_arc_the_leading_axis_passes_a_kink_twice_behind_frame_and_tool() -> None:
    curve = table((0.0, 0.0), (10.0, 0.0), (20.0, 10.0))
    seated = Seated(ParallelAxes((-1, -1, -1)), IDENTITY, (), (3.0, 0.0), led=led(curve))
    found = kinks(seated, lambda f: [10.0 - 5.0 * cos(2.0 * pi * f), 0.0], lambda *_: 0.01)
    assert found == pytest.approx([0.25, 0.75])


def test_from_where_a_curve_leads_is_a_kink() -> None:
    assert kinks(
        led(table((0.0, 0.0), (20.0, 20.0)), from_place=5.0), lambda f: [1.0 + 8.0 * f, 0.0], lambda *_: 0.01
    ) == pytest.approx([0.5])


def test_ratios_have_none() -> None:
    coupled = Coupled.of({1: [Ratio(0, 2.0)]}, (0, -1, -1))
    assert not has_kinks(coupled)
    assert not has_kinks(None)
    assert has_kinks(led(table((0.0, 0.0), (1.0, 1.0))))
    assert kinks(coupled, lambda f: [f, 0.0], lambda *_: 0.0) == []
