"""Memories that channels share: a write acts where the axes are, a read waits for it."""

from __future__ import annotations

import pytest

from tests.mainrun.support import power_on

CONTROL = "sinumerik-840d"


def test_a_link_variable_is_written_when_the_axes_are_there() -> None:
    virtual = power_on("G1 X10 F600\n$A_DLD[4]=7\nX20\nM30\n", CONTROL)
    virtual.cycle_start()
    virtual.step(0.9)
    assert virtual.read_variable("$A_DLD[4]") == 0
    virtual.step(0.3)
    assert virtual.read_variable("$A_DLD[4]") == 7
    assert 10.0 < virtual.machine_position[0] < 15.0


@pytest.mark.parametrize("name", ["$A_DLR[8]", "$A_DBR[8]"])
def test_a_program_reads_what_it_has_written_before(name: str) -> None:
    virtual = power_on(f"{name}=1\nG1 X10 F6000\n{name}={name}+1.5\nR1={name}\nX=R1\nM30\n", CONTROL)
    virtual.cycle_start()
    virtual.run()
    assert virtual.machine_position[0] == pytest.approx(2.5)


def test_a_write_does_not_end_the_look_ahead_of_radius_compensation() -> None:
    setup = {"tools": {1: {"radius": 5}}}
    text = "T1 D1 G1 F6000\nG41 X20 Y0\nX40\n$A_DLB[0]=1\nY30\nM0\nG40 X60\nM30\n"
    virtual = power_on(text, CONTROL, setup=setup)
    records = []
    virtual.listeners.append(lambda record: records.append(max(virtual.machine_position[0], 0.0)))
    virtual.cycle_start()
    virtual.run()
    assert virtual.machine_position[:2] == pytest.approx([35.0, 30.0])
    assert max(records) == pytest.approx(35.0)
    assert virtual.read_variable("$A_DLB[0]") == 1


def test_a_reset_takes_back_a_write_that_was_not_reached() -> None:
    virtual = power_on("G1 X10 F600\n$A_DLD[4]=7\nX20\nM30\n", CONTROL)
    virtual.cycle_start()
    virtual.step(0.3)
    virtual.reset()
    virtual.run()
    assert virtual.read_variable("$A_DLD[4]") == 0


@pytest.mark.parametrize("name", ["$A_OUT[2]", "$AC_MARKER[2]", "$AC_PARAM[2]"])
def test_markers_and_outputs_are_written_when_the_axes_are_there(name: str) -> None:
    virtual = power_on(f"G1 X10 F600\n{name}=1\nX20\nM30\n", CONTROL)
    virtual.cycle_start()
    virtual.step(0.9)
    assert not virtual.read_variable(name)
    virtual.step(0.3)
    assert virtual.read_variable(name)
    assert 10.0 < virtual.machine_position[0] < 15.0
