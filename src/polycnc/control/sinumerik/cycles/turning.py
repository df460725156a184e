"""Turning cycles: stock removal CYCLE95, CYCLE951, threads CYCLE97 to CYCLE99 (strokes: `polycnc.cycles`)."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from itertools import pairwise
from math import atan2, copysign, degrees
from typing import TYPE_CHECKING

from polycnc.control.sinumerik.cycles.contours.reading import read
from polycnc.control.sinumerik.cycles.drilling import METRIC_PITCHES, pitch
from polycnc.control.sinumerik.cycles.milling import feed_of
from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tools import stages
from polycnc.cycles.count import parts
from polycnc.cycles.turning import thread_chain as thread_turning
from polycnc.cycles.turning.allowance import with_stock
from polycnc.cycles.turning.contour import (
    Contour,
    Piece,
    parallel,
    shifted,
    swapped,
    swapped_stroke,
    turned_round,
)
from polycnc.cycles.turning.stock_removal import Removal, blank, is_clear, remove, way_clear, way_over
from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.cycles.turning.thread_chain import Thread
from polycnc.geometry import offset
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge

#: Ways off the work where the call gives none.
LIFT_MM = 1.0
#: By so much a direction of 45 degrees may miss it and still not be steep.
_ROUNDING = 1e-9
#: Kinds of threads: outside, inside with equal depths of cuts, then both with equal cross-sections.
KINDS = (1, 2, 3, 4)
INSIDE_KINDS = (2, 4)
#: Further coarse metric threads that can be cut, but not tapped, by their nominal diameter.
LARGE_PITCHES = {52: 5.0, 56: 5.5, 60: 5.5}


# ---- threads


def thread(moves: Moves, a: Arguments) -> None:
    """CYCLE97: thread between SPL and FPL."""
    corners = [(a["SPL"], a["DM1"]), (a["FPL"], a["DM2"])]
    lead = abs(pitch(a, {**METRIC_PITCHES, **LARGE_PITCHES}))
    _thread(moves, a, corners, [lead])


def thread_chain(moves: Moves, a: Arguments) -> None:
    """CYCLE98: three threads in a row."""
    corners = [(a[f"PO{i}"], a[f"DM{i}"]) for i in range(1, 5)]
    leads = [abs(a[f"PP{i}"]) for i in range(1, 4)]
    if not all(leads):
        raise AlarmError("61001")
    _thread(moves, a, corners, leads)


#: CYCLE99: what its parameters must be, as far as it is executed: one pitch, lengthwise, absolute.
_ONLY_ZERO = "_GDEP _PIT1 _FDEP _GST _GUD _MID _AMODE".split()  # noqa: SIM905 - a table
_PITCH_UNITS = (0, 1)
#: Digits of its VARI: how cuts go in, and whether it roughs and finishes.
INFEED_PLACE, STAGE_PLACE, ALTERNATING = 2, 5, 2
_COMPLETE = (0, 3)


def thread_of_plane(moves: Moves, a: Arguments) -> None:
    """CYCLE99: thread lengthwise, roughed and finished; other kinds are PC0001."""
    kind = a.digit("_VARI", 0)
    if kind not in KINDS:
        raise AlarmError("61002")
    lead = abs(a["_PIT"])
    if not lead:
        raise AlarmError("61001")
    wrong = [name for name in _ONLY_ZERO if a.plain(name)]
    if a.integer("_PITA") not in _PITCH_UNITS:
        wrong.append("_PITA")
    if wrong or a.digit("_VARI", STAGE_PLACE) not in _COMPLETE or not a.integer("_NRC"):
        raise not_supported(f"CYCLE99 {wrong[0] if wrong else '_VARI'}")
    flank = a["_IANG"]
    if not flank and a["_IFLANK"]:
        flank = degrees(atan2(abs(a["_IFLANK"]), abs(a["_TDEP"])))
    if a.digit("_VARI", INFEED_PLACE) == ALTERNATING:
        flank = -abs(flank)
    # The editor leaves the second diameter out where the thread is none of a taper.
    corners = [(a["_SPL"], a["_DM1"]), (a["_FPL"], a["_DM2"] or a["_DM1"])]
    _thread(moves, a, corners, [lead], prefix="_", kind=kind, flank=flank, lift=a["_SDIS"])


def _thread(
    moves: Moves,
    a: Arguments,
    corners: Sequence[Point],
    leads: Sequence[float],
    *,
    prefix: str = "",
    kind: int | None = None,
    flank: float | None = None,
    lift: float | None = None,
) -> None:
    """Cut a thread; what is not given here has the names of CYCLE97, behind a prefix."""
    kind = a.integer("VARI") if kind is None else kind
    lift = a["_VRT"] if lift is None else lift
    if kind not in KINDS:
        raise AlarmError("61002")
    for (a0, b0), (a1, b1) in pairwise(corners):
        if a0 == a1 or abs(b1 - b0) > abs(a1 - a0):
            raise not_supported(f"{a.cycle}: face thread")
    if kind not in INSIDE_KINDS and min(radius for _, radius in corners) < abs(a[f"{prefix}TDEP"]):
        raise AlarmError("61601")
    cutting = Thread(
        corners,
        leads,
        run_in=abs(a[f"{prefix}APP"]),
        run_out=abs(a[f"{prefix}ROP"]),
        depth=abs(a[f"{prefix}TDEP"]),
        allowance=abs(a[f"{prefix}FAL"]),
        cuts=max(a.integer(f"{prefix}NRC"), 1),
        idle=max(a.integer(f"{prefix}NID"), 0),
        inside=kind in INSIDE_KINDS,
        degressive=kind in (3, 4),
        flank_deg=a[f"{prefix}IANG"] if flank is None else flank,
        start_angle_deg=a[f"{prefix}NSP"],
        starts=max(a.integer(f"{prefix}NUMT"), 1),
        lift=lift if lift > 0.0 else LIFT_MM,
    )
    for stroke in thread_turning.strokes(cutting):
        if stroke.lead:
            moves.thread(*stroke.end, stroke.lead, stroke.start_angle_deg)
        else:
            moves.rapid(*stroke.end)
        moves.end_block()


# ---- stock removal

#: Kinds of CYCLE95 by (VARI - 1) // 4.
ROUGHING, FINISHING, COMPLETE = 0, 1, 2
#: For each of the four sides of a kind: whether the cuts run across, and the direction of infeed.
SIDES = ((False, -1.0), (True, -1.0), (False, 1.0), (True, -1.0))
#: Hundreds of VARI: cuts end without following the contour.
WITHOUT_ROUNDING = 2


class Work:
    """Which way the cuts of a call run: lengthwise (a is Z, b the radius) or across (a is the radius, b is Z)."""

    def __init__(self, moves: Moves, *, across: bool, towards: float) -> None:
        self.moves = moves
        self.across = across
        self.towards = towards

    def contour(self, read_: Contour) -> Contour:
        """A contour of the plane in the coordinates of the cuts."""
        return swapped(read_) if self.across else read_

    def pair(self, along: float, radial: float) -> Point:
        """An amount along Z and one along X in the coordinates of the cuts."""
        return (radial, along) if self.across else (along, radial)

    def tool_path(
        self, contour: Contour, allowance: float, *, roughs: bool = False, rounds_begin: bool = False
    ) -> Contour:
        """Where the tool's point runs: the nose lies on the contour, or an allowance off it.

        Roughing leaves stock in a rounding that is too narrow for both. `rounds_begin`: the nose comes round an open
        end from which the contour goes down, for it passes over that end.

        Raises:
            AlarmError: 61606 where the nose does not fit the contour.
        """
        channel = self.moves.channel
        radius = stages.radius(channel)
        first, second = stages.tip(channel)
        try:
            off = -self.towards * onwards(contour) * (radius + allowance)
            path = parallel(contour, off, leaves_fillets=roughs)
        except ValueError:
            raise AlarmError("61606") from None
        if rounds_begin:
            path = [*self._round_begin(contour[0].edge, path[0].edge.start, off, contour[-1].edge.end), *path]
        return shifted(path, *self.pair(radius * first, radius * second))

    def _round_begin(self, first: Edge, onto: Point, off: float, end: Point) -> Contour:
        """The nose's way round the open end of a contour that goes down from there; nothing else needs one."""
        begin = first.start
        is_open = self.towards * (begin[1] - end[1]) >= 0.0
        if not is_open or self.towards * first.departing[1] <= NO_WAY or abs(off) <= NO_WAY:
            return []
        above = (begin[0], begin[1] - self.towards * abs(off))
        return [Piece(offset.arc(above, onto, begin, off < 0.0))]

    def clear(self, contour: Contour, end: Point, lift: float, *, stock: Contour | None = None) -> None:
        """Go past the contour before a rapid to a place, where that would touch it; 61606 where no way is clear.

        `stock` is what still lies on the contour: the way passes over it as well, where there is one that does.
        """
        start = self.pair(*self.moves.point)
        try:
            way = way_clear(contour, start, end, towards=self.towards, lift=lift)
        except ValueError:
            raise AlarmError("61606") from None
        if stock is not None:
            try:
                over = way_clear(stock, start, end, towards=self.towards, lift=lift)
            except ValueError:
                over = way_over(stock, start, end, towards=self.towards, lift=lift)
            if is_clear(contour, [start, *(stroke.end for stroke in over), end], self.towards):
                way = over
        for stroke in way:
            self.perform(stroke, 0.0)

    def require_clear(self, contour: Contour, end: Point) -> None:
        """61606 for a straight stroke through the contour: one that runs back on itself has no cuts that are clear."""
        if not is_clear(contour, [self.pair(*self.moves.point), end], self.towards):
            raise AlarmError("61606")

    def perform(self, stroke: PlaneStroke, feed: float) -> None:
        """Make a stroke, which is a block."""
        made = swapped_stroke(stroke) if self.across else stroke
        if made.kind is Kind.RAPID:
            self.moves.rapid(*made.end)
        elif made.center is None:
            self.moves.feed(feed, *made.end)
        else:
            self.moves.arc(feed, made.end, made.center, made.kind is Kind.CCW)
        self.moves.end_block()


def onwards(contour: Contour) -> float:
    """The direction of a contour along the cuts; 61605 where it has none."""
    if abs(contour[-1].edge.end[0] - contour[0].edge.start[0]) <= NO_WAY:
        raise AlarmError("61605")
    return copysign(1.0, contour[-1].edge.end[0] - contour[0].edge.start[0])


def stock_removal(moves: Moves, a: Arguments) -> None:
    """CYCLE95: remove stock along a contour, lengthwise or across, outside or inside."""
    require_tool(moves)
    rounding, number = divmod(a.integer("VARI"), 100)
    if not 1 <= number <= 12 or not 0 <= rounding <= WITHOUT_ROUNDING:
        raise AlarmError("61002")
    kind, side = divmod(number - 1, len(SIDES))
    across, towards = SIDES[side]
    work = Work(moves, across=across, towards=towards)
    read(moves, a.text("NPP"), partial(_remove, work, a, kind, rounding))


def _remove(work: Work, a: Arguments, kind: int, rounding: int, read_: Contour) -> None:
    """Rough and finish along the contour that was read, and back to where the cycle began."""
    moves = work.moves
    home = moves.point
    contour = work.contour(read_)
    stock: Contour | None = None
    if kind != FINISHING:
        stock = _rough(work, a, contour, follows=rounding != WITHOUT_ROUNDING)
    if kind != ROUGHING:
        _finish(work, a, contour, stock)
        stock = None
    work.clear(work.tool_path(contour, 0.0), work.pair(*home), _lift(a), stock=stock)
    moves.rapid(*home)
    moves.end_block()


def _lift(a: Arguments) -> float:
    return a["_VRT"] if a["_VRT"] > 0.0 else LIFT_MM


def _rough(work: Work, a: Arguments, contour: Contour, *, follows: bool) -> Contour:
    """Cuts down to the allowances, from the open end of the contour; gives what they leave."""
    if not a["MID"] > 0.0:
        raise AlarmError("61610")
    if work.towards * (contour[0].edge.start[1] - contour[-1].edge.end[1]) < 0.0:
        contour = turned_round(contour)
    path = work.tool_path(contour, abs(a["FAL"]), roughs=True, rounds_begin=True)
    off_a, off_b = work.pair(abs(a["FALZ"]), abs(a["FALX"]))
    try:
        path = with_stock(path, (-onwards(contour) * off_a, -work.towards * off_b), work.towards)
    except ValueError:
        raise AlarmError("61606") from None
    straight = feed_of(a, "FF1")
    relief = a["FF2"] or straight
    for number, cut in enumerate(remove(path, Removal(a["MID"], _lift(a), work.towards, follows))):
        if not number:
            work.clear(path, cut.stroke.end, _lift(a), stock=blank(path, work.towards))
        if cut.stroke.center is None:
            work.require_clear(path, cut.stroke.end)
        if cut.is_straight and a["DAM"] > 0.0:
            _in_steps(work, a, cut.stroke, straight)
        else:
            work.perform(cut.stroke, relief if cut.is_relief else straight)
    # Cuts that do not follow the contour leave steps on it.
    return path if follows else blank(path, work.towards)


def _in_steps(work: Work, a: Arguments, stroke: PlaneStroke, feed: float) -> None:
    """A cut that stands still for DT after every DAM, so that the chip breaks."""
    at = work.moves.point
    begin = at[1] if work.across else at[0]
    way = stroke.end[0] - begin
    for part in steps_of(abs(way), a["DAM"]):
        work.perform(replace(stroke, end=(begin + copysign(part, way), stroke.end[1])), feed)
        if part < abs(way):
            work.moves.dwell(a["DT"])
            work.moves.end_block()


def steps_of(total: float, step: float) -> list[float]:
    """Ends of equal steps along a way, the last one shorter."""
    count = max(0, parts(total, step, 1e-9) - 1)
    return [step * k for k in range(1, count + 1)] + [total]


def _finish(work: Work, a: Arguments, contour: Contour, stock: Contour | None) -> None:
    """The contour once, in its own direction, at the finished size; `stock` is what roughing has left."""
    path = work.tool_path(contour, 0.0, rounds_begin=True)
    feed, lift = feed_of(a, "FF3"), _lift(a)
    start, end = path[0].edge.start, path[-1].edge.end
    before = _beside(start, path[0].edge.departing, onwards(contour), work.towards, lift)
    after = _beside(end, path[-1].edge.arriving, onwards(contour), work.towards, lift)
    work.clear(path, before, lift, stock=stock)
    for stroke in (
        PlaneStroke(Kind.RAPID, before),
        PlaneStroke(Kind.FEED, start),
        *(piece.stroke() for piece in path),
        PlaneStroke(Kind.FEED, after),
    ):
        # A rapid in the contour cuts as well: the cycle has feeds of its own.
        work.perform(stroke if stroke.end == before else _at_feed(stroke), feed)


def _beside(point: Point, direction: Point, onwards_: float, towards: float, lift: float) -> Point:
    """A place off an end of the contour: square to the cuts where it is steep there, for the nose is beside a wall."""
    steep = direction[1] * towards > direction[0] * onwards_ + _ROUNDING
    return (point[0] - (0.0 if steep else onwards_ * lift), point[1] - towards * lift)


def _at_feed(stroke: PlaneStroke) -> PlaneStroke:
    return replace(stroke, kind=Kind.FEED) if stroke.kind is Kind.RAPID else stroke


# ---- a corner

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
