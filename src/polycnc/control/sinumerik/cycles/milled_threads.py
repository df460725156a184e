"""Milled threads CYCLE70, CYCLE90, and CYCLE78 that drills as well (strokes: `polycnc.cycles.milling`)."""

from __future__ import annotations

from polycnc.control.sinumerik.cycles.drilling import written_pitch
from polycnc.control.sinumerik.cycles.levels import levels
from polycnc.control.sinumerik.cycles.milling import (
    FINISHING,
    ROUGHING,
    check_start_point,
    cutter,
    feed_of,
    is_ccw,
    perform,
    reference_point,
)
from polycnc.control.sinumerik.errors import not_supported
from polycnc.cycles.drilling.deep_hole import degressive_depths
from polycnc.cycles.milling import drilled_thread
from polycnc.cycles.milling import thread as thread_milling
from polycnc.cycles.milling.stroke import Place, steps
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves


def thread(moves: Moves, a: Arguments) -> None:
    """CYCLE90: internal (TYPTH 0) or external thread on a helix; CDIR 2 is G2, 3 is G3."""
    radius = cutter(moves)
    if a.integer("CDIR") not in (2, 3):
        raise AlarmError("61109")
    if a.integer("TYPTH") not in (0, 1):
        raise AlarmError("61002")
    if not a["PIT"] > 0.0:
        raise AlarmError("61001")
    inside = a.integer("TYPTH") == 0
    size = abs(a["DIATH"]) / 2.0 - radius if inside else abs(a["KDIAM"]) / 2.0 + radius
    if inside and 2.0 * radius >= abs(a["KDIAM"] or a["DIATH"]):
        raise AlarmError("61105")
    found = levels(moves, a)
    if found is None:
        return
    milled = thread_milling.MilledThread(
        Place(reference_point(moves, a)),
        size,
        a["PIT"],
        found.reference,
        found.depth,
        ccw=a.integer("CDIR") == 3,
        inside=inside,
        clearance=radius + abs(a["SDIS"]),
        feed=feed_of(a, "FFR"),
        retract=found.retract,
    )
    perform(moves, thread_milling.mill(milled))


#: Tens of VARI of CYCLE70: where the thread begins; hundreds: its hand.
DOWNWARDS, UPWARDS = 1, 2
RIGHT_HAND, LEFT_HAND = 0, 1
#: No digit of VARI of CYCLE70 is known from here on.
HIGHEST_VARI = 1000


def thread_with_teeth(moves: Moves, a: Arguments) -> None:
    """CYCLE70: internal or external thread in passes, with a cutter of one tooth or of several in a row.

    Raises:
        AlarmError: As the other milling cycles; 61001 without pitch or depth of thread, 61002 for VARI or TYPTH, 61010
            for an allowance of more than the thread's depth, 61105 for a cutter that does not go into the core hole,
            61601 for an external thread without core;
            PC0001 for a pitch by module, a negative number of teeth and higher digits of VARI.
    """
    radius = cutter(moves)
    check_start_point(a)
    kind, way, hand = (a.digit("_VARI", place) for place in range(3))
    teeth = a.integer("_NT")
    if teeth < 0 or not 0 <= a.integer("_VARI") < HIGHEST_VARI:
        raise not_supported("CYCLE70 _NT" if teeth < 0 else "CYCLE70 _VARI")
    is_inside = a.integer("_TYPTH") == 0
    if (
        kind not in (ROUGHING, FINISHING)
        or way not in (DOWNWARDS, UPWARDS)
        or hand not in (RIGHT_HAND, LEFT_HAND)
        or a.integer("_TYPTH") not in (0, 1)
    ):
        raise AlarmError("61002")
    lead, deep = abs(written_pitch(a, "_PIT")), abs(a["_H1"])
    if not lead or not deep:
        raise AlarmError("61001")
    if abs(a["_FAL"]) >= deep:
        raise AlarmError("61010")
    found = levels(moves, a)
    if found is None:
        return
    outer = 0.5 * abs(a["_DIATH"])
    if not is_inside and deep >= outer:
        raise AlarmError("61601")
    if is_inside and radius >= outer - deep:
        raise AlarmError("61105")
    cuts = steps(deep - abs(a["_FAL"]), abs(a["_MID"])) if kind == ROUGHING else [deep]
    rises = way == UPWARDS
    outwards = -found.down if rises else found.down
    milled = thread_milling.ToothedThread(
        Place(reference_point(moves, a), a["_NSP"]),
        [outer - deep + cut - radius if is_inside else outer - cut + radius for cut in cuts],
        lead,
        max(teeth, 1),
        found.reference,
        found.depth,
        rises,
        ccw=(outwards > 0.0) is (hand == RIGHT_HAND),
        beside=0.0 if is_inside else outer + 2.0 * radius + abs(a["SDIS"]),
        feed=feed_of(a, "_FFR"),
        safe=found.safe,
        retract=found.retract,
    )
    perform(moves, thread_milling.mill_with_teeth(milled))


# ---- drilling and milling with one tool

#: Digits of _VARI of CYCLE78: the feed changes for the last part of the hole, is lower for the first one.
_LAST_PART, _FIRST_PART = 3, 4
HIGHEST_VARI_OF_DRILLING = 100_000
#: Senses of milling that are known: climb, up-cut; and first up-cut, then climb.
CLIMB, UP_CUT, BOTH = 0, 1, 4
#: Predrilling: up to this feed (mm/rev) a part of it, from it on another one, mm/rev.
LIGHT_FEED, PART_OF_LIGHT_FEED, PREDRILLING_FEED = 0.15, 0.3, 0.1


def drill_and_mill(moves: Moves, a: Arguments) -> None:
    """CYCLE78: drill a hole and mill its thread with the same tool, where it stands.

    Raises:
        AlarmError: As the other milling cycles; 61001 without pitch, 61002 for VARI, 61105 for a tool that is as wide
            as the thread, 61107 for parts at feeds of their own that are longer than the hole, 61109 for another sense
            of milling; PC0001 for what is not known well enough.
    """
    radius = cutter(moves)
    if a.integer("_CDIR") not in (CLIMB, UP_CUT, BOTH):
        raise AlarmError("61109")
    lead = abs(written_pitch(a, "_PIT"))
    if not lead:
        raise AlarmError("61001")
    size = 0.5 * abs(a["_DIAM"]) - radius
    if size <= NO_WAY:
        raise AlarmError("61105")
    _refuse(moves, a)
    found = levels(moves, a)
    if found is None:
        return
    ccw, up = is_ccw(moves, a.integer("_CDIR"), inside=True), -found.down
    # A right-hand thread is left clockwise into the hole, as seen along the tool, and the other way out of it.
    step = lead if ccw else -lead
    start = found.depth + up * abs(a["_GE"])
    if (start + drilled_thread.TURNS * step - found.depth) * up < -NO_WAY:
        raise not_supported("CYCLE78 _GE")
    total = abs(found.depth - found.reference)
    first = min(abs(a["_FDPR"]), total) or total
    thread = drilled_thread.DrilledThread(
        Place(moves.point),
        found.reference,
        found.safe,
        found.retract,
        found.depth,
        degressive_depths(first, total, -_share(a), abs(a["_MDEP"])),
        _stages(moves, a, total),
        size,
        start,
        step,
        ccw,
        feed_of(a, "_FFR"),
    )
    perform(moves, drilled_thread.drill_and_mill(thread))


def _refuse(moves: Moves, a: Arguments) -> None:
    """What is not known well enough: digits that no parameter explains, feeds that are not per minute."""
    parts = {"_LDPR": _LAST_PART, "_ADPR": _FIRST_PART}
    if not a.integer("_VARI") >= 0 or any(a.digit("_VARI", place) > 1 for place in parts.values()):
        raise AlarmError("61002")
    unknown = {
        "_VARI": any(a.digit("_VARI", place) for place in range(_LAST_PART))
        or a.integer("_VARI") >= HIGHEST_VARI_OF_DRILLING,
        "_CDIR": a.integer("_CDIR") == BOTH,
        "_FFA": a.integer("_FFA") != 0 or moves.channel.mode["feed"] != "G94",
        "_DAM": 0.0 < a.plain("_DAM") <= 1.0 or not 0.0 <= a.plain("_DAM") <= 100.0,
        **{name: bool(a[name]) is not (a.digit("_VARI", place) == 1) for name, place in parts.items()},
    }
    for name, wrong in unknown.items():
        if wrong:
            raise not_supported(f"CYCLE78 {name}")


def _share(a: Arguments) -> float:
    """Each stroke as a part of the one before; 0 for equal strokes."""
    share = a.plain("_DAM") / 100.0
    return 0.0 if share == 1.0 else share


def _stages(moves: Moves, a: Arguments, total: float) -> list[tuple[float, float]]:
    """The drilling feeds, and down to which depth each counts; 61107 for more than the hole."""
    feed, first, last = feed_of(a, "_FFD"), abs(a["_ADPR"]), abs(a["_LDPR"])
    if first + last > total + NO_WAY:
        raise AlarmError("61107")
    stages = [(total - last, feed)]
    if first:
        speed = moves.spindle.speed / 60.0
        is_light = feed < LIGHT_FEED * speed
        stages.insert(0, (first, PART_OF_LIGHT_FEED * feed if is_light else PREDRILLING_FEED * speed))
    if last:
        stages.append((total, feed_of(a, "_FRDP")))
    return stages
