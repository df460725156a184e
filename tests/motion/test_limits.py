"""No plan exceeds what an axis can do, and none is quicker than possible."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import cos, pi, sin

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.machine import load_machine
from polycnc.motion import Settings
from polycnc.motion.kernels.chords import PART_MARGIN
from polycnc.motion.kernels.columns import Limits
from polycnc.motion.limits import axis_limits
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.modes import AccelerationMode, CornerMode
from tests.examples import examples
from tests.motion.paths import MILL, MILL4, Build, Piece, pieces_of

coordinate = st.floats(-50.0, 50.0).map(lambda x: round(x, 3))
speed = st.sampled_from([5.0, 40.0, 200.0, 5000.0])
line = st.tuples(st.just("line"), coordinate, coordinate, coordinate, speed)
arc = st.tuples(st.just("arc"), st.floats(0.5, 30.0), st.floats(0.0, 6.2), st.floats(0.05, 12.0), speed)
spiral = st.tuples(st.just("spiral"), st.floats(2.0, 30.0), st.floats(0.0, 6.2), st.floats(0.5, 12.0), speed)
spline = st.tuples(st.just("spline"), st.floats(2.0, 30.0), st.floats(0.0, 6.2), st.floats(0.5, 6.0), speed)
UNEVEN = replace(
    MILL,
    axes=tuple(
        replace(axis, acceleration=a, max_feed=v)
        for axis, a, v in zip(MILL.axes, (3000.0, 1500.0, 600.0), (400.0, 250.0, 150.0), strict=True)
    ),
)


def build(steps: list[tuple[str, float, float, float, float]], context: Context) -> Build:
    """Lines, arcs that start tangentially anywhere, spirals and splines, one behind the other."""
    rows = Build(context=context)
    for name, a, b, c, feed in steps:
        x, y, z = rows.end
        if name == "line":
            rows.feed(a, b, c, feed=feed)
            continue
        cx, cy = x - a * cos(b), y - a * sin(b)
        if name == "spline":
            points = 60
            for k in range(1, points + 1):
                angle, radius = b + c * k / points, a * (1.0 + 0.3 * sin(3.0 * k / points))
                rows.row(Kind.SPLINE, cx + radius * cos(angle), cy + radius * sin(angle), z, feed=feed)
            continue
        radius = a * (1.0 if name == "arc" else 1.5)
        end = (cx + radius * cos(b + c), cy + radius * sin(b + c), z)
        rows.arc(*end, center=(cx, cy), feed=feed, turns=float(int(c / (2.0 * pi))))
    return rows


def check_limits(pieces: list[Piece], limits: Limits, n: int, slack: float, steps: int = 8) -> None:
    tops, pulls = limits.top_feed, limits.acceleration
    for piece in pieces:
        for x, velocity, acceleration in piece.samples(steps):
            assert x <= piece.cap2 * (1.0 + 1e-9)
            for i in range(n):
                assert abs(velocity[i]) <= tops[i] * slack
                assert abs(acceleration[i]) <= pulls[i] * slack


contexts = st.sampled_from(
    [
        Context(corner_mode=CornerMode.CONTINUOUS),
        Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.02),
        Context(corner_mode=CornerMode.EXACT_STOP),
    ]
)


@settings(max_examples=examples(60), deadline=None)
@given(st.lists(st.one_of(line, arc, spiral), min_size=1, max_size=8), contexts)
def test_axes_keep_their_velocity_and_acceleration(
    steps: list[tuple[str, float, float, float, float]], context: Context
) -> None:
    # Arcs carry a margin for what happens between their points; another test looks at the true circle.
    pieces = pieces_of(build(steps, context).toolpath, UNEVEN)
    check_limits(pieces, axis_limits(UNEVEN, 1, ("X", "Y", "Z"), Settings()), 3, 1.0107 * 1.001)


@settings(max_examples=examples(30), deadline=None)
@given(st.lists(st.one_of(line, spline), min_size=1, max_size=4), contexts)
def test_axes_keep_their_limits_on_splines(
    steps: list[tuple[str, float, float, float, float]], context: Context
) -> None:
    # At the ends of pieces: between them the table does not say how the curve bends. Parts of chords carry a margin.
    pieces = pieces_of(build(steps, context).toolpath, UNEVEN)
    slack = 1.0 + PART_MARGIN + 1e-6
    check_limits(pieces, axis_limits(UNEVEN, 1, ("X", "Y", "Z"), Settings()), 3, slack, steps=1)


@settings(max_examples=examples(60), deadline=None)
@given(st.floats(0.2, 30.0), st.floats(0.0, 6.2), st.floats(0.05, 6.2), speed)
def test_on_the_true_circle_axes_keep_their_acceleration(
    radius: float, start: float, angle: float, feed: float
) -> None:
    """The pieces interpolate tangent and curvature; here the arc itself is differentiated."""
    pieces = pieces_of(build([("arc", radius, start, angle, feed)], Context()).toolpath, UNEVEN)
    way = 0.0
    for piece in pieces:
        u = (piece.end2 - piece.start2) / (2.0 * piece.length)
        constant = 2.0 * piece.length / max(piece.start2**0.5 + piece.end2**0.5, 1e-12)
        for k in range(21):
            s = piece.length * k / 20
            x = max(piece.start2 + 2.0 * u * s, 0.0)
            phi = start + (way + s) / radius
            if piece.time < constant * (1.0 - 1e-9):
                continue  # this piece runs over a peak, not under constant acceleration
            for i, (t, c) in enumerate(((-sin(phi), -cos(phi)), (cos(phi), -sin(phi)))):
                limit = UNEVEN.axes[i].acceleration
                assert abs(t * u + c * x / radius) <= limit * (1.0 + 1e-6)
                assert abs(t) * x**0.5 <= UNEVEN.axes[i].max_feed * (1.0 + 1e-6)
        way += piece.length


@settings(max_examples=examples(60), deadline=None)
@given(st.lists(st.one_of(line, arc, spiral, spline), min_size=1, max_size=8), contexts)
def test_no_plan_is_quicker_than_the_feed_and_the_slowest_axis(
    steps: list[tuple[str, float, float, float, float]], context: Context
) -> None:
    rows = build(steps, context)
    planned = rows.plan(UNEVEN)
    assert planned.total_s >= 0.0
    before = [0.0, 0.0, 0.0]
    for row, seconds in zip(rows.toolpath.rows(), planned.row_s, strict=True):
        for i, axis in enumerate(UNEVEN.axes):
            assert seconds >= abs(row.end[i] - before[i]) / axis.max_feed * (1.0 - 1e-9)
        before = list(row.end)
    assert planned.times.cutting_s >= planned.times.cutting_mm / 5000.0


@settings(max_examples=examples(40), deadline=None)
@given(st.lists(st.one_of(line, arc), min_size=2, max_size=6), st.floats(1.1, 3.0))
def test_a_stronger_machine_is_never_slower(
    steps: list[tuple[str, float, float, float, float]], factor: float
) -> None:
    strong = replace(
        UNEVEN, axes=tuple(replace(a, acceleration=a.acceleration * factor) for a in UNEVEN.axes)
    )
    rows = build(steps, Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.01))
    assert rows.plan(strong).total_s <= rows.plan(UNEVEN).total_s * (1.0 + 1e-9)


@settings(max_examples=examples(60), deadline=None)
@given(
    st.lists(st.tuples(coordinate, coordinate, coordinate, st.floats(-90.0, 90.0)), min_size=2, max_size=8),
    st.floats(0.001, 1.0),
)
def test_rotary_axes_keep_their_limits_in_mixed_moves(
    ends: list[tuple[float, float, float, float]], tolerance: float
) -> None:
    rows = Build(axes=("X", "Y", "Z", "A"), context=Context(tolerance_mm=tolerance))
    for end in ends:
        rows.feed(*end, feed=200.0)
    pieces = pieces_of(rows.toolpath, MILL4)
    check_limits(pieces, axis_limits(MILL4, 1, ("X", "Y", "Z", "A"), Settings()), 4, 1.0 + 1e-9)


@settings(max_examples=examples(60), deadline=None)
@given(st.lists(line, min_size=2, max_size=10))
def test_no_axis_jumps_further_than_allowed_at_a_corner(
    steps: list[tuple[str, float, float, float, float]],
) -> None:
    pieces = pieces_of(build(steps, Context(corner_mode=CornerMode.CONTINUOUS)).toolpath, UNEVEN)
    jumps = axis_limits(UNEVEN, 1, ("X", "Y", "Z"), Settings()).jump
    for before, after in pairwise(pieces):
        for i in range(3):
            step = after.vectors[0][i] - before.vectors[1][i]
            assert abs(step) * after.start2**0.5 <= jumps[i] * (1.0 + 1e-6)


def test_every_built_in_machine_has_limits() -> None:
    for name in ("mill3", "lathe-c-transmit", "mill5-ac-table", "lathe2-2path", "grinder-mu-mz"):
        machine = load_machine(name)
        for channel in machine.channels:
            limits = axis_limits(machine, channel.number, channel.names, Settings())
            for numbers in limits[:4]:
                assert len(numbers) == len(channel.names)
                assert all(0.0 < value < 1e9 for value in numbers)


def test_an_axis_of_a_transformation_is_as_slow_as_the_slowest_linear_one() -> None:
    machine = load_machine("lathe-c-transmit")
    numbers = axis_limits(machine, 1, ("X", "Y", "Z", "C"), Settings())
    linear = [axis.rapid for axis in machine.axes if not axis.rotary]
    assert numbers.top_rapid[1] == pytest.approx(min(linear))


def test_a_control_may_cap_what_the_machine_can_do() -> None:
    rows = Build().feed(300.0, 0.0, 0.0, feed=1e4)
    free = rows.plan(MILL).total_s
    assert rows.plan(MILL, settings=Settings(path_feed=50.0)).total_s == pytest.approx(6.0, rel=0.01)
    assert rows.plan(MILL, settings=Settings(feed_caps={"X": 30.0})).total_s == pytest.approx(10.0, rel=0.01)
    assert rows.plan(MILL, settings=Settings(feed_caps={"Y": 30.0, "X": 1e9})).total_s == free
    turn = Build().arc(20.0, 0.0, 0.0, center=(10.0, 0.0), feed=1e4)
    assert turn.plan(MILL, settings=Settings(path_feed=10.0)).total_s == pytest.approx(3.1416, rel=0.01)
    rapid = Build().rapid(300.0, 0.0, 0.0)
    assert rapid.plan(MILL, settings=Settings(rapid_caps={"X": 100.0})).total_s == pytest.approx(
        3.0, rel=0.02
    )
    assert rapid.plan(MILL, settings=Settings(path_feed=10.0)).total_s == rapid.plan(MILL).total_s


@pytest.mark.parametrize("kind", ["lines", "arcs", "spline"])
@pytest.mark.parametrize("acceleration", [AccelerationMode.CONSTANT, AccelerationMode.JERK_LIMITED])
def test_no_cut_lasts_less_than_the_control_takes_for_a_block(
    kind: str, acceleration: AccelerationMode
) -> None:
    rows = Build(context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.1))
    for k in range(1, 31):
        if kind == "arcs":
            rows.arc(20.0 * sin(0.01 * k), 20.0 - 20.0 * cos(0.01 * k), 0.0, center=(0.0, 20.0), feed=200.0)
        elif kind == "spline":
            rows.row(Kind.SPLINE, 0.2 * k, 0.001 * k * k, 0.0, feed=200.0)
        else:
            rows.feed(0.2 * k, 0.0, 0.0, feed=200.0)
    lead = Settings(acceleration=acceleration)
    slow = replace(MILL, block_time_s=0.02)
    plan = rows.plan(slow, settings=lead)
    assert min(plan.row_s) >= 0.02 * (1.0 - 1e-9)
    assert plan.total_s > rows.plan(MILL, settings=lead).total_s


def test_a_rapid_and_a_tap_wait_for_no_processing() -> None:
    rows = Build(context=Context(spindle_rpm=600.0, spindle_direction=1)).rapid(0.1, 0.0, 0.0)
    rows.row(Kind.TAP, 0.1, 0.0, -1.0, curve=(1.0, 0.0))
    assert rows.plan(replace(MILL, block_time_s=5.0)).total_s == rows.plan(MILL).total_s
