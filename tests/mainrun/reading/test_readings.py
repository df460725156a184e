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


FRAMES = "G90 G54\nG00 X10. Y5. Z2.\n{block}\nG69\nM30\n"


@pytest.mark.parametrize(
    ("control", "block", "work"),
    [
        ("fanuc-m", "G92 X0", (0.0, 5.0, 2.0)),
        ("fanuc-m", "G52 Y3.", (10.0, 2.0, 2.0)),
        ("meldas-m", "G55", (-90.0, 5.0, 2.0)),
        ("syntec-mill", "G92 X0", (0.0, 5.0, 2.0)),
        ("syntec-mill", "G43 H1", (10.0, 5.0, -48.0)),
        ("syntec-mill", "G68.2 X1. Y0 Z0 I0 J90. K0", (9.0, 2.0, -5.0)),
        ("fanuc-m", "G68.2 X1. Y0 Z0 I0 J90. K0", (9.0, 2.0, -5.0)),
        ("fanuc-m", "G43.4 H1", (10.0, 5.0, -48.0)),
    ],
)
def test_displays_follow_a_block_that_changes_frames_alone(
    control: str, block: str, work: tuple[float, ...]
) -> None:
    setup = {"work_offsets": {"G55": {"X": 100}}, "tools": {1: {"length": 50}}}
    virtual = VirtualControl(control, machine="mill5-ac-table", setup=setup)
    virtual.load(FRAMES.format(block=block))
    virtual.set_switches(single_block=True)
    for _ in range(3):
        virtual.cycle_start()
        virtual.run()
    assert virtual.snapshot.block.text == block
    assert [virtual.positions.work[axis] for axis in "XYZ"] == pytest.approx(work)
    assert [virtual.positions.machine[axis] for axis in "XYZ"] == pytest.approx([10.0, 5.0, 2.0])


def test_displays_follow_frames_of_sinumerik_and_the_picture_stays_in_its_system() -> None:
    virtual = VirtualControl("sinumerik-840d", machine="mill3", setup={"work_offsets": {"G55": {"X": 100}}})
    virtual.load("G54\nG0 X10 Y5\nTRANS X3\nAROT Z90\nG55\nM30\n")
    virtual.set_switches(single_block="SBL2")
    shown = []
    for _ in range(5):
        virtual.cycle_start()
        virtual.run()
        work, point = virtual.positions.work, virtual.snapshot.channels[1].point
        shown.append((work["X"], work["Y"], *point[:2]))
    assert shown[1:] == [
        pytest.approx((10.0, 5.0, 10.0, 5.0)),
        pytest.approx((7.0, 5.0, 10.0, 5.0)),
        pytest.approx((5.0, -7.0, 10.0, 5.0)),
        pytest.approx((5.0, 93.0, -90.0, 5.0)),
    ]
