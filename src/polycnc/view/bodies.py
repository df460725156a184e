"""The axes of a machine as bodies that a picture shows, and where they stand.

Solids of a machine file are shown as they are. Slides and discs are schematic: a slide is a rail as long as the travel
of its axis with a carriage on it; it is carried by the slides in front of it. The work stands still in the picture and
the machine moves about it, for the path is drawn on the work.
"""

from __future__ import annotations

from math import isfinite

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.vectors import minus, plus
from polycnc.machine.kinematics import Kinematics

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from polycnc.geometry.frames import Vector
    from polycnc.machine.model import Machine

#: Travel of an axis that has no limits, and half the width of a rail, mm.
ENDLESS, HALF = 400.0, 12.0
#: How far the slides stand away from the tool, mm: behind it and above it.
AWAY = 60.0
_ALONG_Z = (0.0, 0.0, 1.0)
#: Which slide carries which: of a machine whose spindle carries the tool, and of one whose spindle carries the work.
_MILL, _LATHE = (1, 0, 2), (2, 0, 1)


@dataclass(frozen=True, slots=True)
class Body:
    """A box, or a cylinder along a direction.

    Attributes:
        shape: `box` or `cylinder`.
        size: Of a box along X, Y, Z; of a cylinder diameter, length and 0.
        at: Its middle with all axes at zero, machine coordinates, mm.
        moves: With which of X, Y and Z it moves, as factors.
        role: What it is: `rail`, `carriage`, `disc`, or the role of a solid.
        direction: Axis of a cylinder.
        turns: The rotary axis that turns it about its direction; empty for none.
        axis: The axis that it shows.
    """

    shape: str
    size: Vector
    at: Vector
    moves: Vector
    role: str
    direction: Vector = (0.0, 0.0, 1.0)
    turns: str = ""
    axis: str = ""


@dataclass(frozen=True, slots=True)
class Pose:
    """Where everything stands.

    Attributes:
        point: The tool's point on the work, in the system of the path, mm.
        machine: X, Y and Z of the machine, mm.
        nose: Where the head holds the tool, machine coordinates, mm: there the picture has the tool's point.
        along: Direction from the tip along the tool, seen from the work.
        angles: Rotary axes in degrees.
        head: Where the discs of the head are and what they turn about, machine coordinates, by their axes.
    """

    point: Vector
    machine: Vector
    nose: Vector
    along: Vector
    angles: Mapping[str, float]
    head: Mapping[str, tuple[Vector, Vector]]


class MachineBodies:
    """The bodies of a channel of a machine.

    Args:
        machine: The machine.
        channel: Number of the channel.

    Attributes:
        bodies: All of them.
        is_lathe: The spindle carries the work.
    """

    def __init__(self, machine: Machine, channel: int = 1) -> None:
        self.is_lathe = any(spindle.carries == "work" for spindle in machine.spindles[:1])
        self._geometry = machine.geometry_indices(channel)
        self._kinematics = Kinematics.of(machine)
        self._axes = tuple(machine.axis[name] for name in machine.channel(channel).axes)
        self.bodies = (*self._slides(), *self._discs(), *self._solids(machine))

    def _slides(self) -> list[Body]:
        chain = [i for i in (_LATHE if self.is_lathe else _MILL) if self._geometry[i] >= 0]
        made: list[Body] = []
        for place, i in enumerate(chain):
            axis = self._axes[self._geometry[i]]
            low = axis.limit_minus if isfinite(axis.limit_minus) else -ENDLESS / 2
            high = axis.limit_plus if isfinite(axis.limit_plus) else low + ENDLESS
            at, moves = [0.0, AWAY, AWAY], [float(j in chain[:place]) for j in range(3)]
            at[i] = (low + high) / 2
            size = [2 * HALF] * 3
            size[i] = high - low + 2 * HALF
            made.append(Body("box", _vector(size), _vector(at), _vector(moves), "rail", axis=axis.name))
            at[i], moves[i], size[i] = 0.0, 1.0, 4 * HALF
            size = [max(edge, 3 * HALF) for edge in size]
            made.append(Body("box", _vector(size), _vector(at), _vector(moves), "carriage", axis=axis.name))
        return made

    def _discs(self) -> list[Body]:
        made = []
        for joints, moves in ((self._kinematics.work, 0.0), (self._kinematics.tool, 1.0)):
            at = [0.0, 0.0, 0.0]
            for joint in joints:
                at = [a + b for a, b in zip(at, joint.offset, strict=True)]
                made.append(
                    Body("cylinder", (8 * HALF, HALF, 0.0), _vector(at), (moves,) * 3, "disc", joint.direction,
                         joint.axis, joint.axis)
                )  # fmt: skip
        return made

    def _solids(self, machine: Machine) -> list[Body]:
        made = []
        for solid in machine.solids:
            half = [edge / 2 for edge in solid.size]
            if solid.shape == "cylinder":
                half = [solid.size[1] / 2 * part for part in solid.direction]
            middle = [a + b for a, b in zip(solid.position, half, strict=True)]
            moves = (1.0, 1.0, 1.0) if solid.moves_with == "tool" else (0.0, 0.0, 0.0)
            names = [self._axes[i].name if i >= 0 else "" for i in self._geometry]
            if solid.moves_with in names:
                moves = _vector([float(name == solid.moves_with) for name in names])
            made.append(Body(solid.shape, solid.size, _vector(middle), moves, solid.role, solid.direction))
        return made

    def pose(self, point: Vector, position: Sequence[float], mechanism: Kinematics | None = None) -> Pose:
        """Where everything stands.

        Args:
            point: Where the tool is on the work, mm.
            position: Machine position of the axes of the channel.
            mechanism: The rotary joints as the control has them; None for those of the machine file.
        """
        kinematics = mechanism or self._kinematics
        angles = {axis.name: position[i] for i, axis in enumerate(self._axes) if axis.rotary}
        along = self._turning_tool(kinematics, angles) if self.is_lathe else kinematics.tool_on_work(angles)
        x, y, z = (position[i] if i >= 0 else 0.0 for i in self._geometry)
        base = minus(plus((x, y, z), kinematics.to_nose), kinematics.head_turn({}).t)
        nose = plus(base, kinematics.head_turn(angles).t)
        head = {
            joint.axis: (plus(base, frame.t), frame.direct(*joint.direction))
            for joint, frame in zip(kinematics.tool, kinematics.head_places(angles), strict=True)
        }
        return Pose(point, (x, y, z), nose, along, angles, head)

    def _turning_tool(self, kinematics: Kinematics, angles: Mapping[str, float]) -> Vector:
        """On a lathe: along X, as turning tools stand, where neither the machine file nor a head says another thing.

        The work turns under it, and stands still in the picture.
        """
        told = kinematics.tool or self._kinematics.along != _ALONG_Z
        return kinematics.tool_on_machine(angles) if told else (1.0, 0.0, 0.0)


def _vector(values: Sequence[float]) -> Vector:
    x, y, z = values
    return (x, y, z)
