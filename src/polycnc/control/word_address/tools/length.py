"""Tool length compensation G43, G44, G49 and the H word."""

from __future__ import annotations

from math import isclose, nan

from polycnc.control.word_address.coordinates import tip
from polycnc.control.word_address.coordinates.systems import ZeroState, frame_as_told, refresh_zero
from polycnc.control.word_address.cycles import drilling
from polycnc.control.word_address.states import UPRIGHT, LengthState
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.vectors import times
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.frames import Vector

#: The code under which a length counts along the tool as the head turns it (MELDAS).
ALONG_TOOL = "G43.1"
_SIGN = {"G43": 1.0, "G44": -1.0, ALONG_TOOL: 1.0}
#: What rounding leaves of a length (mm) is not travelled.
NO_WAY = 1e-9


def compensate_length(channel: WordAddressChannel, words: Words) -> None:
    """G43 / G44 H: shifts Z by the offset value, or against it; a new H replaces the old one."""
    state = LengthState.of(channel)
    number = words.integer("H")
    if number is not None:
        state.number = number
    _begin_anew(channel)
    _apply(channel, words)


def cancel_length(channel: WordAddressChannel, words: Words) -> None:
    """G49: the shift ends; Z travels it back with its next move."""
    LengthState.of(channel).number = 0
    _begin_anew(channel)
    _apply(channel, words)


def leave_length(channel: WordAddressChannel, axes: list[int], *, returns: bool) -> None:
    """Axes were sent to machine positions without regard to the tool: the way of its length is not travelled in them.

    Args:
        channel: The channel; its modal code stays.
        axes: The axes that were sent.
        returns: The next absolute word counts the length again; else the next G43, G44 or H does.
    """
    state, lengths = LengthState.of(channel), ZeroState.of(channel).length
    left = [axis for axis in axes if lengths[axis]]
    if not left or channel.mode["length"] not in _SIGN:
        return
    if returns:
        machine = channel.coordinates.machine
        state.left_at.update({axis: machine[axis] for axis in left})
    else:
        state.lost = (*state.lost, *left)
        _forget(channel, left)


def _begin_anew(channel: WordAddressChannel) -> None:
    """A length code behind G28, G30 or G53: where an axis still stands there, the whole length lies ahead of it."""
    state, c, lengths = LengthState.of(channel), channel.coordinates, ZeroState.of(channel).length
    state.lost = ()
    if state.left_at:
        machine = c.machine
        for axis, place in state.left_at.items():
            if isclose(machine[axis], place, abs_tol=1e-9):
                c.pending[axis] = lengths[axis]
        c.owes = any(c.pending)
        state.left_at.clear()


def end_length(channel: WordAddressChannel, axes: list[int]) -> None:
    """G49 without motion, where one of the axes has a length."""
    lengths = ZeroState.of(channel).length
    ended = [axis for axis in channel.coordinates.geometry if axis >= 0 and lengths[axis]]
    if channel.mode["length"] in _SIGN and any(axis in axes for axis in ended):
        LengthState.of(channel).number = 0
        channel.mode = channel.mode.with_code("length", "G49")
        _forget(channel, ended)


def _forget(channel: WordAddressChannel, axes: list[int]) -> None:
    """The axes stay where they are; nothing is owed to an incremental word."""
    zero, c = ZeroState.of(channel), channel.coordinates
    for axis in axes:
        zero.length[axis] = 0.0
        c.pending[axis] = 0.0
    c.owes = any(c.pending)
    refresh_zero(channel)


def plan_length_number(builder: Builder) -> Step | None:
    """H without G43/G44 in its block: a new number for the active compensation."""
    slot = builder.slots["H"][0]
    named = {word.axis for word in builder.axis_words()}

    def change(channel: WordAddressChannel, values: list[float]) -> None:
        LengthState.of(channel).number = int(values[slot])
        _begin_anew(channel)
        if channel.mode["length"] in _SIGN:
            _shift(channel)
            _travel(channel, named)
        else:
            renew_tip(channel)

    return change


def renew_length(channel: WordAddressChannel) -> None:
    """The offset memory has changed: an active compensation takes the new value with its next move."""
    if channel.mode["length"] in _SIGN:
        _shift(channel)
    else:
        renew_tip(channel)


def renew_tip(channel: WordAddressChannel) -> None:
    """The length is another one: where tip control leads, the tip lies elsewhere from here on; the machine stays."""
    state, number = tip.TipState.of(channel), LengthState.of(channel).number
    if state.active is not None and state.is_leading(channel):
        value = channel.control.length_value(channel, number) if number else 0.0
        active = replace(state.active, tip=times(state.active.kinematics.along, -value))
        if active != state.active:
            channel.flush()
            offsets = channel.coordinates.offsets
            tip.lead(channel, active, state.frame, offsets, frame_as_told(channel, offsets))
            channel.context_changed()


def _apply(channel: WordAddressChannel, words: Words) -> None:
    _shift(channel)
    _travel(channel, {axis for axis, _, _ in words.axes()})


def active_value(channel: WordAddressChannel) -> float:
    """The length that G43 or G44 adds along the tool, mm; 0 without them, and where a control has none."""
    sign, number = _SIGN.get(channel.mode.codes.get("length", ""), 0.0), LengthState.of(channel).number
    return sign * channel.control.length_value(channel, number) if sign and number else 0.0


def _shift(channel: WordAddressChannel, *, travelled: bool = True) -> None:
    state, lengths, geometry = (
        LengthState.of(channel),
        ZeroState.of(channel).length,
        channel.coordinates.geometry,
    )
    if geometry[2] < 0:
        raise channel.control.fail("plane")
    value = active_value(channel)
    turned = channel.mode.codes.get("length") == ALONG_TOOL
    for axis, part in zip(geometry, state.along if turned else state.direction or UPRIGHT, strict=True):
        if axis >= 0:
            lengths[axis] = value * part if part and axis not in state.lost else 0.0
    refresh_zero(channel, travelled=travelled)


def turn_length(channel: WordAddressChannel, along: Vector) -> None:
    """G43.1: the head stands the tool along this direction at the end of a block, which goes there."""
    LengthState.of(channel).along = along
    _shift(channel, travelled=False)


def renew_direction(channel: WordAddressChannel) -> None:
    """The direction of the tool has changed: an active length counts along the new one."""
    for axis in channel.coordinates.geometry:
        if axis >= 0:
            ZeroState.of(channel).length[axis] = 0.0
    if channel.mode.codes.get("length") in _SIGN:  # lathes have no lengths along the tool
        _shift(channel)


def _travel(channel: WordAddressChannel, named: set[int]) -> None:
    """Without a word the axis moves by the change at once, as `G91 Z0` would, where the control has it so."""
    c = channel.coordinates
    owed = [
        a
        for a in c.geometry
        if a >= 0 and a not in named and (a == c.geometry[2] or abs(c.pending[a]) > NO_WAY)
    ]
    if not owed or not channel.control.LENGTH_TRAVELS_ALONE or drilling.is_active(channel):
        # In a drilling cycle the way to R brings the new length in (Hartford 3.3.4, note 6).
        return
    end = c.position[:]
    for axis in owed:
        end[axis] += c.pending[axis]
        c.pending[axis] = 0.0
    rapid = channel.mode["motion"] == "G0"
    if not rapid and not channel.feed > 0.0:
        raise channel.control.fail("no_feed")
    channel.straight(Kind.RAPID if rapid else Kind.FEED, end, nan if rapid else channel.feed)
