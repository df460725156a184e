"""One row of a run by law: it ends in motion, at rest, or the axes rest within it."""

from __future__ import annotations

from math import inf

import pytest

from polycnc.mainrun.motion.law_motion import LawMotion
from tests.mainrun.support import execution_of, power_on

TEXT = "SOFT G642 G1 X20 F6000\nX40 Y2\nX60\nM30\n"


def motion_in(seconds: float) -> LawMotion:
    virtual = power_on(TEXT, "sinumerik-840d")
    virtual.cycle_start()
    virtual.step(seconds)
    motion = execution_of(virtual).motion
    assert isinstance(motion, LawMotion)
    return motion


def test_a_row_that_goes_on_ends_in_motion() -> None:
    motion = motion_in(0.1)
    assert motion.rest == inf
    assert motion.end2 > 0.0
    assert motion.machine(motion.end) == pytest.approx(motion.end_position)
    assert motion.done(motion.end + 1.0) == motion.done(motion.end)


def test_the_last_row_ends_at_rest_where_the_program_says() -> None:
    motion = motion_in(0.65)
    assert motion.end2 == 0.0
    assert motion.end_position == [60.0, 2.0, 0.0]
    assert motion.speed(motion.end) == 0.0


def test_axes_that_are_held_rest_within_it() -> None:
    motion = motion_in(0.1)
    assert motion._run.brake(0.1)
    motion.follow()
    assert motion.end == inf
    assert 0.1 < motion.rest < 0.3
    assert motion.speed(motion.rest) == 0.0
