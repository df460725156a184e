"""The way along chords, and rotary axes that turn along them."""

from __future__ import annotations

from math import cos, pi, sin

import pytest

from polycnc.channel.moves.chord_path import ChordPath
from polycnc.transformation.orientation.turning import Course, Turning

GEOMETRY = (0, 1, 2)


def quarter(count: int = 90) -> ChordPath:
    """A quarter of a circle of radius 10 about the origin, with a rotary axis in the fourth column."""
    angles = [0.5 * pi * k / count for k in range(count + 1)]
    points = [[10.0 * cos(a), 10.0 * sin(a), 0.0, 0.0] for a in angles]
    chords = [(k / count, point) for k, point in enumerate(points) if k]
    return ChordPath(points[0], chords, lambda u: (-sin(0.5 * pi * u), cos(0.5 * pi * u), 0.0), GEOMETRY)


def test_points_and_directions_are_those_of_the_curve() -> None:
    path = quarter()
    assert path.at(0.0) == [10.0, 0.0, 0.0, 0.0]
    assert path.at(0.5) == pytest.approx([50**0.5, 50**0.5, 0.0, 0.0])
    assert path.at(1.0) == pytest.approx([0.0, 10.0, 0.0, 0.0], abs=1e-9)
    assert path.at(0.505) == pytest.approx(
        [10 * cos(0.2525 * 2 * pi / 2), 10 * sin(0.2525 * pi), 0, 0], abs=1e-3
    )
    assert path.direction(0.5) == pytest.approx((-(0.5**0.5), 0.5**0.5, 0.0))
    assert path.length == pytest.approx(5.0 * pi, abs=1e-3)


def test_knots_of_a_turn_end_chords_as_well() -> None:
    ends = list(quarter(2).turned(Turning((3,), (0.25, 1.0), ((10.0,), (40.0,)))))
    assert [end[3] for end in ends] == pytest.approx([10.0, 20.0, 40.0])
    assert ends[1][:3] == pytest.approx([50**0.5, 50**0.5, 0.0])
    assert ends[-1][:3] == pytest.approx([0.0, 10.0, 0.0], abs=1e-9)


def test_a_turn_with_a_course_ends_early() -> None:
    path = quarter()
    course = Course(30.0, 2.0 * 30.0 / path.length, both_ends=False)
    ends = list(path.turned(Turning((3,), (1.0,), ((30.0,),), course)))
    assert ends[len(ends) // 2 - 1][3] == pytest.approx(30.0)
    assert ends[len(ends) // 4][3] == pytest.approx(15.0, abs=0.7)
