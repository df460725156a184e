"""Points of hole patterns in a plane: circle, line, arc, grid.

Angles are degrees, counter-clockwise from the first axis.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import cos_sin_deg

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.geometry.arcs import Point


def circle(center: Point, radius: float, start: float, count: int) -> Iterator[Point]:
    """Points evenly spaced on a whole circle, counter-clockwise; clockwise for a negative count."""
    pitch = 360.0 / abs(count)
    return arc(center, radius, start, pitch if count > 0 else -pitch, abs(count))


def arc(center: Point, radius: float, start: float, pitch: float, count: int) -> Iterator[Point]:
    """Points on a circle, `pitch` degrees apart."""
    return (_away(center, radius, start + k * pitch) for k in range(count))


def line(start: Point, pitch: float, angle: float, count: int) -> Iterator[Point]:
    """Points on a line through `start`."""
    return (_away(start, k * pitch, angle) for k in range(count))


def grid(start: Point, pitches: Point, columns: int, rows: int) -> Iterator[Point]:
    """Points of a grid, row by row along the first axis, to and fro."""
    for column, row in meander_cells(columns, rows):
        yield start[0] + column * pitches[0], start[1] + row * pitches[1]


def meander_cells(columns: int, rows: int) -> Iterator[tuple[int, int]]:
    """Column and row of every point of a grid, row by row, to and fro."""
    return ((i if j % 2 == 0 else columns - 1 - i, j) for j in range(rows) for i in range(columns))


def frame_cells(columns: int, rows: int) -> list[tuple[int, int]]:
    """Column and row of the outer points of a grid, once round from (0, 0)."""
    if columns == 1 or rows == 1:
        return list(meander_cells(columns, rows))
    right, top = columns - 1, rows - 1
    there = [(i, 0) for i in range(right)] + [(right, j) for j in range(top)]
    return there + [(i, top) for i in range(right, 0, -1)] + [(0, j) for j in range(top, 0, -1)]


def _away(point: Point, distance: float, angle: float) -> Point:
    cosine, sine = cos_sin_deg(angle)
    return point[0] + distance * cosine, point[1] + distance * sine
