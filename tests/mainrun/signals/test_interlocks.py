"""The machine's controller on the live signals: refusals, standing alarms, messages, rules of the Hartford machines."""

from __future__ import annotations

import pytest

from polycnc.mainrun import CommandRefused, State, VirtualControl
from tests.mainrun.support import hartford
from tests.support import HARTFORD_MILL4

RUN = "O1\nM3 S1000\nG1 X100. F6000\nG0 X0\nM30\n"


def codes(virtual: VirtualControl) -> list[str]:
    return [alarm.code for alarm in virtual.alarms]


@pytest.mark.parametrize(
    ("control", "program", "code", "line"),
    [
        ("fanuc-m", "O1\nG0 Z-5.\nT1 M6\nM30\n", "1046", 3),
        ("fanuc-m", "O1\nM6\nM30\n", "1054", 2),
        ("fanuc-m", "O1\nT99\nM30\n", "1041", 2),
        ("fanuc-m", "O1\nM11\nM3\nM30\n", "1095", 3),
        ("fanuc-m", "O1\nM3 S100\nM11\nM30\n", "1104", 3),
        ("fanuc-m", "O1\nG0 X1.\nM88\nM30\n", "1093", 3),
        ("meldas-m", "O1\nM11\nS200\nM30\n", "3007", 3),
        ("meldas-m", "O1\nM82\nM4\nM30\n", "3036", 3),
        ("meldas-m", "O1\nM33\nM30\n", "3010", 2),
        ("meldas-m", "O1\nT25\nM30\n", "3018", 2),
    ],
)
def test_a_word_that_is_refused_stops_the_program(control: str, program: str, code: str, line: int) -> None:
    virtual = hartford(program, control)
    virtual.cycle_start()
    assert virtual.run() is State.ALARM
    assert codes(virtual) == [code]
    assert virtual.alarms[0].line == line
    virtual.reset()
    assert virtual.run() is State.READY
    assert virtual.alarms == ()


def test_maintenance_codes_are_typed_in_at_mdi() -> None:
    virtual = VirtualControl("meldas-m", machine="hartford")
    virtual.select_mode("mdi")
    virtual.mdi("M31")
    assert virtual.run() is State.READY
    virtual.signals["PLC_SWITCH_32_OFF"] = 1.0
    virtual.mdi("M36")
    assert virtual.run() is State.ALARM
    assert codes(virtual) == ["3030"]


def test_a_mode_that_the_machine_refuses_is_not_chosen() -> None:
    virtual = VirtualControl("meldas-m", machine="hartford", setup={"switches": {"NOT_REFERENCED_B": 1}})
    virtual.select_mode("jog")
    with pytest.raises(CommandRefused, match="3015"):
        virtual.select_mode("mdi")
    assert str(virtual.mode) == "jog"


def test_a_tool_change_while_the_magazine_is_opened_stops() -> None:
    virtual = hartford("O1\nT2\nG4 P500\nM6\nM30\n")
    virtual.cycle_start()
    virtual.step(0.2)
    virtual.signals["MAGAZINE_DOOR_OPEN"] = 1.0
    assert (virtual.state, codes(virtual)) == (State.ALARM, ["1063"])
    virtual.run()
    assert virtual.tool.tool == 0


def test_a_refused_m_function_does_nothing() -> None:
    virtual = hartford("O1\nM11\nM3 S500\nM30\n")
    virtual.cycle_start()
    virtual.run()
    assert virtual.signals["SPINDLE_CW"] == 0.0
    assert virtual.spindle.rpm == 0.0


def test_the_state_that_counts_is_that_of_the_axes_not_of_the_preparation() -> None:
    virtual = hartford("O1\nG1 X100. F6000\nM11\nM3 S500\nM30\n")
    virtual.cycle_start()
    virtual.step(0.5)
    assert virtual.state is State.RUNNING
    assert virtual.run() is State.ALARM
    assert virtual.machine_position[0] == 100.0


def test_a_fault_of_the_machine_brakes_the_axes_and_stays_after_reset_until_it_is_gone() -> None:
    virtual = hartford(RUN)
    virtual.cycle_start()
    virtual.step(0.3)
    virtual.signals["AIR_LOW"] = 1.0
    assert virtual.state is State.ALARM
    virtual.run()
    assert 0.0 < virtual.machine_position[0] < 100.0
    assert virtual.feed == 0.0
    virtual.reset()
    virtual.run()
    assert (virtual.state, codes(virtual)) == (State.ALARM, ["1051"])
    virtual.signals["AIR_LOW"] = 0.0
    virtual.reset()
    virtual.run()
    assert (virtual.state, codes(virtual)) == (State.READY, [])


def test_several_faults_are_several_alarms() -> None:
    virtual = VirtualControl("meldas-m", machine="hartford", setup={"switches": {"LUBE_EMPTY": 1}})
    assert codes(virtual) == ["3004"]
    virtual.signals["FUSE_BLOWN"] = 1.0
    assert codes(virtual) == ["3004", "3029"]


@pytest.mark.parametrize(("control", "code"), [("fanuc-m", "1007"), ("meldas-m", "4008")])
def test_the_emergency_stop_has_its_alarm(control: str, code: str) -> None:
    virtual = hartford(RUN, control)
    virtual.cycle_start()
    virtual.step(0.3)
    virtual.emergency_stop()
    assert (virtual.state, codes(virtual)) == (State.EMERGENCY, [code])
    virtual.run()
    virtual.emergency_stop(pressed=False)
    virtual.run()
    assert (virtual.state, codes(virtual)) == (State.READY, [])


@pytest.mark.parametrize(("control", "code"), [("fanuc-m", "2021"), ("meldas-m", "3074")])
def test_feed_hold_is_a_message_as_long_as_it_lasts(control: str, code: str) -> None:
    virtual = hartford(RUN, control)
    virtual.cycle_start()
    virtual.step(0.3)
    virtual.feed_hold()
    assert virtual.notices == (code,)
    assert virtual.snapshot.notices == (code,)
    virtual.cycle_start()
    assert not [*virtual.notices]


@pytest.mark.parametrize(("control", "code"), [("fanuc-m", "2027"), ("meldas-m", "1006")])
def test_the_start_waits_for_the_zero_return(control: str, code: str) -> None:
    lost = {f"NOT_REFERENCED_{axis}": 1 for axis in "XYZ"}
    virtual = hartford(RUN, control, setup={"switches": lost, "start": {"X": -50, "Y": -5, "Z": -10}})
    with pytest.raises(CommandRefused, match=code):
        virtual.cycle_start()
    assert (virtual.state, virtual.notices) == (State.READY, (code,))
    virtual.select_mode("reference")
    virtual.home("X")
    virtual.run()
    virtual.home()
    virtual.run()
    virtual.select_mode("auto")
    virtual.cycle_start()
    assert virtual.run() is State.READY


def test_an_open_door_refuses_the_start_with_an_alarm() -> None:
    virtual = hartford(RUN, setup={"switches": {"DOOR_OPEN": 1}})
    with pytest.raises(CommandRefused, match="1098"):
        virtual.cycle_start()
    assert (virtual.state, codes(virtual)) == (State.ALARM, ["1098"])


@pytest.mark.parametrize(("control", "code"), [("fanuc-m", "1097"), ("meldas-m", "3008")])
def test_a_clamped_axis_is_not_moved_by_a_program(control: str, code: str) -> None:
    virtual = hartford("O1\nM24\nG0 X5.\nA10.\nM30\n", control, machine=HARTFORD_MILL4)
    virtual.cycle_start()
    assert virtual.run() is State.ALARM
    assert codes(virtual) == [code]
    assert virtual.machine_position == [5.0, 0.0, 0.0, 0.0]
    virtual = hartford("O1\nM24\nM25\nG0 X5.\nA10.\nM30\n", control, machine=HARTFORD_MILL4)
    virtual.cycle_start()
    assert virtual.run() is State.READY


def test_a_clamped_axis_does_not_move_by_hand() -> None:
    virtual = hartford("O1\nM24\nM30\n", machine=HARTFORD_MILL4)
    virtual.cycle_start()
    virtual.run()
    virtual.select_mode("jog")
    virtual.jog("X", 1)
    with pytest.raises(CommandRefused, match="1097"):
        virtual.jog("A", 1)


@pytest.mark.parametrize(("control", "code"), [("fanuc-m", "2031"), ("meldas-m", "3012")])
def test_a_spindle_that_was_stopped_by_hand_holds_the_program(control: str, code: str) -> None:
    virtual = hartford(RUN, control)
    virtual.cycle_start()
    virtual.step(0.3)
    assert virtual.spindle.rpm == 1000.0
    virtual.select_mode("jog")
    virtual.run()
    virtual.signals["KEY_B2"] = 1.0
    virtual.signals["KEY_B2"] = 0.0
    assert virtual.spindle.rpm == 0.0
    virtual.select_mode("auto")
    with pytest.raises(CommandRefused, match=code):
        virtual.cycle_start()


def test_spindle_and_coolant_rest_at_m01_and_come_back() -> None:
    virtual = hartford("O1\nM3 S800\nM8\nG0 X5.\nM01\nG0 X9.\nM30\n")
    virtual.set_switches(optional_stop=True)
    virtual.cycle_start()
    virtual.run()
    assert (virtual.spindle.rpm, virtual.signals["COOLANT"], virtual.signals["HALT_M01"]) == (0.0, 0.0, 1.0)
    virtual.cycle_start()
    virtual.step(0.01)
    assert (virtual.spindle.rpm, virtual.signals["COOLANT"], virtual.signals["HALT_M01"]) == (800.0, 1.0, 0.0)


def test_m73_holds_the_feed_at_100_percent_until_m74() -> None:
    virtual = hartford("O1\nM73\nG1 X100. F6000\nM74\nG1 X200.\nM30\n")
    virtual.override(feed=0.5)
    virtual.cycle_start()
    virtual.run_until(lambda control: control.machine_position[0] > 50.0)
    assert virtual.feed == pytest.approx(6000.0)
    virtual.run_until(lambda control: control.machine_position[0] > 150.0)
    assert virtual.feed == pytest.approx(3000.0)


def test_m75_holds_the_spindle_at_100_percent_until_m76() -> None:
    virtual = hartford("O1\nM3 S1000\nM75\nG1 X100. F6000\nM76\nG1 X200.\nM30\n")
    virtual.override(spindle=1.2)
    virtual.cycle_start()
    virtual.run_until(lambda control: control.machine_position[0] > 50.0)
    assert virtual.spindle.rpm == pytest.approx(1000.0)
    virtual.run_until(lambda control: control.machine_position[0] > 150.0)
    assert virtual.spindle.rpm == pytest.approx(1200.0)


def test_the_magazine_counts_its_pockets() -> None:
    virtual = hartford("O1\nM97\nM97\nM96\nM30\n")
    virtual.cycle_start()
    virtual.run()
    assert virtual.signals["MAGAZINE_POCKET"] == 24.0


def test_power_off_keeps_the_program_and_drops_the_outputs() -> None:
    virtual = hartford("O1\nM3 S100\nM8\nM0\nM30\n")
    virtual.cycle_start()
    virtual.run()
    virtual.power_off()
    virtual.run()
    assert virtual.state is State.OFF
    assert virtual.signals["SPINDLE_CW"] == virtual.signals["COOLANT_ON"] == 0.0
    with pytest.raises(CommandRefused):
        virtual.cycle_start()
    with pytest.raises(CommandRefused):
        virtual.reset()
    virtual.power_on()
    virtual.run()
    assert (virtual.state, virtual.program) == (State.READY, "O0001")


def test_incremental_encoders_forget_at_power_off() -> None:
    virtual = hartford(RUN, setup={"switches": {"INCREMENTAL_ENCODERS": 1}})
    virtual.cycle_start()
    assert virtual.run() is State.READY
    virtual.power_off()
    virtual.power_on()
    virtual.run()
    with pytest.raises(CommandRefused, match="2027"):
        virtual.cycle_start()


def test_z_lock_keeps_z_alone_and_the_display_runs_on() -> None:
    virtual = hartford("O1\nG0 X10. Z-20.\nM30\n")
    virtual.set_switches(z_lock=True)
    virtual.cycle_start()
    virtual.run()
    assert (virtual.positions.machine["Z"], virtual.positions.real["Z"]) == (-20.0, 0.0)
    assert virtual.positions.real["X"] == 10.0
    virtual.set_switches(z_lock=False)
    assert (virtual.positions.machine["Z"], virtual.positions.machine["X"]) == (0.0, 10.0)


def test_mst_lock_keeps_m_s_t_from_the_machine() -> None:
    virtual = hartford("O1\nT1 M6\nM3 S500\nM8\nG0 X5.\nM0\nM30\n")
    virtual.set_switches(mst_lock=True)
    virtual.cycle_start()
    assert virtual.run() is State.STOPPED
    assert (virtual.spindle.rpm, virtual.signals["COOLANT_ON"]) == (0.0, 0.0)
    virtual.cycle_start()
    assert virtual.run() is State.READY
    assert virtual.signals["M30_END"] == 1.0


def test_a_tape_program_runs_without_being_stored() -> None:
    virtual = hartford("O1\nG0 X10.\nM30\n")
    virtual.load_tape("O7\nG0 Y7.\nM30\n")
    virtual.select_mode("tape")
    virtual.cycle_start()
    virtual.run()
    assert virtual.machine_position[:2] == [0.0, 7.0]
    assert virtual.program == "O0001"
    virtual.select_mode("auto")
    virtual.cycle_start()
    virtual.run()
    assert virtual.machine_position[:2] == [10.0, 7.0]


def test_dry_run_has_no_effect_on_tape() -> None:
    for mode, feed in (("auto", 1000.0), ("tape", 3000.0)):
        virtual = hartford("O1\nG1 X100. F3000\nM30\n")
        virtual.load_tape("O1\nG1 X100. F3000\nM30\n")
        virtual.set_switches(dry_run=True)
        virtual.select_mode(mode)
        virtual.cycle_start()
        virtual.run_until(lambda control: control.machine_position[0] > 50.0)
        assert virtual.feed == pytest.approx(feed), mode


def test_the_restart_data_tell_the_way_back() -> None:
    virtual = hartford("O1\nG0 X10.\nY20.\nG1 X50. F500\nM30\n")
    assert virtual.restart == {}
    virtual.block_search(4)
    assert virtual.restart["X"] == (10.0, 10.0)
    assert virtual.restart["Y"] == (20.0, 20.0)
    virtual.select_mode("handle")
    virtual.handle("X", 100, 0.1)
    virtual.run()
    assert virtual.restart["X"] == (10.0, 0.0)
    virtual.select_mode("auto")
    virtual.cycle_start()
    virtual.run()
    assert virtual.restart == {}
    assert virtual.machine_position[:2] == [50.0, 20.0]
