"""The stage of 3D radius compensation: the tip moves by the radius across path and tool (manual 2.87).

With the tool along v and the path along t the tool stands to the left by v × t. At a corner both blocks see the
same tool v, so their offset lines, looked at along v, meet at `r (n1 + n2) / (1 + n1 · n2)` from the corner.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import acos, degrees, sqrt
from typing import TYPE_CHECKING

from polycnc.channel.moves.path import Move, PlacedEvent, Rank, Stage
from polycnc.geometry.vectors import cross, dot, times
from polycnc.messages import AlarmError
from polycnc.toolpath.kinds import Kind

if TYPE_CHECKING:
    from polycnc.geometry.frames import Vector
    from polycnc.transformation.orientation import Posture

PARALLEL = 1e-6
#: So many blocks in a row may not be computable once the first one has moved.
MAX_IDLE = 8
INTERSECTION, INTERSECTION_FIRST, ARC_FIRST = 0, 1, 2


@dataclass(frozen=True, slots=True)
class Corners:
    """How outer corners are passed: G10 L450 P, and the corner angles of the work at which the way changes."""

    way: int = INTERSECTION
    least_intersection_deg: float = 0.0
    most_arc_deg: float = 180.0

    def is_arc(self, angle_deg: float) -> bool:
        """Whether a corner of the work with this angle gets an arc."""
        if self.way == INTERSECTION_FIRST:
            return angle_deg < self.least_intersection_deg
        return self.way == ARC_FIRST and angle_deg <= self.most_arc_deg


@dataclass(slots=True)
class _Held:
    """A block whose end waits for the next one: its move, the normal at its end, the tool there, its direction."""

    move: Move
    normal: Vector
    tool: Vector
    tangent: Vector


class SpatialStage(Stage):
    """Offsets straight moves of the tip.

    Args:
        geometry: Columns of X, Y, Z.
        posture: How the tool stands on the work.
        radius: Offset, mm; negative changes sides.
        side: 1 left, -1 right.
        corners: What happens at outer corners.
    """

    rank = Rank.SPATIAL_COMPENSATION

    def __init__(
        self,
        geometry: tuple[int, int, int],
        posture: Posture,
        radius: float,
        side: int,
        corners: Corners,
    ) -> None:
        self.side = side
        self._geometry = geometry
        self._posture = posture
        self._radius = radius
        self._corners = corners
        self._held: _Held | None = None
        self._shift: Vector = (0.0, 0.0, 0.0)
        self._at: list[float] | None = None
        self._idle = 0
        self._queue: list[Move | PlacedEvent] = []

    def move(self, move: Move) -> None:
        """Take the next move."""
        start, end = self._point(move.start), self._point(move.end)
        way = (end[0] - start[0], end[1] - start[1], end[2] - start[2])
        tool = self._posture.tool_at(move.end)
        tangent = _unit(way)
        normal = None if tangent is None else self._normal(tool, tangent)
        if tangent is None or normal is None:
            self._later(move)
            return
        self._idle = 0
        self._join(tangent)
        self._held = _Held(move, normal, tool, tangent)

    def _later(self, item: Move | PlacedEvent) -> None:
        """Pass something on behind the block that waits, or at once where none does."""
        self._queue.append(item)
        if self._held is None:
            self._run_queue()

    def _run_queue(self) -> None:
        queue, self._queue = self._queue, []
        for item in queue:
            if isinstance(item, Move):
                self._emit(item, self._shift)
            else:
                self.after.event(item)

    def _join(self, tangent: Vector) -> None:
        """End the block that waits at its corner with one of this direction."""
        held, self._held = self._held, None
        if held is None:
            return
        first, second = held.normal, self._normal(held.tool, tangent)
        if second is None:
            raise AlarmError("COR-607", line=held.move.line)
        cosine = dot(first, second)
        if cosine < -1.0 + PARALLEL:
            raise AlarmError("COR-607", line=held.move.line)
        radius = self._radius
        outer = dot(second, held.tangent) * radius > PARALLEL
        if outer and self._corners.is_arc(180.0 - degrees(acos(min(1.0, cosine)))):
            self._emit(held.move, times(first, radius))
            self._around(held, times(second, radius))
            self._run_queue()
            return
        factor = radius / (1.0 + cosine)
        x, y, z = (factor * (a + b) for a, b in zip(first, second, strict=True))
        self._emit(held.move, (x, y, z))
        self._run_queue()

    def _around(self, held: _Held, shift: Vector) -> None:
        """An arc about the corner, across the tool."""
        corner = self._point(held.move.end)
        clockwise = self.side * self._radius > 0.0
        self._shift = shift
        end = self._shifted(held.move.end, shift)
        kind = Kind.CW if clockwise else Kind.CCW
        arc = replace(
            held.move, kind=kind, start=self._at or held.move.end, end=end, center=corner, normal=held.tool
        )
        self._at = end
        self.after.move(arc)

    def _emit(self, move: Move, shift: Vector) -> None:
        end = self._shifted(move.end, shift)
        self._shift = shift
        moved = replace(move, start=self._at or move.start, end=end)
        self._at = end
        self.after.move(moved)

    def _normal(self, tool: Vector, tangent: Vector) -> Vector | None:
        left = _unit(cross(tool, tangent))
        return None if left is None else times(left, float(self.side))

    def _point(self, position: list[float]) -> Vector:
        x, y, z = self._geometry
        return position[x], position[y], position[z]

    def _shifted(self, position: list[float], shift: Vector) -> list[float]:
        moved = list(position)
        for axis, value in zip(self._geometry, shift, strict=True):
            moved[axis] += value
        return moved

    def _release(self) -> None:
        """End the block that waits square on itself."""
        held, self._held = self._held, None
        if held is not None:
            self._emit(held.move, times(held.normal, self._radius))
        self._run_queue()

    def change(self, side: int, radius: float) -> None:
        """The other side, or another radius, from the next block on; between the two is no corner."""
        self._release()
        self.side, self._radius = side, radius

    def event(self, event: PlacedEvent) -> None:
        """Take an event; it comes behind the block that waits."""
        self._later(event)

    def block(self) -> None:
        """Count blocks that cannot be computed; a computable one has set the count to zero."""
        self._idle += 1
        if self._at is not None and self._idle > MAX_IDLE:
            raise AlarmError("COR-609")
        self.after.block()

    def flush(self) -> None:
        """Pass on what waits."""
        self._release()
        self.after.flush()


def _unit(v: Vector) -> Vector | None:
    size = sqrt(dot(v, v))
    return None if size < PARALLEL else (v[0] / size, v[1] / size, v[2] / size)
