"""Sections of a program: DELAYFSTON to DELAYFSTOF, IPTRLOCK to IPTRUNLOCK (job planning 8.4, 8.5).

A section ends with the program level that began it; inside it, beginning again and ending on a deeper level have no
effect.
"""

from __future__ import annotations

from dataclasses import field
from typing import TYPE_CHECKING

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
from polycnc.control.sinumerik.variables.row import RowWithStop
from polycnc.deferred.records import dataclass
from polycnc.language.sinumerik.names.values import Type
from polycnc.language.sinumerik.statements.sections import ENDS_CONTEXT

if TYPE_CHECKING:
    from polycnc.channel.stack import Level
    from polycnc.control.sinumerik.family import SinumerikChannel

STOP_DELAY, POINTER_LOCK = "DELAYFST", "IPTRLOCK"


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


SECTION_VARIABLES: dict[str, RowWithStop] = {
    "$P_DELAYFST": (Type.INT, lambda channel, _indices: int(is_open(channel, STOP_DELAY)), None, False),
    "$AC_DELAYFST": (Type.INT, lambda channel, _indices: int(is_open(channel, STOP_DELAY)), None, True),
    "$P_IPTRLOCK": (Type.BOOL, lambda channel, _indices: is_open(channel, POINTER_LOCK), None, False),
}
