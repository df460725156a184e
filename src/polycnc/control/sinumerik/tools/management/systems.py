"""Coordinate systems in which lengths of a tool are told: how each of them sees a vector of the tool.

From the tool to the work: the tool as it is drawn (TCS), a toolholder turns it (KCS), the head of a transformation
turns that (MCS), a table turns the work (BCS), frames turn the work (WCS). Without a transformation KCS, MCS and BCS
are one, and so they are under an inclined axis: only orientation transformations make a system of the machine in which
a length means something. Source: Function Manual W1 (names of the systems; linear transformations).
"""

from __future__ import annotations

from math import isclose

from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tools.selection import rules_of
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame
from polycnc.geometry.vectors import cross

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.transformation.contract import Transformation

#: Letters of the systems; their names begin with them.
BASIC, KINEMATIC, MACHINE, TOOL, WORK = "BKMTW"
SYSTEMS = frozenset((BASIC, KINEMATIC, MACHINE, TOOL, WORK))
NAMES = {name: name[0] for name in ("BCS", "KCS", "MCS", "TCS", "WCS")}
#: A direction of the machine is one of the basic system too where its length differs from 1 by no more.
_EXACT = 1e-9


def seen_from(channel: SinumerikChannel, system: str, name: str) -> Frame:
    """The turn that makes coordinates of a system of those behind the toolholder.

    Args:
        channel: The channel.
        system: Letter of the system.
        name: The function that asks, for its alarm.

    Raises:
        AlarmError: PC0001 in the pole of TRANSMIT.
    """
    if system == KINEMATIC:
        return IDENTITY
    if system == TOOL:
        return (channel.memory.tools.carrier or IDENTITY).inverse()
    machine, basic = _of_transformation(channel, name)
    if system == WORK:
        return rules_of(channel).work.inverse() @ basic
    return machine if system == MACHINE else basic


def has_offsets(channel: SinumerikChannel) -> bool:
    """Whether an orientation transformation acts whose head has offsets beside the tool."""
    point = seat.centre_point(channel)
    if point is None:
        return False
    parts = (point.kinematics.nose, *(joint.offset for joint in point.kinematics.tool))
    return any(any(part) for part in parts)


def _of_transformation(channel: SinumerikChannel, name: str) -> tuple[Frame, Frame]:
    """From the head to the machine, and to the basic system, as the axes stand."""
    state = seat.Transformations.of(channel)
    if state.build is None or state.seated is None:
        return IDENTITY, IDENTITY
    position = state.seated.basic(channel.coordinates.position)
    point = seat.centre_point(channel)
    if point is not None:
        standing = zip(point.axes, position, point.zero, strict=True)
        angles = {axis: value + zero for axis, value, zero in standing}
        head, table = point.kinematics.head_turn(angles), point.kinematics.work_turn(angles)
        return _direction(head), _direction(table.inverse() @ head)
    if state.build.lengths == "before":  # the inclined axis: tools lie in front of it
        return IDENTITY, IDENTITY
    return IDENTITY, _of_axes(state.seated.inner, position, name)


def _direction(frame: Frame) -> Frame:
    """What a frame makes of directions."""
    return Frame(frame.m)


def _of_axes(made: Transformation, position: Sequence[float], name: str) -> Frame:
    """From the machine's axes to the basic system: the infeed of TRANSMIT lies where the work has turned."""
    columns = [column for column in made.geometry if column >= 0]
    slopes = made.jacobian(list(position))
    infeed, along = ([float(slopes[i][j]) for j in columns] for i in (columns[0], columns[-1]))
    if len(columns) < 3 or not all(
        isclose(sum(v * v for v in way), 1.0, abs_tol=_EXACT) for way in (infeed, along)
    ):
        raise not_supported(f"{name}: TRANSMIT TRACYL")
    second = cross((along[0], along[1], along[2]), (infeed[0], infeed[1], infeed[2]))
    rows = zip(infeed, second, along, strict=True)
    x, y, z = rows
    return Frame((x, y, z))
