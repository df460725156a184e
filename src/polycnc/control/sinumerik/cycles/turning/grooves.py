"""Grooves CYCLE93, CYCLE930 (strokes: `polycnc.cycles.turning.groove`)."""

from __future__ import annotations

from math import dist, radians, tan

from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.cycles.turning.work import LIFT_MM
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tools import stages
from polycnc.cycles.turning import groove as turning
from polycnc.cycles.turning.groove import Corner, Groove, GrooveError, Side
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
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
#: A contour across the work stands so on its axis, where STA1 is told, degrees.
SQUARE = 90.0


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
        AlarmError: 61000 without tool offset, 61002 for VARI, 61003 without feed, 61602 for a tool without width or one
            that does not fit, 61603 for a groove without width or depth or whose corners do not fit, 61608 for an edge
            that looks another way.
    """
    require_tool(moves)
    if a.integer("VARI") not in GROOVES:
        raise AlarmError("61002")
    if not abs(a["WIDG"]) or not abs(a["DIAG"]):
        raise AlarmError("61603")
    if not all(0.0 <= a[name] < UPRIGHT for name in ("ANG1", "ANG2")):
        raise AlarmError("61603")
    seat = SEATS[a.digit("VARI", 0)]
    require_edge(moves, across=seat.across, inwards=seat.inwards)
    shape = Groove(
        abs(a["WIDG"]),
        abs(a["DIAG"]),
        tool_width(moves, a.integer("_DN"), _ALONG_X if seat.across else _ALONG_Z),
        base_allowance=abs(a["FAL1"]),
        flank_allowance=abs(a["FAL2"]),
        infeed=abs(a["IDEP"]),
        lift=a["_VRT"] if a["_VRT"] > 0.0 else LIFT_MM,
        sides=(_side(a, 1), _side(a, 2)),
        nose_radius=stages.radius(moves.channel),
        slope=_slope(seat, a["STA1"]),
    )
    home, feed, way = moves.point, moves.channel.feed, _strokes(shape)
    if not feed > 0.0:
        raise AlarmError("61003")
    start = (a["SPD"], a["SPL"]) if seat.across else (a["SPL"], a["SPD"])
    _cut(moves, way, Placing(shape, seat, start), feed, a["DTB"])
    moves.rapid(*home)
    moves.end_block()


def _slope(seat: Seat, angle: float) -> float:
    """How a groove's depth grows along it on a contour that stands at an angle to Z; 0 or left out: along its axis."""
    if not angle:
        return 0.0
    return tan(radians(SQUARE - angle if seat.across else angle)) * seat.onwards * seat.inwards


def _strokes(shape: Groove) -> list[GrooveStroke]:
    """The strokes of a groove; 61602 and 61603 for a tool and corners that do not fit."""
    if not 0.0 < shape.tool_width <= shape.width - 2.0 * shape.flank_allowance + _ROUNDING:
        raise AlarmError("61602")
    if shape.base_allowance >= shape.depth:
        raise AlarmError("61603")
    try:
        return list(turning.strokes(shape))
    except GrooveError:
        raise AlarmError("61603") from None


def _side(a: Arguments, number: int) -> Side:
    """A side of the groove: its flank angle, its corner outside (RCO) and inside (RCI)."""
    return Side(a[f"ANG{number}"], _corner(a, f"RCO{number}"), _corner(a, f"RCI{number}"))


def _corner(a: Arguments, name: str) -> Corner:
    """A radius above 0, a chamfer below: by its length, or with VARI above 10 by what it leaves out."""
    size = a[name]
    if size >= 0.0:
        return Corner(radius=size)
    return Corner(leg=-size) if a.integer("VARI") >= CHAMFERS_BY_LEG else Corner(length=-size)


def require_edge(moves: Moves, *, across: bool, inwards: float) -> None:
    """61608 for an active edge with a nose that is not the tool's corner towards smaller positions, and the base."""
    along, deep = stages.tip(moves.channel)
    if across:
        along, deep = deep, along
    if stages.radius(moves.channel) > _ROUNDING and dist((along, deep), (-1.0, inwards)) > _ROUNDING:
        raise AlarmError("61608")


def tool_width(moves: Moves, number: int, length: int) -> float:
    """From the active edge to the second one along Z or X; 61602 where there is none."""
    tools = moves.memory.tools
    first, second = tools.edge, tools.edges.get(number or tools.edge_number + 1)
    if first is None or second is None:
        raise AlarmError("61602")
    return abs(second.length(length) - first.length(length))


class Placing(NamedTuple):
    """Where the points of a groove lie in the plane: its seat, and its first edge as (along, deep)."""

    shape: Groove
    seat: Seat
    start: Point

    def point(self, point: Point) -> Point:
        """A point of the tool's active edge in the plane."""
        w, t = point
        seat = self.seat
        along = self.start[0] + (w if seat.onwards > 0.0 else -w - self.shape.tool_width)
        deep = self.start[1] + seat.inwards * t
        return (deep, along) if seat.across else (along, deep)

    @property
    def mirrors(self) -> bool:
        """Whether arcs turn the other way."""
        return (self.seat.onwards * self.seat.inwards < 0.0) is not self.seat.across


def _cut(moves: Moves, way: list[GrooveStroke], placing: Placing, feed: float, dwell: float) -> None:
    """The strokes of a groove as moves of the tool's active edge."""
    for stroke in way:
        if stroke.end is None:
            moves.dwell(dwell)
            continue
        end = placing.point(stroke.end)
        if stroke.is_rapid:
            moves.rapid(*end)
        elif stroke.center is None:
            moves.feed(feed, *end)
        else:
            moves.arc(feed, end, placing.point(stroke.center), stroke.ccw is not placing.mirrors)
        moves.end_block()


# ---- grooves of the editor

#: Digits of _VARI of CYCLE930: nothing, stage, seat, place of the reference point, allowances along each axis.
_STAGE, _SEAT, _REFERENCE, _ALLOWANCES = 1, 2, 3, 4
ROUGHING, FINISHING, COMPLETE = 1, 2, 3
#: _ALLOWANCES: `_FAL` along the contour, or `_FALX` and `_FALZ`.
EVEN, ODD = 0, 1
#: Two plunges are at most this share of the tool's width apart.
STEP = 0.8
#: Corners as they stand in the call, at the rim and at the base where it begins, then on the other side, and the digits
#: of _AMODE that make chamfers of them. In front of these stand those of the depths, and what the width is told for.
CORNERS = ((("_RCO1", 3), ("_RCI1", 4)), (("_RCO2", 6), ("_RCI2", 5)))
_DEPTH, _OTHER_DEPTH, _WIDTH = 0, 1, 2
#: Forms by _NR: a rectangle, one with leaning walls and corners, the same on a slanted contour.
RECTANGLE, SHAPED, ON_CONE = 0, 1, 2
#: Sizes that the mask shows beside others are rounded by less, mm.
_SHOWN_MM = 2e-3


def grooves(moves: Moves, a: Arguments) -> None:
    """CYCLE930: a groove or a row of equal ones, roughed, finished or both.

    Raises:
        AlarmError: 61000 without tool offset, 61002 for `_VARI`, 61003 without feed, 61602 for a tool without width or
            one that does not fit, 61603 for a groove without width or depth or whose corners do not fit, 61608 for an
            edge that looks another way; PC0001 for one that is told from its base, and for sizes that contradict
            each other.
    """
    require_tool(moves)
    number, stage = a.digit("_VARI", _SEAT), a.digit("_VARI", _STAGE)
    if number not in SEATS or not ROUGHING <= stage <= COMPLETE or a.integer("_VARI") < 0:
        raise AlarmError("61002")
    seat, feed = SEATS[number], abs(a["_FF1"])
    if not feed:
        raise AlarmError("61003")
    require_edge(moves, across=seat.across, inwards=seat.inwards)
    shape = _of_mask(moves, a, seat, stage)
    way = _strokes(shape)
    _refuse(a, shape, seat)
    start = (a["_SPD"], a["_SPL"]) if seat.across else (a["_SPL"], a["_SPD"])
    # A row lies along its contour.
    along, deep = a["_DBH"], a["_DBH"] * shape.slope * seat.onwards * seat.inwards
    for k in range(max(a.integer("_NUM"), 1)):
        placing = Placing(shape, seat, (start[0] + k * along, start[1] + k * deep))
        _approach(moves, placing, way)
        _cut(moves, way, placing, feed, 0.0)


def _of_mask(moves: Moves, a: Arguments, seat: Seat, stage: int) -> Groove:
    """The groove of a call; 61603 for one without width or depth, or leaning walls beyond upright."""
    form = _form(a)
    if form != RECTANGLE and not all(0.0 <= a[name] < UPRIGHT for name in ("_ANG1", "_ANG2")):
        raise AlarmError("61603")
    depth = abs(a["_DIAG"])
    if a.digit("_AMODE", _DEPTH) == 0:
        base = a["_DIAG"] * (1.0 if seat.across else 0.5)
        depth = (base - a["_SPL" if seat.across else "_SPD"]) * seat.inwards
    if depth <= 0.0 or not abs(a["_WIDG"]):
        raise AlarmError("61603")
    deep, aside = ("_FALZ", "_FALX") if seat.across else ("_FALX", "_FALZ")
    roughs, even = stage != FINISHING, a["_FAL"] if a.digit("_VARI", _ALLOWANCES) == EVEN else 0.0
    sides = [
        Side(a[f"_ANG{number}"], _broken(a, *rim), _broken(a, *base))
        for number, (rim, base) in enumerate(CORNERS, 1)
        if form != RECTANGLE
    ] or [Side(), Side()]
    return Groove(
        abs(a["_WIDG"]),
        depth,
        tool_width(moves, a.integer("_DN"), _ALONG_X if seat.across else _ALONG_Z),
        base_allowance=abs(even or a[deep]) if roughs else 0.0,
        flank_allowance=abs(even or a[aside]) if roughs else 0.0,
        infeed=abs(a["_IDEP1"]),
        lift=abs(a["_SDIS"]) or LIFT_MM,
        sides=(sides[0], sides[1]),
        nose_radius=stages.radius(moves.channel),
        step=STEP,
        alternates=True,
        roughs=roughs,
        finishes=None if stage == COMPLETE else not roughs,
        slope=_slope(seat, a["_STA"]) if form == ON_CONE else 0.0,
    )


def _form(a: Arguments) -> int:
    """Which mask the call is from; what another one shows may be left over from it, and does not count."""
    return a.integer("_NR") if a.given("_NR") else ON_CONE


def _broken(a: Arguments, name: str, digit: int) -> Corner:
    """A corner of the mask: a radius, or a chamfer by what it leaves out."""
    size = abs(a[name])
    return Corner(leg=size) if a.digit("_AMODE", digit) else Corner(radius=size)


def _refuse(a: Arguments, shape: Groove, seat: Seat) -> None:
    """What is not executed, or contradicts itself."""
    even, odd = abs(a["_FAL"]), (abs(a["_FALX"]), abs(a["_FALZ"]))
    depth = abs(a["_DIAG"])
    # Told as a position, the base lies elsewhere at the other end of a slope.
    other = a["_DIAG"] + seat.inwards * shape.slope * shape.top * (1.0 if seat.across else 2.0)
    unknown = {
        "_WIDG2": bool(a["_WIDG2"]) and abs(abs(a["_WIDG2"]) - shape.top) > _SHOWN_MM,
        "_DIAG2": bool(a["_DIAG2"])
        and min(abs(abs(a["_DIAG2"]) - of) for of in (depth, abs(other))) > _SHOWN_MM,
        "_FAL": a.digit("_VARI", _ALLOWANCES) == EVEN and bool(even and any(odd)) and odd != (even, even),
        "_VARI": a.digit("_VARI", 0) != 0
        or a.digit("_VARI", _REFERENCE) != 0
        or a.integer("_VARI") >= (ODD + 1) * 10**_ALLOWANCES,
        "_NR": not RECTANGLE <= _form(a) <= ON_CONE,
        "_AMODE": a.digit("_AMODE", _DEPTH) > 1
        or a.digit("_AMODE", _OTHER_DEPTH) > 1
        or (a.digit("_AMODE", _WIDTH) != 0 and any(shape.feet) and not a["_WIDG2"])
        or any(a.digit("_AMODE", digit) > 1 for pair in CORNERS for _, digit in pair),
        "_NUM": a.integer("_NUM") > 1 and not a["_DBH"],
    }
    for name, wrong in unknown.items():
        if wrong:
            raise not_supported(f"CYCLE930 {name}")


def _approach(moves: Moves, placing: Placing, way: list[GrooveStroke]) -> None:
    """Over the first place of a groove, axis by axis: out to the safety distance first, never down."""
    first = next(stroke.end for stroke in way if stroke.end is not None)
    over = placing.point((first[0], placing.shape.over))
    across = placing.seat.across
    deep = 0 if across else 1
    here = moves.point
    if (here[deep] - over[deep]) * placing.seat.inwards > 0.0:
        moves.rapid(*((over[0], None) if across else (None, over[1])))
        moves.end_block()
    moves.rapid(*((None, over[1]) if across else (over[0], None)))
    moves.end_block()
