"""G31: a straight move that a skip signal ends."""

from __future__ import annotations

from math import dist
from typing import TYPE_CHECKING

from polycnc.control.word_address.path import target
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.words import Words

#: P of G31: which skip input ends the move. All inputs come at the same place here.
SKIP_INPUTS = range(1, 9)
TORQUE_LIMIT_SKIP = (98, 99)


def skip_move(channel: Channel, words: Words) -> None:
    """G31: straight at F to the target or to where the skip signal comes; the rest of the way is dropped."""
    if channel.mode["compensation"] != "G40":
        raise words.fail("comp_skip", "G31")
    number = words.integer("P") if "P" in words else 1
    if number in TORQUE_LIMIT_SKIP:
        raise AlarmError("PC0001", address="P", hint="hint.not-supported", code=f"G31 P{number}")
    if number not in SKIP_INPUTS:
        raise words.fail("address", "P")
    if not channel.feed > 0.0:
        raise words.fail("no_feed")
    c = channel.coordinates
    programmed = target(channel, words.plan.axis_words, words.values)
    end = c.to_position(programmed)
    stopped = signal_position(channel, c.position, end, channel.setup.switches.skip_signal_at)
    move_to_signal(channel, end, stopped)
    channel.memory.note_skip(list(channel.coordinates.position))


def move_to_signal(channel: Channel, end: list[float], stopped: list[float] | None) -> None:
    """The row of a skip move: to where the signal comes, with the way that is then left; else to its end."""
    if stopped is None:
        channel.straight(Kind.SKIP, end, channel.feed)
    elif stopped != channel.coordinates.position:
        channel.curve(Kind.SKIP, stopped, channel.feed, parameters=(dist(stopped, end),))


def signal_position(channel: Channel, start: list[float], end: list[float], at: object) -> list[float] | None:
    """Where on the way a signal comes: the first point at which every named axis has reached its position."""
    fraction = 0.0
    if not isinstance(at, dict) or not at:
        return None
    for name, value in at.items():
        i = channel.axis_index.get(name)
        if i is None:
            continue
        value = channel.control.from_display(channel, i, value)
        way = end[i] - start[i]
        if abs(way) < 1e-12:
            if abs(start[i] - value) > 1e-9:
                return None
            continue
        part = (value - start[i]) / way
        if not -1e-9 <= part <= 1.0 + 1e-9:
            return None
        fraction = max(fraction, part)
    return [s + (e - s) * fraction for s, e in zip(start, end, strict=True)]
