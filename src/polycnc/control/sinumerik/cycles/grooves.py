"""Grooves CYCLE93 and undercuts CYCLE94, CYCLE96 (strokes: `polycnc.cycles.turning.groove`).

Rectangular grooves on a cylinder are cut. Of the others, and of undercuts, the calls are checked and their cuts are
not made.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.cycles.turning import LIFT_MM
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tools.edges import DP_TIP
from polycnc.cycles.turning import groove as turning
from polycnc.cycles.turning.groove import Groove
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves

#: Forms of an undercut by cycle.
FORMS = {"CYCLE94": ("E", "F"), "CYCLE96": ("A", "B", "C", "D")}
#: Finished parts and threads of less have no undercut.
LEAST_DIAMETER_MM = 3.0
#: Cutting edge positions that can turn an undercut.
CORNERS = (1, 2, 3, 4)
#: VARI of CYCLE93: outside or inside, lengthwise or across, side of the start; 10 more for the other kind of chamfer.
GROOVES = (*range(1, 9), *range(11, 19))
#: Of these by the units of VARI: lengthwise, from the right side on, inside.
LENGTHWISE, FROM_RIGHT, INSIDE = (1, 3, 5, 7), (5, 7), (3, 7)
#: Parameters of a groove that is no rectangle on a cylinder.
SHAPED = ("STA1", "ANG1", "ANG2", "RCO1", "RCO2", "RCI1", "RCI2")
#: Length 2 of a turning tool lies along Z.
_ALONG_Z = 1
_ROUNDING = 1e-6


def undercut(moves: Moves, a: Arguments) -> None:
    """CYCLE94, CYCLE96: an undercut of a form.

    Raises:
        AlarmError: 61000 without tool offset, 61608 for a tool point that cannot, 61609 for a form that does not
            exist, 61601 for a diameter below 3 mm; else PC0001.
    """
    require_tool(moves)
    if a.text("FORM").strip().upper() not in FORMS[a.cycle]:
        raise AlarmError("61609", text=a.text("FORM"))
    edge = moves.memory.tools.edge
    if edge is None or int(edge.values[DP_TIP]) not in CORNERS:
        raise AlarmError("61608")
    diameter = 2.0 * a["SPD"] if a.cycle == "CYCLE94" else a["DIATH"]
    if diameter < LEAST_DIAMETER_MM - _ROUNDING:
        raise AlarmError("61601")
    raise not_supported(a.cycle)


def groove(moves: Moves, a: Arguments) -> None:
    """CYCLE93: a groove, with the two edges of a parting tool: the active one on its left, `_DN` or the next D.

    Raises:
        AlarmError: 61000 without tool offset, 61002 for VARI, 61602 for a tool without width or one that does not fit,
            61603 for a groove without width or depth; PC0001 for one that is no rectangle on a cylinder.
    """
    require_tool(moves)
    if a.integer("VARI") not in GROOVES:
        raise AlarmError("61002")
    if not abs(a["WIDG"]) or not abs(a["DIAG"]):
        raise AlarmError("61603")
    side = a.digit("VARI", 0)
    shaped = next((name for name in SHAPED if a.plain(name)), None)
    if side not in LENGTHWISE or shaped is not None:
        raise not_supported(f"CYCLE93 {shaped or 'VARI'}")
    shape = Groove(
        abs(a["WIDG"]),
        abs(a["DIAG"]),
        _tool_width(moves, a.integer("_DN")),
        base_allowance=abs(a["FAL1"]),
        flank_allowance=abs(a["FAL2"]),
        infeed=abs(a["IDEP"]),
        lift=a["_VRT"] if a["_VRT"] > 0.0 else LIFT_MM,
    )
    if not 0.0 < shape.tool_width <= shape.width - 2.0 * shape.flank_allowance + _ROUNDING:
        raise AlarmError("61602")
    if shape.base_allowance >= shape.depth:
        raise AlarmError("61603")
    _cut(moves, a, shape, side)


def _tool_width(moves: Moves, number: int) -> float:
    """From the active edge to the second one along Z; 61602 where there is none."""
    tools = moves.memory.tools
    first, second = tools.edge, tools.edges.get(number or tools.edge_number + 1)
    if first is None or second is None:
        raise AlarmError("61602")
    return abs(second.length(_ALONG_Z) - first.length(_ALONG_Z))


def _cut(moves: Moves, a: Arguments, shape: Groove, side: int) -> None:
    """The strokes of a groove as moves of the tool's left edge, and back to where the cycle began."""
    home, feed = moves.point, moves.channel.feed
    inwards = 1.0 if side in INSIDE else -1.0
    for stroke in turning.strokes(shape):
        if stroke.end is None:
            moves.dwell(a["DTB"])
            continue
        w, t = stroke.end
        z = a["SPL"] - w - shape.tool_width if side in FROM_RIGHT else a["SPL"] + w
        radius = a["SPD"] + inwards * t
        if stroke.is_rapid:
            moves.rapid(z, radius)
        else:
            moves.feed(feed, z, radius)
        moves.end_block()
    moves.rapid(*home)
    moves.end_block()
