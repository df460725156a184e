"""An axis of the machine: where it shall be is the sum of its sources.

The first one is the path of the program that leads it. Beside that there are, in this order, what an operator has moved
while the program waited, what he moves now, and whatever else is added: a coupling to another axis, a motion that is
superimposed. To add one is `axis.add(source)`; nothing else has to know of it.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.mainrun.axes.hand import Hand
from polycnc.mainrun.axes.manual_offset import ManualOffset

if TYPE_CHECKING:
    from polycnc.machine.model import Axis as AxisData


class Source(Protocol):
    """Something that moves an axis."""

    @property
    def due(self) -> float:
        """When it comes to rest, or something else happens to it; inf where nothing will of its own accord."""

    def at(self, time: float) -> float:
        """Its share of the setpoint at a time, mm or degrees."""

    def arrive(self, time: float) -> None:
        """What is due at this time happens."""


class Command(Source, Protocol):
    """Something that moves an axis in place of its program: coordinates know of its share, displays show it."""

    def rebase(self) -> None:
        """The axis stands, and the path has it there: the share is nothing from now on."""


class Axis:
    """An axis with its sources.

    Args:
        data: What the machine says of it.
        ramp: Seconds over which a motion by hand is averaged (limited jerk); 0 without.
        path: The program that leads it.

    Attributes:
        name: Its name on the machine.
        ramp: Seconds over which motions of its own are averaged (limited jerk); 0 without.
        offset: What an operator has moved while its program waited.
        hand: What he moves now.
    """

    def __init__(self, data: AxisData, ramp: float, path: Source) -> None:
        self.name = data.name
        self.data, self.ramp = data, ramp
        self.offset = ManualOffset()
        self.hand = Hand(data, ramp)
        self._path = path
        self._added: list[Source] = []
        self._commands: list[Command] = []

    def add(self, source: Source) -> None:
        """From now on a source moves the axis too."""
        self._added.append(source)

    def command(self, source: Command) -> None:
        """From now on an action moves the axis too: its path is where that has it, beside what is added."""
        self._commands.append(source)

    def remove(self, source: Source) -> None:
        """A source moves the axis no more: it is without its share at once."""
        self._added.remove(source)

    @property
    def sources(self) -> tuple[Source, ...]:
        """All that moves the axis."""
        return (self._path, self.offset, self.hand, *self._commands, *self._added)

    def setpoint(self, time: float) -> float:
        """Where the axis shall be, the sum of its sources."""
        return self._path.at(time) + self.beside(time)

    def beside(self, time: float) -> float:
        """How far the axis is beside its path at a time, all sources together."""
        return self.uncounted(time) + self.counted(time) + self.hand.at(time)

    def uncounted(self, time: float) -> float:
        """The part of it that coordinates do not know of."""
        return self.offset.shift + sum(source.at(time) for source in self._added)

    def counted(self, time: float) -> float:
        """The part that they do know of, but for the hand."""
        return self.offset.pending + self.commanded(time)

    def commanded(self, time: float) -> float:
        """How far commands have the axis from its path."""
        return sum(source.at(time) for source in self._commands)

    def rebase(self) -> None:
        """The axis stands, and its path has it where it stands."""
        for source in self._commands:
            source.rebase()

    @property
    def due(self) -> float:
        """When something happens to one of the sources next; inf where nothing will."""
        if not self._added and not self._commands:
            return self.hand.due
        return min(source.due for source in self.sources)

    def arrive(self, time: float) -> None:
        """What is due happens."""
        for source in self.sources:
            source.arrive(time)
