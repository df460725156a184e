"""A block in which the tool turns on a great circle: rotary axes change their pace smoothly, with limited jerk too."""

from __future__ import annotations

import pytest

from polycnc.session import open_session

TEXT = """G90 G94 {mode}
T1 D1 TRAORI ORIVECT
G1 X0 Y0 Z0 A3=-0.3 B3=0.2 C3=1 F3000
{block}
TRAFOOF
M30
"""
BLOCKS = {
    "line": "G1 X40 Y0 A3=0.5 B3=0.3 C3=1 F1500",
    "arc": "G3 X40 Y0 CR=25 A3=0.5 B3=0.3 C3=1 F1500",
}
#: Times over that under BRISK; 2.1 and 2.3 where the axes rest at every knot.
LONGER = 1.55


def seconds_of(block: str, mode: str) -> float:
    text = TEXT.format(mode=mode, block=BLOCKS[block]).encode()
    tool = {"tools": {1: {"length": 50.0}}}
    result = open_session(text, control="sinumerik-840d", machine="mill5-ca-head", setup=tool).run()
    return float(result.plan.total_s)


@pytest.mark.parametrize("block", BLOCKS)
def test_the_axes_do_not_rest_where_rows_of_a_block_meet(block: str) -> None:
    assert seconds_of(block, "SOFT G642") < LONGER * seconds_of(block, "BRISK G642")


@pytest.mark.parametrize("block", BLOCKS)
def test_a_tolerance_changes_little_where_no_corner_is(block: str) -> None:
    assert seconds_of(block, "BRISK G64") < 1.01 * seconds_of(block, "BRISK G642")
