"""Which axes are X, Y and Z of the plane (manual 2.17)."""

from __future__ import annotations

import pytest

from polycnc.control.syntec.motion.planes import geometry_axes, same_plane
from tests.support import run

XY, ZX, YZ = (0, 1), (2, 0), (1, 2)
NAMES = ("X", "Y", "Z2", "Z1", "Z3")
BASIC = (0, 1, 3)


@pytest.mark.parametrize(
    ("named", "plane", "chosen"),
    [
        ((), XY, BASIC),
        ((0, 1), XY, BASIC),
        ((1, 2, 3), XY, (3, 1, 2)),  # the manual's first example
        ((2, 3), ZX, (3, 1, 2)),  # and its second
        ((4,), YZ, (0, 1, 4)),
        ((2, 3, 4), XY, (3, 4, 2)),
    ],
)
def test_axes_named_with_the_plane_are_its_axes(
    named: tuple[int, ...], plane: tuple[int, int], chosen: tuple[int, int, int]
) -> None:
    assert geometry_axes(NAMES, named, plane, BASIC) == chosen


def test_a_rotary_axis_named_with_the_plane_takes_what_the_plane_still_needs() -> None:
    assert geometry_axes(("X", "Y", "Z", "A"), (0, 3), XY, (0, 1, 2)) == (0, 3, 2)


def test_a_direction_without_an_axis_takes_what_is_left() -> None:
    assert geometry_axes(("X", "U", "Z"), (1,), XY, (0, 1, 2)) == (1, 0, 2)


@pytest.mark.parametrize(("machine", "settled"), [("mill3", True), ("mill4", False)])
def test_a_plane_written_again_changes_nothing_only_where_every_axis_has_its_place(
    machine: str, settled: bool
) -> None:
    assert same_plane(run("G1 X1. F100\nM30\n", "syntec-mill", machine=machine)) is settled
