"""Under a transformation the axes that move are not those that the path is laid out in: bounds on the speed along it.

Polar and cylinder interpolation, tool centre point: the planner knows the limits of the columns of the toolpath. What
the real axes add is found at points of each row: with q(s) the real axes over the way s of the row, the speed v must
keep `|q'|·v` within their velocity and `|q''|·v²` within a part of their acceleration, all along the row.
"""

from __future__ import annotations

from itertools import pairwise
from math import atan2, ceil, cos, hypot, inf, pi, sin, sqrt
from typing import TYPE_CHECKING

from polycnc.motion.frames import laid_of, machine_of, real_of, work_of
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.kinds import ARC_KINDS
from polycnc.toolpath.table import CURVE_WIDTH

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.machine import Axis
    from polycnc.toolpath.table import Chunk

#: Parts of a line, and of a full turn, between whose ends the real axes are looked at.
PARTS, PARTS_PER_TURN = 16, 48
#: Part of the acceleration that is for the bend of the real axes' way; the rest is for changes of speed.
BEND = 0.5
CUTS = frozenset({Kind.FEED, Kind.SPLINE, Kind.SKIP, *ARC_KINDS})


class RealAxes:
    """Follows the real axes of a channel through the rows of a toolpath.

    Args:
        axes: The machine's axes behind the columns; None for one that is not there.
        geometry: Columns of X, Y, Z.
        start: Machine position before the first row.
    """

    def __init__(
        self, axes: tuple[Axis | None, ...], geometry: tuple[int, int, int], start: Sequence[float]
    ) -> None:
        self._axes, self._geometry = axes, geometry
        self._laid, self._context = list(start) or [0.0] * len(axes), Context()

    def stand(self, laid: Sequence[float]) -> None:
        """The axes stand elsewhere, without a transformation."""
        self._laid, self._context = list(laid), Context()

    def caps(self, chunk: Chunk, contexts: Sequence[Context]) -> dict[int, float]:
        """Highest speed along the path, mm/s, of the rows of a chunk that run under a transformation."""
        n, caps = len(self._axes), dict[int, float]()
        if not len(chunk):
            return caps
        if any(contexts[number].transformation is not None for number in set(chunk.context)):
            for row in range(len(chunk)):
                context = contexts[chunk.context[row]]
                end = list(chunk.end[row * n : (row + 1) * n])
                if context.transformation is not None and chunk.kind[row] in CUTS:
                    real = real_of(self._laid, self._context, self._geometry)
                    start = work_of(laid_of(real, context, self._geometry), context, self._geometry)
                    cap = self._cap(context, self._points(chunk, row, start, end, context))
                    if cap < inf:
                        caps[row] = cap
                self._laid, self._context = machine_of(end, context, self._geometry), context
        last = len(chunk) - 1
        self._context = contexts[chunk.context[last]]
        end = list(chunk.end[last * n : (last + 1) * n])
        self._laid = machine_of(end, self._context, self._geometry)
        return caps

    def _points(
        self, chunk: Chunk, row: int, start: list[float], end: list[float], context: Context
    ) -> list[list[float]]:
        """Points along a row, in work coordinates."""
        at = chunk.curve[row] * CURVE_WIDTH
        if chunk.kind[row] not in ARC_KINDS or at < 0 or context.transformation is None:
            shares = [k / PARTS for k in range(PARTS + 1)]
            return [[a + (b - a) * f for a, b in zip(start, end, strict=True)] for f in shares]
        ccw = chunk.kind[row] in (Kind.CCW, Kind.HELIX_CCW)
        return _arc_points(
            start, end, chunk.curves[at : at + CURVE_WIDTH], context.transformation.geometry, ccw=ccw
        )

    def _cap(self, context: Context, points: list[list[float]]) -> float:
        """Highest speed along points that lie evenly on the path."""
        assert context.transformation is not None
        step = sqrt(
            sum(
                (b - a) ** 2
                for i, (a, b) in enumerate(zip(points[0], points[1], strict=True))
                if i in context.transformation.geometry or not self._rotary(i)
            )
        )
        if step <= 0.0:
            return inf
        real = [context.transformation.real(point) for point in points]
        cap = inf
        for i, axis in enumerate(self._axes):
            if axis is None:
                continue
            ways = [self._way(i, b[i] - a[i]) / step for a, b in pairwise(real)]
            bends = [(b - a) / step for a, b in pairwise(ways)]
            fastest = max(map(abs, ways))
            sharpest = max(map(abs, bends), default=0.0)
            if fastest > 0.0 and axis.max_feed:
                cap = min(cap, axis.max_feed / fastest)
            if sharpest > 1e-9 and axis.acceleration:
                cap = min(cap, sqrt(BEND * axis.acceleration / sharpest))
        return cap

    def _rotary(self, column: int) -> bool:
        axis = self._axes[column]
        return axis is not None and axis.rotary

    def _way(self, column: int, way: float) -> float:
        """The shorter way round of a rotary axis."""
        return (way + 180.0) % 360.0 - 180.0 if self._rotary(column) else way


def _arc_points(
    start: list[float], end: list[float], curve: Sequence[float], geometry: tuple[int, int, int], *, ccw: bool
) -> list[list[float]]:
    """Points of an arc, evenly by its angle. `curve` is centre, normal, and further turns."""
    place = [start[i] - c if i >= 0 else 0.0 for i, c in zip(geometry, curve[:3], strict=True)]
    goal = [end[i] - c if i >= 0 else 0.0 for i, c in zip(geometry, curve[:3], strict=True)]
    size = hypot(*curve[3:6]) or 1.0
    nx, ny, nz = (value / size for value in curve[3:6])
    x, y, z = place
    along = x * nx + y * ny + z * nz
    out = [x - along * nx, y - along * ny, z - along * nz]
    sense = 1.0 if ccw else -1.0
    forth = [
        sense * (ny * out[2] - nz * out[1]),
        sense * (nz * out[0] - nx * out[2]),
        sense * (nx * out[1] - ny * out[0]),
    ]
    angle = atan2(_dot(goal, forth), _dot(goal, out)) % (2.0 * pi)
    angle = (angle if angle > 1e-9 else 2.0 * pi) + 2.0 * pi * curve[6]
    parts = max(ceil(angle / (2.0 * pi) * PARTS_PER_TURN), 2)
    points = []
    for k in range(parts + 1):
        f = k / parts
        point = [a + (b - a) * f for a, b in zip(start, end, strict=True)]
        c, s = cos(f * angle) - 1.0, sin(f * angle)
        rise = [(b - a) * f for a, b in zip(place, goal, strict=True)]
        lift = _dot(rise, [nx, ny, nz])
        for j, i in enumerate(geometry):
            if i >= 0:
                point[i] = start[i] + c * out[j] + s * forth[j] + lift * (nx, ny, nz)[j]
        points.append(point)
    return points


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))
