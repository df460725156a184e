"""The columns of a table show what the displays show row by row."""

from __future__ import annotations

from array import array
from math import isnan, nan
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.geometry.frames import rotation
from polycnc.machine.layout import AxisLayout
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.columns import compiled, numbers, shown
from polycnc.toolpath.columns.names import TEXTS, flattened, table_columns
from polycnc.toolpath.columns.numbers import Numbers
from polycnc.toolpath.events import Message, SpindleSpeed, ToolSelection
from polycnc.toolpath.export import arrow_table
from polycnc.toolpath.modes import FeedMode
from tests.kernels.strict import strict
from tests.toolpath.paths import Z_UP, Draft

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.toolpath.table import Chunk
    from polycnc.toolpath.trace import Display

AXES = ("X", "Y", "Z", "C")
LAYOUT = AxisLayout((0, 1, 2), rotary=frozenset({3}), modulo=frozenset({3}))
LATHE = AxisLayout((0, -1, 1), rotary=frozenset({3}))
CONTEXTS = (
    Context(),
    Context(tool=7, inch=True, diameter_axes=1, feed_mode=FeedMode.INVERSE_TIME),
    Context(tool_name="DRILL", frame=rotation(2, 30.0), offsets=(1.0, -2.5, 0.125, 90.0)),
    Context(frame=rotation(0, 12.5), machine_diameters=2, offsets=(0.0, 3.0, 0.0, 0.0)),
)
TILTED = (0.6, 0.0, 0.8)
CURVES = {
    Kind.CW: (10.0, 0.25, -3.0, *Z_UP, 0.0),
    Kind.HELIX_CCW: (1.0, -0.0, 2.0, *TILTED, 2.0),
    Kind.DWELL: (1.5, 0.0),
    Kind.THREAD: (2.5, 90.0),
    Kind.TAP: (1.25, 0.0, 4.0, 5.0, 6.0, *Z_UP),
}
EVENTS = (ToolSelection(12), ToolSelection('T"é'), Message("工件"), SpindleSpeed(800.0, 1))
PLACE = st.floats(-1e9, 1e9) | st.floats(-400, 400).map(lambda value: round(value, 3))
MOVES = (
    st.sampled_from([Kind.RAPID, Kind.FEED, *CURVES, *EVENTS]),
    st.sampled_from(CONTEXTS),
    st.tuples(PLACE, PLACE, PLACE, PLACE),
    st.sampled_from([nan, 0.125, 12.0]),
)
MOVE = st.tuples(*MOVES)


def drawn(moves: Iterable[tuple[object, Context, tuple[float, ...], float]]) -> Draft:
    draft = Draft(AXES, chunk_rows=9)
    for what, context, end, feed in moves:
        draft.under(context)
        if isinstance(what, Kind):
            draft.move(what, *end, feed=feed, curve=CURVES.get(what, ()))
        else:
            draft.event(what)  # type: ignore[arg-type]
    return draft


def by_columns(display: Display) -> list[dict[str, object]]:
    made, rows = Numbers(display), list[dict[str, object]]()
    for chunk in display.toolpath.chunks:
        if len(chunk):
            made.take(chunk)
            rows += [shown_in(made, chunk, row, table_columns(display)) for row in range(len(chunk))]
    return rows


def shown_in(made: Numbers, chunk: Chunk, row: int, names: tuple[str, ...]) -> dict[str, object]:
    found: dict[str, object] = {"line": chunk.line[row]}
    for name in names:
        place = None if name == "line" else made.place(name)
        value = nan if place is None else made.table[place + row]
        if not isnan(value):
            has_texts = name in ("type", "program", "unit", *TEXTS)
            found[name] = made.texts(name)[int(value)] if has_texts else value
    return found


def by_rows(display: Display) -> list[dict[str, object]]:
    names = table_columns(display)
    rows: list[dict[str, object]] = []
    for row in display.toolpath.rows():
        flat = {name: value for name, value in flattened(display.record(row)).items() if name in names}
        tool = row.context.tool_name or row.context.tool or None
        if tool is not None:
            flat.setdefault("tool", tool)
        rows.append({name: str(value) if name in TEXTS else value for name, value in flat.items()})
    return rows


@pytest.mark.parametrize("way", ["compiled", "plain", "numpy"])
@given(moves=st.lists(MOVE, max_size=20), layout=st.sampled_from([LAYOUT, LATHE]))
def test_columns_show_the_very_values_of_rows(
    way: str, moves: list[tuple[object, Context, tuple[float, ...], float]], layout: AxisLayout
) -> None:
    display = drawn(moves).display(layout)
    with pytest.MonkeyPatch.context() as patch:
        if way == "plain":
            patch.setattr(numbers, "show", lambda: strict(shown.show))
        patch.setattr(Numbers, "_is_for_numpy", lambda _self, _chunk: way == "numpy")
        assert by_columns(display) == by_rows(display)


#: Axes that the work display calls otherwise: by the name of another, or by one that no axis has; one is used up.
NAMED = (
    Context(names=("XX", "X", "Z", ""), tool=3),
    Context(names=("X", "C", "Z", "Y"), diameter_axes=1),
    Context(names=("X", "YY", "Z", "C"), inch=True, offsets=(1.0, -2.5, 0.125, 90.0)),
)


@given(moves=st.lists(st.tuples(MOVES[0], st.sampled_from((*CONTEXTS, *NAMED)), *MOVES[2:]), max_size=20))
def test_values_stand_in_the_columns_of_the_names_that_the_display_gives_them(
    moves: list[tuple[object, Context, tuple[float, ...], float]],
) -> None:
    display = drawn(moves).display(LAYOUT, ("XX", "YY", "X"))
    assert table_columns(display)[4:10] == ("x", "y", "z", "c", "xx", "yy")
    assert by_columns(display) == by_rows(display)
    table = arrow_table(display, display.toolpath.chunks, {}).to_pylist()
    present = [{name: value for name, value in row.items() if value is not None} for row in table]
    assert present == by_rows(display)


def test_long_chunks_go_by_the_kernel_alone_where_it_is_compiled() -> None:
    draft = Draft()
    for row in range(10_000):
        draft.move(Kind.FEED, row, 0, 0)
    is_for_numpy = Numbers(draft.display())._is_for_numpy(draft.toolpath.chunk)
    assert is_for_numpy == (compiled.LIBRARY.lack is not None)


def test_more_contexts_than_views_are_kept_of(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(numbers, "_MOST_VIEWS", 2)
    draft = Draft()
    for tool in range(9):
        draft.under(Context(tool=tool % 5)).move(Kind.FEED, tool, 0, 0)
    display = draft.display()
    assert by_columns(display) == by_rows(display)


def test_columns_hold_their_room_from_chunk_to_chunk() -> None:
    draft = Draft()
    made = Numbers(draft.display())
    for rows in (3, 8, 5):
        for row in range(rows):
            draft.move(Kind.FEED, row, rows, 0)
        made.take(draft.toolpath.chunk)
        draft.toolpath._next_chunk()
        place = made.place("y")
        assert place is not None
        assert made.table[place : place + rows] == array("d", [rows] * rows)
