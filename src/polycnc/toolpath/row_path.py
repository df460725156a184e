"""The path of a row by shares of its way, 0 to 1: lines and arcs, in work coordinates."""

from __future__ import annotations

from math import atan2, cos, hypot, pi, sin

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.kinds import ARC_KINDS, CCW_KINDS, Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    Path = Callable[[float], list[float]]

#: An arc by less than this (radians) is a full circle.
NO_ANGLE = 1e-9


class ArcPath(NamedTuple):
    """The path of an arc.

    Attributes:
        at: The point at a share of the angle.
        planar: Length in its plane, mm.
        lift: Along its normal, mm.
        radius: At the start, mm.
        normal: Unit vector of its axis.
        angle: Of the whole way, radians.
        angle_of: Angle from the start at which the arc comes nearest to a point, 0 to 2π.
    """

    at: Path
    planar: float
    lift: float
    radius: float
    normal: tuple[float, float, float]
    angle: float
    angle_of: Callable[[Sequence[float]], float]

    @property
    def length(self) -> float:
        """Of the way, mm."""
        return hypot(self.planar, self.lift)


def path_of_row(
    kind: int,
    start: Sequence[float],
    end: Sequence[float],
    curve: Sequence[float],
    geometry: tuple[int, int, int],
) -> Path:
    """The points of any row: a circular thread is an arc too, what has no curve a line."""
    if kind in ARC_KINDS and curve:
        return arc_path(start, end, curve, geometry, ccw=kind in CCW_KINDS).at
    if kind == Kind.THREAD and any(curve[5:8]):
        return arc_path(start, end, (*curve[2:8], 0.0, 0.0), geometry, ccw=True).at
    return line_path(start, end)


def line_path(start: Sequence[float], end: Sequence[float]) -> Path:
    """The points of a line."""
    return lambda f: [a + (b - a) * f for a, b in zip(start, end, strict=True)]


def arc_path(
    start: Sequence[float],
    end: Sequence[float],
    curve: Sequence[float],
    geometry: tuple[int, int, int],
    *,
    ccw: bool,
) -> ArcPath:
    """An arc, helix or spiral. `curve` is centre, normal, and further turns; `geometry` the columns of X, Y, Z."""
    place = _from_center(start, curve, geometry)
    goal = _from_center(end, curve, geometry)
    size = hypot(*curve[3:6]) or 1.0
    nx, ny, nz = normal = tuple(value / size for value in curve[3:6])
    along = _dot(place, normal)
    out = [p - along * n for p, n in zip(place, normal, strict=True)]
    sense = 1.0 if ccw else -1.0
    forth = [
        sense * (ny * out[2] - nz * out[1]),
        sense * (nz * out[0] - nx * out[2]),
        sense * (nx * out[1] - ny * out[0]),
    ]

    def angle_of(point: Sequence[float]) -> float:
        to = _from_center(point, curve, geometry)
        return atan2(_dot(to, forth), _dot(to, out)) % (2.0 * pi)

    first = angle_of(end)
    angle = (first if first > NO_ANGLE else 2.0 * pi) + 2.0 * pi * curve[6]
    lift = _dot(goal, normal) - along
    radius = hypot(*out)
    end_radius = hypot(_dot(goal, out), _dot(goal, forth)) / radius if radius > 0.0 else 0.0
    growth = end_radius / radius - 1.0 if radius > 0.0 else 0.0

    def at(f: float) -> list[float]:
        point = [a + (b - a) * f for a, b in zip(start, end, strict=True)]
        scale = 1.0 + growth * f
        c, s = scale * cos(f * angle) - 1.0, scale * sin(f * angle)
        for j, i in enumerate(geometry):
            if i >= 0:
                point[i] = start[i] + c * out[j] + s * forth[j] + f * lift * normal[j]
        return point

    return ArcPath(at, angle * 0.5 * (radius + end_radius), lift, radius, (nx, ny, nz), angle, angle_of)


def _from_center(
    point: Sequence[float], curve: Sequence[float], geometry: tuple[int, int, int]
) -> list[float]:
    return [point[i] - c if i >= 0 else 0.0 for i, c in zip(geometry, curve[:3], strict=True)]


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))
