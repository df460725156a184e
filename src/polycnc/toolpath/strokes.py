"""The path as points in space: arcs drawn out, cut into strokes of one tool and one kind of motion."""

from __future__ import annotations

from math import atan2, cos, dist, sin, sqrt, tau

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.arcs import parts_for_chord_error
from polycnc.geometry.tolerances import NO_WAY
from polycnc.geometry.vectors import cross, dot, minus
from polycnc.toolpath.kinds import ARC_KINDS, CCW_KINDS, Kind
from polycnc.toolpath.row_path import path_of_row

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from polycnc.geometry.frames import Vector
    from polycnc.toolpath.context import Context
    from polycnc.toolpath.table import Row, Toolpath

_STANDING = frozenset((Kind.DWELL, Kind.EVENT))
_RAPID = frozenset((Kind.RAPID, Kind.REF))
#: Parts of a row of which a display shows something else; what lies nearer to a line than this is one, mm.
LOOKS, EVEN = 64, 1e-3


@dataclass(slots=True)
class Stroke:
    """A run of connected points (system of the work offset, mm, radius) under one tool, in rapid or in feed."""

    tool: str
    rapid: bool
    points: list[Vector] = field(default_factory=list)


def strokes(
    toolpath: Toolpath,
    geometry: tuple[int, int, int],
    chord_error: float = 0.01,
    rows: Iterable[Row] | None = None,
) -> Iterator[Stroke]:
    """The strokes of a toolpath in order.

    Args:
        toolpath: The table.
        geometry: For X, Y, Z the index of the channel axis, or -1 for an axis that does not exist.
        chord_error: How far a chord may lie from its arc, mm.
        rows: Its rows, where somebody counts them.
    """
    stroke: Stroke | None = None
    before: Row | None = None
    for row in toolpath.rows() if rows is None else rows:
        if row.kind not in _STANDING:
            tool, rapid = tool_label(row.context), row.kind in _RAPID
            points = drawn(toolpath, before, row, geometry, chord_error)
            part = row.context.part
            if not part.is_identity:
                points = [part.apply(*point) for point in points]
            if (
                stroke is None
                or stroke.tool != tool
                or stroke.rapid != rapid
                or stroke.points[-1] != points[0]
            ):
                if stroke is not None:
                    yield stroke
                stroke = Stroke(tool, rapid, points[:1])
            stroke.points += points[1:]
        before = row
    if stroke is not None:
        yield stroke


def tool_label(context: Context) -> str:
    """How the tool of a context is called."""
    return context.tool_name or f"T{context.tool}"


def point_of(end: Sequence[float], geometry: tuple[int, int, int]) -> Vector:
    """X, Y and Z of the end of a row; 0 for an axis that does not exist."""
    x, y, z = (end[i] if i >= 0 else 0.0 for i in geometry)
    return (x, y, z)


def drawn(
    toolpath: Toolpath, before: Row | None, row: Row, geometry: tuple[int, int, int], chord_error: float
) -> list[Vector]:
    """The points of a row, its start included, as the work display shows them."""
    if row.context.shown_by is None:
        start = start_of(toolpath, before, row, geometry)
        return [start, *points_behind(row, start, point_of(row.end, geometry), chord_error)]
    begin = list(row.end)
    if before is not None:
        begin = toolpath.seen_from(list(before.end), before.context, row.context, geometry)
    path = path_of_row(row.kind, begin, row.end, row.curve, row.context.shown_by.geometry)
    points = [point_of(shown_at(path(k / LOOKS), row.context), geometry) for k in range(LOOKS + 1)]
    way = minus(points[-1], points[0])
    chord = [[a + k / LOOKS * b for a, b in zip(points[0], way, strict=True)] for k in range(LOOKS + 1)]
    is_straight = max(map(dist, points, chord)) <= min(chord_error, EVEN)
    return [points[0], points[-1]] if is_straight else points


def shown_at(position: Sequence[float], context: Context) -> Sequence[float]:
    """A position of rows as the work display shows it, internal units."""
    return position if context.shown_by is None else context.shown_by.to_work(position)


def start_of(toolpath: Toolpath, before: Row | None, row: Row, geometry: tuple[int, int, int]) -> Vector:
    """Where a row begins, in its own coordinates: new offsets move the display, not the machine."""
    if before is None:
        return point_of(row.end, geometry)
    if before.context is row.context:
        return point_of(before.end, geometry)
    if before.context.shown_by is not None:
        begin = toolpath.seen_from(list(before.end), before.context, row.context, geometry)
        return point_of(shown_at(begin, row.context), geometry)
    if before.context.transformation is not row.context.transformation:
        return point_of(row.end, geometry)  # other axes: where the row begins in its own is not known
    machine = toolpath.to_machine(before.end, before.context, geometry)
    offsets = row.context.offsets or (0.0,) * len(machine)
    inner = point_of([value - offset for value, offset in zip(machine, offsets, strict=True)], geometry)
    return inner if row.context.frame.is_identity else row.context.frame.inverse().apply(*inner)


def points_behind(row: Row, start: Vector, end: Vector, chord_error: float) -> list[Vector]:
    """The points of a row behind its start, in the coordinates of both."""
    if row.kind == Kind.THREAD and any(row.curve[5:8]):
        return arc_points(start, end, row.curve[2:5], row.curve[5:8], 0.0, chord_error)
    if row.kind not in ARC_KINDS or not row.curve:
        return [end]
    sense = 1.0 if row.kind in CCW_KINDS else -1.0
    axis = tuple(sense * component for component in row.curve[3:6])
    return arc_points(start, end, row.curve[0:3], axis, row.curve[6], chord_error)


def arc_points(
    start: Vector,
    end: Vector,
    center: tuple[float, ...],
    normal: tuple[float, ...],
    turns: float,
    error: float,
) -> list[Vector]:
    """Points of an arc, helix or spiral behind its start, the end included.

    The arc turns counter-clockwise about `normal`; radius and height change evenly with the angle.
    """
    n: Vector = (normal[0], normal[1], normal[2])
    a, b = minus(start, center), minus(end, center)
    rise_a, rise_b = dot(a, n), dot(b, n)
    u = minus(a, [rise_a * c for c in n])
    w = minus(b, [rise_b * c for c in n])
    radius_a, radius_b = sqrt(dot(u, u)), sqrt(dot(w, w))
    if radius_a == 0.0:
        return [end]
    is_full = dist(u, w) <= NO_WAY
    u = (u[0] / radius_a, u[1] / radius_a, u[2] / radius_a)
    v = cross(n, u)
    sweep = (tau if is_full else atan2(dot(w, v), dot(w, u)) % tau) + tau * turns
    parts = parts_for_chord_error(max(radius_a, radius_b), sweep, error)
    points: list[Vector] = []
    for k in range(1, parts):
        f = k / parts
        radius, rise = radius_a + f * (radius_b - radius_a), rise_a + f * (rise_b - rise_a)
        c, s = radius * cos(f * sweep), radius * sin(f * sweep)
        x, y, z = (center[i] + c * u[i] + s * v[i] + rise * n[i] for i in range(3))
        points.append((x, y, z))
    return [*points, end]
