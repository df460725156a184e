"""Machine parameters that a macro names by their numbers: PARAM(n), GETPR(n), SETPR(n, v), #4001 on, #5001 on."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State, retained
from polycnc.control.syntec.five_axes import mechanism
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.memory.retained import PARAMETERS
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.syntec.memory import SyntecMemory
    from polycnc.control.syntec.parameters import SyntecParameters

#: Parameters of users and of macro writers, which are 0 as delivered.
USER_PARAMETERS = (range(4001, 4201), range(5001, 5501))


@dataclass(slots=True)
class WrittenParameters(State, lifetime=Lifetime.RETAINED):
    """User parameters that macros have written, by number."""

    values: dict[int, int] = retained(PARAMETERS, of_control=True)


def is_user_parameter(number: int) -> bool:
    """Whether nothing but macros reads a parameter."""
    return any(number in numbers for numbers in USER_PARAMETERS)


def long_of(parameters: SyntecParameters, number: int) -> int | None:
    """A parameter as a Long: from the setup, else as delivered; None where polycnc does not know it."""
    value = parameters.at(number)
    if value is not None:
        return int(value)
    return 0 if is_user_parameter(number) else None


def read_long(memory: SyntecMemory, number: int) -> int | None:
    """A parameter as macros read it: as one has written it, else `long_of`, else what the machine file answers."""
    written = WrittenParameters.of(memory.channel).values.get(number)
    if written is not None:
        return written
    value = long_of(memory.parameters, number)
    if value is not None:
        return value
    return mechanism.value_of_machine(memory.channel.machine, memory.parameters, number)


def write_long(memory: SyntecMemory, number: int, value: int) -> None:
    """Write a user parameter; PC0001 for one by which the control acts, COR-016 for one that there is not."""
    if is_user_parameter(number):
        WrittenParameters.of(memory.channel).values[number] = value
        return
    if read_long(memory, number) is None:
        raise AlarmError("COR-016", variable=f"Pr{number}")
    raise AlarmError("PC0001", hint="hint.not-supported", code=f"SETPR({number})")
