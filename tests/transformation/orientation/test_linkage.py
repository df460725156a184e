"""Derivatives of the axes behind a tip are those of their positions."""

from __future__ import annotations

from array import array

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.geometry.frames import rotation, translation
from polycnc.transformation.kinematic.polar import PolarPlane
from polycnc.transformation.orientation.linkage import Block, Room, ask, derive, room_for, set_turns
from polycnc.transformation.orientation.linked import linkage_of
from polycnc.transformation.seated import Seated
from tests.motion.five_axes import machines

N = 5
NUMBERS = st.lists(st.floats(-90.0, 90.0), min_size=N, max_size=N)
WAYS = st.lists(st.floats(-1.0, 1.0), min_size=N, max_size=N)


@pytest.mark.parametrize("name", machines())
@pytest.mark.parametrize("seated", [False, True])
@settings(max_examples=25, deadline=None)
@given(NUMBERS, WAYS)
def test_derivatives_are_those_of_the_positions(
    name: str, seated: bool, start: list[float], unit: list[float]
) -> None:
    tip = machines()[name].tip
    turned = rotation(2, 20.0) @ rotation(1, 33.0) @ translation(1.0, 2.0, 3.0)
    led = Seated(tip, turned, (1.0, -2.0, 3.0, 4.0, -5.0), (0.5,) * N) if seated else tip
    linkage, room, ways = linkage_of(led), array("d", bytes(8 * room_for(N))), array("d", unit)
    room[Room.BLOCKS : Room.BLOCKS + N] = array("d", start)
    set_turns(linkage, N, room, ways, 2.0)
    derive(linkage, N, room, ways, 2.0)
    pulls, jolts = array("d", [1.0, 2.0, 3.0, 4.0, 5.0]), array("d", [5.0, 4.0, 3.0, 2.0, 1.0])
    ask(linkage, N, room, ways, 2.0, pulls, jolts)
    blocks = np.array(room[Room.BLOCKS :]).reshape(Block.SIZE, N)

    def place(late: float) -> np.ndarray:
        return np.array(led.to_machine([a + b * (2.0 + late) for a, b in zip(start, unit, strict=True)]))

    def slopes(late: float) -> np.ndarray:
        point = [a + b * (2.0 + late) for a, b in zip(start, unit, strict=True)]
        return np.array(led.jacobian(point)) * [value != 0.0 or i < 3 for i, value in enumerate(unit)]

    step, wide = 0.01, 0.3
    first = (place(step) - place(-step)) / (2.0 * step)
    second = (place(step) - 2.0 * place(0.0) + place(-step)) / step**2
    third = (place(2.0 * wide) - 2.0 * place(wide) + 2.0 * place(-wide) - place(-2.0 * wide)) / (
        2.0 * wide**3
    )
    changes = np.abs(slopes(step) - slopes(-step)) / (2.0 * step) @ pulls
    assert np.abs(blocks[Block.FIRST] - first).max() < 1e-5
    assert np.abs(blocks[Block.SECOND] - second).max() < 1e-5
    assert np.abs(blocks[Block.THIRD] - third).max() < 1e-4
    assert np.abs(blocks[Block.PULLS] - np.abs(slopes(0.0)) @ pulls).max() < 1e-9
    assert np.abs(blocks[Block.JOLTS] - np.abs(slopes(0.0)) @ jolts).max() < 1e-9
    assert np.abs(blocks[Block.CHANGES] - changes).max() < 1e-5


def test_others_have_no_linkage() -> None:
    assert len(linkage_of(None)) == 0
    assert len(linkage_of(PolarPlane(0, 2, (0, 2, 1)))) == 0
