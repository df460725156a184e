"""Stored stroke check: boxes that must not be entered, or not be left."""

from __future__ import annotations

import pytest

from tests.support import codes, run


@pytest.mark.parametrize(
    ("target", "refused"),
    [("X15. Y0", True), ("X30. Y0", True), ("X30. Y30.", False), ("X9.9 Y0", False), ("X0 Y40.", False)],
)
def test_a_forbidden_box_is_not_crossed(target: str, refused: bool) -> None:
    channel = run(f"G22 X20. Y5. Z5. I10. J-5. K-5.\nG0 {target}\nM30\n")
    assert bool(codes(channel)) == refused


def test_the_direction_of_a_zone_alarm_is_that_of_the_move() -> None:
    text = "G0 X30.\nG22 X20. Y5. Z5. I10. J-5. K-5.\nX15.\nM30\n"
    assert codes(run(text)) == ["OT0503"]


def test_a_box_that_must_not_be_left() -> None:
    channel = run("G22 X20. Y5. Z5. I-20. J-5. K-5.\nG0 X21.\nM30\n", setup={"parameters": {"1300#0": 1}})
    assert codes(channel) == ["OT0502"]
