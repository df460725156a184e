"""POLYPATH: what polynomials are for, axes and the direction of the tool (job planning 4.5)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.arguments import Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel

AXES, DIRECTION = GROUPS = ("AXES", "VECT")


@dataclass(slots=True)
class PolynomialGroups(State, lifetime=Lifetime.POWER):
    """Groups whose polynomials act; those of other groups count as a straight line."""

    acting: tuple[str, ...] = GROUPS


def select(channel: SinumerikChannel, args: tuple[Any, ...]) -> None:
    """POLYPATH("AXES", "VECT"): which axes coefficients are for; none without arguments."""
    if any(group not in GROUPS for group in args):
        raise AlarmError("14020", text="POLYPATH")
    PolynomialGroups.of(channel).acting = args


PROCEDURES: dict[str, Procedure] = {"POLYPATH": select}
