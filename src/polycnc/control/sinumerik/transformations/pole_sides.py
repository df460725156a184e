"""TRANSMIT through the centre of turning: on which side of it the infeed axis goes on.

With MD24911 or MD24951 = 0 the infeed axis may go through the centre to its other side while the rotary axis stands.
So it does wherever that spares the rotary axis a turn: straight on, and at corners of less than 90 degrees; at sharper
ones it comes back on its own side. With 1 or 2 it keeps its side, and the rotary axis turns in the centre (6.8.1).
"""

from __future__ import annotations

from polycnc.channel.moves.pole import PoleStage, standing
from polycnc.control.sinumerik.couplings import links
from polycnc.control.sinumerik.transformations.seat import Transformations
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.transformation.chain import Chain
from polycnc.transformation.kinematic.polar import PolarPlane

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel


class PoleSides(PoleStage):
    """The stage of TRANSMIT.

    Args:
        channel: The channel.
    """

    def __init__(self, channel: SinumerikChannel) -> None:
        super().__init__(channel)
        self._own = channel

    @property
    def plane(self) -> PolarPlane | None:
        """The plane of TRANSMIT; None where that does not act."""
        return plane_of(self._own)

    @property
    def changes_sides(self) -> bool:
        """Whether MD24911 leaves the side free."""
        build = Transformations.of(self._own).build
        return build is not None and build.changes_sides

    def stand(self, side: float, pole_deg: float | None) -> None:
        """The infeed axis is on a side of the centre, and the rotary axis in it at an angle; nothing moves."""
        stand(self._own, side, pole_deg)


def plane_of(channel: SinumerikChannel) -> PolarPlane | None:
    """The polar plane of the transformation that acts; None for none."""
    build = Transformations.of(channel).build
    inner = build.inner if build is not None else None
    first = inner.links[0] if isinstance(inner, Chain) else inner
    return first if isinstance(first, PolarPlane) else None


def stand(channel: SinumerikChannel, side: float, pole_deg: float | None, turns_deg: float = 0.0) -> None:
    """The infeed axis is on a side of the centre, and the rotary axis in it at an angle; nothing moves.

    From here on the rotary axis counts `turns_deg` more, whole turns.
    """
    state, coordinates = Transformations.of(channel), channel.coordinates
    build, seated = state.build, state.seated
    assert build is not None
    assert seated is not None
    inner = standing(build.inner, side, pole_deg, turns_deg)
    if inner == build.inner:
        return
    state.build = replace(build, inner=inner)
    state.seated = replace(seated, inner=standing(seated.inner, side, pole_deg, turns_deg))
    links.take_seat(channel, state.seated)
    if coordinates.transformation is seated:
        coordinates.transformation = state.seated
    channel.context_changed()
