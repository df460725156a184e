"""Main programs that begin again (M99): will another pass differ from the last one?

A bar lathe cuts part after part until somebody presses a key. A run that is calculated has nobody to press it, so it
ends where another pass would begin in the very state in which the last one began: everything that follows would be the
same, for ever. A program that counts, reads a clock or changes an offset does not come to that place before its time.
"""

from __future__ import annotations

from polycnc.channel.states.state import plain, plain_states, plain_tables
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel


class Passes:
    """Counts the passes of a main program, and knows when they have begun to repeat themselves.

    Attributes:
        count: Passes that are over.
        repeat: Whether all further ones would be like the last one.
    """

    def __init__(self) -> None:
        self.count = 0
        self.repeat = False
        self._state: tuple[object, ...] | None = None

    def begin_again(self, channel: Channel) -> None:
        """The main program begins again; ends the run where it would do so for ever.

        States are compared where the number of passes is a power of two: that costs a long run nothing.
        """
        self.count += 1
        if self.count & (self.count - 1) == 0 and self.count > 1:
            self.repeat = self._state is not None and self._state == _state(channel)
            if self.repeat:
                channel.end()
        if self.count & (self.count + 1) == 0:
            self._state = None if _hears(channel) else _state(channel)


def _hears(channel: Channel) -> bool:
    """Whether the course of the program hangs on more than its own state: inputs that come once, other channels."""
    switches, group = channel.setup.switches, channel.group
    others = group is not None and any(other.memory is not None for other in group.channels[1:])
    return others or bool(switches.probe or switches.interrupts or switches.signals_at)


def _state(channel: Channel) -> tuple[object, ...]:
    """Everything that a further pass begins with, as plain values."""
    c, control = channel.coordinates, channel.control
    named: dict[str, object] = {
        name: control.read_variable(channel, name) for name in control.variable_names(channel)
    }
    return (
        id(channel.mode), channel.level.index, repr(channel.feed), list(c.position), list(c.programmed),
        list(c.pending), list(c.offsets), repr(c.zero), repr(c.programming),
        named, plain_states(channel), plain_tables(channel), plain(channel.level.locals),
    )  # fmt: skip
