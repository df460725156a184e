"""Drilling cycles of the ISO dialect: G73, G74, G76 and G81 to G89 (strokes: `polycnc.cycles.drilling`).

A cycle is modal: it drills behind every block with words of axes or R until G80 or a motion function. The tool comes at
rapid over the hole, then to R; it ends where it began (G98) or at R (G99). R and the depth are absolute, or under G91 R
counts from where the tool began and the depth from R. K repeats, and under G91 each time a step further.
"""

from __future__ import annotations

from functools import partial

from polycnc.control.sinumerik.cycles import calls, drilling
from polycnc.control.sinumerik.cycles.table import Cycle
from polycnc.control.sinumerik.iso.running import Datum, HoleCycle
from polycnc.cycles.count import checked
from polycnc.cycles.drilling import deep_hole, holes
from polycnc.cycles.drilling.holes import Hole
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.geometry.tolerances import NO_WAY
from polycnc.language.sinumerik.iso_dialect import CORNERS, MOTIONS
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.iso.running import IsoRun
    from polycnc.cycles.drilling.holes import Stroke
    from polycnc.geometry.arcs import Point
    from polycnc.language.sinumerik.iso_dialect import IsoWord

_MILLI = 1000.0


def _peck(hole: Hole) -> Iterator[Stroke]:
    """Peck by peck, out to R after each, and back to what CYCLE83 keeps off the depth reached."""
    below = list(holes.depths(hole))
    limits = [deep_hole.automatic_limit(abs(level - hole.r)) for level in below]
    return deep_hole.peck(below, hole.r, hole.back, dwell_at_bottom=hole.dwell_s, limits=limits)


class HoleKind(NamedTuple):
    """A row of the table of cycles: its strokes, the words beside R and the depth, the hand of its tap (0 for none).

    One that `shifts` lets the spindle stand and leads the tool off the wall.
    """

    strokes: Callable[[Hole], Iterator[Stroke]]
    words: str = ""
    hand: int = 0
    shifts: bool = False


#: SD55806: the way off the wall in the plane (G17: X, Y; G18: Z, X; G19: Y, Z); 0 is as 2.
SHIFTS = {0: (-1.0, 0.0), 1: (1.0, 0.0), 2: (-1.0, 0.0), 3: (0.0, 1.0), 4: (0.0, -1.0)}
#: It comes from below, and ends where it began (G98).
BACK_BORING = "G87"
#: Drilling cycles by code. Q is the depth of a peck or the way off the wall, P the time at the bottom in milliseconds.
KINDS = {
    "G73": HoleKind(holes.peck_breaking_chips, "QP"),
    "G74": HoleKind(holes.tap, "P", -1),
    "G76": HoleKind(holes.bore_and_shift, "QP", shifts=True),
    "G81": HoleKind(holes.drill),
    "G82": HoleKind(holes.drill, "P"),
    "G83": HoleKind(_peck, "QP"),
    "G84": HoleKind(holes.tap, "P", 1),
    "G85": HoleKind(holes.bore),
    "G86": HoleKind(holes.bore_and_stop, "P"),
    "G87": HoleKind(holes.bore_back, "QP", shifts=True),
    "G88": HoleKind(holes.bore_and_halt, "P"),
    "G89": HoleKind(holes.bore, "P"),
}


# ---- the block


def choose(running: IsoRun, word: IsoWord) -> None:
    """G73 to G89: the cycle is modal from here on; what an earlier one remembers stays.

    Raises:
        AlarmError: PC0001 beside another cycle, a motion function or a modal program (G66).
    """
    codes = running.block.codes
    is_modal = running.channel.memory.language.modal_call is not None and "G67" not in codes
    if is_modal or sum(code in KINDS for code in codes) > 1 or any(code in MOTIONS for code in codes):
        raise running.refused(word)
    before = running.state.cycle
    running.state.cycle = HoleCycle(word.code) if before is None else replace(before, code=word.code)


def cancel(running: IsoRun, _word: IsoWord) -> None:
    """G80: no cycle is modal."""
    end(running)


def end(running: IsoRun) -> None:
    """No cycle is modal, and what it remembers is forgotten."""
    running.state.cycle = None


def to_initial(running: IsoRun, _word: IsoWord) -> None:
    """G98: cycles end where they began."""
    running.state.to_r = False


def to_r(running: IsoRun, _word: IsoWord) -> None:
    """G99: cycles end at R."""
    running.state.to_r = True


def with_motion(running: IsoRun, motion: str) -> None:
    """The block moves by a motion function that is not modal behind it."""
    channel, before = running.channel, running.channel.mode["motion"]
    running.extra.append(motion)

    def put_back() -> None:
        channel.mode = channel.mode.with_code("motion", before)

    running.after.append(put_back)


def drill(running: IsoRun) -> None:
    """While a cycle is modal: take its words, and drill behind a block with words of axes or R.

    Raises:
        AlarmError: PC0001 for words that the cycle does not have, for repeats with further axes, and for G87 in G99.
    """
    cycle = running.state.cycle
    if cycle is None or running.positions or "G4" in running.block.codes:
        return
    for corner in (each for each in running.block.words if each.letter in CORNERS):
        raise running.refused(corner)
    words = {letter: word for letter in "RQPK" if (word := running.take(letter)) is not None}
    third = "XYZ"[PLANES[_plane(running)][2]]
    axes = running.axis_words()
    depth = running.take(third) if running.block.find(third) is not None else None
    kind = KINDS[cycle.code]
    if cycle.code == BACK_BORING and running.state.to_r:
        raise running.refused_block(f"{BACK_BORING} G99")
    for letter in "QP":
        if letter in words and letter not in kind.words:
            raise running.refused(words[letter])
    count = _count(running, words.get("K"))
    others = [word for word in axes if word.letter != third]
    if count > 1 and any(word.letter not in "XYZ" for word in others):
        raise running.refused(words["K"])
    if others and count:
        with_motion(running, "G0")
    running.taken += [] if count else others
    start = list(running.channel.coordinates.position)
    works = bool(count and (axes or "R" in words))
    running.after.append(partial(_go_on, running, words, depth, start, count if works else 0))


def drilling_axis(channel: SinumerikChannel) -> int:
    """Column of the axis that stands on the active plane."""
    return channel.coordinates.geometry[PLANES[channel.mode["plane"]][2]]


def _plane(running: IsoRun) -> str:
    return next((code for code in running.block.codes if code in PLANES), running.channel.mode["plane"])


def _count(running: IsoRun, word: IsoWord | None) -> int:
    """K: how many holes; 0 only remembers the words."""
    if word is None:
        return 1
    if not word.value.is_integer() or word.value < 0:
        raise running.refused(word)
    return checked(int(word.value))


def _go_on(
    running: IsoRun, words: dict[str, IsoWord], depth: IsoWord | None, start: list[float], count: int
) -> None:
    """The tool is over the hole: remember the words, and drill."""
    channel, cycle = running.channel, running.state.cycle
    assert cycle is not None
    incremental, plane = channel.mode["distance"] == "G91", channel.mode["plane"]
    if cycle.plane != plane:  # levels of one axis are none of another
        cycle.plane, cycle.initial, cycle.r, cycle.bottom = plane, None, None, None
    columns = [channel.coordinates.geometry[axis] for axis in PLANES[plane]]
    position = channel.coordinates.position
    if cycle.initial is None:
        cycle.initial = position[columns[2]]
    if "R" in words:
        cycle.r = Datum(running.length(words["R"]), incremental)
    if depth is not None:
        cycle.bottom = Datum(running.length(depth), incremental)
    if "Q" in words:
        cycle.peck = abs(running.length(words["Q"]))
    if "P" in words:
        cycle.dwell_s = abs(words["P"].value) / _MILLI
    if not count:
        return
    u, v = (position[column] - start[column] if incremental else 0.0 for column in columns[:2])
    hole = hole_of(cycle, to_r=running.state.to_r)
    plan = partial(_plan, hole, KINDS[cycle.code], _shift(running, cycle), count, (u, v))
    calls.begin(channel, f"G291 {cycle.code}", Cycle("", plan), (), 0)


def _shift(running: IsoRun, cycle: HoleCycle) -> Point:
    """The way off the wall in the plane, mm: Q, as SD55806 directs it; PC0001 for another direction."""
    if not KINDS[cycle.code].shifts:
        return 0.0, 0.0
    direction = SHIFTS.get(running.channel.memory.data.integer("$SCS_ISO_M_RETRACTION_DIR"))
    if direction is None:
        raise running.refused_block("SD55806")
    return cycle.peck * direction[0], cycle.peck * direction[1]


def hole_of(cycle: HoleCycle, *, to_r: bool) -> Hole:
    """The levels of the hole.

    Raises:
        AlarmError: 61101 without R, 61808 without depth, or without Q where the cycle pecks.
    """
    assert cycle.initial is not None
    if cycle.r is None:
        raise AlarmError("61101")
    kind = KINDS[cycle.code]
    if cycle.bottom is None or ("Q" in kind.words and cycle.peck <= NO_WAY):
        raise AlarmError("61808")
    r = cycle.r.value + (cycle.initial if cycle.r.incremental else 0.0)
    bottom = cycle.bottom.value + (r if cycle.bottom.incremental else 0.0)
    return Hole(
        cycle.initial,
        r,
        bottom,
        r if to_r else cycle.initial,
        dwell_s=cycle.dwell_s if "P" in kind.words else 0.0,
        peck=cycle.peck if "Q" in kind.words else 0.0,
        relief=drilling.CHIP_BREAKING_MM,
    )


# ---- the strokes


def _plan(
    hole: Hole, kind: HoleKind, shift: Point, count: int, step: Point, moves: Moves, _a: Arguments
) -> None:
    """One hole after the other, each a step further."""
    first = moves.point
    for number in range(count):
        if number:
            moves.rapid(first[0] + number * step[0], first[1] + number * step[1])
            moves.end_block()
        drilling.perform(moves, kind.strokes(hole), _acts(moves, kind, shift))


def _acts(moves: Moves, kind: HoleKind, shift: Point) -> drilling.Acts:
    """What the strokes mean: a tap turns its own way, other tools as they turn now."""
    feed, direction = moves.channel.feed, kind.hand or moves.spindle.direction

    def tap(level: float) -> None:
        lead = drilling.lead_of(moves, feed)
        if not lead:
            raise AlarmError("61001")
        moves.special(Kind.TAP, kind.hand * lead, level, feed)

    def spindle(value: float) -> None:
        moves.turn(round(value) * direction)

    if kind.hand:
        drilling.turning(moves, direction)
    angle = moves.memory.data.number("$SA_M19_SPOS", f"S{moves.spindle.number}")
    return drilling.Acts(feed, tap=tap, spindle=spindle, shift=(*shift, 0.0), angle=angle)
