"""The stage of the path for G05 and G05.1 Q1 (2.9, 2.10): what they allow stands in the context of each move."""

from __future__ import annotations

from polycnc.channel.moves.fairing import FairingStage
from polycnc.control.syntec.motion.smoothing import SmoothingState
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.toolpath import Context


class Smoother(FairingStage):
    """Holds cuts back while their ends may be moved."""

    def __init__(self, channel: SyntecChannel) -> None:
        super().__init__(channel)
        self._state = SmoothingState.of(channel)

    @property
    def active(self) -> bool:
        """Whether the next cut may be held back."""
        return super().active or self._state.leaves_points

    def _terms_of(self, context: Context) -> tuple[object, ...]:
        """The programming frame too: behind a code that moves coordinates the next cut is led as programmed (2.9.3)."""
        return *super()._terms_of(context), self._channel.coordinates.programming
