"""What the picture of a control shows."""

from __future__ import annotations

import pytest

from polycnc.control.registry import ids
from polycnc.mainrun import VirtualControl
from polycnc.panel.course import Course

TEXT = {
    "sinumerik-840d": "G0 X10\nG1 X20 Y5 F1000\nM30\n",
    "syntec-mill": "G0 X10.\nG1 X20. Y5. F1000\nM30\n",
}
LATHE = "O1\nG0 X10.\nG98 G1 X20. Z5. F1000\nM30\n"


def run(control: VirtualControl, course: Course) -> None:
    control.cycle_start()
    for _ in range(200):
        control.step(0.02)
        course.note(control.snapshot)


def calculated(course: Course) -> None:
    for _ in range(50):
        course.go_on()


@pytest.mark.parametrize("control_id", ids())
def test_the_trail_ends_where_the_path_of_the_program_ends(control_id: str) -> None:
    control = VirtualControl(control_id)
    course = Course(control)
    lathe = control_id == "fanuc-0i-tf"
    control.load(LATHE if lathe else TEXT.get(control_id, "O1\nG0 X10.\nG1 X20. Y5. F1000\nM30\n"))
    for _ in range(20):
        calculated(course)
    path, trail = course.lines["path"], course.lines["trail"]
    assert path.last() == pytest.approx((10.0, 0.0, 5.0) if lathe else (20.0, 5.0, 0.0), abs=1e-3)
    run(control, course)
    assert len(trail) > 10
    assert trail.last() == pytest.approx(path.last(), abs=1e-3)
    assert course.pose.point == pytest.approx(path.last(), abs=1e-3)


def test_another_program_has_another_path_and_another_run_a_trail_of_its_own() -> None:
    control = VirtualControl("fanuc-m")
    course = Course(control)
    control.load("O1\nG1 X10. F1000\nM30\n")
    calculated(course)
    run(control, course)
    long = len(course.lines["trail"])
    control.load("O2\nG1 X12. F6000\nM30\n")
    calculated(course)
    assert course.lines["path"].last() == pytest.approx((12.0, 0.0, 0.0))
    run(control, course)
    assert len(course.lines["trail"]) < long
