"""Ring buffers `$AC_FIFO1[i]` … `$AC_FIFO10[i]` (10.3.10): the first indices have meanings of their own."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Reader, RowWithStop, Writer

NEXT, OLDEST, NEWEST, SUM, COUNT, PLACE, FIRST = range(7)
MOST = 10
#: MD28266 bit 0: the sum is kept.
_KEEPS_SUM = 1


@dataclass(slots=True)
class Fifos(State, lifetime=Lifetime.POWER):
    """The buffers.

    Attributes:
        values: What each holds, the oldest first.
        written: How many elements have been appended to each since it was emptied.
    """

    values: dict[int, list[float]] = field(default_factory=dict)
    written: dict[int, int] = field(default_factory=dict)


def values(channel: SinumerikChannel, number: int) -> list[float]:
    """What a buffer holds, the oldest first; change it in place."""
    return Fifos.of(channel).values.setdefault(number, [])


def _buffer(channel: SinumerikChannel, number: int, indices: Indices) -> tuple[list[float], int, int]:
    """The elements, the index, and how many elements there may be; 0 where MD28264 sets no end."""
    name = f"$AC_FIFO{number}"
    found, length = values(channel, number), channel.memory.data.integer("$MC_LEN_AC_FIFO")
    if len(indices) != 1 or not isinstance(indices[0], int):
        raise AlarmError("12400", text=name)
    if not 0 <= indices[0] < FIRST + (length or len(found)):
        raise AlarmError("17020", text=name, index=indices[0])
    return found, indices[0], length


def _reader(number: int) -> Reader:
    def read(channel: SinumerikChannel, indices: Indices) -> float:
        held, index, length = _buffer(channel, number, indices)
        if index == COUNT:
            return float(len(held))
        if index == PLACE:
            written = Fifos.of(channel).written.get(number, 0)
            return float(written % length if length else written)
        if index == SUM:
            keeps = channel.memory.data.integer("$MC_MODE_AC_FIFO") & _KEEPS_SUM
            return sum(held) if keeps else 0.0
        if index == NEXT:
            return held.pop(0) if held else 0.0
        place = _place(index, held)
        return held[place] if 0 <= place < len(held) else 0.0

    return read


def _writer(number: int) -> Writer:
    def write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
        held, index, length = _buffer(channel, number, indices)
        written = Fifos.of(channel).written
        if index == NEXT:
            written[number] = written.get(number, 0) + 1
            held.append(float(value))
            if 0 < length < len(held):
                del held[0]
        elif index == COUNT and value == 0:
            held.clear()
            written[number] = 0
        elif index in (SUM, COUNT, PLACE):
            raise AlarmError("17210", text=f"$AC_FIFO{number}[{index}]")
        elif 0 <= (place := _place(index, held)) < len(held):
            held[place] = float(value)

    return write


def _place(index: int, held: list[float]) -> int:
    """The element that an index means: the oldest, the newest, or the n-th."""
    if index == OLDEST:
        return 0
    return len(held) - 1 if index == NEWEST else index - FIRST


FIFO_VARIABLES: dict[str, RowWithStop] = {
    f"$AC_FIFO{number}": (Type.REAL, _reader(number), _writer(number), True) for number in range(1, MOST + 1)
}
