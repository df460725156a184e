"""Cycle times against closed forms."""

from __future__ import annotations

from dataclasses import replace
from math import pi, sqrt

import pytest

import polycnc
from polycnc.geometry.frames import rotation, scaling
from polycnc.motion import Settings, plan
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.events import Auxiliary
from polycnc.toolpath.modes import CornerMode, FeedMode
from tests.motion.paths import LATHE, MILL4, Build, mill

A, V = 1000.0, 500.0
MACHINE = mill(A, V)


def trapezoid(length: float, speed: float, acceleration: float) -> float:
    """Seconds from rest to rest."""
    if length >= speed * speed / acceleration:
        return length / speed + speed / acceleration
    return 2.0 * sqrt(length / acceleration)


def test_an_empty_toolpath_takes_no_time() -> None:
    result = Build().plan(MACHINE)
    assert result.total_s == 0.0
    assert result.tools == ()
    assert len(result.row_s) == 0


def test_a_long_cut_is_a_trapezoid() -> None:
    result = Build().feed(200.0, 0.0, 0.0, feed=100.0).plan(MACHINE)
    assert result.total_s == pytest.approx(200.0 / 100.0 + 100.0 / A, rel=1e-12)
    assert result.times.cutting_mm == pytest.approx(200.0)


def test_a_short_cut_is_a_triangle() -> None:
    result = Build().feed(2.0, 0.0, 0.0, feed=100.0).plan(MACHINE)
    assert result.total_s == pytest.approx(2.0 * sqrt(2.0 / A), rel=1e-12)


def test_a_rapid_runs_as_fast_as_its_slowest_axis_allows() -> None:
    axes = tuple(replace(a, rapid=100.0) if a.name == "Y" else a for a in MACHINE.axes)
    result = Build().rapid(300.0, 400.0, 0.0).plan(replace(MACHINE, axes=axes))
    # Y has 0.8 of the way: 125 mm/s and 1250 mm/s² along the path.
    assert result.total_s == pytest.approx(trapezoid(500.0, 125.0, A / 0.8), rel=1e-12)
    assert result.times.rapid_s == result.total_s
    assert result.times.rapid_mm == pytest.approx(500.0)


def test_a_feed_above_the_axis_limit_is_cut_down() -> None:
    result = Build().feed(400.0, 0.0, 0.0, feed=9999.0).plan(MACHINE)
    assert result.total_s == pytest.approx(trapezoid(400.0, V, A), rel=1e-12)


def test_rapids_axis_by_axis_take_as_long_as_the_slowest_axis() -> None:
    settings = Settings(rapid_by_axis=True)
    result = Build().rapid(300.0, 40.0, 0.0).rapid(300.0, 40.0, -90.0).plan(MACHINE, settings=settings)
    assert result.total_s == pytest.approx(trapezoid(300.0, V, A) + trapezoid(90.0, V, A), rel=1e-12)


def test_rapids_without_a_stop_between_them_are_one_motion() -> None:
    rows = Build().rapid(100.0, 0.0, 0.0).rapid(200.0, 0.0, 0.0)
    stopping = rows.plan(MACHINE).total_s
    flying = rows.plan(MACHINE, settings=Settings(rapid_stops=False)).total_s
    assert stopping == pytest.approx(2.0 * trapezoid(100.0, V, A), rel=1e-12)
    assert flying == pytest.approx(trapezoid(200.0, V, A), rel=1e-12)


def test_a_cut_in_many_parts_is_planned_like_one_cut() -> None:
    parts = Build()
    for k in range(1, 101):
        parts.feed(0.02 * k, 0.01 * k, 0.0)
    whole = Build().feed(2.0, 1.0, 0.0)
    assert parts.plan(MACHINE).total_s == pytest.approx(whole.plan(MACHINE).total_s, rel=1e-9)


def test_exact_stop_rests_at_every_block_end() -> None:
    rows = (
        Build(context=Context(corner_mode=CornerMode.EXACT_STOP)).feed(50.0, 0.0, 0.0).feed(100.0, 0.0, 0.0)
    )
    assert rows.plan(MACHINE).total_s == pytest.approx(2.0 * trapezoid(50.0, 100.0, A), rel=1e-12)


def test_exact_stop_of_one_block_rests_at_its_end_only() -> None:
    rows = (
        Build()
        .set(corner_mode=CornerMode.EXACT_STOP)
        .feed(50.0, 0.0, 0.0)
        .set(corner_mode=CornerMode.CONTINUOUS)
    )
    rows.feed(100.0, 0.0, 0.0).feed(150.0, 0.0, 0.0)
    expected = trapezoid(50.0, 100.0, A) + trapezoid(100.0, 100.0, A)
    assert rows.plan(MACHINE).total_s == pytest.approx(expected, rel=1e-12)


def test_a_dwell_and_a_reversal_stop_the_axes() -> None:
    rows = Build().feed(50.0, 0.0, 0.0).dwell(seconds=1.5).feed(100.0, 0.0, 0.0).feed(50.0, 0.0, 0.0)
    result = rows.plan(MACHINE)
    assert result.times.dwell_s == 1.5
    assert result.times.cutting_s == pytest.approx(3.0 * trapezoid(50.0, 100.0, A), rel=1e-12)


def test_a_corner_without_deviation_is_passed_at_the_allowed_velocity_jump() -> None:
    # Each axis changes by the whole path speed at a right angle, v = overload · a · cycle, within overload · cycle.
    corner = 1.2 * A * 0.004
    bend = 0.5 * corner * 1.2 * 0.004
    rows = (
        Build(context=Context(corner_mode=CornerMode.CONTINUOUS)).feed(50.0, 0.0, 0.0).feed(50.0, 50.0, 0.0)
    )
    assert rows.plan(MACHINE).total_s == pytest.approx(2.0 * half_of_corner(50.0, corner, bend), rel=1e-9)


def half_of_corner(length: float, corner: float, bend: float, pull: float = A) -> float:
    """Seconds from rest to the middle of a corner, on `bend` mm before which the speed stays."""
    level = length - bend - (2 * 100.0**2 - corner**2) / (2.0 * pull)
    return (100.0 + (100.0 - corner)) / pull + level / 100.0 + bend / corner


def test_a_rounded_corner_is_passed_at_the_speed_of_the_bend_within_the_tolerance() -> None:
    # At 90° a parabola that leaves the corner by d begins 4·d/√2 before it; each axis turns from its speed to rest or
    # back on twice that way.
    tolerance = 0.05
    bend = 4.0 * tolerance / sqrt(2.0)
    corner = sqrt(A * 2.0 * bend)
    rows = Build(context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=tolerance))
    rows.feed(50.0, 0.0, 0.0).feed(50.0, 50.0, 0.0)
    assert rows.plan(MACHINE).total_s == pytest.approx(2.0 * half_of_corner(50.0, corner, bend), rel=1e-9)


def test_rounding_within_a_distance_begins_no_earlier_than_that_before_the_corner() -> None:
    """G641: at 90° each axis goes from its speed to rest, or back, on 0.04 mm before and 0.04 mm behind the corner."""
    machine = mill(acceleration=1000.0, top=500.0)
    rows = (
        Build()
        .set(corner_mode=CornerMode.ROUNDED_FROM, tolerance_mm=0.04)
        .feed(50.0, 0.0, 0.0)
        .feed(50.0, 50.0, 0.0)
    )
    corner = sqrt(1000.0 * 2.0 * 0.04)
    assert rows.plan(machine).total_s == pytest.approx(
        2.0 * half_of_corner(50.0, corner, 0.04, 1000.0), rel=1e-9
    )


def test_rounding_within_no_distance_keeps_the_corner() -> None:
    modes = (CornerMode.ROUNDED_FROM, CornerMode.CONTINUOUS)
    way = [Build().set(corner_mode=mode).feed(50.0, 0.0, 0.0).feed(50.0, 50.0, 0.0) for mode in modes]
    assert way[0].plan(mill()).total_s == way[1].plan(mill()).total_s


def test_a_slow_circle_takes_its_length_over_the_feed() -> None:
    rows = Build().feed(50.0, 0.0, 0.0, feed=10.0).set(corner_mode=CornerMode.EXACT_STOP)
    rows.arc(50.0, 0.0, 0.0, center=(0.0, 0.0), feed=10.0)
    expected = trapezoid(2.0 * pi * 50.0, 10.0, A)
    assert rows.plan(MACHINE).row_s[1] == pytest.approx(expected, rel=1e-3)


def test_a_fast_circle_is_held_back_by_the_acceleration_to_its_centre() -> None:
    rows = Build().feed(10.0, 0.0, 0.0).arc(10.0, 0.0, 0.0, center=(0.0, 0.0), feed=9999.0, turns=50.0)
    # v²/r is at most a where an axis points to the centre.
    fastest = 51 * 2.0 * pi * 10.0 / sqrt(A * sqrt(2.0) * 10.0)
    slowest = 51 * 2.0 * pi * 10.0 / sqrt(A * 10.0)
    assert fastest < rows.plan(MACHINE).row_s[1] < 1.02 * slowest


@pytest.mark.parametrize("turns", [0, 3])
def test_turns_of_a_helix_lengthen_it(turns: int) -> None:
    rows = Build().feed(20.0, 0.0, 0.0)
    curve = (0.0, 0.0, 0.0, 0.0, 0.0, 1.0, float(turns))
    rows.row(Kind.HELIX_CW, 20.0, 0.0, 5.0, feed=10.0, curve=curve)
    length = sqrt((2.0 * pi * 20.0 * (turns + 1)) ** 2 + 25.0)
    result = rows.plan(MACHINE)
    assert result.times.cutting_mm == pytest.approx(20.0 + length, rel=1e-9)


def test_clockwise_and_counter_clockwise_take_complementary_ways() -> None:
    ways = []
    for kind in (Kind.CW, Kind.CCW):
        rows = Build().feed(10.0, 0.0, 0.0)
        rows.row(kind, 0.0, 10.0, 0.0, curve=(0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0))
        ways.append(rows.plan(MACHINE).times.cutting_mm - 10.0)
    assert ways == pytest.approx([1.5 * pi * 10.0, 0.5 * pi * 10.0])


@pytest.mark.parametrize("frame", [rotation(2, 30.0), scaling(-1.0, 1.0, 1.0), rotation(0, 90.0)])
def test_a_rotated_or_mirrored_contour_keeps_its_length(frame: object) -> None:
    def lengths(context: Context) -> float:
        rows = Build(context=context).feed(10.0, 0.0, 0.0).arc(0.0, 10.0, 0.0, center=(0.0, 0.0))
        return rows.plan(MACHINE).times.cutting_mm

    assert lengths(Context(frame=frame)) == pytest.approx(lengths(Context()), rel=1e-9)  # type: ignore[arg-type]


def test_inverse_time_feed_gives_each_block_its_seconds() -> None:
    rows = Build(context=Context(feed_mode=FeedMode.INVERSE_TIME, corner_mode=CornerMode.EXACT_STOP)).feed(
        10.0, 0.0, 0.0, feed=0.5
    )
    # 20 s at a speed of 5 mm/s, and the ramps.
    expected = trapezoid(10.0, 5.0, A)
    assert rows.plan(MACHINE).total_s == pytest.approx(expected, rel=1e-12)


def test_feed_per_revolution_follows_the_spindle() -> None:
    context = Context(feed_mode=FeedMode.PER_REVOLUTION, spindle_rpm=600.0, spindle_direction=1)
    rows = Build(axes=("X", "Z"), context=context).feed(0.0, -50.0, feed=0.2)
    lathe = LATHE.axis["Z"].acceleration
    result = rows.plan(LATHE)
    assert result.times.cutting_s == pytest.approx(trapezoid(50.0, 2.0, lathe), rel=1e-12)
    assert result.rows_without_feed == 0


def test_surface_speeds_count_feet_where_the_program_is_in_inches() -> None:
    inch = polycnc.run("O1\nG20 G99 G18\nG0 X1. Z0\nG96 S100 M3\nG1 Z-1. F.01\nM30\n", control="fanuc-0i-tf")
    # 12 * 100 / (pi * 1) rpm, 0.01 inch a turn.
    assert inch.plan.times.cutting_s == pytest.approx(60 / (12 * 100 / pi * 0.01), rel=0.01)


def test_facing_under_constant_surface_speed_takes_the_integral_over_the_radius() -> None:
    context = Context(
        feed_mode=FeedMode.PER_REVOLUTION,
        surface_speed=True,
        spindle_rpm=150.0,
        spindle_direction=1,
        spindle_limit_rpm=4000.0,
    )
    rows = Build(axes=("X", "Z"), context=context).rapid(50.0, 0.0).feed(20.0, 0.0, feed=0.2)
    # dt = 2·pi·r·dr / (V·f), with V = 2500 mm/s; 150000 mm/min never exceeds 4000 rpm above r = 6 mm.
    expected = pi * (50.0**2 - 20.0**2) / (2500.0 * 0.2)
    assert rows.plan(LATHE).times.cutting_s == pytest.approx(expected, rel=0.005)


def test_a_thread_runs_its_lead_every_turn() -> None:
    context = Context(feed_mode=FeedMode.PER_REVOLUTION, spindle_rpm=300.0, spindle_direction=1)
    rows = Build(axes=("X", "Z"), context=context)
    rows.row(Kind.THREAD, 0.0, -40.0, feed=0.1, curve=(2.0, 0.0))
    result = rows.plan(LATHE)
    assert result.times.cutting_s == pytest.approx(
        trapezoid(40.0, 10.0, LATHE.axis["Z"].acceleration), rel=1e-12
    )


def test_a_thread_whose_lead_grows_takes_the_revolutions_between_its_leads() -> None:
    context = Context(feed_mode=FeedMode.PER_REVOLUTION, spindle_rpm=300.0, spindle_direction=1)
    rows = Build(axes=("X", "Z"), context=context)
    rows.row(Kind.THREAD, 0.0, -48.0, feed=2.0, curve=(2.0, 0.0, 1.0))
    # The last lead is sqrt(2² + 2·1·48) = 10: 8 revolutions at 5 a second, from 10 to 50 mm/s by 25 mm/s².
    pull, change, first, last = LATHE.axis["Z"].acceleration, 25.0, 10.0, 50.0
    met, left = first * sqrt(pull / (pull - change)), last * sqrt(pull / (pull + change))
    later = met / pull - (met - first) / change + left / pull - (last - left) / change
    assert rows.plan(LATHE).times.cutting_s == pytest.approx(8.0 / 5.0 + later, rel=1e-9)


def test_a_tap_ramps_with_the_spindle() -> None:
    spindle = replace(MACHINE.spindles[0], acceleration_rpm_s=600.0)
    machine = replace(MACHINE, spindles=(spindle,))
    rows = Build(context=Context(spindle_rpm=600.0)).row(Kind.TAP, 0.0, 0.0, -30.0, curve=(1.0, 0.0))
    # 10 mm/s after one second and 5 mm, 20 mm level, one second down.
    assert rows.plan(machine).times.cutting_s == pytest.approx(4.0, rel=1e-12)


def test_a_cut_without_feed_is_counted() -> None:
    rows = Build().feed(10.0, 0.0, 0.0, feed=float("nan")).feed(20.0, 0.0, 0.0, feed=50.0)
    assert rows.plan(MACHINE).rows_without_feed == 1


@pytest.mark.parametrize("kind", ["feed", "arc", "thread", "tap"])
def test_moves_that_wait_for_a_spindle_at_rest_are_counted(kind: str) -> None:
    rows = Build(context=Context(feed_mode=FeedMode.PER_REVOLUTION, spindle_rpm=0.0))
    if kind == "feed":
        rows.feed(10.0, 0.0, 0.0, feed=0.2)
    elif kind == "arc":
        rows.arc(0.0, 10.0, 0.0, center=(0.0, 5.0), feed=0.2)
    else:
        rows.row(Kind.THREAD if kind == "thread" else Kind.TAP, 0.0, 0.0, -10.0, feed=1.0, curve=(1.0, 0.0))
    result = rows.plan(MACHINE)
    assert (result.rows_without_feed, result.rows_without_spindle) == (0, 1)


def test_rotary_axes_alone_move_in_degrees() -> None:
    axes = tuple(
        replace(a, rapid=90.0, max_feed=90.0, acceleration=180.0) if a.rotary else a for a in MILL4.axes
    )
    result = Build(axes=("X", "Y", "Z", "A")).rapid(0.0, 0.0, 0.0, 360.0).plan(replace(MILL4, axes=axes))
    assert result.total_s == pytest.approx(trapezoid(360.0, 90.0, 180.0), rel=1e-12)


def test_the_feed_counts_rotary_axes_as_the_control_does() -> None:
    rows = Build(axes=("X", "Y", "Z", "A")).feed(30.0, 0.0, 0.0, 40.0, feed=5.0)
    assert rows.plan(MILL4).times.cutting_s == pytest.approx(10.0, rel=0.01)
    alone = rows.plan(MILL4, settings=Settings(rotary_in_feed=False))
    assert alone.times.cutting_s == pytest.approx(6.0, rel=0.01)


def test_times_of_rows_add_up_to_the_total() -> None:
    rows = Build().rapid(10.0, 20.0, 30.0).feed(50.0, 20.0, 30.0).dwell(seconds=0.3).event(Auxiliary(19))
    rows.arc(50.0, 40.0, 30.0, center=(50.0, 30.0)).rapid(0.0, 0.0, 0.0)
    result = plan(rows.toolpath, MACHINE)
    assert len(result.row_s) == len(rows.toolpath)
    assert sum(result.row_s) == pytest.approx(result.total_s, rel=1e-12)
    assert sum(result.times.shares().values()) == pytest.approx(1.0)
    assert sum(tool.times.total_s for tool in result.tools) == pytest.approx(result.total_s, rel=1e-12)


def test_the_start_position_is_where_the_first_row_begins() -> None:
    result = plan(Build().feed(200.0, 0.0, 0.0).toolpath, MACHINE, start=(100.0, 0.0, 0.0))
    assert result.times.cutting_mm == pytest.approx(100.0)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_circular_thread_is_as_long_as_its_arc(sense: float) -> None:
    """A thread with a normal turns about its centre: a quarter one way, three quarters the other."""
    rows = Build().feed(20.0, 0.0, 0.0)
    curve = (2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, sense)
    rows.row(Kind.THREAD, 0.0, 20.0, 0.0, feed=2.0, curve=curve)
    quarters = 1.0 if sense > 0.0 else 3.0
    assert rows.plan(MACHINE).times.cutting_mm == pytest.approx(20.0 + quarters * 10.0 * pi, rel=1e-9)


def test_an_arc_that_goes_out_and_hardly_turns_is_as_long_as_it_is() -> None:
    result = Build().feed(1.2, 1.6, 0.0).arc(6.0, 8.0000000001, 0.0, center=(0.0, 0.0)).plan(MACHINE)
    assert result.times.cutting_mm == pytest.approx(10.0, abs=1e-6)
