"""Distances of lines and arcs against points along them."""

from __future__ import annotations

from math import cos, hypot, pi, sin

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.geometry import distance, offset
from polycnc.geometry.offset import Edge

_COORDINATE = st.integers(-40, 40).map(lambda k: 0.25 * k)


@st.composite
def edges(draw: st.DrawFn) -> tuple[Edge, list[tuple[float, float]]]:
    """A line or an arc, and points along it that lie no farther apart than about 0.05 mm."""
    u, v = draw(_COORDINATE), draw(_COORDINATE)
    if draw(st.booleans()):
        end = (draw(_COORDINATE), draw(_COORDINATE))
        count = 1 + int(hypot(end[0] - u, end[1] - v) / 0.05)
        return offset.line((u, v), end), [
            (u + (end[0] - u) * k / count, v + (end[1] - v) * k / count) for k in range(count + 1)
        ]
    radius, first = draw(st.floats(0.5, 8)), draw(st.floats(-pi, pi))
    sweep = draw(st.floats(0.1, 6)) * draw(st.sampled_from([1, -1]))
    count = 1 + int(radius * abs(sweep) / 0.05)
    angles = [first + sweep * k / count for k in range(count + 1)]
    points = [(u + radius * cos(a), v + radius * sin(a)) for a in angles]
    return offset.arc(points[0], points[-1], (u, v), sweep > 0), points


@settings(max_examples=80, deadline=None)
@given(edges(), edges())
def test_the_distance_of_two_edges_is_that_of_their_nearest_points(
    one: tuple[Edge, list[tuple[float, float]]], two: tuple[Edge, list[tuple[float, float]]]
) -> None:
    found = distance.between(one[0], two[0])
    assert found == pytest.approx(distance.between(two[0], one[0]), abs=1e-9)
    sampled = min(distance.of_point(point, two[0]) for point in one[1])
    assert sampled - 0.03 <= found <= sampled + 1e-9


@settings(max_examples=60, deadline=None)
@given(_COORDINATE, _COORDINATE, edges())
def test_the_distance_of_a_point_is_that_of_the_nearest_point_of_the_edge(
    u: float, v: float, edge: tuple[Edge, list[tuple[float, float]]]
) -> None:
    nearest = min(hypot(u - a, v - b) for a, b in edge[1])
    assert distance.of_point((u, v), edge[0]) == pytest.approx(nearest, abs=0.03)


def test_a_line_inside_a_full_circle_keeps_its_distance_from_the_rim() -> None:
    circle = offset.arc((5.0, 0.0), (5.0, 0.0), (0.0, 0.0), ccw=True)
    assert distance.between(circle, offset.line((-1.0, 2.0), (1.0, 2.0))) == pytest.approx(5 - hypot(1, 2))
    assert distance.between(circle, offset.line((0.0, 0.0), (9.0, 0.0))) == 0.0
