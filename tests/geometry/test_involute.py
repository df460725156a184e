from __future__ import annotations

from itertools import pairwise
from math import atan2, cos, degrees, hypot, pi, radians, sin, sqrt

import pytest

from polycnc.geometry import involute
from polycnc.geometry.involute import Involute


@pytest.mark.parametrize("ccw", [True, False])
@pytest.mark.parametrize(("first", "last"), [(0.0, 2.0), (0.5, 7.0), (3.0, 1.0), (4.0, 0.0)])
def test_points_are_those_of_an_unwound_thread(first: float, last: float, ccw: bool) -> None:
    curve = Involute((3.0, -2.0), 5.0, 0.7, first, last, ccw)
    side = 1.0 if (last > first) is ccw else -1.0
    root = 0.7 - side * involute.unwound(first)
    for k in range(9):
        roll = first + (last - first) * k / 8
        angle = root + side * roll
        u = 3.0 + 5.0 * (cos(angle) + side * roll * sin(angle))
        v = -2.0 + 5.0 * (sin(angle) - side * roll * cos(angle))
        assert curve.at(roll) == pytest.approx((u, v))
        assert curve.direction(roll) == pytest.approx((cos(angle), sin(angle)))


def test_end_point_and_angle_mean_the_same_curve() -> None:
    by_angle = involute.by_angle((10.0, 0.0), (0.0, 0.0), 5.0, radians(405), ccw=True)
    assert degrees(atan2(by_angle.end[1], by_angle.end[0])) == pytest.approx(45.0)
    to_point = involute.to_point((10.0, 0.0), by_angle.end, (0.0, 0.0), 5.0, ccw=True)
    assert to_point.last == pytest.approx(by_angle.last)
    assert to_point.sweep == pytest.approx(radians(405))


def test_chords_keep_within_the_error_and_share_the_length() -> None:
    curve = Involute((0.0, 0.0), 5.0, 0.0, 0.0, 6.0, ccw=True)
    chords = curve.chords(0.001)
    assert chords[-1] == (curve.end, 1.0)
    points = [curve.at(0.0), *(point for point, _ in chords)]
    length = sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(points))
    assert length == pytest.approx(5.0 * 36.0 / 2.0, rel=1e-3)


def test_what_is_inside_the_base_circle_is_refused() -> None:
    with pytest.raises(ValueError, match="inside"):
        involute.by_angle((4.0, 0.0), (0.0, 0.0), 5.0, pi, ccw=True)
    with pytest.raises(ValueError, match="beyond"):
        involute.by_angle((5.0 * sqrt(2.0), 0.0), (0.0, 0.0), 5.0, -pi, ccw=True)
