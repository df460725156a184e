"""Quiet mode (#1500 = 1): blocks only renew the program coordinate, no axis moves."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.channel.path import Move, PathStage
    from polycnc.toolpath import Event


class QuietStage:
    """Swallows moves; events go on."""

    def __init__(self, after: PathStage) -> None:
        self.after = after

    def move(self, move: Move) -> None:
        """Drop a move."""

    def event(self, event: Event, program: int, line: int, context: int) -> None:
        """Pass an event on."""
        self.after.event(event, program, line, context)

    def block(self) -> None:
        """Nothing waits here."""

    def flush(self) -> None:
        """Nothing is held back here."""


def switch_quiet(channel: Channel, *, on: bool) -> None:
    """Put the stage into the path, or take it out; the next move then starts from where the axes really are."""
    memory = channel.memory
    stage: QuietStage | None = memory.quiet
    channel.flush()
    if on and stage is None:
        memory.quiet = QuietStage(channel.head or channel.table)
        channel.put_stage(memory.quiet)
    elif stage is not None and not on:
        memory.quiet = None
        channel.take_stage(stage)
