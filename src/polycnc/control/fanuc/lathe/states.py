"""States of the lathe that features ask of each other, apart from the modules that turn them on and off."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.motion.drawing import OpenLine


@dataclass(slots=True)
class BesideState(State, lifetime=Lifetime.RESET):
    """Axes that move beside the program, by their columns; -1 for none.

    Attributes:
        polygon: The tool axis of polygon turning.
        gear: The workpiece axis of the gear box.
        oscillating: The axis that oscillates.
        pairs: Those of G81.5.
        slaves: Those that follow another axis (G51.4).
    """

    polygon: int = -1
    gear: int = -1
    oscillating: int = -1
    pairs: frozenset[int] = frozenset()
    slaves: frozenset[int] = frozenset()

    @property
    def columns(self) -> set[int]:
        """All of them."""
        return {self.polygon, self.gear, self.oscillating, *self.pairs, *self.slaves} - {-1}


@dataclass(slots=True)
class RetractState(State, lifetime=Lifetime.RESET):
    """Where G10.6 leads each axis, and whether the signal has come.

    `ends` has the column of an axis, its value (internal units, as programmed), and whether it is an increment.
    """

    ends: list[tuple[int, float, bool]] = field(default_factory=list)
    came: bool = False


@dataclass(slots=True)
class BalanceState(State, lifetime=Lifetime.RESET):
    """The paths that cut together; none where this one cuts by itself.

    Attributes:
        paths: Their numbers.
        has_met: The running block has met those of the other paths.
    """

    paths: frozenset[int] = frozenset()
    has_met: bool = False


@dataclass(slots=True)
class DrawingState(State, lifetime=Lifetime.RESET):
    """The line that waits for the next block; None for none."""

    open_line: OpenLine | None = None
