"""Stroke limits by parameter, PRESET, the handwheel's part of an axis, program tests that are held."""

from __future__ import annotations

from itertools import pairwise

import pytest

from polycnc.mainrun import CommandRefused, State, VirtualControl
from polycnc.messages.catalogue import LANGUAGES

#: Parameter of the upper limit of X, what says 20 mm, the control's alarm.
LIMITS = {
    "fanuc-m": ("1320 X", 20.0, "OT0500"),
    "meldas-m": ("2014 X", 20.0, "M01 0007"),
    "syntec-mill": ("2401", 20000.0, "PC0004"),
}
#: The lower limit, of -5 mm.
LOWER = {"fanuc-m": ("1321 X", -5.0), "meldas-m": ("2013 X", -5.0), "syntec-mill": ("2402", -5000.0)}


@pytest.mark.parametrize("control_id", LIMITS)
def test_a_stroke_limit_by_parameter_holds_in_programs_and_by_hand(control_id: str) -> None:
    (upper, value, code), (lower, least) = LIMITS[control_id], LOWER[control_id]
    control = VirtualControl(control_id, setup={"parameters": {upper: value, lower: least}})
    control.load("O1\nG90 G1 X20. F6000\nX20.01\nM30\n")
    control.cycle_start()
    control.run()
    assert [alarm.code for alarm in control.alarms] == [code]
    assert control.positions.machine["X"] == pytest.approx(20.0)
    control.reset()
    control.run()
    control.select_mode("jog")
    for direction, end in ((-1, -5.0), (1, 20.0)):
        control.jog("X", direction, rapid=True)
        control.run(limit_s=30.0)
        assert control.positions.machine["X"] == pytest.approx(end)
    control.write_parameter(upper, 1.5 * value)
    control.jog("X", 1, rapid=True)
    control.run(limit_s=30.0)
    assert control.positions.machine["X"] == pytest.approx(30.0)
    control.select_mode("handle")
    control.handle("X", 100, 1.0)
    control.run()
    assert control.positions.machine["X"] == pytest.approx(30.0)


@pytest.mark.parametrize("control_id", LIMITS)
def test_limits_of_which_plus_is_not_above_minus_are_none(control_id: str) -> None:
    (upper, value, _), (lower, _) = LIMITS[control_id], LOWER[control_id]
    control = VirtualControl(control_id, setup={"parameters": {upper: value, lower: value}})
    control.load("O1\nG90 G1 X50. F6000\nM30\n")
    control.cycle_start()
    assert control.run() is State.READY
    assert control.positions.machine["X"] == 50.0


# ---- PRESET --------------------------------------------------------------------------------------------------------


def test_preset_calls_the_place_of_an_axis_another_one() -> None:
    control = VirtualControl("sinumerik-840d", setup={"start": {"X": 5.0}})
    control.select_mode("jog")
    control.preset("X", 100.0)
    assert control.positions.machine["X"] == control.positions.work["X"] == 100.0
    assert control.positions.machine["Y"] == 0.0
    control.jog("X", 1)
    control.step(0.5)
    control.stop_jog("X")
    control.run()
    there = control.positions.machine["X"]
    assert there > 105.0
    control.power_off()
    control.run()
    control.power_on()
    control.run()
    assert control.positions.machine["X"] == pytest.approx(there)
    control.select_mode("auto")
    control.load("G91 G0 X7\nM30\n")
    control.cycle_start()
    control.run()
    assert control.positions.machine["X"] == pytest.approx(there + 7.0)


def test_preset_is_refused_in_other_modes_in_a_program_behind_a_transformation_and_on_other_controls() -> (
    None
):
    control = VirtualControl("sinumerik-840d")
    with pytest.raises(CommandRefused):
        control.preset("X", 1.0)
    control.load("G0 X1\nM0\nM30\n")
    control.cycle_start()
    control.run()
    control.select_mode("jog")
    with pytest.raises(CommandRefused):
        control.preset("X", 1.0)
    control.reset()
    control.run()
    with pytest.raises(CommandRefused):
        control.preset("Q", 1.0)
    assert control.positions.machine["X"] == 1.0
    other = VirtualControl("fanuc-m")
    other.select_mode("jog")
    with pytest.raises(CommandRefused) as refused:
        other.preset("X", 1.0)
    assert all("PRESET" in refused.value.text(lang) for lang in LANGUAGES)


# ---- the handwheel beside a program --------------------------------------------------------------------------------


def test_path_and_handwheel_together_keep_the_acceleration_of_the_axis() -> None:
    control = VirtualControl("sinumerik-840d")
    control.set_switches(drf=True)
    control.load("BRISK\nG0 X60\nG4 F0.2\nX0\nM30\n")
    acceleration = control.channel.axis_data[0].acceleration
    control.cycle_start()
    control.step(0.004)
    control.handle("X", 5000)
    places = [control.machine_position[0]]
    while control.state is State.RUNNING:
        control.step()
        places.append(control.machine_position[0])
    cycle = control.machine.interpolation_cycle_s
    speeds = [(b - a) / cycle for a, b in pairwise(places)]
    most = max(abs(b - a) / cycle for a, b in pairwise(speeds))
    assert places[-1] == pytest.approx(5.0)
    assert most <= acceleration * 1.001


def test_axes_in_the_work_system_go_millimetres_of_the_machine_where_it_is_scaled() -> None:
    control = VirtualControl("sinumerik-840d")
    control.load("ROT RPL=90\nASCALE X2\nG0 X10\nM0\nM30\n")
    control.cycle_start()
    control.run()
    before, shown = control.positions.machine, control.positions.work
    control.select_mode("increment")
    control.signals["JOG_WCS"] = 1.0
    control.increment("X", 1, 1.0)
    control.run()
    assert control.positions.machine["Y"] - before["Y"] == pytest.approx(1.0)
    assert control.positions.work["X"] - shown["X"] == pytest.approx(0.5)
    assert control.positions.work["Y"] == pytest.approx(shown["Y"])


# ---- program test --------------------------------------------------------------------------------------------------


def test_while_a_program_test_is_held_no_axis_is_moved_by_hand() -> None:
    control = VirtualControl("sinumerik-840d")
    control.load("N10 G1 X50 F6000\nN20 X60\nN30 X70\nM30\n")
    control.block_search("N30", how="program-test")
    control.step(0.3)
    control.feed_hold()
    control.run()
    shown = control.positions
    control.select_mode("jog")
    with pytest.raises(CommandRefused):
        control.jog("X", 1)
    control.select_mode("increment")
    with pytest.raises(CommandRefused):
        control.increment("X", 1, 1.0)
    assert control.positions == shown
    control.reset()
    control.run()
    control.increment("X", 1, 1.0)
    control.run()
    assert control.positions.machine["X"] == pytest.approx(1.0)


def test_the_message_of_a_program_test_ends_with_the_power() -> None:
    control = VirtualControl("sinumerik-840d")
    control.load("GOTOF ENDE\nN5 G0 X1\nENDE: G1 X5 F1000\nM30\n")
    control.block_search("N5", how="program-test")
    control.run()
    assert "N5" in control.messages[-1]
    control.power_off()
    control.run()
    assert control.messages == ()
    control.power_on()
    control.run()
    control.block_search("N5", how="program-test")
    control.step()  # the power goes while the program is being tested
    control.power_off()
    control.run()
    assert control.messages == ()
    control.power_on()
    assert control.run() is State.READY
    assert control.messages == ()
