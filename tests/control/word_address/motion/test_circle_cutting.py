"""Circles as one block."""

from __future__ import annotations

from polycnc.toolpath import Kind
from tests.support import moves, run


def test_circle_cutting_is_tangential_and_ends_where_it_began() -> None:
    rows = moves(run("G0 X4. Y4.\nG13 I10. D1 F100\nM30\n", "meldas-m", setup={"tools": {1: {"radius": 2}}}))
    assert [row.kind for row in rows[1:]] == [Kind.CCW] * 3
    assert rows[-1].end[:2] == rows[0].end[:2]
    assert rows[1].end[:2] == (12.0, 4.0)
