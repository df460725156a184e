"""Predefined functions whose value depends on the state of the control.

Source: job planning 5.2 (frame functions), 14.1 (axis functions), 10.4.13 (POSRANGE).
"""

from __future__ import annotations

from polycnc.control.sinumerik.block.arguments import Arguments
from polycnc.control.sinumerik.block.positions import ModuloRange
from polycnc.control.sinumerik.contours import use
from polycnc.control.sinumerik.curve_tables import administration, reading
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.frames import adding, codes
from polycnc.control.sinumerik.frames.variables import frame_axis
from polycnc.control.sinumerik.limits import calcposi
from polycnc.control.sinumerik.signals import workpiece
from polycnc.control.sinumerik.tools import d_numbers
from polycnc.control.sinumerik.tools.management import components, corrections, environments, lists, magazines
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry import fit
from polycnc.language.sinumerik.formatting import formatted
from polycnc.language.sinumerik.keywords import CONTROL_FUNCTIONS
from polycnc.language.sinumerik.names.frame import GEOMETRY_AXES, NEUTRAL, NcFrame, crpl
from polycnc.language.sinumerik.names.spindles import axis_of_spindle, spindle_number
from polycnc.language.sinumerik.names.values import Axis
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Vector


def value(channel: SinumerikChannel, name: str, args: Arguments, column: int) -> Any:
    """The value of a function; PC0001 for one that is not executed, with the column of the call."""
    function = FUNCTIONS.get(name)
    if function is None:
        raise not_supported(name)
    letters = CONTROL_FUNCTIONS[name].arguments
    needed = sum(1 for letter in letters if letter.isupper() or letter == "[")
    try:
        if len(args) < needed or None in args[:needed] or (len(args) > len(letters) and letters != "*"):
            raise AlarmError("14020", text=name)
        return function(channel, args)
    except AlarmError as alarm:
        alarm.column = alarm.column or column
        raise


def is_axis(channel: SinumerikChannel, args: Arguments) -> bool:
    """ISAXIS(n): whether geometry axis 1, 2 or 3 exists."""
    number = args[0]
    if not 1 <= number <= 3:
        raise AlarmError("14020", text="ISAXIS")
    return channel.coordinates.geometry[number - 1] >= 0


def modulo_position(channel: SinumerikChannel, args: Arguments) -> float:
    """MODAXVAL(axis, position): the position within the modulo range; unchanged for other axes."""
    memory = channel.memory
    position = float(args[1])
    axis = axis_of_spindle(channel, args[0])
    spindle = spindle_number(axis)
    if spindle is not None:
        channel.memory.spindles.get(spindle)
        return ModuloRange.of(memory.data, axis.name).shown(position)
    column = memory.column(axis.name)
    if not channel.memory.axes[column].modulo:
        return position
    return ModuloRange.of(memory.data, channel.axes[column]).shown(position)


def spindle_of(channel: SinumerikChannel, args: Arguments) -> int:
    """AXTOSPI(axis): number of the spindle that an identifier means, or that the axis is; 14092 for another axis."""
    number = spindle_number(args[0])
    if number is not None:
        return channel.memory.spindles.get(number).number
    name = channel.axes[channel.memory.column(args[0].name)]
    numbers = [spindle.number for spindle in channel.machine.spindles if spindle.axis == name]
    if not numbers:
        raise AlarmError("14092", text=name)
    return numbers[0]


def identifier_of_spindle(channel: SinumerikChannel, args: Arguments) -> Axis:
    """SPI(n): identifier of a spindle."""
    channel.memory.spindles.get(args[0])
    return Axis(f"S{args[0]}")


def rotation_in_plane(_channel: SinumerikChannel, args: Arguments) -> NcFrame:
    """CRPL(plane, angle): 0 for Z, 1 for X, 2 for Y as the axis of rotation."""
    plane = args[0]
    if not 0 <= plane <= 3:
        raise AlarmError("14020", text="CRPL")
    return crpl((plane + 2) % 3, float(args[1]))


def solid_rotation(channel: SinumerikChannel, args: Arguments) -> NcFrame:
    """CROTS(axis, angle, …): rotation with solid angles."""
    if len(args) % 2:
        raise AlarmError("14020", text="CROTS")
    angles = {frame_axis(channel, args[i].name): float(args[i + 1]) for i in range(0, len(args), 2)}
    if any(axis not in GEOMETRY_AXES for axis in angles):
        raise AlarmError("16440", axis=",".join(angles))
    return codes.crots(angles)


def in_window(_channel: SinumerikChannel, _args: Arguments) -> bool:
    """POSRANGE(axis, reference, window, system): of synchronised actions alone (10.4.13); 14091 in a program."""
    raise AlarmError("14091", text="POSRANGE")


def sprint(_channel: SinumerikChannel, args: Arguments) -> str:
    """SPRINT(format, value, …): the text with its marks replaced."""
    if not args or not isinstance(args[0], str):
        raise AlarmError("14020", text="SPRINT")
    return formatted(args[0], args[1:])


def measured_frame(_channel: SinumerikChannel, args: Arguments) -> NcFrame:
    """MEAFRAME(ideal, measured, VAR quality): best fit; quality -1 or -2 where points lie on a line."""
    ideal, measured = (_points(array) for array in args[:2])
    for points, mistake in ((ideal, -1.0), (measured, -2.0)):
        if fit.is_collinear(*points):
            args[2].value = mistake
            return NEUTRAL
    frame = fit.rigid_fit(ideal, measured)
    args[2].value = sum(fit.distances(frame, ideal, measured))
    return NcFrame(matrix=frame.m, coarse=frame.t)


def _points(array: Any) -> list[Vector]:
    """The three points of a REAL array [3,3]: a row is a point."""
    if tuple(array.dims) != (3, 3):
        raise AlarmError("12360", text="MEAFRAME")
    rows = (array.items[i : i + 3] for i in (0, 3, 6))
    return [(float(x), float(y), float(z)) for x, y, z in rows]


FUNCTIONS: dict[str, Callable[[SinumerikChannel, Arguments], Any]] = {
    "ISAXIS": is_axis,
    "MEAFRAME": measured_frame,
    "MODAXVAL": modulo_position,
    "ADDFRAME": adding.add,
    "CALCPOSI": calcposi.calculate,
    "AXTOSPI": spindle_of,
    "SPI": identifier_of_spindle,
    "CRPL": rotation_in_plane,
    "CROTS": solid_rotation,
    "POSRANGE": in_window,
    "SPRINT": sprint,
    **use.FUNCTIONS,
    "DELDL": d_numbers.delete_additive,
    "CHKDNO": d_numbers.check_numbers,
    "GETDNO": d_numbers.get_number,
    "SETDNO": d_numbers.set_number,
    "GETACTTD": d_numbers.tool_of_number,
    **workpiece.FUNCTIONS,
    **lists.FUNCTIONS,
    **magazines.FUNCTIONS,
    **environments.FUNCTIONS,
    **components.FUNCTIONS,
    **corrections.FUNCTIONS,
    **administration.FUNCTIONS,
    **reading.FUNCTIONS,
}
