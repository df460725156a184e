"""MEASURE: the circle through measured points."""

from __future__ import annotations

from math import cos, dist, radians, sin

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from polycnc.control.sinumerik.signals.workpiece import circle_through

PLACE = st.floats(-500, 500)
RADIUS = st.floats(0.5, 200)
ANGLES = st.lists(st.integers(0, 359), min_size=3, max_size=4, unique=True)


def _on_circle(center: tuple[float, float], radius: float, angle: float) -> tuple[float, float]:
    return center[0] + radius * cos(radians(angle)), center[1] + radius * sin(radians(angle))


@given(PLACE, PLACE, RADIUS, ANGLES)
def test_points_of_a_circle_give_it(x: float, y: float, radius: float, angles: list[int]) -> None:
    ordered = sorted(angles)
    assume(ordered[-1] - ordered[0] >= 30)
    found = circle_through([_on_circle((x, y), radius, angle) for angle in angles])
    assert found is not None
    assert found[0] == pytest.approx((x, y), abs=1e-5)
    assert found[1] == pytest.approx(radius, abs=1e-5)


@given(RADIUS, st.lists(st.floats(-0.02, 0.02), min_size=4, max_size=4), st.floats(0, 6.28))
def test_no_other_circle_is_nearer_to_four_points(radius: float, errors: list[float], turn: float) -> None:
    angles = (0.0, 80.0, 190.0, 260.0)
    points = [_on_circle((3.0, -4.0), radius * (1.0 + e), a) for e, a in zip(errors, angles, strict=True)]
    found = circle_through(points)
    assert found is not None
    (u, v), own = found

    def quality(a: float, b: float, r: float) -> float:
        return sum((dist(point, (a, b)) - r) ** 2 for point in points)

    least, step = quality(u, v, own), 1e-3 * radius
    for a, b, r in ((step * cos(turn), step * sin(turn), 0.0), (0.0, 0.0, step), (0.0, 0.0, -step)):
        assert quality(u + a, v + b, own + r) >= least - 1e-12 * radius * radius


@pytest.mark.parametrize("points", [[(0, 0), (1, 1), (2, 2)], [(1, 2)] * 3, [(0, 0), (0, 0), (5, 0)]])
def test_points_on_a_line_give_none(points: list[tuple[float, float]]) -> None:
    assert circle_through(points) is None
