"""G05.1: AI contour control; smooth interpolation (Q2) and nano smoothing (Q3) are known, and not executed.

The manuals at hand name Q1 and Q0 alone, which leave the path as it is. Q2 and Q3 are options of the control (general
knowledge): they lead the axes along a curve beside the lines.
"""

from __future__ import annotations

from polycnc.control.word_address.motion import path_modes
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel

#: Q of smooth interpolation and of nano smoothing.
CURVES = (2, 3)


def contour_control(channel: WordAddressChannel, words: Words) -> None:
    """G05.1 Q1 [R1 … R10] / Q0, alone in its block; PC0001 for Q2 and Q3, which other words may follow."""
    curve = words.integer("Q")
    if curve in CURVES:
        raise AlarmError("PC0001", hint="hint.not-supported", code=f"G05.1 Q{curve}")
    path_modes.contour_control(channel, words)
