"""Rows of a run by law: found by number and by way, bounded by what the operator has set, forgotten when done."""

from __future__ import annotations

from math import inf

from polycnc.mainrun.preparation.items import Move
from polycnc.mainrun.preparation.law_rows import LawRows
from tests.mainrun.support import execution_of, power_on

TEXT = "SOFT G642 G1 X20 F6000\nX40 Y1\nG0 X60\nG1 X80\nX85 Y1.2\nM30\n"


def rows_of(text: str, *, rapid: float = 1.0) -> LawRows:
    """All rows of a program that is prepared."""
    virtual = power_on(text, "sinumerik-840d")
    virtual.override(rapid=rapid)
    execution = execution_of(virtual)
    virtual.set_switches(single_block=True)  # the first block alone is taken
    virtual.cycle_start()
    execution.preprocessing.fill_on()
    rows = LawRows(3, execution.rates)
    for item in execution.preprocessing.items:
        if isinstance(item, Move):
            assert rows.add(item, execution.preprocessing.contexts)
    return rows


def test_rows_lie_behind_one_another() -> None:
    rows = rows_of(TEXT)
    assert [row.begin for row in rows.rows[1:]] == [row.end for row in rows.rows[:-1]]
    for row in rows.rows:
        assert rows.find(row.move.row) is row
    for row in rows.rows[1:]:
        assert rows.number_from(row.begin) == row.move.row
    assert rows.find(-1.0) is None
    assert rows.number_from(rows.rows[-1].end) == inf
    assert not rows.bars


def test_the_speed_is_what_is_asked_for_or_what_the_axes_allow() -> None:
    rows = rows_of(TEXT)
    line = next(row for row in rows.rows if not row.move.rapid)
    assert rows.cap2(line.begin, line.end, asked=True) == 100.0**2
    assert rows.cap2(line.begin, line.end, asked=False) == line.top2 > 100.0**2


def test_a_row_that_may_not_be_run_now_bars_the_way() -> None:
    rows = rows_of(TEXT, rapid=0.0)
    barred = next(row for row in rows.rows if row.move.rapid)
    assert rows.bars
    assert rows.barred_from(0.0, inf) == barred.begin
    assert rows.barred_from(0.0, 0.5 * barred.begin) == inf
    assert rows.barred_from(barred.begin, inf) == inf, "it is the row itself"


def test_rows_that_are_done_are_forgotten() -> None:
    rows = rows_of(TEXT)
    done, last = rows.rows[0], rows.rows[-1]
    rows.forget(last)
    assert rows.rows == [last]
    assert rows.find(done.move.row) is None
    assert rows.find(last.move.row) is last
