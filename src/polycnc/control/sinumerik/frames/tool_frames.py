"""Frames by the tool and by the table: TOROT, TOFRAME and their like, PAROT.

TOFRAME replaces the programmable frame by a rotation alone; TOROT takes the rotation's place only and leaves where the
programmable frame has its origin. The rotation itself lies in `$P_TOOLFRAME` (Function Manual K2).

Source: statement list, groups 52 and 53; Function Manual K2 (frame rotation in tool direction, SD42980).
"""

from __future__ import annotations

from math import atan2, cos, sin

from polycnc.control.sinumerik.frames import active as frames
from polycnc.control.sinumerik.frames.memory import BEFORE_BASE, chain
from polycnc.control.sinumerik.tools.holders import active as carriers
from polycnc.control.sinumerik.transformations import seat
from polycnc.control.sinumerik.transformations.posture import Posture
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import Frame, Vector
from polycnc.geometry.planes import PLANES
from polycnc.geometry.vectors import axis_vector, cross, dot, minus, times
from polycnc.language.sinumerik.names.frame import NEUTRAL, NcFrame
from polycnc.machine.kinematics import Kinematics, unit

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.toolpath import Context

OFF = "TOROTOF"
#: Functions that also take the programmable frame away.
_ALONE = "TOFRAME"
#: SD42980, its last digit: which direction stays in its old plane; the older values 0 and 1000 mean 1.
_FIRST_STAYS, _SECOND_STAYS = (0, 1), 2
#: Directions are the same where the sine between them is below.
_PARALLEL = 1e-9


def by_tool(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """TOROT, TOFRAME …: an axis of the frame along the tool as it stands now; TOROTOF takes the rotation back."""
    code, state = channel.mode["tool_frame"], channel.memory.frames
    state.system["$P_TOOLFRAME"] = NEUTRAL
    if code == OFF:
        frames.changed(channel)
        return
    if code.startswith(_ALONE):
        state.programmable = NEUTRAL
    axis = "XYZ".index(code[-1]) if code[-1] in "XY" else 2
    system = state.system
    outer = chain([*(system[n] for n in BEFORE_BASE), state.actual_base(), state.active_settable]).frame
    inner = chain(state.inner()).frame
    old, before = Frame(_turned(outer @ inner)), Frame(_turned(outer))
    wanted = _upright(old, axis, tool_direction(channel), channel.memory.data.integer("$SC_TOFRAME_MODE"))
    turn = before.inverse() @ wanted @ Frame(_turned(inner)).inverse()
    system["$P_TOOLFRAME"] = NcFrame(matrix=turn.m, coarse=minus(inner.t, turn.direct(*inner.t)))
    frames.changed(channel)


def by_table(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """PAROT: the work turns with the table of the holder; PAROTOF: only its shift stays."""
    system = channel.memory.frames.system
    if carriers.ActiveCarrier.of(channel).number:
        carriers.turn_table(channel)
    elif channel.mode["workpiece_frame"] == "PAROTOF":
        system["$P_PARTFRAME"] = NcFrame(coarse=system["$P_PARTFRAME"].frame.t)
    frames.changed(channel)


def tool_direction(channel: SinumerikChannel) -> Vector:
    """Direction along the tool in the basic coordinate system.

    An orientation transformation says it; else its edge does, or the plane with its third axis, as the holder turns it.
    """
    if seat.centre_point(channel) is not None:
        posture = Posture.of(channel, channel.mode)
        return posture.direction(posture.angles(channel.coordinates.position))
    return channel.memory.tools.direction(channel.mode["plane"])


def mechanism(channel: SinumerikChannel, context: Context) -> Kinematics:
    """The rotary joints of the machine, with the tool as it stands with them at zero.

    Where no joint carries it, and the machine file names no other axis than Z, it points along the plane's third axis,
    as its length counts, and as a holder turns it.
    """
    point, kinematics = seat.centre_point(channel), Kinematics.of(channel.machine)
    if point is not None:
        return point.kinematics
    if kinematics.tool or kinematics.along != axis_vector(2):
        return kinematics
    across, carrier = axis_vector(PLANES[context.plane][2]), channel.memory.tools.carrier
    return replace(kinematics, along=across if carrier is None else carrier.direct(*across))


def _turned(frame: Frame) -> tuple[Vector, Vector, Vector]:
    """Rotation of a frame without its scale and mirror."""
    columns = [tuple(column) for column in zip(*frame.m, strict=True)]
    x = unit((columns[0][0], columns[0][1], columns[0][2]))
    y = unit(minus(columns[1], times(x, dot(columns[1], x))))
    return _of_columns(x, y, cross(x, y)).m


def _of_columns(x: Vector, y: Vector, z: Vector) -> Frame:
    rows = list(zip(x, y, z, strict=True))
    return Frame((rows[0], rows[1], rows[2]))


def _upright(old: Frame, axis: int, tool: Vector, mode: int) -> Frame:
    """A rotation with one axis along the tool, which turns the two others as little as SD42980 says."""
    first, second = (old.direct(*axis_vector((axis + 1 + i) % 3)) for i in range(2))
    by_first = _beside(cross(second, tool), first)
    by_second = _beside(cross(tool, first), second)
    along: Vector
    if by_second is None or (by_first is not None and mode % 10 in _FIRST_STAYS and mode < 2000):
        along = by_first if by_first is not None else unit(cross(second, tool))
    elif by_first is None or mode % 10 == _SECOND_STAYS:
        along = cross(by_second, tool)
    elif mode % 10 == _FIRST_STAYS[1]:
        along = by_first
    else:
        other = cross(by_second, tool)
        half = 0.5 * atan2(dot(tool, cross(by_first, other)), dot(by_first, other))
        across = times(cross(tool, by_first), sin(half))
        x, y, z = (a * cos(half) + b for a, b in zip(by_first, across, strict=True))
        along = (x, y, z)
    vectors = {axis: tool, (axis + 1) % 3: along, (axis + 2) % 3: cross(tool, along)}
    return _of_columns(vectors[0], vectors[1], vectors[2])


def _beside(direction: Vector, near: Vector) -> Vector | None:
    """A direction of length 1, on the side of another one; None where it is none."""
    if dot(direction, direction) < _PARALLEL**2:
        return None
    found = unit(direction)
    return times(found, -1.0) if dot(found, near) < 0.0 else found
