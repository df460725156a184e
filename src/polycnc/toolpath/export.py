"""Writes the trace: JSON lines, CSV, and Parquet; gives it as an Arrow table.

All three show the same values, those of the control's displays; see `trace.Display`. Writers take the
toolpath chunk by chunk, so that a long program needs no more memory than a short one.
"""

from __future__ import annotations

from io import StringIO

from polycnc.deferred.typing import IO, TYPE_CHECKING, Any, Protocol, TypeAlias
from polycnc.toolpath.columns.names import NAMES, TEXTS, flattened, table_columns

if TYPE_CHECKING:
    from array import array
    from collections.abc import Callable, Iterable, Mapping

    import pyarrow as pa

    from polycnc.toolpath.columns.numbers import Numbers
    from polycnc.toolpath.table import Chunk
    from polycnc.toolpath.trace import Display, Record

#: Columns that a plan adds.
TIMES = ("wait", "start", "duration", "length", "feed_executed")
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
        import json

        from polycnc.toolpath.columns.lines import MARKED_TEXT, Lines

        self._stream, self._marked = stream, MARKED_TEXT
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
        return self._marked.sub(r"\1", self.line(record))

    def close(self) -> None:
        """Nothing stands behind the last line."""


class Csv:
    """A header line and one line a row, in the columns of `table_columns`."""

    def __init__(self, stream: IO[bytes], display: Display, _metadata: Metadata) -> None:
        import csv

        from polycnc.toolpath.columns.lines import Lines

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
    """An Arrow table in Parquet, one row group a chunk.

    It is written without pyarrow, which takes longer to start than most runs take.
    """

    def __init__(self, stream: IO[bytes], display: Display, metadata: Metadata) -> None:
        from polycnc.parquet.schema import Content, Field
        from polycnc.parquet.writer import Writer
        from polycnc.toolpath.columns.numbers import Numbers
        from polycnc.version import MADE_BY

        contents = {"line": Content.WHOLE} | dict.fromkeys(NAMES, Content.NAME)
        contents |= dict.fromkeys(TEXTS, Content.TEXT)
        self._fields = [Field(name, contents.get(name, Content.NUMBER)) for name in table_columns(display)]
        self._texts = frozenset((*NAMES, *TEXTS))
        self._display, self._numbers = display, Numbers(display)
        self._writer = Writer(stream, self._fields, metadata, MADE_BY)

    def take(self, chunk: Chunk) -> None:
        """Write the rows of a chunk."""
        if not len(chunk):
            return
        chunk = chunk.only(self._display.shown_rows(chunk))
        numbers, writer = self._numbers, self._writer
        numbers.take(chunk)
        writer.begin(len(chunk))
        for name, _ in self._fields:
            if name == "line":
                writer.whole(chunk.line)
                continue
            place = numbers.place(name)
            if place is None:
                writer.nothing()
            elif name in self._texts:
                writer.names(numbers.table, place, numbers.texts(name))
            else:
                writer.numbers(numbers.table, place)

    def close(self) -> None:
        """Write the end of the file."""
        self._writer.close()


#: Writers by the suffix of the file, with the mode in which it is opened.
WRITERS: dict[str, tuple[str, Callable[[IO[Any], Display, Metadata], TraceWriter]]] = {
    ".jsonl": ("wb", JsonLines),
    ".csv": ("wb", Csv),
    ".parquet": ("wb", Parquet),
}


def with_times(table: pa.Table, plan: RowTimes, display: Display) -> pa.Table:
    """A table of all chunks with what the plan says of each row: `TIMES` are its further columns.

    `wait` is how long the axes stand before the row (tool change, spindle, auxiliary functions), `start` and `duration`
    are of the motion or dwell behind it, all in seconds. `length` is mm as the feed counts it (degrees
    where rotary axes move alone), `feed_executed` the mean feed of the motion, mm/min or degrees/min.
    """
    import numpy as np
    import pyarrow as pa

    wait = np.zeros(len(plan.row_s))
    wait[list(plan.row_waits)] = list(plan.row_waits.values())
    ends = [chunk.first + row for chunk in display.toolpath.chunks for row in display.shown_rows(chunk)]
    first = np.array([-1, *ends[:-1]]) + 1
    whole, length, wait = (
        np.add.reduceat(column, first) if ends else np.zeros(0) for column in (plan.row_s, plan.row_mm, wait)
    )
    duration = np.maximum(whole - wait, 0.0)
    feed = np.full(len(whole), np.nan)
    np.divide(60.0 * length, duration, out=feed, where=(length > 0.0) & (duration > 0.0))
    start = np.cumsum(whole) - duration
    for name, values in zip(TIMES, (wait, start, duration, length, feed), strict=True):
        table = table.append_column(name, pa.array(values, pa.float64(), from_pandas=True))
    return table


def arrow_schema(display: Display, metadata: Metadata) -> pa.Schema:
    """The Arrow schema of a run's table; `metadata` says control, machine and units."""
    import pyarrow as pa

    names = pa.dictionary(pa.int32(), pa.string())
    types = {"line": pa.int32(), "type": names, "program": names, "unit": names}
    types |= dict.fromkeys(TEXTS, pa.string())
    fields = [pa.field(name, types.get(name, pa.float64())) for name in table_columns(display)]
    return pa.schema(fields, metadata=dict(metadata))


def arrow_table(display: Display, chunks: Iterable[Chunk], metadata: Metadata) -> pa.Table:
    """Chunks as an Arrow table; a value that a row does not have is null. Needs pyarrow and NumPy."""
    import pyarrow as pa

    from polycnc.toolpath.columns.numbers import Numbers

    schema, numbers = arrow_schema(display, metadata), Numbers(display)
    filled = (chunk.only(display.shown_rows(chunk)) for chunk in chunks if len(chunk))
    batches = [_batch(numbers, chunk, schema) for chunk in filled]
    return pa.Table.from_batches(batches, schema=schema)


def _batch(numbers: Numbers, chunk: Chunk, schema: pa.Schema) -> pa.RecordBatch:
    """The rows of one chunk."""
    import numpy as np
    import pyarrow as pa

    numbers.take(chunk)
    table, height = np.frombuffer(numbers.table), len(chunk)

    def column(field: pa.Field) -> pa.Array:
        if field.name == "line":
            return pa.array(np.frombuffer(chunk.line, np.uint32).astype(np.int32))
        place = numbers.place(field.name)
        if place is None:
            return pa.nulls(height, field.type)
        values = table[place : place + height]
        if field.type == pa.float64():
            return pa.array(values.copy(), from_pandas=True)
        is_null = np.isnan(values)
        if is_null.all():
            return pa.nulls(height, field.type)
        texts = numbers.texts(field.name)
        indices = np.where(is_null, len(texts), values).astype(np.int32)
        if field.name in TEXTS:  # Arrow's own way back from numbers takes a library of functions
            return pa.array(np.array([*texts, None], object)[indices], field.type)
        return pa.DictionaryArray.from_arrays(pa.array(indices, mask=is_null), pa.array(texts, pa.string()))

    return pa.record_batch([column(field) for field in schema], schema=schema)
