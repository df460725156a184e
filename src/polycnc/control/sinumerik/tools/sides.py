"""What words say of a compensated contour: side, allowance, depth, DISC."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass
from polycnc.geometry.frames import IDENTITY, Matrix

SIDES = {"G41": 1, "G42": -1}
#: Functions of group 22 that compensate a face mill in space: dimensions act with G41 and G42, lengths at once (7.5.3).
FACES = frozenset(("CUT3DF", "CUT3DFS", "CUT3DFF"))


@dataclass(slots=True)
class Contour(State, lifetime=Lifetime.POWER):
    """What words say of the compensated contour.

    Attributes:
        allowance_mm: OFFN.
        depth_mm: ISD.
        disc: DISC, 0 to 100.
        linear: Rotation, scale and mirror of the frames under which compensation began.
    """

    allowance_mm: float = 0.0
    depth_mm: float = 0.0
    disc: float = 0.0
    linear: Matrix = IDENTITY.m
