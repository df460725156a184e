"""Where tool tip control sits (G43.4, G43.5): what leads the axes while words name the tip, with the zero that acts.

The work zero lies behind it, for the tip turns with the table about an axis of the machine; a turn of the work system
lies in front. So both are put into it whenever they change.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass
from polycnc.geometry.frames import IDENTITY, Frame

if TYPE_CHECKING:
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.frames import Vector
    from polycnc.transformation.contract import Transformation
    from polycnc.transformation.couplings.coupled import Shown
    from polycnc.transformation.orientation.tool_centre import ToolCentrePoint


@dataclass(slots=True)
class TipState(State, lifetime=Lifetime.RESET):
    """What leads the axes while words name the tip; None while they name the axes.

    Attributes:
        active: It without a turn of the work.
        seated: It with that.
        begun: How the table had turned when tip control began, machine coordinates: there the system that it takes
            along is the work system.
        stands: Words name the tip in the work system, which does not turn; positions of the path lie on the table.
    """

    active: ToolCentrePoint | None = None
    seated: Transformation | None = None
    begun: Frame = IDENTITY
    stands: bool = False

    def is_leading(self, channel: WordAddressChannel) -> bool:
        """Whether words name the tip now."""
        return self.active is not None and channel.coordinates.transformation is self.seated

    @property
    def frame(self) -> Frame:
        """How the work system is turned against the axes."""
        from polycnc.transformation.seated import Seated

        return self.seated.frame if isinstance(self.seated, Seated) else IDENTITY

    def lies_at(self, frame: Frame, offsets: list[float]) -> bool:
        """Whether the work system is turned and shifted so already."""
        return self.active is not None and self.active.zero == tuple(offsets) and self.frame == frame


def lead(channel: WordAddressChannel, active: ToolCentrePoint, frame: Frame, offsets: list[float]) -> None:
    """Let words name the tip, in a work system that is turned by a frame and shifted by offsets; the machine stays."""
    from polycnc.transformation.seated import Seated

    state = TipState.of(channel)
    state.active = replace(active, zero=tuple(offsets))
    state.seated = state.active if frame.is_identity else Seated(state.active, frame)
    channel.coordinates.transform(state.seated, None, (IDENTITY, offsets), standing(channel))


def standing(channel: WordAddressChannel) -> Shown | None:
    """From the tip in a work system that does not turn to its places on the table; None where words name these."""
    from polycnc.transformation.couplings.coupled import Shown

    state = TipState.of(channel)
    if not state.stands or state.active is None or state.seated is None:
        return None
    return Shown(state.seated, replace(state.active, kinematics=replace(state.active.kinematics, work=())))


def direction(channel: WordAddressChannel, named: Vector) -> Vector:
    """A direction of the work system, as the axes see it."""
    return TipState.of(channel).frame.direct(*named)
