"""Ways of the tool's direction."""

from __future__ import annotations

from math import cos, hypot, pi, radians, sin
from typing import TYPE_CHECKING

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from polycnc.geometry.vectors import cross, dot
from polycnc.transformation.orientation.directions import (
    about,
    angle_between,
    axis_of_opening,
    axis_of_tangent,
    axis_through,
    cone,
    great_circle,
    leaned,
    polynomial,
    tangent_at_end,
    unit_of,
)

if TYPE_CHECKING:
    from polycnc.geometry.frames import Vector

X: Vector = (1.0, 0.0, 0.0)
Y: Vector = (0.0, 1.0, 0.0)
Z: Vector = (0.0, 0.0, 1.0)
_parts = st.floats(-1.0, 1.0)
vectors = st.tuples(_parts, _parts, _parts).map(unit_of).filter(lambda v: v is not None)
shares = st.floats(0.0, 1.0)


def near(vector: Vector) -> object:
    return pytest.approx(vector, abs=1e-8)


@given(vectors, vectors, shares)
def test_a_great_circle_stays_in_its_plane_and_turns_evenly(a: Vector, b: Vector, share: float) -> None:
    assume(1e-3 < angle_between(a, b) < pi - 1e-3)
    way = great_circle(a, b)
    assert way is not None
    assert way(0.0) == near(a)
    assert way(1.0) == near(b)
    assert hypot(*way(share)) == pytest.approx(1.0)
    assert dot(way(share), cross(a, b)) == pytest.approx(0.0, abs=1e-9)
    assert angle_between(a, way(share)) == pytest.approx(share * angle_between(a, b), abs=1e-9)


def test_opposite_directions_have_no_plane() -> None:
    assert great_circle(Z, (0.0, 0.0, -1.0)) is None


def test_a_polynomial_meets_its_ends_and_its_coefficients() -> None:
    value = polynomial(90.0, 180.0, (90.0,))
    assert [value(u) for u in (0.0, 0.5, 1.0)] == pytest.approx([90.0, 112.5, 180.0])


def test_polynomials_turn_within_the_plane_and_out_of_it() -> None:
    way = great_circle(Z, X, (40.0,), (20.0,))
    assert way is not None
    half = way(0.5)
    assert dot(half, Y) == pytest.approx(sin(radians(-5.0)))
    assert angle_between(Z, (half[0], 0.0, half[2])) == pytest.approx(radians(35.0))
    assert way(1.0) == near(X)


@given(vectors, vectors, vectors, st.sampled_from([1, -1]), shares)
def test_a_cone_ends_where_it_should_in_the_sense_that_it_should(
    axis: Vector, a: Vector, b: Vector, sense: int, share: float
) -> None:
    assume(all(1e-2 < angle_between(axis, v) < pi - 1e-2 for v in (a, b)))
    angle = about(axis, a, b, sense)
    assert sense * angle >= -1e-8
    way = cone(axis, a, b, angle)
    assert way(0.0) == near(a)
    assert way(1.0) == near(b)
    low, high = sorted((angle_between(axis, a), angle_between(axis, b)))
    assert low - 1e-8 <= angle_between(axis, way(share)) <= high + 1e-8


def test_a_whole_turn_where_start_and_end_are_the_same() -> None:
    slanted = (cos(1.0), 0.0, sin(1.0))
    assert about(Z, slanted, slanted, 1, whole=True) == pytest.approx(2.0 * pi)
    assert about(Z, slanted, slanted, -1, whole=True) == pytest.approx(-2.0 * pi)
    assert about(Z, slanted, slanted, 1) == 0.0


@given(vectors, vectors, st.floats(0.0, 1.0), st.sampled_from([1, -1]))
def test_both_directions_lie_on_the_cone_of_an_opening(a: Vector, b: Vector, part: float, side: int) -> None:
    between = angle_between(a, b)
    assume(1e-2 < between < pi - 1e-2)
    opening = between + part * (pi - between)
    axis = axis_of_opening(a, b, opening, side)
    assert axis is not None
    assert [angle_between(axis, v) for v in (a, b)] == pytest.approx([opening / 2.0] * 2, abs=1e-6)
    assert axis_of_opening(a, b, between - 1e-2, side) is None


def test_three_directions_give_a_cone() -> None:
    slanted = [unit_of((cos(t), sin(t), 2.0)) for t in (0.0, 1.0, 2.0)]
    first, middle, last = (v for v in slanted if v is not None)
    assert axis_through(first, middle, last) == near(Z)
    assert axis_through(first, first, last) is None


def test_a_cone_goes_on_along_a_tangent() -> None:
    way = great_circle(Z, X)
    assert way is not None
    tangent = tangent_at_end(way)
    assert tangent == pytest.approx((0.0, 0.0, -1.0), abs=1e-3)
    axis = axis_of_tangent(X, (0.0, 0.0, -1.0), Y)
    assert axis is not None
    begins = cone(axis, X, Y, about(axis, X, Y, 1))(1e-6)
    assert begins[2] < 0.0
    assert abs(begins[1]) < 1e-9


def test_lead_leans_towards_the_path_and_tilt_across_it() -> None:
    assert leaned(X, Z, 30.0, 0.0) == near((0.5, 0.0, cos(radians(30.0))))
    assert leaned(X, Z, 0.0, 30.0) == near((0.0, -0.5, cos(radians(30.0))))
    assert leaned(X, Z, 90.0, 90.0, about_normal=True) == near(Y)
