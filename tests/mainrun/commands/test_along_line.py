"""Geometry axes by hand along those of the work and of the tool, and velocities of jog (job planning 6.2.7)."""

from __future__ import annotations

from dataclasses import replace
from math import cos, radians, sin

import pytest

from polycnc.machine import load_machine
from polycnc.mainrun import CommandRefused, State, VirtualControl

TURNED = "G54 G0 X0 Y0 Z50\nROT Z30\nM0\nG1 X15 F1000\nM30\n"
LEANED = "T1 D1\nM6\nG0 X0 Y0 Z50\nTRAORI\nG0 X10 Y20 Z30 B{angle}\nM0\nG1 X15 F1000\nTRAFOOF\nM30\n"


def halted(program: str, machine: str = "mill3", data: dict[str, float] | None = None) -> VirtualControl:
    setup = {"tools": {1: {"length": 100.0}}, "parameters": data or {}}
    virtual = VirtualControl("sinumerik-840d", machine=machine, setup=setup)
    virtual.load(program)
    virtual.cycle_start()
    assert virtual.run() is State.STOPPED
    virtual.select_mode("jog")
    return virtual


def moved(virtual: VirtualControl, axis: str, direction: int = 1, seconds: float = 1.0) -> dict[str, float]:
    """How far the axes of the machine go when a key is held."""
    before = virtual.positions.machine
    virtual.jog(axis, direction)
    virtual.step(seconds)
    virtual.stop_jog(axis)
    virtual.run()
    after = virtual.positions.machine
    return {name: after[name] - before[name] for name in after}


def test_a_turned_frame_leads_both_axes_of_the_plane() -> None:
    virtual = halted(TURNED)
    alone = moved(virtual, "X")
    assert alone["Y"] == 0.0
    virtual.signals["JOG_WCS"] = 1.0
    work = virtual.positions.work
    along = moved(virtual, "X")
    assert along["X"] > 10.0
    assert along["Y"] == pytest.approx(along["X"] * sin(radians(30)) / cos(radians(30)))
    assert virtual.positions.work["Y"] == pytest.approx(work["Y"], abs=1e-6)
    across = moved(virtual, "Y", -1)
    assert across["X"] == pytest.approx(-across["Y"] * sin(radians(30)) / cos(radians(30)))
    virtual.select_mode("increment")
    work = virtual.positions.work
    virtual.increment("X", 4, 0.5)
    virtual.run()
    assert virtual.positions.work["X"] == pytest.approx(work["X"] + 2.0)
    virtual.signals["JOG_MCS"] = 1.0
    virtual.select_mode("jog")
    assert moved(virtual, "X")["Y"] == 0.0, "the machine's system counts first"
    virtual.select_mode("auto")
    virtual.cycle_start()
    assert virtual.run() is State.READY


def test_the_axes_stay_on_the_line_on_their_way_and_one_key_acts_at_a_time() -> None:
    virtual = halted(TURNED)
    virtual.signals["JOG_WCS"] = 1.0
    work = virtual.positions.work
    virtual.jog("X", 1, rapid=True)
    for _ in range(15):
        virtual.step(0.02)
        assert virtual.positions.work["Y"] == pytest.approx(work["Y"], abs=1e-6)
    with pytest.raises(CommandRefused):
        virtual.jog("Y", 1)
    virtual.stop_jog("X")
    virtual.run()
    assert virtual.positions.work["X"] > work["X"] + 10.0


def test_the_line_ends_where_an_axis_leaves_its_travel() -> None:
    built = load_machine("mill3")
    axes = tuple(replace(axis, limit_plus=5.0) if axis.name == "Y" else axis for axis in built.axes)
    virtual = VirtualControl("sinumerik-840d", machine=replace(built, axes=axes))
    virtual.load(TURNED)
    virtual.cycle_start()
    virtual.run()
    virtual.select_mode("jog")
    virtual.signals["JOG_WCS"] = 1.0
    virtual.jog("X", 1, rapid=True)
    virtual.run()
    assert virtual.positions.machine["Y"] == pytest.approx(5.0)
    assert virtual.positions.work["Y"] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(("machine", "leans"), [("mill5-bc-head", True), ("mill5-ac-table", False)])
def test_the_tool_goes_along_itself(machine: str, leans: bool) -> None:
    program = LEANED.format(angle=30) if leans else LEANED.format(angle=30).replace("B30", "A30")
    virtual = halted(program, machine)
    virtual.signals["JOG_TCS"] = 1.0
    way = moved(virtual, "Z")
    assert way["Z"] > 5.0
    assert abs(way["X"] / way["Z"]) == pytest.approx(sin(radians(30)) / cos(radians(30)) if leans else 0.0)
    assert way["Y"] == pytest.approx(0.0, abs=1e-9)
    virtual.signals["JOG_TCS"], virtual.signals["JOG_WCS"] = 0.0, 1.0
    work = virtual.positions.work
    moved(virtual, "Z")
    now = virtual.positions.work
    assert (now["X"], now["Y"]) == pytest.approx((work["X"], work["Y"]), abs=1e-5)
    assert now["Z"] > work["Z"] + 5.0


def speed(virtual: VirtualControl, axis: str, *, rapid: bool = False) -> float:
    """Speed of an axis by its key, mm/min or degrees/min."""
    virtual.jog(axis, 1, rapid=rapid)
    virtual.step(0.8)
    found = virtual.snapshot.feed
    virtual.stop_jog(axis)
    virtual.run()
    return found


def test_the_machine_data_say_how_fast_axes_are_jogged() -> None:
    virtual = halted(TURNED)
    assert speed(virtual, "X") == pytest.approx(2000.0)
    virtual.override(feed=0.5)
    assert speed(virtual, "X") == pytest.approx(1000.0)
    virtual.override(feed=1.0)
    own = {"$MA_JOG_VELO[X]": 600.0, "$MA_JOG_VELO_RAPID[X]": 4000.0, "$MC_JOG_VELO_GEO[0]": 300.0}
    virtual = halted(TURNED, data=own)
    assert speed(virtual, "X") == pytest.approx(600.0)
    assert speed(virtual, "X", rapid=True) == pytest.approx(4000.0)
    assert speed(virtual, "Y") == pytest.approx(2000.0)
    virtual.signals["JOG_WCS"] = 1.0
    virtual.jog("X", 1)
    virtual.step(0.8)
    there = virtual.positions.work["X"]
    virtual.step(0.6)
    assert virtual.positions.work["X"] - there == pytest.approx(3.0, abs=0.01)
    virtual.stop_jog()
    virtual.run()
    virtual = halted(TURNED, data={"$SN_JOG_SET_VELO": 900.0})
    assert speed(virtual, "Y") == pytest.approx(900.0)


def test_orientation_axes_have_a_velocity_of_their_own() -> None:
    data = {"$MC_JOG_VELO_ORI[0]": 1.5, "$MA_JOG_VELO[B]": 2.0}
    virtual = halted(LEANED.format(angle=0), "mill5-bc-head", data)
    rotary = [axis.name for axis in virtual.channel.axis_data if axis.rotary]
    data = {f"$MC_JOG_VELO_ORI[{rotary.index('B')}]": 1.5, "$MA_JOG_VELO[B]": 2.0}
    virtual = halted(LEANED.format(angle=0), "mill5-bc-head", data)
    virtual.jog("B", 1)
    virtual.step(0.5)
    before = virtual.positions.machine["B"]
    virtual.step(0.1)
    assert virtual.positions.machine["B"] - before == pytest.approx(0.9, rel=0.02)
    virtual.stop_jog("B")
    virtual.run()
    virtual.signals["JOG_MCS"] = 1.0
    assert speed(virtual, "B") == pytest.approx(720.0)


def test_an_override_that_turns_while_an_axis_goes_keeps_its_kind_of_speed() -> None:
    virtual = halted(TURNED)
    fastest = 60.0 * virtual.channel.axis_data[0].rapid
    virtual.jog("X", 1, rapid=True)
    virtual.step(0.4)
    virtual.override(rapid=0.25)
    virtual.step(0.4)
    assert virtual.snapshot.feed == pytest.approx(0.25 * fastest)
    virtual.stop_jog("X")
    virtual.run()
