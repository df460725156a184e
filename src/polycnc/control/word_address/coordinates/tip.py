"""Where tool tip control sits (G43.4, G43.5): what leads the axes while words name the tip, with the zero that acts.

The work zero lies behind it, for the tip turns with the table about an axis of the machine; a turn of the work system
lies in front. So both are put into it whenever they change.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame

if TYPE_CHECKING:
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.frames import Vector
    from polycnc.toolpath import Context
    from polycnc.transformation.contract import Transformation
    from polycnc.transformation.couplings.coupled import Shown
    from polycnc.transformation.orientation.tool_centre import ToolCentrePoint

#: Codes of tip control.
TIP_CODES = ("G43.4", "G43.5")


@dataclass(slots=True)
class TipState(State, lifetime=Lifetime.RESET):
    """What leads the axes while words name the tip; None while they name the axes.

    Attributes:
        active: It without a turn of the work.
        seated: It with that.
        begun: How the table had turned when tip control began, machine coordinates: there the system that it takes
            along is the work system.
        stands: Words name the tip in the work system, which does not turn; positions of the path lie on the table.
        told: What would lead the axes if the work lay where it should, by which words are read then.
        beside: How far words tell each axis beyond where it stands, on a work that lies elsewhere; empty for nowhere.
    """

    active: ToolCentrePoint | None = None
    seated: Transformation | None = None
    begun: Frame = IDENTITY
    stands: bool = False
    told: Transformation | None = None
    beside: tuple[float, ...] = ()

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


def lead(
    channel: WordAddressChannel,
    active: ToolCentrePoint,
    frame: Frame,
    offsets: list[float],
    told: Frame | None = None,
) -> None:
    """Let words name the tip, in a work system that is turned by a frame and shifted by offsets; the machine stays.

    `told` is that frame on a work that lies where it should; None for the same.
    """
    from polycnc.transformation.seated import Seated

    state = TipState.of(channel)
    state.active = replace(active, zero=tuple(offsets))
    state.seated = state.active if frame.is_identity else Seated(state.active, frame)
    state.told = state.seated if told is None else Seated(state.active, told)
    channel.coordinates.transform(state.seated, None, (IDENTITY, offsets), standing(channel))


def displayed(channel: WordAddressChannel, context: Context) -> Context:
    """A context while words name points of another system than that of the path: displays show them there."""
    naming = channel.coordinates.naming
    return context if naming is None else replace(context, shown_by=naming)


def standing(channel: WordAddressChannel) -> Shown | None:
    """From the tip in a work system that does not turn to its places on the table; None where words name these."""
    state = TipState.of(channel)
    if not state.stands or state.active is None or state.told is None:
        return None
    return standing_before(state.active, state.told, state.beside)


def standing_before(active: ToolCentrePoint, told: Transformation, beside: tuple[float, ...]) -> Shown:
    """The same for what leads the axes, and would lead them if the work lay where it should."""
    from polycnc.transformation.couplings.coupled import Shown

    return Shown(told, replace(active, kinematics=replace(active.kinematics, work=())), beside)


def direction(channel: WordAddressChannel, named: Vector) -> Vector:
    """A direction of the work system, as the axes see it."""
    return TipState.of(channel).frame.direct(*named)
