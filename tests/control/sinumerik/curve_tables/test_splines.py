from __future__ import annotations

from itertools import pairwise

import pytest

from polycnc.control.sinumerik.curve_tables.splines import AUTOMATIC, NATURAL, TANGENT, curve
from polycnc.geometry.polynomials import derivative, value

POINTS = [(0.0, 0.0), (3.0, 4.0), (6.0, 0.0), (9.0, 4.0), (15.0, 4.0)]


@pytest.mark.parametrize("akima", [True, False])
def test_a_spline_goes_through_its_points_without_a_corner(akima: bool) -> None:
    pieces = curve(POINTS, akima=akima)
    for (x, y), start, end in zip(pieces, POINTS, POINTS[1:], strict=False):
        assert (x[0], y[0]) == pytest.approx(start)
        assert (sum(x), sum(y)) == pytest.approx(end)
    for before, behind in pairwise(pieces):
        slopes = [
            value(derivative(y), p) / value(derivative(x), p) for (x, y), p in ((before, 1.0), (behind, 0.0))
        ]
        assert slopes[0] == pytest.approx(slopes[1])


@pytest.mark.parametrize("akima", [True, False])
def test_points_on_a_line_stay_on_it(akima: bool) -> None:
    for x, y in curve([(0.0, 1.0), (2.0, 5.0), (3.0, 7.0), (7.0, 15.0)], akima=akima):
        assert value(y, 0.3) == pytest.approx(1.0 + 2.0 * value(x, 0.3))


def test_an_akima_spline_leaves_a_straight_run_straight() -> None:
    pieces = curve([(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 1.0), (4.0, 0.0)], akima=True)
    assert value(pieces[0][1], 0.5) == pytest.approx(0.0)


def test_ends_of_a_c_spline() -> None:
    natural = curve(POINTS, akima=False, begin=NATURAL)[0][1]
    assert derivative(derivative(natural))[0] == pytest.approx(0.0)
    led = curve(POINTS, akima=False, begin=TANGENT, before=(-1.0, 0.0))[0]
    assert derivative(led[1])[0] == pytest.approx(0.0)
    cubic = [(x, x**3) for x in (0.0, 1.0, 2.0, 3.0)]
    along = [(float(k), 0.0) for k in range(4)]
    assert curve(along, akima=False, begin=AUTOMATIC, end=AUTOMATIC)[1][1] == pytest.approx((0.0,), abs=1e-12)
    first, second = curve(cubic, akima=False, begin=AUTOMATIC, end=AUTOMATIC)[:2]
    assert len(first[1]) == len(second[1]) == 4
