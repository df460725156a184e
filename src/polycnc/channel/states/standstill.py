"""Programs that wait for ever: will the loop that runs ever do anything again?

A loop that waits for an input spins until somebody switches it. In a run that is calculated nobody does: inputs have
the values of the setup. So where many blocks have moved no axis (they may dwell and show messages), the whole state of
the channels is compared with what it was at the same block before. Where nothing differs, nothing ever will: PC0013. In
the virtual control, whose inputs change while the program runs, nobody looks.
"""

from __future__ import annotations

from polycnc.channel.states.unchanging import unchanging
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel

#: So many blocks without a move are run before states are compared: a macro that calculates is not slowed down.
PATIENCE = 1 << 18


@unchanging
class Standstill:
    """Compares the states of a channel from time to time, at blocks further and further apart.

    Attributes:
        next_look: The count of blocks at which it looks again.
    """

    __slots__ = ("_noted_until", "_place", "_span", "_state", "_ways", "next_look")

    def __init__(self) -> None:
        self.next_look = self._span = PATIENCE
        self._ways = self._noted_until = 0
        self._place: tuple[object, ...] = ()
        self._state: list[object] | None = None

    def look(self, channel: Channel) -> None:
        """Look behind a block.

        Raises:
            AlarmError: PC0013: the state is the very one in which the channel was at this block before.
        """
        from polycnc.channel.states.snapshot import SnapshotError, contents  # for long runs only

        ways, place = channel.toolpath.ways, _place(channel)
        if ways != self._ways:
            self._ways, self._state, self._span = ways, None, PATIENCE
            self.next_look = channel.blocks + PATIENCE
            return
        is_old = self._state is None or channel.blocks >= self._noted_until
        if not is_old and place != self._place:
            return
        try:
            state = contents(channel)
        except SnapshotError:
            self.next_look = channel.blocks + PATIENCE
            return
        if state == self._state and place == self._place:
            raise AlarmError("PC0013")
        self._place, self._state = place, state
        self._noted_until = channel.blocks + self._span
        self._span *= 2
        self.next_look = channel.blocks + 1


def _place(channel: Channel) -> tuple[object, ...]:
    """Where the program stands: what is asked before whole states are compared."""
    return tuple((level.program_number, level.index, level.repeats) for level in channel.stack)
