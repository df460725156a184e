"""A corner CYCLE951 (cuts: `polycnc.cycles.turning.stock_removal`)."""

from __future__ import annotations

from math import copysign
from typing import TYPE_CHECKING

from polycnc.control.sinumerik.cycles.milling import feed_of
from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.cycles.turning.work import LIFT_MM, Work, onwards
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tools import stages
from polycnc.cycles.turning.contour import Contour, Piece
from polycnc.cycles.turning.stock_removal import Removal, remove
from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.geometry import offset
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
#: Lower digits of _AMODE: points that count from others.
_INCREMENTAL = 10_000


def corner(moves: Moves, a: Arguments) -> None:
    """CYCLE951: rough or finish a right-angled corner, lengthwise or across; other forms are PC0001.

    Raises:
        AlarmError: 61000 without tool offset, 61002 for VARI, 61003 without feed, 61606 where start and end leave
            nothing between them, 61610 for roughing without depth of cut; PC0001 for chamfers, roundings, slanted
            corners, incremental points and a `_LAGE` that start and end contradict.
    """
    require_tool(moves)
    direction, stage = a.digit("_VARI", 0), a.digit("_VARI", 1)
    if direction not in (CORNER_LENGTHWISE, CORNER_ACROSS) or stage not in (
        CORNER_ROUGHING,
        CORNER_FINISHING,
    ):
        raise AlarmError("61002")
    start, end = (a["_SPL"], a["_SPD"]), (a["_EPL"], a["_EPD"])
    if start[0] == end[0] or start[1] == end[1]:
        raise AlarmError("61606")
    signs = (copysign(1.0, end[0] - start[0]), copysign(1.0, end[1] - start[1]))
    unknown = {
        "_VARI": a.integer("_VARI") >= 100,
        "_NR": a.integer("_NR") != 0 or any(a.plain(f"_RF{i}") for i in (1, 2, 3)),
        "_AMODE": a.integer("_AMODE") % _INCREMENTAL != 0,
        "_LAGE": CORNER_PLACES.get(a.integer("_LAGE")) != signs,
    }
    for name, wrong in unknown.items():
        if wrong:
            raise not_supported(f"CYCLE951 {name}")
    feed, lift = feed_of(a, "_FF1"), abs(a["_SDIS"]) or LIFT_MM
    across = direction == CORNER_ACROSS
    work = Work(moves, across=across, towards=signs[0] if across else signs[1])
    free = (start[0] - signs[0] * lift, start[1] - signs[1] * lift)
    work.perform(PlaneStroke(Kind.RAPID, work.pair(*free)), feed)
    if stage == CORNER_ROUGHING:
        if not a["_MID"] > 0.0:
            raise AlarmError("61610")
        off = (signs[0] * abs(a["_FALZ"]), signs[1] * abs(a["_FALX"]))
        if any(abs(way) >= abs(e - s) for way, s, e in zip(off, start, end, strict=True)):
            raise AlarmError("61606")
        path = _corner_path(work, start, (end[0] - off[0], end[1] - off[1]))
        for cut in remove(path, Removal(a["_MID"], lift, work.towards)):
            work.perform(cut.stroke, feed)
    else:
        path = _corner_path(work, start, end)
        before, after = path[0].edge.start, path[-1].edge.end
        work.perform(PlaneStroke(Kind.RAPID, (before[0] - onwards(path) * lift, before[1])), feed)
        for target in (before, path[0].edge.end, (after[0], after[1] - work.towards * lift)):
            work.perform(PlaneStroke(Kind.FEED, target), feed)
    work.clear(path, work.pair(*free), lift)
    work.perform(PlaneStroke(Kind.RAPID, work.pair(*free)), feed)


def _corner_path(work: Work, start: Point, end: Point) -> Contour:
    """The tool point's way along the two sides of a corner, from its open end to where the cuts begin.

    Where the nose is a corner of the tool, the way begins and ends at the start's levels.
    """
    radius = stages.radius(work.moves.channel)
    tip = stages.tip(work.moves.channel)
    begin = (start[0] - radius * tip[0], start[1] - radius * tip[1])
    foot, edge, top = ((begin[0], end[1]), end, (end[0], begin[1]))
    if work.across:
        foot, top = top, foot
    sides = [(work.pair(*p), work.pair(*q)) for p, q in ((foot, edge), (edge, top))]
    return work.tool_path([Piece(offset.line(p, q)) for p, q in sides], 0.0)
