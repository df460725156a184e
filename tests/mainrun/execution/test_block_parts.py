"""Blocks of the main run: those of the program, and the intermediate ones."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.mainrun.execution.block_parts import direction
from polycnc.mainrun.motion.geometry import Line
from tests.examples import examples
from tests.mainrun.support import power_on

if TYPE_CHECKING:
    from collections.abc import Sequence

COUNTS = (
    "ID=1 WHENEVER ($AC_TIMEC==0) AND ($AC_BLOCKTYPE==5) DO $AC_MARKER[1]=$AC_MARKER[1]+1\n"
    "ID=2 WHENEVER $AC_TIMEC==0 DO $AC_MARKER[2]=$AC_MARKER[2]+1\n"
)


def counted(ways: Sequence[tuple[float, float]], feed: float, codes: str) -> tuple[int, int]:
    """Roundings and blocks that a path of lines has, as actions see them."""
    lines = "".join(f"X=IC({x}) Y=IC({y})\n" for x, y in ways)
    text = f"G1 F{feed} X0 Y0\n{COUNTS}{codes}\n{lines}STOPRE\nR1=$AC_MARKER[1] R2=$AC_MARKER[2]\nM30\n"
    virtual = power_on(text, "sinumerik-840d")
    virtual.cycle_start()
    virtual.run(limit_s=10_000.0)
    assert not virtual.alarms
    found = virtual.read_variable("R1"), virtual.read_variable("R2")
    assert isinstance(found[0], float)
    assert isinstance(found[1], float)
    return int(found[0]), int(found[1])


@pytest.mark.parametrize("soft", ["BRISK", "SOFT"])
@settings(max_examples=examples(6), deadline=None)
@given(
    ways=st.lists(st.sampled_from([(10, 0), (0, 10), (7, 3), (3, -8)]), min_size=1, max_size=6),
    feed=st.sampled_from([500, 3000, 12000]),
)
def test_every_corner_that_is_passed_has_one_rounding(
    ways: list[tuple[int, int]], feed: int, soft: str
) -> None:
    corners = sum(a != b for a, b in pairwise(ways))
    # The block of G641 is one, too.
    assert counted(ways, feed, f"G641 ADIS=1 {soft}") == (corners, 1 + len(ways) + corners)
    assert counted(ways, feed, f"G60 {soft}") == (0, len(ways))


def test_an_override_of_zero_makes_no_further_block() -> None:
    text = f"G1 F3000 X0 Y0\n{COUNTS}G641 ADIS=1\nX20\nY20\nX40\nSTOPRE\nR1=$AC_MARKER[1] R2=$AC_MARKER[2]\nM30\n"
    virtual = power_on(text, "sinumerik-840d")
    virtual.cycle_start()
    virtual.step(0.2)
    virtual.override(feed=0.0)
    virtual.step(1.0)
    virtual.override(feed=1.0)
    virtual.run(limit_s=100.0)
    assert (virtual.read_variable("R1"), virtual.read_variable("R2")) == (2.0, 6.0)


def test_directions_at_both_ends_of_a_line() -> None:
    way = Line((0.0, 0.0, 5.0), (3.0, 4.0, 5.0))
    assert direction(way, 0.0, (0, 1)) == pytest.approx([0.6, 0.8])
    assert direction(way, 1.0, (0, 1, 2)) == pytest.approx([0.6, 0.8, 0.0])
    assert direction(way, 1.0, (2,)) == [0.0]
