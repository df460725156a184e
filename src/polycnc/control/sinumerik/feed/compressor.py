"""The stage of the path for COMPON, COMPCURV and COMPCAD (4.4): what they allow stands in the context of each move."""

from __future__ import annotations

from polycnc.channel.moves.fairing import FairingStage
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel


class Compressor(FairingStage):
    """Holds cuts back while a compressor is on."""

    def __init__(self, channel: SinumerikChannel) -> None:
        super().__init__(channel)
        self._modal = channel

    @property
    def active(self) -> bool:
        """Whether the next cut may be held back."""
        return super().active or self._modal.mode["compressor"] != "COMPOF"
