"""Room for what the kernel writes is as large as the work asks for."""

from __future__ import annotations

from polycnc.language.bulk.buffers import FIRST_OTHERS, FIRST_ROWS, MORE_ROOM, Room
from polycnc.language.bulk.layout import NoteRecord, Scan
from polycnc.toolpath.kinds import CURVE_WIDTH


def test_room_for_rows_grows_with_the_rows_that_have_come() -> None:
    room = Room(3, 4 * FIRST_ROWS)
    for _ in range(MORE_ROOM):
        assert room.rows == FIRST_ROWS
        room.make_fit(Scan(rows=FIRST_ROWS))
    assert room.rows == MORE_ROOM * FIRST_ROWS
    assert [len(column) for column in room.columns[:6]] == [room.rows] * 4 + [3 * room.rows, room.rows]
    columns = room.columns
    room.make_fit(Scan(rows=100 * room.rows))
    assert room.rows == 4 * FIRST_ROWS
    assert room.columns is columns


def test_notes_and_curves_have_room_of_their_own() -> None:
    room = Room(2, 16_384)
    kinds = room.columns.kind
    room.make_fit(Scan(curves=FIRST_OTHERS))
    room.make_fit(Scan(notes=FIRST_OTHERS))
    assert (room.rows, room.curves, room.notes) == (
        FIRST_ROWS,
        MORE_ROOM * FIRST_OTHERS,
        MORE_ROOM * FIRST_OTHERS,
    )
    assert len(room.columns.curves) == room.curves * CURVE_WIDTH
    assert (len(room.columns.notes), len(room.columns.said)) == (room.notes * NoteRecord.SIZE, room.notes * 3)
    assert room.columns.kind is kinds
    assert [len(view) for view in room.views] == [len(column) * column.itemsize for column in room.table]


def test_there_is_never_more_room_than_is_allowed() -> None:
    room = Room(3, 5)
    room.make_fit(Scan(rows=5, curves=5, notes=5))
    room.make_fit(Scan(rows=500, curves=5, notes=5))
    assert (room.rows, room.curves, room.notes) == (5, 5, 5)
