"""Contour turning CYCLE952: the contour of CYCLE62 out of its blank (cuts: `polycnc.cycles.turning.stock_removal`).

Source: SINUMERIK Operate, contour turning (stock removal); parameter lists of the externally programmed cycles.
"""

from __future__ import annotations

from functools import partial

from polycnc.control.sinumerik.cycles.contours.reading import read_chosen
from polycnc.control.sinumerik.cycles.milling import feed_of
from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.cycles.turning import blanks, contour_grooves, parallel_cuts
from polycnc.control.sinumerik.cycles.turning.blanks import (
    CONTOUR,
    CYLINDER,
    HAS_LIMITS,
    SWOLLEN,
    ZD_RELATIVE,
    Turning,
)
from polycnc.control.sinumerik.cycles.turning.work import Work, finish, in_steps, onwards
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tools import stages
from polycnc.cycles.plunging.profile import dilated, profile, upright
from polycnc.cycles.turning import outline
from polycnc.cycles.turning.allowance import with_stock
from polycnc.cycles.turning.contour import Contour, shifted, turned_round
from polycnc.cycles.turning.stock_removal import Removal, blank, remove
from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves

#: Digits of _VARI: kind of cuts, stage, direction of the cuts, of the infeed, allowance, rounding, reliefs.
KIND, STAGE, CUTS, INFEED, ALLOWANCE, ROUNDING, RELIEFS = range(7)
LENGTHWISE, ACROSS, PARALLEL = 1, 2, 3
ROUGHING, FINISHING, COMPLETE = 1, 2, 3
#: Axis and sign of a direction: X-, X+, Z-, Z+.
DIRECTIONS = {1: ("X", -1.0), 2: ("X", 1.0), 3: ("Z", -1.0), 4: ("Z", 1.0)}
#: Allowances along both axes, or one all along the contour.
BY_AXES, ALONG_CONTOUR = 0, 1
WITHOUT_ROUNDING, LAST_ROUNDING = 2, 3
#: Reliefs are cut with 0 and 1.
WITHOUT_RELIEFS = 2
#: Digits of _AMODE: infeed parallel to the contour by _DX and _DZ, cuts at the edges, allowance U1.
BY_AXES_OF_INFEED, AT_EDGES, WITH_U1 = 0, 2, 3
#: Digits of _GMODE: what is done; of _DMODE: technology.
ONLY_START = 2
TECHNOLOGY = 1
STOCK_REMOVAL, GROOVING, PLUNGE_TURNING = 1, 2, 3
#: Older calls have none: they remove stock.
TECHNOLOGIES = (0, STOCK_REMOVAL, GROOVING, PLUNGE_TURNING)
#: So long a cut stands still where the chip breaks: one revolution.
BREAK = -1.0
_HAIR = 1e-6


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
    along = {LENGTHWISE: "Z", ACROSS: "X"}.get(kind, cuts[0] if cuts else "")
    if cuts is None or infeed is None or cuts[0] != along or infeed[0] == along:
        raise AlarmError("61002")
    technology = a.digit("_DMODE", TECHNOLOGY)
    needs_depth = a.digit("_VARI", STAGE) != FINISHING and technology != GROOVING
    by_axes = kind == PARALLEL and a.digit("_AMODE", BY_AXES_OF_INFEED) != 0
    if needs_depth and not (a["_D"] > 0.0 or (by_axes and (a["_DX"] > 0.0 or a["_DZ"] > 0.0))):
        raise AlarmError("61610")
    work = Work(moves, across=cuts[0] == "X", towards=infeed[1])
    by_technology = {GROOVING: contour_grooves.plunge, PLUNGE_TURNING: contour_grooves.turn}
    read_chosen(moves, partial(by_technology.get(technology, _turn), work, a, cuts[1]))


def _refuse(a: Arguments, kind: int) -> None:
    """What is not executed, by the parameter that asks for it."""
    technology = a.digit("_DMODE", TECHNOLOGY)
    unknown = {
        "_VARI": (kind == PARALLEL and technology in (GROOVING, PLUNGE_TURNING))
        or a.digit("_VARI", RELIEFS) > WITHOUT_RELIEFS
        or a.digit("_VARI", ALLOWANCE) > ALONG_CONTOUR
        or a.digit("_VARI", ROUNDING) > LAST_ROUNDING,
        "_BL": a.integer("_BL") not in (CYLINDER, SWOLLEN, CONTOUR),
        "_DI": bool(a["_DI"]) and (kind == PARALLEL or technology in (GROOVING, PLUNGE_TURNING)),
        "_U1": technology in (GROOVING, PLUNGE_TURNING) and _more_or_less(a) < 0.0,
        "_GMODE": a.digit("_GMODE", 2) >= ONLY_START or a.integer("_GMODE") >= 10 ** (HAS_LIMITS + 1),
        "_DMODE": technology not in TECHNOLOGIES or a.digit("_DMODE", blanks.RESIDUAL) > 1,
        "_AMODE": a.integer("_AMODE") >= 10 ** (ZD_RELATIVE + 1),
        "_XDA": kind == ACROSS and technology in (GROOVING, PLUNGE_TURNING) and a["_XDA"] != a["_XDB"],
        "_PK": a.integer("_PK") > 1,
        "_DCH": bool(a["_DCH"]),
    }
    for name, wrong in unknown.items():
        if wrong:
            raise not_supported(f"CYCLE952 {name}")


def _turn(work: Work, a: Arguments, direction: float, found: list[Contour]) -> None:
    """Turn what the contours say, from the free corner of the blank and back to it."""
    turning = blanks.of_call(work, a, direction, found)
    part = turning.part
    if work.towards * (part[-1].edge.end[1] - part[0].edge.start[1]) > _HAIR:
        raise not_supported("CYCLE952 _VARI")
    if a.digit("_VARI", RELIEFS) == WITHOUT_RELIEFS:
        turning = replace(turning, part=outline.without_reliefs(part, work.towards))
    turning = blanks.limited(work, a, direction, turning)
    part, lift, stage = turning.part, turning.lift, a.digit("_VARI", STAGE)
    work.require_point(0.0 if stage == FINISHING else direction)
    for name in ("_F", "_FS") if stage == COMPLETE else ("_F",):
        feed_of(a, name)  # one that is missing is told before the tool moves
    front, top = work.front(turning.front, direction), work.touching(turning.top)
    home = blanks.home(work, a, (front - direction * lift, top - work.towards * lift), turning.top)
    blanks.to_corner(work, turning, front, top, home)
    left = _rough(work, a, turning) if stage != FINISHING else None
    path = work.tool_path(part, min(_more_or_less(a), 0.0))
    if stage != ROUGHING:
        feed = feed_of(a, "_FS" if stage == COMPLETE else "_F")
        # In front of the contour some of the allowance still stands: the tool comes along the cuts.
        path = outline.from_front(work.tool_path(part, _more_or_less(a), rounds_begin=True), front)
        finish(work, path, direction, feed, lift, left)
        left = None
    work.clear(path, home, lift, stock=left)
    work.perform(PlaneStroke(Kind.RAPID, home), 0.0)
    blanks.note_left(work, a, turning)


def _more_or_less(a: Arguments) -> float:
    """What finishing leaves along the contour, or takes beyond it (below 0): `_U1`, mm."""
    return a["_U1"] if a.digit("_AMODE", WITH_U1) == 1 and a.digit("_VARI", STAGE) != ROUGHING else 0.0


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
    if a.digit("_VARI", KIND) == PARALLEL:
        met = None if turning.stock is None else _over_roundings(work, turning.stock)
        parallel_cuts.rough(work, a, turning, path, met)
        return path
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
        if cut.is_straight and a["_DI"] > 0.0:
            in_steps(work, cut.stroke, straight, a["_DI"], BREAK)
            continue
        work.perform(cut.stroke, relief if cut.is_relief else straight)
    return path if follows else blank(path, work.towards, top)


def _outline_of_nose(work: Work, turning: Turning) -> Contour | None:
    """Where the tool's point is when its nose touches the blank; None for a cylinder, or a blank that runs back."""
    if turning.stock is None:
        return None
    try:
        return work.tool_path(turning.stock, 0.0, rounds_begin=True)
    except AlarmError:
        return _over_roundings(work, turning.stock)


def _over_roundings(work: Work, stock: Contour) -> Contour | None:
    """As `_outline_of_nose`, round both ends of the blank, and where the nose does not come into all its corners."""
    radius = stages.radius(work.moves.channel)
    tip = work.pair(*stages.tip(work.moves.channel))
    try:
        met = dilated(profile(upright(stock, work.towards), blanks.NOTHING), radius)
    except ValueError:
        return None
    found = shifted(upright(met.between(met.begin, met.end), work.towards), radius * tip[0], radius * tip[1])
    return found if onwards(found) == onwards(stock) else turned_round(found)
