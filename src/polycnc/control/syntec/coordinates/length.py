"""Tool length compensation of SYNTEC (manual 2.30): the shift comes first, then the motion of the block.

A change of the length stops look-ahead: under radius compensation the block in front ends square on itself.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.word_address.tools import length

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words


def compensate_length(channel: SyntecChannel, words: Words) -> None:
    """G43 / G44 H."""
    channel.flush()
    length.compensate_length(channel, words)


def cancel_length(channel: SyntecChannel, words: Words) -> None:
    """G49."""
    channel.flush()
    length.cancel_length(channel, words)
