"""A transformation between frames and tool."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.geometry.frames import rotation, translation
from polycnc.transformation.kinematic.polar import PolarPlane
from polycnc.transformation.seated import Seated

XYZ = (0, 1, 2)
POLAR = PolarPlane(0, 3, (0, 1, 2), virtual=1)


@given(st.floats(-180.0, 180.0), st.floats(-50.0, 50.0), st.floats(-50.0, 50.0))
def test_the_pole_lies_where_the_frame_sees_the_centre(turn: float, x: float, y: float) -> None:
    seated = Seated(POLAR, translation(x, y, 3.0) @ rotation(2, turn), (), (7.0, 0.0, 0.0, 0.0))
    pole = seated.pole
    assert pole is not None
    place = [*pole.place, 0.0, 0.0]
    assert seated.basic(place)[:2] == pytest.approx([0.0, 0.0], abs=1e-9)
    assert seated.to_machine(pole.beside(place, 1.0, 5.0))[0] == pytest.approx(12.0)


def test_a_frame_that_tilts_the_plane_leaves_no_pole_at_one_place() -> None:
    assert Seated(POLAR, rotation(0, 30.0)).pole is None


def test_lengths_of_the_tool_count_behind() -> None:
    seated = Seated(POLAR, translation(10.0, 0.0, 0.0), (), (2.0, 0.0, 4.0, 0.0))
    assert seated.to_machine([0.0, 0.0, 1.0, 0.0]) == [12.0, 0.0, 5.0, 0.0]
