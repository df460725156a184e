"""Quiet mode (#1500 = 1): blocks only renew the program coordinate, no axis moves."""

from __future__ import annotations

from polycnc.channel.moves.path import Sink
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.channel.moves.path import PlacedEvent
    from polycnc.control.syntec.family import SyntecChannel


class QuietStage(Sink):
    """Swallows moves; events go on."""

    def event(self, event: PlacedEvent) -> None:
        """Pass an event on."""
        self.after.event(event)


def is_quiet(channel: SyntecChannel) -> bool:
    """Whether quiet mode is on."""
    return channel.path.find(QuietStage) is not None


def switch_quiet(channel: SyntecChannel, *, on: bool) -> None:
    """Put the stage into the path, or take it out; the next move then starts from where the axes really are."""
    channel.flush()
    if not on:
        channel.path.take(QuietStage)
    elif not is_quiet(channel):
        channel.path.put(QuietStage())
