"""What is configured: the transformations that TRAORI(n), TRANSMIT(n) … choose from.

Machine data name them: `$MC_TRAFO_TYPE_1` and so on give the types, and the n-th of a kind is what `n` means. A machine
whose data say nothing has what its kinematic chain allows, one of each kind. The geometry is that of the machine file.
"""

from __future__ import annotations

from dataclasses import replace
from math import atan2, degrees
from typing import TYPE_CHECKING, NamedTuple

from polycnc.deferred.records import dataclass
from polycnc.geometry.vectors import dot
from polycnc.machine.kinematics import Kinematics, unit
from polycnc.messages import AlarmError
from polycnc.transformation.kinematic.cylinder import Cylinder
from polycnc.transformation.kinematic.groove import GrooveCylinder
from polycnc.transformation.kinematic.inclined import InclinedAxis
from polycnc.transformation.kinematic.polar import PolarPlane
from polycnc.transformation.numbers import RADIAN
from polycnc.transformation.orientation.tool_centre import ToolCentrePoint

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Vector
    from polycnc.transformation.contract import Geometry, Transformation

#: Kinds, by the procedure that selects them, and the types of each (MD24100 and following).
TYPES: dict[str, range] = {
    "TRAORI": range(16, 160),
    "TRANSMIT": range(256, 258),
    "TRACYL": range(512, 515),
    "TRAANG": range(1024, 1025),
    "TRACON": range(9999, 10000),
}
#: Types of TRACYL: groove walls by a linear axis, always or by the third argument.
WITH_WALLS, WALLS_BY_ARGUMENT = 513, 514
#: Sides of the pole of TRANSMIT by MD24911 and MD24951; 0, as delivered, leaves both.
SIDES = {1: 1.0, 2: -1.0}
#: As many transformations as machine data can name.
COUNT = 10
#: Machine data of lengths and angles in a transformation, `_n` behind them: with a value they would move its joints.
SHIFTS: dict[str, tuple[str, ...]] = {
    "TRAORI": (
        "$MC_TRAFO5_PART_OFFSET",
        "$MC_TRAFO5_JOINT_OFFSET",
        "$MC_TRAFO5_JOINT_OFFSET_PART",
        "$MC_TRAFO5_BASE_TOOL",
        "$MC_TRAFO5_NUTATOR_AX_ANGLE",
        "$MC_TRAFO5_TOOL_ROT_AX_OFFSET",
    ),
    "TRANSMIT": ("$MC_TRANSMIT_BASE_TOOL", "$MC_TRANSMIT_ROT_AX_OFFSET"),
    "TRACYL": ("$MC_TRACYL_BASE_TOOL", "$MC_TRACYL_ROT_AX_OFFSET"),
    "TRAANG": ("$MC_TRAANG_BASE_TOOL",),
}
#: Machine data that turn the sense of a rotary axis round where they are 0.
SENSES = {
    "TRAORI": "$MC_TRAFO5_ROT_SIGN_IS_PLUS",
    "TRANSMIT": "$MC_TRANSMIT_ROT_SIGN_IS_PLUS",
    "TRACYL": "$MC_TRACYL_ROT_SIGN_IS_PLUS",
}
_PARALLEL = 1e-6
_TURNS = 1e-9


class DataSet(NamedTuple):
    """A configured transformation: its kind, its type (0 where the machine file alone tells it), and its number."""

    kind: str
    type: int
    number: int


@dataclass(frozen=True, slots=True)
class Build:
    """What a data set makes of the axes, before frames and tool.

    Attributes:
        inner: The transformation.
        used: Columns of axes that programs cannot name while it acts.
        lengths: Where lengths of the tool count: `tip` (within), `behind`, or `before`.
        walls: Where a linear axis keeps the tool square to groove walls (TRACYL, types 513 and 514), the column
            that says how far it goes; else -1.
        bound: Columns of axes that move with the path alone: neither positioned nor oscillating beside it.
        order: Number of its machine data, among those of its kind.
        follows_tool: The tool may say its direction (TRAORI whose call does not).
        changes_sides: The infeed axis goes through the pole to its other side (TRANSMIT with MD24911 = 0).
    """

    inner: Transformation
    used: frozenset[int] = frozenset()
    lengths: str = "behind"
    walls: int = -1
    bound: frozenset[int] = frozenset()
    order: int = 1
    follows_tool: bool = False
    changes_sides: bool = False


def find(channel: SinumerikChannel, kind: str, number: int) -> DataSet:
    """The n-th configured transformation of a kind.

    Raises:
        AlarmError: 14401 where there is none.
    """
    data = channel.memory.data
    types = [(n, data.integer(f"$MC_TRAFO_TYPE_{n}")) for n in range(1, COUNT + 1) if _is_named(channel, n)]
    own = [DataSet(kind, type_, n) for n, type_ in types if type_ in TYPES[kind]]
    found = own or [DataSet(kind, 0, 1)]
    if not 1 <= number <= len(found) or (types and not own):
        raise AlarmError("14401", text=f"{kind}({number})")
    return found[number - 1]


def _is_named(channel: SinumerikChannel, n: int) -> bool:
    return channel.memory.data.is_set(f"$MC_TRAFO_TYPE_{n}")


def order(channel: SinumerikChannel, found: DataSet) -> int:
    """Which one of its kind a data set is: machine data of a kind count from 1."""
    data = channel.memory.data
    before = range(1, found.number)
    return 1 + sum(
        _is_named(channel, n) and data.integer(f"$MC_TRAFO_TYPE_{n}") in TYPES[found.kind] for n in before
    )


def vector(channel: SinumerikChannel, name: str) -> Vector | None:
    """A vector of machine data; None where it is not set."""
    data = channel.memory.data
    if not any(data.is_set(name, i) for i in range(3)):
        return None
    x, y, z = (data.number(name, i) if data.is_set(name, i) else 0.0 for i in range(3))
    return (x, y, z)


def number_of(channel: SinumerikChannel, name: str, index: int, default: float) -> float:
    """An element of a machine datum, or what is delivered."""
    data = channel.memory.data
    for indices in ((index,), ()):
        if data.is_set(name, *indices):
            return data.number(name, *indices)
    return default


# ---- what belongs to the machine file


def check(channel: SinumerikChannel, found: DataSet) -> None:
    """Machine data that describe another machine than its file are refused: its geometry is that of the file.

    Raises:
        AlarmError: PC0019 for an offset or a sense of rotation beside the chain of joints, and under TRAORI for
            the direction or the number of an axis that is not the chain's.
    """
    data, n = channel.memory.data, order(channel, found)
    for name in SHIFTS.get(found.kind, ()):
        if any(data.is_set(f"{name}_{n}", *at) and data.number(f"{name}_{n}", *at) for at in _PLACES):
            raise _another_machine(f"{name}_{n}")
    sense = f"{SENSES.get(found.kind)}_{n}"
    if any(data.is_set(sense, *at) and not data.number(sense, *at) for at in _PLACES):
        raise _another_machine(sense)
    if found.kind == "TRAORI":
        _check_joints(channel, found)


#: A datum without index, or any of its elements.
_PLACES: tuple[tuple[int, ...], ...] = ((), (0,), (1,), (2,))


def _check_joints(channel: SinumerikChannel, found: DataSet) -> None:
    """Directions and numbers of the axes; the sense of a table's direction is not compared (the manual has none)."""
    data, n = channel.memory.data, order(channel, found)
    kinematics, axes = Kinematics.of(channel.machine), channel_names(channel)
    joints = (*kinematics.tool, *kinematics.work)
    for i in range(3):
        name = f"$MC_TRAFO5_AXIS{i + 1}_{n}"
        direction = vector(channel, name)
        if direction is None or not any(direction):
            continue
        cosine = dot(unit(direction), unit(joints[i].direction)) if i < len(joints) else 0.0
        if (cosine if i < len(kinematics.tool) else abs(cosine)) < 1.0 - _PARALLEL:
            raise _another_machine(name)
    columns = (*native(channel), *(axes.index(axis) for axis in in_order(kinematics) if axis in axes))
    for i, column in enumerate(columns):
        name = f"$MC_TRAFO_AXES_IN_{found.number or n}"
        if data.is_set(name, i) and data.number(name, i) not in (0.0, column + 1.0):
            raise _another_machine(name)


def _another_machine(name: str) -> AlarmError:
    return AlarmError("PC0019", text=name)


# ---- orientation


def orientation(
    channel: SinumerikChannel, found: DataSet, along: Vector | None, added: tuple[float, float]
) -> Build:
    """TRAORI: the tip is programmed, the linear axes follow the rotary ones.

    Args:
        channel: The channel.
        found: The data set.
        along: Basic direction of the tool as the call has it; None for that of the tool ($TC_DPV), else of the
            machine data.
        added: Further offsets of the rotary axes.

    Raises:
        AlarmError: 14401 on a machine without rotary joints or without three linear axes.
    """
    n, geometry = order(channel, found), native(channel)
    kinematics = Kinematics.of(channel.machine)
    axes = channel_names(channel)
    if not kinematics.axes or not set(kinematics.axes) <= set(axes) or -1 in geometry:
        raise AlarmError("14401", text="TRAORI")
    direction = along or vector(channel, f"$MC_TRAFO5_BASE_ORIENT_{n}")
    if direction is not None and any(direction):
        kinematics = replace(kinematics, along=unit(direction))
    zero = [0.0] * len(axes)
    for i, axis in enumerate(in_order(kinematics)):
        offset = number_of(channel, f"$MC_TRAFO5_ROT_AX_OFFSET_{n}", i, 0.0)
        zero[axes.index(axis)] = -(offset + (added[i] if i < len(added) else 0.0))
    inner = ToolCentrePoint(kinematics, axes, geometry, tuple(zero), (0.0, 0.0, 0.0))
    return Build(inner, lengths="tip", order=n, follows_tool=along is None)


def in_order(kinematics: Kinematics) -> tuple[str, ...]:
    """The orientation axes in the order of the transformation: those of the head from the base, then the table's."""
    return tuple(joint.axis for joint in (*kinematics.tool, *kinematics.work))


# ---- turning machines


def polar(channel: SinumerikChannel, found: DataSet, infeed: int = -1) -> Build:
    """TRANSMIT: infeed axis and rotary axis become a plane.

    Args:
        channel: The channel.
        found: The data set.
        infeed: Column that stands for X where TRAANG behind makes it of an oblique axis; else -1.

    Raises:
        AlarmError: 14401 on a machine without rotary axis in the work or without an infeed axis.
    """
    geometry, rotary = _with_infeed(channel, infeed), _work_axis(channel, found)
    second = geometry[1] if geometry[1] >= 0 else rotary
    if geometry[0] < 0:
        raise AlarmError("14401", text="TRANSMIT")
    virtual = second if second != rotary else -1
    n = order(channel, found)
    fixed = SIDES.get(int(number_of(channel, f"$MC_TRANSMIT_POLE_SIDE_FIX_{n}", 0, 0.0)))
    inner = PolarPlane(
        geometry[0], rotary, (geometry[0], second, geometry[2]), side=fixed or 1.0, virtual=virtual
    )  # fmt: skip
    return Build(inner, frozenset((rotary,)), order=n, changes_sides=fixed is None)


def cylinder(
    channel: SinumerikChannel, found: DataSet, diameter: float, *, walls: bool, infeed: int = -1
) -> Build:
    """TRACYL: the rotary axis becomes a length round a cylinder; `walls`: a real Y axis keeps groove walls square.

    `infeed` is the column that stands for X where TRAANG behind makes it of an oblique axis; else -1.

    Raises:
        AlarmError: 14401 on a machine without rotary axis in the work, or without the Y axis for walls.
    """
    geometry, rotary = _with_infeed(channel, infeed), _work_axis(channel, found)
    has_y = geometry[1] >= 0
    made = (geometry[0], geometry[1] if has_y else rotary, geometry[2])
    if walls:
        if not has_y:
            raise AlarmError("14401", text="TRACYL")
        groove = GrooveCylinder(rotary, geometry[1], diameter / 2.0 * RADIAN, made)
        return Build(groove, frozenset((rotary,)), walls=rotary, bound=frozenset((geometry[1],)))
    inner = Cylinder.of_radius(rotary, diameter / 2.0, made, geometry[1] if has_y else -1)
    return Build(inner, frozenset((rotary,)), bound=frozenset((made[1],)))


def walls_of_machine(channel: SinumerikChannel, found: DataSet) -> float:
    """What TRACYL of type 514 takes where its third argument is left out: MD24808 and MD24858, delivered as 0."""
    return number_of(channel, f"$MC_TRACYL_DEFAULT_MODE_{order(channel, found)}", 0, 0.0)


def inclined(channel: SinumerikChannel, angle: float) -> Build:
    """TRAANG: an oblique axis and the one that it leans on become two that are square.

    Raises:
        AlarmError: 14401 on a machine without an oblique axis.
    """
    geometry, column = native(channel), oblique_column(channel)
    if column < 0 or geometry[2] < 0:
        raise AlarmError("14401", text="TRAANG")
    inner = InclinedAxis(column, geometry[2], angle, (column, geometry[1], geometry[2]))
    used = frozenset((column,)) if geometry[0] != column else frozenset()
    return Build(inner, used, "before")


def angle_of_machine(channel: SinumerikChannel, found: DataSet) -> float:
    """The angle that TRAANG takes where none was programmed: MD24700, or that of the oblique axis of the machine."""
    name = f"$MC_TRAANG_ANGLE_{order(channel, found)}"
    joint = _oblique(channel)
    built = 0.0 if joint is None else degrees(atan2(joint[2], joint[0]))
    return number_of(channel, name, 0, built)


def _oblique(channel: SinumerikChannel) -> Vector | None:
    column = oblique_column(channel)
    name = channel.axis_data[column].name if column >= 0 else ""
    return next((joint.direction for joint in channel.machine.joints if joint.axis == name), None)


def oblique_column(channel: SinumerikChannel) -> int:
    """Column of the linear axis that leans from X towards Z, or else of the one that stands for X; -1 for none."""
    names = channel_names(channel)
    for joint in channel.machine.joints:
        if not joint.rotary and joint.axis in names:
            x, _, z = unit(joint.direction)
            if abs(x) > _TURNS and abs(z) > _TURNS:
                return names.index(joint.axis)
    return native(channel)[0]


def _work_axis(channel: SinumerikChannel, found: DataSet) -> int:
    """Column of the rotary axis that carries the work; 14401 for none."""
    names = channel_names(channel)
    for joint in channel.machine.work_chain:
        if joint.rotary and joint.axis in names:
            return names.index(joint.axis)
    raise AlarmError("14401", text=found.kind)


# ---- the channel's own axes


def _with_infeed(channel: SinumerikChannel, infeed: int) -> Geometry:
    """Columns of X, Y and Z without a transformation, X that of the infeed where one is told."""
    x, y, z = native(channel)
    return (x if infeed < 0 else infeed, y, z)


def native(channel: SinumerikChannel) -> Geometry:
    """Columns of X, Y and Z without a transformation."""
    return channel.machine.geometry_indices(channel.number)


def channel_names(channel: SinumerikChannel) -> tuple[str, ...]:
    """Names of the machine's axes behind the columns."""
    return tuple(axis.name for axis in channel.axis_data)
