"""Contour pockets and spigots CYCLE63, their predrilling CYCLE64 (strokes: `polycnc.cycles.milling.contour_pocket`).

Source: SINUMERIK standard cycles, cycles, section 5 (CYCLE62 to CYCLE64): parameter lists.
"""

from __future__ import annotations

from functools import partial

from polycnc.control.sinumerik.cycles.chamfers import CHAMFER, chamfer
from polycnc.control.sinumerik.cycles.contours.reading import read_chosen
from polycnc.control.sinumerik.cycles.milling import (
    FINISHING,
    ONLY_START,
    ROUGHING,
    cutter,
    feed_of,
    is_ccw,
    milling_levels,
    perform,
    radius_of,
    width_of_cut,
)
from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.errors import not_supported
from polycnc.cycles.milling import contour_pocket, region, residual
from polycnc.cycles.milling.contour_pocket import ContourPocket, InsertionError, StartError
from polycnc.cycles.milling.pockets import Insertion
from polycnc.cycles.milling.region import RegionError
from polycnc.cycles.milling.stroke import steps
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.levels import Levels
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.cycles.milling.stroke import MillStroke
    from polycnc.cycles.turning.contour import Contour

#: Units of VARI beside roughing.
REST, BASE, EDGE = FINISHING, 3, 4
#: Those that follow the walls alone.
ALONG_WALLS = (EDGE, CHAMFER)
#: Tens of VARI: into what is predrilled, straight down, on a helix, to and fro.
INSERTIONS = {0: Insertion.FEED, 1: Insertion.FEED, 2: Insertion.HELIX, 3: Insertion.OSCILLATION}
#: Places of the digits of VARI: insertion, where the tool rises to between two, who chooses the start point.
_INSERTION_PLACE, _RISE_PLACE, _START_PLACE = 1, 3, 4
#: How far the tool rises between two insertions: to the retraction plane, or to the safety plane.
TO_RETRACT, TO_SAFE = 0, 1
#: No digit of VARI is known from here on, nor in its hundreds.
HIGHEST_VARI = 100_000
#: Hundreds of _DMODE: pocket (0 in older calls) or spigot; those of _GMODE may ask for the start point alone.
_HUNDREDS = 2
POCKETS, SPIGOT = (0, 1), 2
#: Who chooses the start point: ten-thousands of VARI.
BY_CYCLE, BY_CALL = 0, 1
#: What is wrong with contours, and the alarm of it; else preparation failed.
REGION_ALARMS = {
    "open": "61605",
    "crossing": "61605",
    "nested": "61605",
    "no inside": "61605",
    "narrow": "61105",
}


def mill(moves: Moves, a: Arguments) -> None:
    """CYCLE63: clear a pocket with islands, or what stands round spigots; finish the base or the edges.

    Raises:
        AlarmError: As the other milling cycles; 61605 for contours that are open, cross, lie in each other or are too
            few, 61606 where they cannot be followed, 61105 for a cutter that goes in nowhere, 61108 for a helix or an
            oscillation without room, 61607 for a start point from which it cannot go on; for residual material 17190
            and 61000 for a reference cutter that does not exist; PC0001 for a mere calculation, a start point of an
            oscillation, of residual material or of edges.
    """
    radius = radius_of(moves, a, "_VARI")
    if radius <= NO_WAY:
        raise AlarmError("61117")
    kind = a.digit("_VARI", 0)
    _refuse(a, kind)
    base_allowance = abs(a["_UZ"]) if kind in (ROUGHING, REST) else 0.0
    chamfers = kind == CHAMFER
    found = chamfer(moves, a).levels if chamfers else milling_levels(moves, a, base_allowance, "_DZ")
    if found is None:
        return
    insertion = INSERTIONS.get(a.digit("_VARI", _INSERTION_PLACE))
    if insertion is None:
        raise AlarmError("61002")
    feed = feed_of(a, "_F")
    # Down along the wall nothing is left; into the material the feed must be told.
    walls = kind in ALONG_WALLS
    into = not walls and insertion is Insertion.FEED
    depth_feed = feed_of(a, "_FZ") if into else a["_FZ"] or feed
    helix, pitch, angle = abs(a["_ER"]), abs(a["_EP"]), abs(a["_EW"])
    if not walls and (
        (insertion is Insertion.HELIX and not (helix and pitch))
        or (insertion is Insertion.OSCILLATION and not 0.0 < angle < 90.0)
    ):
        raise AlarmError("61108")
    shape = ContourPocket(
        [],
        None,
        radius,
        (0.0 if chamfers else abs(a["_UXY"])) if walls else width_of_cut(a, radius, "_DXY"),
        is_ccw(moves, a.integer("_CDIR"), inside=True),
        feed,
        depth_feed,
        found.reference,
        found.safe,
        found.retract,
        abs(a["SDIS"]),
        0.0 if walls else abs(a["_UXY"]),
        insertion,
        helix,
        pitch,
        angle,
        (a["_XS"], a["_YS"]) if a.digit("_VARI", _START_PLACE) == BY_CALL else None,
    )
    total = _above_allowance(found, base_allowance)
    levels = [found.depth]
    if kind not in (BASE, CHAMFER):
        levels = [found.reference + found.down * below for below in steps(total, abs(a["_DZ"]))]
    read_chosen(moves, partial(_mill, moves, a, shape, levels))


def _above_allowance(found: Levels, allowance: float) -> float:
    """How deep the cutter goes where an allowance is left on the base; 61110 where nothing is above that."""
    deep = abs(found.depth - found.reference) - allowance
    if deep <= NO_WAY:
        raise AlarmError("61110")
    return deep


def _refuse(a: Arguments, kind: int) -> None:
    """What no call may ask for, and what is not executed."""
    if kind not in (ROUGHING, REST, BASE, EDGE, CHAMFER):
        raise AlarmError("61002")
    if a.integer("_VARI") < 0 or a.digit("_VARI", _RISE_PLACE) not in (TO_RETRACT, TO_SAFE):
        raise AlarmError("61002")
    if a.integer("_CDIR") not in (0, 1):
        raise AlarmError("61109")
    unknown = {
        "_TR": a.cycle == "CYCLE63" and kind not in (ROUGHING, REST) and bool(a.text("_TR").strip()),
        "_VARI": _start_is_unknown(a, kind)
        or a.digit("_VARI", _HUNDREDS) != 0
        or a.integer("_VARI") >= HIGHEST_VARI,
        "_GMODE": a.digit("_GMODE", _HUNDREDS) >= ONLY_START,
        "_DMODE": a.digit("_DMODE", _HUNDREDS) not in (*POCKETS, SPIGOT),
    }
    for name, wrong in unknown.items():
        if wrong:
            raise not_supported(f"{a.cycle} {name}")


def _is_rest(a: Arguments) -> bool:
    """Whether a call mills what a reference cutter has left: roughing with one."""
    return a.cycle == "CYCLE63" and (
        a.digit("_VARI", 0) == REST or (a.digit("_VARI", 0) == ROUGHING and bool(a.text("_TR").strip()))
    )


def _start_is_unknown(a: Arguments, kind: int) -> bool:
    """Whether a call names a start point in a way that is not executed."""
    chooser = a.digit("_VARI", _START_PLACE)
    is_slope = INSERTIONS.get(a.digit("_VARI", _INSERTION_PLACE)) is Insertion.OSCILLATION
    return chooser not in (BY_CYCLE, BY_CALL) or (
        chooser == BY_CALL and (kind in (REST, *ALONG_WALLS) or is_slope)
    )


def _with_walls(a: Arguments, shape: ContourPocket, contours: list[Contour]) -> ContourPocket:
    """The shape with the contours that were read: the first one is the pocket, or the blank round spigots."""
    first, *others = ([piece.edge for piece in contour] for contour in contours)
    if a.digit("_DMODE", _HUNDREDS) != SPIGOT:
        return replace(shape, walls=region.walls(first, others))
    if not others:
        raise RegionError("open")
    blank, *spigots = region.walls(first, others, free_outside=True)
    return replace(shape, walls=spigots, blank=blank)


def _work(
    moves: Moves, a: Arguments, shape: ContourPocket
) -> Callable[[ContourPocket, Sequence[float]], Iterator[MillStroke]]:
    """What a call does with a shape and its levels.

    Raises:
        AlarmError: For residual material 61000 without reference cutter, 61105 for one that is no larger.
    """
    kind = a.digit("_VARI", 0)
    if kind in ALONG_WALLS:
        return contour_pocket.finish_edges
    if not _is_rest(a):
        return contour_pocket.rough
    if not a.text("_TR").strip():
        raise AlarmError("61000")
    reference = _cutter_radius(moves, a)
    if reference <= shape.radius + NO_WAY:
        raise AlarmError("61105")
    return partial(residual.rough, reference=reference)


def _mill(
    moves: Moves, a: Arguments, shape: ContourPocket, levels: list[float], contours: list[Contour]
) -> None:
    """Mill what the contours enclose."""
    work = _work(moves, a, shape)
    try:
        strokes = list(work(_with_walls(a, shape, contours), levels))
    except RegionError as error:
        raise AlarmError(REGION_ALARMS.get(str(error), "61606")) from None
    except InsertionError:
        raise AlarmError("61108") from None
    except StartError:
        raise AlarmError("61607") from None
    rises_less = a.digit("_VARI", _RISE_PLACE) == TO_SAFE
    perform(moves, contour_pocket.rising_to(shape, strokes, shape.safe) if rises_less else strokes)


# ---- predrilling


def predrill(moves: Moves, a: Arguments) -> None:
    """CYCLE64: drill where CYCLE63 with the cutter `_TR`, `_DR` will go in, to the depth less the base's allowance.

    Raises:
        AlarmError: 61000 without tool offset, 17190 for a cutter that does not exist, else as `mill`.
    """
    require_tool(moves)
    _refuse(a, ROUGHING)
    found = milling_levels(moves, a, 0.0, "_UZ") if a["_UZ"] else milling_levels(moves, a, 0.0, "_DXY")
    if found is None:
        return
    radius = _cutter_radius(moves, a)
    shape = ContourPocket(
        [],
        None,
        radius,
        width_of_cut(a, radius, "_DXY"),
        is_ccw(moves, a.integer("_CDIR"), inside=True),
        feed_of(a, "_F"),
        a["_F"],
        found.reference,
        found.safe,
        found.retract,
        abs(a["SDIS"]),
        abs(a["_UXY"]),
    )
    read_chosen(moves, partial(_drill, moves, a, found, shape))


def _cutter_radius(moves: Moves, a: Arguments) -> float:
    """Radius of the cutter that will follow; without one that of the tool in the spindle."""
    if not a.text("_TR").strip():
        return cutter(moves)
    tools = moves.memory.tools
    edge = tools.find(a.text("_TR")).edges.get(max(a.integer("_DR"), 1))
    if edge is None:
        raise AlarmError("61000")
    if edge.radius() <= 0.0:
        raise AlarmError("61117")
    return edge.radius()


def _drill(moves: Moves, a: Arguments, found: Levels, shape: ContourPocket, contours: list[Contour]) -> None:
    """A hole at every place where the cutter goes in."""
    try:
        places = contour_pocket.entries(_with_walls(a, shape, contours))
    except RegionError as error:
        raise AlarmError(REGION_ALARMS.get(str(error), "61606")) from None
    bottom = found.reference + found.down * _above_allowance(found, abs(a["_UZ"]))
    moves.rapid(w=found.retract)
    moves.end_block()
    between = found.safe if a.digit("_VARI", _RISE_PLACE) == TO_SAFE else found.retract
    for number, place in enumerate(places, 1):
        moves.rapid(*place)
        moves.end_block()
        moves.rapid(w=found.safe)
        moves.end_block()
        moves.feed(shape.feed, w=bottom)
        moves.end_block()
        moves.rapid(w=found.retract if number == len(places) else between)
        moves.end_block()
