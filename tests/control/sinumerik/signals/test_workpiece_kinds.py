"""MEASURE: circles, corners and planes through measured points."""

from __future__ import annotations

from math import cos, dist, radians, sin

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from polycnc.control.sinumerik.signals.workpiece_kinds import (
    circle_through,
    corners_of,
    given_direction,
    tilt,
)
from polycnc.language.sinumerik.names.frame import crot

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


@given(PLACE, PLACE, st.floats(-89, 90), st.floats(20, 160), st.floats(0, 20), st.integers(0, 3))
def test_a_corner_is_found_by_two_points_on_each_edge_or_by_given_angles(
    x: float, y: float, alpha: float, phi: float, radius: float, turns: int
) -> None:
    angle = alpha + 180.0 * (turns % 2)
    sense = 1.0 if turns < 2 else -1.0
    one, two = given_direction(angle), given_direction(angle + sense * phi)

    def touched(along: tuple[float, float], other: tuple[float, float], way: float) -> tuple[float, float]:
        """A centre beside an edge, outside of the work."""
        part = along[0] * other[0] + along[1] * other[1]
        out = [a - part * b for a, b in zip(other, along, strict=True)]
        size = dist((0.0, 0.0), out)
        a, b = (p + way * s - radius * o / size for p, s, o in zip((x, y), along, out, strict=True))
        return a, b

    points = [*(touched(one, two, way) for way in (60, 150)), *(touched(two, one, way) for way in (60, 150))]
    assume(radius / abs(sin(radians(phi))) < 50.0)
    for given_points, given_phi in (
        (points, None),
        ([*points[:3], None], phi),
        ([points[0], None, points[2], None], phi),
    ):
        area = abs(one[0] * two[1] - one[1] * two[0])
        corners = [
            [p + radius / area * (a + b) for p, a, b in zip(*found, strict=True)]
            for found in corners_of(given_points, one, given_phi)
        ]
        assert corners[0] == pytest.approx([x, y], abs=1e-5) or len(corners) == 2
        assert any(corner == pytest.approx([x, y], abs=1e-5) for corner in corners)


@given(st.floats(-80, 80), st.floats(-80, 80), st.integers(0, 2))
def test_a_plane_is_level_behind_its_rotations(first: float, second: float, w: int) -> None:
    u, v = (1, 2) if w == 0 else (2, 0) if w == 1 else (0, 1)
    turned = crot({"XYZ"[u]: first, "XYZ"[v]: second}).frame
    axis = [0.0, 0.0, 0.0]
    axis[w] = 1.0
    normal = turned.direct(*axis)
    assume(normal[w] > 0.01)
    back = crot(dict(zip(("XYZ"[u], "XYZ"[v]), tilt(normal, w), strict=True))).frame
    assert back.direct(*axis) == pytest.approx(normal, abs=1e-9)
