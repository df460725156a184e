"""With limited jerk no axis exceeds a limit at any sample, and no rounded path leaves its tolerance."""

from __future__ import annotations

import itertools
from dataclasses import replace
from math import cos, hypot, sin, sqrt
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from polycnc.motion import Settings
from polycnc.motion.kernels.columns import PieceRecord, piece_width
from polycnc.motion.limits import EXACT_MM, averages
from polycnc.motion.planner import Planner
from polycnc.motion.sampling.run import Run
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.modes import AccelerationMode, CornerMode, FeedMode
from tests.examples import examples
from tests.motion.paths import MILL, MILL4, Build
from tests.motion.test_limits import UNEVEN, arc, build, line, spiral, spline

if TYPE_CHECKING:
    from polycnc.machine import Machine

SOFT = Settings(acceleration=AccelerationMode.JERK_LIMITED)
PERIOD = 0.001
#: Sampled values come from sums of many terms.
SLACK = 1.0 + 1e-6
#: Third differences of positions over a millisecond have fewer digits.
OF_PLACES = 1.0 + 1e-5

short = st.floats(-2.0, 2.0)
contexts = st.sampled_from(
    [
        Context(corner_mode=CornerMode.CONTINUOUS),
        Context(corner_mode=CornerMode.EXACT_STOP),
        Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.005),
        Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.1),
        Context(corner_mode=CornerMode.ROUNDED_FROM, tolerance_mm=0.5),
    ]
)
machines = st.sampled_from([MILL, UNEVEN])


def runs(rows: Build, machine: Machine, lead: Settings = SOFT) -> tuple[float, list[Run]]:
    """Planned time, and the runs of a toolpath under one context."""
    n, found = len(rows.toolpath.axes), list[Any]()
    width = piece_width(n)
    planner = Planner(
        rows.toolpath,
        machine,
        settings=lead,
        compiled=False,
        on_pieces=lambda pieces, count: found.append(np.array(pieces[: count * width]).reshape(count, width)),
    )
    total = planner.finish().total_s
    if not found:
        return total, []
    pieces = np.concatenate(found)
    starts = [*np.flatnonzero(pieces[:, PieceRecord.SPEED2] == 0.0).tolist(), len(pieces)]
    return total, [Run(pieces[a:b], n) for a, b in itertools.pairwise(starts)]


def check(rows: Build, machine: Machine) -> None:
    """Every axis within its limits, by the differences of positions too; planned time and that of the runs agree."""
    total, found = runs(rows, machine)
    assert sum(run.seconds for run in found) == pytest.approx(total, rel=1e-6)
    for run in found:
        times = np.arange(0.0, min(run.seconds, 20.0), PERIOD)
        places, velocity, acceleration = run.at(times)
        jerk = np.diff(acceleration, axis=0) / PERIOD
        for i, axis in enumerate(machine.axes):
            for order, limit in enumerate((axis.max_feed, axis.acceleration, axis.jerk), 1):
                changes = np.abs(np.diff(places[:, i], order)) / PERIOD**order
                assert changes.max(initial=0.0) <= limit * OF_PLACES
            assert np.abs(velocity[:, i]).max() <= axis.max_feed * SLACK
            assert np.abs(acceleration[:, i]).max() <= axis.acceleration * SLACK
            assert np.abs(jerk[:, i]).max(initial=0.0) <= axis.jerk * SLACK


@settings(max_examples=500 if settings.get_current_profile_name() == "explore" else 40, deadline=None)
@given(st.lists(st.one_of(line, arc, spiral, spline), min_size=1, max_size=6), contexts, machines)
def test_axes_keep_their_limits_at_every_sample(
    steps: list[tuple[str, float, float, float, float]], context: Context, machine: Machine
) -> None:
    check(build(steps, context), machine)


@settings(max_examples=examples(40), deadline=None)
@given(st.lists(st.tuples(short, short, short), min_size=1, max_size=40), contexts, machines)
def test_axes_keep_their_limits_on_short_lines(
    ways: list[tuple[float, float, float]], context: Context, machine: Machine
) -> None:
    rows = Build(context=context)
    for way in ways:
        rows.feed(*(round(a + b, 3) for a, b in zip(rows.end, way, strict=True)), feed=150.0)
    check(rows, machine)


@settings(max_examples=examples(25), deadline=None)
@given(st.floats(1.0, 30.0), st.floats(0.002, 0.3), st.floats(0.0, 0.02), st.integers(0, 9), contexts)
def test_axes_keep_their_limits_on_facets_of_a_circle(
    radius: float, angle: float, noise: float, seed: int, context: Context
) -> None:
    check(facets(radius, angle, noise, seed, context), UNEVEN)


#: Lines of such lengths, each turned against the one before it by as much: two short ones are near to one another where
#: the average sees a long one on the other side.
UNEVEN_LENGTHS = (
    2.84,
    3.47,
    2.86,
    3.36,
    4.19,
    1.98,
    3.69,
    1.45,
    4.65,
    2.54,
    2.98,
    2.23,
    3.11,
    1.97,
    3.71,
    3.91,
    2.0,
    1.93,
)


@settings(max_examples=examples(8), deadline=None)
@given(
    st.lists(st.floats(0.3, 3.0), min_size=5, max_size=12).map(tuple),
    st.floats(0.1, 4.0),
    st.floats(0.005, 0.3),
    st.sampled_from([0.002, 0.01, 0.05, 0.2]),
)
@example(UNEVEN_LENGTHS, 1.0, 0.0501, 0.05)
def test_axes_keep_their_limits_on_lines_of_uneven_lengths(
    lengths: tuple[float, ...], step: float, turn: float, tolerance: float
) -> None:
    rows, x, y = Build(context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=tolerance)), 0.0, 0.0
    for k, length in enumerate(lengths):
        heading = 0.74 + turn * k
        x, y = x + step * length * cos(heading), y + step * length * sin(heading)
        rows.feed(x, y, 0.0, feed=1000.0)
    check(rows, MILL)


@settings(max_examples=examples(25), deadline=None)
@given(
    st.floats(0.1, 30.0),
    st.floats(0.1, 0.6),
    st.integers(3, 20),
    st.sampled_from([1.0, 100.0, 1e6]),
    contexts,
)
def test_axes_keep_their_limits_on_splines_of_few_points(
    radius: float, angle: float, points: int, feed: float, context: Context
) -> None:
    """A chord turns much: bounds that begin on it must not cut it before its end is known."""
    rows = Build(context=context).feed(0.3 * radius, 0.1 * radius, 0.0, feed=feed)
    x, y, _ = rows.end
    for k in range(1, points + 1):
        grown = radius * (1.0 + 0.3 * sin(3.0 * k / points))
        rows.row(Kind.SPLINE, x + grown * sin(k * angle), y + radius - grown * cos(k * angle), 0.0, feed=feed)
    check(rows, MILL)


@settings(max_examples=examples(60), deadline=None)
@given(
    st.lists(st.tuples(st.floats(0.2, 30.0), st.floats(-0.6, 0.6)), min_size=3, max_size=20),
    st.floats(0.0, 6.2),
    st.sampled_from([AccelerationMode.CONSTANT, AccelerationMode.JERK_LIMITED]),
)
def test_axes_keep_their_velocity_between_the_points_of_a_coarse_spline(
    chords: list[tuple[float, float]], heading: float, acceleration: AccelerationMode
) -> None:
    """Chords of any lengths that turn to either side, at the velocity of the axes."""
    swift = replace(MILL, axes=tuple(replace(axis, max_feed=20.0) for axis in MILL.axes))
    rows = Build(context=Context(acceleration=acceleration))
    for length, turn in chords:
        x, y, z = rows.end
        heading += turn
        rows.row(Kind.SPLINE, x + length * cos(heading), y + length * sin(heading), z, feed=1e6)
    _, found = runs(rows, swift)
    for run in found:
        velocity = run.at(np.arange(0.0, min(run.seconds, 20.0), PERIOD))[1]
        for i, axis in enumerate(swift.axes):
            assert np.abs(velocity[:, i]).max() <= axis.max_feed * SLACK


@pytest.mark.parametrize("tolerance", [0.002, 0.2])
def test_an_axis_that_stands_costs_no_time(tolerance: float) -> None:
    """A weak rotary axis beside lines, arcs, facets and a spline."""

    def seconds(pull: float) -> float:
        rows = Build(
            axes=("X", "Y", "Z", "A"), context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=tolerance)
        )
        rows.feed(5.0, 0.0, 0.0, 0.0).arc(6.0, 1.0, 0.0, 0.0, center=(5.0, 1.0)).feed(6.0, 1.03, 0.0, 0.0)
        rows.arc(5.98, 1.05, 0.0, 0.0, center=(5.98, 1.03)).feed(5.9, 1.05, 0.0, 0.0)
        for k in range(9):
            rows.row(Kind.SPLINE, 5.8 - 0.4 * k, 1.06 + 0.02 * k * k, 0.0, 0.0)
        turning = replace(MILL4.axes[3], acceleration=pull, jerk=20.0 * pull)
        return rows.plan(replace(MILL4, axes=(*MILL.axes, turning)), settings=SOFT).total_s

    assert seconds(10.0) == pytest.approx(seconds(1e6), rel=1e-9)


@pytest.mark.parametrize("growth", [0.0, -4.0, 10.0])
@pytest.mark.parametrize(("turn", "radius"), [(8.0, 0.3), (90.0, 10.0), (-20.0, 40.0)])
def test_a_rotary_axis_that_turns_with_an_arc_keeps_its_limits(
    turn: float, radius: float, growth: float
) -> None:
    """On arcs and spirals of any size, between two lines along which it stands."""
    rows = Build(axes=("X", "Y", "Z", "A"), context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.1))
    rows.feed(5.0, 0.0, 0.0, 0.0).arc(5.0 + radius, radius, 0.0, turn, center=(5.0, radius), feed=300.0)
    rows.arc(
        5.0, 2.0 * radius + max(growth, -0.4 * radius), 0.0, 3.0 * turn, center=(5.0, radius), feed=300.0
    )
    rows.feed(0.0, 2.0 * radius + max(growth, -0.4 * radius), 0.0, 3.0 * turn)
    check(rows, MILL4)


@settings(max_examples=300 if settings.get_current_profile_name() == "explore" else 40, deadline=None)
@given(
    st.lists(st.tuples(st.floats(0.05, 8.0), st.floats(-0.5, 0.5)), min_size=2, max_size=24),
    st.floats(0.0, 1.0),
    contexts,
    machines,
)
def test_splines_of_any_chords_keep_limits_and_tolerance(
    chords: list[tuple[float, float]], evenness: float, context: Context, machine: Machine
) -> None:
    """From chords of one length that turn alike to chords of any length that turn to either side, between two lines."""
    rows, heading = Build(context=context).feed(5.0, 0.0, 0.0, feed=300.0), 0.0
    for length, turn in chords:
        heading += evenness * chords[0][1] + (1.0 - evenness) * turn
        way = evenness * chords[0][0] + (1.0 - evenness) * length
        x, y, z = rows.end
        rows.row(Kind.SPLINE, x + way * cos(heading), y + way * sin(heading), z + 0.02 * way, feed=300.0)
    rows.feed(rows.end[0] + 5.0 * cos(heading), rows.end[1] + 5.0 * sin(heading), rows.end[2], feed=300.0)
    check(rows, machine)
    blend = averages(context, machine, SOFT)[1]
    for run in runs(rows, machine)[1]:
        assert stray(run, blend) <= (context.tolerance_mm or EXACT_MM) * SLACK


@pytest.mark.parametrize(("chord", "longer"), [(0.02, 1.05), (0.05, 1.1), (0.2, 1.5)])
def test_a_spline_takes_little_longer_than_the_arc_through_its_points(chord: float, longer: float) -> None:
    """Twice round a circle: only at its ends, where a chord has no neighbour, does the spline differ from the arc."""
    context = Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.01)
    around, spline_rows = Build(context=context), Build(context=context)
    around.arc(0.0, 0.0, 0.0, center=(0.0, 20.0), feed=1000.0, turns=1.0)
    for k in range(1, round(12.5 / chord) + 1):
        spline_rows.row(Kind.SPLINE, 20.0 * sin(k * chord), 20.0 * (1.0 - cos(k * chord)), 0.0, feed=1000.0)
    arc_s = around.plan(MILL, settings=SOFT).total_s
    assert spline_rows.plan(MILL, settings=SOFT).total_s < longer * arc_s


def facets(radius: float, angle: float, noise: float, seed: int, context: Context) -> Build:
    """A circle in short lines, as a CAM system writes it, a little off."""
    off = np.random.default_rng(seed).uniform(-noise, noise, (120, 2))
    rows = Build(context=context)
    for k, (dx, dy) in enumerate(off.tolist(), start=1):
        rows.feed(radius * sin(k * angle) + dx, radius * (1.0 - cos(k * angle)) + dy, 0.01 * k, feed=200.0)
    return rows


def stray(run: Run, blend: float) -> float:
    """Largest distance (mm) of the run's samples from its path."""
    times = np.arange(0.0, min(run.seconds, 10.0), 5.0 * PERIOD)
    near = np.linspace(-blend, blend, 61)
    exact = run.on_path((times[:, None] + near[None, :]).ravel()).reshape(len(times), len(near), -1)
    chord, way = exact[:, 1:] - exact[:, :-1], run.at(times)[0][:, None, :] - exact[:, :-1]
    share = np.clip((chord * way).sum(-1) / np.maximum((chord**2).sum(-1), 1e-300), 0.0, 1.0)
    return float(np.sqrt(((way - share[..., None] * chord) ** 2).sum(-1)).min(1).max())


@settings(max_examples=examples(40), deadline=None)
@given(st.lists(st.one_of(line, arc, spiral, spline), min_size=2, max_size=6), contexts, machines)
def test_a_rounded_path_never_leaves_its_tolerance(
    steps: list[tuple[str, float, float, float, float]], context: Context, machine: Machine
) -> None:
    tolerance = context.tolerance_mm or EXACT_MM
    blend = averages(context, machine, SOFT)[1]
    for run in runs(build(steps, context), machine)[1]:
        assert stray(run, blend) <= tolerance * SLACK


@settings(max_examples=examples(25), deadline=None)
@given(st.lists(st.tuples(short, short, short), min_size=2, max_size=30), st.sampled_from([0.002, 0.02, 0.2]))
def test_short_lines_are_rounded_within_their_tolerance(
    ways: list[tuple[float, float, float]], tolerance: float
) -> None:
    rows = Build(context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=tolerance))
    for way in ways:
        rows.feed(*(round(a + b, 3) for a, b in zip(rows.end, way, strict=True)), feed=150.0)
    blend = averages(rows.context, MILL, SOFT)[1]
    for run in runs(rows, MILL)[1]:
        assert stray(run, blend) <= tolerance * SLACK


def off_lines(places: np.ndarray, points: np.ndarray) -> float:
    """Largest distance of places from the lines through points, mm."""
    nearest = np.full(len(places), np.inf)
    for first, last in itertools.pairwise(points):
        way = last - first
        share = np.clip((places - first) @ way / max(float(way @ way), 1e-300), 0.0, 1.0)
        nearest = np.minimum(nearest, ((places - first - share[:, None] * way) ** 2).sum(1))
    return float(np.sqrt(nearest.max()))


@settings(max_examples=200 if settings.get_current_profile_name() == "explore" else 25, deadline=None)
@given(
    st.floats(0.02, 2.0),
    st.floats(-0.5, 0.5),
    st.lists(st.tuples(st.floats(0.5, 1.5), st.floats(-1.0, 1.0)), min_size=3, max_size=40),
    st.sampled_from([0.0, 0.05, 1.0]),
    contexts,
    machines,
)
def test_facets_keep_limits_and_stay_within_the_tolerance_of_the_programmed_lines(
    length: float,
    turn: float,
    others: list[tuple[float, float]],
    unevenness: float,
    context: Context,
    machine: Machine,
) -> None:
    """Facets of a curve between two longer lines, from even ones to any; a sharp corner in the middle of them."""
    points, heading = [(0.0, 0.0, 0.0), (3.0, 0.0, 0.0)], 0.0
    for k, (longer, more) in enumerate(others):
        heading += (
            turn + unevenness * more * abs(turn) + (1.5 if k == len(others) // 2 and turn > 0.3 else 0.0)
        )
        way = length * (1.0 + unevenness * (longer - 1.0))
        x, y, z = points[-1]
        points.append((x + way * cos(heading), y + way * sin(heading), z))
    points.append((points[-1][0] + 3.0 * cos(heading), points[-1][1] + 3.0 * sin(heading), 0.0))
    rows = Build(context=context)
    for point in points[1:]:
        rows.feed(*point, feed=400.0)
    check(rows, machine)
    for run in runs(rows, machine)[1]:
        places = run.at(np.arange(0.0, min(run.seconds, 10.0), 5.0 * PERIOD))[0]
        assert off_lines(places, np.array(points)) <= (context.tolerance_mm or EXACT_MM) * SLACK


@pytest.mark.parametrize("tolerance", [0.005, 0.02, 0.1])
def test_a_slow_corner_does_not_change_the_time_of_an_arc_far_behind_it(tolerance: float) -> None:
    def arc_s(turn: float) -> float:
        rows = Build(context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=tolerance))
        rows.feed(-60.0 - 20.0 * cos(turn), -20.0 * sin(turn), 0.0).feed(-60.0, 0.0, 0.0).feed(0.0, 0.0, 0.0)
        rows.arc(0.0, 20.0, 0.0, center=(0.0, 10.0)).feed(-60.0, 20.0, 0.0)
        return rows.plan(MILL, settings=SOFT).row_s[3]

    assert arc_s(1.5) == pytest.approx(arc_s(0.0), rel=1e-6)


def facet_circle(step: float, tolerance: float) -> float:
    rows = Build(context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=tolerance))
    for k in range(1, round(60.0 / step) + 1):
        rows.feed(10.0 * sin(0.1 * step * k), 10.0 * (1.0 - cos(0.1 * step * k)), 0.0, feed=1000.0)
    return rows.plan(MILL, settings=SOFT).total_s


def test_facets_of_a_circle_take_little_longer_than_the_circle() -> None:
    arc = Build(context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.01))
    arc.arc(0.0, 0.0, 0.0, center=(0.0, 10.0), feed=1000.0)
    assert facet_circle(0.2, 0.01) < 1.15 * arc.plan(MILL, settings=SOFT).total_s


def short_zigzag(tolerance: float) -> float:
    rows = Build(context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=tolerance))
    for k in range(1, 21):
        rows.feed(1.4 * k, 1.4 * (k % 2), 0.0, feed=20.0)
    return rows.plan(MILL, settings=SOFT).total_s


@pytest.mark.parametrize(
    ("seconds", "tolerances"),
    [
        (lambda tolerance: facet_circle(0.2, tolerance), (0.002, 0.005, 0.01, 0.02, 0.05)),
        (short_zigzag, (0.002, 0.01, 0.05, 0.1, 0.2)),
    ],
)
def test_a_larger_tolerance_never_takes_longer(seconds: Any, tolerances: tuple[float, ...]) -> None:
    found = [seconds(tolerance) for tolerance in tolerances]
    for less, more in itertools.pairwise(found):
        assert more <= less * (1.0 + 1e-9)


def test_a_corner_is_rounded_at_all() -> None:
    rows = Build(context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.1))
    rows.feed(20.0, 0.0, 0.0).feed(36.0, 4.0, 0.0)
    (run,) = runs(rows, MILL)[1]
    assert 0.005 < stray(run, averages(rows.context, MILL, SOFT)[1]) <= 0.1


@settings(max_examples=examples(40), deadline=None)
@given(st.lists(st.one_of(line, arc, spiral), min_size=1, max_size=6), contexts)
def test_limited_jerk_never_saves_time(
    steps: list[tuple[str, float, float, float, float]], context: Context
) -> None:
    rows = build(steps, context)
    brisk = replace(SOFT, acceleration=AccelerationMode.CONSTANT)
    assert rows.plan(UNEVEN, settings=SOFT).total_s >= rows.plan(UNEVEN, settings=brisk).total_s * (
        1.0 - 1e-9
    )


def test_a_long_way_takes_its_ramps_longer() -> None:
    """From rest to rest: as without limited jerk, and the time in which the acceleration is built up."""
    rows = Build(context=Context(corner_mode=CornerMode.EXACT_STOP)).rapid(400.0, 0.0, 0.0)
    x = MILL.axis["X"]
    expected = 400.0 / x.rapid + x.rapid / x.acceleration + x.acceleration / x.jerk
    assert rows.plan(MILL, settings=SOFT).total_s == pytest.approx(expected)


def test_the_context_chooses_brisk_or_soft() -> None:
    brisk = (
        Build(context=Context(acceleration=AccelerationMode.CONSTANT))
        .feed(20.0, 0.0, 0.0)
        .plan(MILL, settings=SOFT)
    )
    soft = Build(context=Context(acceleration=AccelerationMode.JERK_LIMITED)).feed(20.0, 0.0, 0.0).plan(MILL)
    assert soft.total_s > brisk.total_s + 0.05


def test_drive_accelerates_less_where_an_axis_may_become_fast() -> None:
    lead = Settings(drive_speed=0.5, drive_reduction=0.5)
    top = MILL.axis["X"].max_feed

    def seconds(feed: float, acceleration: AccelerationMode) -> float:
        rows = Build(context=Context(acceleration=acceleration)).feed(100.0, 0.0, 0.0, feed=feed)
        return rows.plan(MILL, settings=lead).total_s

    pull = MILL.axis["X"].acceleration
    brisk, drive = AccelerationMode.CONSTANT, AccelerationMode.REDUCED_AT_SPEED
    assert seconds(0.4 * top, drive) == seconds(0.4 * top, brisk)
    assert seconds(0.8 * top, drive) - seconds(0.8 * top, brisk) == pytest.approx(0.8 * top / pull)


@pytest.mark.parametrize("kind", ["arc", "helix", "spline", "per revolution"])
def test_drive_acts_on_every_kind_of_path(kind: str) -> None:
    """From rest at a feed above the part of the velocity; below it DRIVE is BRISK."""
    lead = Settings(drive_speed=0.5, drive_reduction=0.5)
    top = MILL.axis["X"].max_feed

    def seconds(feed: float, acceleration: AccelerationMode) -> float:
        rows = Build(context=Context(acceleration=acceleration, corner_mode=CornerMode.CONTINUOUS))
        if kind == "per revolution":
            rows.set(feed_mode=FeedMode.PER_REVOLUTION, spindle_rpm=600.0, spindle_direction=1)
            rows.feed(300.0, 0.0, 0.0, feed=feed / 10.0)
        elif kind == "spline":
            for k in range(1, 201):
                rows.row(Kind.SPLINE, 2.0 * k, 40.0 * (1.0 - cos(0.01 * k)), 0.0, feed=feed)
        else:
            rise = 5.0 if kind == "helix" else 0.0
            curve = (0.0, 200.0, 0.0, 0.0, 0.0, 1.0, 0.0)
            rows.row(Kind.HELIX_CCW if rise else Kind.CCW, 200.0, 200.0, rise, feed=feed, curve=curve)
        return rows.plan(MILL, settings=lead).times.cutting_s

    pull = MILL.axis["X"].acceleration
    assert seconds(0.4 * top, AccelerationMode.REDUCED_AT_SPEED) == seconds(
        0.4 * top, AccelerationMode.CONSTANT
    )
    longer = seconds(0.8 * top, AccelerationMode.REDUCED_AT_SPEED) - seconds(
        0.8 * top, AccelerationMode.CONSTANT
    )
    assert 0.3 * 0.8 * top / pull < longer <= 1.2 * 0.8 * top / pull


def test_the_pieces_of_a_cut_line_make_up_the_line() -> None:
    context = Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.1)
    rows = Build(context=context).feed(30.0, 0.0, 0.0).feed(60.0, 4.0, 0.0)
    lengths: list[float] = []
    width = piece_width(3)

    def note(pieces: Any, count: int) -> None:
        lengths.extend(pieces[k * width + PieceRecord.LENGTH] for k in range(count))

    rows.plan(MILL, settings=SOFT, on_pieces=note)
    assert len(lengths) > 2
    assert sum(lengths) == pytest.approx(30.0 + hypot(30.0, 4.0))


def least_seconds(length: float, top: float, pull: float, jerk: float) -> float:
    """Least time from rest to rest within speed, acceleration and jerk: seven phases, some of them empty.

    Up to a speed v it takes `v/pull + pull/jerk` on half of that at v on average, or `2·√(v/jerk)` where v is too small
    to reach the acceleration; v is the highest speed that leaves room for getting up to it and down again.
    """

    def rise(speed: float) -> float:
        return speed / pull + pull / jerk if speed * jerk >= pull * pull else 2.0 * sqrt(speed / jerk)

    slow, fast = 0.0, top
    if top * rise(top) > length:
        for _ in range(200):
            middle = 0.5 * (slow + fast)
            slow, fast = (middle, fast) if middle * rise(middle) <= length else (slow, middle)
    return length / fast + rise(fast)


@given(
    st.floats(0.001, 2000.0), st.floats(1.0, 1000.0), st.floats(100.0, 20_000.0), st.floats(1e3, 1e6)
)  # fmt: skip
def test_a_line_from_rest_to_rest_takes_the_least_time(
    length: float, top: float, pull: float, jerk: float
) -> None:
    axes = tuple(replace(a, acceleration=pull, rapid=top, max_feed=top, jerk=jerk) for a in MILL.axes)
    machine = replace(MILL, axes=axes)
    least = least_seconds(length, top, pull, jerk)
    rest = Context(corner_mode=CornerMode.EXACT_STOP)
    for lead in (SOFT, replace(SOFT, rapid_by_axis=True)):
        assert Build(context=rest).rapid(length, 0.0, 0.0).plan(
            machine, settings=lead
        ).total_s == pytest.approx(least, rel=1e-6)
    cut = Build(context=rest).feed(length, 0.0, 0.0, feed=0.5 * top)
    assert cut.plan(machine, settings=SOFT).total_s == pytest.approx(
        least_seconds(length, 0.5 * top, pull, jerk), rel=1e-6
    )


@settings(max_examples=examples(40), deadline=None)
@given(st.tuples(st.floats(-60.0, 60.0), st.floats(-60.0, 60.0), st.floats(-60.0, 60.0)))
def test_a_rapid_of_each_axis_alone_takes_as_long_as_its_slowest_axis(
    way: tuple[float, float, float],
) -> None:
    least = max(
        least_seconds(abs(part), axis.rapid, axis.acceleration, axis.jerk)
        for part, axis in zip(way, UNEVEN.axes, strict=True)
    )
    lead = replace(SOFT, rapid_by_axis=True)
    assert Build().rapid(*way).plan(UNEVEN, settings=lead).total_s == pytest.approx(least, rel=1e-6)


@pytest.mark.parametrize("pieces", [2, 20, 1000])
@pytest.mark.parametrize(("length", "feed"), [(100.0, 20.0), (100.0, 1e4), (2.0, 400.0)])
def test_short_lines_in_one_direction_take_as_long_as_one_line(
    length: float, feed: float, pieces: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("polycnc.motion.planner.FULL_ROOM", 256)

    def seconds(count: int) -> float:
        rows = Build(context=Context(corner_mode=CornerMode.CONTINUOUS))
        for k in range(1, count + 1):
            rows.feed(0.8 * length * k / count, 0.6 * length * k / count, 0.0, feed=feed)
        return rows.plan(MILL, settings=SOFT, compiled=False).total_s

    assert seconds(pieces) == pytest.approx(seconds(1), rel=1e-9)


@settings(max_examples=examples(25), deadline=None)
@given(
    st.lists(
        st.tuples(st.floats(0.001, 5.0), st.sampled_from([0, 0, 0, 1]), st.booleans()),
        min_size=2,
        max_size=20,
    ),
    contexts,
)
def test_axes_keep_their_limits_where_straight_runs_change_direction_or_feed(
    steps: list[tuple[float, int, bool]], context: Context
) -> None:
    rows, angle = Build(context=context), 0.3
    for way, turn, is_slow in steps:
        angle += 0.5 * turn
        x, y, _ = rows.end
        rows.feed(x + way * cos(angle), y + way * sin(angle), 0.0, feed=60.0 if is_slow else 300.0)
    check(rows, UNEVEN)


def test_a_slow_corner_before_an_arc_does_not_slow_down_the_arc() -> None:
    alone, after_corner = (Build(context=Context(corner_mode=CornerMode.CONTINUOUS)) for _ in range(2))
    alone.arc(20.0, 0.0, 0.0, center=(10.0, 0.0))
    after_corner.feed(-10.0, 0.0, 0.0).feed(0.0, 0.0, 0.0).arc(20.0, 0.0, 0.0, center=(10.0, 0.0))
    after_corner.toolpath.block_boundary()
    corner = (
        Build(context=Context(corner_mode=CornerMode.CONTINUOUS)).feed(-10.0, 0.0, 0.0).feed(0.0, 0.0, 0.0)
    )
    lines = corner.plan(MILL, settings=SOFT).total_s
    total = after_corner.plan(MILL, settings=SOFT).total_s
    assert total < lines + alone.plan(MILL, settings=SOFT).total_s + 0.1


def test_a_bent_piece_that_is_cut_keeps_its_curve() -> None:
    rows = (
        Build(context=Context(corner_mode=CornerMode.CONTINUOUS))
        .feed(10.0, 0.0, 0.0)
        .arc(30.0, 0.0, 0.0, center=(20.0, 0.0))
    )
    run = runs(rows, MILL)[1][-1]
    path = run.on_path(np.linspace(0.0, run.seconds, 4000))
    on_arc = path[(path[:, 1] < -0.05)]
    assert len(on_arc) > 100
    assert np.abs(np.hypot(on_arc[:, 0] - 20.0, on_arc[:, 1]) - 10.0).max() < 1e-4


def test_resting_at_a_sharp_corner_is_chosen_where_it_takes_less_time() -> None:
    zigzag = Build(context=Context(corner_mode=CornerMode.CONTINUOUS))
    for k in range(1, 9):
        zigzag.feed(0.5 * k, 0.5 * (k % 2), 0.0)
    stops = Build(context=Context(corner_mode=CornerMode.EXACT_STOP))
    for k in range(1, 9):
        stops.feed(0.5 * k, 0.5 * (k % 2), 0.0)
    assert zigzag.plan(MILL, settings=SOFT).total_s <= stops.plan(MILL, settings=SOFT).total_s * (1.0 + 1e-9)
