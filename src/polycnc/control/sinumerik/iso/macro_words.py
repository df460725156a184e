"""`$C_A` to `$C_Z`: what a program that G65 or G66 has called reads of the words of that block."""

from __future__ import annotations

from polycnc.control.sinumerik.errors import not_supported
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Type

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Reader, Row

#: Letters that hand over a number; D, M and T belong to programs in place of functions (`replaced`).
LETTERS = "ABCEFHIJKQRSUVWXYZ"
#: Where a level keeps its words.
WORDS = "iso_words"


def _words(channel: SinumerikChannel) -> Mapping[str, float]:
    """The words of the innermost call; none outside of one."""
    for level in reversed(channel.stack):
        if WORDS in level.data:
            words: Mapping[str, float] = level.data[WORDS]
            return words
    return {}


def _value(letter: str) -> Reader:
    def read(channel: SinumerikChannel, indices: Indices) -> float:
        if indices:
            raise not_supported(f"$C_{letter}[]")
        return _words(channel).get(letter, 0.0)

    return read


def _is_given(letter: str) -> Reader:
    def read(channel: SinumerikChannel, _indices: Indices) -> bool:
        return letter in _words(channel)

    return read


MACRO_VARIABLES: dict[str, Row] = {
    **{f"$C_{letter}": (Type.REAL, _value(letter), None) for letter in LETTERS},
    **{f"$C_{letter}_PROG": (Type.BOOL, _is_given(letter), None) for letter in LETTERS},
}
