"""Where the last path move came from: CT and smooth retraction go on in its direction."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.geometry.frames import Vector


class ArcOfMove(NamedTuple):
    """The arc that a move was: its centre, and the normal that it runs counter-clockwise about or against.

    Attributes:
        center: In work coordinates, mm.
        normal: Unit vector.
        sense: 1.0 for counter-clockwise about the normal, -1.0 for clockwise.
    """

    center: Vector
    normal: Vector
    sense: float


@dataclass(slots=True)
class LastMove(State, lifetime=Lifetime.RESET):
    """The last path move; it ends where the channel stands.

    Attributes:
        start: Position of all axes at its beginning; None where no direction is known.
        arc: None for a straight line; without a start it means nothing.
    """

    start: list[float] | None = None
    arc: ArcOfMove | None = None
