"""The clock of SINUMERIK: date and time `$A_YEAR` to `$A_MSECOND`.

It does not depend on the host's, so that the same input gives the same output: it begins at the switch `clock` of the
setup (`2026-03-01 14:05:00`), else with the year 2000. Dwells count, moves do not, because programs are read ahead;
each look takes a millisecond, so that a loop which waits for the clock ends.

Source: the list manual of system variables by name.
"""

from __future__ import annotations

from datetime import datetime, timedelta

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Reader

_DELIVERED_CLOCK = "2000-01-01 00:00:00"
_LOOK_S = 0.001
#: Parts of the date and the time, by variable.
PARTS: dict[str, Callable[[datetime], int]] = {
    "$A_YEAR": lambda now: now.year,
    "$A_MONTH": lambda now: now.month,
    "$A_DAY": lambda now: now.day,
    "$A_HOUR": lambda now: now.hour,
    "$A_MINUTE": lambda now: now.minute,
    "$A_SECOND": lambda now: now.second,
    "$A_MSECOND": lambda now: now.microsecond // 1000,
}


@dataclass(slots=True)
class Clock(State, lifetime=Lifetime.POWER):
    """The time that programs have seen go by.

    Attributes:
        waited: Seconds since power-on.
        is_read: Whether a program has looked at the time.
    """

    waited: float = 0.0
    is_read: bool = False

    def compared(self) -> object:
        """What was waited matters to a program that has looked."""
        return super().compared() if self.is_read else ()

    def look(self) -> float:
        """The time now; looking takes its own."""
        now = self.waited
        self.is_read = True
        self.waited += _LOOK_S
        return now


def part_of_clock(part: Callable[[datetime], int]) -> Reader:
    """Reads a part of date or time; alarm 12160 for a switch `clock` that is none."""

    def read(channel: SinumerikChannel, _indices: Indices) -> int:
        text = str(channel.setup.switches.signals.get("clock", _DELIVERED_CLOCK))
        try:
            start = datetime.fromisoformat(text)
        except ValueError:
            raise AlarmError("12160", text=text) from None
        return part(start + timedelta(seconds=Clock.of(channel).look()))

    return read
