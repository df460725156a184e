"""Floors beside walls: the lowest point of a mill touches the floor that its program was made for."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, hypot, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.compensation.spatial.limiting_surface import Mill, across, infeed
from polycnc.geometry.frames import Vector
from polycnc.geometry.vectors import cross, dot
from polycnc.machine.kinematics import unit

component = st.floats(-1.0, 1.0)
vectors = st.tuples(component, component, component).filter(lambda v: hypot(*v) > 0.1)
mills = (
    st.floats(0.5, 20.0).flatmap(lambda r: st.tuples(st.just(r), st.floats(0.0, r))).map(lambda m: Mill(*m))
)


def lowest(mill: Mill, tip: Sequence[float], tool: Vector, floor: Vector) -> float:
    """Least height over a floor of the circle in which the corner has its centre, less the corner."""
    u = unit(cross(tool, (0.3, -0.5, 0.7)))
    v = cross(tool, u)
    heights = []
    for k in range(3600):
        c, s = (
            (mill.radius - mill.corner) * cos(k * pi / 1800),
            (mill.radius - mill.corner) * sin(k * pi / 1800),
        )
        point = [t + mill.corner * d + c * a + s * b for t, d, a, b in zip(tip, tool, u, v, strict=True)]
        heights.append(dot(floor, point))
    return min(heights) - mill.corner


@given(mills, mills, vectors, vectors, vectors)
def test_both_mills_touch_the_same_floor(
    standard: Mill, actual: Mill, tool: Vector, path: Vector, floor: Vector
) -> None:
    tool, floor = unit(tool), unit(floor)
    wall = cross(tool, path)
    if dot(tool, floor) < 0.1 or hypot(*wall) < 0.1:
        return
    wall, moved = unit(wall), actual.radius - standard.radius
    along = infeed(standard, actual, moved, wall, tool, floor)
    tip = [moved * m + along * v for m, v in zip(wall, tool, strict=True)]
    expected = lowest(standard, (0.0, 0.0, 0.0), tool, floor)
    assert lowest(actual, tip, tool, floor) == pytest.approx(expected, abs=1e-4)


def test_a_cylinder_stays_at_an_obtuse_angle() -> None:
    wall, tool = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    assert infeed(Mill(5.0), Mill(4.0), -1.0, wall, tool, unit((0.0, 1.0, 1.0))) == pytest.approx(0.0)
    assert infeed(Mill(5.0), Mill(4.0), -1.0, wall, tool, unit((0.0, -1.0, 1.0))) == pytest.approx(-2.0)


def test_a_floor_along_the_tool_limits_nothing() -> None:
    assert infeed(Mill(5.0), Mill(4.0), -1.0, (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 1.0, 0.0)) == 0.0


def test_a_floor_counts_across_the_path() -> None:
    assert across(unit((1.0, 0.0, 1.0)), (1.0, 0.0, 0.0)) == pytest.approx((0.0, 0.0, 1.0))
    assert across((1.0, 0.0, 0.0), (1.0, 0.0, 0.0)) is None
