"""Where the axes are: along a row, a line or an arc, by the share of its way; along a piece of a curve."""

from __future__ import annotations

from math import cos, hypot, sin

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.kernels.arcs import SAME_RADIUS
from polycnc.motion.kernels.columns import PLACES, Form, Limits, PieceRecord, State
from polycnc.motion.pole import RING_MM

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.motion.pole import Turn


@dataclass(frozen=True, slots=True)
class Line:
    """All axes move in proportion. Positions are machine coordinates of all channel axes (mm, degrees)."""

    start: tuple[float, ...]
    end: tuple[float, ...]

    def at(self, share: float) -> list[float]:
        """The position after a share of the way, 0 to 1."""
        if share >= 1.0:
            return list(self.end)
        return [a + (b - a) * share for a, b in zip(self.start, self.end, strict=True)]


@dataclass(frozen=True, slots=True)
class Arc:
    """An arc, helix or spiral: radius, height and the axes beside the geometry change evenly with the angle.

    Attributes:
        start: Position of all axes.
        end: Position of all axes.
        geometry: Index of X, Y, Z among the axes, -1 for none.
        outward: Unit vector from the centre to the start, in X, Y, Z.
        forth: Unit vector along the way there.
        normal: Unit vector of the axis.
        sweep: Angle of the whole way, radians.
        radius: At the start, mm.
        growth: Of the radius over the whole way, mm.
        rise: Along the axis over the whole way, mm.
    """

    start: tuple[float, ...]
    end: tuple[float, ...]
    geometry: tuple[int, int, int]
    outward: tuple[float, ...]
    forth: tuple[float, ...]
    normal: tuple[float, ...]
    sweep: float
    radius: float
    growth: float
    rise: float

    def at(self, share: float) -> list[float]:
        """The position after a share of the angle, 0 to 1."""
        if share >= 1.0:
            return list(self.end)
        point = [a + (b - a) * share for a, b in zip(self.start, self.end, strict=True)]
        angle, radius = self.sweep * share, self.radius + self.growth * share
        c, s = radius * cos(angle) - self.radius, radius * sin(angle)
        for j, i in enumerate(self.geometry):
            if i >= 0:
                turned = c * self.outward[j] + s * self.forth[j] + self.rise * share * self.normal[j]
                point[i] = self.start[i] + turned
        return point


Segment = Line | Arc


def is_spiral(way: Segment) -> bool:
    """Whether the angle of a way does not grow as its length does, by what the planner takes for a spiral."""
    return isinstance(way, Arc) and abs(way.growth) > SAME_RADIUS * way.radius


@dataclass(frozen=True, slots=True)
class Cubic:
    """A piece of a spline, or of a corner that is rounded: the cubic of the samples (`motion/sampling/run.py`).

    Attributes:
        start: Position of all axes.
        end: Position of all axes.
        leave: What the tangent at its start, over the whole piece, leads past its end; `arrive` that at its end.
    """

    start: tuple[float, ...]
    end: tuple[float, ...]
    leave: tuple[float, ...]
    arrive: tuple[float, ...]

    def at(self, share: float) -> list[float]:
        """The position after a share of the piece, 0 to 1."""
        if share >= 1.0:
            return list(self.end)
        left = 1.0 - share
        return [
            a + share * (b - a + left * (left * leave - share * arrive))
            for a, b, leave, arrive in zip(self.start, self.end, self.leave, self.arrive, strict=True)
        ]


def piece_cubic(record: Sequence[float], axes: int) -> Cubic | None:
    """The curve of a piece from the planner's record; None for one that is straight."""
    if record[PieceRecord.FORM] in (Form.STRAIGHT, Form.LED):
        return None
    first = PieceRecord.VECTORS
    leave, arrive = record[first : first + axes], record[first + axes : first + 2 * axes]
    first += PLACES * axes
    start, end = record[first : first + axes], record[first + axes : first + 2 * axes]
    scale = record[PieceRecord.LENGTH] / record[PieceRecord.MARGIN]
    return Cubic(
        tuple(start),
        tuple(end),
        tuple(q * scale - (b - a) for q, a, b in zip(leave, start, end, strict=True)),
        tuple(q * scale - (b - a) for q, a, b in zip(arrive, start, end, strict=True)),
    )


def row_line(start: Sequence[float], state: State) -> Line:
    """The line of the row that the planner's kernel has just laid out."""
    return Line(tuple(start), tuple(state.position))


def row_arc(start: Sequence[float], state: State, limits: Limits) -> Arc:
    """The arc of the row that the planner's kernel has just laid out."""
    x, y, z = limits.geometry
    outward, forth, normal = (tuple(state.basis[3 * k : 3 * k + 3]) for k in range(3))
    return Arc(
        tuple(start),
        tuple(state.position),
        (x, y, z),
        outward,
        forth,
        normal,
        state.arc.sweep,
        state.arc.radius,
        state.arc.growth,
        state.arc.rise,
    )


def turn_arc(turn: Turn, records: Sequence[float], axes: int) -> Arc:
    """The way of a turn at the pole along its ring; `records` are the planner's pieces of it."""
    first, last = PieceRecord.VECTORS + PLACES * axes, len(records) - axes
    forth, inward = (
        records[PieceRecord.VECTORS + k * axes : PieceRecord.VECTORS + (k + 1) * axes] for k in (0, 2)
    )
    i, j = turn.pole.columns
    return Arc(
        tuple(records[first : first + axes]),
        tuple(records[last : last + axes]),
        (i, j, -1),
        tuple(-inward[k] / hypot(inward[i], inward[j]) for k in (i, j)),
        tuple(forth[k] / hypot(forth[i], forth[j]) for k in (i, j)),
        (0.0, 0.0, 0.0),
        abs(turn.way),
        RING_MM,
        0.0,
        0.0,
    )
