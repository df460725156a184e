"""G38 and G39: the vector of radius compensation held or replaced, and an arc about a corner."""

from __future__ import annotations

from polycnc.control.word_address.tools import radius
from polycnc.control.word_address.tools.radius import RadiusState, direction_of, place_of_block
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.compensation.cutter import CutterCompensation
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel


def hold_vector(channel: WordAddressChannel, words: Words) -> None:
    """G38: the vector at the end of the block in front is kept; with I J K it is square on that direction."""
    stage = _stage(channel, words, "G38")
    direction = direction_of(channel, words)
    if direction is None:
        stage.hold_vector()
    else:
        stage.forced_vector(direction)


def corner_arc(channel: WordAddressChannel, words: Words) -> None:
    """G39: an arc of the tool's radius about the corner; I J K give the direction on which it ends square."""
    _stage(channel, words, "G39").corner_arc(place_of_block(channel), direction_of(channel, words))


def compensate_left(channel: WordAddressChannel, words: Words) -> None:
    """G41 D [I J K]: left of the contour; with I J K the block ends square on that direction."""
    radius.compensate_left(channel, words)
    _force(channel, words)


def compensate_right(channel: WordAddressChannel, words: Words) -> None:
    """G42 D [I J K]."""
    radius.compensate_right(channel, words)
    _force(channel, words)


def _force(channel: WordAddressChannel, words: Words) -> None:
    direction, stage = direction_of(channel, words), radius.active_compensation(channel)
    if direction is not None and stage is not None:
        stage.forced_vector(direction)


def _stage(channel: WordAddressChannel, words: Words, code: str) -> CutterCompensation:
    stage = radius.active_compensation(channel)
    if stage is None or not RadiusState.of(channel).side:
        raise words.fail("comp_format", code)
    return stage
