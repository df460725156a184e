"""What frames make of circles."""

from __future__ import annotations

import pytest

from polycnc.geometry.arcs import circle_image, is_even
from polycnc.geometry.frames import IDENTITY, Frame, rotation, scaling, translation

UP = (0.0, 0.0, 1.0)


@pytest.mark.parametrize(
    "frame",
    [
        IDENTITY,
        translation(1.0, 2.0, 3.0),
        rotation(0, 33.0),
        scaling(2.0, 2.0, 2.0),
        scaling(-1.0, 1.0, 1.0),
    ],
)
def test_turns_shifts_mirrors_and_even_scales_leave_circles(frame: Frame) -> None:
    assert is_even(frame)


def test_factors_that_differ_bend_the_circles_of_their_planes_alone() -> None:
    tall = scaling(1.0, 1.0, 3.0)
    assert circle_image(tall, UP) == pytest.approx(UP)
    assert circle_image(tall, (1.0, 0.0, 0.0)) is None
    assert not is_even(tall)


def test_the_image_of_a_circle_has_the_turned_normal() -> None:
    assert circle_image(rotation(0, 90.0), UP) == pytest.approx((0.0, -1.0, 0.0))


def test_a_turn_of_what_was_stretched_is_still_an_ellipse() -> None:
    assert circle_image(rotation(2, 30.0) @ scaling(1.0, 2.0, 1.0), UP) is None
    assert circle_image(scaling(1.0, 2.0, 1.0) @ rotation(2, 45.0), UP) is None
