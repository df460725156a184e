"""Axes programmed in diameters: which ones G10.9 has switched (manual 2.73)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words


@dataclass(slots=True)
class DiameterState(State, lifetime=Lifetime.POWER):
    """Axes switched by G10.9: programmed in diameter or not."""

    switched: dict[int, bool] = field(default_factory=dict)


def switch_diameter(channel: SyntecChannel, words: Words) -> None:
    """G10.9 X0 Y1: axes programmed and shown in radius (0) or diameter (1); nothing moves (2.73)."""
    named = words.plan.axis_words
    if not named:
        raise words.fail("diameter_switch", "G10.9")
    for word in named:
        value = words.values[word.slot]
        if value not in (0, 1) or channel.axis_data[word.axis].rotary:
            raise words.fail("diameter_switch", word.address)
        DiameterState.of(channel).switched[word.axis] = value == 1
    channel.modes.forget_plans()
    channel.context_changed()
