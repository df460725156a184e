"""What the operator can do to a rigid tap of the lathe: 5203#4 OVS, 5200#6 FHD (0i-TF Plus II.4.5.1, 4.5.4.2)."""

from __future__ import annotations

import pytest

from polycnc.machine import parse_setup
from polycnc.mainrun import State, VirtualControl
from tests.mainrun.support import power_on

TAP = "O1\nG98 G0 X0 Z5.\nM29 S600\nG84 Z-35. R-3. F600\nG80\nM30\n"


def lathe(**parameters: int) -> VirtualControl:
    named = {f"{name[1:5]}#{name[6]}": value for name, value in parameters.items()}
    return power_on(TAP, "fanuc-0i-tf", setup=parse_setup({"parameters": named}))


def seconds(virtual: VirtualControl, **rates: float) -> float:
    virtual.override(**rates)
    virtual.cycle_start()
    assert virtual.run() is State.READY
    return virtual.time


def test_a_rigid_tap_takes_no_override() -> None:
    assert seconds(lathe(), feed=0.5) == pytest.approx(seconds(lathe()), abs=0.01)


def test_ovs_lets_the_feed_override_act_on_both_ways_of_a_rigid_tap() -> None:
    # 37 mm in and out at 10 mm/s.
    slower = seconds(lathe(p5203_4=1), feed=0.5) - seconds(lathe(p5203_4=1))
    assert slower == pytest.approx(7.4, abs=0.4)


@pytest.mark.parametrize(("fhd", "stops_at"), [(0, 5.0), (1, -10.0)])
def test_fhd_lets_feed_hold_stop_a_rigid_tap_at_once(fhd: int, stops_at: float) -> None:
    virtual = lathe(p5200_6=fhd)
    virtual.cycle_start()
    assert virtual.run_until(lambda control: control.machine_position[1] < -10.0)
    virtual.feed_hold()
    assert virtual.run() is State.HOLD
    # Without FHD the tap goes on to the initial level.
    assert virtual.machine_position[1] == pytest.approx(stops_at, abs=2.5)
    virtual.cycle_start()
    assert virtual.run() is State.READY
