"""Joined steps that have become hot: the scanner runs them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.toolpath.table import CHUNK_ROWS

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.channel.steps import Step

#: Blocks that make a try of the scanner worth its while: joined steps are fast, and the scanner needs all variables.
WORTHWHILE = 256
#: Blocks that are run here at the most between two tries.
MOST_PATIENCE = 8_192


class HotLoop:
    """Joined steps that come round again; once they have run for long the scanner runs them, as far as it can.

    Args:
        joined: The joined steps.
        alone: The first one of them: single block operation runs that alone.
    """

    __slots__ = ("_done", "_joined", "_next_try", "_patience", "alone")

    def __init__(self, joined: Step, alone: Step) -> None:
        self._joined = joined
        self.alone = alone
        self._done = self._next_try = 0
        self._patience = 1

    def __call__(self, channel: Channel) -> None:
        """Run the steps, and what follows as far as it can be scanned."""
        begin = channel.blocks
        if channel.bulk is not None and self._done >= self._next_try and channel.bulk.pays(self._done):
            scanner = channel.scanner()
            taken = 0 if scanner is None else scanner.turn(channel)
            self._patience = 1 if taken >= WORTHWHILE else min(2 * self._patience, MOST_PATIENCE)
            self._next_try = self._done + self._patience
            if taken:
                if len(channel.toolpath.chunk) >= CHUNK_ROWS:  # it is handed on first
                    self._next_try = self._done
                channel.blocks -= 1  # whoever runs a step counts it
                channel.attention = True
                return
        self._joined(channel)
        self._done += channel.blocks - begin + 1
