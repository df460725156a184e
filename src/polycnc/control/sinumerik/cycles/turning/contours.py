"""Contour turning CYCLE952: the contour of CYCLE62 out of its blank (cuts: `polycnc.cycles.turning.stock_removal`).

Source: SINUMERIK Operate, contour turning (stock removal); parameter lists of the externally programmed cycles.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING

from polycnc.control.sinumerik.cycles.contours.reading import read_chosen
from polycnc.control.sinumerik.cycles.milling import feed_of
from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.cycles.turning.work import LIFT_MM, Work, finish, onwards
from polycnc.control.sinumerik.errors import not_supported
from polycnc.cycles.turning import outline
from polycnc.cycles.turning.allowance import with_stock
from polycnc.cycles.turning.contour import Contour, Piece, turned_round
from polycnc.cycles.turning.stock_removal import Removal, blank, remove, sections
from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.deferred.records import dataclass
from polycnc.geometry import offset
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.geometry.arcs import Point

#: Digits of _VARI: kind of cuts, stage, direction of the cuts, of the infeed, allowance, rounding, reliefs.
KIND, STAGE, CUTS, INFEED, ALLOWANCE, ROUNDING, RELIEFS = range(7)
LENGTHWISE, ACROSS, PARALLEL = 1, 2, 3
ROUGHING, FINISHING, COMPLETE = 1, 2, 3
#: Axis and sign of a direction: X-, X+, Z-, Z+.
DIRECTIONS = {1: ("X", -1.0), 2: ("X", 1.0), 3: ("Z", -1.0), 4: ("Z", 1.0)}
#: Allowances along both axes, or one all along the contour.
BY_AXES, ALONG_CONTOUR = 0, 1
WITHOUT_ROUNDING, LAST_ROUNDING = 2, 3
#: What the blank is.
CYLINDER, SWOLLEN, CONTOUR = 1, 2, 3
#: Digits of _AMODE: cuts at the edges, allowance U1, values of the blank that count from the contour.
AT_EDGES, WITH_U1, XD_RELATIVE, ZD_RELATIVE = 2, 3, 5, 6
#: Digits of _GMODE: what is done, whether there are limits; of _DMODE: technology, residual material.
ONLY_START, HAS_LIMITS = 2, 3
TECHNOLOGY, RESIDUAL = 1, 2
STOCK_REMOVAL = (0, 1)
LIMITS = ("_XA", "_XB", "_ZA", "_ZB")
_HAIR = 1e-6


@dataclass(frozen=True, slots=True)
class Turning:
    """What a call turns, in the coordinates of the cuts.

    Attributes:
        part: The finished contour, in the direction of the cuts.
        front, top: Where the blank begins along the cuts, and against the infeed.
        stock: Outline of a blank that is no cylinder.
        lift: Distance off the work.
    """

    part: Contour
    front: float
    top: float
    stock: Contour | None
    lift: float


def turn(moves: Moves, a: Arguments) -> None:
    """CYCLE952: rough, finish or both, lengthwise or across, outside or inside.

    Raises:
        AlarmError: 61000 without tool offset, 61002 for `_VARI`, 61003 without feed, 61101 for a retraction plane
            inside of the stock, 61605 for contours that are too few, 61606 for what cannot be followed, 61608 for a
            tool that looks away from the work, 61610 for roughing without depth of cut; PC0001 for what is not
            executed.
    """
    require_tool(moves)
    kind = a.digit("_VARI", KIND)
    if kind not in (LENGTHWISE, ACROSS, PARALLEL) or not ROUGHING <= a.digit("_VARI", STAGE) <= COMPLETE:
        raise AlarmError("61002")
    if a.integer("_VARI") < 0 or a.integer("_VARI") >= 10 ** (RELIEFS + 1):
        raise AlarmError("61002")
    _refuse(a, kind)
    cuts, infeed = (DIRECTIONS.get(a.digit("_VARI", place)) for place in (CUTS, INFEED))
    along = "Z" if kind == LENGTHWISE else "X"
    if cuts is None or infeed is None or cuts[0] != along or infeed[0] == along:
        raise AlarmError("61002")
    if a.digit("_VARI", STAGE) != FINISHING and not a["_D"] > 0.0:
        raise AlarmError("61610")
    work = Work(moves, across=kind == ACROSS, towards=infeed[1])
    read_chosen(moves, partial(_turn, work, a, cuts[1]))


def _refuse(a: Arguments, kind: int) -> None:
    """What is not executed, by the parameter that asks for it."""
    unknown = {
        "_CON": bool(a.text("_CON").strip()),
        "_VARI": kind == PARALLEL
        or a.digit("_VARI", ALLOWANCE) > ALONG_CONTOUR
        or a.digit("_VARI", ROUNDING) > LAST_ROUNDING,
        "_BL": a.integer("_BL") not in (CYLINDER, SWOLLEN, CONTOUR),
        "_DI": bool(a["_DI"]),
        "_U1": bool(a["_U1"]) and a.digit("_AMODE", WITH_U1) != 0 and a.digit("_VARI", STAGE) != ROUGHING,
        "_GMODE": a.digit("_GMODE", 2) >= ONLY_START or a.integer("_GMODE") >= 10 ** (HAS_LIMITS + 1),
        "_DMODE": a.digit("_DMODE", TECHNOLOGY) not in STOCK_REMOVAL or a.digit("_DMODE", RESIDUAL) != 0,
        "_AMODE": a.integer("_AMODE") >= 10 ** (ZD_RELATIVE + 1),
        "_PK": a.integer("_PK") > 1,
        "_DCH": bool(a["_DCH"]),
    }
    for name, wrong in unknown.items():
        if wrong:
            raise not_supported(f"CYCLE952 {name}")


def _turn(work: Work, a: Arguments, direction: float, found: list[Contour]) -> None:
    """Turn what the contours say, from the free corner of the blank and back to it."""
    turning = _of_call(work, a, direction, found)
    part, lift, stage = turning.part, turning.lift, a.digit("_VARI", STAGE)
    work.require_point(0.0 if stage == FINISHING else direction)
    whole = outline.walled(
        outline.from_front(part, turning.front), part[-1].edge.end[0], turning.top, work.towards
    )
    if len(sections(whole, work.towards)) > 1 and a.digit("_VARI", RELIEFS):
        raise not_supported("CYCLE952 _VARI")
    front, top = work.front(turning.front, direction), work.touching(turning.top)
    home = _over_plane(work, a, (front - direction * lift, top - work.towards * lift), turning.top)
    ways = pairwise(((front, part[0].edge.start[1]), (front, top), (part[-1].edge.end[0], top)))
    work.clear([Piece(offset.line(p, q)) for p, q in ways], home, lift)
    work.perform(PlaneStroke(Kind.RAPID, home), 0.0)
    left = _rough(work, a, turning) if stage != FINISHING else None
    path = work.tool_path(part, 0.0)
    if stage != ROUGHING:
        feed = feed_of(a, "_FS" if stage == COMPLETE else "_F")
        # In front of the contour some of the allowance still stands: the tool comes along the cuts.
        path = outline.from_front(work.tool_path(part, 0.0, rounds_begin=True), front)
        finish(work, path, direction, feed, lift, left)
        left = None
    work.clear(path, home, lift, stock=left)
    work.perform(PlaneStroke(Kind.RAPID, home), 0.0)


def _over_plane(work: Work, a: Arguments, home: Point, top: float) -> Point:
    """Where a call begins and ends: inside, lengthwise, on the retraction plane if there is one.

    Raises:
        AlarmError: 61101 for a plane that lies in the stock.
    """
    if work.across or work.towards < 0.0 or not a["_RP"]:
        return home
    if a["_RP"] > top + _HAIR:
        raise AlarmError("61101")
    return (home[0], a["_RP"])


def _of_call(work: Work, a: Arguments, direction: float, found: list[Contour]) -> Turning:
    """Contour and blank of a call.

    Raises:
        AlarmError: 61605 where a blank contour is missing; PC0001 for further contours, for cuts that begin at the
            closed end, and for limits that leave stock in the way.
    """
    kind = a.integer("_BL")
    if len(found) != (2 if kind == CONTOUR else 1):
        if len(found) < 2:
            raise AlarmError("61605")
        raise not_supported("CYCLE952: CYCLE62")
    *blanks, part = (_in_direction(work, contour, direction) for contour in found)
    if work.towards * (part[-1].edge.end[1] - part[0].edge.start[1]) > _HAIR:
        raise not_supported("CYCLE952 _VARI")
    stock: Contour | None = None
    if kind == CYLINDER:
        front, top = _cylinder(work, a, direction, part)
    else:
        stock = blanks[0] if blanks else _swollen(work, a, direction, part)
        front = outline.farthest(stock, 0, -direction)
        top = outline.farthest(stock, 1, -work.towards)
    # A blank is not smaller than its part.
    front = -direction * max(-direction * front, -direction * part[0].edge.start[0])
    top = -work.towards * max(-work.towards * top, -work.towards * outline.farthest(part, 1, -work.towards))
    turning = Turning(part, front, top, stock, abs(a["_SC"]) or LIFT_MM)
    return _limited(work, a, direction, turning)


def _in_direction(work: Work, read_: Contour, direction: float) -> Contour:
    contour = work.contour(read_)
    return contour if onwards(contour) == direction else turned_round(contour)


def _cylinder(work: Work, a: Arguments, direction: float, part: Contour) -> Point:
    """Front and top of a cylinder; its values are positions, X a diameter, or amounts in front of the contour."""
    radial, along = a["_XD"], a["_ZD"]
    places = work.pair(along, 0.5 * radial)
    amounts = work.pair(abs(along), abs(radial))
    relative = work.pair(a.digit("_AMODE", ZD_RELATIVE), a.digit("_AMODE", XD_RELATIVE))
    edges = []
    for axis, way in enumerate((-direction, -work.towards)):
        by_contour = outline.farthest(part, axis, way) + way * amounts[axis]
        edges.append(by_contour if relative[axis] else places[axis])
    return edges[0], edges[1]


def _swollen(work: Work, a: Arguments, direction: float, part: Contour) -> Contour:
    """The part with an allowance along both axes; 61606 where that leaves nothing between two walls."""
    off_a, off_b = work.pair(abs(a["_ZD"]), abs(a["_XD"]))
    try:
        return with_stock(part, (-direction * off_a, -work.towards * off_b), work.towards)
    except ValueError:
        raise AlarmError("61606") from None


def _limited(work: Work, a: Arguments, direction: float, turning: Turning) -> Turning:
    """The part of the work that lies between the limits of the call.

    Raises:
        AlarmError: 61605 where nothing of the contour does; PC0001 where they would leave stock in front of the cuts
            or above them, and where it is not clear whether they count.
    """
    if not any(a[name] for name in LIMITS):
        return turning
    first, second = work.pair(a["_ZA"], a["_XA"]), work.pair(a["_ZB"], a["_XB"])
    low, high = tuple(map(min, first, second)), tuple(map(max, first, second))
    front, last = (low[0], high[0]) if direction > 0.0 else (high[0], low[0])
    top, floor = (low[1], high[1]) if work.towards > 0.0 else (high[1], low[1])
    end = turning.part[-1].edge.end[0]
    bottom = outline.farthest(turning.part, 1, work.towards)
    cuts_short = direction * (end - last) > _HAIR or work.towards * (bottom - floor) > _HAIR
    in_the_way = direction * (front - turning.front) > _HAIR or work.towards * (top - turning.top) > _HAIR
    if in_the_way or (cuts_short and a.digit("_GMODE", HAS_LIMITS) != 1):
        raise not_supported(f"CYCLE952 {LIMITS[0]}")
    if not cuts_short:
        return turning
    if a.digit("_VARI", STAGE) != ROUGHING:
        raise not_supported(f"CYCLE952 {LIMITS[0]}")
    part = outline.not_deeper(outline.not_beyond(turning.part, last, direction), floor, work.towards)
    if not part:
        raise AlarmError("61605")
    onwards(part)
    return replace(turning, part=part)


def _rough(work: Work, a: Arguments, turning: Turning) -> Contour:
    """Cuts down to the allowances; gives what they leave."""
    direction = onwards(turning.part)
    is_even = a.digit("_VARI", ALLOWANCE) == ALONG_CONTOUR
    off_a, off_b = (0.0, 0.0) if is_even else work.pair(abs(a["_UZ"]), abs(a["_UX"]))
    even = abs(a["_U"]) if is_even else 0.0
    front, top = work.front(turning.front, direction), work.touching(turning.top)
    path = work.tool_path(turning.part, even, roughs=True, rounds_begin=True, rounds_end=True)
    try:
        path = with_stock(path, (-direction * off_a, -work.towards * off_b), work.towards)
    except ValueError:
        raise AlarmError("61606") from None
    wall = work.front(turning.part[-1].edge.end[0], direction)
    path = outline.walled(outline.from_front(path, front), wall, top, work.towards)
    follows = a.digit("_VARI", ROUNDING) != WITHOUT_ROUNDING
    at_edges = a.digit("_AMODE", AT_EDGES) == 1
    removal = Removal(a["_D"], turning.lift, work.towards, follows, at_edges, front, top)
    straight = feed_of(a, "_F")
    relief = a["_FR"] or straight
    for number, cut in enumerate(remove(path, removal, _outline_of_nose(work, turning))):
        if not number and cut.stroke.end[0] != (home := work.pair(*work.moves.point))[0]:
            work.perform(PlaneStroke(Kind.RAPID, (cut.stroke.end[0], home[1])), 0.0)
        if cut.stroke.center is None and cut.stroke.kind is Kind.FEED:
            work.require_clear(path, cut.stroke.end)
        work.perform(cut.stroke, relief if cut.is_relief else straight)
    return path if follows else blank(path, work.towards, top)


def _outline_of_nose(work: Work, turning: Turning) -> Contour | None:
    """Where the tool's point is when its nose touches the blank; None for a cylinder, and where it fits nowhere."""
    if turning.stock is None:
        return None
    try:
        return work.tool_path(turning.stock, 0.0, rounds_begin=True)
    except AlarmError:
        return None
