"""Where the tool stands against the work, from the positions of the rotary axes.

A machine's joints make two chains, from the base to the tool and from the base to the work
(`machine.model.Joint`). With the rotary axes at zero both are as drawn; what the rotary axes turn is measured
from there. Angles are machine positions in degrees by axis name. `transformation.orientation` is the way back, from a
direction of the tool to positions of the axes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import atan2, degrees, sqrt

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame, cos_sin_deg, rotation, translation
from polycnc.geometry.vectors import cross, dot

if TYPE_CHECKING:
    from polycnc.geometry.frames import Vector
    from polycnc.machine.model import Joint, Machine

_ALONG_Z: Vector = (0.0, 0.0, 1.0)
_NOWHERE: Vector = (0.0, 0.0, 0.0)
Angles = Mapping[str, float]
HALF_TURN_DEG = 180.0
#: Directions of length 1 are the same where the sine between them is below.
SAME_DIRECTION = 1e-12


def turn_about(axis: Vector, angle_deg: float) -> Frame:
    """Right-handed rotation about a direction of any length through the origin; exact about X, Y and Z (Rodrigues)."""
    x, y, z = direction = unit(axis)
    for i in range(3):
        if abs(direction[i]) == 1.0:
            return rotation(i, angle_deg * direction[i])
    c, s = cos_sin_deg(angle_deg)
    d = 1.0 - c
    return Frame((
        (c + x * x * d, x * y * d - z * s, x * z * d + y * s),
        (y * x * d + z * s, c + y * y * d, y * z * d - x * s),
        (z * x * d - y * s, z * y * d + x * s, c + z * z * d),
    ))  # fmt: skip


def turn_between(start: Vector, end: Vector, aside: Vector) -> Frame:
    """The shortest turn of one direction into another; of opposite ones that about `aside`, square on both."""
    across = cross(start, end)
    size = sqrt(dot(across, across))
    if size > SAME_DIRECTION:
        return turn_about(across, degrees(atan2(size, dot(start, end))))
    return IDENTITY if dot(start, end) > 0.0 else turn_about(aside, HALF_TURN_DEG)


@dataclass(frozen=True)
class Kinematics:
    """The rotary joints of a machine: `tool` from the base to the tool, `work` from the base to the work.

    `along` is the direction from the tip along the tool with all of them at zero, `nose` leads from the last joint of
    the head to where tools are seated, and `to_nose` from the point that the linear axes name to there, mm: machine
    files have these two in one.
    """

    tool: tuple[Joint, ...]
    work: tuple[Joint, ...]
    along: Vector = _ALONG_Z
    nose: Vector = _NOWHERE
    to_nose: Vector = _NOWHERE

    @classmethod
    def of(cls, machine: Machine) -> Kinematics:
        """The rotary joints of a machine."""
        return cls(
            tuple(joint for joint in machine.tool_chain if joint.rotary),
            tuple(joint for joint in machine.work_chain if joint.rotary),
            unit(machine.tool_direction),
            machine.nose,
        )

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the rotary axes, in the order in which a tool direction depends on them."""
        return tuple(joint.axis for joint, _ in self.turns)

    def work_turn(self, angles: Angles) -> Frame:
        """How the table moves a point that is fixed on it, machine coordinates."""
        return _chain(self.work, angles) @ _chain(self.work, {}).inverse()

    def head_turn(self, angles: Angles) -> Frame:
        """How the head moves the tool's tip about the point that the linear axes move; turn and shift."""
        turn = _chain(self.tool, angles)
        return turn if self.nose == _NOWHERE else turn @ translation(*self.nose)

    def head_places(self, angles: Angles) -> list[Frame]:
        """Of each joint of the head where it is and how those before it turn it, seen from the base of the head."""
        return [_chain(self.tool[: n + 1], {**angles, joint.axis: 0.0}) for n, joint in enumerate(self.tool)]

    def tool_on_machine(self, angles: Angles) -> Vector:
        """Direction from the tip along the tool, machine coordinates."""
        return self.head_turn(angles).direct(*self.along)

    def tool_on_work(self, angles: Angles) -> Vector:
        """Direction from the tip along the tool, seen from the work."""
        return self.work_turn(angles).inverse().direct(*self.tool_on_machine(angles))

    @property
    def ordered(self) -> tuple[str, ...]:
        """Names of the rotary axes, first axis first, as controls count them.

        Of two in a head, or in a table, the first one carries the other; of one in each it is that of the head (FANUC
        19680, 19681).
        """
        return tuple(joint.axis for joint in (*self.tool, *self.work))

    @property
    def turns(self) -> tuple[tuple[Joint, float], ...]:
        """Joints whose turns, one after the other, lead from the tool at zero to the tool seen from the work."""
        return (*((joint, -1.0) for joint in reversed(self.work)), *((joint, 1.0) for joint in self.tool))


def _chain(joints: Sequence[Joint], angles: Angles) -> Frame:
    frame = IDENTITY
    for joint in joints:
        turn = turn_about(joint.direction, angles.get(joint.axis, 0.0))
        frame = frame @ translation(*joint.offset) @ turn
    return frame


def unit(v: Vector) -> Vector:
    """The vector of length 1 in a direction."""
    size = sqrt(dot(v, v))
    return (v[0] / size, v[1] / size, v[2] / size)
