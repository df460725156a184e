"""Where single block halts within a hole."""

from __future__ import annotations

from enum import Enum

from polycnc.cycles.drilling.holes import Action, Stroke
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.control.word_address.family import WordAddressChannel


class Halts(Enum):
    """Where single block halts in a hole, besides its end."""

    NONE = "nowhere"
    APPROACH = "over the hole and on R"
    ALL = "behind every stroke"


def halts_nowhere(_channel: WordAddressChannel, _code: str) -> Halts:
    """A block that drills is one block."""
    return Halts.NONE


def with_halts(channel: WordAddressChannel, strokes: Iterator[Stroke], halts: Halts) -> Iterator[Stroke]:
    """Note where single block halts: behind strokes and dwells; the end of the hole is not counted here.

    A dwell behind an M code (unclamping an axis) belongs to the action that the code ends.
    """
    if halts is Halts.NONE or not channel.single_block:
        yield from strokes
        return
    waits, last = False, None
    for stroke in strokes:
        if stroke.action not in (Action.OUTPUT, Action.SPINDLE, Action.ORIENT):
            if waits and not (stroke.action is Action.DWELL and last is Action.OUTPUT):
                channel.halt_inside()
            on_r = halts is Halts.APPROACH and stroke.action is Action.RAPID
            waits = halts is Halts.ALL or on_r
            halts = Halts.NONE if on_r else halts
        last = stroke.action
        yield stroke
