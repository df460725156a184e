"""Where parallels meet in space compensation: looked at along the tool, lines and arcs are those of a plane."""

from __future__ import annotations

from math import sin

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
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
    first: Move, second: Move, tool: Vector, distances: tuple[float, float], geometry: tuple[int, int, int]
) -> Vector | None:
    """From a corner to where the parallels of its two moves meet; None where they do not.

    Args:
        first: The move that ends at the corner, a line or an arc across the tool.
        second: The one that begins there.
        tool: Direction along the tool.
        distances: Of the parallels, left positive, mm.
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
    point = offset.meet(a, b, *distances)
    if point is None:
        return None
    x, y, z = (point[0] * a + point[1] * b for a, b in zip(u, v, strict=True))
    return (x, y, z)


def crossing(one: Vector, two: Vector) -> Vector | None:
    """From a corner to where two straight parallels cross, each through the tip of its vector and square on that."""
    a, b, c = dot(one, one), dot(two, two), dot(one, two)
    span = a * b - c * c
    if span <= PARALLEL * a * b:
        return None
    p, q = b * (a - c) / span, a * (b - c) / span
    x, y, z = (p * u + q * v for u, v in zip(one, two, strict=True))
    return (x, y, z)


class Rest(NamedTuple):
    """What a vector has beside what stands square on path and tool: parts along the path, down the tool, and others.

    The first two keep the tool as far beside the path, however it turns.
    """

    path: float
    tool: float
    beside: Vector

    @classmethod
    def of(cls, rest: Vector, tangent: Vector, tool: Vector) -> Rest:
        """The parts of a vector; path and tool must not be parallel."""
        cosine, along, down = dot(tangent, tool), dot(rest, tangent), dot(rest, tool)
        span = 1.0 - cosine * cosine
        p, q = (along - cosine * down) / span, (down - cosine * along) / span
        x, y, z = (a - p * b - q * c for a, b, c in zip(rest, tangent, tool, strict=True))
        return cls(p, q, (x, y, z))

    def fading(self, other: Rest, share: float) -> Rest:
        """On the way from this one to another."""
        x, y, z = (a + share * (b - a) for a, b in zip(self.beside, other.beside, strict=True))
        path, tool = (
            self.path + share * (other.path - self.path),
            self.tool + share * (other.tool - self.tool),
        )
        return Rest(path, tool, (x, y, z))

    def at(self, tangent: Vector, tool: Vector) -> Vector:
        """The vector with the tool where it stands now."""
        x, y, z = (
            a + self.path * b + self.tool * c for a, b, c in zip(self.beside, tangent, tool, strict=True)
        )
        return (x, y, z)


def between(a: Vector, b: Vector, sweep: float, share: float) -> Vector:
    """A direction at a share of the way between two on their great circle, which are `sweep` apart, radians."""
    if sweep < PARALLEL:
        return b
    p, q = sin((1.0 - share) * sweep) / sin(sweep), sin(share * sweep) / sin(sweep)
    x, y, z = (p * s + q * t for s, t in zip(a, b, strict=True))
    return (x, y, z)


def _point(position: list[float], geometry: tuple[int, int, int]) -> Vector:
    x, y, z = (position[column] for column in geometry)
    return (x, y, z)
