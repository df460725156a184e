"""FZ: feed per tooth. The path feed follows from the number of teeth of the active edge, $TC_DPNT.

Source: Fundamentals (G95, FZ).
"""

from __future__ import annotations

from polycnc.control.sinumerik.block.positions import number
from polycnc.control.sinumerik.feed.path_feed import PathFeed, ToothFeed
from polycnc.control.sinumerik.motion import moves
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.words import WordAlarm

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.words import WordShape

#: The feed type that FZ is for.
PER_REVOLUTION = "G95"


def tooth_feed(draft: Draft, position: int, _shape: WordShape) -> Step:
    """FZ: feed per tooth, modal under G95 until F; 12080 beside F or under another feed type, 14800 below zero."""
    if draft.mode["feed"] != PER_REVOLUTION or any(word.address == "F" for word in draft.block.words):
        raise WordAlarm("12080", position, text="FZ")
    factor = moves.feed_factor(draft)

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        if value < 0.0:
            raise WordAlarm("14800", position)
        set_feed(channel, value * factor)

    return run


def follow(channel: SinumerikChannel) -> None:
    """Another edge or number of teeth: the feed follows, unless F or another feed type has taken its place."""
    kept = PathFeed.of(channel).tooth
    if kept is not None and channel.feed == kept.per_revolution:
        set_feed(channel, kept.per_tooth)


def set_feed(channel: SinumerikChannel, tooth_feed: float) -> None:
    """The path feed that a feed per tooth gives with the active edge; none without teeth (then 0, alarm 10860)."""
    edge = channel.memory.tools.edge
    channel.feed = tooth_feed * (edge.teeth if edge is not None else 0.0)
    PathFeed.of(channel).tooth = ToothFeed(tooth_feed, channel.feed)
