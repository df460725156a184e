"""Curves that a block writes as chords: nothing rests between them, and under G93 they share the time of the block."""

from __future__ import annotations

from itertools import pairwise
from math import hypot
from typing import TYPE_CHECKING

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.deferred.records import dataclass
from polycnc.toolpath.modes import CornerMode, FeedMode

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from polycnc.control.sinumerik.family import SinumerikChannel


@dataclass(slots=True)
class Chords(State, lifetime=Lifetime.BLOCK):
    """Whether another chord of the same block follows the one that is written."""

    follows: bool = False


def write_chords(
    channel: SinumerikChannel,
    points: Iterable[list[float]],
    feed: float,
    put: Callable[[list[float], float], None],
) -> None:
    """Write the chords to some points, each with its feed; an exact stop is at the last one alone."""
    ends, state = list(points), Chords.of(channel)
    feeds = _feeds(channel, ends, feed)
    try:
        for k, (end, own) in enumerate(zip(ends, feeds, strict=True)):
            if state.follows is not (k < len(ends) - 1):
                state.follows = not state.follows
                channel.context_changed()
            put(end, own)
    finally:
        state.follows = False


def corner_mode(channel: SinumerikChannel, mode: CornerMode) -> CornerMode:
    """What happens at the end of a row: no exact stop where another chord follows."""
    passes = mode is CornerMode.EXACT_STOP and Chords.of(channel).follows
    return CornerMode.CONTINUOUS if passes else mode


def _feeds(channel: SinumerikChannel, ends: Sequence[list[float]], feed: float) -> list[float]:
    """Under G93 the time of each chord is its part of the block's."""
    if PathFeed.of(channel).mode is not FeedMode.INVERSE_TIME or len(ends) < 2:
        return [feed] * len(ends)
    columns = [column for column in channel.coordinates.geometry if column >= 0]
    ways = [
        hypot(*(b[i] - a[i] for i in columns)) for a, b in pairwise((channel.coordinates.position, *ends))
    ]
    whole = sum(ways)
    return [feed * whole / way if way > 0.0 else feed for way in ways]
