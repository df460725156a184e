"""The run of a program as an object: it goes from wait to wait, and where it stands is in its fields.

So whoever drives it may stop behind any wait, take a snapshot (`snapshot`) and go on from there again later.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.channel.waits import Wait
    from polycnc.program import Program


class Run:
    """The waits of a channel that runs a program; it begins when the first one is asked for.

    Args:
        channel: The channel.
        program: The main program.
        power_on: Begin in the state of power-on; else in the state that the channel is in.
        enter: Called at the first block: it may begin at another one.
    """

    __slots__ = ("_begun", "_channel", "_enter", "_over", "_power_on", "_program")

    def __init__(
        self,
        channel: Channel,
        program: Program,
        *,
        power_on: bool,
        enter: Callable[[Channel], None] | None = None,
    ) -> None:
        self._channel = channel
        self._program = program
        self._power_on = power_on
        self._enter = enter
        self._begun = self._over = False

    def __iter__(self) -> Run:
        return self

    def __next__(self) -> Wait:
        channel = self._channel
        if not self._begun:
            self._begun = True
            channel.begin(self._program, power_on=self._power_on)
            if self._enter is not None:
                self._enter(channel)
                self._enter = None
            first, channel.wait = channel.wait, None
            if first is not None:  # it is to be executed in time from its first block on
                return first
        while not self._over and not channel.finished:
            wait = channel.advance()
            if wait is not None:
                return wait
        if not self._over:
            self._over = True
            channel.flush()
        raise StopIteration
