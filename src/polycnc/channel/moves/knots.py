"""Moves cut at parts of their way, where axes beside the path or the feed change their course within one motion."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from polycnc.channel.moves.move_path import MovePath
from polycnc.toolpath.kinds import ARC_KINDS, Kind
from polycnc.toolpath.modes import CornerMode, FeedMode

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.moves.path import Move

#: Kinds of moves that pieces can make up; a thread or a rapid stays whole.
DIVISIBLE = frozenset((Kind.FEED, *ARC_KINDS))


def is_divisible(move: Move) -> bool:
    """Whether a move can be cut: its rotary axes have no course of their own."""
    return move.kind in DIVISIBLE and move.turning is None


def cut(channel: Channel, move: Move, parts: Sequence[float]) -> list[Move]:
    """The pieces of a divisible move that end at parts of its way, of which the last is 1.

    The last piece ends with the very list of the move, in its context; the others end at knots.
    """
    if len(parts) == 1:
        return [move]
    path = MovePath(move, channel.coordinates.geometry)
    within = knot_context(channel, move.context)
    timed = channel.toolpath.contexts[move.context].feed_mode is FeedMode.INVERSE_TIME
    pieces: list[Move] = []
    before = 0.0
    for part in parts:
        piece = path.between(before, part)
        if timed:
            piece.feed = move.feed / (part - before)
        piece.context = within
        if pieces:
            piece.start = pieces[-1].end
        pieces.append(piece)
        before = part
    pieces[-1].context, pieces[-1].end = move.context, move.end
    if timed:
        toolpath, share = channel.toolpath, parts[-1] - parts[-2]
        held = toolpath.contexts[move.context]
        pieces[-1].context = toolpath.context_number(replace(held, share=held.share * share))
    return pieces


def knot_context(channel: Channel, context: int) -> int:
    """The context of pieces within a motion: nothing rests or rounds a corner at their ends."""
    toolpath = channel.toolpath
    held = toolpath.contexts[context]
    mode = CornerMode.CONTINUOUS if held.corner_mode is CornerMode.EXACT_STOP else held.corner_mode
    return toolpath.context_number(replace(held, corner_mode=mode, knot=True))
