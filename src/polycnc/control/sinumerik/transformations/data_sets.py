"""What is configured: the transformations that TRAORI(n), TRANSMIT(n) … choose from.

Machine data name them: `$MC_TRAFO_TYPE_1` and so on give the types, and the n-th of a kind is what `n` means. A
machine whose data say nothing has what its kinematic chain allows, one of each kind. The axes are those of the
machine file; how far they lie apart, and how far the tool lies from them, data may say anew.
"""

from __future__ import annotations

from math import atan2, degrees

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.vectors import dot, times
from polycnc.machine.kinematics import Kinematics, unit
from polycnc.messages import AlarmError
from polycnc.transformation.kinematic.cylinder import Cylinder
from polycnc.transformation.kinematic.groove import GrooveCylinder
from polycnc.transformation.kinematic.inclined import InclinedAxis
from polycnc.transformation.kinematic.polar import PolarPlane
from polycnc.transformation.numbers import RADIAN
from polycnc.transformation.orientation.tool_centre import ToolCentrePoint

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Vector
    from polycnc.machine.model import Joint
    from polycnc.transformation.contract import Geometry, Transformation

#: Kinds, by the procedure that selects them, and the types of each (MD24100 and following).
TYPES: dict[str, range] = {
    "TRAORI": range(16, 160),
    "TRANSMIT": range(256, 258),
    "TRACYL": range(512, 515),
    "TRAANG": range(1024, 1025),
    "TRACON": range(9999, 10000),
}
#: Types of TRAORI that say whether axes turn the head, and whether the table (general knowledge); others say neither.
TURNED: dict[range, tuple[bool, bool]] = {
    range(16, 32): (True, False),
    range(32, 48): (False, True),
    range(48, 64): (True, True),
}
#: Types of TRACYL: groove walls by a linear axis, always or by the third argument.
WITH_WALLS, WALLS_BY_ARGUMENT = 513, 514
#: Sides of the pole of TRANSMIT by MD24911 and MD24951; 0, as delivered, leaves both.
SIDES = {1: 1.0, 2: -1.0}
#: As many transformations as machine data can name.
COUNT = 10
#: Machine data of angles and lengths in a transformation, by its number, that polycnc does not follow.
SHIFTS: dict[str, tuple[str, ...]] = {
    "TRAORI": ("$MC_TRAFO5_NUTATOR_AX_ANGLE_{n}", "$MC_TRAFO5_TOOL_ROT_AX_OFFSET_{n}"),
    "TRANSMIT": ("$MC_TRANSMIT_ROT_AX_OFFSET_{n}",),
    "TRACYL": ("$MC_TRACYL_ROT_AX_OFFSET_{n}",),
}
PART, JOINT, JOINT_OF_PART, BASE_TOOL = (
    "$MC_TRAFO5_PART_OFFSET_{n}",
    "$MC_TRAFO5_JOINT_OFFSET_{n}",
    "$MC_TRAFO5_JOINT_OFFSET_PART_{n}",
    "$MC_TRAFO5_BASE_TOOL_{n}",
)
#: Vectors of TRAORI by how many axes turn the head and the table: of each chain those in front of its joints, and the
#: one behind. They are l1 to l4 of toolholders of types T, P and M (commissioning of CYCLE800), which job planning has.
VECTORS: dict[tuple[int, int], tuple[tuple[str, ...], tuple[str, ...]]] = {
    (2, 0): ((PART, JOINT, BASE_TOOL), ()),
    (0, 2): ((), (BASE_TOOL, JOINT, PART)),
    (1, 1): ((JOINT, BASE_TOOL), (JOINT_OF_PART, PART)),
}
#: Machine data that turn the sense of a rotary axis round where they are 0.
SENSES = {
    "TRAORI": "$MC_TRAFO5_ROT_SIGN_IS_PLUS_{n}",
    "TRANSMIT": "$MC_TRANSMIT_ROT_SIGN_IS_PLUS_{n}",
    "TRACYL": "$MC_TRACYL_ROT_SIGN_IS_PLUS_{n}",
}
_NOWHERE: Vector = (0.0, 0.0, 0.0)
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
        in_front: What vectors of machine data add to positions in front of it, X, Y, Z, mm.
        behind: The same along the machine's axes behind it.
    """

    inner: Transformation
    used: frozenset[int] = frozenset()
    lengths: str = "behind"
    walls: int = -1
    bound: frozenset[int] = frozenset()
    order: int = 1
    follows_tool: bool = False
    changes_sides: bool = False
    in_front: Vector = _NOWHERE
    behind: Vector = _NOWHERE


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
    """Machine data that describe another machine than its file are refused: its axes are those of the file.

    Raises:
        AlarmError: PC0019 for an angle or a sense of rotation beside the chain of joints, and under TRAORI for a type
            that turns something else, the direction or the number of an axis that is not the chain's, and vectors of
            joints that it does not have.
    """
    data, n = channel.memory.data, order(channel, found)
    for name in (each.format(n=n) for each in SHIFTS.get(found.kind, ())):
        if _has_value(channel, name):
            raise another_machine(name)
    sense = SENSES.get(found.kind, "").format(n=n)
    if any(data.is_set(sense, *at) and not data.number(sense, *at) for at in _PLACES):
        raise another_machine(sense)
    if found.kind == "TRAORI":
        _check_type(channel, found)
        _check_joints(channel, found)
        known = {name for chain in _vectors(Kinematics.of(channel.machine)) for name in chain}
        for name in (each.format(n=n) for each in {PART, JOINT, JOINT_OF_PART, BASE_TOOL} - known):
            if _has_value(channel, name):
                raise another_machine(name)


def _has_value(channel: SinumerikChannel, name: str) -> bool:
    data = channel.memory.data
    return any(data.is_set(name, *at) and data.number(name, *at) for at in _PLACES)


#: A datum without index, or any of its elements.
_PLACES: tuple[tuple[int, ...], ...] = ((), (0,), (1,), (2,))


def _check_type(channel: SinumerikChannel, found: DataSet) -> None:
    """What the axes turn: head, table or both."""
    kinematics = Kinematics.of(channel.machine)
    turns = (bool(kinematics.tool), bool(kinematics.work))
    if any(found.type in types and turns != told for types, told in TURNED.items()):
        raise another_machine(f"$MC_TRAFO_TYPE_{found.number}")


def _check_joints(channel: SinumerikChannel, found: DataSet) -> None:
    """Directions and numbers of the axes; the sense of a table's direction is not compared (the manual has none)."""
    data, n = channel.memory.data, order(channel, found)
    kinematics, axes = Kinematics.of(channel.machine), channel_names(channel)
    joints = (*kinematics.tool, *kinematics.work)
    for axis in (1, 2, 3):
        name = f"$MC_TRAFO5_AXIS{axis}_{n}"
        direction = vector(channel, name)
        if direction is None or not any(direction):
            continue
        cosine = dot(unit(direction), unit(joints[axis - 1].direction)) if axis <= len(joints) else 0.0
        if (cosine if axis <= len(kinematics.tool) else abs(cosine)) < 1.0 - _PARALLEL:
            raise another_machine(name)
    columns = (*native(channel), *(axes.index(axis) for axis in in_order(kinematics) if axis in axes))
    number = found.number or n
    for i, column in enumerate(columns):
        name = f"$MC_TRAFO_AXES_IN_{number}"
        if data.is_set(name, i) and data.number(name, i) not in (0.0, column + 1.0):
            raise another_machine(name)


def another_machine(name: str) -> AlarmError:
    """PC0019 for a machine datum."""
    return AlarmError("PC0019", text=name)


# ---- vectors


def placed(channel: SinumerikChannel, kinematics: Kinematics, n: int) -> tuple[Kinematics, Vector]:
    """The joints with the vectors that machine data give, and what those of the table add to positions in front.

    Vectors of the head count as tool lengths do, from the tip to the machine, those of the table the other way round.
    Others are as the machine file has them. That leaves positions alone with all axes at zero; given vectors that do
    not close their chain do not.
    """
    of_head, of_table = (
        [vector(channel, name.format(n=n)) for name in names] for names in _vectors(kinematics)
    )
    noses = [None if given is None else times(given, -1.0) for given in of_head]
    tool = _apart(kinematics.tool, noses[:-1])
    nose = noses[-1] if noses and noses[-1] is not None else kinematics.nose
    work = _apart(kinematics.work, of_table[:-1])
    return replace(kinematics, tool=tool, work=work, nose=nose, to_nose=_sum(noses)), _sum(of_table)


def base_tool(channel: SinumerikChannel, kind: str, n: int) -> Vector:
    """MD24920, MD24820 and MD24710: what a transformation adds to the lengths of every tool, mm."""
    return vector(channel, f"$MC_{kind}_BASE_TOOL_{n}") or _NOWHERE


def _vectors(kinematics: Kinematics) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Names of the vectors of head and table."""
    return VECTORS.get((len(kinematics.tool), len(kinematics.work)), ((), ()))


def _apart(joints: tuple[Joint, ...], given: Sequence[Vector | None]) -> tuple[Joint, ...]:
    """Joints of a chain with other offsets in front of them, where those are given."""
    if not given:
        return joints
    pairs = zip(joints, given, strict=True)
    return tuple(joint if offset is None else replace(joint, offset=offset) for joint, offset in pairs)


def _sum(vectors: Sequence[Vector | None]) -> Vector:
    x, y, z = (sum(parts) for parts in zip(_NOWHERE, *filter(None, vectors), strict=True))
    return (x, y, z)


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
    joints, in_front = placed(channel, kinematics, n)
    zero = [0.0] * len(axes)
    for i, axis in enumerate(in_order(kinematics)):
        offset = number_of(channel, f"$MC_TRAFO5_ROT_AX_OFFSET_{n}", i, 0.0)
        zero[axes.index(axis)] = -(offset + (added[i] if i < len(added) else 0.0))
    inner = ToolCentrePoint(joints, axes, geometry, tuple(zero), (0.0, 0.0, 0.0))
    return Build(inner, lengths="tip", order=n, in_front=in_front, follows_tool=along is None)


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
    base = base_tool(channel, "TRANSMIT", n)
    return Build(inner, frozenset((rotary,)), order=n, changes_sides=fixed is None, behind=base)


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
    base = base_tool(channel, "TRACYL", order(channel, found))
    if walls:
        if not has_y:
            raise AlarmError("14401", text="TRACYL")
        groove = GrooveCylinder(rotary, geometry[1], diameter / 2.0 * RADIAN, made)
        bound = frozenset((geometry[1],))
        return Build(groove, frozenset((rotary,)), walls=rotary, bound=bound, behind=base)
    inner = Cylinder.of_radius(rotary, diameter / 2.0, made, geometry[1] if has_y else -1)
    return Build(inner, frozenset((rotary,)), bound=frozenset((made[1],)), behind=base)


def walls_of_machine(channel: SinumerikChannel, found: DataSet) -> float:
    """What TRACYL of type 514 takes where its third argument is left out: MD24808 and MD24858, delivered as 0."""
    return number_of(channel, f"$MC_TRACYL_DEFAULT_MODE_{order(channel, found)}", 0, 0.0)


def inclined(channel: SinumerikChannel, found: DataSet, angle: float) -> Build:
    """TRAANG: an oblique axis and the one that it leans on become two that are square.

    Raises:
        AlarmError: 14401 on a machine without an oblique axis.
    """
    geometry, column = native(channel), oblique_column(channel)
    if column < 0 or geometry[2] < 0:
        raise AlarmError("14401", text="TRAANG")
    inner = InclinedAxis(column, geometry[2], angle, (column, geometry[1], geometry[2]))
    used = frozenset((column,)) if geometry[0] != column else frozenset()
    return Build(inner, used, "before", in_front=base_tool(channel, "TRAANG", order(channel, found)))


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
