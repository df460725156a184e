"""States that functions ask of each other, apart from the modules that change them."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.transformation.contract import Transformation


@dataclass(slots=True)
class PointToPoint(State, lifetime=Lifetime.RESET):
    """What a block that goes with the axes does.

    Attributes:
        turns: TU of the running block; None where it is not programmed.
        placed: Columns of the axes that the running block sends to a place.
        across: STAT = 1 was programmed, and no block has gone with the axes since: under TRANSMIT that goes to the
            other side of the centre.
        shown_by: What shows its end while it is written.
    """

    turns: int | None = None
    placed: frozenset[int] = frozenset()
    across: bool = False
    shown_by: Transformation | None = None
