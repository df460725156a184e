"""Writes the trace: JSON lines, CSV, and Arrow tables (Parquet).

All three show the same values, those of the control's displays; see `trace.Display`. Writers take the
toolpath chunk by chunk, so that a long program needs no more memory than a short one.
"""

from __future__ import annotations

import csv
import json
from io import StringIO
from typing import IO, TYPE_CHECKING, Any, Literal, Protocol, TypeAlias

from polycnc.toolpath.kinds import ARC_KINDS, TYPE_NAMES, Kind
from polycnc.toolpath.lines import MARKED_TEXT, Lines

if TYPE_CHECKING:
    from array import array
    from collections.abc import Callable, Iterable, Mapping, Sequence

    import numpy as np
    import pyarrow as pa
    from numpy.typing import NDArray

    from polycnc.toolpath.table import Chunk
    from polycnc.toolpath.trace import Display, Record

    #: A column of numbers, whole or not.
    Numbers = NDArray[np.float64] | NDArray[np.int32]

#: Columns that stand before the positions, and behind them. Values of events go into the last ones.
_FIRST = ("type", "program", "line", "unit")
_NUMBERS = ("feed", "turns", "seconds", "revolutions", "lead", "start_angle", "speed", "spindle")
_TEXTS = ("code", "tool", "text")
#: Columns of few names.
_NAMES = ("type", "program", "unit")
#: Prefixes of the columns of positions.
_POSITIONS: tuple[tuple[Literal["to", "machine", "center"], str], ...] = (
    ("to", ""),
    ("machine", "machine_"),
    ("center", "center_"),
)
#: Columns that a plan adds.
TIMES = ("wait", "start", "duration", "length", "feed_executed")
_NOWHERE: dict[str, float] = {}
#: What the schema of a table says of the whole run: control, machine.
Metadata: TypeAlias = "Mapping[str, str]"


class RowTimes(Protocol):
    """Times and ways of rows, as `motion.plan.Plan` has them."""

    @property
    def row_s(self) -> array[float]:
        """Seconds of each row, waits included."""

    @property
    def row_mm(self) -> array[float]:
        """The way of each row, mm."""

    @property
    def row_waits(self) -> Mapping[int, float]:
        """Seconds that rows wait, by number."""


class TraceWriter(Protocol):
    """Writes rows as they come. `close` writes what belongs behind the last row; the stream stays open."""

    def take(self, chunk: Chunk) -> None:
        """Write the rows of a chunk."""

    def close(self) -> None:
        """Write what belongs behind the last row."""


class JsonLines:
    """One JSON object a line."""

    def __init__(self, stream: IO[bytes], display: Display, _metadata: Metadata) -> None:
        self._stream = stream
        self._encode = json.JSONEncoder(ensure_ascii=False, default=str).encode
        self._lines = Lines(display, self)

    def take(self, chunk: Chunk) -> None:
        """Write the rows of a chunk."""
        self._stream.writelines(self._lines.of(chunk))

    def add(self, records: Iterable[Record]) -> None:
        """Write records that come from elsewhere (further channels)."""
        self._stream.writelines(self.line(record).encode() for record in records)

    def line(self, record: Record) -> str:
        """The line of a record."""
        return self._encode(record) + "\n"

    def form(self, record: Record) -> str:
        """The line of a record whose numbers are marks."""
        return MARKED_TEXT.sub(r"\1", self.line(record))

    def close(self) -> None:
        """Nothing stands behind the last line."""


class Csv:
    """A header line and one line a row, in the columns of `table_columns`."""

    def __init__(self, stream: IO[bytes], display: Display, _metadata: Metadata) -> None:
        self._stream, self._row = stream, StringIO()
        self._writer = csv.writer(self._row, lineterminator="\n")
        self._columns = table_columns(display)
        self._lines = Lines(display, self)
        stream.write(self._text(dict(zip(self._columns, self._columns, strict=True))).encode())

    def take(self, chunk: Chunk) -> None:
        """Write the rows of a chunk."""
        self._stream.writelines(self._lines.of(chunk))

    def line(self, record: Record) -> str:
        """The line of a record."""
        return self._text(flattened(record))

    form = line

    def _text(self, flat: dict[str, object]) -> str:
        self._row.seek(0)
        self._row.truncate()
        self._writer.writerow([flat.get(column, "") for column in self._columns])
        return self._row.getvalue()

    def close(self) -> None:
        """Nothing stands behind the last line."""


class Parquet:
    """An Arrow table in Parquet, one row group a chunk. Needs pyarrow."""

    def __init__(self, stream: IO[bytes], display: Display, metadata: Metadata) -> None:
        from pyarrow import parquet

        self._display = display
        self._metadata = metadata
        # Coordinates hardly repeat: a dictionary of them costs time and saves nothing. Row groups are looked for by
        # their lines and names; the smallest and largest of every coordinate would take a seventh of the writing.
        schema, names = arrow_schema(display, metadata), [*_NAMES, *_TEXTS]
        self._writer = parquet.ParquetWriter(
            stream, schema, use_dictionary=names, write_statistics=["line", *names]
        )

    def take(self, chunk: Chunk) -> None:
        """Write the rows of a chunk."""
        self._writer.write_table(arrow_table(self._display, [chunk], self._metadata))

    def close(self) -> None:
        """Write the end of the file."""
        self._writer.close()


#: Writers by the suffix of the file, with the mode in which it is opened.
WRITERS: dict[str, tuple[str, Callable[[IO[Any], Display, Metadata], TraceWriter]]] = {
    ".jsonl": ("wb", JsonLines),
    ".csv": ("wb", Csv),
    ".parquet": ("wb", Parquet),
}


def table_columns(display: Display) -> tuple[str, ...]:
    """Names of the columns: positions as `x`, `machine_x`, `center_x`."""
    names = [axis.lower() for axis in display.axes]
    positions = [prefix + name for _, prefix in _POSITIONS for name in names]
    return (*_FIRST, *positions, *_NUMBERS, *_TEXTS)


def with_times(table: pa.Table, plan: RowTimes) -> pa.Table:
    """A table of all rows with what the plan says of each: `TIMES` are its further columns.

    `wait` is how long the axes stand before the row (tool change, spindle, auxiliary functions), `start` and `duration`
    are of the motion or dwell behind it, all in seconds. `length` is mm as the feed counts it (degrees
    where rotary axes move alone), `feed_executed` the mean feed of the motion, mm/min or degrees/min.
    """
    import numpy as np
    import pyarrow as pa

    whole, length = np.asarray(plan.row_s), np.asarray(plan.row_mm)
    wait = np.zeros(len(whole))
    wait[list(plan.row_waits)] = list(plan.row_waits.values())
    duration = np.maximum(whole - wait, 0.0)
    feed = np.full(len(whole), np.nan)
    np.divide(60.0 * length, duration, out=feed, where=(length > 0.0) & (duration > 0.0))
    start = np.cumsum(whole) - duration
    for name, values in zip(TIMES, (wait, start, duration, length, feed), strict=True):
        table = table.append_column(name, pa.array(values, pa.float64(), from_pandas=True))
    return table


def flattened(record: Record) -> dict[str, object]:
    """A record with its positions as columns of their own."""
    flat: dict[str, object] = {key: value for key, value in record.items() if not isinstance(value, dict)}
    for key, prefix in _POSITIONS:
        for axis, value in record.get(key, _NOWHERE).items():
            flat[prefix + axis.lower()] = value
    return flat


def arrow_schema(display: Display, metadata: Metadata) -> pa.Schema:
    """The Arrow schema of a run's table; `metadata` says control, machine and units."""
    import pyarrow as pa

    names = pa.dictionary(pa.int32(), pa.string())
    types = {"line": pa.int32(), "type": names, "program": names, "unit": names}
    types |= dict.fromkeys(_TEXTS, pa.string())
    fields = [pa.field(name, types.get(name, pa.float64())) for name in table_columns(display)]
    return pa.schema(fields, metadata=dict(metadata))


def arrow_table(display: Display, chunks: Iterable[Chunk], metadata: Metadata) -> pa.Table:
    """Chunks as an Arrow table; a value that a row does not have is null."""
    import pyarrow as pa

    schema = arrow_schema(display, metadata)
    batches = [_batch(display, chunk, schema) for chunk in chunks if len(chunk)]
    return pa.Table.from_batches(batches, schema=schema)


def _batch(display: Display, chunk: Chunk, schema: pa.Schema) -> pa.RecordBatch:
    """The rows of one chunk: whole columns; what only few rows have, row by row."""
    import numpy as np
    import pyarrow as pa

    shown = display.columns(chunk)
    kinds, types = shown.columns.kind.astype(np.int32), list(TYPE_NAMES)
    numbers: dict[str, Numbers] = {"line": shown.columns.line.astype(np.int32), "feed": shown.feed}
    for i, axis in enumerate(display.axes):
        numbers[axis.lower()] = shown.work[:, i]
        numbers[f"machine_{axis.lower()}"] = shown.machine[:, i]
    numbers |= {name.lower(): values for name, values in display.arcs(shown).items()}
    sparse = _sparse(display, chunk, kinds, types, numbers)
    names = {
        "tool": _tools(display, shown.columns.context, sparse.pop("tool", None)),
        "type": _named(kinds, types),
        "program": _named(shown.columns.program.astype(np.int32), display.toolpath.programs),
        "unit": _named(shown.inch.astype(np.int32), ("mm", "inch"), shown.columns.kind == Kind.EVENT),
    }

    nothing: dict[pa.DataType, pa.Array] = {}

    def column(field: pa.Field) -> pa.Array:
        named, values = names.get(field.name), sparse.get(field.name, numbers.get(field.name))
        if named is not None:
            return named
        if values is not None:
            return pa.array(values, type=field.type, from_pandas=True)
        if field.type not in nothing:
            nothing[field.type] = pa.nulls(len(chunk), field.type)
        return nothing[field.type]

    return pa.record_batch([column(field) for field in schema], schema=schema)


def _tools(
    display: Display, contexts: NDArray[np.uint32], called: NDArray[np.object_] | None
) -> pa.Array | None:
    """The tool in the spindle of every row, by number or name; null for none. Where a row calls one, that one."""
    import numpy as np

    names = [
        context.tool_name or (str(context.tool) if context.tool else None)
        for context in display.toolpath.contexts
    ]
    numbers = contexts.astype(np.int32)
    if called is not None:
        for row in np.flatnonzero(called != None).tolist():  # noqa: E711 - element by element
            numbers[row] = len(names)
            names.append(called[row])
    if not any(names):
        return None
    is_null = np.array([name is None for name in names])[numbers]
    return _named(numbers, [name or "" for name in names], is_null).dictionary_decode()


def _named(
    numbers: NDArray[np.int32], names: Sequence[str], is_null: NDArray[np.bool_] | None = None
) -> pa.DictionaryArray:
    """A column of names from their numbers."""
    import pyarrow as pa

    indices = pa.array(numbers, mask=is_null)
    return pa.DictionaryArray.from_arrays(indices, pa.array(names, pa.string()))


def _sparse(
    display: Display, chunk: Chunk, kinds: NDArray[np.int32], types: list[str], numbers: Mapping[str, Numbers]
) -> dict[str, NDArray[np.object_]]:
    """Columns that few rows fill: what curve parameters beside arcs add, and events.

    The types of events join `types`, their numbers go into `kinds`; what events have of other columns goes into
    `numbers`.
    """
    import numpy as np

    known = frozenset(table_columns(display))
    sparse: dict[str, NDArray[np.object_]] = {}
    curve = np.frombuffer(chunk.curve, np.int32)
    rows: list[int] = np.flatnonzero((curve >= 0) & ~np.isin(kinds, tuple(ARC_KINDS))).tolist()
    for i in rows:
        row = display.toolpath.row_of(chunk, i)
        for name, value in flattened(display.record(row)).items():
            if name in _NAMES or name not in known:
                if name == "type" and row.event is not None:
                    if row.event.type not in types:
                        types.append(row.event.type)
                    kinds[i] = types.index(row.event.type)
            elif name in numbers:
                if row.event is not None and isinstance(value, float | int):
                    numbers[name][i] = value
            else:
                column = sparse.setdefault(name, np.full(len(chunk), None, object))
                # Codes and tools may be numbers or names: as texts they are both.
                column[i] = str(value) if name in _TEXTS else value
    return sparse
