"""Sections of a program: DELAYFSTON to DELAYFSTOF, IPTRLOCK to IPTRUNLOCK (job planning 8.4, 8.5).

A section ends with the program level that began it; inside it, beginning again and ending on a deeper level have no
effect. Blocks of G331 and G332 are a section for stops by themselves, as long as no other function of motion comes.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
from polycnc.control.sinumerik.couplings.links import Couplings, Kind
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.control.sinumerik.variables.row import Indices, RowWithStop
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Type
from polycnc.language.sinumerik.statements.sections import ENDS_CONTEXT

with loaded_when_called():
    from polycnc.control.sinumerik.couplings.gears import Gears
    from polycnc.control.sinumerik.couplings.generated import MasterValues

if TYPE_CHECKING:
    from polycnc.channel.stack import Level
    from polycnc.control.sinumerik.family import SinumerikChannel

STOP_DELAY, POINTER_LOCK = "DELAYFST", "IPTRLOCK"
#: MD22680: which couplings, while they are on, make their section one that a search cannot enter; by its bits.
AUTOMATIC = "$MC_AUTO_IPTR_LOCK"
LOCKING = {0: Kind.GEAR, 1: Kind.LEAD}
#: MD11550: with its bit 0 rigid taps are no section.
STOP_MODE, MAY_STOP_IN_TAPS = "$MN_STOP_MODE_MASK", 1
RIGID_TAPS = frozenset(("G331", "G332"))


@dataclass(slots=True)
class Sections(State, lifetime=Lifetime.RESET):
    """Open sections.

    Attributes:
        open: The program level that began each.
        taps: A cycle taps rigidly (CYCLE84), as G331 and G332 do.
    """

    open: dict[str, Level] = field(default_factory=dict)
    taps: bool = False


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


def tap(channel: SinumerikChannel, *, on: bool) -> None:
    """Rigid tapping of a cycle begins, or is over."""
    Sections.of(channel).taps = on
    channel.context_changed()


def delays_stops(channel: SinumerikChannel) -> bool:
    """Whether stops wait for the end of a section: of DELAYFSTON, or one that G331 and G332 are by themselves (8.4)."""
    if is_open(channel, STOP_DELAY):
        return True
    taps = Sections.of(channel).taps or channel.mode["motion"] in RIGID_TAPS
    return taps and not MachineData.of(channel).integer(STOP_MODE) & MAY_STOP_IN_TAPS


def locks_pointer(channel: SinumerikChannel, _indices: Indices = ()) -> bool:
    """`$P_IPTRLOCK`: a search cannot enter, for IPTRLOCK or for couplings that MD22680 names (8.5)."""
    mask = MachineData.of(channel).integer(AUTOMATIC)
    kinds = {kind for bit, kind in LOCKING.items() if mask >> bit & 1}
    on = (
        {link.kind for links in Couplings.of(channel).links.values() for link in links}
        if kinds
        else set[Kind]()
    )
    if kinds and any(gear.beside for gear in Gears.of(channel).defined.values()):
        on.add(Kind.GEAR)
    if kinds and MasterValues.of(channel).led:
        on.add(Kind.LEAD)
    return is_open(channel, POINTER_LOCK) or not kinds.isdisjoint(on)


SECTION_VARIABLES: dict[str, RowWithStop] = {
    "$P_DELAYFST": (Type.INT, lambda channel, _indices: int(is_open(channel, STOP_DELAY)), None, False),
    "$AC_DELAYFST": (Type.INT, lambda channel, _indices: int(is_open(channel, STOP_DELAY)), None, True),
    "$P_IPTRLOCK": (Type.BOOL, locks_pointer, None, False),
}
