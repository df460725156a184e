"""Swivel data records: the rotary axes of the machine file, or a toolholder that `$TC_CARR1` to `$TC_CARR40` describe.

A stored record names its channel axes ($TC_CARR21 and 22, or 35 and 36). An axis that the channel does not have is set
by hand: the cycle says where to.
"""

from __future__ import annotations

from math import inf

from polycnc.control.sinumerik.tools.holders.stored import (
    AXIS_NAMES,
    HIGHEST,
    HIRTH_OFFSETS,
    HIRTH_STEPS,
    LOWEST,
    NAME,
    Carrier,
    CarrierData,
)
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.machine.kinematics import Kinematics
from polycnc.machine.model import Joint
from polycnc.messages import AlarmError
from polycnc.transformation.planes import tilted

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.tools.holders.stored import Values
    from polycnc.geometry.frames import Frame
    from polycnc.machine.kinematics import Angles

#: First of the numbers of $TC_CARR that have the retraction positions, and the names of axes for the cycles.
PLACE, USER_NAMES = 38, 35
#: An axis stands on a tooth of its Hirth coupling if it misses it by less.
ON_TOOTH_DEG = 1e-3
#: The record whose limits and positions belong to the machine's own axes.
OWN = 1
#: Vectors in front of the axes of each kinematic type, by their place in l1 to l4.
_IN_FRONT = {"T": (0, 1), "P": (1, 2), "M": (0, 2)}


@dataclass(frozen=True, slots=True)
class Record:
    """A swivel data record.

    Attributes:
        kinematics: The rotary joints; their angles are zero where nothing is turned.
        axes: The rotary axes, the one nearer to the base first.
        columns: Their columns in the channel, -1 for an axis that is set by hand.
        limits_deg: Lowest and highest position of each.
        teeth_deg: Offset and step of the Hirth coupling of each; a step of 0 for none.
        places: Machine positions for retracting, by geometry axis (0 to 2).
        carrier: What is stored, for a record that is not the machine's own.
    """

    kinematics: Kinematics
    axes: tuple[str, ...]
    columns: tuple[int, ...]
    limits_deg: tuple[tuple[float, float], ...]
    teeth_deg: tuple[tuple[float, float], ...]
    places: dict[int, float]
    carrier: Carrier | None = None

    @property
    def tilting(self) -> str:
        """The axis whose sign tells the two solutions apart: the one that does not turn about the tool."""
        joints = {joint.axis: joint for joint in (*self.kinematics.tool, *self.kinematics.work)}
        return min(reversed(self.axes), key=lambda axis: abs(joints[axis].direction[2]) > 0.5)

    def zero(self, axis: str) -> float:
        """Position of an axis at which nothing is turned."""
        return self.carrier.zeros_deg[int(self._number(axis))] if self.carrier is not None else 0.0

    def meets_teeth(self, angles: Angles) -> bool:
        """Whether every axis with a Hirth coupling stands on one of its teeth."""
        return all(
            not step or abs(_signed_rest(angles[axis] + self.zero(axis) - offset, step)) < ON_TOOTH_DEG
            for axis, (offset, step) in zip(self.axes, self.teeth_deg, strict=True)
        )

    def head(self, angles: Angles) -> Frame | None:
        """What the tool's lengths become; None where the head has no axis."""
        if not self.kinematics.tool:
            return None
        if self.carrier is None:
            return tilted.tool_carrier(self.kinematics, angles)
        return self.carrier.tool_turn(self._positions(angles))

    def table(self, angles: Angles) -> Frame:
        """How the table moves the work."""
        if self.carrier is None:
            return self.kinematics.work_turn(angles)
        return self.carrier.table_turn(self._positions(angles))

    def _positions(self, angles: Angles) -> tuple[float, float]:
        assert self.carrier is not None
        found = list(self.carrier.zeros_deg)
        for axis, angle in angles.items():
            found[int(self._number(axis))] += angle
        return (found[0], found[1])

    def _number(self, axis: str) -> int:
        """0 for v1, 1 for v2 of a stored record."""
        assert self.carrier is not None
        present = [i for i, direction in enumerate(self.carrier.axes) if direction is not None]
        return present[self.axes.index(axis)]


def _signed_rest(position: float, step: float) -> float:
    return position - step * round(position / step)


def record_of(channel: SinumerikChannel, name: str) -> Record:
    """The record of a name, stored or the machine's own; empty for the only one.

    Raises:
        AlarmError: 61180 where there is none, 61182 for a name that is not known.
    """
    stored = CarrierData.of(channel)
    number = stored.named(name) if name else None
    if number is not None and _has_axes(stored.carriers[number]):
        return _stored(channel, number)
    own = _of_machine(channel)
    names = {channel.machine.id.upper(), str(stored.carriers.get(OWN, {}).get(NAME, "")).upper()}
    if own is not None and (not name or name.upper() in names):
        return own
    described = [n for n, values in sorted(stored.carriers.items()) if _has_axes(values)]
    if name or not described:
        raise AlarmError("61182", name=name) if own is not None or described else AlarmError("61180")
    return _stored(channel, described[0])


def _has_axes(values: Values) -> bool:
    return any(float(values.get(n, 0.0)) for n in range(7, 13))


def _of_machine(channel: SinumerikChannel) -> Record | None:
    """The two rotary axes of the machine file, with limits and positions of record 1."""
    kinematics = Kinematics.of(channel.machine)
    axes = tuple(joint.axis for joint in (*kinematics.tool, *kinematics.work))
    names = [axis.name for axis in channel.axis_data]
    if len(axes) != 2 or any(axis not in names for axis in axes):
        return None
    values = CarrierData.of(channel).carriers.get(OWN, {})
    pairs = [[float(values.get(n + i, 0.0)) for n in (LOWEST, HIGHEST)] for i in range(2)]
    limits = tuple((low, high) if low or high else (-inf, inf) for low, high in pairs)
    teeth = tuple(_teeth(values, i) for i in range(2))
    columns = tuple(names.index(axis) for axis in axes)
    return Record(kinematics, axes, columns, limits, teeth, _places(values))


def _teeth(values: Values, i: int) -> tuple[float, float]:
    return float(values.get(HIRTH_OFFSETS + i, 0.0)), float(values.get(HIRTH_STEPS + i, 0.0))


def _places(values: Values) -> dict[int, float]:
    return {i: float(values[PLACE + i]) for i in range(3) if PLACE + i in values}


def _stored(channel: SinumerikChannel, number: int) -> Record:
    """A record from its values."""
    values = CarrierData.of(channel).find(number)
    carrier = Carrier.of(values, channel.memory.data, number)
    of_tool, _ = carrier.chains
    joints: dict[bool, list[Joint]] = {True: [], False: []}
    names, columns, limits, teeth = [], [], [], []
    for i, direction in enumerate(carrier.axes):
        if direction is None:
            continue
        name = str(values.get(AXIS_NAMES + i, "") or values.get(USER_NAMES + i, "")).upper()
        column = channel.memory.columns.get(name, -1)
        if column >= 0 and not channel.axis_data[column].rotary:
            column = -1
        names.append(name if column >= 0 else name or f"v{i + 1}")
        columns.append(column)
        limits.append(carrier.limits_deg[i])
        teeth.append(carrier.hirth_deg[i])
        offset = carrier.lengths[_IN_FRONT[carrier.kind][i]]
        tool = i in of_tool
        joints[tool].append(Joint(names[-1], True, "tool" if tool else "work", direction, offset))
    kinematics = Kinematics(tuple(joints[True]), tuple(joints[False]))
    found = tuple(limits), tuple(teeth)
    return Record(kinematics, tuple(names), tuple(columns), *found, _places(values), carrier)
