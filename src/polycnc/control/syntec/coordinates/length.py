"""Tool length compensation of SYNTEC (manual 2.30): the shift comes first, then the motion of the block.

A change of the length stops look-ahead: under radius compensation the block in front ends square on itself.
"""

from __future__ import annotations

from polycnc.control.word_address.memory import ToolOffsets
from polycnc.control.word_address.tools import length
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM

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


# ---- the page of tool data ---------------------------------------------------------------------------------


def tool_datum(channel: SyntecChannel, number: int, field: str) -> float:
    """A field of a tool (`length`, `length_wear`, `radius`, `radius_wear`), in the unit of the program."""
    tool = ToolOffsets.of(channel).numbers.get(number)
    millimetres: float = getattr(tool, field) if tool is not None else 0.0
    return millimetres / INCH_MM if channel.memory.is_inch else millimetres


def set_tool_datum(channel: SyntecChannel, number: int, field: str, value: float) -> None:
    """Another value, in the unit of the program; an active compensation takes it with its next move, as by G10."""
    millimetres = value * INCH_MM if channel.memory.is_inch else value
    setattr(channel.memory.offset_number(number), field, millimetres)
    length.renew_length(channel)
