"""Partial infeeds of `POSP[axis]=(end,partial,mode)`: one after the other, when actions let the axis go (11.2)."""

from __future__ import annotations

from math import ceil, copysign

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.channel.interpolator import Interpolator

#: What is left of a length for rounding.
_NOTHING = 1e-9


@dataclass(frozen=True, slots=True)
class PartialInfeeds:
    """A way that is made in parts, however many they are.

    Attributes:
        start: Where it begins, machine position.
        length: The whole way, signed.
        partial: Length of one part, positive.
        mode: 0: the last two share what is left equally; 1: all of them are equal.
    """

    start: float
    length: float
    partial: float
    mode: int

    @property
    def count(self) -> int:
        """Number of the parts."""
        return max(ceil(abs(self.length) / self.partial - _NOTHING), 0)

    @property
    def end(self) -> float:
        """Where the way ends."""
        return self.start + self.length

    def after(self, part: int) -> float:
        """Where a part ends, from 1."""
        left = self.count - part
        if left <= 0:
            return self.end
        if self.mode == 1:
            return self.start + self.length * part / self.count
        whole = min(part, self.count - 2)
        done = whole * self.partial
        if whole < part:
            done += (abs(self.length) - done) / 2.0
        return self.start + copysign(done, self.length)


@dataclass(slots=True)
class Infeed:
    """An axis that is fed in.

    Attributes:
        column: The axis.
        speed: mm/s.
        way: What is fed in, in parts.
        done: How many of them have begun.
        has_been_seen: Actions have looked at the end of the last one.
    """

    column: int
    speed: float
    way: PartialInfeeds
    done: int = 0
    has_been_seen: bool = True

    def step(self, clocked: Interpolator) -> None:
        """Begin the next partial infeed, once actions have seen that the last one is done."""
        axis = clocked.commanded(self.column)
        if axis.moves:
            self.has_been_seen = False
        elif not self.has_been_seen:
            self.has_been_seen = True
        elif self.done < self.way.count:
            self.done += 1
            axis.move_to(self.way.after(self.done), self.speed)

    def is_done(self, clocked: Interpolator) -> bool:
        """Whether all is fed in."""
        return self.done >= self.way.count and not clocked.commanded(self.column).moves
