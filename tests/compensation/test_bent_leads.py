"""KONTT and KONTC: the curve meets the parallel of the contour with its tangent, and with its curvature."""

from __future__ import annotations

from dataclasses import replace
from math import cos, hypot, radians, sin
from typing import TYPE_CHECKING

import pytest

from polycnc.compensation.bent_leads import CHORD_TOLERANCE_MM, course
from polycnc.compensation.policy import BENDS, Approach
from polycnc.compensation.step import Contact
from polycnc.toolpath import Kind
from tests.compensation import policies
from tests.compensation.support import run

if TYPE_CHECKING:
    from polycnc.geometry.frames import Vector

FREE, TOUCHING = (3.0, -7.0, 5.0), (40.0, 10.0, 0.0)
_ANGLES = [0.0, 30.0, 75.0, 120.0, 200.0, 310.0]


def _meeting(angle: float, curvature: float | None) -> Contact:
    along = (cos(radians(angle)), sin(radians(angle)), 0.0)
    across = None if curvature is None else (-along[1] * curvature, along[0] * curvature, 0.0)
    return Contact(along, across)


def _circle(a: Vector, b: Vector, c: Vector) -> float:
    """Curvature of the circle through three points of a plane, left positive."""
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    sides = [hypot(q[0] - p[0], q[1] - p[1]) for p, q in ((a, b), (b, c), (c, a))]
    return 2.0 * area / (sides[0] * sides[1] * sides[2])


@pytest.mark.parametrize("curvature", [None, 0.0, 0.05, -0.02])
@pytest.mark.parametrize("angle", _ANGLES)
def test_the_curve_begins_along_the_tangent_and_ends_at_the_free_point(
    angle: float, curvature: float | None
) -> None:
    at = _meeting(angle, curvature)
    points = [TOUCHING, *(point for _, point in course(FREE, TOUCHING, at))]
    way = [b - a for a, b in zip(points[0], points[1], strict=True)]
    along = sum(a * b for a, b in zip(way, at.outwards, strict=True)) / hypot(*way)
    assert along > 0.999
    assert points[-1] == FREE


@pytest.mark.parametrize("curvature", [0.0, 0.05, -0.02])
@pytest.mark.parametrize("angle", _ANGLES)
def test_with_a_curvature_the_curve_begins_on_that_circle(angle: float, curvature: float) -> None:
    flat = (FREE[0], FREE[1], 0.0)
    points = [TOUCHING, *(point for _, point in course(flat, TOUCHING, _meeting(angle, curvature)))]
    assert _circle(*points[:3]) == pytest.approx(curvature, abs=0.01)


def test_chords_keep_within_their_tolerance() -> None:
    points = [TOUCHING, *(point for _, point in course(FREE, TOUCHING, _meeting(200.0, 0.05)))]
    for a, b, c in zip(points, points[1:], points[2:], strict=False):
        # The middle one of three points is twice as far off the chord of two parts as half a chord is.
        away = hypot(*(y - 0.5 * (x + z) for x, y, z in zip(a, b, c, strict=True)))
        assert away <= 4.0 * CHORD_TOLERANCE_MM * 1.001


@pytest.mark.parametrize("rule", BENDS)
def test_approach_and_retraction_mirror_each_other(rule: Approach) -> None:
    policy = replace(policies.SINUMERIK_KONT_G450, approach=rule)
    there = run(policy, "G1 G41 X20 Y-30\nX60\nG40 X80 Y0", start=(0.0, 0.0, 0.0))
    bends = [move for move in there.moves if move.kind is Kind.SPLINE]
    firsts, lasts = ([m for m in bends if m.line == line] for line in (1, 3))
    assert firsts[-1].end[:2] == [20.0, -25.0]
    assert lasts[0].start[:2] == [60.0, -25.0]
    (before, touching), (leaving, behind) = (
        (firsts[-1].start, firsts[-1].end),
        (lasts[0].start, lasts[0].end),
    )
    assert touching[1] - before[1] == pytest.approx(0.0, abs=0.01)
    assert behind[1] - leaving[1] == pytest.approx(0.0, abs=0.01)
    assert touching[0] > before[0]
    assert behind[0] > leaving[0]
