"""G31: a straight move that a skip signal ends."""

from __future__ import annotations

from math import dist
from typing import TYPE_CHECKING

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.word_address.motion.path import reach
from polycnc.deferred.records import dataclass
from polycnc.geometry.surfaces import first_touch
from polycnc.machine.setup.values import SkipInput
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel

#: P of G31: which skip input ends the move. All inputs come at the same place here.
SKIP_INPUTS = range(1, 9)
TORQUE_LIMIT_SKIP = (98, 99)


@dataclass(slots=True)
class LastSkip(State, lifetime=Lifetime.POWER):
    """Where the last skip move has ended (absolute display); None where there was none."""

    position: list[float] | None = None

    @classmethod
    def here(cls, channel: Channel) -> list[float]:
        """That position, else where the channel is."""
        return cls.of(channel).position or channel.coordinates.position


def skip_move(channel: WordAddressChannel, words: Words) -> None:
    """G31 (MELDAS also G31.1 to G31.3): straight at F to the target or to the skip signal; what is left is dropped."""
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
    programmed = reach(channel, words.plan.axis_words, words.values)
    end = c.to_position(programmed)
    stopped = signal_position(channel, c.position, end, channel.setup.switches.skip_input)
    move_to_signal(channel, end, stopped)
    LastSkip.of(channel).position = list(channel.coordinates.position)


def move_to_signal(channel: WordAddressChannel, end: list[float], stopped: list[float] | None) -> None:
    """The row of a skip move: to where the signal comes, with the way that is then left; else to its end."""
    if stopped is None:
        channel.straight(Kind.SKIP, end, channel.feed)
    elif stopped != channel.coordinates.position:
        channel.curve(Kind.SKIP, stopped, channel.feed, parameters=(dist(stopped, end),))


def signal_position(
    channel: WordAddressChannel, start: list[float], end: list[float], signal: object
) -> list[float] | None:
    """Where on the way a signal comes.

    `signal` is a work position, or all that makes the skip input come; of that the first counts. A signal that comes
    by the clock counts in the move from where the channel stands; where a main run executes the move, it gives it.
    """
    if not isinstance(signal, SkipInput):
        fraction = _fraction_at(channel, start, end, signal)
    else:
        c, geometry = channel.coordinates, channel.coordinates.geometry
        shares = [_fraction_at(channel, start, end, signal.at)]
        if signal.surfaces and c.transformation is None:
            places = ([c.to_machine(place)[i] if i >= 0 else 0.0 for i in geometry] for place in (start, end))
            (x, y, z), (x1, y1, z1) = places
            shares.append(first_touch(signal.surfaces, (x, y, z), (x1, y1, z1)))
        if signal.after_s is not None and channel.share_after is not None and start == c.position:
            shares.append(channel.share_after(channel, end, channel.feed, signal.after_s))
        fraction = min((share for share in shares if share is not None), default=None)
    if fraction is None:
        return None
    return [s + (e - s) * fraction for s, e in zip(start, end, strict=True)]


def _fraction_at(
    channel: WordAddressChannel, start: list[float], end: list[float], at: object
) -> float | None:
    """The share of the way after which every axis that a work position names has reached it."""
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
    return fraction
