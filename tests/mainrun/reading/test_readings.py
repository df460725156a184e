"""What a panel reads while an operator has the axes."""

from __future__ import annotations

from math import cos, radians, sin

import pytest

from polycnc.mainrun import State, VirtualControl

PROGRAM = "G90 G43.4 H1\nN10 G01 X10. Y0 Z0 B30. F2000\nM00\nG01 X20.\nM30\n"


def test_under_tip_control_an_axis_moved_by_hand_moves_the_tip_on_the_display() -> None:
    setup = {"tools": {1: {"length": 100.0}}}
    virtual = VirtualControl("syntec-mill", machine="mill5-bc-head", setup=setup)
    virtual.load(PROGRAM)
    virtual.cycle_start()
    assert virtual.run() is State.STOPPED
    virtual.select_mode("increment")
    virtual.increment("Z", 5, 1.0)
    virtual.increment("B", 20, 1.0)
    virtual.run()
    place, machine = virtual.positions.work, virtual.positions.machine
    assert machine["B"] == pytest.approx(50.0)
    # The nose is 100 mm along the tool: at (10,0,0) + 100·(sin 30, 0, cos 30), then 5 mm higher.
    tip = 10.0 + 100.0 * (sin(radians(30.0)) - sin(radians(50.0)))
    height = 5.0 + 100.0 * (cos(radians(30.0)) - cos(radians(50.0)))
    assert [place[each] for each in "XYZ"] == pytest.approx([tip, 0.0, height], abs=1e-6)
    target, left = virtual.restart["Z"]
    assert (target, left) == pytest.approx((0.0, -height), abs=1e-6)
    virtual.select_mode("auto")
    virtual.cycle_start()
    assert virtual.run() is State.READY
    assert virtual.positions.machine["X"] == pytest.approx(70.0)


def test_under_polar_interpolation_the_axes_moved_by_hand_are_shown_themselves() -> None:
    virtual = VirtualControl("syntec-mill", machine="mill4-xyzc")
    virtual.load("G90 G00 X20. C0\nG12.1\nG01 X10. C10. F500\nM00\nM30\n")
    virtual.cycle_start()
    assert virtual.run() is State.STOPPED
    virtual.select_mode("increment")
    virtual.increment("C", 5, 1.0)
    virtual.run()
    assert virtual.positions.work["C"] == pytest.approx(50.0)
