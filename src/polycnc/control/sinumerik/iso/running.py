"""A block of the ISO dialect while it runs, and what the dialect remembers between blocks."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.tables import length_factor
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.errors import not_supported

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.errors import NcSyntaxError
    from polycnc.language.sinumerik.iso_dialect import IsoBlock, IsoWord

#: Letters of axes.
AXES = "XYZABCUVW"


class Datum(NamedTuple):
    """A level of a cycle: mm, and whether it counts from another level (G91)."""

    value: float
    incremental: bool


@dataclass(slots=True)
class HoleCycle:
    """The drilling cycle that is modal.

    Attributes:
        code: G73 to G89.
        initial: Level of the drilling axis where the cycle became modal, mm; None before its block has run.
        r: Level from which the tool feeds.
        bottom: Depth.
        peck: Depth of a peck, mm.
        dwell_s: Time at the bottom.
        plane: The plane that its levels stand on (G17 to G19).
    """

    code: str
    initial: float | None = None
    r: Datum | None = None
    bottom: Datum | None = None
    peck: float = 0.0
    dwell_s: float = 0.0
    plane: str = ""


@dataclass(slots=True)
class IsoState(State, lifetime=Lifetime.RESET):
    """What the dialect remembers.

    Attributes:
        cycle: The drilling cycle that is modal; None for none (G80).
        to_r: It ends at the level R (G99), else where it began (G98).
        length: H chooses an offset of length (G43).
        mirrors: Where each mirrored axis is mirrored (G51.1), mm.
    """

    cycle: HoleCycle | None = None
    to_r: bool = False
    length: bool = False
    mirrors: dict[str, float] = field(default_factory=dict)


class IsoRun:
    """A block of the ISO dialect while it runs.

    Args:
        channel: The channel.
        block: Its words.

    Attributes:
        taken: Words that a function has taken; the others are told in the control's own language.
        extra: What is told beside them.
        before: What happens in front of that.
        after: What happens behind it.
        positions: A function uses the axis words: no drilling cycle does.
    """

    def __init__(self, channel: SinumerikChannel, block: IsoBlock) -> None:
        self.channel = channel
        self.block = block
        self.taken: list[IsoWord] = []
        self.extra: list[str] = []
        self.before: list[Callable[[], None]] = []
        self.after: list[Callable[[], None]] = []
        self.positions = False

    @property
    def state(self) -> IsoState:
        """What the dialect remembers."""
        return IsoState.of(self.channel)

    def take(self, letter: str) -> IsoWord | None:
        """A word that nobody has taken; it is told by nobody else then."""
        for word in self.block.words:
            if word.letter == letter and word not in self.taken:
                self.taken.append(word)
                return word
        return None

    def axis_words(self) -> list[IsoWord]:
        """Words of axes that nobody has taken."""
        return [word for word in self.block.words if word.letter in AXES and word not in self.taken]

    def length(self, word: IsoWord) -> float:
        """A length, mm."""
        return word.value * length_factor(self.channel.mode)

    def refused(self, word: IsoWord) -> NcSyntaxError:
        """PC0001 for a word."""
        return not_supported(word.column, f"G291 {word.letter}{word.number}")

    def refused_block(self, what: str) -> NcSyntaxError:
        """PC0001 for something about the block."""
        return not_supported(self.block.end + 1, f"G291 {what}")
