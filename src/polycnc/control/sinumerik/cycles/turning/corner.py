"""A corner CYCLE951 (cuts: `polycnc.cycles.turning.stock_removal`)."""

from __future__ import annotations

from itertools import pairwise
from math import copysign

from polycnc.control.sinumerik.cycles.milling import feed_of
from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.cycles.turning.work import LIFT_MM, Work, onwards
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tools import stages
from polycnc.cycles.turning.contour import Contour, Piece, turned_round
from polycnc.cycles.turning.groove import SHARP, Corner, GrooveError, with_corner
from polycnc.cycles.turning.stock_removal import Removal, remove
from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, offset
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.geometry.arcs import Point

#: CYCLE951: units and tens of VARI.
CORNER_LENGTHWISE, CORNER_ACROSS = 1, 2
CORNER_ROUGHING, CORNER_FINISHING = 1, 2
#: CYCLE951: places of the corner by _LAGE: the signs of the ways from start to end along Z and X.
CORNER_PLACES = {0: (1.0, -1.0), 1: (-1.0, -1.0), 2: (1.0, 1.0), 3: (-1.0, 1.0)}
#: Forms by _NR: sharp, with its three corners broken or rounded, and with sides that slope as well.
SHARP_FORM, BROKEN_FORM, SLANTED_FORM = 0, 1, 2
#: Digits of _AMODE: an end that counts from the start along X and Z; the same of the intermediate point, where the
#: sides of a slanted form meet; then one of each corner, 1 for a chamfer.
END_X, END_Z, MIDDLE_X, MIDDLE_Z, CORNERS = 0, 1, 2, 3, (4, 5, 6)
#: Digit of _DMODE: how the intermediate point is told, 0 for its coordinates, others for angles.
BY_ANGLES = 1


def corner(moves: Moves, a: Arguments) -> None:
    """CYCLE951: rough or finish a corner, lengthwise or across; its sides meet at a right angle or at a point.

    Raises:
        AlarmError: 61000 without tool offset, 61002 for VARI, 61003 without feed, 61606 where start and end leave
            nothing between them or the corners do not fit, 61608 for a tool that looks away from the work, 61610 for
            roughing without depth of cut; PC0001 for angles of the sides, outer corners that differ, a `_LAGE` that
            start and end contradict, and an intermediate point that does not lie between them.
    """
    require_tool(moves)
    direction, stage = a.digit("_VARI", 0), a.digit("_VARI", 1)
    known = direction in (CORNER_LENGTHWISE, CORNER_ACROSS) and stage in (CORNER_ROUGHING, CORNER_FINISHING)
    if not known or a.integer("_VARI") < 0:
        raise AlarmError("61002")
    start = (a["_SPL"], a["_SPD"])
    end = (
        a["_EPL"] + (start[0] if a.digit("_AMODE", END_Z) else 0.0),
        start[1] + 2.0 * a["_EPD"] if a.digit("_AMODE", END_X) else a["_EPD"],
    )
    if start[0] == end[0] or start[1] == end[1]:
        raise AlarmError("61606")
    signs = (copysign(1.0, end[0] - start[0]), copysign(1.0, end[1] - start[1]))
    broken = _corners(a)
    middle = _middle(a, start) if a.integer("_NR") == SLANTED_FORM else end
    _refuse(a, broken, signs)
    _require_between(start, middle, end, signs)
    # How much each side leans from Z and from X.
    lean = (middle[1] - end[1]) / (middle[0] - start[0]), (middle[0] - end[0]) / (middle[1] - start[1])
    feed, lift = feed_of(a, "_FF1"), abs(a["_SDIS"]) or LIFT_MM
    across = direction == CORNER_ACROSS
    work = Work(moves, across=across, towards=signs[0] if across else signs[1])
    work.require_point(0.0 if stage == CORNER_FINISHING else work.pair(*signs)[0])
    free = (start[0] - signs[0] * lift, start[1] - signs[1] * lift)
    if stage == CORNER_ROUGHING:
        if not a["_MID"] > 0.0:
            raise AlarmError("61610")
        off = (signs[0] * abs(a["_FALZ"]), signs[1] * abs(a["_FALX"]))
        if any(abs(way) >= abs(m - s) for way, s, m in zip(off, start, middle, strict=True)):
            raise AlarmError("61606")
        path = _corner_path(work, start, arcs.minus(middle, off), lean, broken)
        work.perform(PlaneStroke(Kind.RAPID, work.pair(*free)), feed)
        top, front = work.touching(work.pair(*start)[1]), work.front(work.pair(*start)[0], onwards(path))
        for cut in remove(path, Removal(a["_MID"], lift, work.towards, front=front, top=top)):
            work.perform(cut.stroke, feed)
    else:
        path = _corner_path(work, start, middle, lean, broken)
        work.perform(PlaneStroke(Kind.RAPID, work.pair(*free)), feed)
        before, after = path[0].edge.start, path[-1].edge.end
        work.perform(PlaneStroke(Kind.RAPID, (before[0] - onwards(path) * lift, before[1])), feed)
        work.perform(PlaneStroke(Kind.FEED, before), feed)
        # The last side is led on up to the lift-off.
        is_side = abs(path[-1].edge.end[0] - path[-1].edge.start[0]) <= NO_WAY
        for piece in path[:-1] if is_side else path:
            work.perform(piece.stroke(), feed)
        work.perform(PlaneStroke(Kind.FEED, (after[0], after[1] - work.towards * lift)), feed)
    work.clear(path, work.pair(*free), lift)
    work.perform(PlaneStroke(Kind.RAPID, work.pair(*free)), feed)


def _corners(a: Arguments) -> tuple[Corner, Corner, Corner]:
    """The corner at the front, the inner one, and the one at the other edge; the sharp form has none of them."""
    if a.integer("_NR") == SHARP_FORM:
        return SHARP, SHARP, SHARP
    first, inner, last = (
        Corner(leg=size) if a.digit("_AMODE", place) else Corner(radius=size)
        for size, place in zip((abs(a[f"_RF{i}"]) for i in (1, 2, 3)), CORNERS, strict=True)
    )
    return first, inner, last


def _middle(a: Arguments, start: Point) -> Point:
    """Where the sides of a slanted corner meet."""
    along, radial = a["_ZPL"], a["_ZPD"]
    return (
        along + (start[0] if a.digit("_AMODE", MIDDLE_Z) else 0.0),
        start[1] + 2.0 * radial if a.digit("_AMODE", MIDDLE_X) else radial,
    )


def _refuse(a: Arguments, broken: tuple[Corner, Corner, Corner], signs: Point) -> None:
    """What is not executed, or contradicts itself."""
    form = a.integer("_NR")
    unknown = {
        "_VARI": a.integer("_VARI") >= 100,
        "_NR": not SHARP_FORM <= form <= SLANTED_FORM or broken[0] != broken[2],
        "_DMODE": form == SLANTED_FORM and a.digit("_DMODE", BY_ANGLES) != 0,
        "_AMODE": any(a.digit("_AMODE", place) > 1 for place in (END_X, END_Z, MIDDLE_X, MIDDLE_Z, *CORNERS)),
        "_LAGE": CORNER_PLACES.get(a.integer("_LAGE")) != signs,
    }
    for name, wrong in unknown.items():
        if wrong:
            raise not_supported(f"CYCLE951 {name}")


def _require_between(start: Point, middle: Point, end: Point, signs: Point) -> None:
    """61606 for sides without length; PC0001 for a point beyond start and end, where a side hangs over."""
    for s, m, e, sign in zip(start, middle, end, signs, strict=True):
        if abs(m - s) <= NO_WAY:
            raise AlarmError("61606")
        if (m - s) * sign < 0.0 or (e - m) * sign < -NO_WAY:
            raise not_supported("CYCLE951 _ZPD, _ZPL")


def _corner_path(
    work: Work, start: Point, middle: Point, lean: Point, broken: tuple[Corner, Corner, Corner]
) -> Contour:
    """The tool point's way along the two sides of a corner, from its open end to where the cuts begin.

    Where the nose is a corner of the tool, the way begins and ends at the start's levels.

    Raises:
        AlarmError: 61606 where a corner does not fit, or the nose does not into the inner one.
    """
    radius = stages.radius(work.moves.channel)
    tip = stages.tip(work.moves.channel)
    begin = (start[0] - radius * tip[0], start[1] - radius * tip[1])
    first, inner, last = broken
    # Each side goes on in its own direction to where the cuts begin.
    front = start[0] if not first.is_sharp else begin[0]
    edge = start[1] if not last.is_sharp else begin[1]
    before = (front, middle[1] + lean[0] * (front - middle[0]))
    behind = (middle[0] + lean[1] * (edge - middle[1]), edge)
    points = [before, middle, behind]
    kinds = [inner]
    # Outer corners lie between a side and what the part goes on with: a face below it, an edge beside it.
    if not first.is_sharp:
        beyond = abs(middle[1] - start[1]) + first.radius + first.leg
        points[:0] = [(before[0], before[1] + copysign(beyond, middle[1] - start[1]))]
        kinds.insert(0, first)
    if not last.is_sharp:
        beyond = abs(middle[0] - start[0]) + last.radius + last.leg
        points.append((behind[0] + copysign(beyond, middle[0] - start[0]), behind[1]))
        kinds.append(last)
    lines = [Piece(offset.line(p, q)) for p, q in pairwise(points)]
    contour: Contour = lines[:1]
    try:
        for line, kind in zip(lines[1:], kinds, strict=True):
            contour = with_corner(contour, line, kind)
    except GrooveError:
        raise AlarmError("61606") from None
    contour = contour[0 if first.is_sharp else 1 : None if last.is_sharp else -1]
    if work.across:
        contour = turned_round(contour)
    return work.tool_path(work.contour(contour), 0.0)
