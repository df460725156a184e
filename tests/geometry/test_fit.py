"""Best fit of points to points."""

from __future__ import annotations

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from polycnc.geometry.fit import distances, is_collinear, rigid_fit
from polycnc.geometry.frames import Vector, rotation, translation

COORDINATES = st.floats(-100.0, 100.0)
POINTS = st.tuples(COORDINATES, COORDINATES, COORDINATES)
ANGLES = st.floats(-179.0, 179.0)


@given(st.lists(POINTS, min_size=3, max_size=4), POINTS, ANGLES, ANGLES, ANGLES)
def test_points_that_were_moved_as_one_body_are_found_again(
    points: list[Vector], shift: Vector, x: float, y: float, z: float
) -> None:
    assume(not is_collinear(*points[:3]))
    assume(
        min(abs(a - b) for i, p in enumerate(points) for q in points[:i] for a, b in zip(p, q, strict=True))
        > 0.5
    )
    moved = translation(*shift) @ rotation(2, z) @ rotation(1, y) @ rotation(0, x)
    found = rigid_fit(points, [moved.apply(*p) for p in points])
    assert distances(found, points, [moved.apply(*p) for p in points]) == pytest.approx(
        [0.0] * len(points), abs=1e-5
    )


def test_the_fit_of_bent_points_is_a_rotation() -> None:
    ideal = [(10.0, 0.0, 0.0), (0.0, 10.0, 0.0), (0.0, 0.0, 10.0)]
    measured = [(10.1, 0.2, -0.2), (-0.2, 10.2, 0.1), (-0.2, 0.2, 9.8)]
    frame = rigid_fit(ideal, measured)
    for i in range(3):
        for j in range(3):
            product = sum(frame.m[i][k] * frame.m[j][k] for k in range(3))
            assert product == pytest.approx(float(i == j), abs=1e-12)
    assert sum(distances(frame, ideal, measured)) < 0.6


def test_points_on_a_line_are_told() -> None:
    assert is_collinear((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (3.0, 3.0, 3.0))
    assert is_collinear((1.0, 2.0, 3.0), (1.0, 2.0, 3.0), (0.0, 0.0, 1.0))
    assert not is_collinear((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
