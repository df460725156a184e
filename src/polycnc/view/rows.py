"""Rows of a toolpath as a line: in the system of the work offset, mm and radius, as `toolpath.strokes` has them.

Plain runs go column by column, for a long program has a million of them; arcs are drawn out row by row.
"""

from __future__ import annotations

from itertools import groupby
from math import cos, isnan, sin, tau

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.events import Circle, Pen
from polycnc.toolpath.kinds import ARC_KINDS, RAPID_KINDS, Kind
from polycnc.toolpath.modes import FeedMode
from polycnc.toolpath.strokes import drawn, start_of, tool_label
from polycnc.view.lines import FEED, GAP, KINDS, RAPID

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.geometry.frames import Vector
    from polycnc.toolpath import Context, Toolpath
    from polycnc.toolpath.table import Chunk, Row
    from polycnc.view.lines import Lines

#: How far a chord may lie from its arc, mm.
CHORD_ERROR = 0.02
_MIN = 60.0
#: Chords of a circle that a program draws, and the axes of the working planes.
CHORDS = 36
_PLANES = {"G17": (0, 1), "G18": (2, 0), "G19": (1, 2)}
#: Kinds whose row is more than a straight way to its end.
_CURVED = frozenset((*ARC_KINDS, Kind.THREAD))
_STANDING = frozenset((Kind.DWELL, Kind.EVENT))
_KIND = [RAPID if kind in RAPID_KINDS else FEED for kind in Kind]


class RowLine:
    """Makes a line of the rows of a toolpath, chunk by chunk.

    Args:
        lines: The line, which grows.
        toolpath: The toolpath.
        geometry: For X, Y, Z the index of the channel axis, or -1 for an axis that does not exist.
    """

    def __init__(self, lines: Lines, toolpath: Toolpath, geometry: tuple[int, int, int]) -> None:
        self.lines = lines
        self._toolpath, self._geometry = toolpath, geometry
        self._before: Row | None = None
        self._pen = ""

    def add(self, chunk: Chunk) -> None:
        """Add the rows of the next chunk, in order."""
        first = 0
        shown = [context.shown_by is not None for context in self._toolpath.contexts]
        kinds = zip(chunk.kind, chunk.context, strict=True)
        curved = [kind in _CURVED or shown[context] for kind, context in kinds]
        for (_, is_curved), run in groupby(zip(chunk.context, curved, strict=True)):
            end = first + sum(1 for _ in run)
            if is_curved:
                for i in range(first, end):
                    if chunk.kind[i] not in _STANDING:
                        self._add_curved(self._toolpath.row_of(chunk, i))
            else:
                self._add_drawn(chunk, first, end)
            first = end

    def _add_drawn(self, chunk: Chunk, first: int, end: int) -> None:
        """Straight rows, among which the program may draw."""
        for i in range(first, end) if any(isinstance(each, Pen | Circle) for each in chunk.events) else ():
            event = chunk.events[chunk.curve[i]] if chunk.kind[i] == Kind.EVENT else None
            if not isinstance(event, Pen | Circle):
                continue
            self._add_straight(chunk, first, i + 1)
            first = i + 1
            if isinstance(event, Pen):
                self._pen = event.colour
            else:
                context = self._toolpath.contexts[chunk.context[i]]
                draw_circle(self.lines, event, context.plane, self._colour(context))
        if first < end:
            self._add_straight(chunk, first, end)

    def _colour(self, context: Context) -> int:
        """The colour of a tool, or of the pen where the program has taken one."""
        return self.lines.colour(self._pen or tool_label(context))

    def _add_straight(self, chunk: Chunk, first: int, end: int) -> None:
        """Rows of one context that lead straight to their ends; those that only stand repeat a point."""
        context, n = self._toolpath.contexts[chunk.context[first]], chunk.axes
        row = self._toolpath.row_of(chunk, first)
        self._begin(row, start_of(self._toolpath, self._before, row, self._geometry))
        columns: list[Sequence[float] | None] = [
            chunk.end[first * n + i : end * n : n] if i >= 0 else None for i in self._geometry
        ]
        if not context.part.is_identity:
            places = zip(*(column or [0.0] * (end - first) for column in columns), strict=True)
            columns = list(zip(*(context.part.apply(*place) for place in places), strict=True))
        tool = KINDS * self._colour(context)
        what = [_KIND[kind] + tool for kind in chunk.kind[first:end]]
        scale = _scale(context)
        self.lines.extend(
            columns, [0.0 if isnan(feed) else feed * scale for feed in chunk.feed[first:end]], what
        )
        self._before = self._toolpath.row_of(chunk, end - 1)

    def _add_curved(self, row: Row) -> None:
        start, *points = drawn(self._toolpath, self._before, row, self._geometry, CHORD_ERROR)
        self._begin(row, start)
        colour, feed = self._colour(row.context), row.feed * _scale(row.context)
        for point in points:
            self.lines.add(
                row.context.part.apply(*point), 0.0 if isnan(feed) else feed, _KIND[row.kind], colour
            )
        self._before = row

    def _begin(self, row: Row, start: Vector) -> None:
        """A gap leads to the start of a row where the line does not end at it."""
        place = row.context.part.apply(*start)
        last = self.lines.last()
        if not last or max(abs(a - b) for a, b in zip(place, last, strict=True)) > CHORD_ERROR:
            self.lines.add(place, 0.0, GAP, self._colour(row.context))


def draw_circle(lines: Lines, circle: Circle, plane: str, colour: int) -> None:
    """Draw a circle about the last point, in a working plane; a filled one has spokes."""
    center = lines.last()
    if not center or not circle.radius:
        return
    across, up = _PLANES[plane]
    for k in range(CHORDS + 1):
        point = list(center)
        point[across] += circle.radius * cos(tau * k / CHORDS)
        point[up] += circle.radius * sin(tau * k / CHORDS)
        lines.add(point, 0.0, FEED if k else GAP, colour)
        if circle.filled:
            lines.add(center, 0.0, FEED, colour)
            lines.add(point, 0.0, FEED, colour)
    lines.add(center, 0.0, GAP, colour)


def _scale(context: Context) -> float:
    """What makes mm/min of the feeds of a context's rows."""
    if context.feed_mode is FeedMode.PER_REVOLUTION and not context.surface_speed:
        return context.spindle_rpm
    return _MIN
