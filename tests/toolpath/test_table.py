"""Columns of rows."""

from __future__ import annotations

import random
from itertools import groupby

import pytest

from polycnc.toolpath import Kind, Toolpath
from polycnc.toolpath.events import Auxiliary, Message
from polycnc.toolpath.table import CHUNK_ROWS, FEW_ROWS, Chunk
from tests.toolpath.paths import Z_UP, Draft


@pytest.mark.parametrize("rows", [0, 1, FEW_ROWS, FEW_ROWS + 1, 5_000])
@pytest.mark.parametrize("most", [1, 2, 700])
def test_runs_of_one_context_are_those_of_looking_at_every_row(rows: int, most: int) -> None:
    chosen, chunk = random.Random(rows + most), Chunk(3, 0)
    while len(chunk) < rows:
        number = chosen.randrange(3)
        for _ in range(min(chosen.randint(1, most), rows - len(chunk))):
            chunk.add(1, 0, 1, number, 0.0, (0.0, 0.0, 0.0), -1)
    wanted, first = [], 0
    for number, group in groupby(chunk.context):
        end = first + len(list(group))
        wanted.append((number, first, end))
        first = end
    assert chunk.context_runs() == wanted


def test_joined_chunks_hold_the_same_rows() -> None:
    draft = Draft(chunk_rows=1)
    draft.event(Auxiliary(3)).move(Kind.FEED, 1, 2, 3, feed=2)
    draft.move(Kind.CW, 20, 10, 5, feed=2, curve=(20, 0, 5, *Z_UP, 0))
    draft.event(Message("a")).event(Message("b")).move(Kind.CCW, 0, 0, 5, curve=(1, 0, 5, *Z_UP, 2))
    draft.event(Message("c"))
    rows = list(draft.display().records())
    joined = draft.toolpath.join_chunks(1)
    assert list(draft.display().records()) == rows
    assert [chunk.first for chunk in draft.toolpath.chunks] == [0, 2, 6]
    assert draft.toolpath.chunks[1:-1] == joined


def test_chunks_are_joined_until_one_is_full() -> None:
    draft = Draft(chunk_rows=CHUNK_ROWS // 2 + 1)
    for _ in range(4 * (CHUNK_ROWS // 2 + 1)):
        draft.move(Kind.FEED, 1, 2, 3)
    assert [len(chunk) for chunk in draft.toolpath.join_chunks(0)] == [CHUNK_ROWS + 2] * 2
    assert [chunk.first for chunk in draft.toolpath.chunks] == [0, CHUNK_ROWS + 2, 2 * CHUNK_ROWS + 4]


def test_what_is_taken_back_counts_no_axis_otherwise_and_begins_no_block() -> None:
    toolpath = Toolpath(("X", "Z"))
    toolpath.recount({0: 5.0})
    back = toolpath.memento()
    toolpath.recount({1: 7.0})
    toolpath.set_block_apart(0)
    assert (toolpath.counts, toolpath.block_starts) == ({0: {0: 5.0, 1: 7.0}}, [0])
    back()
    assert (toolpath.counts, toolpath.block_starts) == ({0: {0: 5.0}}, [])
