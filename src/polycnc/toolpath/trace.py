"""A toolpath row as the control's displays would show it: the records of the trace.

Inside the table lengths are millimetres and radii. Here, and only here, they become what an operator
reads: inches where the program is in inches, diameters on diameter axes, feeds per minute, modulo rotary axes
within one turn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.modules import is_installed
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.geometry.units import INCH_MM
from polycnc.toolpath.digits import STEPS
from polycnc.toolpath.events import Raised
from polycnc.toolpath.kinds import ARC_KINDS, TYPE_NAMES, Kind
from polycnc.toolpath.modes import FeedMode

with loaded_when_called():
    from polycnc.transformation import rows as of_columns

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from typing import NotRequired, TypedDict

    import numpy as np
    from numpy.typing import NDArray

    from polycnc.machine.layout import AxisLayout
    from polycnc.toolpath.context import Context
    from polycnc.toolpath.events import Event
    from polycnc.toolpath.table import Chunk, Columns, Row, Toolpath


#: From so many rows on, whole columns (and the start of NumPy) are faster than row by row.
COLUMN_ROWS = 10_000
_FULL_TURN = 360.0
#: Contexts whose factors a display keeps; the main run comes to new ones without end.
MOST_SCALES = 1000
#: Unit of lengths, metric or in inches.
UNITS = ("mm", "inch")
#: Seconds in the time unit of each feed mode: per minute, per revolution (no time in it), inverse minutes.
_TIME_FACTOR = {FeedMode.INVERSE_TIME: 60.0, FeedMode.PER_MINUTE: 60.0, FeedMode.PER_REVOLUTION: 1.0}


@dataclass(frozen=True, slots=True)
class Scale:
    """Factors from the table's units to the displays' under one context.

    Attributes:
        work: For each axis of the work display.
        machine: For each axis of the machine display.
        length: For lengths along no axis (leads).
        feed: For the feed in the context's feed mode.
        unit: Unit of lengths.
    """

    work: tuple[float, ...]
    machine: tuple[float, ...]
    length: float
    feed: float
    unit: str


if TYPE_CHECKING:  # `typing` would compile every annotation at each start

    class Record(TypedDict):
        """A row as the trace shows it. A move has a unit and positions by axis; an event has its fields.

        Only the records of further channels name their `channel`.
        """

        channel: NotRequired[int]
        type: str
        program: str
        line: int
        unit: NotRequired[str]
        to: NotRequired[dict[str, float]]
        machine: NotRequired[dict[str, float]]
        feed: NotRequired[float]
        center: NotRequired[dict[str, float]]
        turns: NotRequired[float]
        seconds: NotRequired[float]
        revolutions: NotRequired[float]
        lead: NotRequired[float]
        start_angle: NotRequired[float]
        code: NotRequired[float | str]
        spindle: NotRequired[int]
        speed: NotRequired[float]
        tool: NotRequired[float | str]
        text: NotRequired[str]
        name: NotRequired[str]
        value: NotRequired[float]
        word: NotRequired[str]
        column: NotRequired[int]

    class CurveRecord(TypedDict, total=False):
        """What the curve parameters of a row add to its record."""

        center: dict[str, float]
        turns: float
        seconds: float
        revolutions: float
        lead: float
        start_angle: float


class Shown(NamedTuple):
    """The columns of a chunk as the displays show them.

    Attributes:
        columns: As the table has them.
        work: Work display (n, axes); NaN where a row is an event.
        machine: Machine display (n, axes); NaN where a row is an event.
        feed: As shown (n,); NaN where a row names none.
        inch: Whether lengths are inches (n,).
    """

    columns: Columns
    work: NDArray[np.float64]
    machine: NDArray[np.float64]
    feed: NDArray[np.float64]
    inch: NDArray[np.bool_]


class Display:
    """Shows the rows of one toolpath.

    Args:
        toolpath: The toolpath that the rows belong to.
        layout: Geometry and rotary axes of the channel.
        alarm_text: Gives the text of an alarm.
        names: What the work display may call an axis beside its own name (`Context.names`).

    Attributes:
        names: All names of the work display, those of the axes first.
    """

    def __init__(
        self,
        toolpath: Toolpath,
        layout: AxisLayout,
        alarm_text: Callable[[Raised], str] | None = None,
        names: Sequence[str] = (),
    ) -> None:
        self.axes = toolpath.axes
        self.names = (*self.axes, *(name for name in names if name not in self.axes))
        self.toolpath = toolpath
        self.layout = layout
        self._alarm_text = alarm_text
        self.modulo_axes = frozenset(self.axes[i] for i in layout.modulo)
        #: By the identity of a context, which is kept as long as the entry: another one must not come in its place.
        self._scales: dict[int, tuple[Context, Scale]] = {}

    def records(self) -> Iterator[Record]:
        """The records of all motions and events that the toolpath still holds, in order."""
        yield from self._motions(self.toolpath.rows())

    def _motions(self, rows: Iterable[Row]) -> Iterator[Record]:
        """A motion of several rows is shown by its last one, where something has broken it off too."""
        held: Row | None = None
        for row in rows:
            if held is not None and (
                row.event is not None or (row.program, row.line) != (held.program, held.line)
            ):
                yield self.record(held)
            held = row if row.context.is_hidden and row.event is None else None
            if held is None:
                yield self.record(row)
        if held is not None:
            yield self.record(held)

    def shown_rows(self, chunk: Chunk) -> Sequence[int]:
        """The rows of a chunk that have a record: events, and of each motion its last row."""
        contexts, every = self.toolpath.contexts, range(len(chunk))
        hidden = {number for number, _, _ in chunk.context_runs() if contexts[number].is_hidden}
        if not hidden:
            return every
        kinds, lines, programs = chunk.kind, chunk.line, chunk.program
        goes_on = [
            number in hidden and kind != Kind.EVENT != after and (line, program) == behind
            for number, kind, after, line, program, behind in zip(
                chunk.context, kinds, kinds[1:], lines, programs, zip(lines[1:], programs[1:], strict=True),
                strict=False,
            )
        ]  # fmt: skip
        return [row for row in every if row == len(goes_on) or not goes_on[row]]

    def records_of(self, chunk: Chunk) -> Iterator[Record]:
        """The records of one chunk. Long chunks go by whole columns, which gives the same values."""
        contexts = self.toolpath.contexts
        single = any(each.names or each.shown_by is not None or each.is_hidden for each in contexts)
        if len(chunk) >= COLUMN_ROWS and not single and is_installed("numpy"):
            yield from self._records_by_column(chunk)
        else:
            yield from self._motions(self.toolpath.rows_of(chunk))

    def _records_by_column(self, chunk: Chunk) -> Iterator[Record]:
        shown = self.columns(chunk)
        kinds, numbers, lines, _context, _feed, _end, curves, _curves = shown.columns
        columns = (kinds, numbers, lines, shown.inch, shown.work, shown.machine, shown.feed, curves)
        rows = zip(*(column.tolist() for column in columns), strict=True)
        for i, (*move, curve) in enumerate(rows):
            yield self._move(*move) if curve < 0 else self.record(self.toolpath.row_of(chunk, i))

    def _move(
        self,
        kind: int,
        program: int,
        line: int,
        inch: bool,
        work: Sequence[float],
        machine: Sequence[float],
        feed: float,
    ) -> Record:
        """A move without curve parameters as a record."""
        record: Record = {
            "type": TYPE_NAMES[kind],
            "program": self.toolpath.programs[program],
            "line": line,
            "unit": UNITS[inch],
            "to": dict(zip(self.axes, work, strict=True)),
            "machine": dict(zip(self.axes, machine, strict=True)),
        }
        if feed == feed:
            record["feed"] = feed
        return record

    def columns(self, chunk: Chunk) -> Shown:
        """A chunk by whole columns. Needs NumPy."""
        import numpy as np

        columns = chunk.numpy()
        kind, end, feed = columns.kind, columns.end, columns.feed.copy()
        work, machine = np.empty_like(end), np.empty_like(end)
        inch = np.zeros(len(chunk), bool)
        turning: list[tuple[NDArray[np.bool_] | slice, int]] = []
        numbers: list[int] = np.unique(columns.context).tolist()
        for number in numbers:
            rows: NDArray[np.bool_] | slice = columns.context == number if len(numbers) > 1 else slice(None)
            context = self.toolpath.contexts[number]
            scale = self.scale(context)
            seen = (
                end[rows] if context.shown_by is None else of_columns.work_rows(context.shown_by, end[rows])
            )
            work[rows] = seen * scale.work
            turning.extend((rows, i) for i in self.modulo(context))
            machine[rows] = _machine_columns(end[rows], context, self.layout.geometry) * scale.machine
            feed[rows] *= np.where(kind[rows] == Kind.THREAD, scale.length, scale.feed)
            inch[rows] = context.inch
        for values in (work, machine, feed):
            _round(values)
        for rows, i in turning:
            work[rows, i] = np.rint(work[rows, i] % _FULL_TURN * STEPS) / STEPS
        is_event: NDArray[np.bool_] = kind == Kind.EVENT
        work[is_event] = machine[is_event] = np.nan
        return Shown(columns, work, machine, feed, inch)

    def record(self, row: Row) -> Record:
        """One row as a record of the trace."""
        if row.event is not None:
            return self._event(row, row.event)
        scale = self.scale(row.context)
        record: Record = {
            "type": TYPE_NAMES[row.kind],
            "program": row.program,
            "line": row.line,
            "unit": scale.unit,
            "to": self.work(row.end, row.context),
            "machine": self.machine(row.end, row.context),
        }
        if row.has_feed:
            # The F of a thread is its lead, whatever the feed mode.
            factor = scale.length if row.kind == Kind.THREAD else scale.feed
            record["feed"] = _shown(row.feed * factor)
        return {**record, **self.curve(row)} if row.curve else record

    def _event(self, row: Row, event: Event) -> Record:
        place = {"type": event.type, "program": row.program, "line": row.line}
        record = cast("Record", {**place, **event.data})
        if isinstance(event, Raised) and self._alarm_text is not None:
            record["text"] = self._alarm_text(event)
        return record

    def work(self, end: Sequence[float], context: Context) -> dict[str, float]:
        """A position (absolute, internal units) as the work display shows it."""
        factors = self.scale(context).work
        if context.shown_by is not None:
            end = context.shown_by.to_work(end)
        names = context.names or self.axes
        shown = {axis: _shown(v * f) for axis, v, f in zip(names, end, factors, strict=True)}
        for i in self.modulo(context):
            if names[i]:
                shown[names[i]] = _shown(shown[names[i]] % _FULL_TURN)
        shown.pop("", None)
        return shown

    def machine(self, end: Sequence[float], context: Context) -> dict[str, float]:
        """A position (absolute, internal units) as the machine display shows it, never in inches."""
        position = self.toolpath.to_machine(tuple(end), context, self.layout.geometry)
        factors = self.scale(context).machine
        return {axis: _shown(v * f) for axis, v, f in zip(self.axes, position, factors, strict=True)}

    def scale(self, context: Context) -> Scale:
        """The factors that hold under a context."""
        _, scale = self._scales.get(id(context), (None, None))
        if scale is None:
            length = 1.0 / INCH_MM if context.inch else 1.0
            diameter = _diameters(context.diameter_axes, len(self.axes))
            angles = self.layout.rotary.difference(self.geometry(context))
            work = [d if i in angles else d * length for i, d in enumerate(diameter)]
            if context.unrolled is not None:
                work[context.unrolled[0]] = context.unrolled[1]
            if context.machine_diameters is not None:
                diameter = _diameters(context.machine_diameters, len(self.axes))
            feed = _TIME_FACTOR[context.feed_mode] * (
                context.share if context.feed_mode is FeedMode.INVERSE_TIME else length
            )
            unit = UNITS[context.inch]
            scale = Scale(tuple(work), tuple(diameter), length, feed, unit)
            if len(self._scales) >= MOST_SCALES:
                self._scales.clear()
            self._scales[id(context)] = context, scale
        return scale

    def geometry(self, context: Context) -> tuple[int, int, int]:
        """Columns of X, Y, Z of what is shown."""
        made = context.transformation or context.shown_by
        return self.layout.geometry if made is None else made.geometry

    def modulo(self, context: Context) -> frozenset[int]:
        """Axes whose display stays within one turn; not one that a transformation makes a length."""
        made = context.transformation or context.shown_by
        if made is None or context.unrolled is not None:
            return self.layout.modulo
        return self.layout.modulo.difference(made.geometry)

    def curve(self, row: Row) -> CurveRecord:
        """What the curve parameters of a row add to its record."""
        kind, curve = row.kind, row.curve
        scale = self.scale(row.context)
        if kind == Kind.DWELL:
            seconds, revolutions = curve[0], curve[1]
            return {"revolutions": _shown(revolutions)} if revolutions else {"seconds": _shown(seconds)}
        if kind in (Kind.THREAD, Kind.TAP):
            record: CurveRecord = {"lead": _shown(curve[0] * scale.length), "start_angle": _shown(curve[1])}
            # A circular thread: its centre and normal stand behind lead and angle.
            return {**record, **self._arc((*curve[2:8], 0.0), row)} if any(curve[5:8]) else record
        return self._arc(curve, row) if kind in ARC_KINDS else {}

    def _arc(self, curve: Sequence[float], row: Row) -> CurveRecord:
        """Centre on the axes of the arc's plane (all three where it is tilted), and further turns.

        Where displays show the path by a transformation, the centre is shown as the end of the row is.
        """
        center, normal, turns, context = curve[0:3], curve[3:6], curve[6], row.context
        if context.shown_by is not None:
            columns, point = self.geometry(context), list(row.end)
            for axis, value in zip(columns, center, strict=True):
                point[axis] = value
            point = context.shown_by.to_work(point)
            center = tuple(point[axis] for axis in columns)
        tilted = sum(1 for component in normal if abs(component) > 1e-9) > 1
        shown: dict[str, float] = {}
        scale = self.scale(context)
        for i, value, component in zip(self.geometry(context), center, normal, strict=True):
            if i >= 0 and (tilted or abs(component) <= 1e-9):
                shown[(context.names or self.axes)[i]] = _shown(value * scale.work[i])
        record: CurveRecord = {"center": shown}
        if turns:
            record["turns"] = _shown(turns + 1)
        return record

    def arcs(self, shown: Shown) -> dict[str, NDArray[np.float64]]:
        """`center_X` … and `turns` of the rows that `columns` gives, NaN where a row has none; as `_arc` for one."""
        import numpy as np

        columns = shown.columns
        is_arc = np.isin(columns.kind, tuple(ARC_KINDS))
        found: dict[str, NDArray[np.float64]] = {}
        if not is_arc.any():
            return found
        numbers: list[int] = np.unique(columns.context[is_arc]).tolist()
        for number in numbers:
            context = self.toolpath.contexts[number]
            rows = np.flatnonzero(is_arc & (columns.context == number))
            curves, scale = columns.curves[columns.curve[rows]], self.scale(context)
            geometry, center = self.geometry(context), curves[:, :3]
            if context.shown_by is not None:
                points = columns.end[rows]
                points[:, geometry] = center
                center = of_columns.work_rows(context.shown_by, points)[:, geometry]
            along = np.abs(curves[:, 3:6]) > 1e-9
            tilted = along.sum(axis=1) > 1
            for k, i in enumerate(geometry):
                if i >= 0:
                    name = (context.names or self.axes)[i]
                    column = found.setdefault(f"center_{name}", np.full(len(is_arc), np.nan))
                    values = np.rint(center[:, k] * scale.work[i] * STEPS) / STEPS + 0.0
                    column[rows] = np.where(tilted | ~along[:, k], values, np.nan)
            turns = np.rint((curves[:, 6] + 1.0) * STEPS) / STEPS
            found.setdefault("turns", np.full(len(is_arc), np.nan))[rows] = np.where(
                curves[:, 6], turns, np.nan
            )
        return found


def _diameters(axes: int, count: int) -> list[float]:
    """The factor of every axis: 2 for those whose bit is set."""
    return [2.0 if axes >> i & 1 else 1.0 for i in range(count)]


def _shown(value: float) -> float:
    """A value without rounding noise and without -0.0, to the same bits as `Display.columns`."""
    return round(value * STEPS) / STEPS


def _round(values: NDArray[np.float64]) -> None:
    """`_shown` for many values, in their place: `np.rint(values * STEPS) / STEPS + 0.0`."""
    import numpy as np

    np.multiply(values, STEPS, out=values)
    np.rint(values, out=values)
    np.divide(values, STEPS, out=values)
    np.add(values, 0.0, out=values)


def _machine_columns(
    end: NDArray[np.float64], context: Context, geometry: tuple[int, int, int]
) -> NDArray[np.float64]:
    """`Toolpath.to_machine` for whole columns (n, axes), in the same order of operations."""
    machine = end
    if context.transformation is not None:
        machine = of_columns.machine_rows(context.transformation, machine)
    if not context.frame.is_identity:
        machine = of_columns.mapped_rows(context.frame, machine, geometry)
    return machine + context.offsets if context.offsets else machine
