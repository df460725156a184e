"""Plain blocks of SYNTEC ISO programs, for the scanner."""

from __future__ import annotations

from polycnc.control.syntec.motion.arcs import ArcState
from polycnc.control.word_address.block.plain import PlainBlocks
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import Spelling
from polycnc.language.syntec.blocks import MAX_DIGITS

if TYPE_CHECKING:
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.language.bulk.scanner import LastMoves

SPELLING = Spelling(
    MAX_DIGITS,
    round_comments=True,
    starred_comments=True,
    slash_comments=True,
    hexadecimal=True,
    m_codes=True,
)


class SyntecPlainBlocks(PlainBlocks):
    """What the scanner asks of a SYNTEC control."""

    def __init__(self) -> None:
        super().__init__(SPELLING)

    def moved(self, channel: WordAddressChannel, last: LastMoves) -> None:
        """The centre of the last arc can be read as a system variable."""
        if last.center is not None:
            ArcState.of(channel).last_center = last.center
