"""Faces, contours, spigots: CYCLE61, CYCLE71, CYCLE72, CYCLE76, CYCLE77, CYCLE79."""

from __future__ import annotations

from functools import partial

from polycnc.control.sinumerik.cycles.chamfers import CHAMFER, chamfer
from polycnc.control.sinumerik.cycles.contours.reading import read
from polycnc.control.sinumerik.cycles.levels import levels
from polycnc.control.sinumerik.cycles.milling import (
    FINISHING,
    ROUGHING,
    cutter,
    feed_of,
    is_ccw,
    levels_of_work,
    perform,
    place_of,
    reference_point,
    variant,
    width_of_cut,
)
from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.errors import not_supported
from polycnc.cycles.count import checked
from polycnc.cycles.milling import contour as path_milling
from polycnc.cycles.milling import facing, spigots
from polycnc.cycles.milling.contour import Approach, ApproachShape, PathMilling
from polycnc.cycles.milling.stroke import Place, steps
from polycnc.cycles.turning.contour import parallel, turned_round
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.levels import Levels
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.cycles.turning.contour import Contour


def levels_below(found: Levels, total: float, infeed: float) -> list[float]:
    """Levels of equal steps from the reference plane."""
    return [found.reference + found.down * below for below in steps(total, infeed)]


# ---- faces

#: Tens of VARI: strips along the abscissa or the ordinate, in one direction or to and fro.
STRIPS = {1: (False, False), 2: (True, False), 3: (False, True), 4: (True, True)}


def face(moves: Moves, a: Arguments) -> None:
    """CYCLE71 and CYCLE61: face milling in strips."""
    radius = cutter(moves, deep=True)
    kind = variant(a, "_VARI", (ROUGHING, FINISHING))
    strips = STRIPS.get(a.digit("_VARI", 1))
    if strips is None:
        raise AlarmError("61002")
    found = levels(moves, a)
    if found is None:
        return
    length, width = _size(a)
    if not length or not width:
        raise AlarmError("61118")
    shape = facing.Face(
        Place((a["_PA"], a["_PO"]), a["_STA"]),
        length,
        width,
        radius,
        _strip(a, radius),
        abs(a["_FDP"]),
        abs(a["_FDP1"]),
        across=strips[0],
        alternating=strips[1],
        feed=feed_of(a, "_FFP1"),
        safe=found.safe,
        retract=found.retract,
        walls=_walls(a),
    )
    if not shape.fits:
        raise AlarmError("61105")
    total = abs(found.depth - found.reference)
    rough = levels_below(found, total - abs(a["_FALD"]), a["_MID"])
    perform(moves, facing.face(shape, rough if kind == ROUGHING else [found.depth]))


def _walls(a: Arguments) -> tuple[bool, bool, bool, bool]:
    """Sides that the tool does not pass: digits of _LIM for abscissa - and +, ordinate - and +."""
    first, second, third, fourth = (bool(a.digit("_LIM", place)) for place in range(4))
    return first, second, third, fourth


def _size(a: Arguments) -> tuple[float, float]:
    """Length and width from the corner; CYCLE61 tells the opposite corner where _AMODE does not say else."""
    length, width = a["_LENG"], a["_WID"]
    if a.cycle == "CYCLE61":
        length -= 0.0 if a.digit("_AMODE", 3) == 1 else a["_PA"]
        width -= 0.0 if a.digit("_AMODE", 4) == 1 else a["_PO"]
    return length, width


def _strip(a: Arguments, radius: float) -> float:
    """Greatest width of a strip: mm, or per cent of the tool's diameter (_AMODE tens).

    Raises:
        AlarmError: 61124 for none, 61111 for one that is wider than the tool.
    """
    strip = abs(a["_MIDA"])
    if a.digit("_AMODE", 1) == 1:
        strip = abs(a.plain("_MIDA")) / 100.0 * 2.0 * radius
    if not strip:
        raise AlarmError("61124")
    if strip > 2.0 * radius + NO_WAY:
        raise AlarmError("61111")
    return strip


# ---- contours

SIDES = {40: 0.0, 41: 1.0, 42: -1.0}
#: Hundreds of VARI: how far the tool rises at the end of the contour.
TO_RETRACT, TO_SAFE, BY_SAFETY, STAYS = range(4)
#: Place of the digit of VARI that leads along the contour the other way.
TURNED_ROUND = 4


def path(moves: Moves, a: Arguments) -> None:
    """CYCLE72: milling along a contour on its left, on its right or on it."""
    radius = require_tool(moves, deep=True)
    if radius < 0.0:
        raise AlarmError("61112")
    kind = variant(a, "_VARI", (ROUGHING, FINISHING), digits=TURNED_ROUND + 1)
    if a.digit("_VARI", 1) not in (0, 1) or a.digit("_VARI", 2) > STAYS:
        raise AlarmError("61002")
    if a.digit("_VARI", TURNED_ROUND - 1) or a.digit("_VARI", TURNED_ROUND) > 1:
        raise not_supported("CYCLE72 _VARI")
    side = SIDES.get(a.integer("_RL"))
    if side is None or (kind == CHAMFER and not side):
        raise AlarmError("61114")
    ways = _approach(a, "_AS1", "_LP1", side), _approach(a, "_AS2", "_LP2", side)
    found = levels_of_work(moves, a, kind, abs(a["_FALD"]))
    if found is None:
        return
    feed, depth_feed = feed_of(a, "_FFP1"), feed_of(a, "_FFD")
    between = feed_of(a, "_FF3") if a.digit("_VARI", 1) == 1 else 0.0
    mills = partial(_mill_path, moves, a, found, side, ways, (feed, depth_feed, between))
    read(moves, a.text("_KNAME"), mills)


def _mill_path(
    moves: Moves,
    a: Arguments,
    found: Levels,
    side: float,
    ways: tuple[Approach, Approach],
    feeds: tuple[float, float, float],
    contour: Contour,
) -> None:
    """Mill along the contour that was read; `feeds` are those along it, in depth and between the passes."""
    radius, kind = moves.memory.tools.radius, a.digit("_VARI", 0)
    if a.digit("_VARI", TURNED_ROUND) == 1:
        contour, side = turned_round(contour), -side
    off = chamfer(moves, a).radius if kind == CHAMFER else radius
    off += abs(a["_FAL"]) if kind == ROUGHING else 0.0
    try:
        # Roughing leaves stock in a rounding that is too narrow for radius and allowance.
        tool = parallel(contour, side * off, leaves_fillets=kind == ROUGHING)
    except ValueError:
        raise AlarmError("61606") from None
    left = abs(a["_FALD"]) if kind == ROUGHING else 0.0
    infeed = 0.0 if kind == CHAMFER else a["_MID"]
    at = levels_below(found, abs(found.depth - found.reference) - left, infeed)
    lifts = [_lift(found, level, a.digit("_VARI", 2), abs(a["SDIS"])) for level in at]
    work = PathMilling(tool, side, *ways, *feeds, lifts, found.safe, found.retract)
    perform(moves, path_milling.mill(work, at))


def _lift(found: Levels, level: float, rise: int, safety: float) -> float | None:
    """Level to which the tool rises behind a pass."""
    return {TO_RETRACT: found.retract, TO_SAFE: found.safe, BY_SAFETY: level - found.down * safety}.get(rise)


def _approach(a: Arguments, mode: str, size: str, side: float) -> Approach:
    """An approach or a return.

    Raises:
        AlarmError: 61115 for a mode that does not exist, or arcs on the contour; 61116 for a way of no length.
    """
    kinds = {way.value: way for way in ApproachShape}
    way = kinds.get(a.digit(mode, 0))
    needs_side = way in (ApproachShape.QUARTER, ApproachShape.HALF)
    if way is None or a.digit(mode, 1) not in (0, 1) or (needs_side and not side):
        raise AlarmError("61115")
    if way is not ApproachShape.DIRECT and not abs(a[size]):
        raise AlarmError("61116")
    return Approach(way, abs(a[size]), a.digit(mode, 1) == 1)


# ---- spigots


def spigot(moves: Moves, a: Arguments) -> None:
    """CYCLE76 (rectangular), CYCLE77 (circular)."""
    radius = require_tool(moves, evenly=True)
    if radius < 0.0:
        raise AlarmError("61112")
    kind = variant(a, "_VARI", (ROUGHING, FINISHING), digits=1)
    circular = a.cycle == "CYCLE77"
    length = abs(a["_PRAD"]) if circular else abs(a["_LENG"])
    width, corner = (length, length / 2.0) if circular else (abs(a["_WID"]), abs(a["_CRAD"]))
    if not length or not width:
        raise AlarmError("61118")
    if 2.0 * corner > min(length, width) + NO_WAY:
        raise AlarmError("61113")
    outline = spigots.Rectangle(length / 2.0, width / 2.0, corner)
    place = Place(reference_point(moves, a), a["_STA"]) if circular else place_of(moves, a, length, width)
    _mill_spigot(moves, a, outline, kind, radius, place, "_FFD")


def polygon(moves: Moves, a: Arguments) -> None:
    """CYCLE79: spigot with NUM edges; SWL is the width across flats, or an edge where NUM is odd."""
    radius = require_tool(moves, evenly=True)
    kind = variant(a, "_VARI", (ROUGHING, FINISHING), digits=1)
    count, size = checked(abs(a.integer("_NUM"))), abs(a["_SWL"])
    if count < spigots.FEWEST_EDGES or not size:
        raise AlarmError("61118")
    inner = size / 2.0 if count % 2 == 0 else spigots.inner_radius(count, size)
    if abs(a["_RC"]) > inner:
        raise AlarmError("61113")
    outline = spigots.Polygon(count, inner, abs(a["_RC"]))
    _mill_spigot(moves, a, outline, kind, radius, Place(reference_point(moves, a), a["_STA"]), "_FFP1")


def _mill_spigot(
    moves: Moves,
    a: Arguments,
    outline: spigots.Outline,
    kind: int,
    radius: float,
    place: Place,
    depth_feed: str,
) -> None:
    """Mill round an outline; `depth_feed` names the parameter of the feed in depth."""
    found = levels_of_work(moves, a, kind, abs(a["_FALD"]))
    if found is None:
        return
    chamfers = kind == CHAMFER
    if chamfers:
        radius = chamfer(moves, a).radius
    left, left_below = (abs(a["_FAL"]), abs(a["_FALD"])) if kind == ROUGHING else (0.0, 0.0)
    shape = spigots.Spigot(
        place,
        outline,
        abs(a["_AP1"]) / 2.0,
        radius + left,
        abs(a["SDIS"]),
        is_ccw(moves, a.integer("_CDIR"), inside=False),
        feed_of(a, "_FFP1"),
        feed_of(a, depth_feed),
        found.safe,
        found.retract,
    )
    total = abs(found.depth - found.reference) - left_below
    in_rounds = a.has("_MIDA") and not chamfers
    rounds = _rounds(a, radius, shape.blank - outline.reach - left) if in_rounds else [0.0]
    infeed = 0.0 if chamfers else a["_MID"]
    perform(moves, spigots.mill(shape, levels_below(found, total, infeed), rounds))


def _rounds(a: Arguments, radius: float, stock: float) -> list[float]:
    """How far outside of the outline the tool goes round, where the blank is more than one width of cut larger."""
    if not a.plain("_MIDA") or stock <= NO_WAY:
        return [0.0]
    return [stock - part for part in steps(stock, width_of_cut(a, radius))]
