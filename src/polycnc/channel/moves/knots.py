"""One motion that becomes several rows: a curve as chords, a move cut where axes beside it or the feed change course.

Whatever makes rows of one block asks here. Nothing rests between them, under inverse time they last as long as the
motion, and the main run counts them as one block.
"""

from __future__ import annotations

from itertools import pairwise
from math import dist, hypot

from polycnc.channel.moves.move_path import MovePath
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.kinds import ARC_KINDS, Kind
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.moves.path import Move
    from polycnc.toolpath.context import Context

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


def write_chords(
    channel: Channel,
    points: Iterable[list[float]],
    feed: float,
    put: Callable[[list[float], float], object],
) -> None:
    """Write one motion as chords to some points (positions of all axes), which displays show.

    Args:
        channel: The channel that moves.
        points: Ends of the chords, the last one that of the motion.
        feed: Of the motion, in internal units.
        put: Writes a chord to its end with its feed.
    """
    ends, held = list(points), channel.context
    shares = [1.0] * len(ends)
    if held.feed_mode is FeedMode.INVERSE_TIME:
        shares = _parts(channel, list(pairwise((channel.coordinates.position, *ends))))
    for end, share in zip(ends[:-1], shares, strict=False):
        with channel.under(passing(held, share)):
            put(end, feed / share)
    for end, share in zip(ends[-1:], shares[-1:], strict=True):
        with channel.under(replace(held, share=held.share * share)):
            put(end, feed / share)


def join(channel: Channel, pieces: Sequence[Move], *, shows: bool = False, counted: float = 1.0) -> None:
    """Pieces that make up a move, each with its feed and context, become one motion.

    Args:
        channel: The channel that moves.
        pieces: The pieces.
        shows: Displays show every piece.
        counted: Of the chords of an arc its radius over its length: inverse time may count that.
    """
    toolpath = channel.toolpath
    for piece in pieces[:-1]:
        within = passing(toolpath.contexts[piece.context], shows=shows)
        piece.context = toolpath.context_number(within)
    share_time(channel, pieces, counted)


def share_time(channel: Channel, pieces: Sequence[Move], counted: float = 1.0) -> None:
    """Pieces of inverse time, the first one the move itself, last as long together as that; displays show its feed."""
    toolpath = channel.toolpath
    if len(pieces) < 2 or toolpath.contexts[pieces[0].context].feed_mode is not FeedMode.INVERSE_TIME:
        return
    parts = _parts(channel, [(piece.start, piece.end) for piece in pieces])
    if any(piece.is_arc for piece in pieces):
        lengths = [MovePath(piece, channel.coordinates.geometry).length for piece in pieces]
        parts = [length / sum(lengths) if length > 0.0 else 1.0 for length in lengths]
    for piece, share in zip(pieces, _counted(channel, pieces, parts, counted), strict=True):
        held = toolpath.contexts[piece.context]
        piece.feed /= share
        piece.context = toolpath.context_number(replace(held, share=held.share * share))


def _counted(channel: Channel, pieces: Sequence[Move], parts: list[float], counted: float) -> list[float]:
    """What inverse time counts of pieces that have some parts of a move: of arcs on some controls the radius."""
    if not channel.control.motion_settings(channel).inverse_time_by_radius:
        return parts
    geometry, whole = channel.coordinates.geometry, counted
    paths = [MovePath(piece, geometry) if piece.is_arc else None for piece in pieces]
    by_radius = [1.0 if path is None else path.radius / path.length for path in paths]
    if paths[0] is not None:
        whole = parts[0] * by_radius[0]
    return [part * factor / whole for part, factor in zip(parts, by_radius, strict=True)]


def _parts(channel: Channel, ways: Sequence[tuple[list[float], list[float]]]) -> list[float]:
    """Parts that straight ways have of their sum on the geometry axes, or where those stand on all; 1 without way."""
    columns: Iterable[int] = [column for column in channel.coordinates.geometry if column >= 0]
    lengths = [hypot(*(b[i] - a[i] for i in columns)) for a, b in ways]
    if not any(lengths):
        lengths = [dist(a, b) for a, b in ways]
    whole = sum(lengths)
    return [length / whole if length > 0.0 else 1.0 for length in lengths]


class Motions:
    """Motions of several rows, for stages that know no channel."""

    def __init__(self, channel: Channel) -> None:
        self._channel = channel

    def join(self, pieces: Sequence[Move]) -> None:
        """Pieces that make up a move become one motion."""
        join(self._channel, pieces)

    def share_time(self, pieces: Sequence[Move]) -> None:
        """A move and what lies at its end last as long together as the move would by inverse time."""
        share_time(self._channel, pieces)

    def is_timed(self, context: int) -> bool:
        """Whether moves of a context last a time that the program says."""
        return self._channel.toolpath.contexts[context].feed_mode is FeedMode.INVERSE_TIME


def passing(held: Context, share: float = 1.0, *, shows: bool = True) -> Context:
    """The context of a piece within a motion of another one: nothing rests at its end."""
    return replace(held, knot=True, shows_knot=shows, share=held.share * share)


def knot_context(channel: Channel, context: int) -> int:
    """The context of pieces within a motion: nothing rests at their ends, and displays show them as one."""
    toolpath = channel.toolpath
    return toolpath.context_number(passing(toolpath.contexts[context], 1.0, shows=False))
