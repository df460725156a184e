"""A main program that begins again ends where all further passes would be like the last one."""

from __future__ import annotations

import pytest

import polycnc

LIMIT = 5000
MILLS = ["fanuc-m", "meldas-m", "syntec-mill"]


@pytest.mark.parametrize("control", MILLS)
def test_a_part_that_is_cut_again_and_again_is_run_until_it_repeats_itself(control: str) -> None:
    result = polycnc.run("O1\nG90 G0 X10.\nG1 X20. F100.\nG4 X1.\nM99\n", control=control, block_limit=LIMIT)
    assert result.ok
    assert result.repeats == 2
    assert [row["to"]["X"] for row in result.rows if row["type"] == "feed"] == [20.0, 20.0]


def test_a_lathe_that_pulls_its_bar_repeats_itself_too() -> None:
    result = polycnc.run("O1\nG0 X30. Z2.\nM98 P2\nM99\nO2\nG1 Z-5. F.2\nM99\n", control="fanuc-0i-tf")
    assert result.ok
    assert result.repeats == 2


@pytest.mark.parametrize(
    ("program", "passes"),
    [
        ("O1\nG0 X1.\n#500=#500+1\nIF[#500 EQ 20]GOTO 9\nM99\nN9 M30\n", 20),
        ("O1\nG0 X1.\nG10 L2 P1 X[#5221+1]\nIF[#5221 GE 7]GOTO 9\nM99\nN9 M30\n", 7),
        ("O1\nG0 X1.\nG10 L10 P1 R[#11001+1]\nIF[#11001 GE 6]GOTO 9\nM99\nN9 M30\n", 6),
        ("O1\nG91 G0 X1.\nIF[#5001 GE 5]GOTO 9\nM99\nN9 M30\n", 5),
        ("O1\nG0 X1.\nG4 P20\nIF[#3001 GE 90]GOTO 9\nM99\nN9 M30\n", 5),
    ],
)
def test_a_program_that_changes_something_goes_on_until_it_ends(program: str, passes: int) -> None:
    result = polycnc.run(program, control="fanuc-m", block_limit=LIMIT)
    assert result.ok
    assert result.repeats == 0
    assert result.channel.passes is not None
    assert result.channel.passes.count == passes - 1


@pytest.mark.parametrize("control", MILLS)
def test_jumps_of_the_main_program_are_no_passes_that_repeat_themselves(control: str) -> None:
    program = "O1\nG90 G0 X10.\nM99 P5\nN7 G0 X20.\nM99 P9\nN5 G0 X10.\nM99 P7\nN9 M30\n"
    result = polycnc.run(program, control=control, block_limit=LIMIT)
    assert result.repeats == 0
    assert [row["to"]["X"] for row in result.rows if row["type"] == "rapid"] == [10.0, 20.0]


def test_a_program_that_waits_for_an_input_is_never_thought_to_repeat_itself() -> None:
    setup = {"switches": {"signals_at": {"UI000": {"X": 99}}}}
    result = polycnc.run("O1\nG90 G0 X10.\nM99\n", control="fanuc-m", setup=setup, block_limit=200)
    assert [alarm.code for alarm in result.alarms] == ["PC0002"]
    assert result.repeats == 0


def test_the_virtual_control_goes_on_until_it_is_stopped() -> None:
    control = polycnc.VirtualControl("fanuc-m")
    control.load("O1\nG90 G0 X10.\nG4 X1.\nX0\nM99\n")
    control.cycle_start()
    control.step(20.0)
    assert control.state == "running"
