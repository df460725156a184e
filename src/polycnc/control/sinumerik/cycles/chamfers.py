"""Chamfers of milling cycles (VARI 5): a cone of 45 degrees breaks the edge of what is milled already.

The tip of the tool goes to `_ZFS` below the face, the chamfer is `_FS` wide. Where the cone meets the wall, at the foot
of the chamfer, it is wider than the tip by as much as the tip lies deeper; a cutter of that radius would follow the
wall on the same path.
"""

from __future__ import annotations

from polycnc.control.sinumerik.cycles.levels import Levels, levels, sign
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tools.edges import DP_CLEARANCE, DP_SIDE_ANGLE
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves

#: Units of VARI.
CHAMFER = 5
#: Place of the digit of _AMODE that says how _ZFS counts, and the one for a way below the face.
_ZFS_PLACE, BELOW_FACE = 2, 1
#: Drills, whose radius is that of the shank: their cone begins in a point, and $TC_DP24 is the angle of it.
DRILLS = range(200, 300)
DP_TIP_ANGLE, SQUARE_TIP = DP_CLEARANCE, 90.0
#: Side angle of conical mills, from their axis.
SIDE_ANGLE = 45.0


class Chamfer(NamedTuple):
    """How a chamfer is milled: the radius that meets the wall, and the levels, with the tool's tip as the depth."""

    radius: float
    levels: Levels


def is_chamfer(a: Arguments, name: str) -> bool:
    """Whether a call asks for a chamfer."""
    return a.digit(name, 0) == CHAMFER and a.has("_ZFS")


def chamfer(moves: Moves, a: Arguments) -> Chamfer:
    """The chamfer of a call.

    Raises:
        AlarmError: 61101 for a tip that lies above the foot of the chamfer or below the base, 61105 for a cone that is
            too short, 61112 for a negative radius, 61118 for a chamfer without width; PC0001 for another cone.
    """
    retract, reference, size = a["RTP"], a["RFP"], abs(a["_FS"])
    if not size:
        raise AlarmError("61118")
    base = levels(moves, a)
    up = sign(retract - reference) or (-base.down if base is not None else 1.0)
    tip = abs(a["_ZFS"]) if a.digit("_AMODE", _ZFS_PLACE) == BELOW_FACE else (reference - a["_ZFS"]) * up
    deepest = abs(base.depth - base.reference) if base is not None else tip
    if not size - NO_WAY <= tip <= deepest + NO_WAY:
        raise AlarmError("61101")
    safe = reference + up * abs(a["SDIS"])
    return Chamfer(_tip(moves, tip) + tip - size, Levels(retract, reference, safe, reference - up * tip))


def _tip(moves: Moves, depth: float) -> float:
    """Radius of the tool at its tip."""
    tools = moves.memory.tools
    if tools.edge is None:
        raise AlarmError("61000")
    values, radius = tools.edge.values, tools.radius
    if radius < 0.0:
        raise AlarmError("61112")
    if tools.edge.type not in DRILLS:
        if values[DP_SIDE_ANGLE] not in (0.0, SIDE_ANGLE):
            raise not_supported("$TC_DP11")
        return radius
    if values[DP_TIP_ANGLE] != SQUARE_TIP:
        raise not_supported("$TC_DP24")
    if 0.0 < radius < depth - NO_WAY:
        raise AlarmError("61105")
    return 0.0
