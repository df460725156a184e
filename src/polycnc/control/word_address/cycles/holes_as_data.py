"""Holes told as data, for the scanner: blocks that only say where the next hole of the active cycle is."""

from __future__ import annotations

from polycnc.control.word_address.cycles.drilling import CycleState, hole_of
from polycnc.control.word_address.cycles.plunge import plunge_of
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk.recipe import Drilled
from polycnc.messages import AlarmError
from polycnc.toolpath.context import NO_OVERLAP

if TYPE_CHECKING:
    from polycnc.control.word_address.cycles.drilling import Drilling
    from polycnc.control.word_address.family import WordAddressChannel


def next_hole(channel: WordAddressChannel) -> Drilled | None:
    """The strokes of the hole of a block that only says where; None where more than plain strokes is to be done."""
    code, state, c = channel.mode.codes.get("cycle", ""), CycleState.of(channel), channel.coordinates
    rules: Drilling = channel.control.drilling_rules(channel)
    cycle, data = rules.cycles.get(code), state.data
    if (
        channel.path.head is not None
        or cycle is None
        or data is None
        or data.now
        or not c.direct
        or c.transformation is not None
    ):
        return None
    if any(not data.amount(address) for address in cycle.needs) or state.overlap != NO_OVERLAP:
        return None
    if (
        rules.overlaps(channel, code) is not None
        or rules.dress(channel, code, cycle.strokes) is not cycle.strokes
    ):
        return None
    try:
        rules.check(channel, code)
    except AlarmError:
        return None  # the interpreter comes to the hole and raises it
    level = c.position[data.axis]
    plunge = plunge_of(cycle.strokes, hole_of(channel, code, data), level, channel.feed)
    if plunge is None:
        return None
    strokes = tuple(zip(plunge.kinds, plunge.feeds, plunge.levels, strict=True))
    return Drilled(data.axis, level, channel.feed, plunge.end, plunge.blocks, strokes)
