"""Machine parameters (Pr) as delivered, and what they mean for reading numbers.

Only parameters that polycnc evaluates are here; `PARAM(n)` of another one is VACANT unless the setup names
it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.machine.setup.values import Parameters

DELIVERED: dict[int, int] = {
    17: 2,  # input unit: 2 is 0.001 mm
    411: 0,  # G00: 0 straight line, 1 every axis by itself
    3215: 0,  # T code: 0 plain, 1 subprogram T0000, 2 macro T0000
    3229: 0,  # work coordinate systems: 0 on, 1 off
    3241: 0,  # numbers without a point: 0 least input units, 1 whole units
    3600: 96,  # M code of the interrupt function
    3807: 10,  # arc end tolerance, least units
    3809: 0,  # 1: U V W are increments of X Y Z
    3815: 0,  # start and cancel of radius compensation
    3819: 0,  # 1: overcut check of radius compensation
    3835: 0,  # machining condition at the start
    3836: 0,  # feed mode at power-on: 0 per minute, 1 per revolution
    3838: 0,  # 1: G22 at power-on
}
#: Parameters whose delivered value is zero, by number ranges: registered codes, user parameters.
ZERO_RANGES = ((281, 300), (3601, 3610), (3701, 3710), (4001, 4200), (5001, 5500))
#: Least input units in millimetres or degrees, and in inches, by Pr17 (manual, chapter 5).
DECIMALS = {1: 2, 2: 3, 3: 4}
DECIMALS_INCH = {1: 3, 2: 4, 3: 5}

#: Names of the work coordinate systems G54 P1 … P100 in the memory of offsets.
WORK_SYSTEMS = (
    *(f"G{number}" for number in range(54, 60)),
    *(f"G59.{number}" for number in range(1, 10)),
    *(f"G54 P{number}" for number in range(16, 101)),
)


def parameter(parameters: Parameters, number: int) -> int:
    """A parameter as a Long: from the setup, else as delivered, else 0."""
    value = parameters.get(number)
    if isinstance(value, bool | int | float):
        return int(value)
    return DELIVERED.get(number, 0)


def is_known(parameters: Parameters, number: int) -> bool:
    """Whether a parameter has a value here."""
    if number in DELIVERED or any(first <= number <= last for first, last in ZERO_RANGES):
        return True
    return parameters.get(number) is not None


def decimals(parameters: Parameters, *, inch: bool) -> int:
    """Decimals of the least input unit."""
    table = DECIMALS_INCH if inch else DECIMALS
    return table.get(parameter(parameters, 17), table[2])


def is_diameter(parameters: Parameters, axis: int) -> bool:
    """Whether the axis with this index (from 0) is programmed in diameters (Pr281~)."""
    return parameter(parameters, 281 + axis) == 1


def has_option(parameters: Parameters, number: int) -> bool:
    """Whether a software option is enabled; built-in machines have all unless the setup says otherwise."""
    value = parameters.get(f"OPTION{number}")
    return value is None or bool(value)
