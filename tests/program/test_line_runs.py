"""Numbers of lines as runs are those lines."""

from __future__ import annotations

from bisect import bisect_left
from itertools import groupby

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.program.line_runs import LineRuns


def runs_of(lines: list[int]) -> list[range]:
    parts = [
        [line for _, line in part]
        for _, part in groupby(enumerate(lines), key=lambda placed: placed[1] - placed[0])
    ]
    return [range(part[0], part[-1] + 1) for part in parts]


@given(st.lists(st.integers(0, 60), unique=True).map(sorted), st.data())
def test_runs_are_the_lines_however_they_are_cut(lines: list[int], data: st.DataObject) -> None:
    cut = []
    for run in runs_of(lines):
        at = data.draw(st.integers(run.start, run.stop - 1))
        cut += [part for part in (range(run.start, at), range(at, run.stop)) if part]
    runs = LineRuns(cut)
    assert list(runs) == lines
    assert runs[1:3] == lines[1:3]
    assert len(runs) == len(lines)
    wanted = data.draw(st.integers(0, 61))
    assert bisect_left(runs, wanted) == bisect_left(lines, wanted)
    for beyond in (-1, len(lines)):
        with pytest.raises(IndexError):
            runs[beyond]
