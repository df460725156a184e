"""The mechanism of five-axis machines: what Pr3001 to Pr3004 and Pr3013 say of it (manual 2.45).

The machine file has the rotary joints, so it is what answers where the setup does not. Joints that the setup tells
otherwise (Pr3001; Pr3021 to Pr3046 are offsets of which the manual has no word) are refused where a function would act
by them: nobody knows then which of the two is the machine. How the tool stands with all rotary axes at zero the setup
may tell anew: Pr3002 along which axis of the machine, Pr3003 and Pr3004 how it leans from that, Pr3013 how far the nose
of a head lies from its last rotary axis.
"""

from __future__ import annotations

from polycnc.control.syntec.units import least_unit
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame
from polycnc.geometry.vectors import axis_vector, dot, times
from polycnc.machine.kinematics import Kinematics, unit
from polycnc.transformation.planes.tilted import by_leaning, square_on

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.syntec.parameters import SyntecParameters
    from polycnc.control.word_address.block.words import Words
    from polycnc.geometry.frames import Vector
    from polycnc.machine import Machine

#: Pr3001: no five-axis machine; both rotary axes in the spindle; both in the table; one in each.
NONE, SPINDLE, TABLE, MIXED = range(4)
#: Pr3002: no direction set; the tool points along X, Y or Z of the machine (1 to 3) with all rotary axes at zero.
NOT_SET = 0
#: By the axis of the tool how it stands there: Z of the frame is the tool, X and Y are the axes that follow that one,
#: as in G19, G18 and G17.
STANDING: tuple[Frame, Frame, Frame] = (
    Frame(((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))),
    Frame(((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))),
    IDENTITY,
)
#: How many rotary axes make a five-axis machine.
ROTARY_AXES = 2
TYPE, DIRECTION, HOLDER, OFFSETS = 3001, 3002, 3013, 3021


def mechanism_of(machine: Machine) -> int:
    """Pr3001 as the machine file has it."""
    kinematics = Kinematics.of(machine)
    if len(kinematics.axes) < ROTARY_AXES:
        return NONE
    if not kinematics.work:
        return SPINDLE
    return MIXED if kinematics.tool else TABLE


def value_of_machine(machine: Machine, parameters: SyntecParameters, number: int) -> int | None:
    """A parameter that the machine file answers; None for another."""
    kinematics, mechanism = Kinematics.of(machine), mechanism_of(machine)
    if number == TYPE:
        return mechanism
    if number == DIRECTION:
        return NOT_SET if mechanism == NONE else 1 + _axis_along(kinematics.along)
    if number == HOLDER:
        return round(-dot(kinematics.nose, unit(kinematics.along)) / least_unit(parameters))
    return None


def kinematics_of(channel: SyntecChannel) -> Kinematics:
    """The joints of the machine file, with the tool as Pr3002 to Pr3004 stand it, the nose as Pr3013 has it."""
    kinematics, parameters = Kinematics.of(channel.machine), channel.memory.parameters
    if _is_told(parameters):
        kinematics = replace(kinematics, along=tool_at_zero(channel).direct(0.0, 0.0, 1.0))
    if not kinematics.tool or parameters.holder_length is None:
        return kinematics
    holder = parameters.holder_length * least_unit(parameters)
    return replace(kinematics, nose=times(unit(kinematics.along), -holder))


def tool_at_zero(channel: SyntecChannel) -> Frame:
    """How the tool stands with all rotary axes at zero, machine coordinates: Z of the frame lies along it.

    Which way RA and RB turn it is general knowledge of the control's five-axis manual, and as on FANUC.
    """
    parameters, along = channel.memory.parameters, Kinematics.of(channel.machine).along
    told = parameters.tool_direction or NOT_SET
    axis = told - 1 if told != NOT_SET else _axis_along(along)
    if axis < 0:
        return square_on(unit(along))
    degrees = least_unit(parameters)
    lean, about = parameters.tool_lean_a * degrees, parameters.tool_lean_b * degrees
    return by_leaning(axis, lean, about) @ STANDING[axis]


def _is_told(parameters: SyntecParameters) -> bool:
    """Whether the setup says how the tool stands."""
    return bool(parameters.tool_direction or parameters.tool_lean_a or parameters.tool_lean_b)


def _axis_along(direction: Vector) -> int:
    """The axis, 0 to 2, that a direction counts up along; -1 for none of them."""
    return next((axis for axis in range(3) if dot(unit(direction), axis_vector(axis)) > 1.0 - 1e-12), -1)


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
        ("Pr3002", parameters.tool_direction not in (None, NOT_SET, 1, 2, 3)),
    )
    offsets = enumerate(parameters.mechanism_offsets, OFFSETS)
    for name, is_so in (*contradicted, *((f"Pr{n}", value != 0) for n, value in offsets)):
        if is_so:
            raise channel.control.not_yet(f"{code} {name}", code)
