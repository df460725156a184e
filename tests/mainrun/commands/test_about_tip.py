"""Jogging orientation axes: the tool turns about its tip (job planning 6.2.7)."""

from __future__ import annotations

from dataclasses import replace

import pytest

from polycnc.machine import load_machine
from polycnc.machine.model import Machine
from polycnc.mainrun import CommandRefused, State, VirtualControl

MACHINES = {"mill5-ac-table": "A", "mill5-bc-head": "B"}
PROGRAM = "T1 D1\nM6\nG0 X0 Y0 Z50\nTRAORI\nG0 X10 Y20 Z30\nM0\nG1 X15 F1000\nTRAFOOF\nM30\n"


def halted(machine: str | Machine, program: str = PROGRAM) -> VirtualControl:
    """A control that waits behind TRAORI, in mode JOG."""
    virtual = VirtualControl("sinumerik-840d", machine=machine, setup={"tools": {1: {"length": 100.0}}})
    virtual.load(program)
    virtual.cycle_start()
    assert virtual.run() is State.STOPPED
    virtual.select_mode("jog")
    return virtual


def tip(virtual: VirtualControl) -> list[float]:
    """Where the tip is on the work."""
    run = virtual._operation.runs.first
    return run.display.on_path(run.machine_position, run.execution.context)[:3]


@pytest.mark.parametrize("machine", MACHINES)
def test_the_tip_stays_while_a_rotary_axis_is_jogged(machine: str) -> None:
    virtual, axis = halted(machine), MACHINES[machine]
    before, there = virtual.positions.machine, tip(virtual)
    virtual.jog(axis, 1)
    for _ in range(20):
        virtual.step(0.05)
        assert tip(virtual) == pytest.approx(there, abs=1e-6)
    virtual.stop_jog(axis)
    virtual.run()
    after = virtual.positions.machine
    assert after[axis] > before[axis] + 1.0
    assert max(abs(after[each] - before[each]) for each in "XYZ") > 0.1
    assert [virtual.positions.work[each] for each in "XYZ"] == pytest.approx([10.0, 20.0, 30.0], abs=1e-4)
    # A second time, and by increments, from there.
    virtual.jog(axis, -1)
    virtual.step(0.3)
    virtual.stop_jog(axis)
    virtual.run()
    virtual.select_mode("increment")
    virtual.increment(axis, 3, 1.0)
    virtual.run()
    assert tip(virtual) == pytest.approx(there, abs=1e-6)
    # The program goes on where it was.
    virtual.select_mode("auto")
    virtual.cycle_start()
    assert virtual.run() is State.READY
    assert virtual.positions.machine[axis] == pytest.approx(before[axis])


def test_axes_are_moved_each_by_itself_in_the_machine_system_and_without_transformation() -> None:
    for program, signal in ((PROGRAM, 1.0), (PROGRAM.replace("TRAORI\n", ""), 0.0)):
        virtual = halted("mill5-bc-head", program)
        virtual.signals["JOG_MCS"] = signal
        before = virtual.positions.machine
        virtual.jog("B", 1)
        virtual.step(0.5)
        virtual.stop_jog("B")
        virtual.run()
        after = virtual.positions.machine
        assert after["B"] > before["B"]
        assert [after[each] for each in "XYZ"] == [before[each] for each in "XYZ"]


def test_keys_move_one_orientation_axis_and_the_handwheel_several() -> None:
    virtual = halted("mill5-bc-head")
    virtual.jog("B", 1)
    virtual.step(0.1)
    for other in ("C", "X"):
        with pytest.raises(CommandRefused):
            virtual.jog(other, 1)
    virtual.stop_jog("B")
    virtual.run()
    there = tip(virtual)
    virtual.select_mode("handle")
    virtual.handle("B", 100, 0.1)
    virtual.handle("C", 100, 0.1)
    virtual.run()
    assert tip(virtual) == pytest.approx(there, abs=1e-6)
    assert virtual.positions.machine["C"] == pytest.approx(10.0)


def test_linear_axes_stay_within_their_limits_and_speeds() -> None:
    built = load_machine("mill5-bc-head")
    axes = tuple(replace(axis, limit_plus=40.0) if axis.name == "X" else axis for axis in built.axes)
    virtual = halted(replace(built, axes=axes))
    data = {each.name: each for each in virtual.channel.axis_data}
    virtual.jog("B", 1, rapid=True)
    last, fastest = virtual.positions.machine, 0.0
    for _ in range(600):
        virtual.step(0.01)
        now = virtual.positions.machine
        fastest = max([fastest, *(abs(now[each] - last[each]) / 0.01 / data[each].rapid for each in "XYZ")])
        assert now["X"] <= 40.0
        last = now
    assert fastest <= 1.01
    assert virtual.positions.machine["X"] > 38.5  # B stands where X would leave its travel
    assert not virtual._operation.runs.move_by_hand


def test_linear_axes_go_on_from_where_they_have_followed() -> None:
    virtual = halted("mill5-bc-head")
    virtual.jog("B", 1)
    virtual.step(1.0)
    virtual.stop_jog("B")
    virtual.run()
    before = virtual.positions.machine
    virtual.select_mode("increment")
    virtual.increment("X", 4, 0.5)
    virtual.run()
    after = virtual.positions.machine
    assert after["X"] == pytest.approx(before["X"] + 2.0)
    assert after["Z"] == before["Z"]
    virtual.select_mode("jog")
    virtual.jog("X", 1)
    virtual.step(0.5)
    virtual.stop_jog("X")
    virtual.run()
    there = tip(virtual)
    virtual.jog("B", -1)
    virtual.step(0.4)
    assert tip(virtual) == pytest.approx(there, abs=1e-6)


def test_the_tool_turns_no_farther_than_software_limits_let_the_linear_axes_follow() -> None:
    setup = {"tools": {1: {"length": 100.0}}, "parameters": {"36110[X]": 15.0}}
    control = VirtualControl("sinumerik-840d", machine="mill5-bc-head", setup=setup)
    control.load("T1 D1\nM6\nTRAORI\nG0 X10 Y0 Z50\nM0\nM30\n")
    control.cycle_start()
    control.run()
    control.select_mode("jog")
    control.jog("B", 1)
    control.run(limit_s=20.0)
    assert 14.0 < control.positions.machine["X"] < 15.0001
    assert control.positions.machine["B"] > 1.0
