"""Arcs in space compensation: looked at along the tool they are arcs of a plane, whose parallels meet as there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.geometry import offset
from polycnc.geometry.vectors import cross, dot, minus
from polycnc.machine.kinematics import unit
from polycnc.toolpath.kinds import CCW_KINDS

if TYPE_CHECKING:
    from polycnc.channel.moves.path import Move
    from polycnc.geometry.frames import Vector
    from polycnc.geometry.offset import Edge

#: Directions that differ by less are the same.
PARALLEL = 1e-6


def is_across(move: Move, tool: Vector) -> bool:
    """Whether the plane of an arc is square on the tool."""
    return abs(dot(move.normal, tool)) > 1.0 - PARALLEL


def turns_left(move: Move, tool: Vector) -> bool:
    """Whether an arc turns to the left, seen from the tool's holder."""
    return (move.kind in CCW_KINDS) is (dot(move.normal, tool) > 0.0)


def meeting(
    first: Move, second: Move, tool: Vector, distance: float, geometry: tuple[int, int, int]
) -> Vector | None:
    """From a corner to where the parallels of its two moves meet; None where they do not.

    Args:
        first: The move that ends at the corner, a line or an arc across the tool.
        second: The one that begins there.
        tool: Direction along the tool.
        distance: Of the parallels, left positive, mm.
        geometry: Columns of X, Y, Z.
    """
    corner = _point(first.end, geometry)
    u = unit(cross(tool, (1.0, 0.0, 0.0) if abs(tool[0]) < 0.9 else (0.0, 1.0, 0.0)))
    v = cross(tool, u)

    def drawn(at: Vector) -> tuple[float, float]:
        away = minus(at, corner)
        return dot(away, u), dot(away, v)

    def edge(move: Move, start: tuple[float, float], end: tuple[float, float]) -> Edge:
        if move.center is None:
            return offset.line(start, end)
        return offset.arc(start, end, drawn(move.center), turns_left(move, tool))

    here = (0.0, 0.0)
    a = edge(first, drawn(_point(first.start, geometry)), here)
    b = edge(second, here, drawn(_point(second.end, geometry)))
    point = offset.meet(a, b, distance, distance)
    if point is None:
        return None
    x, y, z = (point[0] * a + point[1] * b for a, b in zip(u, v, strict=True))
    return (x, y, z)


def _point(position: list[float], geometry: tuple[int, int, int]) -> Vector:
    x, y, z = (position[column] for column in geometry)
    return (x, y, z)
