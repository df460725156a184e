"""What goes on beside the axes: spindles that run up, a magazine that turns."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.motion import Settings
from polycnc.motion.planner import Planner
from polycnc.motion.standing.beside import Search, Turning
from polycnc.toolpath import Context
from polycnc.toolpath.events import Auxiliary, ToolSelection
from polycnc.toolpath.modes import AccelerationMode
from tests.motion.paths import LATHE, MILL, Build

if TYPE_CHECKING:
    from polycnc.machine import Machine
    from polycnc.motion import Plan

SOFT = Settings(keeps_corners=False, acceleration=AccelerationMode.JERK_LIMITED, rapid_by_axis=True)
RAMP_S = 3000.0 / MILL.spindles[0].acceleration_rpm_s
CHANGE_S, PLACE_S = MILL.magazine.change_time_s, 0.5


def waiting(speed_wait: Any, machine: Machine = MILL) -> Machine:
    return replace(machine, spindles=tuple(replace(s, speed_wait=speed_wait) for s in machine.spindles))


def turning(**keys: Any) -> Machine:
    return replace(MILL, magazine=replace(MILL.magazine, places=24, place_time_s=PLACE_S, **keys))


def planned(rows: Build, machine: Machine, **options: Any) -> tuple[Plan, float]:
    """The plan, and the seconds of work that nothing waited for."""
    planner = Planner(rows.toolpath, machine, settings=options.pop("settings", SOFT), **options)
    plan = planner.finish()
    return plan, sum(planner.hidden_s.values())


def approach(way: float = 100.0, rapids: int = 1) -> Build:
    """M3 S3000, rapids, a cut."""
    rows = Build().set(spindle_rpm=3000.0, spindle_direction=1).event(Auxiliary(3))
    for k in range(rapids):
        rows.rapid(way * (k + 1), 0.0, 0.0)
    return rows.feed(way * rapids + 50.0, 0.0, 0.0)


# ---- spindles


def test_the_block_waits_as_long_as_the_machine_file_says_nothing_else() -> None:
    plan, hidden = planned(approach(), MILL)
    assert plan.times.spindle_s == pytest.approx(RAMP_S)
    assert plan.row_s[0] == pytest.approx(RAMP_S)
    assert hidden == 0.0


def test_a_spindle_runs_up_beside_rapids_and_the_first_cut_waits_for_the_rest() -> None:
    rapid_s = planned(approach(), MILL)[0].times.rapid_s
    plan, hidden = planned(approach(), waiting("cut"))
    assert plan.times.spindle_s == pytest.approx(RAMP_S - rapid_s)
    assert hidden == pytest.approx(rapid_s)
    assert plan.row_waits == {2: pytest.approx(RAMP_S - rapid_s)}
    assert plan.total_s == pytest.approx(planned(approach(), MILL)[0].total_s - rapid_s)


def test_nothing_waits_for_a_spindle_that_has_its_speed() -> None:
    plan, hidden = planned(approach(rapids=3), waiting("cut"))
    assert plan.times.spindle_s == 0.0
    assert hidden == pytest.approx(RAMP_S)


def test_a_cut_without_a_rapid_waits_for_all_of_it() -> None:
    assert planned(approach(rapids=0), waiting("cut"))[0].times.spindle_s == pytest.approx(RAMP_S)


def test_where_the_control_does_not_look_nothing_waits() -> None:
    assert planned(approach(), waiting("never"))[0].times.spindle_s == 0.0
    settings = replace(SOFT, spindle_wait="never")
    assert planned(approach(), waiting("cut"), settings=settings)[0].times.spindle_s == 0.0
    settings = replace(SOFT, spindle_wait="cut")
    assert 0.0 < planned(approach(), MILL, settings=settings)[0].times.spindle_s < RAMP_S


def test_a_dwell_counts_as_well() -> None:
    rows = Build().set(spindle_rpm=3000.0, spindle_direction=1).event(Auxiliary(3)).dwell(0.2)
    assert planned(rows.feed(50.0, 0.0, 0.0), waiting("cut"))[0].times.spindle_s == pytest.approx(
        RAMP_S - 0.2
    )


def test_a_second_speed_begins_where_the_spindle_is() -> None:
    rows = Build().set(spindle_rpm=3000.0, spindle_direction=1).event(Auxiliary(3)).dwell(0.2)
    rows.set(spindle_direction=-1).event(Auxiliary(4)).feed(50.0, 0.0, 0.0)
    reached = 0.2 * MILL.spindles[0].acceleration_rpm_s
    expected = (3000.0 + reached) / MILL.spindles[0].acceleration_rpm_s
    assert planned(rows, waiting("cut"))[0].times.spindle_s == pytest.approx(expected)


def test_a_tool_change_waits_until_the_spindle_stands_and_none_runs_up_during_it() -> None:
    rows = approach(rapids=3).set(spindle_direction=0).event(Auxiliary(5)).set(tool=2).event(ToolSelection(2))
    rows.set(spindle_direction=1).event(Auxiliary(3)).feed(0.0, 0.0, 0.0)
    assert planned(rows, waiting("cut"))[0].times.spindle_s == pytest.approx(2.0 * RAMP_S)
    at_once = Build().set(tool=2, spindle_rpm=3000.0, spindle_direction=1).event(ToolSelection(2))
    plan, hidden = planned(at_once.feed(50.0, 0.0, 0.0), waiting("cut"))
    assert (plan.times.spindle_s, plan.times.tool_change_s) == pytest.approx((RAMP_S, CHANGE_S))
    assert hidden == pytest.approx(0.0)


def test_under_constant_surface_speed_it_begins_where_it_has_followed_the_cuts() -> None:
    rows = Build(axes=("X", "Z")).rapid(30.0, 0.0)
    rows.set(surface_speed=True, spindle_rpm=188.49555921538757, spindle_direction=1).feed(30.0, -1.0)
    rows.feed(15.0, -1.0).set(surface_speed=False, spindle_rpm=500.0).feed(15.0, -2.0)
    rate = LATHE.spindles[0].acceleration_rpm_s
    # 1000 rpm at 30 mm radius, 2000 at 15.
    assert planned(rows, waiting("cut", LATHE))[0].times.spindle_s == pytest.approx((1000.0 + 1500.0) / rate)


def test_the_rapid_of_a_control_that_does_not_stop_rests_before_the_cut() -> None:
    settings = Settings(rapid_stops=False)
    plan, _ = planned(approach(), waiting("cut"), settings=settings)
    stopping = planned(approach(), waiting("cut"), settings=replace(settings, rapid_stops=True))[0]
    assert plan.total_s == pytest.approx(stopping.total_s)


def test_a_cut_waits_for_what_rapids_under_constant_surface_speed_leave_of_the_ramp() -> None:
    """From radius 50 to 10, and back and forth: a rapid goes on from where the last one has left the spindle."""
    speed, lathe = 188.49555921538757, waiting("cut", LATHE)
    ramp = lathe.spindles[0].acceleration_rpm_s
    rows = Build(axes=("X", "Z"), context=Context(spindle_rpm=speed, spindle_direction=1, surface_speed=True))
    rows.rapid(50.0, 0.0).feed(50.0, -10.0).rapid(10.0, -10.0).feed(10.0, -20.0)
    plan, _ = planned(rows, lathe, settings=replace(SOFT, rapid_stops=True))
    change = 30_000.0 / 10.0 - 30_000.0 / 50.0
    assert plan.row_waits[3] == pytest.approx(change / ramp - plan.row_s[2])
    assert planned(rows, waiting("never", LATHE))[0].row_waits.get(3, 0.0) == 0.0
    rows.rapid(30.0, -20.0).rapid(50.0, -20.0).rapid(10.0, -20.0).feed(10.0, -30.0)
    plan, _ = planned(rows, lathe)
    back_s = plan.row_s[4] + plan.row_s[5]  # it slows down meanwhile, and goes up again in the last rapid
    assert plan.row_waits[7] == pytest.approx(max(back_s - plan.row_s[6], 0.0), abs=1e-6)


@given(st.lists(st.tuples(st.floats(-6000.0, 6000.0), st.floats(0.0, 2.0)), max_size=6))
def test_a_spindle_never_goes_faster_than_it_can(steps: list[tuple[float, float]]) -> None:
    spindle, before = Turning(4000.0), 0.0
    for aim, seconds in steps:
        spindle.begin(aim)
        assert spindle.speed == pytest.approx(before, abs=1e-6)
        spindle.left_s = max(spindle.left_s - seconds, 0.0)
        assert abs(spindle.speed - before) <= 4000.0 * seconds + 1e-6
        assert min(before, aim) - 1e-6 <= spindle.speed <= max(before, aim) + 1e-6
        before = spindle.speed


# ---- the magazine


def changes(*tools: int, cut: float = 100.0, ahead: bool = True) -> Build:
    """T, a cut, M06, a cut: over and over, beginning with tool 1."""
    rows, x = Build().set(tool=1), 0.0
    for tool in tools:
        if ahead:
            rows.event(ToolSelection(tool))
        x = cut - x
        rows.feed(x, 0.0, 0.0)
        if not ahead:
            rows.event(ToolSelection(tool))
        rows.set(tool=tool).event(Auxiliary(6))
    return rows


def test_a_magazine_without_a_time_for_places_has_found_its_tool() -> None:
    assert planned(changes(9), MILL, tool=1)[0].times.tool_change_s == CHANGE_S


def test_it_turns_beside_machining_and_m06_waits_for_the_rest() -> None:
    cut_s = planned(changes(9), MILL, tool=1)[0].times.cutting_s
    plan, hidden = planned(changes(9), turning(), tool=1)
    assert plan.times.tool_change_s == pytest.approx(CHANGE_S + 8 * PLACE_S - cut_s)
    assert hidden == pytest.approx(cut_s)
    assert plan.times.cutting_s == cut_s


def test_a_t_in_front_of_its_m06_hides_nothing() -> None:
    plan, hidden = planned(changes(9, ahead=False), turning(), tool=1)
    assert (plan.times.tool_change_s, hidden) == pytest.approx((CHANGE_S + 8 * PLACE_S, 0.0))


@pytest.mark.parametrize(("turns", "places"), [("shortest", 4), ("forward", 20)])
def test_it_turns_the_shorter_way_round_or_only_forward(turns: str, places: int) -> None:
    plan, _ = planned(changes(21, ahead=False), turning(turns=turns), tool=1)
    assert plan.times.tool_change_s == pytest.approx(CHANGE_S + places * PLACE_S)


def test_with_an_arm_the_old_tool_gets_the_pocket_of_the_new_one() -> None:
    # 1 -> 9: tool 1 lies in pocket 9 then; 9 -> 5: 4 places; 5 -> 1: from pocket 5 to pocket 9.
    plan, _ = planned(changes(9, 5, 1, ahead=False), turning(), tool=1)
    assert plan.times.tool_change_s == pytest.approx(3 * CHANGE_S + (8 + 4 + 4) * PLACE_S)


def test_without_an_arm_the_change_takes_the_old_tool_back_first() -> None:
    # 1 -> 9: 8 places; 9 -> 5: 4; 5 -> 1: 4. Nothing turns beside machining.
    plan, hidden = planned(changes(9, 5, 1), turning(pockets="fixed"), tool=1)
    assert plan.times.tool_change_s == pytest.approx(3 * CHANGE_S + (8 + 4 + 4) * PLACE_S)
    assert hidden == 0.0


def test_a_second_t_takes_the_way_from_where_the_first_one_ends() -> None:
    rows = Build().set(tool=1).event(ToolSelection(5)).event(ToolSelection(7)).set(tool=7).event(Auxiliary(6))
    assert planned(rows, turning(), tool=1)[0].times.tool_change_s == pytest.approx(CHANGE_S + 6 * PLACE_S)


def test_tools_without_a_place_are_not_turned_to() -> None:
    rows = Build().set(tool=1).event(ToolSelection(99)).set(tool=99).event(Auxiliary(6))
    rows.event(ToolSelection("DRILL")).set(tool=0, tool_name="DRILL").event(Auxiliary(6))
    assert planned(rows, turning(), tool=1)[0].times.tool_change_s == 2 * CHANGE_S


def test_chunks_do_not_matter() -> None:
    def total(chunk: int, keep_rows: bool) -> float:
        rows = Build(chunk_rows=chunk)
        rows.set(tool=1)
        for k in range(12):
            rows.event(ToolSelection(3 * k % 24 + 1)).set(
                spindle_rpm=1000.0 + 500.0 * (k % 3), spindle_direction=1
            )
            rows.rapid(100.0 * (k % 2), 0.0, 0.0).feed(50.0, 10.0 * k, 0.0)
            rows.set(tool=3 * k % 24 + 1).event(Auxiliary(6))
        return planned(rows, waiting("cut", turning()), tool=1, keep_rows=keep_rows)[0].total_s

    assert total(1, False) == total(65_536, True) == total(7, False)


def test_a_way_that_has_begun_is_gone_to_its_end() -> None:
    search = Search(turning().magazine)
    search.begin(5.0)
    search.left_s -= 0.5
    search.begin(3.0)
    assert search.left_s == pytest.approx(1.5 + 1.0)
    search.begin(4.0, since=3.0)
    assert search.left_s == pytest.approx(0.5)
