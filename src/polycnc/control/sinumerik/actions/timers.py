"""Timers `$AC_TIMER[n]` (10.3.9): a number that is written counts on from there in seconds, a negative one stops it."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.toolpath.events import Deed

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices

NAME = "$AC_TIMER"


@dataclass(slots=True)
class Timers(State, lifetime=Lifetime.POWER):
    """The timers.

    Attributes:
        values: What each showed when it was last started or stopped, s.
        since: Simulated time at which each that runs was started.
    """

    values: dict[int, float] = field(default_factory=dict)
    since: dict[int, float] = field(default_factory=dict)


def _number(channel: SinumerikChannel, indices: Indices) -> int:
    if len(indices) != 1 or not isinstance(indices[0], int):
        raise AlarmError("12400", text=NAME)
    if not 0 <= indices[0] < channel.memory.data.integer("$MC_MM_NUM_AC_TIMER"):
        raise AlarmError("17020", text=NAME, index=indices[0])
    return indices[0]


def _now(channel: SinumerikChannel) -> float:
    clocked = channel.actual.clocked
    return clocked.time if clocked is not None else 0.0


def read(channel: SinumerikChannel, indices: Indices) -> float:
    """What a timer shows now, s."""
    number, timers = _number(channel, indices), Timers.of(channel)
    since = timers.since.get(number)
    return timers.values.get(number, 0.0) + (_now(channel) - since if since is not None else 0.0)


def write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
    """Start a timer at a value, or stop it: of a program when its axes are there."""
    number, timers = _number(channel, indices), Timers.of(channel)

    def store() -> None:
        if value < 0.0:
            timers.values[number] = read(channel, indices)
            timers.since.pop(number, None)
        else:
            timers.values[number], timers.since[number] = float(value), _now(channel)

    if channel.main_run is None:
        store()
    else:
        channel.event(Deed(NAME, number, store))
