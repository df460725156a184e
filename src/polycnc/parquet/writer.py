"""Writes a table as a Parquet file: row groups of columns, and what stands at the end.

A column has one page: numbers as they are or, where values repeat, places in a dictionary that stands in front; of
whole numbers the steps. Nothing is compressed: coordinates hardly repeat, and what repeats is short as it stands.
Apache Parquet format 2.
"""

from __future__ import annotations

import struct
import sys
from array import array

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import IO, TYPE_CHECKING, TypeAlias
from polycnc.parquet import thrift
from polycnc.parquet.compiled import kernels
from polycnc.parquet.pages import BLOCK, MOST_VALUES, PART, SLOTS
from polycnc.parquet.schema import TYPES, Content, Field, arrow_schema, elements
from polycnc.parquet.thrift import varint

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

MAGIC = b"PAR1"
_FORMAT_VERSION = 2
#: Encodings, and pages.
_PLAIN, _RLE, _STEPS, _DICTIONARY = 0, 3, 5, 8
_DATA_PAGE, _DICTIONARY_PAGE = 0, 2
_UNCOMPRESSED = 0
#: How values are ordered that statistics compare: as their type says.
_TYPE_ORDER = thrift.struct({1: thrift.struct({})})

#: Parts of a page one behind the other.
_Parts: TypeAlias = "Sequence[bytes | memoryview]"


class _Statistics(NamedTuple):
    """Nulls of a column, its least and greatest value as Parquet writes them; no values where all are null."""

    nulls: int
    values: tuple[bytes, ...] = ()


class Writer:
    """Writes row groups: `begin`, then the columns in the order of the fields; `close` writes the end of the file.

    Args:
        stream: What is written to; it stays open.
        fields: The columns.
        metadata: What the file says of the whole table.
        made_by: The program that writes.
    """

    def __init__(
        self, stream: IO[bytes], fields: Sequence[Field], metadata: Mapping[str, str], made_by: str
    ) -> None:
        self._stream, self._fields, self._metadata, self._made_by = stream, fields, metadata, made_by
        self._kernels = kernels()
        self._slots, self._homes = array("i", bytes(4 * SLOTS)), array("i", bytes(4 * MOST_VALUES))
        self._values, self._places = array("d", bytes(8 * MOST_VALUES)), array("i")
        self._bits = array("B")
        self._at = self._rows = self._all_rows = 0
        self._groups: list[thrift.Value] = []
        self._columns: list[thrift.Value] = []
        self._group_bytes = 0
        self._write([MAGIC])

    def begin(self, rows: int) -> None:
        """Begin a row group of so many rows, at least one, behind the columns of the last one."""
        self._end()
        self._rows = rows
        if len(self._places) < rows:
            self._places = array("i", bytes(4 * rows))
            self._bits = array("B", bytes(5 * rows + 1024))

    def nothing(self) -> None:
        """Add a column of nulls."""
        field = self._fields[len(self._columns)]
        self._column(0, _PLAIN, [], _Statistics(self._rows) if field.content is not Content.NUMBER else None)

    def whole(self, numbers: array[int]) -> None:
        """Add a column of whole numbers without nulls: `array("I")`, below 2^31."""
        held, found = array("q", bytes(8 * (PART + 2))), array("q", (0, 0))
        size = self._kernels.put_steps(numbers, held, self._bits, found)
        least, greatest = (struct.pack("<i", number) for number in found)
        head = b"".join(varint(number) for number in (BLOCK, BLOCK // PART, self._rows, 2 * numbers[0]))
        steps: _Parts = [head, memoryview(self._bits)[:size]]
        self._column(self._rows, _STEPS, steps, _Statistics(0, (least, greatest)))

    def numbers(self, numbers: array[float], first: int) -> None:
        """Add the column of numbers that begins at a place; NaN is null. The array is used up."""
        count = self._kernels.drop_nulls(numbers, first, self._rows, self._bits)
        levels = self._levels(count)
        found = self._index(numbers, first, count)
        if found >= 0:
            self._dictionary(found, [_little(self._values[:found])], count, levels, None)
        else:
            values = memoryview(numbers)[first : first + count]
            self._column(count, _PLAIN, [_little(values)], None, levels)

    def names(self, numbers: array[float], first: int, names: Sequence[str]) -> None:
        """Add a column of texts by their numbers, as `numbers` adds one of numbers."""
        count = self._kernels.drop_nulls(numbers, first, self._rows, self._bits)
        levels = self._levels(count)
        found = self._index(numbers, first, count)
        values = self._values[:found] if found >= 0 else numbers[first : first + count]
        texts = [names[int(number)].encode() for number in values]
        statistics = _Statistics(self._rows - count, (min(texts), max(texts)) if texts else ())
        written = [b"".join(struct.pack("<i", len(text)) + text for text in texts)]
        if found >= 0:
            self._dictionary(found, written, count, levels, statistics)
        else:
            self._column(count, _PLAIN, written, statistics, levels)

    def close(self) -> None:
        """Write the end of the file."""
        self._end()
        said = {**self._metadata, "ARROW:schema": arrow_schema(self._fields, self._metadata)}
        pairs = [
            thrift.struct({1: thrift.binary(name), 2: thrift.binary(value)}) for name, value in said.items()
        ]
        end = {
            1: thrift.i32(_FORMAT_VERSION),
            2: elements(self._fields),
            3: thrift.i64(self._all_rows),
            4: thrift.array(self._groups),
            5: thrift.array(pairs),
            6: thrift.binary(self._made_by),
            7: thrift.array([_TYPE_ORDER] * len(self._fields)),
        }
        _, content = thrift.struct(end)
        self._write([content, struct.pack("<i", len(content)), MAGIC])

    def _end(self) -> None:
        """End the row group that is open."""
        if not self._columns:
            return
        size = self._group_bytes
        group = {
            1: thrift.array(self._columns),
            2: thrift.i64(size),
            3: thrift.i64(self._rows),
            5: thrift.i64(self._at - size),
            6: thrift.i64(size),
        }
        self._groups.append(thrift.struct(group))
        self._all_rows += self._rows
        self._columns, self._group_bytes = [], 0

    def _index(self, numbers: array[float], first: int, count: int) -> int:
        """How many different values there are, in `_values`, with the place of each row's one in `_places`."""
        if not count:
            return -1
        return self._kernels.index_values(
            numbers, first, count, self._slots, self._homes, self._values, self._places
        )

    def _levels(self, count: int) -> bytes:
        """Which rows have values, of so many that have one: what `drop_nulls` has left."""
        if count in (0, self._rows):
            return _run(self._rows, 1 if count else 0, 1)
        groups = (self._rows + 7) // 8
        return varint(groups << 1 | 1) + self._bits[:groups].tobytes()

    def _dictionary(
        self, found: int, values: _Parts, count: int, levels: bytes, statistics: _Statistics | None
    ) -> None:
        """Add a column as places in a dictionary."""
        if found == 1:
            width, packed = 1, _run(count, 0, 1)
        else:
            width = (found - 1).bit_length()
            size = self._kernels.pack_places(self._places, count, width, self._bits)
            packed = varint((count + 7) // 8 << 1 | 1) + self._bits[:size].tobytes()
        start = self._at
        self._page(_DICTIONARY_PAGE, 7, {1: thrift.i32(found), 2: thrift.i32(_PLAIN)}, values)
        self._column(count, _DICTIONARY, [bytes((width,)), packed], statistics, levels, start)

    def _column(
        self,
        count: int,
        encoding: int,
        values: _Parts,
        statistics: _Statistics | None,
        levels: bytes = b"",
        start: int = -1,
    ) -> None:
        """Write the page of a column, and note it.

        Args:
            count: Values that are not null.
            encoding: Of the values.
            values: As they are written.
            statistics: What is noted of them.
            levels: Which rows have values; left out where all have, or none has.
            start: Place of the dictionary; -1 where there is none.
        """
        levels = levels or _run(self._rows, 1 if count else 0, 1)
        page = self._at
        head = {1: thrift.i32(self._rows), 2: thrift.i32(encoding), 3: thrift.i32(_RLE), 4: thrift.i32(_RLE)}
        self._page(_DATA_PAGE, 5, head, [struct.pack("<i", len(levels)), levels, *values])
        field = self._fields[len(self._columns)]
        start = page if start < 0 else start
        size = thrift.i64(self._at - start)
        encodings = {_RLE, encoding, *((_PLAIN,) if start < page else ())}
        noted = {
            1: thrift.i32(TYPES[field.content]),
            2: thrift.array([thrift.i32(each) for each in sorted(encodings)]),
            3: thrift.array([thrift.binary(field.name)]),
            4: thrift.i32(_UNCOMPRESSED),
            5: thrift.i64(self._rows),
            6: size,
            7: size,
            9: thrift.i64(page),
        }
        if start < page:
            noted[11] = thrift.i64(start)
        if statistics is not None:
            noted[12] = _noted(statistics)
        self._columns.append(thrift.struct({2: thrift.i64(start), 3: thrift.struct(noted)}))
        self._group_bytes += self._at - start

    def _page(self, kind: int, field: int, head: dict[int, thrift.Value], parts: _Parts) -> None:
        size = thrift.i32(sum(len(part) for part in parts))
        _, content = thrift.struct({1: thrift.i32(kind), 2: size, 3: size, field: thrift.struct(head)})
        self._write([content, *parts])

    def _write(self, parts: _Parts) -> None:
        for part in parts:
            self._stream.write(part)
            self._at += len(part)


def _run(count: int, value: int, width: int) -> bytes:
    """So many rows of one number."""
    return varint(count << 1) + value.to_bytes((width + 7) // 8, "little")


def _noted(statistics: _Statistics) -> thrift.Value:
    noted = {3: thrift.i64(statistics.nulls)}
    if statistics.values:
        least, greatest = statistics.values
        noted |= {5: thrift.binary(greatest), 6: thrift.binary(least), 7: thrift.true(), 8: thrift.true()}
    return thrift.struct(noted)


def _little(numbers: array[float] | array[int] | memoryview) -> memoryview:
    """The bytes of numbers, the lowest first."""
    if sys.byteorder == "big":
        numbers = array(memoryview(numbers).format, numbers)
        numbers.byteswap()
    return memoryview(numbers).cast("B")
