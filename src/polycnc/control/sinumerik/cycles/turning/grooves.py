"""Grooves CYCLE93 (strokes: `polycnc.cycles.turning.groove`)."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.cycles.turning.work import LIFT_MM
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tools import stages
from polycnc.cycles.turning import groove as turning
from polycnc.cycles.turning.groove import Corner, Groove, GrooveError, Side
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.cycles.turning.groove import GrooveStroke
    from polycnc.geometry.arcs import Point

#: VARI of CYCLE93: outside or inside, lengthwise or across, side of the start; 10 more for the other kind of chamfer.
GROOVES = (*range(1, 9), *range(11, 19))
#: From here on a chamfer is told by what it leaves out of its edges.
CHAMFERS_BY_LEG = 10
#: Flanks lean less than this, degrees.
UPRIGHT = 89.999


class Seat(NamedTuple):
    """Where a groove lies: on a cylinder or on a face; which way its width goes from the start, and its depth."""

    across: bool
    onwards: float
    inwards: float


#: By the units of VARI: lengthwise outside, across outside, lengthwise inside, across inside; start left, then right.
#: On a face the start lies outside or inside, and the face is the left or the right one.
SEATS = {
    1: Seat(across=False, onwards=1.0, inwards=-1.0),
    2: Seat(across=True, onwards=-1.0, inwards=1.0),
    3: Seat(across=False, onwards=1.0, inwards=1.0),
    4: Seat(across=True, onwards=1.0, inwards=1.0),
    5: Seat(across=False, onwards=-1.0, inwards=-1.0),
    6: Seat(across=True, onwards=-1.0, inwards=-1.0),
    7: Seat(across=False, onwards=-1.0, inwards=1.0),
    8: Seat(across=True, onwards=1.0, inwards=-1.0),
}
#: Length 1 of a turning tool lies along X, length 2 along Z.
_ALONG_X, _ALONG_Z = 0, 1
_ROUNDING = 1e-6


def groove(moves: Moves, a: Arguments) -> None:
    """CYCLE93: a groove, with the two edges of a parting tool: the active one and `_DN` or the next D.

    Raises:
        AlarmError: 61000 without tool offset, 61002 for VARI, 61602 for a tool without width or one that does not fit,
            61603 for a groove without width or depth or whose corners do not fit; PC0001 for one on a slanted contour.
    """
    require_tool(moves)
    if a.integer("VARI") not in GROOVES:
        raise AlarmError("61002")
    if not abs(a["WIDG"]) or not abs(a["DIAG"]):
        raise AlarmError("61603")
    if a["STA1"]:
        raise not_supported("CYCLE93 STA1")
    if not all(0.0 <= a[name] < UPRIGHT for name in ("ANG1", "ANG2")):
        raise AlarmError("61603")
    seat = SEATS[a.digit("VARI", 0)]
    shape = Groove(
        abs(a["WIDG"]),
        abs(a["DIAG"]),
        _tool_width(moves, a.integer("_DN"), _ALONG_X if seat.across else _ALONG_Z),
        base_allowance=abs(a["FAL1"]),
        flank_allowance=abs(a["FAL2"]),
        infeed=abs(a["IDEP"]),
        lift=a["_VRT"] if a["_VRT"] > 0.0 else LIFT_MM,
        sides=(_side(a, 1), _side(a, 2)),
        nose_radius=stages.radius(moves.channel),
    )
    if not 0.0 < shape.tool_width <= shape.width - 2.0 * shape.flank_allowance + _ROUNDING:
        raise AlarmError("61602")
    if shape.base_allowance >= shape.depth:
        raise AlarmError("61603")
    try:
        way = list(turning.strokes(shape))
    except GrooveError:
        raise AlarmError("61603") from None
    _cut(moves, a, shape, seat, way)


def _side(a: Arguments, number: int) -> Side:
    """A side of the groove: its flank angle, its corner outside (RCO) and inside (RCI)."""
    return Side(a[f"ANG{number}"], _corner(a, f"RCO{number}"), _corner(a, f"RCI{number}"))


def _corner(a: Arguments, name: str) -> Corner:
    """A radius above 0, a chamfer below: by its length, or with VARI above 10 by what it leaves out."""
    size = a[name]
    if size >= 0.0:
        return Corner(radius=size)
    return Corner(leg=-size) if a.integer("VARI") >= CHAMFERS_BY_LEG else Corner(length=-size)


def _tool_width(moves: Moves, number: int, length: int) -> float:
    """From the active edge to the second one along Z or X; 61602 where there is none."""
    tools = moves.memory.tools
    first, second = tools.edge, tools.edges.get(number or tools.edge_number + 1)
    if first is None or second is None:
        raise AlarmError("61602")
    return abs(second.length(length) - first.length(length))


def _cut(moves: Moves, a: Arguments, shape: Groove, seat: Seat, way: list[GrooveStroke]) -> None:
    """The strokes of a groove as moves of the tool's active edge, and back to where the cycle began."""
    home, feed = moves.point, moves.channel.feed
    start = (a["SPD"], a["SPL"]) if seat.across else (a["SPL"], a["SPD"])

    def placed(point: Point) -> Point:
        w, t = point
        along = start[0] + (w if seat.onwards > 0.0 else -w - shape.tool_width)
        deep = start[1] + seat.inwards * t
        return (deep, along) if seat.across else (along, deep)

    mirrors = (seat.onwards * seat.inwards < 0.0) is not seat.across
    for stroke in way:
        if stroke.end is None:
            moves.dwell(a["DTB"])
            continue
        end = placed(stroke.end)
        if stroke.is_rapid:
            moves.rapid(*end)
        elif stroke.center is None:
            moves.feed(feed, *end)
        else:
            center = placed(stroke.center)
            moves.arc(feed, end, center, stroke.ccw is not mirrors)
        moves.end_block()
    moves.rapid(*home)
    moves.end_block()
