"""Pockets, slots, elongated holes: POCKET1 to POCKET4, SLOT1, SLOT2, LONGHOLE, CYCLE899 (shapes: `polycnc.cycles`)."""

from __future__ import annotations

from math import radians, sin

from polycnc.channel.stack import LevelKind
from polycnc.control.sinumerik.cycles.chamfers import CHAMFER, chamfer, is_chamfer
from polycnc.control.sinumerik.cycles.levels import levels
from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.errors import not_supported
from polycnc.cycles.count import checked
from polycnc.cycles.milling import open_slot as open_slots
from polycnc.cycles.milling import pockets, slots
from polycnc.cycles.milling.open_slot import OpenSlot
from polycnc.cycles.milling.pockets import Insertion, Pocket
from polycnc.cycles.milling.stroke import MillStroke, Place, steps
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.levels import Levels
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.geometry.arcs import Point

#: Width of a cut where the call gives none, as part of the tool's diameter.
USUAL_WIDTH = 0.8
TURN = 360.0
#: Units of VARI.
COMPLETE, ROUGHING, FINISHING, EDGE = 0, 1, 2, 4


def perform(moves: Moves, strokes: Iterable[MillStroke]) -> None:
    """Make the strokes of a milling cycle; every stroke is a block."""
    for stroke in strokes:
        u, v = stroke.point or (None, None)
        match stroke.kind:
            case Kind.RAPID:
                moves.rapid(u, v, stroke.w)
            case Kind.FEED:
                moves.feed(stroke.feed, u, v, stroke.w)
            case _ if stroke.point is not None and stroke.center is not None:
                ccw = stroke.kind is Kind.CCW
                moves.arc(stroke.feed, stroke.point, stroke.center, ccw, stroke.w)
        moves.end_block()


# ---- what the cycles check alike


def cutter(moves: Moves, *, deep: bool = False) -> float:
    """Radius of a cutter as `require_tool` gives it; 61117 for one that is not above zero."""
    radius = require_tool(moves, deep=deep)
    if radius <= 0.0:
        raise AlarmError("61117")
    return radius


def radius_of(moves: Moves, a: Arguments, name: str) -> float:
    """Radius that follows the walls: the cutter's, or that of the cone that makes a chamfer."""
    if is_chamfer(a, name):
        require_tool(moves)
        return chamfer(moves, a).radius
    return cutter(moves)


def feed_of(a: Arguments, name: str) -> float:
    """A feed of the call; 61003 for one that is not above zero."""
    if a[name] <= 0.0:
        raise AlarmError("61003")
    return a[name]


def is_ccw(moves: Moves, direction: int, *, inside: bool) -> bool:
    """Sense of rotation: 0 climb and 1 up-cut milling by the spindle, 2 G2, 3 G3.

    Raises:
        AlarmError: 61109 for another value, 61102 where the spindle would say but does not turn.
    """
    if direction not in (0, 1, 2, 3):
        raise AlarmError("61109")
    if direction in (2, 3):
        return direction == 3
    spindle = moves.spindle.direction
    if spindle == 0:
        raise AlarmError("61102")
    climb = (spindle > 0) is inside
    return climb is (direction == 0)


def variant(a: Arguments, name: str, allowed: tuple[int, ...], digits: int = 2) -> int:
    """Units of VARI.

    Raises:
        AlarmError: 61002 for one that the cycle does not have, or below zero; PC0001 for digits that are not known.
    """
    check_start_point(a)
    value = a.digit(name, 0)
    if (value not in allowed and not is_chamfer(a, name)) or a.integer(name) < 0:
        raise AlarmError("61002")
    if a.integer(name) >= 10**digits:
        raise not_supported(f"{a.cycle} {name}")
    return value


def width_of_cut(a: Arguments, radius: float, name: str = "_MIDA") -> float:
    """Step in the plane: as given, as a percentage of the tool's diameter (_AMODE tens), or 80 % of it.

    Raises:
        AlarmError: 61111 for a step that is wider than the tool.
    """
    diameter = 2.0 * radius
    width = abs(a[name])
    if a.digit("_AMODE", 1) == 1 and a.plain(name):
        width = abs(a.plain(name)) / 100.0 * diameter
    if width > diameter + NO_WAY:
        raise AlarmError("61111")
    return width or USUAL_WIDTH * diameter


def milling_levels(moves: Moves, a: Arguments, base_allowance: float, infeed: str) -> Levels | None:
    """Levels of a cycle whose depth may be given alone; 61110 for an allowance deeper than an infeed."""
    found = levels(moves, a)
    if found is not None and a[infeed] > 0.0 and base_allowance > a[infeed]:
        raise AlarmError("61110")
    return found


def levels_of_work(moves: Moves, a: Arguments, kind: int, base_allowance: float) -> Levels | None:
    """Levels as `milling_levels`, or those of a chamfer."""
    return chamfer(moves, a).levels if kind == CHAMFER else milling_levels(moves, a, base_allowance, "_MID")


def reference_point(moves: Moves, a: Arguments) -> Point:
    """PA, PO (CPA, CPO); where the cycle is modal and both are 0, the position that was reached."""
    given = (a["_PA"], a["_PO"]) if a.has("_PA") else (a["CPA"], a["CPO"])
    return moves.point if moves.channel.level.kind is LevelKind.MODAL and given == (0.0, 0.0) else given


#: Digits of _GMODE: how the shape is dimensioned, and whether all of a pocket is milled (1).
#: In its hundreds 2 asks for the start point alone.
_START_POINT_PLACE, _DIMENSIONING_PLACE, _PREMACHINED_PLACE = 2, 3, 4
ONLY_START = 2
WHOLE = 1
FROM_MIDDLE = 1
#: On which side of the reference point the shape lies, by the thousands of _GMODE: about it, or from a corner: the left
#: or right one below, the left or right one above.
SIDES_OF_REFERENCE = {
    0: (0.0, 0.0), 1: (0.0, 0.0), 2: (1.0, 1.0), 3: (-1.0, 1.0), 4: (1.0, -1.0), 5: (-1.0, -1.0)
}  # fmt: skip


def place_of(moves: Moves, a: Arguments, length: float, width: float) -> Place:
    """Middle and angle of a rectangular shape, from its reference point, which may be one of its corners.

    Raises:
        AlarmError: PC0001 for a corner that does not exist.
    """
    sides = SIDES_OF_REFERENCE.get(a.digit("_GMODE", _DIMENSIONING_PLACE))
    if sides is None:
        raise not_supported(f"{a.cycle} _GMODE")
    corner = Place(reference_point(moves, a), a["_STA"])
    return Place(corner(0.5 * sides[0] * length, 0.5 * sides[1] * width), a["_STA"])


def check_start_point(a: Arguments) -> None:
    """PC0001 where the start point alone is asked for: milling would be more than that."""
    if a.digit("_GMODE", _START_POINT_PLACE) >= ONLY_START:
        raise not_supported(f"{a.cycle} _GMODE")


# ---- pockets

#: Digit of _DMODE of POCKET4: what tells its size.
_SIZE_PLACE, DIAMETER = 2, 1
#: Digit of _VARI of POCKET4: level by level (0), or ring by ring on helices.
_STRATEGY_PLACE, ON_HELICES = 3, 1


def pocket3(moves: Moves, a: Arguments) -> None:
    """POCKET3: rectangular pocket about its middle or from a corner."""
    radius = radius_of(moves, a, "_VARI")
    length, width, corner = abs(a["_LENG"]), abs(a["_WID"]), abs(a["_CRAD"])
    if not length or not width:
        raise AlarmError("61118")
    if 2.0 * corner > min(length, width) + NO_WAY:
        raise AlarmError("61113")
    if radius > corner + NO_WAY and corner > 0.0:
        raise AlarmError("61105")
    core = (abs(a["_AP1"]), abs(a["_AP2"]) or abs(a["_AP1"]))
    _pocket(moves, a, (length, width, corner), core, radius)


def pocket4(moves: Moves, a: Arguments) -> None:
    """POCKET4: circular pocket; its size is a radius, or a diameter where hundreds of _DMODE say so."""
    radius = radius_of(moves, a, "_VARI")
    size = abs(a["_PRAD"]) * (0.5 if a.digit("_DMODE", _SIZE_PLACE) == DIAMETER else 1.0)
    strategy = a.digit("_VARI", _STRATEGY_PLACE)
    if strategy > ON_HELICES:
        raise AlarmError("61002")
    if a.digit("_VARI", 2) or (strategy == ON_HELICES and a.digit("_VARI", 0) != ROUGHING):
        raise not_supported("POCKET4 _VARI")
    _pocket(moves, a, (2.0 * size, 2.0 * size, size), (abs(a["_AP1"]), abs(a["_AP1"])), radius)


def _pocket(
    moves: Moves, a: Arguments, size: tuple[float, float, float], core: tuple[float, float], radius: float
) -> None:
    is_round = a.has("_PRAD")
    kind = variant(a, "_VARI", (ROUGHING, FINISHING, EDGE), digits=_STRATEGY_PLACE + 1 if is_round else 2)
    if a.digit("_GMODE", _PREMACHINED_PLACE) == WHOLE:
        core = (0.0, 0.0)
    base_allowance = 0.0 if kind in (EDGE, CHAMFER) else abs(a["_FALD"])
    found = levels_of_work(moves, a, kind, base_allowance)
    if found is None:
        return
    insertion = a.digit("_VARI", 1)
    if insertion not in (0, 1, 2, 3) or (insertion == 3 and size[0] == size[1] == 2.0 * size[2]):
        raise AlarmError("61002")
    way = Insertion(insertion)
    helix, pitch = abs(a["_RAD1"]), abs(a["_DP1"])
    if way is Insertion.OSCILLATION:
        helix = abs(a.plain("_RAD1"))
    on_helices = is_round and a.digit("_VARI", _STRATEGY_PLACE) == ON_HELICES
    if (
        kind == ROUGHING
        and not on_helices
        and (
            (way is Insertion.HELIX and not (helix and pitch)) or (way is Insertion.OSCILLATION and not helix)
        )
    ):
        raise AlarmError("61108")
    pocket = Pocket(
        Place(reference_point(moves, a)) if is_round else place_of(moves, a, size[0], size[1]),
        size[0] / 2.0,
        size[1] / 2.0,
        size[2],
        radius,
        found.reference,
        found.safe,
        found.retract,
        found.depth,
        0.0 if kind == CHAMFER else abs(a["_MID"]),
        0.0 if kind == CHAMFER else width_of_cut(a, radius),
        feed_of(a, "_FFP1"),
        feed_of(a, "_FFD"),
        is_ccw(moves, a.integer("_CDIR"), inside=True),
        allowance=0.0 if kind == CHAMFER else abs(a["_FAL"]),
        base_allowance=base_allowance,
        insertion=way,
        insertion_size=helix,
        pitch=pitch,
        core_length=core[0],
        core_width=core[1],
        core_depth=abs(a["_AD"]),
    )
    if on_helices:
        if not pockets.fits(pocket):
            raise AlarmError("61105")
        perform(moves, pockets.rough_on_helices(pocket))
        return
    _mill(moves, along(pocket), kind if kind in (COMPLETE, ROUGHING) else FINISHING)


def along(pocket: Pocket) -> Pocket:
    """The same pocket with its long side first."""
    if pocket.half_length >= pocket.half_width:
        return pocket
    place = Place(pocket.place.origin, pocket.place.angle_deg + 90.0)
    return replace(
        pocket,
        place=place,
        half_length=pocket.half_width,
        half_width=pocket.half_length,
        core_length=pocket.core_width,
        core_width=pocket.core_length,
    )


def _mill(
    moves: Moves, pocket: Pocket, kind: int, finishing: Pocket | None = None, speed: float = 0.0
) -> None:
    """Rough, finish, or both; 61105 for a tool that does not go in."""
    if not pockets.fits(pocket):
        raise AlarmError("61105")
    if kind in (COMPLETE, ROUGHING):
        perform(moves, pockets.rough(pocket))
    if kind in (COMPLETE, FINISHING):
        perform_at_speed(moves, speed, pockets.finish(finishing or pocket))


def perform_at_speed(moves: Moves, speed: float, strokes: Iterable[MillStroke]) -> None:
    """Strokes with a spindle speed of their own (SSF), 0 for the one in force."""
    before = moves.spindle.speed
    if speed > 0.0:
        moves.speed(speed)
    perform(moves, strokes)
    moves.speed(before)


def older_pocket(moves: Moves, a: Arguments) -> None:
    """POCKET1 (rectangular), POCKET2 (circular): in with G1 in the middle; complete, roughing or finishing."""
    radius = cutter(moves)
    kind = variant(a, "VARI", (COMPLETE, ROUGHING, FINISHING), digits=1)
    found = levels(moves, a)
    if found is None:
        return
    circular = a.cycle == "POCKET2"
    length = 2.0 * abs(a["PRAD"]) if circular else abs(a["LENG"])
    width, corner = (length, length / 2.0) if circular else (abs(a["WID"]), abs(a["CRAD"]))
    if 2.0 * corner > min(length, width) + NO_WAY:
        raise AlarmError("61113")
    rough = Pocket(
        Place(reference_point(moves, a), 0.0 if circular else a["STA1"]),
        length / 2.0,
        width / 2.0,
        corner,
        radius,
        found.reference,
        found.safe,
        found.retract,
        found.depth,
        abs(a["MID"]),
        USUAL_WIDTH * 2.0 * radius,
        feed_of(a, "FFP1"),
        feed_of(a, "FFD"),
        is_ccw(moves, a.integer("CDIR"), inside=True),
        allowance=abs(a["FAL"]),
    )
    fine = replace(rough, infeed=abs(a["MIDF"]), feed=a["FFP2"] or rough.feed)
    _mill(moves, along(rough), kind, along(fine), a["SSF"])


# ---- patterns of slots

#: Where the reference point of a straight slot lies, by the thousands of _GMODE: its middle, the middle of its first or
#: last half circle, its first or last edge; as parts of the length between the half circles and of the width by which
#: the first half circle's middle lies behind it.
PLACES_OF_REFERENCE = {
    0: (0.0, 0.5), 1: (-0.5, 0.0), 2: (0.0, 0.0), 3: (-1.0, 0.0), 4: (0.0, 0.5), 5: (-1.0, -0.5)
}  # fmt: skip
#: Thousands of VARI of SLOT2: the slots lie on all of the circle, whatever INDA says, or on a part of it by INDA.
ALL_OF_CIRCLE, PART_OF_CIRCLE = 1, 2


def _first_middle(a: Arguments, length: float, width: float) -> float:
    """How far along a slot from the reference point its first half circle's middle lies, RAD included.

    Raises:
        AlarmError: PC0001 for a reference point that is not known.
    """
    place = PLACES_OF_REFERENCE.get(a.digit("_GMODE", _DIMENSIONING_PLACE))
    if place is None:
        raise not_supported(f"{a.cycle} _GMODE")
    return abs(a["RAD"]) + place[0] * length + place[1] * width


def _angles(a: Arguments) -> list[float]:
    """Directions of the elements on their circle; 61106 for none, or a pattern beyond one turn."""
    count, pitch = checked(abs(a.integer("NUM"))), _pitch(a)
    if count == 0 or abs(pitch) * (count - 1) >= TURN:
        raise AlarmError("61106")
    pitch = pitch or TURN / count
    return [a["STA1"] + k * pitch for k in range(count)]


def _pitch(a: Arguments) -> float:
    """INDA; 0 where the elements lie on all of the circle."""
    return 0.0 if a.cycle == "SLOT2" and a.digit("VARI", 3) == ALL_OF_CIRCLE else a["INDA"]


def _apart(a: Arguments, count: int) -> float:
    """The angle between neighbours, at most half a turn."""
    pitch = abs(_pitch(a)) or TURN / count
    return min(pitch, 180.0)


def _slotting(moves: Moves, a: Arguments, found: Levels, insertion: Insertion) -> slots.Slotting:
    """How the slots of a call are milled; 61105 for a cutter that does not fit the width."""
    radius, chamfers = radius_of(moves, a, "VARI"), is_chamfer(a, "VARI")
    width = abs(a["WID"])
    if 2.0 * radius > width + NO_WAY or (2.0 * radius <= width / 2.0 and not chamfers):
        raise AlarmError("61105")
    feed = feed_of(a, "FFP1")
    return slots.Slotting(
        half_width=width / 2.0,
        radius=radius,
        reference=found.reference,
        safe=found.safe,
        retract=found.retract,
        depth=found.depth,
        infeed=abs(a["MID"]),
        finishing_infeed=0.0 if chamfers else abs(a["MIDF"]),
        allowance=abs(a["FAL"]),
        base_allowance=abs(a["_FALD"]),
        feed=feed,
        depth_feed=feed_of(a, "FFD"),
        finishing_feed=feed if chamfers else a["FFP2"] or feed,
        ccw=is_ccw(moves, a.integer("CDIR"), inside=True),
        insertion=insertion,
        steepest_deg=abs(a["_STA2"]),
    )


def _mill_slot(moves: Moves, a: Arguments, slotting: slots.Slotting, shape: slots.Shape) -> None:
    """One slot: roughing, finishing, or complete."""
    kind = variant(a, "VARI", (COMPLETE, ROUGHING, FINISHING, EDGE), digits=4 if a.cycle == "SLOT2" else 2)
    if kind in (COMPLETE, ROUGHING):
        perform(moves, slots.rough(slotting, shape))
    if kind in (CHAMFER, EDGE):
        perform_at_speed(moves, 0.0 if kind == CHAMFER else a["SSF"], slots.finish(slotting, shape))
    elif kind == FINISHING or (kind == COMPLETE and slotting.leaves_allowance):
        perform_at_speed(moves, a["SSF"], slots.finish(slotting, shape))
    moves.rapid(w=slotting.retract)
    moves.end_block()


#: Insertion by the tens of VARI of SLOT1.
INSERTIONS = {0: Insertion.RAPID, 1: Insertion.FEED, 3: Insertion.OSCILLATION}


def slot1(moves: Moves, a: Arguments) -> None:
    """SLOT1: straight slots that point away from a centre."""
    require_tool(moves)
    insertion = INSERTIONS.get(a.digit("VARI", 1))
    if insertion is None:
        raise AlarmError("61002")
    found = chamfer(moves, a).levels if is_chamfer(a, "VARI") else levels(moves, a)
    if found is None:
        return
    slotting = _slotting(moves, a, found, insertion)
    angles, width = _angles(a), abs(a["WID"])
    length = abs(a["LENG"]) - width
    first = _first_middle(a, length, width)
    inner = max(first - width / 2.0, 0.0)
    if len(angles) > 1 and 2.0 * inner * sin(radians(_apart(a, len(angles)) / 2.0)) < width:
        raise AlarmError("61104")
    if length < 0.0:
        raise AlarmError("61105")
    center = reference_point(moves, a)
    for angle in angles:
        start = Place(center, angle)(first, 0.0)
        _mill_slot(moves, a, slotting, slots.Straight(Place(start, angle), length))


def slot2(moves: Moves, a: Arguments) -> None:
    """SLOT2: slots along a circle; from one to the next straight, or along the circle (tens of VARI).

    Raises:
        AlarmError: As the other milling cycles; 61118 for slots without length, which would be the whole circle.
    """
    require_tool(moves)
    if a.digit("VARI", 1) not in (0, 1) or a.digit("VARI", 3) > PART_OF_CIRCLE:
        raise AlarmError("61002")
    if a.digit("VARI", 2):
        raise not_supported("SLOT2 VARI")
    found = chamfer(moves, a).levels if is_chamfer(a, "VARI") else levels(moves, a)
    if found is None:
        return
    slotting = _slotting(moves, a, found, Insertion.FEED)
    angles = _angles(a)
    size, center = abs(a["RAD"]), reference_point(moves, a)
    if not a.plain("AFSL"):
        raise AlarmError("61118")
    if size <= abs(a["WID"]) / 2.0:
        raise AlarmError("61105")
    if len(angles) > 1 and slots.angle_of(abs(a["WID"]), size) + abs(a["AFSL"]) > _apart(a, len(angles)):
        raise AlarmError("61104")
    for number, angle in enumerate(angles):
        shape = slots.Curved(Place(center, angle), size, abs(a["AFSL"]))
        if number and a.digit("VARI", 1) == 1:
            moves.arc(feed_of(a, "_FFCP"), shape.start, center, angles[1] > angles[0])
            moves.end_block()
        _mill_slot(moves, a, slotting, shape)


def long_hole(moves: Moves, a: Arguments) -> None:
    """LONGHOLE: elongated holes as wide as the tool, milled to and fro."""
    radius = cutter(moves)
    check_start_point(a)
    found = levels(moves, a)
    if found is None:
        return
    length = abs(a["LENG"])
    if length < 2.0 * radius:
        raise AlarmError("61105")
    angles = _angles(a)
    inner = _first_middle(a, length - 2.0 * radius, 2.0 * radius)
    outer = inner + length - 2.0 * radius
    if len(angles) > 1 and inner * sin(radians(_apart(a, len(angles)) / 2.0)) < radius:
        raise AlarmError("61104")
    feed, depth_feed = feed_of(a, "FFP1"), feed_of(a, "FFD")
    center = reference_point(moves, a)
    for angle in angles:
        place = Place(center, angle)
        ends = place(inner, 0.0), place(outer, 0.0)
        strokes = slots.to_and_fro(ends, moves.point, found, abs(a["MID"]), feed, depth_feed)
        perform(moves, strokes)


# ---- an open slot

#: Units of VARI of CYCLE899 beside roughing, finishing and finishing of the walls; what is behind them: the technique.
BASE, PREFINISHING, OPEN_CHAMFER = 3, 5, 6
KINDS_OF_OPEN_SLOTS = (ROUGHING, FINISHING, BASE, EDGE, PREFINISHING, OPEN_CHAMFER)
TROCHOIDAL, PLUNGING = 1, 2
_TECHNIQUE_PLACES = (1, 2, 3)


def open_slot(moves: Moves, a: Arguments) -> None:
    """CYCLE899: a slot that is open at one end: roughed in circles or in plunges, or finished.

    Raises:
        AlarmError: As the other milling cycles; 61002 for VARI, 61105 for a tool that does not go in, 61118 for a slot
            without length or width; PC0001 for a mere start point, a reference point on one of its walls, and
            higher digits of VARI.
    """
    check_start_point(a)
    kind = a.digit("_VARI", 0)
    chamfers = kind == OPEN_CHAMFER
    require_tool(moves)
    radius = chamfer(moves, a).radius if chamfers else cutter(moves)
    technique = next((digit for place in _TECHNIQUE_PLACES if (digit := a.digit("_VARI", place))), TROCHOIDAL)
    if kind not in KINDS_OF_OPEN_SLOTS or technique not in (TROCHOIDAL, PLUNGING) or a.integer("_VARI") < 0:
        raise AlarmError("61002")
    if a.integer("_VARI") >= 10 ** (max(_TECHNIQUE_PLACES) + 1):
        raise not_supported("CYCLE899 _VARI")
    if a.digit("_GMODE", _DIMENSIONING_PLACE) > FROM_MIDDLE:
        raise not_supported("CYCLE899 _GMODE")
    length, width = abs(a["_LENG"]), abs(a["_WID"])
    if not length or not width:
        raise AlarmError("61118")
    base_allowance = abs(a["_FALD"]) if kind in (ROUGHING, PREFINISHING) else 0.0
    found = levels_of_work(moves, a, CHAMFER if chamfers else kind, base_allowance)
    if found is None:
        return
    slot = OpenSlot(
        Place(reference_point(moves, a), a["_STA"]),
        length,
        width,
        radius,
        0.0 if chamfers else width_of_cut(a, radius),
        allowance=0.0 if kind in (FINISHING, EDGE, OPEN_CHAMFER) else abs(a["_FAL"]),
        clearance=abs(a["SDIS"]) + (abs(a["_FS"]) if chamfers else 0.0),
        ccw=is_ccw(moves, a.integer("_CDIR"), inside=True),
        feed=feed_of(a, "_FFP1"),
        safe=found.safe,
        retract=found.retract,
    )
    if slot.reach < -NO_WAY or slot.last < -NO_WAY:
        raise AlarmError("61105")
    below = [found.depth]
    if kind not in (BASE, OPEN_CHAMFER):
        total = abs(found.depth - found.reference) - base_allowance
        below = [found.reference + found.down * part for part in steps(total, abs(a["_MID"]))]
    if kind != ROUGHING:
        perform(moves, open_slots.walls(slot, below, base=kind in (FINISHING, BASE)))
    elif technique == PLUNGING:
        perform(moves, open_slots.plunging(slot, below))
    else:
        perform(moves, open_slots.circling(slot, below))
