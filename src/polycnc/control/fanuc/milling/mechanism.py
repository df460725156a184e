"""The mechanism of five axes by parameters: how the tool stands, how far its nose and the rotary axes lie apart.

The machine file has the rotary axes; vectors that parameters give take the place of its own. Parameters 19666, 19697 to
19714 and 19665#4, #5 are general knowledge of the 30i (A-79348E, tool center point control).
"""

from __future__ import annotations

from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.vectors import axis_vector, minus, plus, times
from polycnc.machine.kinematics import Kinematics, unit
from polycnc.transformation.planes.tilted import by_leaning

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.fanuc.milling.parameters import FanucMillingParameters
    from polycnc.geometry.frames import Vector
    from polycnc.machine.model import Joint

_NOWHERE: Vector = (0.0, 0.0, 0.0)
Parts = tuple[float | None, float | None, float | None]


def kinematics_of(channel: Channel, parameters: FanucMillingParameters) -> Kinematics:
    """The joints of the machine file, as far apart as the parameters say, with the tool as they stand it."""
    of_machine = Kinematics.of(channel.machine)
    along = _along(of_machine, parameters)
    tool, between = _head(of_machine.tool, parameters)
    nose = _nose(parameters, along) if of_machine.tool else None
    work = _table(of_machine.work, parameters)
    kinematics = replace(of_machine, along=along, tool=tool, work=work, nose=nose or of_machine.nose)
    if parameters.SVC and not parameters.SPR:
        return kinematics
    to_nose = plus(between, nose or _NOWHERE)
    if parameters.SVC:
        to_nose = minus(to_nose, _shift(channel, parameters))
    return replace(kinematics, to_nose=to_nose)


def _along(kinematics: Kinematics, parameters: FanucMillingParameters) -> Vector:
    """19697 to 19699; the machine file's direction where 19697 names no axis."""
    axis = parameters.tool_axis
    if axis not in (1, 2, 3):
        return kinematics.along
    lean, about = parameters.tool_lean, parameters.tool_lean_about
    return by_leaning(axis - 1, lean, about).direct(*axis_vector(axis - 1))


def _nose(parameters: FanucMillingParameters, along: Vector) -> Vector | None:
    """From the rotary axis that carries the tool to the nose: against 19709 to 19711, then 19666; None for neither."""
    parts = (parameters.tool_apart_x, parameters.tool_apart_y, parameters.tool_apart_z)
    holder = parameters.holder_offset
    if holder is None and parts == (None, None, None):
        return None
    return minus(times(unit(along), -(holder or 0.0)), _vector(parts))


def _head(joints: tuple[Joint, ...], parameters: FanucMillingParameters) -> tuple[tuple[Joint, ...], Vector]:
    """The axes of the head, the second one against 19712 to 19714 from the first, and that way."""
    parts = (parameters.head_apart_x, parameters.head_apart_y, parameters.head_apart_z)
    if len(joints) != 2 or parts == (None, None, None):
        return joints, _NOWHERE
    way = times(_vector(parts), -1.0)
    return (joints[0], replace(joints[1], offset=way)), way


def _table(joints: tuple[Joint, ...], parameters: FanucMillingParameters) -> tuple[Joint, ...]:
    """The axes of the table: the first at 19700 to 19702, the second 19703 to 19705 from it."""
    places: tuple[Parts, ...] = (
        (parameters.table_place_x, parameters.table_place_y, parameters.table_place_z),
        (parameters.table_apart_x, parameters.table_apart_y, parameters.table_apart_z),
    )
    placed = zip(joints, places, strict=False)
    moved = tuple(
        joint if parts == (None,) * 3 else replace(joint, offset=_vector(parts)) for joint, parts in placed
    )
    return (*moved, *joints[len(moved) :])


def _shift(channel: Channel, parameters: FanucMillingParameters) -> Vector:
    """19667 of X, Y and Z."""
    x, y, z = (
        parameters.of(channel.axes[axis]).control_point_shift if axis >= 0 else 0.0
        for axis in channel.coordinates.geometry
    )
    return (x, y, z)


def _vector(parts: Parts) -> Vector:
    x, y, z = (part or 0.0 for part in parts)
    return (x, y, z)
