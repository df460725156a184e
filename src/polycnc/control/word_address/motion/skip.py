"""G31: a straight move that a skip signal ends."""

from __future__ import annotations

from functools import partial
from math import dist

from polycnc.control.word_address.auxiliary.overrides import fixed_feed
from polycnc.control.word_address.motion.path import FEED_MODES, reach
from polycnc.control.word_address.states import LastSkip
from polycnc.deferred.contexts import nullcontext
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.machine.setup.values import SkipInput
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MacroChannel, WordAddressChannel

#: P of G31: which skip input ends the move. All inputs come at the same place here.
SKIP_INPUTS = range(1, 9)
#: P of torque limit skip: by the torque alone, or by torque or skip input, whichever comes first.
TORQUE_LIMIT_SKIP = BY_TORQUE, BY_TORQUE_OR_INPUT = (98, 99)
#: Where the torque of an axis reaches its limit: a signal of the setup. Without it no limit acts.
TORQUE_LIMIT = "TORQUE_LIMIT"


def skip_move(channel: WordAddressChannel, words: Words) -> None:
    """G31 (MELDAS also G31.1 to G31.3): straight at F to the target or to the skip signal; what is left is dropped."""
    number = words.integer("P") if "P" in words else 1
    if number in TORQUE_LIMIT_SKIP:
        raise AlarmError("PC0001", address="P", hint="hint.not-supported", code=f"G31 P{number}")
    if number not in SKIP_INPUTS:
        raise words.fail("address", "P")
    end = _target(channel, words)
    stopped = signal_position(channel, channel.coordinates.position, end, channel.setup.switches.skip_input)
    move_to_signal(channel, end, stopped)
    LastSkip.of(channel).position = list(channel.coordinates.named(channel.coordinates.position))


def _target(channel: WordAddressChannel, words: Words) -> list[float]:
    """Where a skip move leads: a work position."""
    if channel.mode["compensation"] != "G40":
        raise words.fail("comp_skip", "G31")
    if not channel.feed > 0.0:
        raise words.fail("no_feed")
    return channel.coordinates.to_position(reach(channel, words.plan.axis_words, words.values))


def skip_or_torque_move(channel: MacroChannel, words: Words) -> None:
    """G31 of FANUC: at the programmed feed alone by feed per minute (6200#7 SKF = 0; B-63844EN, 4.13)."""
    per_minute = FEED_MODES[channel.mode["feed"]] is FeedMode.PER_MINUTE
    with nullcontext() if channel.memory.parameters.SKF or not per_minute else fixed_feed(channel):
        _skip_or_torque_move(channel, words)


def _skip_or_torque_move(channel: MacroChannel, words: Words) -> None:
    """As `skip_move`; with P98 and P99 torque limit skip.

    P98 ends where the torque reaches its limit and does not look at the skip input, P99 at what comes first. Where no
    torque limit is active the move goes to its end (0i-TF Plus, warnings: torque limit skip).
    """
    number = words.integer("P") if "P" in words else 1
    if number not in TORQUE_LIMIT_SKIP:
        skip_move(channel, words)
        return
    end = _target(channel, words)
    start, switches = channel.coordinates.position, channel.setup.switches
    places = [signal_position(channel, start, end, switches.signals_at.get(TORQUE_LIMIT))]
    if number == BY_TORQUE_OR_INPUT:
        places.append(signal_position(channel, start, end, switches.skip_input))
    stopped = min((place for place in places if place is not None), key=partial(dist, start), default=None)
    if number == BY_TORQUE_OR_INPUT:
        move_to_signal(channel, end, stopped)
    else:  # a row of skipping would end at the skip input
        channel.straight(Kind.FEED, end if stopped is None else stopped, channel.feed)
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
        fraction = fraction_at(channel, start, end, signal)
    else:
        c, geometry = channel.coordinates, channel.coordinates.geometry
        shares = [fraction_at(channel, start, end, signal.at)]
        if signal.surfaces and c.transformation is None:
            places = ([c.to_machine(place)[i] if i >= 0 else 0.0 for i in geometry] for place in (start, end))
            (x, y, z), (x1, y1, z1) = places
            from polycnc.geometry.surfaces import first_touch  # where the setup has some

            shares.append(first_touch(signal.surfaces, (x, y, z), (x1, y1, z1)))
        if signal.after_s is not None and channel.move_times is not None and start == c.position:
            shares.append(channel.move_times.share_after(channel, end, channel.feed, signal.after_s))
        fraction = min((share for share in shares if share is not None), default=None)
    if fraction is None:
        return None
    return [s + (e - s) * fraction for s, e in zip(start, end, strict=True)]


def fraction_at(
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
