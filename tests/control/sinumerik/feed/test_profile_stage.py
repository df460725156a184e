"""Moves whose feed takes a course: one motion for the trace, slices for the planner."""

from __future__ import annotations

from itertools import pairwise

import pytest

from polycnc.motion import plan
from tests.support import moves, run


def test_slices_are_knots_and_make_up_the_block() -> None:
    channel = run("G64 G1 F6000 X100\nFLIN F12000 X400\nM30\n", "sinumerik-840d")
    rows = moves(channel)
    assert [row.line for row in rows if not row.context.knot] == [1, 2]
    feeds = [row.feed for row in rows]
    assert all(a <= b for a, b in pairwise(feeds))
    assert feeds[-1] == pytest.approx(200.0)
    assert rows[-1].end[0] == pytest.approx(400.0)
    assert plan(channel.toolpath, channel.machine).total_s == pytest.approx(3.13, abs=0.02)


def test_many_blocks_of_fcub_are_not_held_for_ever() -> None:
    blocks = "".join(f"X{10 * k} F{1000 + 7 * k}\n" for k in range(1, 201))
    channel = run(f"G64 G1 F1000 FCUB\n{blocks}M30\n", "sinumerik-840d")
    shown = [row for row in moves(channel) if not row.context.knot]
    assert [row.end[0] for row in shown] == pytest.approx([10.0 * k for k in range(1, 201)])
    assert [row.feed * 60.0 for row in shown] == pytest.approx([1000.0 + 7 * k for k in range(1, 201)])
