"""When variables go back to their first values: INIRE, INICF (job planning 1.1.7)."""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.variables import Array
from polycnc.language.sinumerik.runtime import default_value

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.interface import LanguageMemory
    from polycnc.language.sinumerik.names.variables import Variable

#: Which init times an event concerns.
RESET = frozenset({"INIRE", "INICF", "PRLOC"})
NEW_CONFIGURATION = frozenset({"INICF"})


@dataclass(frozen=True, slots=True)
class FirstValues:
    """What REDEF says of a datum of the control.

    Attributes:
        name: The system variable, or R.
        time: Its init time.
        write: Writes the first values; None for those that the datum had before any program.
    """

    name: str
    time: str
    write: Callable[[Channel], None] | None


def remember_first_values(memory: LanguageMemory) -> None:
    """Keep what definition files gave global variables: the first values that events bring back."""
    for variable in memory.global_variables.values():
        if variable.init_time and variable.store is not None:
            variable.first = _copied(variable.store[0])


def _copied(value: Any) -> Any:
    return Array(value.variable, value.items.copy(), value.dims) if isinstance(value, Array) else value


def initialise(channel: Channel, times: Collection[str], *, keep_values: bool) -> None:
    """Bring variables back to their first values, without `keep_values` (MD11270) GUD to the zero of their types.

    NCK variables know INIPO alone: they stay.
    """
    memory: LanguageMemory = channel.memory.language
    for first in memory.first_values.values():
        if first.time in times:
            if first.write is not None:
                first.write(channel)
            else:
                channel.control.restore_setting(channel, first.name)
    for variable in memory.global_variables.values():
        if variable.init_time not in times or variable.range == "NCK" or variable.store is None:
            continue
        held = variable.store[0]
        if isinstance(held, Array):
            held.items[:] = (
                variable.first.items if keep_values else [_zero(variable, memory)] * len(held.items)
            )
        else:
            variable.store[0] = variable.first if keep_values else _zero(variable, memory)


def _zero(variable: Variable, memory: LanguageMemory) -> Any:
    """The value of a type, or the limit that it is beyond (1.1.8)."""
    value = default_value(variable.type, memory)
    if variable.low is not None and value < variable.low:
        value = variable.low
    if variable.high is not None and value > variable.high:
        value = variable.high
    return int(value) if variable.type.name in ("INT", "CHAR") else value
