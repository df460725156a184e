"""Moves cut at parts of their way, where axes beside the path or the feed change their course within one motion."""

from __future__ import annotations

from dataclasses import replace
from math import hypot
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


def passing_context(channel: Channel, context: int) -> int:
    """The context of rows that another one of their block follows, where displays show each of them."""
    toolpath = channel.toolpath
    held = toolpath.contexts[context]
    if held.corner_mode is not CornerMode.EXACT_STOP:
        return context
    return toolpath.context_number(replace(held, corner_mode=CornerMode.CONTINUOUS))


def join(channel: Channel, pieces: Sequence[Move]) -> None:
    """Pieces become one motion: nothing rests within it, and it takes the time of the whole."""
    for piece in pieces[:-1]:
        piece.context = knot_context(channel, piece.context)
    share_time(channel, pieces)


def share_time(channel: Channel, pieces: Sequence[Move]) -> None:
    """Pieces that make up a move of inverse time take their part of it each; displays show the feed of the whole."""
    toolpath = channel.toolpath
    held = toolpath.contexts[pieces[-1].context]
    if held.feed_mode is not FeedMode.INVERSE_TIME or len(pieces) < 2:
        return
    columns = [column for column in channel.coordinates.geometry if column >= 0]
    ways = [hypot(*(piece.end[i] - piece.start[i] for i in columns)) for piece in pieces]
    whole = sum(ways)
    for piece, way in zip(pieces, ways, strict=True):
        if way > 0.0:
            piece.feed *= whole / way
    if ways[-1] > 0.0:
        share = held.share * ways[-1] / whole
        pieces[-1].context = toolpath.context_number(replace(held, share=share))


def knot_context(channel: Channel, context: int) -> int:
    """The context of pieces within a motion: nothing rests or rounds a corner at their ends."""
    toolpath = channel.toolpath
    held = toolpath.contexts[context]
    mode = CornerMode.CONTINUOUS if held.corner_mode is CornerMode.EXACT_STOP else held.corner_mode
    return toolpath.context_number(replace(held, corner_mode=mode, knot=True))
