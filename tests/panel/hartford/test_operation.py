"""What changes the way of a program by hand: overrides, stops, locks, emergency stop (Hartford 5.2.4.4 to 5.2.4.14)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.mainrun import State
from polycnc.panel import Light

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.panel.bench import Bench

    Make = Callable[..., Bench]

HOLD = ("Feed hold (SW3)", "進給暫停 (SW3)")
START = ("Cycle start (SW4)", "循環啟動 (SW4)")
COOLANT = ("Coolant pump", "切削液泵")
CW = ("Spindle clockwise", "主軸正轉")
LONG = "O1\nG90 G1 X300. F1000\nM30\n"


def is_dim(panel: Bench, key: str) -> bool:
    """Whether a key would do nothing now."""
    return key in panel.look(panel.lang).dim


@pytest.mark.feature("har.panel_hold")
def test_feed_hold_lights_stops_the_axes_and_cycle_start_goes_on(bench: Make) -> None:
    panel = bench(LONG)
    panel.press("START")
    panel.passes(1.0)
    panel.press("HOLD")
    panel.control.run()
    stood = panel.control.positions.machine["X"]
    assert panel.is_lit(*HOLD)
    assert not panel.is_lit(*START)
    panel.passes(2.0)
    assert panel.control.positions.machine["X"] == stood
    panel.press("START")
    assert panel.light(*HOLD) is Light.OFF
    assert panel.is_lit(*START)
    assert panel.control.run() is State.READY
    assert panel.control.positions.work["X"] == 300.0


@pytest.mark.feature("har.panel_estop")
def test_the_emergency_stop_ends_everything_and_the_program_begins_at_its_head(bench: Make) -> None:
    panel = bench("O1\nM3 S500\nM8\nG90 G1 X300. F1000\nM30\n")
    panel.press("START")
    panel.passes(3.0)
    assert panel.is_lit(*CW)
    panel.press("EMERGENCY")
    panel.control.run()
    assert panel.state() is State.EMERGENCY
    assert panel.is_lit("Alarm of the control", "NC 警示")
    assert not panel.is_lit(*CW)
    assert not panel.is_lit(*COOLANT)
    stood = panel.control.positions.machine["X"]
    panel.press("START")
    assert panel.message
    panel.release("EMERGENCY")
    panel.control.run()
    assert panel.state() is State.READY
    assert panel.control.active_block.line == 0
    panel.press("START")
    panel.passes(0.2)
    assert panel.control.active_block.line <= 4
    assert panel.control.positions.machine["X"] == pytest.approx(stood, abs=5.0)
    assert panel.control.run() is State.READY


@pytest.mark.feature("har.panel_optstop")
def test_m01_stops_behind_the_move_of_its_block_with_spindle_and_coolant_or_is_passed(bench: Make) -> None:
    panel = bench("O1\nM3 S500\nM8\nG90 G0 X5. M01\nG0 X9.\nM30\n")
    assert panel.start() is State.READY
    panel.press("C8", "C2")
    assert panel.is_lit("Optional stop", "選擇性停止")
    assert panel.start() is State.STOPPED
    assert panel.control.positions.work["X"] == 5.0
    assert panel.is_lit("Stop M00, M01", "停止 M00、M01")
    assert not panel.is_lit(*COOLANT)
    assert panel.control.signals["SPINDLE_TURNS"] == 0.0
    panel.press("START")
    panel.passes(0.1)
    assert panel.is_lit(*COOLANT)
    assert panel.control.signals["SPINDLE_TURNS"] == 1.0
    assert panel.control.run() is State.READY


@pytest.mark.feature("har.panel_skip")
def test_block_delete_leaves_blocks_with_a_slash_out(bench: Make) -> None:
    panel = bench("O1\nG90 G0 X1.\n/G0 Y-7.\nM30\n")
    panel.press("C8", "C3")
    assert panel.is_lit("Block delete", "單節刪除")
    panel.start()
    assert panel.control.positions.work["Y"] == 0.0
    panel.press("C8", "C3")
    panel.start()
    assert panel.control.positions.work["Y"] == -7.0


@pytest.mark.feature("har.panel_dry")
def test_dry_run_moves_at_the_speed_of_the_jog_switch(bench: Make) -> None:
    panel = bench("O1\nG90 G1 X-300. F200\nM30\n")
    panel.press("C8", "C4")
    assert panel.is_lit("Dry run", "試運轉")
    panel.turn("feed", "150")
    panel.press("START")
    panel.passes(1.0)
    assert panel.control.feed == pytest.approx(1500.0)
    panel.turn("feed", "0")
    panel.passes(1.0)
    assert panel.control.feed == 0.0


@pytest.mark.feature("har.panel_lock")
def test_machine_lock_keeps_every_axis_while_the_display_runs_on(bench: Make) -> None:
    panel = bench("O1\nG90 G0 X5. Y-6. Z-7.\nM0\nM30\n")
    panel.press("C8", "C5")
    assert panel.is_lit("Machine lock", "機械鎖固")
    assert panel.start() is State.STOPPED
    assert set(panel.control.positions.real.values()) == {0.0}
    assert "-7.000" in panel.text


@pytest.mark.feature("har.panel_sp_ovr", "har.panel_feed_ovr")
def test_overrides_act_between_their_ends_and_not_in_a_tapping_cycle(control: str, bench: Make) -> None:
    pitch = "F1." if control == "meldas-m" else "F500"  # MELDAS has the pitch there
    panel = bench(f"O1\nM3 S500\nG90 G1 X-100. F500\nG84 X0 Y0 Z-30. R-5. {pitch}\nG80\nM30\n")
    panel.turn("spindle", "120")
    panel.turn("feed", "200")
    panel.press("START")
    panel.passes(3.0)
    assert panel.control.spindle.rpm == pytest.approx(600.0)
    assert panel.control.feed == pytest.approx(1000.0)
    panel.turn("feed", "210")
    assert "210" in panel.message
    panel.turn("spindle", "40")
    assert "40" in panel.message
    taps = panel.control.run_until(
        lambda control: "G84" in control.active_block.text and 0.0 < control.feed <= 600.0, limit_s=60.0
    )
    assert taps
    panel.passes(1.0)
    assert panel.control.spindle.rpm == pytest.approx(500.0)
    assert panel.control.feed == pytest.approx(500.0)


@pytest.mark.feature("har.panel_rapid_ovr")
def test_rapids_of_a_program_follow_their_switch(bench: Make) -> None:
    panel = bench("O1\nG91 G0 X-400.\nM30\n")
    panel.turn("rapid", "20")
    panel.press("START")
    panel.passes(1.0)
    fastest = 60.0 * panel.control.channel.axis_data[0].rapid
    assert panel.control.feed == pytest.approx(0.2 * fastest)


def test_keys_that_do_nothing_now_are_dim(bench: Make) -> None:
    panel = bench(LONG)
    assert is_dim(panel, "B3")
    assert is_dim(panel, "POWER_ON")
    assert not is_dim(panel, "START")
    panel.turn("mode", "jog")
    assert not is_dim(panel, "B3")
    assert is_dim(panel, "START")
