"""FCTDEF and SYNFCT: polynomials of the third degree with limits (10.4.6, 10.4.7)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError

with loaded_when_called():
    from polycnc.control.sinumerik.block import arguments

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Reader, RowWithStop, Writer

#: Places of the numbers of a function: limits, then coefficients.
FIELDS = {"LL": 0, "UL": 1, "0": 2, "1": 3, "2": 4, "3": 5}
LOW, HIGH, FIRST = 0, 1, 2


@dataclass(slots=True)
class Polynomials(State, lifetime=Lifetime.POWER):
    """What FCTDEF has defined: limits and coefficients, by number."""

    numbers: dict[int, list[float]] = field(default_factory=dict)


def _of(channel: SinumerikChannel, number: int) -> list[float]:
    """The numbers of a function, zero where none were given; 17020 for one that MD28252 does not provide."""
    if not 1 <= number <= channel.memory.data.integer("$MC_MM_NUM_FCTDEF_ELEMENTS"):
        raise AlarmError("17020", text="FCTDEF", index=number)
    return Polynomials.of(channel).numbers.setdefault(number, [0.0] * len(FIELDS))


def define(channel: SinumerikChannel, args: Arguments) -> None:
    """FCTDEF(number,lower limit,upper limit,a0,a1,a2,a3): coefficients left out are 0."""
    if not 3 <= len(args) <= 1 + len(FIELDS) or None in args[:3]:
        raise AlarmError("14020", text="FCTDEF")
    numbers = _of(channel, arguments.whole(args[0]))
    given = [0.0 if value is None else arguments.real(value) for value in args[1:]]
    numbers[:] = given + [0.0] * (len(FIELDS) - len(given))


def value(channel: SinumerikChannel, number: int, at: float) -> float:
    """The value of a function, within its limits; 17020 for one that nothing has defined."""
    if number not in Polynomials.of(channel).numbers:
        raise AlarmError("17020", text="FCTDEF", index=number)
    numbers = _of(channel, number)
    a0, a1, a2, a3 = numbers[FIRST:]
    return min(max(a0 + at * (a1 + at * (a2 + at * a3)), numbers[LOW]), numbers[HIGH])


def _reader(place: int) -> Reader:
    def read(channel: SinumerikChannel, indices: Indices) -> float:
        return _of(channel, _number(indices))[place]

    return read


def _writer(place: int) -> Writer:
    def write(channel: SinumerikChannel, indices: Indices, new: float) -> None:
        _of(channel, _number(indices))[place] = float(new)

    return write


def _number(indices: Indices) -> int:
    if len(indices) != 1 or not isinstance(indices[0], int):
        raise AlarmError("12400", text="$AC_FCT")
    return indices[0]


POLYNOMIAL_VARIABLES: dict[str, RowWithStop] = {
    f"$AC_FCT{name}": (Type.REAL, _reader(place), _writer(place), True) for name, place in FIELDS.items()
}
PROCEDURES = {"FCTDEF": define}
