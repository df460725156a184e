"""All columns of a chunk as numbers: texts by their numbers in a list, NaN where a row has no value."""

from __future__ import annotations

from array import array
from math import nan

from polycnc.deferred.modules import is_installed
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.columns.compiled import LIBRARY, show
from polycnc.toolpath.columns.names import NUMBERS, POSITIONS, TEXTS, flattened, positions_of
from polycnc.toolpath.columns.shown import FEED, PLACES, PROGRAM, TOOL, TURNS, TYPE, UNIT, Rows, View
from polycnc.toolpath.kinds import ARC_KINDS, SHOWN_IN_COLUMNS, TYPE_NAMES, Kind
from polycnc.toolpath.trace import COLUMN_ROWS, UNITS

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from polycnc.toolpath.context import Context
    from polycnc.toolpath.table import Chunk
    from polycnc.toolpath.trace import Display, Record, Shown

#: Columns in front of the positions.
_HEAD = {"type": TYPE, "program": PROGRAM, "unit": UNIT, "tool": TOOL, "feed": FEED, "turns": TURNS}
#: Views that are kept; the main run comes to new contexts without end.
_MOST_VIEWS = 1000


class Numbers:
    """The columns of a chunk, of the one that was taken last. Every column has its place; not every one is filled.

    Args:
        display: Of the toolpath that the chunks belong to.

    Attributes:
        table: Columns one behind the other, each as long as the chunk.
    """

    def __init__(self, display: Display) -> None:
        self._display = display
        axes = [axis.lower() for axis in display.axes]
        positions = [prefix + axis for _, prefix in POSITIONS for axis in axes]
        named = [name for key, _ in POSITIONS for name in positions_of(key, display) if name not in positions]
        rare = [name for name in (*NUMBERS, *TEXTS) if name not in _HEAD]
        self._columns = _HEAD | {name: PLACES + i for i, name in enumerate((*positions, *named, *rare))}
        self._places = len(self._columns) - len(rare)
        self._of_arcs = {"turns", *positions[2 * len(axes) :]}
        #: What every row has, of its own.
        self._common = {*_HEAD, *positions} - self._of_arcs
        self._filled = self._common.copy()
        self._height = 0
        self.table = array("d")
        self._others = array("q")
        self._texts: dict[str, dict[str, int]] = {}
        self._tools: dict[str, int] = {}
        #: By the identity of a context, which is kept as long as the entry.
        self._views: dict[int, tuple[Context, View]] = {}

    def take(self, chunk: Chunk) -> None:
        """Fill the columns with the rows of a chunk, which has one at least."""
        kinds = chunk.kind.tobytes()
        arcs = any(kind in kinds for kind in ARC_KINDS)
        self._height, self._filled = len(chunk), self._common | (self._of_arcs if arcs else set())
        types = {name: number for number, name in enumerate(TYPE_NAMES)}
        self._texts = {"type": types, "tool": self._tools, "code": {}, "text": {}}
        self._make_room(self._places)
        fill = self._by_numpy if self._is_for_numpy(chunk) else self._by_kernel
        for i in fill(chunk, arcs=arcs):
            row = self._display.toolpath.row_of(chunk, i)
            self._add(i, self._display.record(row), is_event=row.event is not None)

    def place(self, name: str) -> int | None:
        """Where a column begins; None where no row has a value in it."""
        return self._columns[name] * self._height if name in self._filled else None

    def texts(self, name: str) -> Sequence[str]:
        """The texts of a column by their numbers."""
        if name == "program":
            return self._display.toolpath.programs
        return UNITS if name == "unit" else list(self._texts[name])

    def _make_room(self, columns: int) -> None:
        missing = columns * self._height - len(self.table)
        if missing > 0:
            room = array("d", (nan,)) * missing
            self.table = self.table + room if self.table else room

    def _is_for_numpy(self, chunk: Chunk) -> bool:
        """Transformations and other names of axes come as Python code; so does the kernel where it is not compiled."""
        contexts = self._display.toolpath.contexts
        for number in {number for number, _, _ in chunk.context_runs()}:
            context = contexts[number]
            if context.transformation is not None or context.shown_by is not None or context.names:
                return True
        return LIBRARY.lack is not None and len(chunk) >= COLUMN_ROWS and is_installed("numpy")

    def _by_kernel(self, chunk: Chunk, *, arcs: bool) -> Iterable[int]:
        """Fill the columns; gives the rows that have more than these."""
        rows = Rows(chunk.kind, chunk.program, chunk.feed, chunk.end, chunk.curve, chunk.curves)
        fill, found = show(), 0
        if len(self._others) < len(chunk):
            self._others = array("q", bytes(8 * len(chunk)))
        for number, first, end in chunk.context_runs():
            view = self._view(self._display.toolpath.contexts[number])
            found = fill(rows, view, first, end, arcs, self.table, self._others, found)
        return self._others[:found]

    def _view(self, context: Context) -> View:
        _, view = self._views.get(id(context), (None, None))
        if view is None:
            display, scale, frame = self._display, self._display.scale(context), context.frame
            offsets = context.offsets or (0.0,) * len(display.axes)
            modulo = display.modulo(context)
            axes = array("d")
            for i, each in enumerate(zip(scale.work, scale.machine, offsets, strict=True)):
                axes.extend((*each, i in modulo))
            mapped = array("d")
            if not frame.is_identity:
                for line, shift in zip(frame.m, frame.t, strict=True):
                    mapped.extend((*line, shift))
            beside = array("d", (scale.length, scale.feed, context.inch, self._tool(context)))
            view = View(axes, mapped, array("q", display.geometry(context)), beside)
            if len(self._views) >= _MOST_VIEWS:
                self._views.clear()
            self._views[id(context)] = context, view
        return view

    def _tool(self, context: Context) -> float:
        """The number of the tool in the spindle, by its number or name; NaN for none."""
        name = context.tool_name or (str(context.tool) if context.tool else None)
        return nan if name is None else self._tools.setdefault(name, len(self._tools))

    def _by_numpy(self, chunk: Chunk, *, arcs: bool) -> Iterable[int]:
        """The same by the columns of the display."""
        import numpy as np

        display, height = self._display, self._height
        shown, axes = display.columns(chunk), len(display.axes)
        columns = shown.columns
        table = np.frombuffer(self.table, np.float64)
        table = table[: len(table) // height * height].reshape(-1, height)
        table[TYPE], table[PROGRAM], table[FEED] = columns.kind, columns.program, shown.feed
        table[UNIT] = np.where(columns.kind == Kind.EVENT, nan, shown.inch)
        table[TOOL] = np.array([self._tool(context) for context in display.toolpath.contexts])[
            columns.context
        ]
        table[PLACES : PLACES + axes] = shown.work.T
        table[PLACES + axes : PLACES + 2 * axes] = shown.machine.T
        self._put_named(table, shown)
        if arcs:
            table[TURNS] = table[PLACES + 2 * axes : PLACES + 3 * axes] = nan
            for name, values in display.arcs(shown).items():
                table[self._columns[name.lower()]] = values
                self._filled.add(name.lower())
        others: list[int] = np.flatnonzero(
            (columns.curve >= 0) & ~np.isin(columns.kind, tuple(SHOWN_IN_COLUMNS))
        ).tolist()
        return others

    def _put_named(self, table: NDArray[np.float64], shown: Shown) -> None:
        """Move what the work display calls otherwise than the axes into the columns of these names."""
        import numpy as np

        contexts, axes = self._display.toolpath.contexts, len(self._display.axes)
        numbers: list[int] = np.unique(shown.columns.context).tolist()
        for number in numbers:
            if names := contexts[number].names:
                rows = shown.columns.context == number
                table[PLACES : PLACES + axes, rows] = nan
                for name, values in zip(names, shown.work[rows].T, strict=True):
                    if name:
                        column = self._columns[name.lower()]
                        if name.lower() not in self._filled:
                            self._filled.add(name.lower())
                            table[column] = nan
                        table[column, rows] = values

    def _add(self, row: int, record: Record, *, is_event: bool) -> None:
        """Add what a record says beside what every row has."""
        for name, value in flattened(record).items():
            if name in self._common and not is_event:
                continue
            if name in self._texts:
                texts = self._texts[name]
                # Codes and tools may be numbers or names: as texts they are both.
                self._set(name, row, texts.setdefault(str(value), len(texts)))
            elif name in self._columns and isinstance(value, float | int):
                self._set(name, row, value)

    def _set(self, name: str, row: int, value: float) -> None:
        column = self._columns[name]
        if name not in self._filled:
            self._filled.add(name)
            self._make_room(column + 1)
            first = column * self._height
            self.table[first : first + self._height] = array("d", (nan,)) * self._height
        self.table[column * self._height + row] = value
