"""Synchronised actions in the main run: modes, holds and resets, checkpoints, and that nobody else pays for them."""

from __future__ import annotations

import pytest

import polycnc
from polycnc.mainrun import State, VirtualControl
from tests.mainrun.support import power_on, run_through

CONTROL = "sinumerik-840d"
WAY = """N10 ID=1 WHENEVER $AA_IM[X]>5 DO $AC_PARAM[1]=$AA_IM[X]
N20 IDS=2 WHENEVER TRUE DO $AC_PARAM[2]=$AC_PARAM[2]+1
N30 ID=3 WHEN $AA_IM[X]>10 DO POS[A]=90 FA[A]=1200
N40 G1 X40 F1200
N50 R1=$AC_PARAM[1]
N60 M30
"""


def started(text: str = WAY, seconds: float = 1.0) -> VirtualControl:
    control = power_on(text, CONTROL, machine="mill4")
    control.cycle_start()
    control.step(seconds)
    return control


def actions_of(control: VirtualControl) -> set[int]:
    from polycnc.control.sinumerik.actions.actions import SynchronisedActions

    return set(SynchronisedActions.of(control.channel).modal)


def test_a_calculation_and_a_main_run_find_the_same() -> None:
    text = WAY.replace("N60", "N55 R2=$AA_IM[A]\nN60")
    result = polycnc.run(text, control=CONTROL, setup={"machine": "mill4"})
    control = power_on(text, CONTROL, machine="mill4")
    assert run_through(control) is State.READY
    assert result.ok
    for name in ("R1", "R2"):
        assert control.read_variable(name) == pytest.approx(result.variables[name], abs=1e-6)


def test_a_program_without_actions_visits_no_cycle() -> None:
    control = power_on("N10 G1 X40 F1200\nN20 M30\n", CONTROL)
    assert run_through(control) is State.READY
    assert control._operation.clock.visits == 0


def test_actions_that_wait_for_nothing_that_moves_let_the_clock_sleep() -> None:
    control = power_on("N10 ID=1 WHENEVER $A_IN[1]==1 DO $A_OUT[1]=1\nN20 G4 F100\nN30 M30\n", CONTROL)
    assert run_through(control) is State.READY
    assert 0 < control._operation.clock.visits < 20


def test_an_input_wakes_them() -> None:
    control = power_on("N10 ID=1 EVERY $A_IN[1]==1 DO $R5=$R5+1\nN20 G4 F100\nN30 M30\n", CONTROL)
    control.cycle_start()
    control.step(10.0)
    control.signals["$A_IN[1]"] = 1.0
    control.step(0.1)
    assert control.read_variable("R5") == 1.0
    control.signals["$A_IN[1]"] = 0.0
    control.step(0.1)
    control.signals["$A_IN[1]"] = 1.0
    control.step(0.1)
    assert control.read_variable("R5") == 2.0


def test_a_reset_deletes_modal_actions_and_leaves_static_ones() -> None:
    control = started()
    assert actions_of(control) == {1, 2, 3}
    control.reset()
    control.run()
    assert actions_of(control) == {2}
    before = control.read_variable("$AC_PARAM[2]")
    control.step(0.1)
    after = control.read_variable("$AC_PARAM[2]")
    assert isinstance(before, float)
    assert isinstance(after, float)
    assert after > before


def test_the_end_of_the_program_leaves_static_actions() -> None:
    control = started(seconds=10.0)
    assert control.state is State.READY
    assert actions_of(control) == {2}
    assert control.positions.machine["A"] == pytest.approx(90.0)


def test_a_reset_breaks_the_motion_of_an_action_off() -> None:
    control = started(seconds=1.5)
    assert 0.0 < control.positions.machine["A"] < 60.0
    control.reset()
    control.run()
    stood = control.positions.machine["A"]
    control.step(3.0)
    assert control.positions.machine["A"] == stood < 60.0


@pytest.mark.parametrize(("word", "goes_on"), [("ID", False), ("IDS", True)])
def test_feed_hold_stops_axes_of_actions_that_are_not_static(word: str, goes_on: bool) -> None:
    text = f"N10 {word}=1 WHEN TRUE DO POS[A]=90 FA[A]=1200\nN20 G1 X60 F1200\nN30 M30\n"
    control = started(text, 1.0)
    control.feed_hold()
    control.step(1.0)
    stood = control.positions.machine["A"]
    control.step(6.0)
    assert (control.positions.machine["A"] == pytest.approx(90.0)) is goes_on
    assert (control.positions.machine["A"] == stood) is not goes_on
    control.cycle_start()
    assert control.run() is State.READY
    assert control.positions.machine["A"] == pytest.approx(90.0)


def test_static_actions_hold_in_every_mode_and_modal_ones_in_that_of_the_program() -> None:
    counts = (f"{word}={n} DO $AC_PARAM[{n}]=$AC_PARAM[{n}]+1\n" for word, n in (("ID", 1), ("IDS", 2)))
    text = "".join((*counts, "G1 X60 F600\nM30\n"))
    control = started(text, 1.0)
    control.select_mode("jog")
    control.step(1.0)
    modal, static = (control.read_variable(f"$AC_PARAM[{n}]") for n in (1, 2))
    control.step(1.0)
    assert control.read_variable("$AC_PARAM[1]") == modal
    assert isinstance(static, float)
    assert control.read_variable("$AC_PARAM[2]") != static
    control.select_mode("auto")
    control.cycle_start()
    control.step(0.5)
    assert control.read_variable("$AC_PARAM[1]") != modal


def test_a_checkpoint_in_the_midst_brings_actions_back() -> None:
    control = started(seconds=1.2)
    checkpoint = control.checkpoint()
    ends = []
    for _ in range(2):
        control.run()
        ends.append(
            (
                control.read_variable("R1"),
                control.read_variable("$AC_PARAM[2]"),
                control.positions,
                control.time,
            )
        )
        checkpoint.restore()
    assert ends[0] == ends[1]


def test_an_endless_motion_ends_with_the_program() -> None:
    control = power_on(
        "N10 ID=1 WHEN TRUE DO MOV[A]=1 FA[A]=600\nN20 G4 F2\nN30 M30\n", CONTROL, machine="mill4"
    )
    assert run_through(control) is State.READY
    assert control.time < 4.0


def test_a_program_that_waits_for_an_action_goes_on() -> None:
    text = (
        "N10 $AC_MARKER[0]=0\nN20 ID=1 WHEN $AA_IM[X]>=20 DO $AC_MARKER[0]=1\nN30 WAITP(A)\nN40 G1 X30 F600\n"
        "N50 WHILE $AC_MARKER[0]==0\nN60 ENDWHILE\nN70 G1 Y5\nN80 M30\n"
    )
    result = polycnc.run(text, control=CONTROL, setup={"machine": "mill4"})
    assert result.ok
    assert result.final["work"]["Y"] == 5.0
    assert result.main_run_s == pytest.approx(3.5, abs=0.2)


def test_a_program_that_waits_for_ever_is_refused_and_a_long_dwell_is_not() -> None:
    never = "N10 ID=1 WHENEVER TRUE DO RDISABLE\nN20 G1 X5 F1000\nN30 X10\nN40 M30\n"
    assert [alarm.code for alarm in polycnc.run(never, control=CONTROL).alarms] == ["PC0013"]
    dwell = "N10 $AC_TIMER[1]=0\nN20 G4 F3000\nN30 R1=$AC_TIMER[1]\nN40 M30\n"
    assert polycnc.run(dwell, control=CONTROL).ok
