"""Planning chunk by chunk, plain and compiled."""

from __future__ import annotations

import ast
import inspect
import subprocess
import sys
from array import array
from math import cos, nan, sin
from typing import TYPE_CHECKING

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from polycnc.motion import Plan, Settings
from polycnc.motion import planner as planner_module
from polycnc.motion.compiled import LIBRARY, Kernels, plain
from polycnc.motion.planner import Planner
from polycnc.toolpath import Context, Kind, Toolpath
from polycnc.toolpath.events import Auxiliary
from polycnc.toolpath.modes import AccelerationMode, CornerMode
from tests.examples import examples
from tests.kernels.strict import strict
from tests.motion.paths import MILL, Build
from tests.motion.test_limits import UNEVEN

if TYPE_CHECKING:
    from polycnc.toolpath.table import Chunk


CORNERS = (CornerMode.CONTINUOUS, CornerMode.EXACT_STOP, CornerMode.ROUNDED)


def varied(rows: int, chunk_rows: int = 65_536) -> Build:
    """Lines, arcs, splines, rapids, dwells, events and changing contexts."""
    build = Build(chunk_rows=chunk_rows)
    k = 0
    while len(build.toolpath) < rows:
        k += 1
        x, y = round(30.0 * sin(0.7 * k), 3), round(20.0 * cos(1.1 * k), 3)
        build.set(
            tolerance_mm=0.01 * (k % 3),
            corner_mode=CORNERS[k // 5 % 3],
            tool=1 + k // 40,
        )
        build.feed(x, y, 0.01 * k, feed=60.0 + k % 50)
        if k % 3 == 0:
            build.arc(x, y + 4.0, 0.01 * k, center=(x, y + 2.0), feed=150.0, turns=float(k % 2))
        if k % 4 == 0:
            for j in range(1, 12):
                build.row(Kind.SPLINE, x + 0.3 * j, y + sin(0.3 * j), 0.01 * k, feed=200.0)
        if k % 7 == 0:
            build.rapid(x, y, 10.0).rapid(0.0, 0.0, 10.0)
        if k % 11 == 0:
            build.set(spindle_rpm=1000.0 + k, spindle_direction=1).event(Auxiliary(3)).dwell(seconds=0.1)
        if k % 13 == 0:
            build.event(Auxiliary(8)).feed(x, y, 0.01 * k + 1.0)
    return build


def bits(plan: Plan) -> tuple[object, ...]:
    """Everything of a plan that must not depend on how it was made."""
    return plan.row_s.tobytes(), plan.times, plan.tools, plan.rows_without_feed


@pytest.mark.parametrize("chunk_rows", [1, 7, 1000])
def test_chunks_do_not_change_the_result(chunk_rows: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planner_module, "FULL_ROOM", 256)
    whole = varied(1500).plan()
    parts = varied(1500, chunk_rows)
    assert len(parts.toolpath.chunks) > 1
    assert bits(parts.plan()) == bits(whole)


def test_the_room_for_pieces_does_not_change_the_result(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = varied(1500).plan(compiled=False)
    monkeypatch.setattr(planner_module, "FULL_ROOM", 256)
    assert bits(varied(1500).plan(compiled=False)) == bits(whole)


def test_rows_that_are_faster_than_all_before_reach_back_no_farther_than_the_room_keeps(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The joints of the last rows are fast enough to reach over all slow ones, to where the path slows down."""
    lead, angle = Settings(acceleration=AccelerationMode.JERK_LIMITED), 0.3
    build = Build(context=Context(corner_mode=CornerMode.CONTINUOUS))
    for rows, way, turn, feed in (
        (100, 0.3, 0.0005, 20.0),
        (110, 0.05, 0.0005, 2.0),
        (100, 5.0, 0.002, 500.0),
    ):
        for _ in range(rows):
            angle += turn
            x, y, _z = build.end
            build.feed(x + way * cos(angle), y + way * sin(angle), 0.0, feed=feed)
    whole = build.plan(UNEVEN, settings=lead, compiled=False)
    monkeypatch.setattr(planner_module, "FULL_ROOM", 256)
    assert bits(build.plan(UNEVEN, settings=lead, compiled=False)) == bits(whole)


def test_kernels_square_by_products() -> None:
    """Python's power of two may be off the product, which machine code has in its place, by the last bit."""
    for module in LIBRARY.modules:
        for node in ast.walk(ast.parse(inspect.getsource(module))):
            if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
                whole = isinstance(node.right, ast.Constant) and isinstance(node.right.value, int)
                assert not whole, (module.__name__, node.lineno)


@pytest.mark.skipif(LIBRARY.lack is not None, reason="needs compiled kernels")
def test_compiled_kernels_give_the_same_bits(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planner_module, "FULL_ROOM", 256)
    build = varied(1500)
    assert bits(build.plan(compiled=True)) == bits(build.plan(compiled=False))


@pytest.mark.parametrize("acceleration", AccelerationMode)
def test_no_index_counts_from_the_end(
    acceleration: AccelerationMode, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Compiled kernels would read what lies in front of the array."""
    lead = Settings(acceleration=acceleration)
    whole = varied(400).plan(MILL, settings=lead, compiled=False)
    monkeypatch.setattr(planner_module, "plain", lambda: Kernels._make(map(strict, plain())))
    assert bits(varied(400).plan(MILL, settings=lead, compiled=False)) == bits(whole)


def test_a_toolpath_is_planned_while_it_grows() -> None:
    """The chunks are dropped as they are planned; the result is that of the whole."""
    taken: list[int] = []

    def take(chunk: Chunk) -> bool:
        taken.append(len(chunk))
        return planner.take(chunk)

    toolpath = Toolpath(("X", "Y", "Z"), chunk_rows=100, on_full=take)
    planner = Planner(toolpath, MILL)
    for row in varied(1500).toolpath.rows():
        context = toolpath.context_number(row.context)
        if row.event is not None:
            toolpath.append_event(row.event, 0, row.line, context, list(row.end))
        else:
            number = toolpath.add_curve(*row.curve) if row.curve else -1
            toolpath.append(row.kind, 0, row.line, context, row.feed, list(row.end), number)
        toolpath.block_boundary()
    assert len(toolpath.chunks) == 1
    result = planner.finish()
    assert sum(taken) >= 1500
    assert bits(result)[1:] == bits(varied(1500).plan())[1:]


def test_rows_need_not_be_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planner_module, "FULL_ROOM", 256)
    build = varied(1500, 100)
    kept, dropped = build.plan(), build.plan(keep_rows=False)
    assert len(dropped.row_s) == 0
    assert dropped.times == kept.times


def test_a_run_up_over_the_whole_buffer_grows_the_buffer(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing becomes final while every joint hangs on the end: the room doubles until it does."""
    monkeypatch.setattr(planner_module, "FULL_ROOM", 256)
    parts = Build(context=Context(corner_mode=CornerMode.CONTINUOUS))
    for k in range(1, 4001):
        parts.feed(0.001 * k, 0.0, 0.0, feed=400.0)
    whole = Build().feed(4.0, 0.0, 0.0, feed=400.0)
    assert parts.plan().total_s == pytest.approx(whole.plan().total_s, rel=1e-9)


def test_rows_without_a_way_take_no_time_and_stop_nothing() -> None:
    plain = Build().feed(50.0, 0.0, 0.0).feed(100.0, 0.0, 0.0)
    dotted = Build().feed(50.0, 0.0, 0.0).feed(50.0, 0.0, 0.0).feed(100.0, 0.0, 0.0)
    assert dotted.plan().total_s == plain.plan().total_s


def test_an_arc_whose_start_is_its_centre_is_a_line() -> None:
    build = Build().arc(10.0, 0.0, 0.0, center=(0.0, 0.0))
    assert build.plan().times.cutting_mm == pytest.approx(10.0)


def test_numbers_that_are_not_finite_never_end_in_a_traceback() -> None:
    build = (
        Build().feed(10.0, 0.0, 0.0, feed=nan).feed(10.0, 5.0, 0.0, feed=0.0).feed(0.0, 5.0, 0.0, feed=-3.0)
    )
    assert build.plan().rows_without_feed == 3


def test_a_short_program_loads_no_array_library() -> None:
    program = (
        "import sys\n"
        "from polycnc.machine import load_machine\n"
        "from polycnc.motion import plan\n"
        "from polycnc.toolpath import Context, Kind, Toolpath\n"
        "t = Toolpath(('X', 'Y', 'Z'))\n"
        "t.append(Kind.FEED, 0, 1, t.context_number(Context()), 10.0, [5.0, 0.0, 0.0])\n"
        "assert plan(t, load_machine('mill3')).total_s > 0.5\n"
        "print([name for name in ('numpy', 'numba', 'pyarrow') if name in sys.modules])\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_a_feed_profile_takes_the_place_of_programmed_feeds() -> None:
    def half(chunk: Chunk) -> array[float]:
        return array("d", [0.5 * feed for feed in chunk.feed])

    def rows(feed: float) -> Build:
        build = Build(context=Context(tolerance_mm=0.01))
        return build.feed(40.0, 0.0, 0.0, feed=feed).rapid(0.0, 0.0, 0.0).feed(0.0, 30.0, 0.0, feed=feed)

    assert rows(80.0).plan(MILL, feed_profile=half).total_s == rows(40.0).plan(MILL).total_s


@pytest.mark.parametrize("acceleration", [AccelerationMode.CONSTANT, AccelerationMode.JERK_LIMITED])
def test_chunks_give_the_same_bits_with_limited_jerk(acceleration: AccelerationMode) -> None:
    lead = Settings(acceleration=acceleration)
    whole = varied(400).plan(MILL, settings=lead, compiled=False)
    assert varied(400, chunk_rows=1).plan(MILL, settings=lead, compiled=False).row_s == whole.row_s
    assert varied(400, chunk_rows=7).plan(MILL, settings=lead, compiled=True).row_s == whole.row_s


def test_a_small_buffer_gives_almost_the_same_time_with_limited_jerk(monkeypatch: pytest.MonkeyPatch) -> None:
    lead = Settings(acceleration=AccelerationMode.JERK_LIMITED)
    whole = varied(600).plan(MILL, settings=lead, compiled=False).total_s
    monkeypatch.setattr(planner_module, "FULL_ROOM", 256)
    assert varied(600).plan(MILL, settings=lead, compiled=False).total_s == pytest.approx(whole, rel=1e-9)


ARC = st.tuples(
    st.sampled_from([0.2, 1.0, 5.0, 40.0, 300.0]),
    st.floats(0.02, 6.2),
    st.floats(-3.1, 3.1),
    st.sampled_from([0.0, 0.0, 3.0, 300.0]),
    st.sampled_from([0.5, 20.0, 120.0, 400.0]),
)


@settings(max_examples=examples(40), deadline=None)
@given(st.lists(ARC, min_size=1, max_size=8))
@example([(0.2, 1.0, 0.0, 0.0, 0.5), (0.2, 1.5, 1.0, 0.0, 20.0)])
@example([(0.2, 1.0, 0.0, 0.0, 0.5), (1.0, 5.03125, 0.875, 0.0, 20.0), (0.2, 1.0, 0.0, 3.0, 20.0)])
@example(
    [(0.2, sweep, 0.0, 0.0, 0.5) for sweep in (1.0, 2.0, 2.5, 0.75, 1.0)]
    + [(1.0, 5.03125, 0.875, 0.0, 20.0), (0.2, 1.0, 0.0, 3.0, 20.0)]
)
def test_an_even_arc_takes_as_long_unseen(arcs: list[tuple[float, float, float, float, float]]) -> None:
    """Where nobody asks for places, an arc of the same limits is laid in three pieces.

    A bound on the speed may hold for another 1e-5 mm then, which at 0.5 mm/s is 20 µs.
    """
    build, x, y, z = Build(context=Context(tolerance_mm=0.02)), 0.0, 0.0, 0.0
    for radius, sweep, heading, rise, feed in arcs:
        u, v = x + radius * cos(heading), y + radius * sin(heading)
        x, y, z = u - radius * cos(heading + sweep), v - radius * sin(heading + sweep), z + rise
        kind = Kind.HELIX_CCW if rise else Kind.CCW
        build.row(kind, x, y, z, feed=feed, curve=(u, v, 0.0, 0.0, 0.0, 1.0, 0.0))
        build.feed(x + 0.5, y, z, feed=feed)
        x += 0.5
    lead = Settings(acceleration=AccelerationMode.JERK_LIMITED)
    pieces: list[int] = []
    seen = Planner(build.toolpath, MILL, settings=lead, on_pieces=lambda _, count: pieces.append(count))
    unseen = build.plan(MILL, settings=lead)
    assert unseen.row_s.tolist() == pytest.approx(seen.finish().row_s.tolist(), rel=1e-5, abs=2e-5)
