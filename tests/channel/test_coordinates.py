from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.channel.coordinates import Coordinates
from polycnc.geometry.frames import IDENTITY, Frame, rotation, translation
from polycnc.transformation.planes.feature import FeatureFrame

LENGTH = st.floats(-1000.0, 1000.0)


def coordinates(*machine: float) -> Coordinates:
    return Coordinates(("X", "Y", "Z"), (0, 1, 2), list(machine))


def test_new_offsets_leave_the_machine_where_it_is() -> None:
    c = coordinates(100.0, 50.0, 0.0)
    c.set_zero(IDENTITY, [20.0, 10.0, -5.0])
    assert c.machine == [100.0, 50.0, 0.0]
    assert c.position == [80.0, 40.0, 5.0]


def test_a_travelled_change_is_owed_to_increments() -> None:
    c = coordinates(0.0, 0.0, 50.0)
    c.set_zero(IDENTITY, [0.0, 0.0, 120.0], travelled=True)
    assert c.pending == [0.0, 0.0, 120.0]
    assert c.owes


def test_a_work_offset_is_not_owed() -> None:
    c = coordinates(0.0, 0.0, 50.0)
    c.set_zero(IDENTITY, [0.0, 0.0, 120.0])
    assert not c.owes


@given(LENGTH, LENGTH, LENGTH, st.floats(-360.0, 360.0))
def test_display_and_machine_are_inverse(x: float, y: float, z: float, angle: float) -> None:
    c = coordinates(0.0, 0.0, 0.0)
    c.set_zero(translation(7.0, -3.0, 2.0) @ rotation(2, angle), [1.0, 2.0, 3.0])
    assert c.from_machine(c.to_machine([x, y, z])) == pytest.approx([x, y, z], abs=1e-9)


@given(LENGTH, LENGTH, st.floats(-360.0, 360.0))
def test_programmed_and_display_are_inverse(x: float, y: float, angle: float) -> None:
    c = coordinates(x, y, 0.0)
    c.set_programming(rotation(2, angle))
    assert c.to_position(c.programmed) == pytest.approx(c.position, abs=1e-9)


def test_a_missing_geometry_axis_counts_as_zero() -> None:
    c = Coordinates(("X", "Z"), (0, -1, 1), [0.0, 0.0])
    c.set_zero(rotation(2, 90.0), [0.0, 0.0])
    assert c.to_machine([10.0, 4.0]) == pytest.approx([0.0, 4.0])


#: X and Y are named each other.
SWAPPED = FeatureFrame(Frame(((0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))), (1, 0, 2))


def test_axes_that_stand_for_others_leave_the_machine_where_it_is() -> None:
    c = coordinates(100.0, 50.0, 0.0)
    c.set_zero(IDENTITY, [20.0, 10.0, 0.0])
    c.transform(SWAPPED, SWAPPED.geometry)
    assert (c.position, c.programmed, c.geometry) == ([40.0, 80.0, 0.0], [40.0, 80.0, 0.0], (1, 0, 2))
    assert c.machine == [100.0, 50.0, 0.0]
    c.transform(None, (0, 1, 2))
    assert (c.position, c.geometry) == ([80.0, 40.0, 0.0], (0, 1, 2))


FAR = Frame(t=(0.0, 1e300, 0.0))
HUGE = Frame(((1e200, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))
NOWHERE = Frame(t=(float("nan"), 0.0, 0.0))


@pytest.mark.parametrize("frame", [FAR, HUGE, NOWHERE])
def test_a_frame_that_leads_beyond_all_machines_is_refused(frame: Frame) -> None:
    c = coordinates(1.0, 2.0, 3.0)
    with pytest.raises(OverflowError):
        c.set_zero(frame, [0.0, 0.0, 0.0])
    with pytest.raises(OverflowError):
        c.set_programming(frame)
    assert (c.position, c.programmed, c.machine) == ([1.0, 2.0, 3.0],) * 3


def test_shifts_that_lead_beyond_all_machines_are_refused() -> None:
    c = coordinates(1.0, 2.0, 3.0)
    with pytest.raises(OverflowError):
        c.set_zero(IDENTITY, [0.0, -1e13, 0.0])
    with pytest.raises(OverflowError):
        c.set_programming(IDENTITY, [0.0, 0.0, float("inf")])
    assert c.offsets == [0.0, 0.0, 0.0]
