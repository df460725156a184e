"""Tilted planes: how they are told, and what turning rotary axes do to them (G68.2, G68.3, G53.1, G53.6, CYCLE800).

A tilted plane is a frame from the plane to the work. To stand the tool on it the rotary axes turn (`orientation/`).
What the table turns takes the plane with it: it is worked out anew. What the head turns takes the tool's length along.
"""

from __future__ import annotations

from math import hypot

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame, rotation, translation
from polycnc.geometry.vectors import axis_vector, cross, minus
from polycnc.machine.kinematics import turn_about

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from polycnc.geometry.frames import Vector
    from polycnc.machine.kinematics import Angles, Kinematics

#: Vectors that are not longer (mm) have no direction.
SHORTEST_MM = 1e-6
#: A tool that is nearer to Z of the work than this (sine) leaves X of the work as it is.
UPRIGHT = 1e-9


# ---- planes by angles --------------------------------------------------------------------------------------------


def by_euler(precession: float, nutation: float, spin: float) -> Frame:
    """About Z, then about the new X, then about the new Z; degrees."""
    return rotation(2, precession) @ rotation(0, nutation) @ rotation(2, spin)


def by_fixed_axes(order: Iterable[int], angles: Sequence[float]) -> Frame:
    """About the axes of the work, one after the other (roll, pitch, yaw); `angles` about X, Y, Z, degrees."""
    turned = IDENTITY
    for axis in order:
        turned = rotation(axis, angles[axis]) @ turned
    return turned


def by_own_axes(turns: Iterable[tuple[int, float]]) -> Frame:
    """One after the other about axes that turn along: pairs of axis (0 to 2) and degrees."""
    turned = IDENTITY
    for axis, angle in turns:
        turned = turned @ rotation(axis, angle)
    return turned


def by_solid_angle(around: float, down: float) -> Frame:
    """Z leans by the second angle towards the direction in X and Y that the first one says; degrees."""
    return rotation(2, around) @ rotation(1, down)


def by_leaning(axis: int, lean: float, about: float) -> Frame:
    """A tool leans from its axis (0 to 2), from X to Y, Y to Z or Z to X, then turns about it; degrees (RA, RB)."""
    return rotation(axis, about) @ rotation((axis + 2) % 3, lean)


def by_projections(about_y: float, about_x: float, spin: float) -> Frame | None:
    """Through X turned about Y and Y turned about X, X along the first, turned about Z at last; degrees (G68.2 P4).

    None where both lie on a line.
    """
    first, second = rotation(1, about_y).direct(1.0, 0.0, 0.0), rotation(0, about_x).direct(0.0, 1.0, 0.0)
    upright = _unit(cross(first, second))
    return None if upright is None else _of_axes((0.0, 0.0, 0.0), first, upright) @ rotation(2, spin)


def by_rotary_axes(kinematics: Kinematics, angles: Angles) -> Frame:
    """As the rotary axes turn the tool against the work: those of the table turn back, then those of the head."""
    turned = IDENTITY
    for joint, sign in kinematics.turns:
        turned = turned @ turn_about(joint.direction, sign * angles.get(joint.axis, 0.0))
    return turned


# ---- planes by points and directions -----------------------------------------------------------------------------


def by_points(origin: Vector, along: Vector, beside: Vector) -> Frame | None:
    """An origin, a point on X, and one on the side of Y; None where they lie on a line."""
    x = _unit(minus(along, origin))
    z = None if x is None else _unit(cross(x, minus(beside, origin)))
    return None if x is None or z is None else _of_axes(origin, x, z)


def by_directions(origin: Vector, along: Vector, upright: Vector) -> Frame | None:
    """An origin, the direction of X, and about that of Z; None where they are parallel or nothing."""
    x = _unit(along)
    z = None if x is None else _unit(cross(x, cross(upright, x)))
    return None if x is None or z is None else _of_axes(origin, x, z)


def square_on(tool: Vector, upright: int = 2) -> Frame:
    """The plane across a tool (a unit vector): its X axis is square on the tool and on an upright axis, 0 to 2.

    Where both lie along a line X of the plane is the axis that follows the upright one: X follows Z.
    """
    x = _unit(cross(axis_vector(upright), tool), UPRIGHT) or axis_vector((upright + 1) % 3)
    return _of_axes((0.0, 0.0, 0.0), x, tool)


def _of_axes(origin: Vector, x: Vector, z: Vector) -> Frame:
    y = cross(z, x)
    rows = tuple(zip(x, y, z, strict=True))
    return translation(*origin) @ Frame((rows[0], rows[1], rows[2]))


def _unit(vector: Vector, shortest: float = SHORTEST_MM) -> Vector | None:
    size = hypot(*vector)
    return None if size < shortest else (vector[0] / size, vector[1] / size, vector[2] / size)


# ---- what turning axes do ----------------------------------------------------------------------------------------


def table_turn(kinematics: Kinematics, angles: Angles, zero: Sequence[float]) -> Frame:
    """How the table turns what is fixed on it, seen from a work zero that does not turn (machine coordinates, mm)."""
    shift = translation(zero[0], zero[1], zero[2])
    return shift.inverse() @ kinematics.work_turn(angles) @ shift


def tool_carrier(kinematics: Kinematics, angles: Angles) -> Frame:
    """What the head does to lengths of the tool: its turn, and what makes good how far it takes the tool away."""
    head, rest = kinematics.head_turn(angles), kinematics.head_turn({})
    x, y, z = minus(rest.t, head.t)
    return Frame(head.m, (x, y, z))
