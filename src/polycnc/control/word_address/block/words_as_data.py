"""Words told as data, so that the scanner can read them as the plans of plain blocks do (`plain`)."""

from __future__ import annotations

from polycnc.control.word_address.block.numbers import conversion
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import Target, Word

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.word_address.block.numbers import Convert
    from polycnc.control.word_address.block.plan import AxisWord


def targets_as_data(words: Sequence[AxisWord]) -> tuple[Target, ...] | None:
    """Axis words as data; None where one has a conversion that cannot be told."""
    found = []
    for axis_word in words:
        told = conversion(axis_word.convert)
        if told is None:
            return None
        found.append(Target(axis_word.slot, told, axis_word.axis, axis_word.incremental))
    return tuple(found)


def word_as_data(slot: int | None, convert: Convert | None) -> Word | None:
    """A word as data; None where the block does not have it."""
    told = conversion(convert)
    return None if slot is None or told is None else Word(slot, told)
