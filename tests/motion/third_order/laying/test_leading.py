"""Runs led by a law in the planner: the same however rows come, and what belongs to which row, tool and window."""

from __future__ import annotations

from itertools import pairwise
from math import cos, sin
from typing import TYPE_CHECKING

import numpy as np
import pytest

from polycnc.motion import Settings
from polycnc.motion.kernels.columns import Form, PieceRecord, piece_width
from polycnc.motion.planner import Planner
from polycnc.motion.sampling.run import Run
from polycnc.motion.third_order import runs
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.modes import AccelerationMode, CornerMode
from tests.motion.paths import MILL, Build

if TYPE_CHECKING:
    from array import array

SOFT = Settings(acceleration=AccelerationMode.JERK_LIMITED, bends_by_way=True, rapid_stops=False)
ROUNDED = Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.05)


def mixed(chunk_rows: int = 65_536) -> Build:
    """Runs, rows alone, arcs, threads, dwells, two tools."""
    build = Build(context=ROUNDED, chunk_rows=chunk_rows)
    for tool in (1, 2):
        build.set(tool=tool)
        for k in range(6):
            build.feed(5.0 * k, 3.0 * (k % 2), 0.0, feed=60.0)
        build.arc(35.0, 3.0, 0.0, center=(30.0, 3.0), feed=60.0)
        build.rapid(35.0, 20.0, 0.0)
        build.row(Kind.DWELL, *build.end, feed=0.5)
        build.feed(0.0, 0.0, 0.0)
        build.row(Kind.DWELL, *build.end, feed=0.5)
        build.row(Kind.THREAD, 5.0, 0.0, 0.0, feed=float("nan"), curve=(1.0,))
    return build


def facets(count: int) -> Build:
    build = Build(context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.01))
    for k in range(1, count + 1):
        angle = 0.02 * k
        build.feed(10.0 * sin(angle), 10.0 * (1.0 - cos(angle)), 0.001 * k, feed=60.0)
    return build


@pytest.mark.parametrize("chunk_rows", [1, 3, 5])
def test_however_rows_come_they_take_as_long(chunk_rows: int) -> None:
    whole, parts = (mixed(rows).plan(MILL, settings=SOFT) for rows in (65_536, chunk_rows))
    assert parts.row_s.tolist() == whole.row_s.tolist()
    assert parts.row_mm.tolist() == whole.row_mm.tolist()


def test_rows_and_tools_add_up() -> None:
    plan = mixed().plan(MILL, settings=SOFT)
    assert sum(plan.row_s) == pytest.approx(plan.total_s, rel=1e-12)
    first, second = plan.tools
    assert first.times.cutting_mm == pytest.approx(second.times.cutting_mm, rel=0.3)
    assert first.times.rapid_s > 0.0
    assert first.times.cutting_s > first.times.rapid_s


def test_a_run_in_windows_is_one_motion(monkeypatch: pytest.MonkeyPatch) -> None:
    """Records of all windows lead on from each other in time, place and speed."""
    monkeypatch.setattr(runs, "Sizes", lambda: SMALL)
    build = facets(400)
    records: list[array[float]] = []

    def note(pieces: array[float], count: int) -> None:
        width = piece_width(3)
        records.extend(pieces[k * width : (k + 1) * width] for k in range(count))

    planner = Planner(build.toolpath, MILL, settings=SOFT, on_pieces=note)
    plan = planner.finish()
    assert {record[PieceRecord.FORM] for record in records} == {Form.JERKED}
    assert sum(record[PieceRecord.TIME] for record in records) == pytest.approx(plan.total_s, rel=1e-12)
    for before, behind in pairwise(records):
        assert behind[PieceRecord.SPEED2] == pytest.approx(before[PieceRecord.END2], abs=1e-6)
        assert behind[-6:-3].tolist() == pytest.approx(before[-3:].tolist(), abs=1e-9)
    assert Run(np.array(records), 3).seconds == pytest.approx(plan.total_s, rel=1e-12)


SMALL = runs.Sizes(stretches=60, seconds=0.2, most=200, range=16, around=16)


def test_rows_that_are_dropped_have_been_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(runs, "Sizes", lambda: SMALL)
    build = facets(400)
    kept = Planner(build.toolpath, MILL, settings=SOFT).finish()
    dropped = Planner(build.toolpath, MILL, settings=SOFT, keep_rows=False).finish()
    assert dropped.total_s == kept.total_s
