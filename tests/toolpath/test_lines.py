"""Rows as text: every number as `repr` writes it."""

from __future__ import annotations

import io
from array import array
from math import nan

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from polycnc.machine.layout import AxisLayout
from polycnc.toolpath import Context, Kind, lines
from polycnc.toolpath.digits import LONGEST_NUMBER, STEPS, fill, put_number, put_whole
from polycnc.toolpath.events import Message
from polycnc.toolpath.export import Csv, JsonLines
from tests.kernels.strict import strict
from tests.toolpath.paths import Z_UP, Draft


@given(steps=st.integers(-(10**15) + 1, 10**15 - 1) | st.integers(-2_000, 2_000))
@example(1_000)
@example(-999)
@example(1_230_000_000)
def test_numbers_of_steps_are_written_with_the_fewest_digits(steps: int) -> None:
    text = array("B", bytes(LONGEST_NUMBER))
    end = put_number(steps / STEPS, text, 0)
    assert text[:end].tobytes().decode() == repr(steps / STEPS)


@pytest.mark.parametrize("value", [nan, 1e8, -1e300, 0.1 + 0.2, 1e-8])
def test_other_numbers_are_left_to_python(value: float) -> None:
    assert put_number(value, array("B", bytes(LONGEST_NUMBER)), 0) == -1


@given(st.integers(0, 2**32 - 1))
def test_lines_are_whole_numbers(line: int) -> None:
    text = array("B", bytes(LONGEST_NUMBER))
    assert text[: put_whole(line, text, 0)].tobytes().decode() == str(line)


LATHE = AxisLayout((0, 1, 2), rotary=frozenset({3}), modulo=frozenset({3}))
CONTEXTS = (
    Context(),
    Context(inch=True, diameter_axes=1),
    Context(knot=True),
    Context(names=("X", "", "Z", "A")),
)
PLACE = st.floats(-1e9, 1e9) | st.floats(-400, 400).map(lambda value: round(value, 3))
MOVE = st.tuples(
    st.sampled_from([Kind.RAPID, Kind.FEED, Kind.CW, Kind.HELIX_CCW, Kind.DWELL, Kind.EVENT]),
    st.sampled_from(CONTEXTS),
    PLACE,
    PLACE,
    st.sampled_from([nan, 0.125, 12.0]),
    st.sampled_from([0.0, 2.0]),
)


@given(st.lists(MOVE, max_size=30), st.sampled_from([Csv, JsonLines]))
def test_long_chunks_are_written_as_short_ones_are(
    moves: list[tuple[Kind, Context, float, float, float, float]], writer: type[Csv | JsonLines]
) -> None:
    """Row by row, by templates, and by the kernel."""
    pytest.importorskip("numpy")
    draft = Draft(("X", "Y", "Z", "C"), chunk_rows=12)
    draft.toolpath.programs[0] = '50 %, "é" %d'
    for kind, context, x, y, feed, turns in moves:
        draft.under(context)
        if kind is Kind.EVENT:
            draft.event(Message("工件"))
            continue
        curve = {Kind.DWELL: (1.5, 0.0)}.get(kind, (x, 0.25, y, *Z_UP, turns))
        is_straight = kind in (Kind.RAPID, Kind.FEED)
        draft.move(kind, x, y, 5.0, x + y, feed=feed, curve=() if is_straight else curve)
        draft.line -= context.knot and turns > 0.0  # a motion of several rows, or one that is broken off

    def written() -> bytes:
        stream = io.BytesIO()
        made = writer(stream, draft.display(LATHE, ("A",)), {})
        for chunk in draft.toolpath.chunks:
            made.take(chunk)
        return stream.getvalue()

    by_row = written()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(lines, "COLUMN_ROWS", 1)
        for way in (None, strict(fill)):
            patch.setattr(lines, "fill", lambda way=way: way)
            for room in (1, 1 << 20):
                patch.setattr(lines, "_TEXT_BYTES", room)
                assert written() == by_row
