"""The ISO dialect on a lathe: threads, single cycles, T with an offset, the limit of the spindle's speed.

Codes are those of system B (`systems`). Source: general knowledge of the control's ISO turning.
"""

from __future__ import annotations

from functools import partial

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.block import positions
from polycnc.control.sinumerik.block.positions import Dimension
from polycnc.control.sinumerik.cycles import calls
from polycnc.control.sinumerik.cycles.table import Cycle
from polycnc.cycles.turning import single
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.iso_dialect import MOTIONS
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.iso.running import IsoRun
    from polycnc.geometry.arcs import Point
    from polycnc.language.sinumerik.iso_dialect import IsoWord

THREAD = "G33"
#: Single cycles: along Z, and along X.
CYCLES = {"G77": single.longitudinal, "G79": single.facing}
#: T of four digits: the tool, and the D number of its offset.
_DIGITS, _OF_OFFSET = 4, 2
_MILLI = 1000.0
_PLANE = "G18"
#: Words of corners without a comma.
CORNERS = {"R": "RND", "C": "CHR"}
#: Functions that change what words of axes mean.
CHANGING = frozenset(
    ("G17", "G18", "G19", "G20", "G21", "G40", "G41", "G42", "G54.1", *(f"G{n}" for n in range(54, 60)))
)


@dataclass(slots=True)
class IsoTurning(State, lifetime=Lifetime.RESET):
    """What the dialect remembers on a lathe.

    Attributes:
        cycle: The single cycle that is modal; empty for none.
        corner: X and Z where its cut ends, mm of radius.
        taper: How much further on the cut begins (R), mm of radius.
        lead: Lead of threads, as it was written.
    """

    cycle: str = ""
    corner: dict[str, float] | None = None
    taper: float = 0.0
    lead: str = ""


def begin(channel: SinumerikChannel) -> None:
    """The dialect begins: no cycle is modal, and no lead known, from an earlier part of a program in it."""
    state = IsoTurning.of(channel)
    state.cycle = state.lead = ""


def limit_speed(running: IsoRun, word: IsoWord) -> None:
    """G92 S: the highest speed of the spindle under G96; PC0001 without S, and for a position that it sets."""
    speed = running.take("S")
    if speed is None or running.axis_words():
        raise running.refused(word)
    running.extra.append(f"LIMS={speed.number}")


def choose(running: IsoRun, word: IsoWord) -> None:
    """G77, G79: the cycle is modal from here on; PC0001 beside a motion function."""
    if any(code in (*MOTIONS, THREAD) for code in running.block.codes):
        raise running.refused(word)
    state = IsoTurning.of(running.channel)
    state.cycle, state.corner, state.taper = word.code, None, 0.0


def thread(running: IsoRun, _word: IsoWord) -> None:
    """G33: a thread; its words are read behind all functions of the block."""
    running.extra.append(THREAD)


def act(running: IsoRun) -> None:
    """Behind the functions of a block: its tool, its thread or its cycle.

    Raises:
        AlarmError: PC0001 for D, and what these raise.
    """
    _tool(running)
    radius = running.take("D")
    if radius is not None:
        raise running.refused(radius)
    state, codes = IsoTurning.of(running.channel), running.block.codes
    if any(code in (*MOTIONS, THREAD) for code in codes):
        state.cycle = ""
    if running.channel.mode["diameter"] == "DIAM90":  # increments are radii there, in the dialect diameters
        for word in running.axis_words():
            if word.incremental and word.letter == "X":
                raise running.refused(word)
    if running.positions or "G4" in codes:
        return
    motion = next((code for code in codes if code in (*MOTIONS, THREAD)), running.channel.mode["motion"])
    if motion == "G1" and not state.cycle:
        _corner(running)
    if state.cycle:
        _cycle(running, state)
    elif motion == THREAD and running.axis_words():
        _thread(running, state)


def _corner(running: IsoRun) -> None:
    """R rounds the corner behind a straight move, C chamfers it where it is no axis; PC0001 for a negative one."""
    for letter, told in CORNERS.items():
        word = running.block.find(letter)
        if word is None or word.incremental or letter in running.channel.axes:
            continue
        if word.value < 0.0:
            raise running.refused(word)
        running.taken.append(word)
        running.extra.append(f"{told}={word.number}")


def _tool(running: IsoRun) -> None:
    """T0203: tool 2 with its edge D3, 00 without; PC0001 for another number of digits."""
    tool = running.take("T")
    if tool is None:
        return
    if len(tool.number) != _DIGITS or not tool.number.isdigit():
        raise running.refused(tool)
    number, offset = divmod(int(tool.number), 10**_OF_OFFSET)
    running.extra.append(f"T{number} D{offset}")


# ---- where words lead


def _end(running: IsoRun, word: IsoWord) -> float:
    """Where a word of X or Z leads, mm of radius."""
    channel, codes = running.channel, running.block.codes
    by_code = "G91" in codes or (channel.mode["distance"] == "G91" and "G90" not in codes)
    way = Dimension.INCREMENTAL if word.incremental or by_code else Dimension.ABSOLUTE
    column = channel.memory.column(word.letter)
    halves = positions.is_diameter(channel.mode, way, column, channel.memory.transverse)
    value = running.length(word) * (0.5 if halves else 1.0)
    return value + (channel.coordinates.position[column] if way is Dimension.INCREMENTAL else 0.0)


def _plane_words(running: IsoRun) -> list[IsoWord]:
    """The words of axes, which are X and Z in their plane without a radius compensation; PC0001 else.

    They are read before the block acts: functions that would give them another meaning are refused too.
    """
    words, mode = running.axis_words(), running.channel.mode
    is_elsewhere = mode["plane"] != _PLANE or mode["compensation"] != "G40"
    for word in words:
        if word.letter not in "XZ" or is_elsewhere or not CHANGING.isdisjoint(running.block.codes):
            raise running.refused(word)
    return words


# ---- threads


def _thread(running: IsoRun, state: IsoTurning) -> None:
    """F is the lead along the axis with the longer way, Q the start in thousandths of a degree."""
    lead, start = running.take("F"), running.take("Q")
    words = _plane_words(running)
    state.lead = lead.number if lead is not None else state.lead
    if not state.lead:
        raise running.refused(words[0])
    position, column = running.channel.coordinates.position, running.channel.memory.column
    ways = {word.letter: abs(_end(running, word) - position[column(word.letter)]) for word in words}
    along_x = ways.get("X", 0.0) > ways.get("Z", 0.0)
    running.extra.append(f"{'I' if along_x else 'K'}={state.lead}")
    if start is not None:
        running.extra.append(f"SF={start.value / _MILLI!r}")


# ---- single cycles


def _cycle(running: IsoRun, state: IsoTurning) -> None:
    """X, Z and R last; a block with one of them runs the cycle.

    Raises:
        AlarmError: PC0001 without X or Z.
    """
    taper, words = running.take("R"), _plane_words(running)
    running.taken += words
    if taper is None and not words:
        return
    corner = (state.corner or {}) | {word.letter: _end(running, word) for word in words}
    if len(corner) < len("XZ"):
        raise running.refused_block(state.cycle)
    state.corner = corner
    state.taper = running.length(taper) if taper is not None else state.taper
    running.after.append(partial(_run, running, state.cycle, (corner["Z"], corner["X"]), state.taper))


def _run(running: IsoRun, code: str, corner: Point, taper: float) -> None:
    channel = running.channel

    def plan(moves: Moves, _a: Arguments) -> None:
        for stroke in CYCLES[code](moves.point, corner, taper):
            if stroke.kind is Kind.RAPID:
                moves.rapid(*stroke.end)
            else:
                moves.feed(channel.feed, *stroke.end)
            moves.end_block()

    calls.begin(channel, f"G291 {code}", Cycle("", plan), (), 0)
