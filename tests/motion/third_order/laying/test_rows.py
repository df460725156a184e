"""Rows of a toolpath become stretches of runs, from one standstill to the next; single straight rows become pieces."""

from __future__ import annotations

from dataclasses import replace
from math import pi
from typing import TYPE_CHECKING

import pytest

from polycnc.motion import Settings
from polycnc.motion.kernels.columns import Form, PieceRecord, piece_width
from polycnc.motion.planner import Planner
from polycnc.motion.third_order.laying import leading
from polycnc.motion.third_order.parts import part_of
from polycnc.motion.third_order.runs import RunPlanner
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.context import Pace
from polycnc.toolpath.events import Stop
from polycnc.toolpath.modes import AccelerationMode, CornerMode
from tests.motion.jerk_paths import jerk_paths
from tests.motion.paths import MILL, Build

if TYPE_CHECKING:
    from array import array

    from polycnc.motion.third_order.bends.stretches import Stretches
    from tests.motion.jerk_paths import JerkPath

SOFT = Settings(acceleration=AccelerationMode.JERK_LIMITED, bends_by_way=True, rapid_stops=False)
ROUNDED = Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.05)
#: Paths whose axes rest at their corners, for that takes less time (`laying/resting.py`), and those of other runs.
OTHERS = ("line of", "spiral", "zigzag 20", "zigzag 10 mm, 90", "square", "hexagon")
COLUMNS = ("way", "place", "leave", "arrive", "form", "tolerance")


class Runs:
    """What the planner of runs would have got: the stretches of each run."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.runs: list[list[Stretches]] = []
        noted = self.runs

        class Noted(RunPlanner):
            def take(self, chunk: Stretches, *, closed: bool = False) -> None:
                noted[-1].append(part_of(chunk, 0, len(chunk.form)))
                super().take(chunk, closed=closed)

        def begun(*args: object, **named: object) -> Noted:
            noted.append([])
            return Noted(*args, **named)  # type: ignore[arg-type]

        monkeypatch.setattr(leading, "RunPlanner", begun)

    def of(self, build: Build, settings: Settings = SOFT) -> list[list[Stretches]]:
        self.runs.clear()
        build.plan(MILL, settings=settings)
        return self.runs

    def rows(self, build: Build, settings: Settings = SOFT) -> list[list[int]]:
        return [sorted({row for chunk in run for row in chunk.row}) for run in self.of(build, settings)]


def joined(run: list[Stretches], name: str) -> list[float]:
    """A column of a run; in that of ways and places a chunk begins with what the one before has ended with."""
    known = {"way": 1, "place": 3}.get(name, 0)
    found = list(getattr(run[0], name))
    for chunk in run[1:]:
        found += list(getattr(chunk, name))[known:]
    return found


@pytest.mark.parametrize("path", [path for path in jerk_paths() if not path.name.startswith(OTHERS)], ids=str)
def test_stretches_are_those_of_the_programmed_path(path: JerkPath, monkeypatch: pytest.MonkeyPatch) -> None:
    (run,) = Runs(monkeypatch).of(path.rows, replace(SOFT, rapid_stops=True))
    wanted = path.programmed.path
    for name in COLUMNS:
        assert joined(run, name) == pytest.approx(list(getattr(wanted, name)), rel=1e-9, abs=1e-9), name


class Slow(Build):
    """Rows that are so slow that the axes need not rest at a corner."""

    def feed(self, *end: float, feed: float = 10.0) -> Build:
        return super().feed(*end, feed=feed)


def zigzag(count: int, **of_context: object) -> Build:
    build = Slow(context=replace(ROUNDED, **of_context))  # type: ignore[arg-type]
    for k in range(count):
        build.feed(5.0 * (k + 1), 5.0 * (k % 2), 0.0)
    return build


def test_a_run_leads_from_standstill_to_standstill(monkeypatch: pytest.MonkeyPatch) -> None:
    build = zigzag(3)  # rows 0 to 2
    build.set(corner_mode=CornerMode.EXACT_STOP).feed(30.0, 0.0, 0.0)
    build.set(corner_mode=CornerMode.ROUNDED).feed(40.0, 5.0, 0.0).feed(50.0, 0.0, 0.0)
    build.row(Kind.DWELL, *build.end, feed=0.5)
    build.feed(60.0, 5.0, 0.0).feed(70.0, 0.0, 0.0)
    build.feed(60.0, 4.9, 0.0).feed(55.0, 0.0, 0.0)  # it turns back
    build.set(spindle_rpm=500.0, spindle_direction=1).feed(60.0, 0.0, 0.0).feed(65.0, 5.0, 0.0)
    assert Runs(monkeypatch).rows(build) == [[0, 1, 2, 3], [4, 5], [7, 8], [9, 10], [11, 12]]


def test_a_straight_row_alone_is_a_piece_with_averages_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    build = zigzag(4, corner_mode=CornerMode.EXACT_STOP)
    forms: list[float] = []

    def note(pieces: array[float], count: int) -> None:
        forms.extend(pieces[k * piece_width(3) + PieceRecord.FORM] for k in range(count))

    runs = Runs(monkeypatch)
    Planner(build.toolpath, MILL, settings=SOFT, on_pieces=note).finish()
    assert forms == [Form.STRAIGHT] * 4
    assert not runs.runs
    by_averages = build.plan(MILL, settings=replace(SOFT, bends_by_way=False))
    assert build.plan(MILL, settings=SOFT).row_s.tolist() == by_averages.row_s.tolist()


def test_an_arc_alone_is_a_run(monkeypatch: pytest.MonkeyPatch) -> None:
    build = Build(context=ROUNDED).arc(20.0, 0.0, 0.0, center=(10.0, 0.0))
    (run,) = Runs(monkeypatch).of(build)
    assert joined(run, "way")[-1] == pytest.approx(10.0 * pi, rel=1e-6)


def test_threads_and_rapids_that_stop_are_no_part_of_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    build = zigzag(2)
    build.row(Kind.THREAD, 20.0, 0.0, 0.0, feed=float("nan"), curve=(1.0,))
    build.feed(25.0, 5.0, 0.0).feed(30.0, 0.0, 0.0).rapid(40.0, 0.0, 0.0).feed(45.0, 5.0, 0.0).feed(
        50.0, 0.0, 0.0
    )
    runs = Runs(monkeypatch)
    assert runs.rows(build) == [[0, 1], [3, 4, 5, 6, 7]]
    assert runs.rows(build, replace(SOFT, rapid_stops=True)) == [[0, 1], [3, 4], [6, 7]]


def test_a_rapid_goes_as_fast_as_its_axes_and_a_cut_as_its_feed(monkeypatch: pytest.MonkeyPatch) -> None:
    build = Slow(context=ROUNDED).rapid(30.0, 0.0, 0.0).feed(30.0, 40.0, 0.0)
    (run,) = Runs(monkeypatch).of(build)
    assert joined(run, "cap2") == pytest.approx([MILL.axes[0].rapid ** 2, 100.0])


def test_what_the_program_makes_of_speeds_holds_by_row(monkeypatch: pytest.MonkeyPatch) -> None:
    build = zigzag(2)
    build.set(pace=Pace(feed=0.5, acceleration=(0.4, 1.0, 1.0))).feed(15.0, 0.0, 5.0).feed(20.0, 0.0, 5.0)
    (run,) = Runs(monkeypatch).of(build)
    assert joined(run, "cap2") == pytest.approx([100.0, 100.0, 25.0, 25.0])
    assert joined(run, "ease")[:2] == [1.0, 1.0]
    assert joined(run, "ease")[3] == pytest.approx(0.4)


def test_a_corner_that_is_rounded_from_a_distance_on_has_the_tolerance_of_that(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    build = Slow(context=Context(corner_mode=CornerMode.ROUNDED_FROM, tolerance_mm=0.6))
    build.feed(10.0, 0.0, 0.0).feed(10.0, 10.0, 0.0)
    (run,) = Runs(monkeypatch).of(build)
    assert joined(run, "tolerance") == pytest.approx([2.0**0.5 * 0.6 / 6.0] * 2)


def test_an_event_at_which_the_axes_stand_ends_a_run(monkeypatch: pytest.MonkeyPatch) -> None:
    build = zigzag(2)
    build.event(Stop("M00"))
    build.feed(15.0, 0.0, 0.0).feed(20.0, 5.0, 0.0)
    assert Runs(monkeypatch).rows(build) == [[0, 1], [3, 4]]
