"""Levels of drilling and milling cycles: RTP, RFP, SDIS, DP and DPR as positions on the axis of the cycle."""

from __future__ import annotations

from polycnc.cycles.drilling.holes import Hole
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves


def sign(value: float) -> float:
    """1, -1 or 0."""
    return 1.0 if value > 0.0 else -1.0 if value < 0.0 else 0.0


class Levels(NamedTuple):
    """Levels of a cycle on its axis: retraction plane, reference plane, safety plane, depth; mm."""

    retract: float
    reference: float
    safe: float
    depth: float

    @property
    def down(self) -> float:
        """The direction of drilling."""
        return 1.0 if self.depth > self.reference else -1.0

    def hole(self, dwell: float = 0.0) -> Hole:
        """The same as the strokes want it."""
        return Hole(self.retract, self.safe, self.depth, self.retract, dwell_s=dwell)


def levels(moves: Moves, a: Arguments) -> Levels | None:
    """Levels from RTP, RFP, SDIS and a depth; None where the depth is the reference plane: nothing to do.

    The relative depth counts where it is given, else the absolute one; _AMODE can demand either. A cycle that has
    only DP takes that as either.

    Raises:
        AlarmError: 61101 for a reference plane that does not lie between retraction plane and depth.
    """
    retract, reference = a["RTP"], a["RFP"]
    mode = a.digit("_AMODE", 0)
    amount = abs(a["DPR" if a.has("DPR") or mode != 1 else "DP"])
    if mode == 1 or (mode != 2 and amount):
        if amount and retract == reference:
            raise AlarmError("61101")
        if mode == 0 and a.given("DP") and a["DP"] != reference - sign(retract - reference) * amount:
            moves.note("62000")
        depth = reference - sign(retract - reference) * amount
    else:
        depth = a["DP"]
    if depth == reference:
        return None
    up = sign(reference - depth)
    if retract != reference and sign(retract - reference) != up:
        raise AlarmError("61101")
    return Levels(retract, reference, reference + up * abs(a["SDIS"]), depth)
