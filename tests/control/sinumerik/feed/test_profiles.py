"""Courses of the feed over a block."""

from __future__ import annotations

from math import log, nan

import pytest

from polycnc.control.sinumerik.feed.profiles import Course, Profile, course_of, spline
from polycnc.control.sinumerik.tables import CUBIC, LINEAR, POLYNOMIAL


def test_polynomial_of_the_manual() -> None:
    course = course_of(Profile(POLYNOMIAL, 2000.0, 4000.0, (6000.0, -4000.0)))
    assert course == Course(2000.0, 0.0, 6000.0, -4000.0)
    assert course.at(0.5) == pytest.approx(3000.0)


def test_slices_take_as_long_as_the_course() -> None:
    course = course_of(Profile(LINEAR, 100.0, 300.0))
    ends = course.slices()
    seconds = sum((b - a) / course.mean(a, b) for a, b in zip([0.0, *ends], ends, strict=False))
    assert seconds == pytest.approx(log(3.0) / 200.0, rel=1e-9)
    assert ends[-1] == 1.0
    assert course.slices(most=3)[-1] == 1.0
    assert len(course.slices(most=3)) == 4


def test_without_a_feed_before_it_is_constant() -> None:
    assert course_of(Profile(LINEAR, nan, 50.0)).slices() == [1.0]


def test_a_course_never_ends_before_the_way() -> None:
    assert Course(100.0, -100.0).at(1.0) == pytest.approx(1.0)


def test_spline_is_smooth_and_goes_through_its_points() -> None:
    feeds, lengths = [60.0, 90.0, 120.0, 80.0], [100.0, 50.0, 200.0]
    courses = spline(feeds, lengths, 0.1, 0.0)
    assert courses[0].slope(0.0) / lengths[0] == pytest.approx(0.1)
    assert courses[-1].slope(1.0) == pytest.approx(0.0)
    for k, (course, length) in enumerate(zip(courses, lengths, strict=True)):
        assert (course.at(0.0), course.at(1.0)) == pytest.approx((feeds[k], feeds[k + 1]))
        if k:
            before = courses[k - 1]
            assert before.slope(1.0) / lengths[k - 1] == pytest.approx(course.slope(0.0) / length)
            bends = (2.0 * before.c + 6.0 * before.d) / lengths[k - 1] ** 2, 2.0 * course.c / length**2
            assert bends[0] == pytest.approx(bends[1])
    assert course_of(Profile(CUBIC, 1.0, 2.0)) == Course(2.0)
