"""The stage of the path for COMPON, COMPCURV and COMPCAD (4.4): what they allow stands in the context of each move."""

from __future__ import annotations

from polycnc.channel.moves.fairing import FairingStage
from polycnc.control.sinumerik.limits import protection
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel


class Compressor(FairingStage):
    """Holds cuts back while a compressor is on."""

    def __init__(self, channel: SinumerikChannel) -> None:
        super().__init__(channel)
        self._modal = channel

    def _watches(self) -> bool:
        """Whether anything is forbidden beside walls: protection zones are, too."""
        return super()._watches() or protection.is_watched(self._modal)

    def _comes_near(self, start: list[float], end: list[float], distance: float) -> bool:
        """Whether a way of machine positions comes nearer than a distance to what is forbidden beside walls."""
        near_zone = protection.is_watched(self._modal) and protection.comes_near(
            self._modal, start, end, distance
        )
        return near_zone or super()._comes_near(start, end, distance)

    @property
    def active(self) -> bool:
        """Whether the next cut may be held back."""
        return super().active or self._modal.mode["compressor"] != "COMPOF"
