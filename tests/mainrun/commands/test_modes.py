"""Operating modes, switches and stops."""

from __future__ import annotations

import itertools
from math import pi, sqrt
from pathlib import Path

import pytest

from polycnc.mainrun import Command, CommandRefused, Mode, State, VirtualControl
from polycnc.mainrun.commands import search
from polycnc.mainrun.commands.states import ALLOWED, is_allowed
from tests.mainrun.support import power_on, recorded, run_through

TWO_MOVES = "O1\nG0 X10.\nG0 Y10.\nM30\n"


def test_every_command_has_its_row_and_every_mode_and_state_allows_reset() -> None:
    assert set(ALLOWED) == set(Command)
    for mode, state in itertools.product(Mode, State):
        assert is_allowed(Command.RESET, mode, state)


def test_a_command_out_of_place_is_refused_in_both_languages() -> None:
    virtual = power_on()
    with pytest.raises(CommandRefused) as refused:
        virtual.jog("X", 1)
    assert "jog" in refused.value.text("en")
    assert "寸動" in refused.value.text("zh-TW")
    assert refused.value.text("en") != refused.value.text("zh-TW")


def test_without_a_program_nothing_starts() -> None:
    with pytest.raises(CommandRefused):
        VirtualControl("fanuc-m").cycle_start()


# ---- stops -------------------------------------------------------------------------------------------------


def test_single_block_halts_behind_each_block() -> None:
    virtual = power_on(TWO_MOVES)
    virtual.set_switches(single_block=True)
    virtual.cycle_start()
    assert virtual.run() is State.STOPPED
    assert virtual.snapshot.halt == "single-block"
    assert virtual.machine_position == [10.0, 0.0, 0.0]
    assert virtual.active_block.text == "G0 X10."
    virtual.cycle_start()
    virtual.run()
    assert virtual.machine_position == [10.0, 10.0, 0.0]


def test_single_block_acts_on_the_block_in_execution() -> None:
    virtual = power_on("O1\nG1 X10. F600\nX20.\nX30.\nM30\n")
    virtual.cycle_start()
    virtual.step(0.5)
    virtual.set_switches(single_block=True)
    virtual.run()
    assert virtual.machine_position[0] == 10.0
    virtual.set_switches(single_block=False)
    virtual.cycle_start()
    assert virtual.run() is State.READY


def test_single_block_under_compensation_halts_at_the_ends_of_the_compensated_blocks() -> None:
    text = "O1\nG41 D1 G1 X10. Y0 F600\nY20.\nX30.\nG40 X40.\nM30\n"
    virtual = power_on(text, setup={"tools": {1: {"radius": 2.0}}})
    virtual.set_switches(single_block=True)
    virtual.cycle_start()
    stops = []
    while virtual.run() is State.STOPPED:
        stops.append((virtual.active_block.line, [round(v, 3) for v in virtual.machine_position[:2]]))
        virtual.cycle_start()
    lines = [line for line, _ in stops]
    assert lines == [2, 3, 4, 5]
    assert stops[2][1] == [30.0, 22.0]


def test_sinumerik_single_block_kinds_differ() -> None:
    def stops(kind: str) -> int:
        virtual = power_on("R1=1\nG0 X1\nR2=2\nG0 X2\nM30\n", "sinumerik-840d")
        virtual.set_switches(single_block=kind)
        virtual.cycle_start()
        count = 0
        while virtual.run() is State.STOPPED:
            count += 1
            virtual.cycle_start()
        return count

    assert stops("SBL2") > stops("SBL1") > 0


def test_m00_stops_and_m01_only_with_the_switch() -> None:
    text = "O1\nG0 X10.\nM01\nG0 X20.\nM00\nG0 X30.\nM30\n"
    virtual = power_on(text)
    virtual.cycle_start()
    assert virtual.run() is State.STOPPED
    assert (virtual.snapshot.halt, virtual.machine_position[0]) == ("M00", 20.0)
    virtual.cycle_start()
    assert virtual.run() is State.READY
    virtual.set_switches(optional_stop=True)
    virtual.cycle_start()
    virtual.run()
    assert (virtual.snapshot.halt, virtual.machine_position[0]) == ("M01", 10.0)


@pytest.mark.parametrize(("control", "text"), [
    ("fanuc-m", "O1\nG0 X1.\n/G0 X5.\n/2 G0 Y5.\nM30\n"),
    ("sinumerik-840d", "G0 X1\n/G0 X5\n/2 G0 Y5\nM30\n"),
])  # fmt: skip
def test_block_skip_leaves_blocks_out(control: str, text: str) -> None:
    virtual = power_on(text, control)
    for skip, end in ((False, [5.0, 5.0]), (True, [1.0, 5.0]), ((2,), [5.0, 0.0]), (False, [5.0, 5.0])):
        virtual.select_mode("reference")
        virtual.home()
        virtual.run()
        virtual.select_mode("auto")
        virtual.set_switches(block_skip=skip)
        run_through(virtual)
        assert virtual.machine_position[:2] == end, skip


def test_an_alarm_stops_in_front_of_its_block_and_waits_for_reset() -> None:
    virtual = power_on("O1\nG1 X10. F600\nG999\nM30\n")
    virtual.cycle_start()
    virtual.step(0.3)
    assert virtual.state is State.RUNNING, "the alarm comes when its block would be executed"
    assert virtual.run() is State.ALARM
    assert virtual.machine_position[0] == 10.0
    assert [alarm.line for alarm in virtual.alarms] == [3]
    assert virtual.alarm_text(virtual.alarms[0])
    with pytest.raises(CommandRefused):
        virtual.cycle_start()
    virtual.reset()
    assert (virtual.state, virtual.alarms) == (State.READY, ())


# ---- reset and emergency stop --------------------------------------------------------------------------------


def test_reset_brakes_first_and_brings_modal_codes_back() -> None:
    virtual = power_on("O1\nG91 G1 X100. F6000\nM30\n")
    virtual.cycle_start()
    virtual.step(0.3)
    assert virtual.modal["distance"] == "G91"
    virtual.reset()
    assert virtual.state is State.BRAKING
    before = virtual.machine_position[0]
    assert virtual.run() is State.READY
    # Half of the line's ramp T = √(v/j) behind, then at j·T (`kernels/alone.py`).
    ramp = sqrt(100.0 / 50000.0)
    braking = 100.0 * 0.5 * ramp + 100.0**2 / (2.0 * 50000.0 * ramp)
    assert virtual.machine_position[0] == pytest.approx(before + braking)
    assert virtual.modal["distance"] == "G90"
    virtual.cycle_start()
    virtual.run()
    assert virtual.machine_position[0] == pytest.approx(before + braking + 100.0)


def test_the_emergency_stop_ends_the_program() -> None:
    virtual = power_on()
    virtual.cycle_start()
    virtual.step(1.0)
    virtual.emergency_stop()
    virtual.run()
    assert virtual.state is State.EMERGENCY
    for refused in (virtual.reset, virtual.cycle_start):
        with pytest.raises(CommandRefused):
            refused()
    virtual.emergency_stop(pressed=False)
    assert virtual.run() is State.READY
    virtual.cycle_start()
    assert virtual.active_block.line <= 2, "from the head of the program"


# ---- MDI ---------------------------------------------------------------------------------------------------


def test_mdi_runs_blocks_and_what_they_change_stays() -> None:
    virtual = power_on()
    virtual.select_mode("mdi")
    virtual.mdi("G91 G0 X10.")
    assert virtual.run() is State.READY
    virtual.mdi("X10.")
    virtual.run()
    assert virtual.positions.work["X"] == 20.0
    assert virtual.modal["distance"] == "G91"
    assert virtual.parts == 0


def test_a_mistake_in_mdi_is_an_alarm() -> None:
    virtual = power_on()
    virtual.select_mode("mdi")
    virtual.mdi("G999 X10.")
    assert virtual.run() is State.ALARM


# ---- by hand -----------------------------------------------------------------------------------------------


def test_jog_runs_while_the_key_is_pressed() -> None:
    virtual = power_on()
    virtual.select_mode("jog")
    virtual.jog("X", 1)
    virtual.step(1.0)
    assert virtual.feed == pytest.approx(1000.0)
    virtual.override(feed=0.5)
    virtual.step(1.0)
    assert virtual.feed == pytest.approx(500.0)
    virtual.stop_jog("X")
    virtual.run()
    assert virtual.feed == 0.0
    assert virtual.machine_position[0] == pytest.approx(25.0, abs=0.1)


def test_jog_ends_at_the_limit(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    limits = "limit_minus = -10\nlimit_plus = 60\n"
    file.write_text(f'base = "mill3"\n\n[axis.X]\n{limits}', encoding="utf-8")
    virtual = power_on(machine=file)
    virtual.select_mode("jog")
    virtual.jog("X", 1, rapid=True)
    virtual.run()
    assert virtual.machine_position[0] == 60.0
    virtual.jog("X", -1)
    virtual.run()
    assert virtual.machine_position[0] == -10.0


def test_real_time_paces_the_clock(monkeypatch: pytest.MonkeyPatch) -> None:
    now, slept = [100.0], [0.0]

    def sleep(seconds: float) -> None:
        slept[0] += seconds
        now[0] += seconds

    monkeypatch.setattr("time.monotonic", lambda: now[0])
    monkeypatch.setattr("time.sleep", sleep)
    virtual = power_on("O1\nG1 X10. F600\nM30\n")
    virtual.cycle_start()
    assert virtual.run(real_time=True) is State.READY
    assert slept[0] == pytest.approx(virtual.time)


def test_an_override_of_zero_lets_a_jog_wait() -> None:
    virtual = power_on()
    virtual.select_mode("increment")
    virtual.increment("Y", -3, 1.0)
    virtual.step(0.05)
    virtual.override(feed=0.0)
    virtual.step(1.0)
    assert -3.0 < virtual.machine_position[1] < 0.0
    virtual.override(feed=1.0)
    virtual.run()
    assert virtual.machine_position[1] == -3.0


def test_handle_pulses_add_up() -> None:
    virtual = power_on()
    virtual.select_mode("handle")
    for _ in range(5):
        virtual.handle("Z", 10, 0.1)
        virtual.step(0.01)
    virtual.handle("Z", -20, 0.1)
    virtual.run()
    assert virtual.machine_position[2] == pytest.approx(3.0)


def test_two_axes_jog_at_once() -> None:
    virtual = power_on()
    virtual.select_mode("jog")
    virtual.jog("X", 1)
    virtual.jog("Y", -1)
    virtual.step(1.0)
    virtual.stop_jog()
    virtual.run()
    x, y, _ = virtual.machine_position
    assert x == pytest.approx(-y)
    assert x > 10.0


def test_reference_approach_leads_to_the_reference_point() -> None:
    virtual = power_on("O1\nG0 X-50. Y20.\nM30\n")
    run_through(virtual)
    virtual.select_mode("reference")
    virtual.home("X")
    virtual.run()
    assert virtual.machine_position[:2] == [virtual.machine.axis["X"].reference_points[0], 20.0]


def test_an_unknown_axis_is_refused() -> None:
    virtual = power_on()
    virtual.select_mode("jog")
    with pytest.raises(CommandRefused):
        virtual.jog("Q", 1)


def test_axes_moved_in_between_go_back_before_the_program_goes_on() -> None:
    virtual = power_on("G1 X100. F6000\nM30\n", "sinumerik-840d")
    records = recorded(virtual)
    virtual.cycle_start()
    virtual.step(0.5)
    virtual.select_mode("jog")
    assert virtual.state is State.HOLD
    virtual.run()
    virtual.jog("Y", 1)
    virtual.step(1.0)
    virtual.stop_jog()
    virtual.run()
    assert virtual.machine_position[1] > 10.0
    with pytest.raises(CommandRefused):
        virtual.cycle_start()
    virtual.select_mode("auto")
    virtual.cycle_start()
    assert virtual.run_until(lambda control: abs(control.machine_position[1]) < 0.001, limit_s=10.0)
    assert virtual.run() is State.READY
    assert virtual.machine_position == [100.0, 0.0, 0.0]
    assert records[-1].data["state"] is State.READY


def test_a_program_goes_on_only_in_its_own_mode() -> None:
    virtual = power_on()
    virtual.cycle_start()
    virtual.step(1.0)
    virtual.select_mode("mdi")
    virtual.run()
    with pytest.raises(CommandRefused, match="auto"):
        virtual.cycle_start()


# ---- dry run, machine lock, teach-in, block search -----------------------------------------------------------


def test_dry_run_takes_the_jog_rate() -> None:
    virtual = power_on("O1\nG1 X1000. F10.\nM30\n")
    virtual.set_switches(dry_run=True)
    virtual.cycle_start()
    virtual.step(1.0)
    assert virtual.feed == pytest.approx(1000.0)


@pytest.mark.parametrize("control", ["fanuc-m", "fanuc-0i-tf"])
def test_1410_is_the_speed_of_a_dry_run(control: str) -> None:
    text = "O1\nG98 G1 Z1000. F10.\nM30\n" if control == "fanuc-0i-tf" else "O1\nG1 X1000. F10.\nM30\n"
    virtual = power_on(text, control, setup={"parameters": {1410: 600}})
    virtual.set_switches(dry_run=True)
    virtual.cycle_start()
    virtual.step(1.0)
    assert virtual.feed == pytest.approx(600.0)


def test_under_machine_lock_the_display_runs_and_the_axes_stand() -> None:
    virtual = power_on(TWO_MOVES)
    virtual.set_switches(machine_lock=True)
    run_through(virtual)
    assert virtual.positions.machine["X"] == 10.0
    assert virtual.positions.real["X"] == 0.0
    virtual.set_switches(machine_lock=False)
    assert virtual.positions.machine["X"] == 0.0


def test_teach_in_writes_positions_into_the_program() -> None:
    virtual = power_on("O1\nG90 G1 F600\nM30\n")
    virtual.select_mode("teach")
    virtual.increment("X", 5, 1.0)
    virtual.run()
    assert virtual.teach("G1", line=2) == "G1 X5. Y0. Z0."
    virtual.increment("Y", 7, 1.0)
    virtual.run()
    virtual.teach()
    virtual.select_mode("reference")
    virtual.home()
    virtual.run()
    virtual.select_mode("auto")
    records = recorded(virtual)
    run_through(virtual)
    assert virtual.machine_position == [5.0, 7.0, 0.0]
    assert [r.data["line"] for r in records if r.what == "block"] == [2, 3, 4, 5]


SEARCHED = "O1\nG90 G54 S500 M3\nM8\nG1 X10. F600\nN40 G91 Y20.\nN50 X30.\nM9\nM30\n"


@pytest.mark.parametrize("target", [6, "N50"])
def test_block_search_calculates_what_lies_before(target: int | str) -> None:
    virtual = power_on(SEARCHED)
    records = recorded(virtual)
    virtual.block_search(target)
    assert virtual.state is State.STOPPED
    assert virtual.machine_position == [0.0, 0.0, 0.0]
    assert virtual.modal["distance"] == "G91"
    virtual.cycle_start()
    assert virtual.run_until(lambda control: control.active_block.line == 6, limit_s=100.0)
    assert virtual.machine_position[:2] == pytest.approx([10.0, 20.0], abs=0.05)
    assert virtual.run() is State.READY
    assert virtual.machine_position[:2] == [40.0, 20.0]
    assert [r.data["code"] for r in records if r.data.get("type") == "m"] == [3, 8, 9, 30]


#: Programs whose block N30 only calculates or jumps.
STATEMENTS = {
    "fanuc-m": "O1\nN10 G1 X10. F6000\nN20 Y20.\nN30 #1=30.\nN40 X#1\nM30\n",
    "meldas-m": "O1\nN10 G1 X10. F6000\nN20 Y20.\n#1=30.\nN30 IF[#1GT3]GOTO40\nX1.\nN40 X#1\nM30\n",
    "syntec-mill": "%@MACRO\nN10 G1 X10. F6000;\nN20 Y20.;\nN30 #1 := 30.;\nN40 X#1;\nM30;\n",
    "sinumerik-840d": "N10 G1 X10 F6000\nN20 Y20\nR1=30\nN30 IF R1>3 GOTOF N40\nX1\nN40 X=R1\nM30\n",
}


@pytest.mark.parametrize("control", STATEMENTS)
@pytest.mark.parametrize("how", ["contour", "end-point", "program-test"])
def test_a_block_that_only_calculates_is_found(control: str, how: str) -> None:
    virtual = VirtualControl(control)
    virtual.load(STATEMENTS[control])
    virtual.block_search("N30", how=how)
    virtual.run()
    assert (virtual.state, virtual.machine_position) == (State.STOPPED, [0.0, 0.0, 0.0])
    records = recorded(virtual)
    run_through(virtual)
    assert virtual.machine_position == [30.0, 20.0, 0.0]
    in_front = range(1, STATEMENTS[control].partition("N30")[0].count("\n") + 1)
    assert not any(r.data["line"] in in_front for r in records if r.what == "block")


def test_block_search_for_a_block_that_never_comes_is_refused() -> None:
    virtual = power_on(SEARCHED)
    with pytest.raises(CommandRefused):
        virtual.block_search("N99")
    assert virtual.state is State.READY
    run_through(virtual)
    assert virtual.machine_position[:2] == [40.0, 20.0]


@pytest.mark.parametrize("how", ["contour", "end-point", "program-test"])
def test_block_search_says_that_a_block_belongs_to_the_shape_of_a_cycle(how: str) -> None:
    shape = "N100 G0 X20.\nN105 G1 Z-10. F50\nN110 X62.\n"
    text = f"G98 G0 X100. Z10.\nG71 U3. R1.\nG71 P100 Q110 F9000\n{shape}G70 P100 Q110\nM30\n"
    virtual = power_on(text, "fanuc-0i-tf")
    told = "block N105 runs only as a part of the block in line 7"
    if how == "program-test":
        virtual.block_search("N105", how=how)
        virtual.run(limit_s=600.0)
        assert any(told in message for message in virtual.messages)
        return
    with pytest.raises(CommandRefused, match=told):
        virtual.block_search("N105", how=how)


@pytest.mark.parametrize("how", ["contour", "end-point", "program-test"])
def test_a_search_for_where_g70_was_given_up_is_refused(how: str) -> None:
    shape = "N100 G0 X20.\nN105 G1 Z-10. F6000\nN110 X62.\n"
    virtual = power_on(f"G98 G0 X100. Z10.\n{shape}G70 P100 Q110\nM30\n", "fanuc-0i-tf")
    virtual.cycle_start()
    assert virtual.run_until(lambda control: [line for _, line in control.snapshot.interrupted] == [5, 4])
    virtual.reset()
    virtual.run()
    levels = virtual.snapshot.interrupted
    told = "block 4 runs only as a part of the block in line 5"
    if how == "program-test":
        virtual.block_search(levels, how=how)
        virtual.run(limit_s=600.0)
        assert any(told in message for message in virtual.messages)
    else:
        with pytest.raises(CommandRefused, match=told):
            virtual.block_search(levels, how=how)
    virtual.reset()
    virtual.block_search(levels[:1])
    assert virtual.state is State.STOPPED


def test_block_search_that_comes_to_an_alarm_tells_it() -> None:
    virtual = power_on("O1\nG1 X10. F600\nX[1/0]\nN40 X5.\nM30\n")
    with pytest.raises(CommandRefused) as refused:
        virtual.block_search("N40")
    for lang, where in (("en", "line 3"), ("zh-TW", "第 3 行")):
        assert where in refused.value.text(lang)
        assert "PS0112" in refused.value.text(lang)
    assert virtual.state is State.READY


def test_snapshots_do_not_change() -> None:
    virtual = power_on()
    virtual.cycle_start()
    virtual.step(1.0)
    before = virtual.snapshot
    shown = repr(before)
    virtual.run()
    assert repr(before) == shown
    assert before.time == 1.0
    assert virtual.snapshot.parts == 1


@pytest.mark.parametrize("name", ["feed", "rapid", "spindle"])
def test_overrides_have_their_range(name: str) -> None:
    virtual = power_on()
    with pytest.raises(CommandRefused):
        virtual.override(**{name: 9.0})


def test_the_spindle_turns_as_the_override_says() -> None:
    virtual = power_on("O1\nS1000 M3\nG1 X100. F600\nM30\n")
    virtual.override(spindle=1.2)
    virtual.cycle_start()
    virtual.step(2.0)
    assert virtual.spindle.rpm == pytest.approx(1200.0)
    assert virtual.spindle.direction == 1


@pytest.mark.parametrize(
    ("control", "machine", "limit", "wait"),
    [
        ("sinumerik-840d", "mill4", "G26 S1100", "G4 F3"),
        ("fanuc-0i-tf", "lathe2", "G50 S1100", "G4 X3."),
        ("fanuc-m", "mill4", "G92 S1100", "G4 X3."),
        ("syntec-mill", "mill4", "G92 S1100", "G4 X3."),
    ],
)
def test_no_override_passes_the_highest_speed_of_the_program(
    control: str, machine: str, limit: str, wait: str
) -> None:
    virtual = power_on(f"{limit}\nM3 S1000\n{wait}\nM30\n", control, machine=machine)
    virtual.override(spindle=1.2)
    virtual.cycle_start()
    virtual.step(2.0)
    assert virtual.spindle.rpm == pytest.approx(1100.0)


def test_feed_per_revolution_goes_with_a_spindle_at_its_highest_speed() -> None:
    virtual = power_on("G50 S1100\nM3 S1000\nG99 G1 Z-500. F1.\nM30\n", "fanuc-0i-tf", machine="lathe2")
    virtual.override(spindle=1.2)
    virtual.cycle_start()
    virtual.step(4.0)
    assert virtual.feed == pytest.approx(1100.0)


@pytest.mark.parametrize("machine", ["lathe2", "hartford"])
def test_under_constant_surface_speed_the_panel_shows_the_speed_at_the_radius(machine: str) -> None:
    lathe = machine == "lathe2"
    text = "O1\nG96 S100 M3\nG0 X50.\nG4 X2.\nG1 X100. F60.\nM5\nG4 X2.\nM30\n"
    control = "fanuc-0i-tf" if lathe else "fanuc-m"
    virtual = power_on(text, control, machine=machine)
    virtual.cycle_start()
    virtual.step(2.0)
    around_m = pi * (0.05 if lathe else 0.1)
    assert virtual.spindle.rpm == pytest.approx(100.0 / around_m)
    virtual.override(spindle=0.5)
    assert virtual.spindle.rpm == pytest.approx(50.0 / around_m)
    virtual.run()
    assert virtual.spindle.rpm == 0.0


def test_block_search_in_a_program_that_never_ends_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(search, "LONGEST", 100)
    virtual = power_on("O1\nG1 X20. F6000\nG91 Y5.\nM99\nN40 X5.\nM30\n")
    with pytest.raises(CommandRefused):
        virtual.block_search("N40")


def test_block_search_goes_through_any_number_of_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(search, "LONGEST", 100)
    virtual = power_on("O1\n" + "G1 X20. F6000\nX10.\n" * 500 + "N40 X5.\nM30\n")
    virtual.block_search("N40")
    assert virtual.state is State.STOPPED


def test_machine_lock_and_block_search_wait_until_an_axis_moved_by_hand_stands() -> None:
    machine = VirtualControl("fanuc-m")
    machine.load("O1\nN10 G0 X10.\nM30\n")
    machine.select_mode("jog")
    machine.jog("X", 1)
    machine.step(0.1)
    with pytest.raises(CommandRefused):
        machine.set_switches(machine_lock=True)
    machine.stop_jog()
    machine.step(5.0)
    machine.set_switches(machine_lock=True)
    assert machine.switches.machine_lock


@pytest.mark.parametrize("end", ["M2", "M30"])
def test_m02_of_a_machining_centre_asks_for_a_reset_and_m30_does_not(end: str) -> None:
    virtual = power_on(f"O1\nG0 X10.\n{end}\n", machine="hartford")
    virtual.cycle_start()
    virtual.run()
    if end == "M2":
        with pytest.raises(CommandRefused, match="reset"):
            virtual.cycle_start()
        virtual.reset()
    virtual.cycle_start()
    assert virtual.run() is State.READY
    assert virtual.parts == 2


@pytest.mark.parametrize(("end", "bit"), [("M02", 5), ("M30", 4)])
def test_3404_keeps_a_lathe_from_rewinding(end: str, bit: int) -> None:
    text = f"O1\nG0 X10.\n{end}\n"
    for value in (0, 1 << bit):
        virtual = power_on(text, "fanuc-0i-tf", setup={"parameters": {3404: value}})
        virtual.cycle_start()
        virtual.run()
        if value:
            with pytest.raises(CommandRefused, match="reset"):
                virtual.cycle_start()
            virtual.load(text)
        virtual.cycle_start()
        assert virtual.run() is State.READY


# ---- blocks typed in while a program waits -------------------------------------------------------------------


def waiting_in_mdi(virtual: VirtualControl) -> VirtualControl:
    virtual.set_switches(single_block=True)
    if virtual.state is State.READY:
        virtual.cycle_start()
    virtual.run()
    virtual.select_mode("mdi")
    return virtual


def test_in_single_block_nothing_is_prepared_behind_the_block_that_runs() -> None:
    virtual = power_on("O1\n#100=1\nG1 X10. F600\n#100=2\nG1 X20.\nM30\n", "fanuc-m")
    virtual.set_switches(single_block=True)
    virtual.cycle_start()
    virtual.run()
    assert (virtual.machine_position[0], virtual.read_variable("#100")) == (10.0, 1.0)


@pytest.mark.parametrize("control", ["syntec-mill", "sinumerik-840d"])
def test_not_every_control_takes_blocks_while_a_program_waits(control: str) -> None:
    virtual = waiting_in_mdi(power_on("G90 G1 X10. F600\nX20.\nM30\n", control))
    with pytest.raises(CommandRefused, match="auto"):
        virtual.mdi("G1 X5.\n")


def test_no_blocks_are_taken_while_others_are_read_ahead_for_compensation() -> None:
    text = "O1\nG41 D1 G1 X10. F600\nX20.\nX30.\nX40.\nG40 Y9.\nM30\n"
    virtual = power_on(text, "fanuc-m", setup={"tools": {1: {"radius": 2.0}}})
    with pytest.raises(CommandRefused, match="compensation"):
        waiting_in_mdi(virtual).mdi("G1 Z5.\n")
    virtual.select_mode("auto")
    virtual.set_switches(single_block="")
    assert run_through(virtual) is State.READY
    assert virtual.machine_position == [40.0, 9.0, 0.0]


def test_no_blocks_are_taken_while_those_behind_are_prepared() -> None:
    virtual = power_on("O1\nG91 G1 X10. F600\nX10.\nX10.\nM30\n", "fanuc-m")
    virtual.cycle_start()
    virtual.step(0.1)
    with pytest.raises(CommandRefused, match="prepared"):
        waiting_in_mdi(virtual).mdi("G1 Z5.\n")


def test_axes_moved_by_hand_before_an_intervention_count_in_it() -> None:
    virtual = waiting_in_mdi(power_on("O1\nG91 G1 X10. F600\nX10.\nM30\n", "meldas-m"))
    virtual.select_mode("increment")
    virtual.increment("X", 5, 1.0)
    virtual.run()
    virtual.select_mode("mdi")
    virtual.set_switches(single_block="")
    virtual.mdi("G91 X1.\n")
    virtual.run()
    assert virtual.machine_position[0] == 16.0
    virtual.select_mode("auto")
    assert run_through(virtual) is State.READY
    assert virtual.machine_position[0] == 26.0


def test_an_alarm_of_typed_blocks_ends_the_program_too() -> None:
    virtual = waiting_in_mdi(power_on("O1\nG1 X10. F600\nX20.\nM30\n", "fanuc-m"))
    virtual.mdi("G999\n")
    assert virtual.run() is State.ALARM
    virtual.reset()
    virtual.run()
    virtual.select_mode("auto")
    virtual.set_switches(single_block="")
    assert run_through(virtual) is State.READY
    assert virtual.machine_position[0] == 20.0
