from __future__ import annotations

import csv
import io
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.geometry.frames import rotation
from polycnc.machine.layout import AxisLayout
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.columns.names import flattened
from polycnc.toolpath.events import Auxiliary, Message, ToolSelection
from polycnc.toolpath.export import WRITERS, Csv, JsonLines, Parquet, arrow_table
from polycnc.toolpath.modes import FeedMode
from tests.toolpath.paths import Z_UP, Draft


@pytest.fixture
def draft() -> Draft:
    draft = Draft(chunk_rows=2)
    draft.event(ToolSelection(2))
    draft.move(Kind.RAPID, 10, -0.0, 5.000000000001)
    draft.move(Kind.CW, 20, 10, 5, feed=2, curve=(20, 0, 5, *Z_UP, 0))
    draft.event(Message("工件, 完成"))
    return draft.under(Context(inch=True)).move(Kind.FEED, 25.4, 0, 0, feed=1)


def written_text(writer: type[JsonLines | Csv], draft: Draft) -> str:
    stream = io.BytesIO()
    made = writer(stream, draft.display(), {})
    for chunk in draft.toolpath.chunks:
        made.take(chunk)
    made.close()
    return stream.getvalue().decode()


def test_json_lines_hold_one_object_a_row_in_order(draft: Draft) -> None:
    records = [json.loads(line) for line in written_text(JsonLines, draft).splitlines()]
    assert records == list(draft.display().records())
    assert len(records) == 5


def test_rounding_noise_and_negative_zero_are_not_written(draft: Draft) -> None:
    line = written_text(JsonLines, draft).splitlines()[1]
    assert '"to": {"X": 10.0, "Y": 0.0, "Z": 5.0}' in line


def test_csv_has_a_column_for_every_value_and_leaves_empty_what_a_row_does_not_have(draft: Draft) -> None:
    rows = list(csv.DictReader(io.StringIO(written_text(Csv, draft))))
    assert rows[0]["tool"] == "2"
    assert rows[0]["x"] == ""
    assert (rows[2]["center_x"], rows[2]["center_z"], rows[2]["feed"]) == ("20.0", "", "120.0")
    assert rows[3]["text"] == "工件, 完成"
    assert (rows[4]["unit"], rows[4]["x"]) == ("inch", "1.0")


def test_csv_of_a_run_without_rows_still_has_its_header() -> None:
    assert written_text(Csv, Draft()).startswith("type,program,line,unit,x,y,z,")


def test_an_arrow_table_holds_the_same_values_with_null_for_what_is_absent(draft: Draft) -> None:
    display = draft.display()
    table = arrow_table(display, draft.toolpath.chunks, {"control": "fanuc-m"})
    rows = table.to_pylist()
    assert [row["type"] for row in rows] == ["t", "rapid", "cw", "message", "feed"]
    assert rows[1]["feed"] is None
    assert rows[2]["center_y"] == 0
    assert (rows[4]["x"], rows[4]["unit"]) == (1.0, "inch")
    assert rows[0]["x"] is None
    assert rows[0]["tool"] == "2"
    assert table.schema.metadata == {b"control": b"fanuc-m"}


def test_a_motion_of_several_rows_is_one_row_of_every_table() -> None:
    draft = Draft(chunk_rows=3)
    knot = Context(knot=True)
    assert knot.is_hidden
    draft.under(knot)
    for x in range(1, 4):
        draft.end = [x, 0.0, 0.0]
        draft.toolpath.append(Kind.FEED, draft.program, 1, draft.context, 100.0, draft.end)
    draft.event(Message("broken off"))
    draft.toolpath.append(Kind.FEED, draft.program, 5, draft.context, 100.0, [4.0, 0.0, 0.0])
    draft.under(Context()).line = 4
    draft.move(Kind.CW, 20, 10, 5, feed=2, curve=(20, 0, 5, *Z_UP, 0)).event(Message("end"))
    records = list(draft.display().records())
    assert [record.get("to", {}).get("X") for record in records] == [3.0, None, 20.0, None]
    table = arrow_table(draft.display(), draft.toolpath.chunks, {}).to_pylist()
    assert [{key: value for key, value in row.items() if value is not None} for row in table] == [
        flattened(record) for record in records
    ]
    assert len(written_text(Csv, draft).splitlines()) == 1 + len(records)
    from pyarrow import parquet

    stream = io.BytesIO()
    writer = Parquet(stream, draft.display(), {})
    for chunk in draft.toolpath.chunks:
        writer.take(chunk)
    writer.close()
    assert parquet.read_table(stream).to_pylist() == table


ROW = st.tuples(
    st.sampled_from([Kind.RAPID, Kind.FEED, Kind.THREAD]), *[st.floats(-1e4, 1e4)] * 3, st.floats(0.01, 99)
)


@given(
    rows=st.lists(ROW, max_size=12),
    inch=st.booleans(),
    mode=st.sampled_from(FeedMode),
    angle=st.floats(-360, 360),
    diameter=st.integers(0, 15),
)
def test_whole_columns_show_the_very_values_of_single_rows(
    rows: list[tuple[Kind, float, float, float, float]],
    inch: bool,
    mode: FeedMode,
    angle: float,
    diameter: int,
) -> None:
    layout = AxisLayout((0, 1, -1), rotary=frozenset({3}), modulo=frozenset({3}))
    draft = Draft(("X", "Y", "Z", "C"), chunk_rows=5)
    moved = Context(
        frame=rotation(2, angle), offsets=(1, 2, 3, 4), inch=inch, feed_mode=mode, diameter_axes=diameter
    )
    draft.event(Auxiliary(3))
    for number, (kind, x, y, c, feed) in enumerate(rows):
        draft.under((Context(), moved)[number % 2]).move(kind, x, y, 5, c, feed=feed)
    display = draft.display(layout)
    by_row = list(display.records())
    by_column = [record for chunk in draft.toolpath.chunks for record in display._records_by_column(chunk)]
    assert by_column == by_row
    table = arrow_table(display, draft.toolpath.chunks, {}).to_pylist()
    present = [{key: value for key, value in row.items() if value is not None} for row in table]
    assert present == [{**flattened(record), **CODE_AS_TEXT.get(record["type"], {})} for record in by_row]


CODE_AS_TEXT = {"m": {"code": "3"}}


def test_parquet_reads_back_as_the_arrow_table(draft: Draft) -> None:
    from pyarrow import parquet

    stream = io.BytesIO()
    writer = Parquet(stream, draft.display(), {"control": "fanuc-m"})
    for chunk in draft.toolpath.chunks:
        writer.take(chunk)
    writer.close()
    display = draft.display()
    expected = arrow_table(display, draft.toolpath.chunks, {"control": "fanuc-m"})
    read = parquet.read_table(io.BytesIO(stream.getvalue()))
    assert read.to_pylist() == expected.to_pylist()
    assert read.schema.equals(expected.schema, check_metadata=True)


def test_every_suffix_that_the_command_line_offers_has_a_writer() -> None:
    from polycnc.cli.commands.run import TRACES

    assert set(WRITERS) == set(TRACES)
