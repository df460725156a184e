"""Axes that several channels can move: each is where the channel has left it that moved it last."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.channel.group import ChannelGroup
    from polycnc.machine.model import Machine


class Path(Protocol):
    """What is prepared for a channel."""

    @property
    def position(self) -> Sequence[float]:
        """Machine position behind everything prepared."""


class SharedAxes:
    """The axes that more than one channel names.

    Args:
        machine: The machine.

    Attributes:
        paths: What is prepared, by channel.
    """

    def __init__(self, machine: Machine) -> None:
        self.paths: dict[int, Path] = {}
        named = [name for channel in machine.channels for name in channel.axes]
        self._columns = {
            channel.number: {name: i for i, name in enumerate(channel.axes) if named.count(name) > 1}
            for channel in machine.channels
        }
        self._prepared_by = {
            name: machine.owner(name) for columns in self._columns.values() for name in columns
        }

    def of(self, number: int) -> dict[str, int]:
        """The axes of a channel that another one can move too, with their columns."""
        return self._columns[number]

    def elsewhere(self, number: int, group: ChannelGroup | None) -> Iterator[tuple[int, int, int]]:
        """The axes of a channel that another one has moved last: column here, that channel, column there."""
        if group is None:
            return
        for name, column in self._columns[number].items():
            mover = group.moved_by[name]
            if mover != number:
                yield column, mover, self._columns[mover][name]

    def taken(self, number: int, group: ChannelGroup | None) -> Iterator[tuple[int, float]]:
        """The axes that a channel moves from now on, and where the other one has left them."""
        if group is None:
            return
        for name, column in self._columns[number].items():
            before = self._prepared_by[name]
            if group.moved_by[name] == number != before:
                self._prepared_by[name] = number
                yield column, self.paths[before].position[self._columns[before][name]]
