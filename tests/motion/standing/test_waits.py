"""Time that passes while the axes stand."""

from __future__ import annotations

from dataclasses import replace

import pytest

from polycnc.machine import MFunction, load_machine
from polycnc.machine.text import Text
from polycnc.motion import Settings
from polycnc.motion.standing.waits import rpm_at
from polycnc.toolpath import Context
from polycnc.toolpath.events import Auxiliary, Message, ToolSelection
from polycnc.toolpath.modes import CornerMode, StopWindow
from polycnc.toolpath.motion_settings import SpindleWaitFor
from tests.motion.paths import LATHE, MILL, Build

CHANGE_S = MILL.magazine.change_time_s
RAMP = MILL.spindles[0].acceleration_rpm_s


def m_function(code: int, seconds: float, timing: str) -> MFunction:
    return MFunction(code, Text("test"), seconds, timing)  # type: ignore[arg-type]


def test_each_tool_change_takes_the_magazines_time_and_belongs_to_the_new_tool() -> None:
    rows = Build().set(tool=1).event(ToolSelection(1)).feed(10.0, 0.0, 0.0)
    rows.set(tool=2).event(ToolSelection(2)).feed(20.0, 0.0, 0.0).set(tool=1).feed(30.0, 0.0, 0.0)
    result = rows.plan()
    assert result.times.tool_change_s == 3.0 * CHANGE_S
    assert [(tool.tool, tool.times.tool_change_s) for tool in result.tools] == [
        (1, 2 * CHANGE_S),
        (2, CHANGE_S),
    ]


def test_the_tool_that_is_in_the_spindle_needs_no_change() -> None:
    assert Build().set(tool=7).feed(10.0, 0.0, 0.0).plan(tool=7).times.tool_change_s == 0.0


def test_tools_are_told_apart_by_name() -> None:
    rows = Build().set(tool_name="MILL_10").feed(10.0, 0.0, 0.0).set(tool_name="DRILL_5").feed(20.0, 0.0, 0.0)
    result = rows.plan()
    assert [tool.name for tool in result.tools] == ["MILL_10", "DRILL_5"]
    assert result.times.tool_change_s == 2.0 * CHANGE_S


def test_the_axes_stop_for_a_tool_change() -> None:
    flying = Build().set(tool=1).feed(50.0, 0.0, 0.0).feed(100.0, 0.0, 0.0)
    stopping = Build().set(tool=1).feed(50.0, 0.0, 0.0).set(tool=2).feed(100.0, 0.0, 0.0)
    ramp = 100.0 / MILL.axes[0].acceleration
    assert stopping.plan().times.cutting_s == pytest.approx(flying.plan().times.cutting_s + ramp, rel=1e-9)


def test_the_spindle_ramps_up_reverses_and_stops() -> None:
    rows = Build().set(spindle_rpm=3000.0, spindle_direction=1).event(Auxiliary(3)).feed(10.0, 0.0, 0.0)
    rows.set(spindle_direction=-1).event(Auxiliary(4)).feed(20.0, 0.0, 0.0)
    rows.set(spindle_direction=0).event(Auxiliary(5))
    result = rows.plan()
    assert result.times.spindle_s == pytest.approx((3000.0 + 6000.0 + 3000.0) / RAMP)
    assert result.row_s[0] == pytest.approx(3000.0 / RAMP)


def test_a_spindle_speed_above_the_machines_is_the_machines() -> None:
    rows = Build().set(spindle_rpm=1e6, spindle_direction=1).feed(10.0, 0.0, 0.0)
    assert rows.plan().times.spindle_s == pytest.approx(MILL.spindles[0].max_rpm / RAMP)


def test_constant_surface_speed_ramps_to_the_speed_at_the_radius() -> None:
    rows = Build(axes=("X", "Z")).rapid(30.0, 0.0)
    rows.set(surface_speed=True, spindle_rpm=188.49555921538757, spindle_direction=1).feed(30.0, -1.0)
    # 188.5 m/min at 30 mm radius are 1000 rpm.
    assert rows.plan(LATHE).times.spindle_s == pytest.approx(1000.0 / LATHE.spindles[0].acceleration_rpm_s)


def test_orienting_the_spindle_takes_its_time() -> None:
    assert Build().event(Auxiliary(19)).plan().times.spindle_s == MILL.spindles[0].orient_s


@pytest.mark.parametrize(("timing", "expected"), [("before", 0.7), ("after", 0.7)])
def test_an_auxiliary_function_takes_its_seconds(timing: str, expected: float) -> None:
    machine = replace(MILL, m_functions={50: m_function(50, 0.7, timing)})
    rows = Build().feed(50.0, 0.0, 0.0).event(Auxiliary(50)).feed(100.0, 0.0, 0.0)
    still = Build().feed(50.0, 0.0, 0.0).dwell(seconds=1.0).feed(100.0, 0.0, 0.0)
    result = rows.plan(machine)
    assert result.times.auxiliary_s == pytest.approx(expected)
    assert result.times.cutting_s == still.plan().times.cutting_s


def test_a_function_beside_the_motion_takes_only_what_is_longer() -> None:
    machine = replace(MILL, m_functions={8: m_function(8, 3.0, "with")})
    rows = Build().event(Auxiliary(8))
    rows.line -= 1
    rows.feed(100.0, 0.0, 0.0)
    motion = rows.plan(replace(MILL, m_functions={})).times.cutting_s
    result = rows.plan(machine)
    assert result.times.auxiliary_s == pytest.approx(3.0 - motion)
    assert result.total_s == pytest.approx(3.0)
    assert sum(result.row_s) == pytest.approx(3.0)


def test_a_function_beside_a_long_motion_takes_nothing_and_stops_nothing() -> None:
    machine = replace(MILL, m_functions={8: m_function(8, 0.2, "with")})
    rows = Build().feed(100.0, 0.0, 0.0).event(Auxiliary(8))
    rows.line -= 1
    rows.feed(200.0, 0.0, 0.0)
    plain = Build().feed(100.0, 0.0, 0.0).feed(200.0, 0.0, 0.0)
    assert rows.plan(machine).total_s == plain.plan(machine).total_s


def test_a_function_in_a_block_without_motion_stops_the_axes_until_it_is_done() -> None:
    machine = replace(MILL, m_functions={8: m_function(8, 0.2, "with")})
    rows = Build().feed(100.0, 0.0, 0.0).event(Auxiliary(8)).feed(200.0, 0.0, 0.0)
    stopped = replace(MILL, m_functions={8: m_function(8, 0.2, "before")})
    assert rows.plan(machine).total_s == rows.plan(stopped).total_s
    assert rows.plan(machine).times.auxiliary_s == pytest.approx(0.2)


def test_a_function_that_takes_no_time_stops_nothing() -> None:
    machine = replace(MILL, m_functions={8: m_function(8, 0.0, "with")})
    rows = Build().feed(100.0, 0.0, 0.0).event(Auxiliary(8)).feed(200.0, 0.0, 0.0)
    plain = Build().feed(100.0, 0.0, 0.0).feed(200.0, 0.0, 0.0)
    assert rows.plan(machine).total_s == plain.plan(machine).total_s


def test_messages_do_not_stop_the_axes() -> None:
    rows = Build().feed(50.0, 0.0, 0.0).event(Message("HALF")).feed(100.0, 0.0, 0.0)
    plain = Build().feed(50.0, 0.0, 0.0).feed(100.0, 0.0, 0.0)
    assert rows.plan().total_s == plain.plan().total_s


def test_a_dwell_in_revolutions_follows_the_spindle() -> None:
    rows = Build().set(spindle_rpm=120.0, spindle_direction=1).dwell(revolutions=3.0)
    assert rows.plan().times.dwell_s == pytest.approx(1.5)


SETTLING = replace(MILL, settle_fine_s=0.05, settle_coarse_s=0.02)


@pytest.mark.parametrize(
    ("window", "seconds"), [(StopWindow.FINE, 0.05), (StopWindow.COARSE, 0.02), (StopWindow.NONE, 0.0)]
)
def test_behind_each_exact_stop_the_axes_settle_within_the_window(window: StopWindow, seconds: float) -> None:
    rows = Build(context=Context(corner_mode=CornerMode.EXACT_STOP, stop_window=window)).feed(10.0, 0.0, 0.0)
    rows.feed(20.0, 0.0, 0.0).feed(20.0, 0.0, 0.0).event(Auxiliary(30))
    settled, at_once = rows.plan(SETTLING), rows.plan()
    assert settled.times.cutting_s == pytest.approx(at_once.times.cutting_s + 2.0 * seconds)
    waits = [after - before for after, before in zip(settled.row_s, at_once.row_s, strict=True)]
    assert waits == pytest.approx([0.0, seconds, seconds, 0.0])


def test_nothing_settles_on_a_continuous_path() -> None:
    rows = Build(context=Context(corner_mode=CornerMode.CONTINUOUS)).feed(10.0, 0.0, 0.0).feed(20.0, 9.0, 0.0)
    assert rows.event(Auxiliary(30)).plan(SETTLING).total_s == rows.plan().total_s


def test_a_rapid_settles_where_rapids_stop() -> None:
    rows = (
        Build(context=Context(corner_mode=CornerMode.CONTINUOUS)).rapid(10.0, 0.0, 0.0).feed(20.0, 0.0, 0.0)
    )
    for stops, seconds in ((True, 0.05), (False, 0.0)):
        settings = Settings(rapid_stops=stops)
        times, before = (rows.plan(machine, settings=settings).times for machine in (SETTLING, MILL))
        assert times.rapid_s == pytest.approx(before.rapid_s + seconds)


def test_settling_does_not_depend_on_the_chunks() -> None:
    whole, cut = (
        Build(context=Context(corner_mode=CornerMode.EXACT_STOP), chunk_rows=rows) for rows in (65_536, 1)
    )
    for rows in (whole, cut):
        for k in range(5):
            rows.feed(10.0 * k, 0.0, 0.0)
    assert list(whole.plan(SETTLING).row_s) == list(cut.plan(SETTLING).row_s)


def test_the_axes_settle_behind_the_last_row_too() -> None:
    rows = Build(context=Context(corner_mode=CornerMode.EXACT_STOP)).feed(10.0, 0.0, 0.0)
    assert rows.plan(SETTLING).total_s == pytest.approx(rows.plan().total_s + 0.05)
    assert sum(rows.plan(SETTLING).row_s) == pytest.approx(rows.plan(SETTLING).total_s)


def test_the_spindle_follows_a_cut_under_constant_surface_speed_without_a_wait() -> None:
    rows = Build(axes=("X", "Z")).rapid(30.0, 0.0)
    rows.set(surface_speed=True, spindle_rpm=188.49555921538757, spindle_direction=1).feed(30.0, -1.0)
    # 1000 rpm at 30 mm, 500 at 60 mm: reached on the way; then 500 rpm on, reversed.
    rows.set(tolerance_mm=0.01).feed(60.0, -1.0).set(surface_speed=False, spindle_rpm=500.0).feed(60.0, -2.0)
    rows.set(spindle_direction=-1).feed(60.0, -3.0)
    ramp = LATHE.spindles[0].acceleration_rpm_s
    assert rows.plan(LATHE).times.spindle_s == pytest.approx((1000.0 + 1000.0) / ramp)


@pytest.mark.parametrize("speed", [0.0, -100.0])
def test_a_surface_speed_that_is_none_turns_no_spindle(speed: float) -> None:
    context = Context(surface_speed=True, spindle_rpm=speed, spindle_direction=1)
    assert rpm_at(context, 0.0, MILL.spindles[0]) == 0.0


def test_a_turret_turns_the_shorter_way_round_to_the_place_of_its_tool() -> None:
    magazine = replace(LATHE.magazine, kind="turret", places=12, change_time_s=1.0, place_time_s=0.2)
    machine = replace(LATHE, magazine=magazine)
    rows = Build(axes=("X", "Z"), context=Context(tool=2)).feed(1.0, 0.0)
    rows.set(tool=11).feed(2.0, 0.0)
    assert rows.plan(machine, tool=1).times.tool_change_s == pytest.approx(2 * 1.0 + (1 + 3) * 0.2)


def test_a_turret_stays_where_it_is_when_no_tool_is_named() -> None:
    magazine = replace(LATHE.magazine, kind="turret", places=12, change_time_s=1.0, place_time_s=0.2)
    rows = Build().set(tool=5).dwell(1.0).set(tool=0).dwell(1.0).set(tool=5).dwell(1.0).set(tool=7).dwell(1.0)
    plan = rows.plan(replace(LATHE, magazine=magazine))
    assert list(plan.row_s) == pytest.approx([2.0, 1.0, 1.0, 2.4])


def test_a_magazine_takes_the_tool_out_of_the_spindle_when_none_is_named() -> None:
    rows = Build().set(tool=5).dwell(1.0).set(tool=0).dwell(1.0)
    assert rows.plan().times.tool_change_s == 2.0 * CHANGE_S


@pytest.mark.parametrize(("waits", "turns_up"), [("block", True), ("cut", True), ("never", False)])
def test_a_tool_is_changed_in_a_spindle_that_stands(waits: SpindleWaitFor, turns_up: bool) -> None:
    machine = replace(MILL, spindles=(replace(MILL.spindle[1], speed_wait=waits),))
    rows = Build().set(spindle_rpm=6000.0, spindle_direction=1).event(Auxiliary(3)).dwell(5.0)
    rows.set(tool=2).event(Auxiliary(6)).event(Auxiliary(3)).feed(10.0, 0.0, 0.0)
    times = rows.plan(machine).times
    ramp = 6000.0 / RAMP
    assert times.tool_change_s == pytest.approx(CHANGE_S + ramp)
    up = 2.0 * ramp if waits == "block" else ramp  # the first one beside the dwell
    assert times.spindle_s == pytest.approx(up if turns_up else 0.0)


def test_a_spindle_that_stands_since_a_change_goes_to_the_speed_that_it_is_told_next() -> None:
    rows = Build().set(spindle_rpm=9000.0, spindle_direction=1).dwell(1.0).set(tool=2).event(Auxiliary(6))
    rows.event(Auxiliary(8)).set(spindle_rpm=3000.0).event(Auxiliary(3)).feed(10.0, 0.0, 0.0)
    assert rows.plan().times.spindle_s == pytest.approx((9000.0 + 3000.0) / RAMP)


@pytest.mark.parametrize("waits", ["block", "cut", "never"])
def test_an_orientation_waits_until_the_spindle_stands(waits: SpindleWaitFor) -> None:
    machine = replace(MILL, spindles=(replace(MILL.spindle[1], speed_wait=waits),))
    rows = Build().set(spindle_rpm=6000.0, spindle_direction=1).dwell(5.0).event(Auxiliary(19))
    rows.set(spindle_direction=0).dwell(1.0)
    plan = rows.plan(machine)
    assert plan.row_s[1] == pytest.approx(6000.0 / RAMP + machine.spindle[1].orient_s)
    assert plan.row_s[2] == pytest.approx(1.0)


def test_an_orientation_of_another_spindle_stops_that_one_alone() -> None:
    rows = Build().set(spindle_rpm=6000.0, spindle_direction=1).dwell(5.0).event(Auxiliary(19, 2)).dwell(1.0)
    machine = load_machine("mill3-two-spindles")
    assert rows.plan(machine).row_s[1] == pytest.approx(machine.spindle[2].orient_s)
