"""The stage of polar coordinate interpolation: where the rotary axis stands in the rotation centre."""

from __future__ import annotations

from polycnc.channel.moves.pole import PoleStage, standing
from polycnc.control.word_address.states import PolarState
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.transformation.kinematic.polar import PolarPlane


class PolarStage(PoleStage):
    """The stage of G12.1; the linear axis keeps its side."""

    @property
    def plane(self) -> PolarPlane | None:
        """The plane of G12.1; None while it is off."""
        return PolarState.of(self._channel).plane

    def stand(self, side: float, pole_deg: float | None) -> None:
        """The rotary axis stands at an angle in the centre; nothing moves."""
        channel, state = self._channel, PolarState.of(self._channel)
        if state.plane is not None and (state.plane.side, state.plane.pole_deg) != (side, pole_deg):
            state.plane = standing(state.plane, side, pole_deg)
            channel.coordinates.transformation = standing(channel.coordinates.transformation, side, pole_deg)
            channel.context_changed()
