"""Machine parameters that a macro names by their numbers: PARAM(n), #4001 on, #5001 on."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from polycnc.control.parameters import load_parameters

if TYPE_CHECKING:
    from polycnc.machine.setup.values import Parameters

#: The list of SYNTEC's parameters, in the package `control`.
FILE = "syntec/parameters.toml"
#: Parameters of users and of macro writers, which are 0 as delivered.
USER_PARAMETERS = (range(4001, 4201), range(5001, 5501))


def long_of(parameters: Parameters, number: int) -> int | None:
    """A parameter as a Long: from the setup, else as delivered; None where polycnc does not know it."""
    value = parameters.get(number)
    if isinstance(value, int | float):
        return int(value)
    of_user = 0 if any(number in numbers for numbers in USER_PARAMETERS) else None
    return _delivered().get(number, of_user)


@cache
def _delivered() -> dict[int | str, int]:
    """The delivered value of every number of the list that has one."""
    return {
        key.id: int(parameter.delivered)
        for parameter in load_parameters(FILE)
        if parameter.delivered is not None
        for key in parameter.keys
    }
