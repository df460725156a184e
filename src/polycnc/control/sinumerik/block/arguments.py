"""Arguments of predefined procedures, checked: the language hands them over as they were written."""

from __future__ import annotations

from collections.abc import Callable

from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.spindles import spindle_number
from polycnc.language.sinumerik.names.values import Axis
from polycnc.language.sinumerik.names.variables import Array, Reference
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Arguments as the language hands them over, None for one that is left out; and what they are handed to.
Arguments = tuple[Any, ...]
Procedure = Callable[["SinumerikChannel", Arguments], None]


def real(value: Any) -> float:
    """A number; alarm 12330 for anything else."""
    if isinstance(value, (int, float)):
        return float(value)
    raise AlarmError("12330", text=_shown(value))


def whole(value: Any) -> int:
    """A whole number; alarm 12330 for anything else."""
    number = real(value)
    if number != int(number):
        raise AlarmError("12330", text=_shown(value))
    return int(number)


def column(channel: SinumerikChannel, value: Any) -> int:
    """Column of an axis; alarm 12040 for anything else, 12050 for an axis that the channel does not have."""
    if not isinstance(value, Axis):
        raise AlarmError("12040", text=_shown(value))
    found: int = channel.memory.column(value.name)
    return found


def spindle(value: Any) -> int | None:
    """Number of a spindle, by number or identifier; None where it is left out."""
    if value is None:
        return None
    number = spindle_number(value) if isinstance(value, Axis) else None
    return whole(value) if number is None else number


def give_back(place: Any, value: int) -> None:
    """Put a whole number into a variable that was handed over; alarm 12330 for what is none for a number."""
    if not isinstance(place, Reference) or not place.variable.type.is_number:
        raise AlarmError("12330", text=_shown(place))
    place.value = value


def _shown(value: Any) -> str:
    if isinstance(value, Reference | Array):
        return str(value.variable.name)
    return value.name if isinstance(value, Axis) else str(value)
