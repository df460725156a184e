"""A workpiece beside its place: where a point of it lies, whatever the table has turned."""

from __future__ import annotations

import pytest
from hypothesis import given

from polycnc.geometry.frames import Frame, rotation, translation
from polycnc.transformation.planes.misplaced import Misplaced
from tests.transformation.kinds import angles, frames, offsets

Point = tuple[float, float, float]


@given(frames, angles, angles, offsets, offsets)
def test_a_point_of_the_work_goes_with_the_table(
    error: Frame, measured: float, now: float, zero: Point, point: Point
) -> None:
    before, after = rotation(2, measured), rotation(0, now) @ rotation(2, 20.0)
    lies = Misplaced(((error, before),), after)
    # Where the work was measured its error is what was measured.
    assert Misplaced(((error, before),), before).seen(zero).apply(*point) == pytest.approx(
        error.apply(*point), abs=1e-9
    )
    # A point that the program has at `ideal` of the turned table lies where the table has taken the true one.
    shift = translation(*zero)
    ideal = shift.inverse().apply(*after.apply(*shift.apply(*point)))
    true = after.apply(*shift.apply(*lies.on_table(zero).apply(*point)))
    assert shift.apply(*lies.seen(zero).apply(*ideal)) == pytest.approx(true, abs=1e-9)
