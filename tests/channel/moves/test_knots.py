"""Moves cut at parts of their way."""

from __future__ import annotations

import pytest

from polycnc.channel.moves import knots
from polycnc.channel.moves.path import Move
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.modes import CornerMode, FeedMode
from tests.support import run


def test_pieces_go_on_from_each_other() -> None:
    channel = run("G90 G1 F100 X1")
    context = channel.toolpath.context_number(Context(corner_mode=CornerMode.EXACT_STOP))
    move = Move(Kind.FEED, [0.0, 0.0, 0.0], [10.0, 0.0, 0.0], 5.0, context=context)
    first, last = knots.cut(channel, move, (0.25, 1.0))
    assert first.end == pytest.approx([2.5, 0.0, 0.0])
    assert last.start is first.end
    assert last.end is move.end
    assert (last.context, channel.toolpath.contexts[first.context].knot) == (context, True)
    assert [channel.toolpath.contexts[each.context].stops for each in (first, last)] == [False, True]


def test_inverse_time_counts_the_piece() -> None:
    channel = run("G90 G1 F100 X1")
    context = channel.toolpath.context_number(Context(feed_mode=FeedMode.INVERSE_TIME))
    move = Move(Kind.FEED, [0.0, 0.0, 0.0], [10.0, 0.0, 0.0], 0.5, context=context)
    assert [piece.feed for piece in knots.cut(channel, move, (0.25, 1.0))] == pytest.approx([2.0, 0.5 / 0.75])


def test_threads_stay_whole() -> None:
    thread = Move(Kind.THREAD, [0.0], [1.0], parameters=(1.0, 0.0))
    assert not knots.is_divisible(thread)
