"""G04 of FANUC controls: seconds, or revolutions of the spindle by parameter."""

from __future__ import annotations

from polycnc.control.word_address.auxiliary import functions
from polycnc.deferred.typing import TYPE_CHECKING, cast

if TYPE_CHECKING:
    from polycnc.control.fanuc.parameters import FanucAxisParameters, FanucParameters
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel

#: Feed per revolution on machining centres and on lathes.
PER_REVOLUTION = frozenset(("G95", "G99"))


def dwell(channel: WordAddressChannel, words: Words) -> None:
    """G04 X, U (seconds) or P (milliseconds); spindle revolutions under feed per revolution with 3405#1 DWL."""
    parameters = cast("FanucParameters[FanucAxisParameters]", channel.memory.parameters)
    turns = parameters.DWL and channel.mode["feed"] in PER_REVOLUTION
    functions.dwell(channel, words, in_revolutions=turns)
