"""Arcs: tables worked out by hand, and properties that tie the functions to each other."""

from __future__ import annotations

from math import hypot, isclose, pi, sqrt
from typing import TYPE_CHECKING

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from polycnc.geometry import arcs, vectors

if TYPE_CHECKING:
    from polycnc.geometry.arcs import Point

coordinate = st.floats(-500.0, 500.0, allow_nan=False)
point = st.tuples(coordinate, coordinate)


@pytest.mark.parametrize(
    ("start", "end", "radius", "ccw", "center"),
    [
        ((10, 0), (0, 10), 10, True, (0, 0)),
        ((10, 0), (0, 10), -10, True, (10, 10)),
        ((10, 0), (0, 10), 10, False, (10, 10)),
        ((10, 0), (0, 10), -10, False, (0, 0)),
        ((0, 0), (20, 0), 10, True, (10, 0)),
        ((0, 0), (6, 0), 5, True, (3, 4)),
        ((0, 0), (6, 0), 5, False, (3, -4)),
    ],
)
def test_radius_gives_the_centre(start: Point, end: Point, radius: float, ccw: bool, center: Point) -> None:
    assert arcs.center_from_radius(start, end, radius, ccw) == pytest.approx(center, abs=1e-12)


def test_chord_longer_than_the_diameter_is_clamped_inside_the_tolerance_and_refused_beyond() -> None:
    assert arcs.center_from_radius((0, 0), (20.01, 0), 10, True, 0.02) == pytest.approx((10.005, 0))
    with pytest.raises(ValueError, match="chord"):
        arcs.center_from_radius((0, 0), (20.03, 0), 10, True, 0.02)


@pytest.mark.parametrize(("start", "end", "radius"), [((0, 0), (5, 0), 0), ((3, 3), (3, 3), 5)])
def test_no_radius_and_no_chord_are_refused(start: Point, end: Point, radius: float) -> None:
    with pytest.raises(ValueError, match="no circle"):
        arcs.center_from_radius(start, end, radius, True)


@pytest.mark.parametrize(
    ("start", "end", "ccw", "sweep"),
    [
        ((1, 0), (0, 1), True, 90),
        ((1, 0), (0, 1), False, -270),
        ((1, 0), (-1, 0), True, 180),
        ((1, 0), (-1, 0), False, -180),
        ((0, -1), (0, 1), True, 180),
        ((0, -1), (0, 1), False, -180),
        ((1, 0), (1, 0), True, 360),
        ((1, 0), (1, 0), False, -360),
        ((0, 1), (1, 0), True, 270),
    ],
)
def test_sweep_of_arcs_about_the_origin(start: Point, end: Point, ccw: bool, sweep: float) -> None:
    assert arcs.sweep_angle(start, end, (0, 0), ccw) == pytest.approx(sweep * pi / 180)


@given(point, point, st.floats(0.5, 3.0), st.booleans(), st.booleans())
def test_both_radii_are_equal_and_the_sign_tells_the_longer_arc(
    start: Point, end: Point, factor: float, ccw: bool, long: bool
) -> None:
    chord = hypot(end[0] - start[0], end[1] - start[1])
    assume(chord > 1e-3)
    radius = factor * chord
    center = arcs.center_from_radius(start, end, -radius if long else radius, ccw)
    assert isclose(arcs.radius_of(center, start), radius, rel_tol=1e-6)
    assert isclose(arcs.radius_of(center, end), radius, rel_tol=1e-6)
    sweep = arcs.sweep_angle(start, end, center, ccw)
    assert (sweep > 0) == ccw
    assert abs(sweep) >= pi - 1e-3 if long else abs(sweep) <= pi + 1e-3


def test_lengths_of_arc_helix_turns_and_full_circle() -> None:
    assert arcs.arc_length((10, 0), (0, 10), (0, 0), True) == pytest.approx(5 * pi)
    assert arcs.arc_length((10, 0), (10, 0), (0, 0), False) == pytest.approx(20 * pi)
    assert arcs.arc_length((10, 0), (0, 10), (0, 0), True, turns=2) == pytest.approx(45 * pi)
    assert arcs.arc_length((1, 0), (1, 0), (0, 0), True, rise=3) == pytest.approx(hypot(2 * pi, 3))


def test_radius_mismatch_is_end_less_start() -> None:
    assert arcs.radius_mismatch((10, 0), (0, 10.5), (0, 0)) == pytest.approx(0.5)


def test_points_along_an_arc_and_along_a_spiral() -> None:
    assert arcs.point_on_arc((10, 0), (0, 10), (0, 0), True, 0.5) == pytest.approx((50**0.5, 50**0.5))
    assert arcs.point_on_arc((10, 0), (0, 10), (0, 0), False, 1 / 3) == pytest.approx((0, -10))
    assert arcs.point_on_arc((10, 0), (-20, 0), (0, 0), True, 0.5) == pytest.approx((0, 15))
    assert arcs.point_on_arc((10, 0), (10, 0), (0, 0), True, 0.25, turns=1) == pytest.approx((-10, 0))


@pytest.mark.parametrize(("ccw", "tangent"), [(True, (0, 1)), (False, (0, -1))])
def test_tangent_points_in_the_direction_of_travel(ccw: bool, tangent: Point) -> None:
    assert arcs.tangent_at((0, 0), (10, 0), ccw) == pytest.approx(tangent)


@given(point, point, st.floats(0.51, 3.0), st.booleans(), st.integers(1, 40))
def test_every_point_of_a_split_arc_lies_in_its_sweep(
    start: Point, end: Point, factor: float, ccw: bool, parts: int
) -> None:
    chord = hypot(end[0] - start[0], end[1] - start[1])
    assume(chord > 1e-3)
    center = arcs.center_from_radius(start, end, factor * chord, ccw)
    points = arcs.split(start, end, center, ccw, parts)
    assert len(points) == parts
    assert points[-1] == end
    for at in points:
        assert arcs.radius_of(center, at) == pytest.approx(arcs.radius_of(center, start))
        assert arcs.contains_direction(start, end, center, ccw, at, 1e-6)


def test_direction_outside_an_arc_is_not_on_it() -> None:
    assert not arcs.contains_direction((10, 0), (0, 10), (0, 0), True, (-1, -1))
    assert arcs.contains_direction((10, 0), (0, 10), (0, 0), False, (-1, -1))
    assert arcs.contains_direction((10, 0), (0, 10), (0, 0), False, (10, 0))


@pytest.mark.parametrize(
    ("radius", "sweep", "error", "parts"),
    [
        (10, pi / 2, 10 * (1 - sqrt(3) / 2), 2),
        (10, pi / 2, 10 * (1 - sqrt(3) / 2) - 1e-3, 2),
        (10, 2 * pi, 50, 2),
        (10, pi, 20, 1),
    ],
)
def test_parts_for_a_chord_error(radius: float, sweep: float, error: float, parts: int) -> None:
    assert arcs.parts_for_chord_error(radius, sweep, error) == parts


def test_three_points_give_centre_and_a_normal_that_sees_the_arc_counter_clockwise() -> None:
    center, normal = arcs.three_point_circle((10, 0, 5), (0, 10, 5), (-10, 0, 5))
    assert center == pytest.approx((0, 0, 5))
    assert normal == pytest.approx((0, 0, 1))
    center, normal = arcs.three_point_circle((0, 10, 0), (0, 0, 10), (0, -10, 0))
    assert center == pytest.approx((0, 0, 0))
    assert normal == pytest.approx((1, 0, 0))


@pytest.mark.parametrize("third", [(2, 2, 2), (0, 0, 0), (1, 1, 1)])
def test_three_points_on_a_line_are_refused(third: tuple[float, float, float]) -> None:
    with pytest.raises(ValueError, match="line"):
        arcs.three_point_circle((0, 0, 0), (1, 1, 1), third)


@given(*(st.tuples(coordinate, coordinate, coordinate) for _ in range(3)))
def test_the_centre_is_equally_far_from_all_three_points(
    a: tuple[float, float, float], b: tuple[float, float, float], c: tuple[float, float, float]
) -> None:
    sides = [sqrt(sum((p - q) ** 2 for p, q in zip(x, y, strict=True))) for x, y in ((a, b), (b, c), (a, c))]
    area = vectors.cross(vectors.minus(b, a), vectors.minus(c, a))
    assume(min(sides) > 1e-2 and sqrt(sum(x * x for x in area)) > 0.05 * max(sides) ** 2)
    center, normal = arcs.three_point_circle(a, b, c)
    distances = [sqrt(sum((p - q) ** 2 for p, q in zip(x, center, strict=True))) for x in (a, b, c)]
    assert max(distances) - min(distances) < 1e-6
    assert sum(x * x for x in normal) == pytest.approx(1)


@pytest.mark.parametrize(
    ("end", "ccw", "stop"),
    [
        ((200.0, 0.0), False, (100.0, 0.0)),
        ((60.0, 90.0), False, (sqrt(1900.0), 90.0)),
        ((-90.0, -60.0), True, (-90.0, -sqrt(1900.0))),
    ],
)
def test_an_arc_leaves_its_circle_where_it_reaches_a_coordinate_of_the_end_point(
    end: arcs.Point, ccw: bool, stop: arcs.Point
) -> None:
    assert arcs.stop_on_circle((0.0, 100.0), end, (0.0, 0.0), ccw) == pytest.approx(stop)


def test_where_the_circle_reaches_neither_coordinate_the_arc_stops_on_the_ray_to_the_end_point() -> None:
    assert arcs.stop_on_circle((0.0, 5.0), (6.0, 8.0), (0.0, 0.0), False) == pytest.approx((3.0, 4.0))
