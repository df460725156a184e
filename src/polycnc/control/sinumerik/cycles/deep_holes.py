"""Deep holes CYCLE83 and CYCLE830 (strokes: `polycnc.cycles.drilling.deep_hole`).

Source: SINUMERIK standard cycles; of CYCLE830 the parameter list and the sequence of the operating manual.
"""

from __future__ import annotations

import re
from functools import partial

from polycnc.control.sinumerik import auxiliary, tables
from polycnc.control.sinumerik.cycles.drilling import (
    CHIP_BREAKING_MM,
    DIRECTIONS,
    Acts,
    levels_of_drill,
    pause,
    perform,
)
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.m_functions import NEVER_CALL
from polycnc.control.sinumerik.replaced import program_of
from polycnc.cycles.drilling import deep_hole as deep
from polycnc.cycles.drilling.deep_hole import Zone
from polycnc.cycles.drilling.holes import Action, Stroke
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.levels import Levels
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Units of VARI: chips are broken, cleared, both in turn, or the hole is drilled in one stroke.
CHIPS, SWARF, IN_TURN, AT_ONCE = range(4)


def deep_hole(moves: Moves, a: Arguments) -> None:
    """CYCLE83: strokes that become shorter, breaking chips (VARI=0) or clearing them (VARI=1), or both in turn."""
    found = levels_of_drill(moves, a)
    if a.integer("VARI") >= 10:
        raise not_supported(f"{a.cycle} VARI")
    if found is not None:
        perform(moves, iter(pecks(moves, a, found, found.safe)), Acts(moves.channel.feed))


def pecks(
    moves: Moves, a: Arguments, found: Levels, clearance: float, *, begin: float = 0.0, breaks: int = 1
) -> list[Stroke]:
    """The strokes of a deep hole.

    Args:
        moves: The cycle's moves.
        a: Its arguments.
        found: Its levels.
        clearance: Level at which chips are cleared.
        begin: Depth that is drilled already, mm: strokes to above it are left out.
        breaks: Where chips are broken and cleared in turn: how often they are broken before.

    Raises:
        AlarmError: 61002 for VARI, 61107 for a first depth above the reference plane.
    """
    variant = a.integer("VARI") % 10 if a.integer("VARI") >= 0 else -1
    if variant not in (CHIPS, SWARF, IN_TURN, AT_ONCE):
        raise AlarmError("61002")
    total = abs(found.depth - found.reference)
    mode = partial(a.digit, "_AMODE")
    below = [total]
    if variant != AT_ONCE:
        first = _first_depth(moves, a, found, total)
        by = _degression(a, mode(5), first)
        below = deep.degressive_depths(first, total, by, abs(a["_MDEP"]))
    below = [depth for depth in below if depth > begin + deep.SAME_MM]
    down = found.down
    return list(
        deep.peck(
            [found.reference + down * depth for depth in below[:-1]] + [found.depth],
            clearance,
            found.retract,
            first_factor=_first_feed(a["FRF"], percent=mode(6) > 0 or not a.has("FDPR")),
            dwell=pause(a["DTB"], mode(1)),
            dwell_at_bottom=pause(a["_DTD"], mode(3)) or pause(a["DTB"], mode(1)),
            retract=None if variant == SWARF else a["_VRT"] if a["_VRT"] > 0.0 else CHIP_BREAKING_MM,
            breaks=breaks if variant == IN_TURN else 0,
            dwell_at_clearance=pause(a["DTS"], mode(2)),
            limits=[_limit(a, mode(7), depth) for depth in below],
        )
    )


def _first_depth(moves: Moves, a: Arguments, found: Levels, total: float) -> float:
    """Depth of the first stroke below the reference plane; 61107 for one above it."""
    mode = a.digit("_AMODE", 4)
    relative = abs(a["FDPR" if a.has("FDPR") or mode != 1 else "FDEP"])
    if mode == 1 or (mode != 2 and relative):
        if a.given("FDEP") and mode == 0 and abs(a["FDEP"] - found.reference) != relative:
            moves.note("62001")
        return relative or total
    if not a.given("FDEP"):
        return total
    first = (a["FDEP"] - found.reference) * found.down
    if first <= 0.0:
        raise AlarmError("61107")
    return min(first, total)


def _degression(a: Arguments, mode: int, first: float) -> float:
    """Amount above 0, factor below, 0 for none; as a percentage where _AMODE says so (100: none)."""
    name = "DAM" if a.has("DAM") else "_DAM"
    value = a.plain(name)
    # Nobody shortens strokes of CYCLE830 by more than the first one: such an amount is a percentage.
    is_percent = mode == 2 or (mode == 0 and a.cycle == "CYCLE830" and a[name] > first)
    if is_percent or (mode == 0 and value < 0.0):
        factor = abs(value) / 100.0 if is_percent else min(abs(value), 1.0)
        return 0.0 if factor in (0.0, 1.0) and is_percent else -factor
    return abs(a[name])


def _first_feed(factor: float, *, percent: bool) -> float:
    """FRF: factor on the feed of the first stroke, 0.001 to 1; 0 or none: 1."""
    if percent and factor > 1.0:
        factor /= 100.0
    return min(max(factor, 0.001), 1.0) if factor else 1.0


def _limit(a: Arguments, mode: int, depth: float) -> float:
    """Distance in front of a depth at which the rapid return ends."""
    return a["_DIS1"] if a["_DIS1"] > 0.0 and mode != 1 else deep.automatic_limit(depth)


# ---- CYCLE830


#: What a call of CYCLE830 may hold behind the strokes: feeds, speeds and directions of pilot hole, hole and way back,
#: soft entry, through drilling, M functions of the coolant; and behind the modes the distance in the pilot hole.
REST = (
    "S_FP:feed S_SDAC2:number S_SV2:number S_F:feed S_SDAC:number S_SV:number S_SPOS:number S_ZA S_FA:number S_ZP"
    " S_FS:number S_ZS1 S_ZS2 S_N:number S_ZD S_FD:number S_FR:feed S_SDAC3:number S_SV3:number S_CON S_COFF"
)
REST_OF_MODES = "S_AMODE2:number S_AMODE3:number S_ZPV"
#: Digits of VARI behind that of the chips: where these are cleared, soft entry, through drilling, what is there
#: already, where the way back at its own feed ends; and the greatest value of each.
_CLEARING, _SOFT, _THROUGH, _ENTRY, _BACK = range(1, 6)
GREATEST = (AT_ONCE, 1, 1, 1, 2, 1)
#: _ENTRY: drilling begins in the full, at a lower feed, or in a pilot hole.
FULL, SPOTTED, PILOT = range(3)
_M_FUNCTION = re.compile(r"\s*M\s*=?\s*0*(\d{1,5})\s*", re.IGNORECASE)


def deep_hole_2(moves: Moves, a: Arguments) -> None:
    """CYCLE830: as CYCLE83, with a pilot hole, a soft entry, through drilling, spindle and coolant of its own.

    Raises:
        AlarmError: 61002 for VARI, 61102 for a direction of the spindle, 61107 for parts that do not fit into the
            hole; PC0001 for digits of units, a spindle position, other words for the coolant, and speeds under G96.
    """
    if a.integer("VARI") < 0 or a.integer("VARI") >= 10 ** len(GREATEST):
        raise AlarmError("61002")
    if any(a.digit("VARI", place) > most for place, most in enumerate(GREATEST)):
        raise AlarmError("61002")
    found = levels_of_drill(moves, a)
    _refuse(moves, a)
    if found is not None:
        _drill_deep(moves, a, found)


def _refuse(moves: Moves, a: Arguments) -> None:
    """What is not executed."""
    speeds = [abs(a[name]) for name in ("S_SV", "S_SV2", "S_SV3")]
    unknown = {
        "_AMODE2": a.integer("S_AMODE2") != 0,
        "_AMODE3": a.integer("S_AMODE3") != 0,
        # Neither an amount nor a percentage: strokes do not grow.
        "_DAM": a.digit("_AMODE", 5) == 0 and a["FDEP"] != 0.0 and a.plain("_DAM") > 100.0,
        "S_SPOS": bool(a["S_SPOS"]),
        "S_SV": any(speeds) and tables.feed_type(moves.channel.mode).surface_speed,
    }
    for name, wrong in unknown.items():
        if wrong:
            raise not_supported(f"CYCLE830 {name}")


def _drill_deep(moves: Moves, a: Arguments, found: Levels) -> None:
    """The whole hole: entry, strokes, way back, and the spindle as it was."""
    down, feed = found.down, a["S_F"] if a["S_F"] > 0.0 else moves.channel.feed
    acts, spindle = Acts(feed), _Spindle(moves, a)
    coolant_on, coolant_off = _m_function(moves, a, "S_CON"), _m_function(moves, a, "S_COFF")
    zones, has_pilot = _zones(a, found), a.digit("VARI", _ENTRY) == PILOT
    # So far the tool goes into a pilot hole without drilling, and comes back to for its last way out.
    pilot = found.reference + down * (abs(a["S_ZP"]) - abs(a["S_ZPV"])) if has_pilot else found.safe
    if has_pilot and (pilot - found.safe) * down <= 0.0:
        raise AlarmError("61107")
    approach = _share(a["S_FP"], feed)
    clearance = pilot if a.digit("VARI", _CLEARING) == 0 else found.safe
    begin = abs(a["S_ZP"]) if has_pilot else 0.0
    strokes = pecks(moves, a, found, clearance, begin=begin, breaks=max(a.integer("S_N"), 1))[1:-1]

    if has_pilot:
        spindle.turn("S_SDAC2", "S_SV2")
        perform(moves, iter((Stroke(Action.RAPID, found.safe), Stroke(Action.FEED, pilot, approach))), acts)
    spindle.turn("S_SDAC", "S_SV")
    coolant_on()
    if not has_pilot:
        perform(moves, iter((Stroke(Action.RAPID, found.safe),)), acts)
    perform(moves, deep.in_zones(strokes, pilot, zones, down), acts)

    back = pilot if a.digit("VARI", _BACK) == 0 else found.safe
    out = Stroke(Action.RAPID, found.retract)
    if a["S_FR"] > 0.0:
        perform(moves, iter((Stroke(Action.FEED, back, _share(a["S_FR"], feed)),)), acts)
    else:
        perform(moves, iter((out._replace(value=back) if back != found.safe else out,)), acts)
    coolant_off()
    spindle.turn("S_SDAC3", "S_SV3")
    if back != found.safe:
        perform(moves, iter((Stroke(Action.FEED, found.safe, approach),)), acts)
    perform(moves, iter((out,)), acts)
    spindle.put_back()


def _share(own: float, feed: float) -> float:
    """A feed as a factor on that of drilling; 1 for none."""
    return own / feed if own > 0.0 and feed > 0.0 else 1.0


def _zones(a: Arguments, found: Levels) -> list[Zone]:
    """Where drilling has another feed: spotting, or the soft entry, and where the drill comes through.

    Raises:
        AlarmError: 61107 where they are longer than the hole.
    """
    reference, down = found.reference, found.down
    zones: list[Zone] = []
    begin = 0.0
    if a.digit("VARI", _ENTRY) == SPOTTED and a["S_ZA"]:
        begin = abs(a["S_ZA"])
        zones.append(Zone(reference + down * begin, _percent(a, "S_FA")))
    elif a.digit("VARI", _ENTRY) == PILOT:
        begin = abs(a["S_ZP"])
        zones.append(Zone(reference + down * begin, 1.0))
    if a.digit("VARI", _SOFT):
        even, more, factor = abs(a["S_ZS1"]), abs(a["S_ZS2"]), _percent(a, "S_FS")
        zones.append(Zone(reference + down * (begin + even), factor))
        if more:
            zones += deep.rising(reference + down * (begin + even), down * more, factor)
        begin += even + more
    rest = abs(a["S_ZD"]) if a.digit("VARI", _THROUGH) else 0.0
    if begin + rest > abs(found.depth - reference) + deep.SAME_MM:
        raise AlarmError("61107")
    if rest:
        zones += [Zone(found.depth - down * rest, 1.0), Zone(found.depth, _percent(a, "S_FD"))]
    return zones


def _percent(a: Arguments, name: str) -> float:
    """A share of the drilling feed; all of it where none is given."""
    return a[name] / 100.0 if a[name] > 0.0 else 1.0


class _Spindle:
    """Direction and speed of the spindle as far as they are noted, and as they were."""

    def __init__(self, moves: Moves, a: Arguments) -> None:
        self._moves, self._arguments = moves, a
        self._before = self._now = (moves.spindle.direction, moves.spindle.speed)
        for name in ("S_SDAC2", "S_SDAC", "S_SDAC3"):
            if a.integer(name) not in (0, *DIRECTIONS):
                raise AlarmError("61102")

    def turn(self, direction: str, speed: str) -> None:
        """Turn as two arguments say; what they leave out stays."""
        code, rpm = self._arguments.integer(direction), abs(self._arguments[speed])
        self._note(DIRECTIONS[code] if code else self._now[0], rpm or self._now[1])

    def put_back(self) -> None:
        """Turn as before the cycle."""
        self._note(*self._before)

    def _note(self, direction: int, rpm: float) -> None:
        if rpm != self._now[1]:
            self._moves.speed(rpm)
        if direction != self._now[0]:
            self._moves.turn(direction)
        self._now = (direction, rpm)


def _m_function(moves: Moves, a: Arguments, name: str) -> Callable[[], None]:
    """What puts an M function out that a text names; PC0001 for other texts, stops, and calls of programs."""
    text = a.text(name).strip()
    if text in ("", "0"):
        return lambda: None
    found = _M_FUNCTION.fullmatch(text)
    code = int(found[1]) if found else 0
    if code in NEVER_CALL or program_of(moves.channel, code):
        raise not_supported(f"CYCLE830 {name}")
    return partial(moves.act, _put_out, moves.channel, code)


def _put_out(channel: SinumerikChannel, code: int) -> None:
    """An M function, wherever the machine file has it in its block."""
    auxiliary.before_motion(channel, code, None)
    auxiliary.after_motion(channel, code)
