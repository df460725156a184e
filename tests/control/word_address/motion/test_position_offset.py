"""Moves lengthened by an offset, and positioning from one direction."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.support import ends, moves, run


@given(st.integers(-50, 50).filter(bool), st.integers(1, 9))
def test_a_lengthened_move_is_undone_by_a_shortened_one(way: int, radius: int) -> None:
    setup = {"tools": {1: {"radius": radius}}}
    there = run(f"G91 G0 G45 X{way}. D1\nG45 X{-way}. D1\nM30\n", setup=setup)
    assert there.coordinates.position[0] == pytest.approx(0.0)
    longer = run(f"G91 G0 G45 X{way}. D1\nM30\n", setup=setup).coordinates.position[0]
    shorter = run(f"G91 G0 G46 X{way}. D1\nM30\n", setup=setup).coordinates.position[0]
    assert longer + shorter == pytest.approx(2.0 * way)
    assert abs(longer) - abs(way) == pytest.approx(radius)


def test_a_double_offset_counts_twice() -> None:
    setup = {"tools": {1: {"radius": 3}}}
    assert ends(run("G91 G0 G47 Y10. D1\nG48 Y10.\nM30\n", setup=setup)) == [(0, 16, 0), (0, 20, 0)]


@pytest.mark.parametrize("ending", ["X1. Y0", "X3. Y0"])
def test_one_way_positioning_always_ends_in_the_same_direction(ending: str) -> None:
    setup = {"parameters": {"5440 X": 0.5}}
    last = moves(run(f"G0 X2.\nG60 {ending}\nM30\n", setup=setup))[-2:]
    assert last[1].end[0] - last[0].end[0] == pytest.approx(0.5)
