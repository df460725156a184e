"""Power off and on: what lives as long as the power begins anew, what outlives it stays."""

from __future__ import annotations

import pytest

from polycnc.channel.states.state import plain_states
from polycnc.mainrun import State, VirtualControl

#: Programs that change modal codes, zero points, variables and spindles, and wait.
PROGRAMS = {
    "fanuc-m": "O1\nG91 G18 G55\nG10 L2 P2 X5.\n#100=7\n#500=8\nM3 S500\nG1 X1. F500\nG92 X0\nM0\nM30\n",
    "meldas-m": "O1\nG91 G18 G55\n#100=7\n#500=8\nM3 S500\nG1 X1. F500\nG92 X0\nM0\nM30\n",
    "fanuc-0i-tf": "O1\nG18 G55\n#100=7\n#500=8\nM3 S500\nG1 U2. F0.5\nG50 X0\nM0\nM30\n",
    "syntec-mill": "G91 G18 G55\n@100:=7;\nM3 S500\nG1 X1. F500\nG92 X0\nM00\nM30\n",
    "sinumerik-840d": "G91 G18 G55\nR1=7\nG1 X1 F500\nM3 S500\nG25 S100\nATRANS X7\nM0\nM30\n",
}


def again(virtual: VirtualControl) -> None:
    """Switch off and on."""
    virtual.power_off()
    virtual.run()
    virtual.power_on()
    virtual.run()


@pytest.mark.parametrize("control", PROGRAMS)
def test_a_control_is_as_one_that_is_switched_on_with_the_same_memory(control: str) -> None:
    virtual = VirtualControl(control)
    virtual.load(PROGRAMS[control])
    virtual.cycle_start()
    assert virtual.run() is State.STOPPED
    fresh = VirtualControl(control, retained=virtual._retained)
    channel, other = virtual._operation.runs.first.channel, fresh._operation.runs.first.channel
    assert virtual.modal != fresh.modal
    assert plain_states(channel) != plain_states(other)
    here = dict(virtual.positions.machine)

    again(virtual)

    assert virtual.state is State.READY
    assert virtual.positions.machine == here
    assert virtual.modal == fresh.modal
    assert plain_states(channel) == plain_states(other)
    virtual.cycle_start()
    assert virtual.run() is State.STOPPED  # it runs again


def test_the_tool_stays_in_the_spindle() -> None:
    virtual = VirtualControl("sinumerik-840d", setup={"tools": {"MILL": {"length": 5.0}}})
    virtual.load('T="MILL"\nM6\nM0\nM30\n')
    virtual.cycle_start()
    virtual.run()
    assert virtual.tool.name == "MILL"
    again(virtual)
    assert virtual.tool.name == "MILL"


def test_variables_that_outlive_the_power_stay_and_others_go() -> None:
    virtual = VirtualControl("fanuc-m", setup={"variables": {"#500": 1.0}})
    virtual.load(PROGRAMS["fanuc-m"])
    virtual.cycle_start()
    virtual.run()
    again(virtual)
    assert virtual.read_variable("#500") == 8.0
    assert virtual.read_variable("#100") is None
    assert virtual.read_variable("#5221") == 0.0
    assert virtual.read_variable("#5241") == 5.0  # G55 X


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m", "syntec-mill"])
def test_the_zone_of_g22_is_over_with_the_code(control: str) -> None:
    virtual = VirtualControl(control)
    inside = "" if control == "syntec-mill" else "O1\n"
    virtual.load(f"{inside}G22 X100. I50.\nM30\n")
    virtual.cycle_start()
    virtual.run()
    again(virtual)
    assert virtual.modal["stroke"] == "G23"
    for x in (75.0, 0.0):  # into a zone that is forbidden, and out of one that is not to be left
        virtual.load(f"{inside}G0 X{x}\nM30\n")
        virtual.cycle_start()
        assert virtual.run() is State.READY
        assert virtual.positions.machine["X"] == x


def test_power_may_come_back_before_the_axes_stand() -> None:
    virtual = VirtualControl("sinumerik-840d")
    virtual.load("G55 G91\nR1=7\nG1 X500 F5000\nM30\n")
    virtual.cycle_start()
    virtual.step(1.0)
    virtual.power_off()
    virtual.power_on()
    virtual.run()
    assert virtual.modal["wcs"] != "G55"
    assert virtual.read_variable("R1") == 7.0
    assert 0.0 < virtual.positions.machine["X"] < 500.0


def test_programs_read_user_variables_of_the_memory_that_is_there() -> None:
    files = {"_N_MGUD_DEF": "DEF NCK INT COUNT\nDEF CHAN REAL WAY=3\nM30\n"}
    virtual = VirtualControl("sinumerik-840d", files=files)
    virtual.load("COUNT=COUNT+1\nWAY=WAY+1\nR1=COUNT\nG0 X=WAY\nM30\n")
    for turn in range(1, 4):
        virtual.cycle_start()
        assert virtual.run() is State.READY
        assert virtual.read_variable("R1") == virtual.read_variable("COUNT") == turn
        assert virtual.positions.machine["X"] == 3.0 + turn
        again(virtual)
        assert virtual.read_variable("COUNT") == turn
