"""Tool length compensation G43, G44, G49 and the H word."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.word_address.coordinates.systems import ZeroState, refresh_zero
from polycnc.control.word_address.cycles import drilling
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.frames import Vector

_SIGN = {"G43": 1.0, "G44": -1.0}


@dataclass(slots=True)
class LengthState(State, lifetime=Lifetime.RESET):
    """Number of the active length offset (H), and the direction in which it counts where that is not Z."""

    number: int = 0
    direction: Vector | None = None


def compensate_length(channel: WordAddressChannel, words: Words) -> None:
    """G43 / G44 H: shifts Z by the offset value, or against it; a new H replaces the old one."""
    number = words.integer("H")
    if number is not None:
        LengthState.of(channel).number = number
    _apply(channel, words)


def cancel_length(channel: WordAddressChannel, words: Words) -> None:
    """G49: the shift ends; Z travels it back with its next move."""
    LengthState.of(channel).number = 0
    _apply(channel, words)


def plan_length_number(builder: Builder) -> Step | None:
    """H without G43/G44 in its block: a new number for the active compensation."""
    slot = builder.slots["H"][0]
    z = builder.channel.coordinates.geometry[2]
    moved = any(word.axis == z for word in builder.axis_words())

    def change(channel: WordAddressChannel, values: list[float]) -> None:
        LengthState.of(channel).number = int(values[slot])
        if channel.mode["length"] in _SIGN:
            _shift(channel)
            if not moved:
                _travel(channel)

    return change


def renew_length(channel: WordAddressChannel) -> None:
    """The offset memory has changed: an active compensation takes the new value with its next move."""
    if channel.mode["length"] in _SIGN:
        _shift(channel)


def _apply(channel: WordAddressChannel, words: Words) -> None:
    _shift(channel)
    z = channel.coordinates.geometry[2]
    if not any(axis == z for axis, _, _ in words.axes()):
        _travel(channel)


def _shift(channel: WordAddressChannel) -> None:
    zero_state = ZeroState.of(channel)
    length_state = LengthState.of(channel)
    z = channel.coordinates.geometry[2]
    if z < 0:
        raise channel.control.fail("plane")
    sign = _SIGN.get(channel.mode["length"], 0.0)
    value = (
        channel.control.length_value(channel, length_state.number) if sign and length_state.number else 0.0
    )
    if length_state.direction is None:
        zero_state.length[z] = sign * value
    else:
        for axis, part in zip(channel.coordinates.geometry, length_state.direction, strict=True):
            if axis >= 0:
                zero_state.length[axis] = sign * value * part
    refresh_zero(channel, travelled=True)


def renew_direction(channel: WordAddressChannel) -> None:
    """The direction of the tool has changed: an active length counts along the new one."""
    for axis in channel.coordinates.geometry:
        if axis >= 0:
            ZeroState.of(channel).length[axis] = 0.0
    if channel.mode["length"] in _SIGN:
        _shift(channel)


def _travel(channel: WordAddressChannel) -> None:
    """Without a Z word the axis moves by the change at once, as `G91 Z0` would, where the control has it so."""
    if not channel.control.LENGTH_TRAVELS_ALONE or drilling.is_active(channel):
        # In a drilling cycle the way to R brings the new length in (Hartford 3.3.4, note 6).
        return
    c = channel.coordinates
    z = c.geometry[2]
    end = c.position[:]
    end[z] += c.pending[z]
    c.pending[z] = 0.0
    rapid = channel.mode["motion"] == "G0"
    if not rapid and not channel.feed > 0.0:
        raise channel.control.fail("no_feed")
    channel.straight(Kind.RAPID if rapid else Kind.FEED, end, nan if rapid else channel.feed)
