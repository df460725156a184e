"""Drilling, tapping and boring cycles: CYCLE81, 82, 84 to 89 and CYCLE840 (strokes: `polycnc.cycles`)."""

from __future__ import annotations

from math import radians, tan

from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.cycles.levels import Levels, levels, sign
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.control.sinumerik.feed.thread_ramps import START_ANGLE
from polycnc.control.sinumerik.signals import sections
from polycnc.cycles.drilling import deep_hole as deep
from polycnc.cycles.drilling import holes
from polycnc.cycles.drilling.holes import Action, Stroke
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves

#: Pitch of coarse metric threads by nominal diameter, mm (DIN 13; MPIT 3 to 48).
METRIC_PITCHES = {
    3: 0.5, 4: 0.7, 5: 0.8, 6: 1.0, 8: 1.25, 10: 1.5, 12: 1.75, 14: 2.0, 16: 2.0, 18: 2.5, 20: 2.5, 22: 2.5,
    24: 3.0, 27: 3.0, 30: 3.5, 33: 3.5, 36: 4.0, 39: 4.0, 42: 4.5, 45: 4.5, 48: 5.0,
}  # fmt: skip
#: Retract between strokes where the call gives none.
CHIP_BREAKING_MM = 1.0
DP_TIP_ANGLE = 24
DIRECTIONS = {3: 1, 4: -1, 5: 0}


def pause(value: float, mode: int) -> float:
    """A dwell from an argument: seconds above 0, revolutions below; the mode may say which (1, 2)."""
    if mode == 1:
        return abs(value)
    return -abs(value) if mode == 2 else value


def _tip_per_radius(moves: Moves) -> float:
    """Height of the tool's tip for each mm of radius; 0 for a tool without tip angle: it is flat."""
    edge = moves.memory.tools.edge
    angle = edge.values[DP_TIP_ANGLE] if edge is not None else 0.0
    return 1.0 / tan(radians(angle / 2.0)) if 0.0 < angle < 180.0 else 0.0


def levels_of_drill(moves: Moves, a: Arguments) -> Levels | None:
    """Levels as _GMODE (tens) means the depth: of the tip, of the full diameter, or as a diameter to be centred.

    Raises:
        AlarmError: 61000 for a diameter to be centred with a tool that has no tip angle.
    """
    if a.digit("_GMODE", 1) != 1:
        return levels(moves, a)
    if a.cycle == "CYCLE81":
        retract, reference = a["RTP"], a["RFP"]
        up = sign(retract - reference) or 1.0
        if not _tip_per_radius(moves):
            raise AlarmError("61000")
        depth = reference - up * abs(a["DP"]) / 2.0 * _tip_per_radius(moves)
        return Levels(retract, reference, reference + up * abs(a["SDIS"]), depth)
    found = levels(moves, a)
    if found is None:
        return None
    tip = moves.memory.tools.radius * _tip_per_radius(moves)
    return found._replace(depth=found.depth + found.down * tip)


# ---- performing


#: Strokes between taps that end no section of them.
BESIDE_TAPS = frozenset((Action.DWELL, Action.SPINDLE))


class Acts(NamedTuple):
    """What the strokes of one cycle mean on the machine.

    Attributes:
        feed: Path feed of FEED strokes; their factor multiplies it.
        tap: TAP strokes: to a level.
        is_rigid: Stops wait for the end of TAP strokes that follow each other, as in blocks of G331 and G332.
        spindle: SPINDLE strokes.
        shift: Way of SHIFT strokes along u, v and w.
        angle: Where ORIENT strokes let the spindle stand, degrees.
    """

    feed: float
    tap: Callable[[float], None] = lambda _level: None
    is_rigid: bool = False
    spindle: Callable[[float], None] = lambda _value: None
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)
    angle: float = 0.0


def perform(moves: Moves, strokes: Iterator[Stroke], acts: Acts) -> None:
    """Make the strokes of a hole; every stroke is a block."""
    center, taps = moves.point, False
    for action, value, factor, _ in strokes:
        if acts.is_rigid and action not in BESIDE_TAPS and taps is not (action is Action.TAP):
            taps = not taps
            moves.act(sections.tap, moves.channel, on=taps)
        match action:
            case Action.RAPID:
                moves.rapid(w=value)
            case Action.RETURN:
                moves.rapid(*_if_moved(moves, center), value)
            case Action.FEED:
                moves.feed(acts.feed * factor, w=value)
            case Action.TAP:
                acts.tap(value)
            case Action.DWELL:
                moves.dwell(value)
            case Action.SPINDLE:
                acts.spindle(value)
            case Action.SHIFT:
                du, dv, dw = acts.shift
                moves.rapid(
                    center[0] + value * du if du else None,
                    center[1] + value * dv if dv else None,
                    moves.level + value * dw,
                )
            case Action.ORIENT:
                moves.orient(acts.angle)
            case Action.HALT:
                moves.stop()
        moves.end_block()
    if taps:
        moves.act(sections.tap, moves.channel, on=False)


def _if_moved(moves: Moves, center: tuple[float, float]) -> tuple[float | None, float | None]:
    """The hole's centre, without the axes that stand over it."""
    u, v = (None if here == there else there for here, there in zip(moves.point, center, strict=True))
    return u, v


# ---- the cycles


def drill(moves: Moves, a: Arguments) -> None:
    """CYCLE81, CYCLE82: drilling, centring, with dwell."""
    found = levels_of_drill(moves, a)
    if found is None:
        return
    feed = moves.channel.feed
    hole = found.hole(pause(a["DTB"], a.digit("_AMODE", 1)))
    before, last = _stage(a, "S_ZA", "S_FA", feed), _stage(a, "S_ZD", "S_FD", feed)
    if before is None and last is None:
        perform(moves, holes.drill(hole), Acts(feed))
        return
    if sum(stage.way for stage in (before, last) if stage is not None) > abs(found.depth - found.reference):
        raise AlarmError("61107")
    perform(moves, deep.drill_in_stages(hole, found.reference, before, last), Acts(feed))


def _stage(a: Arguments, way: str, own: str, feed: float) -> deep.Stage | None:
    """A part of a hole at a feed of its own, the path feed where it has none; None where the hole has no such part."""
    if not a[way]:
        return None
    return deep.Stage(abs(a[way]), a[own] / feed if a[own] > 0.0 and feed > 0.0 else 1.0)


def bore(moves: Moves, a: Arguments) -> None:
    """CYCLE89: in and out with the path feed."""
    found = levels(moves, a)
    if found is not None:
        perform(moves, holes.bore(found.hole(a["DTB"])), Acts(moves.channel.feed))


def ream(moves: Moves, a: Arguments) -> None:
    """CYCLE85: in with FFR, out with RFF; the path feed where one of them is left out."""
    found = levels(moves, a)
    if found is not None:
        into, out = a["FFR"] or moves.channel.feed, a["RFF"] or moves.channel.feed
        dwell = pause(a["DTB"], a.digit("_AMODE", 1))
        perform(moves, holes.bore(found.hole(dwell), out / into), Acts(into))


def _direction(a: Arguments, name: str = "SDIR") -> int:
    """A direction of the spindle, 3 or 4; 61102 for others."""
    if a.integer(name) not in (3, 4):
        raise AlarmError("61102")
    return DIRECTIONS[a.integer(name)]


def turning(moves: Moves, direction: int) -> None:
    """The spindle turns so; M3 or M4 where it does not yet."""
    if moves.spindle.direction != direction:
        moves.turn(direction)


def bore_and_lift(moves: Moves, a: Arguments) -> None:
    """CYCLE86: oriented stop, off the wall by RPA, RPO, RPAP, out at rapid."""
    direction = _direction(a)
    found = levels(moves, a)
    if found is None:
        return
    turning(moves, direction)

    def spindle(value: float) -> None:
        if value:
            moves.turn(direction)
        else:
            moves.orient(a["POSS"])

    acts = Acts(moves.channel.feed, spindle=spindle, shift=(a["RPA"], a["RPO"], a["RPAP"]))
    dwell = pause(a["DTB"], a.digit("_AMODE", 1))
    perform(moves, holes.bore_and_lift(found.hole(dwell)), acts)


def bore_and_halt(moves: Moves, a: Arguments) -> None:
    """CYCLE87, CYCLE88: spindle stop and M0 at depth, out at rapid."""
    direction = _direction(a)
    found = levels(moves, a)
    if found is not None:
        turning(moves, direction)
        acts = Acts(moves.channel.feed, spindle=lambda _value: moves.turn(0))
        perform(moves, holes.bore_and_leave_standing(found.hole(a["DTB"])), acts)


# ---- tapping


def pitch(a: Arguments, sizes: Mapping[int, float] = METRIC_PITCHES) -> float:
    """Pitch of a thread by PIT or MPIT, mm, with the sign of its hand; 61001 for none, or two that differ."""
    nominal, written = a.plain("MPIT"), a.plain("PIT")
    of_size = sizes.get(round(abs(nominal)))
    if nominal and of_size is None:
        raise AlarmError("61001")
    given = written_pitch(a, "PIT")
    if not nominal and not written:
        raise AlarmError("61001")
    if nominal and of_size is not None:
        if written and abs(abs(given) - of_size) > deep.SAME_MM:
            raise AlarmError("61001")
        given = of_size if nominal > 0.0 else -of_size
    return -abs(given) if a.digit("_AMODE", 2) == 2 else given


def written_pitch(a: Arguments, name: str) -> float:
    """PIT in the unit that _PITA names: of the program, mm, threads per inch, inch per revolution.

    Raises:
        AlarmError: PC0001 for a pitch by module or in a unit that is not known.
    """
    value = a.plain(name)
    match a.integer("_PITA"):
        case 0:
            return a[name]
        case 1:
            return value
        case 2:
            return INCH_MM / value if value else 0.0
        case 3:
            return value * INCH_MM
        case _ if value:
            raise not_supported(f"{a.cycle} _PITA")
        case _:
            return 0.0


def _directions(a: Arguments) -> int:
    """Direction after the cycle (SDAC); whatever is not 3, 4 or 5 counts as 5."""
    return DIRECTIONS.get(a.integer("SDAC"), 0)


#: Greatest digits of _TECHNO, from the right: exact stop, feedforward, acceleration, spindle, check of the gear.
TECHNOLOGY = (3, 2, 3, 1, 1)
_STAYS_CONTROLLED = 3


def _check_technology(a: Arguments) -> None:
    """61125 for a digit of _TECHNO that does not exist; the first three change no way, and are not carried out."""
    digits = (a.digit("_TECHNO", place) for place in range(len(TECHNOLOGY)))
    if not 0 <= a.integer("_TECHNO") < 10 ** len(TECHNOLOGY) or any(
        digit > most for digit, most in zip(digits, TECHNOLOGY, strict=True)
    ):
        raise AlarmError("61125", text=a.cycle)


def rigid_tapping(moves: Moves, a: Arguments) -> None:
    """CYCLE84: tapping with the spindle in position control, in one go or in steps."""
    lead = pitch(a)
    _check_technology(a)
    variant = a.integer("_VARI")
    if variant >= 10:
        raise not_supported("CYCLE84 _VARI")
    if variant not in (0, 1, 2):
        raise AlarmError("61002")
    found = levels(moves, a)
    if found is None:
        return
    total = abs(found.depth - found.reference)
    below = [total]
    if variant:
        step = abs(a["_DAM"])
        if not 0.0 < step <= total:
            raise AlarmError("61809")
        below = deep.degressive_depths(step, total, step)
    speed, into = moves.spindle.speed, a["SST"] or moves.spindle.speed
    out = a["SST1"] if a["SST1"] > 0.0 else into

    def spindle(value: float) -> None:
        if value:
            moves.speed(into if value > 0.0 else out)
        else:
            moves.speed(speed)
            if a.digit("_TECHNO", _STAYS_CONTROLLED) != 1:
                moves.turn(_directions(a))

    strokes = deep.tap_in_steps(
        [found.reference + found.down * depth for depth in below[:-1]] + [found.depth],
        found.safe,
        found.retract,
        dwell=abs(a["DTB"]),
        retract=None if variant != 1 else a["_VRT"] if a["_VRT"] > 0.0 else CHIP_BREAKING_MM,
        limit=a["_VRT"] if a["_VRT"] > 0.0 else CHIP_BREAKING_MM,
    )
    moves.orient(_start_angle(moves, a["POSS"]))
    acts = Acts(
        moves.channel.feed,
        tap=lambda level: moves.special(Kind.TAP, lead, level),
        is_rigid=True,
        spindle=spindle,
    )
    perform(moves, strokes, acts)


def _start_angle(moves: Moves, position: float) -> float:
    """POSS; below 0 the start angle of threads of setting datum 42000."""
    return position if position >= 0.0 else moves.memory.data.number(START_ANGLE)


#: ENC of CYCLE840: with the encoder of the spindle, without dwell and with it; without encoder, with the programmed
#: feed and with one that the cycle works out.
WITH_ENCODER, WITH_ENCODER_AND_DWELL, BY_FEED, BY_PITCH = 0, 20, 1, 11


def tapping_with_chuck(moves: Moves, a: Arguments) -> None:
    """CYCLE840: tapping with a compensating chuck, G33 with the spindle's encoder or G63 without."""
    kind = a.integer("ENC")
    _check_technology(a)
    if kind not in (WITH_ENCODER, WITH_ENCODER_AND_DWELL, BY_FEED, BY_PITCH):
        raise AlarmError("61002")
    encoder = kind in (WITH_ENCODER, WITH_ENCODER_AND_DWELL)
    back = a.integer("SDR")
    if back not in (3, 4) and (back != 0 or not encoder):
        raise AlarmError("61102")
    has_pitch = bool(a.plain("PIT") or a.plain("MPIT"))
    lead = abs(pitch(a)) if kind != BY_FEED or has_pitch else 0.0
    found = levels(moves, a)
    if found is None:
        return
    cutting = moves.spindle.direction or 1
    feed = _chuck_feed(moves, lead if kind == BY_PITCH else 0.0)

    def tap(level: float) -> None:
        if encoder:
            moves.special(Kind.THREAD, lead, level)
        else:
            moves.special(Kind.TAP, lead or lead_of(moves, feed), level, feed)

    def spindle(value: float) -> None:
        if value < 0.0:
            moves.turn(DIRECTIONS[back] if back else -cutting)
        elif value == 0.0:
            moves.turn(_directions(a))

    strokes = deep.tap_in_steps(
        [found.depth], found.safe, found.retract, dwell=0.0 if kind == WITH_ENCODER else abs(a["DTB"])
    )
    perform(moves, strokes, Acts(moves.channel.feed, tap=tap, spindle=spindle))


def _chuck_feed(moves: Moves, lead: float) -> float:
    """Feed of G63: the programmed one, or speed times pitch in the feed type of the caller."""
    if not lead:
        return moves.channel.feed
    return (
        lead
        if PathFeed.of(moves.channel).mode is FeedMode.PER_REVOLUTION
        else lead * moves.spindle.speed / tables.MINUTE
    )


def lead_of(moves: Moves, feed: float) -> float:
    """Pitch of a tap whose feed is programmed, mm; 0 where the spindle stands. 10860 without feed."""
    if not feed > 0.0:
        raise AlarmError("10860")
    speed = moves.spindle.speed
    return (
        feed
        if PathFeed.of(moves.channel).mode is FeedMode.PER_REVOLUTION
        else feed * tables.MINUTE / speed
        if speed
        else 0.0
    )
