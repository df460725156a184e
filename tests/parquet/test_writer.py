"""Files that are written here, read by pyarrow."""

from __future__ import annotations

import io
from array import array
from math import inf, isnan, nan
from random import Random
from typing import TYPE_CHECKING, Any, cast

import pyarrow as pa
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pyarrow import parquet

from polycnc.parquet import pages
from polycnc.parquet.compiled import LIBRARY, Kernels
from polycnc.parquet.schema import Content, Field
from polycnc.parquet.writer import Writer
from tests.kernels.strict import strict

if TYPE_CHECKING:
    from collections.abc import Sequence

FIELDS = [
    Field("kind", Content.NAME),
    Field("line", Content.WHOLE),
    Field("x", Content.NUMBER),
    Field("never", Content.NUMBER),
    Field("tool", Content.TEXT),
    Field("unsaid", Content.TEXT),
]
NAMES = ["rapid", "feed", "工件", ""]


def written(groups: Sequence[Sequence[tuple[float, int, float, float]]], **metadata: str) -> bytes:
    """Row groups of kind, line, x, tool; NaN is null."""
    stream = io.BytesIO()
    writer = Writer(stream, FIELDS, metadata, "a test")
    for rows in groups:
        kinds, lines, x, tools = zip(*rows, strict=True)
        numbers = array("d", (*kinds, *x, *tools))
        writer.begin(len(rows))
        writer.names(numbers, 0, NAMES)
        writer.whole(array("I", lines))
        writer.numbers(numbers, len(rows))
        writer.nothing()
        writer.names(numbers, 2 * len(rows), NAMES)
        writer.nothing()
    writer.close()
    return stream.getvalue()


def read(content: bytes) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = parquet.read_table(io.BytesIO(content)).to_pylist()
    return found


def expected(groups: Sequence[Sequence[tuple[float, int, float, float]]]) -> list[dict[str, Any]]:
    def text(number: float) -> str | None:
        return None if isnan(number) else NAMES[int(number)]

    return [
        {
            "kind": text(kind), "line": line, "x": None if isnan(x) else x, "never": None, "tool": text(tool),
            "unsaid": None,
        }
        for rows in groups
        for kind, line, x, tool in rows
    ]  # fmt: skip


NUMBER = st.sampled_from([0.0, -0.5, 1.25, 1e300, inf, -inf, nan]) | st.floats(allow_nan=False).map(
    lambda x: x + 0.0
)
NAME = st.sampled_from([0.0, 1.0, 2.0, 3.0, nan])
ROW = st.tuples(NAME, st.integers(0, 2**31 - 1), NUMBER, NAME)


@given(st.lists(st.lists(ROW, min_size=1, max_size=40), max_size=4))
def test_what_was_written_is_read(groups: list[list[tuple[float, int, float, float]]]) -> None:
    assert read(written(groups)) == expected(groups)


@pytest.mark.parametrize("different", [1, 2, 300, 5_000, 40_000], ids=str)
@pytest.mark.parametrize("nulls", [0.0, 0.01, 1.0], ids=str)
def test_long_columns_are_read_with_a_dictionary_and_without(different: int, nulls: float) -> None:
    random = Random(different)
    rows = [
        (1.0, line, nan if random.random() < nulls else random.randrange(different) / 1000, 2.0 * (line % 2))
        for line in range(50_000)
    ]
    content = written([rows, rows[:9]])
    assert read(content) == expected([rows, rows[:9]])
    encodings = parquet.ParquetFile(io.BytesIO(content)).metadata.row_group(0).column(2).encodings
    assert ("RLE_DICTIONARY" in encodings) == (different < 20_000 and nulls < 1.0)


def test_numbers_that_repeat_take_little_room() -> None:
    rows = [(1.0, line, 250.0, nan) for line in range(60_000)]
    assert len(written([rows])) < 6_000


def test_arrow_reads_types_metadata_and_statistics() -> None:
    file = parquet.ParquetFile(
        io.BytesIO(written([[(1.0, 7, 1.0, nan), (0.0, 3, nan, 2.0)]], control="fanuc-m"))
    )
    names = pa.dictionary(pa.int32(), pa.string())
    types = [names, pa.int32(), pa.float64(), pa.float64(), pa.string(), pa.string()]
    fields = [pa.field(field.name, kind) for field, kind in zip(FIELDS, types, strict=True)]
    assert file.schema_arrow.equals(pa.schema(fields, metadata={"control": "fanuc-m"}), check_metadata=True)
    group = file.metadata.row_group(0)
    kind, line, x, _, tool, unsaid = (group.column(i).statistics for i in range(6))
    assert (kind.min, kind.max, kind.null_count) == ("feed", "rapid", 0)
    assert (line.min, line.max) == (3, 7)
    assert x is None
    assert (tool.min, tool.max, tool.null_count) == ("工件", "工件", 1)
    assert (unsaid.has_min_max, unsaid.null_count) == (False, 2)
    assert (file.metadata.num_rows, file.metadata.created_by) == (2, "a test")


def test_a_file_without_rows_has_its_columns() -> None:
    assert parquet.read_table(io.BytesIO(written([]))).column_names == [field.name for field in FIELDS]


def test_a_column_of_many_texts_has_no_dictionary() -> None:
    stream, texts = io.BytesIO(), [f"T{number}" for number in range(20_000)]
    writer = Writer(stream, [Field("text", Content.TEXT)], {}, "a test")
    writer.begin(len(texts))
    writer.names(array("d", range(len(texts))), 0, texts)
    writer.close()
    assert [row["text"] for row in read(stream.getvalue())] == texts


def indexed(
    kernel: Any, values: Sequence[float], slots: array[int], homes: array[int]
) -> tuple[int, list[float]]:
    found, places = array("d", bytes(8 * pages.MOST_VALUES)), array("i", bytes(4 * len(values)))
    count = kernel(array("d", (nan, *values)), 1, len(values), slots, homes, found, places)
    return count, [found[place] for place in places] if count >= 0 else []


def test_what_slots_hold_from_before_does_not_matter() -> None:
    random = Random(1)
    for _ in range(20):
        slots = array("i", (random.randrange(-5, 40) for _ in range(pages.SLOTS)))
        homes = array("i", (random.randrange(pages.SLOTS) for _ in range(pages.MOST_VALUES)))
        values = [random.randrange(30) / 7 for _ in range(100)]
        assert indexed(strict(pages.index_values), values, slots, homes) == (len(set(values)), values)


@pytest.mark.skipif(LIBRARY.lack is not None, reason="kernels are not compiled")
def test_compiled_kernels_find_and_write_the_same() -> None:
    random = Random(2)
    compact, index, pack, steps = (cast("Any", LIBRARY.compiled(each)) for each in Kernels._fields)
    for width in (1, 7, 13):
        places = array("i", (random.randrange(1 << width) for _ in range(1003)))
        values = [place / 3 - 5 for place in places]
        slots, homes = array("i", bytes(4 * pages.SLOTS)), array("i", bytes(4 * pages.MOST_VALUES))
        assert indexed(index, values, slots, homes) == indexed(
            strict(pages.index_values), values, slots, homes
        )
        plain, made = array("B", bytes(2000)), array("B", bytes(2000))
        assert pack(places, 1003, width, made) == strict(pages.pack_places)(places, 1003, width, plain)
        assert made == plain
        with_nulls = array("d", (nan if random.random() < 0.3 else value for value in values))
        other = with_nulls[:]
        assert compact(with_nulls, 2, 900, made) == strict(pages.drop_nulls)(other, 2, 900, plain)
        assert (made, with_nulls.tobytes()) == (plain, other.tobytes())
        found, plainly, held = array("q", (0, 0)), array("q", (0, 0)), array("q", bytes(8 * (pages.PART + 2)))
        words, room = array("I", (*places, 2**31 - 1, 0, 0)), array("B", bytes(9000))
        size = steps(words, held, room, found)
        other_room = array("B", bytes(9000))
        assert strict(pages.put_steps)(words, held, other_room, plainly) == size
        assert (room, found) == (other_room, plainly)
