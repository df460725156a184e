"""G45 to G48, moves lengthened or shortened by an offset, and G60, positioning from one direction."""

from __future__ import annotations

from math import copysign, nan
from typing import TYPE_CHECKING

from polycnc.control.word_address.path import target
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.plan import AxisWord
    from polycnc.control.word_address.words import Words

#: How often each code adds the offset, in the direction of the move.
TIMES = {"G45": 1.0, "G46": -1.0, "G47": 2.0, "G48": -2.0}


def offset_move(channel: Channel, words: Words) -> None:
    """G45 to G48: the move of each named axis grows or shrinks along its own direction; only in this block."""
    memory, c = channel.memory, channel.coordinates
    code = next(key for key in words.plan.order if key in TIMES)
    if channel.mode["compensation"] != "G40":
        raise words.fail("comp_g45", code)
    motion = channel.mode["motion"]
    if motion not in ("G0", "G1"):
        raise AlarmError("PC0001", address=code, hint="hint.not-supported", code=f"{code} {motion}")
    number = words.integer("D") if "D" in words else None
    memory.d = memory.d if number is None else number
    amount = TIMES[code] * channel.control.radius_value(channel, memory.d)
    end = target(channel, words.plan.axis_words, words.values)
    for word in words.plan.axis_words:
        end[word.axis] += amount * _direction(words, word, end[word.axis] - c.programmed[word.axis])
    rapid = motion == "G0"
    if not rapid and not channel.feed > 0.0:
        raise words.fail("no_feed")
    kind = Kind.RAPID if rapid else Kind.FEED
    channel.straight(kind, c.to_position(end), nan if rapid else channel.feed, end)


def _direction(words: Words, word: AxisWord, way: float) -> float:
    """1 or -1; an increment of -0 points backwards."""
    return copysign(1.0, words.values[word.slot] if word.incremental else way)


def position_one_way(channel: Channel, words: Words) -> None:
    """G60: rapid past the target by each axis's overrun, then on to it always from the same side."""
    c = channel.coordinates
    end = target(channel, words.plan.axis_words, words.values)
    via = end[:]
    for word in words.plan.axis_words:
        via[word.axis] -= channel.control.overrun(channel, word.axis)
    channel.straight(Kind.RAPID, c.to_position(via), nan, via)
    channel.straight(Kind.RAPID, c.to_position(end), nan, end)
