"""The mechanism of five-axis machines: what Pr3001 to Pr3004 and Pr3013 say of it (manual 2.45).

The machine file has the rotary joints, so it is what answers where the setup does not. A setup that says something else
is refused where a function would act by it: nobody knows then which of the two is the machine. Two add to it: Pr3002,
along which axis of the machine the tool points with all rotary axes at zero, and Pr3013, how far the nose of a head
lies from its last rotary axis.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.syntec.units import least_unit
from polycnc.deferred.records import replace
from polycnc.geometry.vectors import times
from polycnc.machine.kinematics import Kinematics

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words
    from polycnc.geometry.frames import Vector
    from polycnc.machine import Machine

#: Pr3001: no five-axis machine; both rotary axes in the spindle; both in the table; one in each.
NONE, SPINDLE, TABLE, MIXED = range(4)
#: Pr3002: no direction set, which is Z; the tool points along X, Y or Z of the machine with all rotary axes at zero.
NOT_SET, ALONG_Z = 0, 3
DIRECTIONS: dict[int, Vector] = {1: (1.0, 0.0, 0.0), 2: (0.0, 1.0, 0.0)}
#: How many rotary axes make a five-axis machine.
ROTARY_AXES = 2
TYPE, DIRECTION = 3001, 3002


def mechanism_of(machine: Machine) -> int:
    """Pr3001 as the machine file has it."""
    kinematics = Kinematics.of(machine)
    if len(kinematics.axes) < ROTARY_AXES:
        return NONE
    if not kinematics.work:
        return SPINDLE
    return MIXED if kinematics.tool else TABLE


def value_of_machine(machine: Machine, number: int) -> int | None:
    """A parameter that the machine file answers; None for another."""
    mechanism = mechanism_of(machine)
    if number == TYPE:
        return mechanism
    if number == DIRECTION:
        return ALONG_Z if mechanism != NONE else NOT_SET
    return None


def kinematics_of(channel: SyntecChannel) -> Kinematics:
    """The joints of the machine file, the direction of Pr3002; Pr3013 leads along the tool to the nose of a head."""
    kinematics, parameters = Kinematics.of(channel.machine), channel.memory.parameters
    if parameters.tool_direction in DIRECTIONS:
        kinematics = replace(kinematics, along=DIRECTIONS[parameters.tool_direction])
    if not kinematics.tool or not parameters.holder_length:
        return kinematics
    holder = parameters.holder_length * least_unit(parameters)
    return replace(kinematics, nose=times(kinematics.along, -holder))


def check(channel: SyntecChannel, words: Words, code: str) -> None:
    """Refuse a five-axis function where the parameters name another mechanism than the machine has.

    COR-100 where Pr3001 says that there is none; PC0001 with the parameter where polycnc does not follow it.
    """
    parameters, own = channel.memory.parameters, mechanism_of(channel.machine)
    given = parameters.five_axis_mechanism
    if given == NONE:
        raise words.fail("tip_machine", code)
    contradicted = (
        ("Pr3001", given is not None and given != own),
        ("Pr3002", parameters.tool_direction not in (None, NOT_SET, ALONG_Z, *DIRECTIONS)),
        ("Pr3003", parameters.tool_lean_a % 360_000 != 0),
        ("Pr3004", parameters.tool_lean_b % 360_000 != 0),
    )
    for name, is_so in contradicted:
        if is_so:
            raise channel.control.not_yet(f"{code} {name}", code)
