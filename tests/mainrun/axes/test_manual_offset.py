"""Manual intervention: where a program goes on after its axes were moved by hand, with manual absolute on and off."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.mainrun import State, VirtualControl
from tests.mainrun.support import power_on

if TYPE_CHECKING:
    from pathlib import Path

#: The usual example: a hold in the second line, then 75 mm by hand along Y.
LINES = "O1\nG90 G1 X100. Y100. F5000.\nX200. Y150.\nX300. Y200.\nM30\n"


def intervened(
    text: str, way: dict[str, float], at_x: float = 150.0, *, absolute: bool = True, **more: object
) -> VirtualControl:
    """A program that is held, whose axes are moved by hand, and that has been started again."""
    control = str(more.pop("control", "fanuc-m"))
    virtual = power_on(text, control, **more)
    virtual.signals["MANUAL_ABSOLUTE"] = float(absolute)
    virtual.cycle_start()
    assert virtual.run_until(lambda now: now.positions.work["X"] >= at_x)
    virtual.feed_hold()
    virtual.run()
    by_hand(virtual, way)
    virtual.cycle_start()
    return virtual


def by_hand(virtual: VirtualControl, way: dict[str, float]) -> None:
    virtual.select_mode("handle")
    for axis, value in way.items():
        virtual.handle(axis, round(value * 1000), 0.001)
    virtual.run()
    virtual.select_mode("auto")


def ends(virtual: VirtualControl) -> list[tuple[float, ...]]:
    """Machine X and Y at the end of each block with motion, as near as a cycle comes to it."""
    found: dict[int, tuple[float, ...]] = {}
    while virtual.is_busy:
        line = virtual.active_block.line
        virtual.step()
        if virtual.feed or virtual.active_block.line == line:
            found[line] = tuple(round(virtual.positions.machine[axis]) for axis in "XY")
    return list(found.values())


def test_with_manual_absolute_on_a_line_goes_to_its_end_from_where_the_axes_are() -> None:
    virtual = intervened(LINES, {"Y": 75.0})
    assert ends(virtual)[:2] == [(200, 150), (300, 200)]
    assert virtual.state is State.READY


def test_with_manual_absolute_off_everything_that_follows_is_shifted() -> None:
    virtual = intervened(LINES, {"Y": 75.0}, absolute=False)
    virtual.run()
    assert virtual.positions.machine["Y"] == 275.0
    assert virtual.positions.work["Y"] == 200.0, "the coordinates do not know of it"
    virtual.cycle_start()
    virtual.run()
    assert virtual.positions.machine["Y"] == 275.0, "also not in the next run"
    virtual.select_mode("reference")
    virtual.home("Y")
    virtual.run()
    assert virtual.positions.work["Y"] == virtual.positions.machine["Y"]


def test_only_an_axis_that_is_commanded_goes_back() -> None:
    virtual = intervened("O1\nG1 X100. F5000.\nX200.\nX210. Y0.\nM30\n", {"Y": 40.0, "Z": 10.0})
    assert virtual.run_until(lambda now: now.active_block.line == 4)
    assert virtual.machine_position == pytest.approx([200.0, 40.0, 10.0], abs=0.1)
    virtual.run()
    assert virtual.machine_position == [210.0, 0.0, 10.0]
    assert virtual.positions.work["Z"] == 10.0


def test_increments_are_run_beside_the_path_until_an_absolute_word_comes() -> None:
    text = "O1\nG91 G1 X100. F5000.\nX100.\nY10.\nG90 X300. Y10.\nM30\n"
    virtual = intervened(text, {"Y": 75.0})
    assert virtual.run_until(lambda now: now.active_block.line == 5)
    assert virtual.machine_position == pytest.approx([200.0, 85.0, 0.0], abs=0.1)
    virtual.run()
    assert virtual.machine_position == [300.0, 10.0, 0.0]


def test_an_arc_is_run_beside_its_path() -> None:
    virtual = intervened("O1\nG1 X50. F3000.\nG2 X100. Y-50. R50.\nG1 X100. Y-100.\nM30\n", {"X": 20.0}, 60.0)
    assert virtual.run_until(lambda now: now.active_block.line == 4)
    assert virtual.machine_position == pytest.approx([120.0, -50.0, 0.0], abs=0.2)
    virtual.run()
    assert virtual.machine_position == [100.0, -100.0, 0.0]


def test_after_a_single_block_the_next_line_starts_from_where_the_axes_are() -> None:
    virtual = power_on(LINES)
    virtual.set_switches(single_block=True)
    virtual.cycle_start()
    while virtual.run() is State.STOPPED and virtual.positions.work["X"] < 100.0:
        virtual.cycle_start()
    by_hand(virtual, {"X": 20.0, "Y": 100.0})
    virtual.set_switches(single_block=False)
    virtual.cycle_start()
    assert virtual.machine_position == [120.0, 200.0, 0.0]
    assert ends(virtual)[1:3] == [(200, 150), (300, 200)]


def test_a_hole_is_drilled_to_its_bottom_after_the_tool_was_lifted() -> None:
    text = "O1\nG0 X10.\nG81 X50. Z-30. R2. F300.\nX60.\nM30\n"
    virtual = power_on(text)
    virtual.cycle_start()
    assert virtual.run_until(lambda now: now.machine_position[2] < -10.0)
    virtual.feed_hold()
    virtual.run()
    by_hand(virtual, {"Z": 40.0})
    virtual.cycle_start()
    depths = []
    while virtual.is_busy:
        virtual.step()
        depths.append(virtual.machine_position[2])
    assert min(depths) == pytest.approx(-30.0)
    assert virtual.machine_position == [60.0, 0.0, 0.0]


def test_the_feed_override_and_hold_act_on_the_way_back() -> None:
    virtual = intervened(LINES, {"Y": 75.0})
    virtual.step(0.2)
    virtual.override(feed=0.1)
    virtual.step(0.5)
    assert virtual.feed == pytest.approx(500.0)
    virtual.feed_hold()
    virtual.run()
    assert virtual.state is State.HOLD
    by_hand(virtual, {"Y": -10.0})
    virtual.override(feed=1.0)
    virtual.cycle_start()
    assert ends(virtual)[:2] == [(200, 150), (300, 200)]


def test_a_path_that_is_shifted_out_of_the_limits_is_an_alarm_before_it_leaves_them(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    file.write_text('base = "mill3"\n\n[axis.X]\nlimit_minus = -10\nlimit_plus = 400\n', encoding="utf-8")
    virtual = intervened("O1\nG91 G1 X10. F5000.\nX100.\nX100.\nM30\n", {"X": 220.0}, 50.0, machine=file)
    assert virtual.run() is State.ALARM
    assert [(alarm.code, alarm.line) for alarm in virtual.alarms] == [("OT0500", 4)]
    assert virtual.machine_position[0] == pytest.approx(330.0)


def test_manual_intervention_and_return_leads_back_first() -> None:
    setup = {"parameters": {7001: 1}}
    virtual = intervened("O1\nG1 X200. F5000.\nM30\n", {"Y": 40.0}, setup=setup)
    assert virtual.run_until(lambda now: abs(now.machine_position[1]) < 0.001)
    assert virtual.machine_position[0] < 180.0
    virtual.run()
    assert virtual.machine_position == [200.0, 0.0, 0.0]


@pytest.mark.parametrize("control", ["sinumerik-840d", "syntec-mill"])
def test_other_controls_lead_back_first(control: str) -> None:
    virtual = intervened("G1 X200. F5000.\nM30\n", {"Y": 40.0}, control=control)
    virtual.run()
    assert virtual.machine_position == [200.0, 0.0, 0.0]


def test_what_a_program_reads_at_a_stop_counts_the_intervention() -> None:
    text = "O1\nG91 G1 X100. F5000.\nX100.\nM0\n#100=#5042\nM30\n"
    virtual = intervened(text, {"Y": 75.0})
    assert virtual.run() is State.STOPPED
    virtual.cycle_start()
    virtual.run()
    assert virtual.read_variable("#100") == 75.0
