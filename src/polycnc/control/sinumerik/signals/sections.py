"""Sections of a program: DELAYFSTON to DELAYFSTOF, IPTRLOCK to IPTRUNLOCK (job planning 8.4, 8.5).

A section ends with the program level that began it; inside it, beginning again and ending on a deeper level have no
effect.
"""

from __future__ import annotations

from dataclasses import field
from typing import TYPE_CHECKING

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
from polycnc.control.sinumerik.couplings.links import Couplings, Kind
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.control.sinumerik.variables.row import Indices, RowWithStop
from polycnc.deferred.records import dataclass
from polycnc.language.sinumerik.names.values import Type
from polycnc.language.sinumerik.statements.sections import ENDS_CONTEXT

if TYPE_CHECKING:
    from polycnc.channel.stack import Level
    from polycnc.control.sinumerik.family import SinumerikChannel

STOP_DELAY, POINTER_LOCK = "DELAYFST", "IPTRLOCK"
#: MD22680: which couplings, while they are on, make their section one that a search cannot enter; by its bits.
AUTOMATIC = "$MC_AUTO_IPTR_LOCK"
LOCKING = {0: Kind.GEAR, 1: Kind.LEAD}


@dataclass(slots=True)
class Sections(State, lifetime=Lifetime.RESET):
    """The program level that began each open section."""

    open: dict[str, Level] = field(default_factory=dict)


def begin(section: str) -> Procedure:
    """DELAYFSTON, IPTRLOCK: the section begins, unless one is open."""

    def run(channel: SinumerikChannel, _args: Arguments) -> None:
        if not is_open(channel, section):
            Sections.of(channel).open[section] = channel.level
            channel.level.data[ENDS_CONTEXT] = True
            channel.context_changed()

    return run


def end(section: str) -> Procedure:
    """DELAYFSTOF, IPTRUNLOCK: the section ends, on the level that began it."""

    def run(channel: SinumerikChannel, _args: Arguments) -> None:
        if Sections.of(channel).open.get(section) is channel.level:
            del Sections.of(channel).open[section]
            channel.context_changed()

    return run


def is_open(channel: SinumerikChannel, section: str) -> bool:
    """Whether a section is open: its level has not ended."""
    level = Sections.of(channel).open.get(section)
    return any(level is each for each in channel.stack)


def locks_pointer(channel: SinumerikChannel, _indices: Indices = ()) -> bool:
    """`$P_IPTRLOCK`: a search cannot enter, for IPTRLOCK or for couplings that MD22680 names (8.5)."""
    mask = MachineData.of(channel).integer(AUTOMATIC)
    kinds = {kind for bit, kind in LOCKING.items() if mask >> bit & 1}
    every = Couplings.of(channel).links.values() if kinds else ()
    return is_open(channel, POINTER_LOCK) or any(link.kind in kinds for links in every for link in links)


SECTION_VARIABLES: dict[str, RowWithStop] = {
    "$P_DELAYFST": (Type.INT, lambda channel, _indices: int(is_open(channel, STOP_DELAY)), None, False),
    "$AC_DELAYFST": (Type.INT, lambda channel, _indices: int(is_open(channel, STOP_DELAY)), None, True),
    "$P_IPTRLOCK": (Type.BOOL, locks_pointer, None, False),
}
