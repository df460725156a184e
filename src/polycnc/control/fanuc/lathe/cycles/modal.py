"""What cycles keep from block to block: their modal words, and the modes in which the blocks of a shape run."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.fanuc.code_calls import PROGRAM_M
from polycnc.control.word_address.block.codes import MCode
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.plan import Builder

#: Codes of single cycles, and of grinding cycles as the control names them inside.
CYCLES = frozenset({"G90", "G92", "G94"})
GRINDING = frozenset({"G71 grinding", "G72 grinding", "G73 grinding", "G74 grinding"})
#: Group and codes of the modal state in which the blocks of a shape are read for a cycle, or run by G70.
GROUP, READING, FINISHING = "shape", "reading", "finishing"
#: Kind of the level in which G70 runs the blocks of a shape.


def is_reading(channel: LatheChannel) -> bool:
    """Whether blocks are read for their shape only: T, S and M do nothing."""
    return channel.mode.codes.get(GROUP) == READING


def silent_row(builder: Builder, number: int) -> MCode | None:
    """An M code that blocks which are read for their shape only leave out; those that end or call programs act."""
    reading = builder.mode.codes.get(GROUP) == READING
    return MCode(number, silent=True) if reading and number not in PROGRAM_M else None


@dataclass(slots=True)
class SingleCycleState(State, lifetime=Lifetime.RESET):
    """Modal words of G90, G92 and G94.

    Attributes:
        ends: Words of axes by column: value in mm, and whether it is an increment.
        taper: Taper, mm of radius; None without the word.
        lead: Lead that E of an inch thread gives, mm; None where F gives it.
    """

    ends: dict[int, tuple[float, bool]] = field(default_factory=dict)
    taper: float | None = None
    lead: float | None = None

    @property
    def has_words(self) -> bool:
        """Whether any word has been given."""
        return bool(self.ends) or self.taper is not None or self.lead is not None

    def forget(self) -> None:
        """The next cycle begins without words."""
        self.ends, self.taper, self.lead = {}, None, None


@dataclass(slots=True)
class GrindingState(State, lifetime=Lifetime.RESET):
    """Modal words of grinding cycles, by address, mm."""

    words: dict[str, float] = field(default_factory=dict)


@dataclass(slots=True)
class ThreadDepthState(State, lifetime=Lifetime.POWER):
    """P and Q of the last thread of G76, mm."""

    depths: dict[str, float] = field(default_factory=dict)
