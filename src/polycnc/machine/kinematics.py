"""Where the tool stands against the work, from the positions of the rotary axes, and the way back.

A machine's joints make two chains, from the base to the tool and from the base to the work
(`machine.model.Joint`). With the rotary axes at zero both are as drawn; what the rotary axes turn is measured
from there. Angles are machine positions in degrees by axis name.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import acos, atan2, degrees, hypot, sqrt
from typing import TYPE_CHECKING

from polycnc.geometry.angles import nearest_turn
from polycnc.geometry.frames import IDENTITY, Frame, cos_sin_deg, translation
from polycnc.geometry.vectors import cross, dot

if TYPE_CHECKING:
    from polycnc.geometry.frames import Vector
    from polycnc.machine.model import Joint, Machine

#: Directions closer than this (sine of the angle) are the same.
_PARALLEL = 1e-9
_ALONG_Z: Vector = (0.0, 0.0, 1.0)
Angles = Mapping[str, float]


def turn_about(axis: Vector, angle_deg: float) -> Frame:
    """Right-handed rotation about a direction of any length through the origin."""
    x, y, z = _unit(axis)
    c, s = cos_sin_deg(angle_deg)
    d = 1.0 - c
    return Frame((
        (c + x * x * d, x * y * d - z * s, x * z * d + y * s),
        (y * x * d + z * s, c + y * y * d, y * z * d - x * s),
        (z * x * d - y * s, z * y * d + x * s, c + z * z * d),
    ))  # fmt: skip


@dataclass(frozen=True)
class Kinematics:
    """The rotary joints of a machine: `tool` from the base to the tool, `work` from the base to the work."""

    tool: tuple[Joint, ...]
    work: tuple[Joint, ...]

    @classmethod
    def of(cls, machine: Machine) -> Kinematics:
        """The rotary joints of a machine."""
        return cls(
            tuple(joint for joint in machine.tool_chain if joint.rotary),
            tuple(joint for joint in machine.work_chain if joint.rotary),
        )

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the rotary axes, in the order in which a tool direction depends on them."""
        return tuple(joint.axis for joint, _ in self._turns)

    def work_turn(self, angles: Angles) -> Frame:
        """How the table moves a point that is fixed on it, machine coordinates."""
        return _chain(self.work, angles) @ _chain(self.work, {}).inverse()

    def head_turn(self, angles: Angles) -> Frame:
        """How the head moves the tool's tip about the point that the linear axes move; turn and shift."""
        return _chain(self.tool, angles)

    def tool_on_machine(self, angles: Angles) -> Vector:
        """Direction from the tip along the tool, machine coordinates."""
        return self.head_turn(angles).direct(*_ALONG_Z)

    def tool_on_work(self, angles: Angles) -> Vector:
        """Direction from the tip along the tool, seen from the work."""
        return self.work_turn(angles).inverse().direct(*self.tool_on_machine(angles))

    def angles_for(self, direction: Vector, near: Angles) -> dict[str, float] | None:
        """Angles of the rotary axes that stand the tool along a direction of the work; None where none do.

        Of two solutions the one with the shorter way from `near`.
        """
        found = self.solutions_for(direction, near)
        return min(found, key=lambda s: sum(abs(s[a] - near.get(a, 0.0)) for a in s), default=None)

    def solutions_for(self, direction: Vector, near: Angles) -> list[dict[str, float]]:
        """All angles of the rotary axes, each on its turn nearest to `near`, that stand the tool along a direction.

        With `d = R(k1, a1) R(k2, a2) ez` the component of `d` along k1 depends on a2 alone; a1 then turns the rest
        about k1. At a pole, where a1 may be anything, it stays.
        """
        wanted = _unit(direction)
        turns = self._turns
        if not turns or len(turns) > 2:
            return []
        if len(turns) == 1:
            turns = ((turns[0][0], turns[0][1]), (turns[0][0], 0.0))
        (outer, outer_sign), (inner, inner_sign) = turns
        k1, k2 = _unit(outer.direction), _unit(inner.direction)
        found: list[dict[str, float]] = []
        for inner_deg in _inner_angles(k1, k2, wanted) if inner_sign else (0.0,):
            middle = turn_about(k2, inner_deg).direct(*_ALONG_Z)
            outer_deg = _angle_about(k1, middle, wanted)
            solution = dict(near)
            if inner_sign:
                solution[inner.axis] = inner_sign * inner_deg
            if outer_deg is not None:
                solution[outer.axis] = outer_sign * outer_deg
            found.append({name: _nearest(solution[name], near.get(name, 0.0)) for name in self.axes})
        return [solution for solution in found if _same(self.tool_on_work(solution), wanted)]

    @property
    def _turns(self) -> tuple[tuple[Joint, float], ...]:
        """Joints whose turns, one after the other, lead from the tool at zero to the tool seen from the work."""
        return (*((joint, -1.0) for joint in reversed(self.work)), *((joint, 1.0) for joint in self.tool))


def _chain(joints: Sequence[Joint], angles: Angles) -> Frame:
    frame = IDENTITY
    for joint in joints:
        turn = turn_about(joint.direction, angles.get(joint.axis, 0.0))
        frame = frame @ translation(*joint.offset) @ turn
    return frame


def _inner_angles(k1: Vector, k2: Vector, wanted: Vector) -> tuple[float, ...]:
    """Angles about k2 for which the turned tool has the same component along k1 as the wanted direction."""
    along = dot(k2, _ALONG_Z)
    across = (-k2[0] * along, -k2[1] * along, 1.0 - k2[2] * along)
    a, b = dot(k1, across), dot(k1, cross(k2, _ALONG_Z))
    size, rest = hypot(a, b), dot(k1, wanted) - dot(k1, k2) * along
    if size < _PARALLEL or abs(rest) > size * (1.0 + _PARALLEL):
        return ()
    middle, half = degrees(atan2(b, a)), degrees(acos(max(-1.0, min(1.0, rest / size))))
    return (middle + half, middle - half)


def _angle_about(axis: Vector, start: Vector, end: Vector) -> float | None:
    """Angle that turns one direction into another about an axis; None where both lie on the axis."""
    along = dot(axis, start)
    a = tuple(s - k * along for s, k in zip(start, axis, strict=True))
    along = dot(axis, end)
    b = tuple(e - k * along for e, k in zip(end, axis, strict=True))
    u, v = (a[0], a[1], a[2]), (b[0], b[1], b[2])
    if min(dot(u, u), dot(v, v)) < _PARALLEL**2:
        return None
    return degrees(atan2(dot(axis, cross(u, v)), dot(u, v)))


def _nearest(angle: float, near: float) -> float:
    """The same angle on the turn nearest to another."""
    return round(nearest_turn(angle, near), 10) + 0.0


def _unit(v: Vector) -> Vector:
    size = sqrt(dot(v, v))
    return (v[0] / size, v[1] / size, v[2] / size)


def _same(a: Vector, b: Vector) -> bool:
    return all(abs(x - y) < 1e-6 for x, y in zip(a, b, strict=True))
