"""Partial infeeds of `POSP[axis]=(end,partial,mode)`: one after the other, when actions let the axis go (11.2)."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, copysign
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.channel.interpolator import Interpolator

#: What is left of a length for rounding.
_NOTHING = 1e-9


def parts(way: float, partial: float, mode: int) -> list[float]:
    """Lengths of the partial infeeds over a way, signed.

    Args:
        way: The whole way, signed.
        partial: Length of one, positive.
        mode: 0: the last two share what is left equally; 1: all of them are equal.
    """
    total = abs(way)
    count = max(ceil(total / partial - _NOTHING), 0)
    if count == 0:
        return []
    if mode == 1 or count == 1:
        lengths = [total / count] * count
    else:
        rest = total - (count - 2) * partial
        lengths = [partial] * (count - 2) + [rest / 2.0] * 2
    return [copysign(length, way) for length in lengths]


@dataclass(slots=True)
class Infeed:
    """An axis that is fed in.

    Attributes:
        column: The axis.
        speed: mm/s.
        targets: Where the partial infeeds end, machine positions.
        has_been_seen: Actions have looked at the end of the last one.
    """

    column: int
    speed: float
    targets: list[float]
    has_been_seen: bool = True

    def step(self, clocked: Interpolator) -> None:
        """Begin the next partial infeed, once actions have seen that the last one is done."""
        axis = clocked.commanded(self.column)
        if axis.moves:
            self.has_been_seen = False
        elif not self.has_been_seen:
            self.has_been_seen = True
        elif self.targets:
            axis.move_to(self.targets.pop(0), self.speed)

    def is_done(self, clocked: Interpolator) -> bool:
        """Whether all is fed in."""
        return not self.targets and not clocked.commanded(self.column).moves
