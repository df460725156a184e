"""Offsets in the ISO dialect: those of the tool, G43, G44, G49 with H, and D; further work offsets, G54 P and G54.1 P.

An edge of the control has lengths and a radius in one: H and D are the D number of the tool in the spindle, and must
be the same.
"""

from __future__ import annotations

from polycnc.control.sinumerik.iso import holes
from polycnc.control.sinumerik.tools.selection import LengthSign
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.iso_dialect import CALLS

if TYPE_CHECKING:
    from polycnc.control.sinumerik.iso.running import IsoRun
    from polycnc.language.sinumerik.iso_dialect import IsoWord

#: G54 P1 is G507, and so on, up to G599.
FIRST_FURTHER, FURTHER_ZEROS = 506, 93
#: Functions with a P of their own.
_WITH_P = frozenset(("G4", "G10", "G30", "G51", "G65", "G66"))


def select(running: IsoRun, word: IsoWord) -> None:
    """G43: the lengths that H names act, G44: against the tool; PC0001 without H where none or the other is chosen."""
    sign, against = LengthSign.of(running.channel), word.code == "G44"
    if running.block.find("H") is None and not (running.state.length and sign.against is against):
        raise running.refused(word)
    running.state.length, sign.against = True, against


def cancel(running: IsoRun, _word: IsoWord) -> None:
    """G49: no length acts."""
    running.state.length = LengthSign.of(running.channel).against = False
    running.extra.append("D0")


def check(running: IsoRun) -> None:
    """H where G43 or G44 acts, and D, of the same number; PC0001 else, and where G44 finds lengths 2 and 3."""
    length, radius = running.take("H"), running.take("D")
    active = running.channel.memory.tools.edge_number
    if length is not None:
        if not running.state.length or not length.value.is_integer():
            raise running.refused(length)
        active = int(length.value)
        edge = running.channel.memory.tools.edges.get(active)
        if edge is not None and LengthSign.of(running.channel).against and any(map(edge.length, (1, 2))):
            raise running.refused(length)
        running.extra.append(f"D{active}")
    if radius is not None and radius.value != active:
        raise running.refused(radius)


def select_zero(running: IsoRun, word: IsoWord) -> None:
    """G54 P1 to P93, G54.1 P: the work offsets G507 to G599; P is that of a function beside it, where one has it.

    Raises:
        AlarmError: PC0001 for another P.
    """
    codes, others = running.block.codes, running.block.find("M")
    beside = any(code in _WITH_P or code in holes.KINDS for code in codes)
    calls = others is not None and others.value in CALLS
    chosen = None if beside or calls else running.take("P")
    if chosen is None and word.code == "G54":
        running.extra.append("G54")
        return
    if chosen is None or not chosen.value.is_integer() or not 1 <= chosen.value <= FURTHER_ZEROS:
        raise running.refused(chosen or word)
    running.extra.append(f"G{FIRST_FURTHER + int(chosen.value)}")
