"""What a program has used: how far its cuts reach, the speeds and feeds of each tool, the work offsets.

Extents are those of the controlled point, arcs included; the tool's radius is not in them. Where a transformation or a
coupling stands between the rows and a display, every row is looked at by itself: what many rows reach there is not the
image of their box.
"""

from __future__ import annotations

from array import array
from itertools import groupby, product
from math import inf

from polycnc.deferred.modules import is_installed
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.compiled import survey
from polycnc.toolpath.kinds import CURVE_WIDTH, RAPID_KINDS, Kind
from polycnc.toolpath.modes import FeedMode
from polycnc.toolpath.survey import CUTS, RAPIDS, STANDS, Boxes, Contexts, Moves, add_box

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from polycnc.toolpath.context import Context
    from polycnc.toolpath.row_path import Path
    from polycnc.toolpath.table import Chunk
    from polycnc.toolpath.trace import Display

    Seen = Callable[[Sequence[float]], Sequence[float]]

_UNITS = {
    FeedMode.PER_MINUTE: "{unit}/min",
    FeedMode.PER_REVOLUTION: "{unit}/rev",
    FeedMode.INVERSE_TIME: "1/min",
}
_STANDING = frozenset((Kind.DWELL, Kind.EVENT))
#: Parts of a row at whose ends it is looked at where displays show something else; steps of the search around one.
LOOKS, NARROWINGS = 32, 40
#: From so many rows on they are looked at by whole columns first, in so many parts; of very many the ends alone.
MANY, PARTS, VERY_MANY = 200, 4, 5000


@dataclass(slots=True)
class Extents:
    """The least and the greatest position by axis or name; `low` above `high` as long as none is known."""

    low: list[float]
    high: list[float]

    @classmethod
    def empty(cls, axes: int) -> Extents:
        """No position yet."""
        return cls([inf] * axes, [-inf] * axes)

    @property
    def known(self) -> bool:
        """Whether there is a position in them."""
        return all(low <= high for low, high in zip(self.low, self.high, strict=True))

    def include(self, low: Sequence[float], high: Sequence[float]) -> None:
        """Reach as far as two corners."""
        self.low[:] = map(min, self.low, low)
        self.high[:] = map(max, self.high, high)


@dataclass(slots=True)
class ToolUsage:
    """What one tool has done.

    Attributes:
        tool: Number or name; 0 for none.
        work: Extents of its cuts on the work display, by the display's names.
        machine: The same on the machine display, mm.
        units: Of the work display while it cut, `mm` or `inch`, in order of use.
        speeds: Programmed spindle speeds (rpm), in order of use.
        surface_speeds: Programmed surface speeds (m/min, feet/min in inches), in order of use.
        feeds: Lowest and highest programmed feed of its cuts by unit (`mm/min`, `inch/rev`), as the display shows them.
    """

    tool: int | str
    work: Extents
    machine: Extents
    units: dict[str, None] = field(default_factory=dict)
    speeds: dict[float, None] = field(default_factory=dict)
    surface_speeds: dict[float, None] = field(default_factory=dict)
    feeds: dict[str, tuple[float, float]] = field(default_factory=dict)


class Views(NamedTuple):
    """How far rows reach on the machine display, and on the work display where that shows something else than rows."""

    machine: Extents
    shown: Extents

    @classmethod
    def empty(cls, axes: int) -> Views:
        """No position yet."""
        return cls(Extents.empty(axes), Extents.empty(axes))


class Box(NamedTuple):
    """The least and the greatest position of each axis, and least and greatest feed."""

    low: Sequence[float]
    high: Sequence[float]
    feeds: Sequence[float]


class Usage:
    """Collects what a program uses while its toolpath grows: `take` fits a session's consumers.

    Args:
        display: Of the toolpath.

    Attributes:
        tools: By tool, in the order of first use; of those that cut.
        machine: Machine extents of every move, rapids too.
        offsets: Names of the work coordinate systems in which axes have moved, in the order of first use.
    """

    def __init__(self, display: Display) -> None:
        self._display = display
        self._axes = len(display.axes)
        self.tools: dict[int | str, ToolUsage] = {}
        self.machine = Extents.empty(self._axes)
        self.offsets: dict[str, None] = {}
        self._survey = survey()
        self._last: tuple[tuple[float, ...], int] | None = None
        self._contexts = Contexts(array("q"), array("q"))
        self._systems: dict[tuple[object, ...], int] = {}
        self._led: set[int] = set()

    def take(self, chunk: Chunk) -> None:
        """Look through a chunk."""
        if not len(chunk):
            return
        self._add_contexts()
        contexts, known = self._display.toolpath.contexts, self._contexts
        moves = Moves(chunk.kind, chunk.context, chunk.feed, chunk.end, chunk.curve, chunk.curves)
        boxes, keys = Boxes(array("d"), array("d"), array("d")), list[tuple[int, int]]()
        row = 0
        while row < len(chunk):
            number, kind = chunk.context[row], _CLASSES[chunk.kind[row]]
            if kind != STANDS and known.box[2 * number + kind] < 0:
                known.box[2 * number + kind] = len(keys)
                keys.append((number, kind))
                add_box(boxes, self._axes)
            before = self._before(chunk, row, contexts[number])
            geometry = self._geometry(contexts[number])
            row = self._survey(moves, row, _CLASSES, geometry, before, known, boxes)
        views = self._views(chunk) if self._led else {}
        for place, (number, kind) in enumerate(keys):
            known.box[2 * number + kind] = -1
            box = _box(boxes, place, self._axes)
            self._count(contexts[number], box, views.get((number, kind)), is_cut=kind == CUTS)
        self._last = tuple(chunk.end[-self._axes :]), chunk.context[-1]

    def _add_contexts(self) -> None:
        """Note the systems of new contexts."""
        contexts, systems = self._display.toolpath.contexts, self._contexts.system
        for number in range(len(systems), len(contexts)):
            context = contexts[number]
            system = context.frame, context.offsets, context.transformation
            systems.append(self._systems.setdefault(system, len(self._systems)))
            self._contexts.box.extend((-1, -1))
            if _is_led(context):
                self._led.add(number)

    def _geometry(self, context: Context) -> array[int]:
        """Columns of X, Y and Z where arcs are."""
        made = context.transformation
        return array("q", self._display.layout.geometry if made is None else made.geometry)

    def _before(self, chunk: Chunk, row: int, context: Context) -> array[float]:
        """The position in front of a row in the system of a context; empty where no row says it."""
        if row:
            before, number = chunk.end[(row - 1) * self._axes : row * self._axes], chunk.context[row - 1]
        elif self._last is not None:
            before, number = array("d", self._last[0]), self._last[1]
        else:
            return array("d")
        toolpath = self._display.toolpath
        seen = toolpath.seen_from(
            list(before), toolpath.contexts[number], context, self._display.layout.geometry
        )
        return array("d", seen)

    def _views(self, chunk: Chunk) -> dict[tuple[int, int], Views]:
        """How far moves reach on the displays where these show something else than the rows."""
        contexts, views = self._display.toolpath.contexts, dict[tuple[int, int], Views]()
        for number, first, end in chunk.context_runs():
            if number not in self._led:
                continue
            for kind, rows in groupby(range(first, end), lambda row: _CLASSES[chunk.kind[row]]):
                if kind != STANDS:
                    found = list(rows)
                    seen = views.setdefault((number, kind), Views.empty(self._axes))
                    self._look(chunk, range(found[0], found[-1] + 1), contexts[number], seen)
        return views

    def _look(self, chunk: Chunk, rows: range, context: Context, views: Views) -> None:
        """See how far moves of one context reach on both displays."""
        toolpath, geometry = self._display.toolpath, self._display.layout.geometry
        made = context.transformation or context.shown_by
        assert made is not None
        n, start = self._axes, list(self._before(chunk, rows.start, context))
        seers = [(views.machine, lambda point: toolpath.to_machine(point, context, geometry))]
        if context.shown_by is not None:
            seers.append((views.shown, context.shown_by.to_work))
        from polycnc.toolpath.row_path import path_of_row  # where the axes follow more than lines

        for row in _far_rows(chunk, rows, start, [seen for _, seen in seers]):
            end = list(chunk.end[row * n : (row + 1) * n])
            if row > rows.start:
                start = list(chunk.end[(row - 1) * n : row * n])
            at = chunk.curve[row] * CURVE_WIDTH
            curve = chunk.curves[at : at + CURVE_WIDTH] if at >= 0 else ()
            path = path_of_row(chunk.kind[row], start or end, end, curve, made.geometry)
            for extents, seen in seers:
                _follow(path, seen, extents)

    def _count(self, context: Context, box: Box, views: Views | None, *, is_cut: bool) -> None:
        """Add what has been done under one context."""
        low, high = box.low, box.high
        if views is None:
            machine = self._machine_box(context, low, high)
        else:
            machine = _scaled(views.machine, self._display.scale(context).machine)
            if context.shown_by is not None:
                low, high = views.shown.low, views.shown.high
        self.machine.include(*machine)
        self.offsets.setdefault(context.wcs)
        if not is_cut:
            return
        name = context.tool_name or context.tool
        tool = self.tools.get(name)
        if tool is None:
            work = Extents.empty(len(self._display.names))
            tool = self.tools[name] = ToolUsage(name, work, Extents.empty(self._axes))
        scale = self._display.scale(context)
        for i, shown in enumerate(context.names or self._display.axes):
            if shown:
                place, factor = self._display.names.index(shown), scale.work[i]
                tool.work.low[place] = min(tool.work.low[place], low[i] * factor)
                tool.work.high[place] = max(tool.work.high[place], high[i] * factor)
        tool.machine.include(*machine)
        tool.units.setdefault(scale.unit)
        if context.spindle_rpm and context.spindle_direction:
            speeds = tool.surface_speeds if context.surface_speed else tool.speeds
            speeds.setdefault(context.spindle_rpm)
        if box.feeds[0] <= box.feeds[1]:
            unit = _UNITS[context.feed_mode].format(unit=scale.unit)
            least, most = tool.feeds.get(unit, (inf, -inf))
            tool.feeds[unit] = min(least, box.feeds[0] * scale.feed), max(most, box.feeds[1] * scale.feed)

    def _machine_box(
        self, context: Context, low: Sequence[float], high: Sequence[float]
    ) -> tuple[list[float], list[float]]:
        """A box on the machine display, around the images of its corners: under a turned frame a little too large."""
        toolpath, geometry = self._display.toolpath, self._display.layout.geometry
        turns = context.transformation is not None or not context.frame.is_identity
        moved = [i for i in range(self._axes) if turns and i in geometry and low[i] != high[i]]
        corners = []
        for sides in product((low, high), repeat=len(moved)):
            corner = list(low)
            for i, side in zip(moved, sides, strict=True):
                corner[i] = side[i]
            corners.append(toolpath.to_machine(corner, context, geometry))
        other_end = toolpath.to_machine(list(high), context, geometry)
        columns = list(zip(*corners, other_end, strict=True))
        reached = Extents([min(column) for column in columns], [max(column) for column in columns])
        return _scaled(reached, self._display.scale(context).machine)


def _scaled(extents: Extents, factors: Sequence[float]) -> tuple[list[float], list[float]]:
    """Two corners as a display shows them."""
    low, high = (
        [value * factor for value, factor in zip(corner, factors, strict=True)]
        for corner in (extents.low, extents.high)
    )
    return low, high


def _box(boxes: Boxes, place: int, axes: int) -> Box:
    """One of many boxes."""
    at = slice(place * axes, (place + 1) * axes)
    return Box(boxes.low[at], boxes.high[at], boxes.feeds[2 * place : 2 * place + 2])


def _is_led(context: Context) -> bool:
    """Whether a display shows something else than the rows, but for a shift and a turn."""
    return context.transformation is not None or context.shown_by is not None


def _far_rows(chunk: Chunk, rows: range, start: Sequence[float], seers: Sequence[Seen]) -> Iterable[int]:
    """Rows of a run among which are those that reach farthest: of many straight ones only these."""
    if len(rows) < MANY or not is_installed("numpy"):
        return rows
    import numpy as np

    n = chunk.axes
    ends = np.frombuffer(chunk.end)[rows.start * n : rows.stop * n].reshape(-1, n)
    starts = np.vstack((start if len(start) else ends[0], ends[:-1]))
    far = {
        rows.start + i for i, row in enumerate(rows) if chunk.curve[row] >= 0 and chunk.kind[row] != Kind.FEED
    }
    for seen in seers:
        parts = PARTS if len(rows) < VERY_MANY else 1
        for k in range(1, parts + 1):
            for column in seen(list((starts + (ends - starts) * (k / parts)).T)):
                far.update((rows.start + int(np.argmin(column)), rows.start + int(np.argmax(column))))
    return sorted(far)


def _follow(path: Path, seen: Seen, extents: Extents) -> None:
    """Widen extents by the points of a path as a display shows them; turning points lie between looks."""
    looks = [seen(path(k / LOOKS)) for k in range(LOOKS + 1)]
    for i, places in enumerate(zip(*looks, strict=True)):
        for sign, known in ((1.0, extents.high), (-1.0, extents.low)):
            heights = [sign * place for place in places]
            top = max(range(LOOKS + 1), key=heights.__getitem__)
            height, beside = heights[top], heights[max(top - 1, 0) : top + 2]
            if 0 < top < LOOKS and 2.0 * height - min(beside) > sign * known[i]:
                height = _turning(_height(path, seen, i, sign), top)
            if height > sign * known[i]:
                known[i] = sign * height


def _height(path: Path, seen: Seen, axis: int, sign: float) -> Callable[[float], float]:
    """How far an axis is up, or down, at a part of a path."""
    return lambda part: sign * seen(path(part))[axis]


def _turning(height: Callable[[float], float], look: int) -> float:
    """The greatest height around a look."""
    low, high = (look - 1) / LOOKS, (look + 1) / LOOKS
    for _ in range(NARROWINGS):
        third = (high - low) / 3.0
        if height(low + third) < height(high - third):
            low += third
        else:
            high -= third
    return max(height(0.5 * (low + high)), height(look / LOOKS))


#: What each kind is, by its number.
_CLASSES = array("B", (STANDS if k in _STANDING else RAPIDS if k in RAPID_KINDS else CUTS for k in Kind))
