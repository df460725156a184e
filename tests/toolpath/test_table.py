"""Columns of rows."""

from __future__ import annotations

import random
from itertools import groupby

import pytest

from polycnc.toolpath.table import FEW_ROWS, Chunk


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
