"""Skip moves: the signal comes inside a segment, the axes brake behind it, and the program goes on from there."""

from __future__ import annotations

from math import dist, hypot, sqrt

import pytest

from polycnc.mainrun import State
from polycnc.session import open_session
from tests.mainrun.support import power_on

PROBE = "O1\nG90 G31 X100. F6000\n#100=#5061\n#101=#5041\nG91 G1 Y10.\nM30\n"
#: The axes are half a ramp behind, then they brake with what limited jerk leaves of 3000 mm/s² (`kernels/alone.py`).
RAMP_S = sqrt(100.0 / 50000.0)
BRAKING_MM = 100.0 * 0.5 * RAMP_S + 100.0**2 / (2.0 * 50000.0 * RAMP_S)


def test_a_signal_of_the_setup_leaves_its_braking_distance_behind() -> None:
    virtual = power_on(PROBE, setup={"switches": {"skip_signal_at": {"X": 40.0}}})
    virtual.cycle_start()
    assert virtual.run() is State.READY
    read = virtual.read_variable
    assert read("#100") == pytest.approx(40.0)
    assert read("#101") == pytest.approx(40.0 + BRAKING_MM)
    assert virtual.machine_position[:2] == pytest.approx([40.0 + BRAKING_MM, 10.0])


def test_the_axes_do_not_go_beyond_the_programmed_end() -> None:
    virtual = power_on(PROBE, setup={"switches": {"skip_signal_at": {"X": 99.9}}})
    virtual.cycle_start()
    virtual.run()
    assert 99.9 < virtual.machine_position[0] <= 100.0 + 1e-9


def test_a_signal_may_come_at_any_time() -> None:
    virtual = power_on(PROBE)
    virtual.cycle_start()
    virtual.step(0.3)
    here = virtual.machine_position[0]
    virtual.signals["SKIP"] = 1.0
    assert virtual.run() is State.READY
    assert virtual.read_variable("#100") == pytest.approx(here)
    assert virtual.machine_position[0] == pytest.approx(here + BRAKING_MM)


def test_without_a_signal_the_move_goes_to_its_end() -> None:
    virtual = power_on(PROBE)
    virtual.cycle_start()
    virtual.run()
    assert virtual.machine_position[:2] == pytest.approx([100.0, 10.0])


def test_feed_hold_and_resume_in_a_skip_move() -> None:
    virtual = power_on(PROBE, setup={"switches": {"skip_signal_at": {"X": 40.0}}})
    virtual.cycle_start()
    virtual.step(0.2)
    virtual.feed_hold()
    virtual.run()
    virtual.cycle_start()
    assert virtual.run() is State.READY
    assert virtual.read_variable("#100") == pytest.approx(40.0)


def test_a_loop_waits_for_an_input_while_time_passes() -> None:
    virtual = power_on("O1\nWHILE[#1000 EQ 0] DO1\nEND1\nG0 X10.\nM30\n")
    virtual.cycle_start()
    virtual.step(2.0)
    assert virtual.state is State.RUNNING
    assert virtual.machine_position[0] == 0.0
    virtual.signals["UI000"] = 1.0
    assert virtual.run() is State.READY
    assert virtual.machine_position[0] == 10.0
    assert 2.0 < virtual.time < 2.5


def test_an_output_of_the_program_comes_in_time() -> None:
    virtual = power_on("O1\nG1 X10. F600\n#1101=1\nG1 X20.\nM30\n")
    virtual.cycle_start()
    virtual.step(0.5)
    assert virtual.signals["UO001"] == 0.0
    virtual.run()
    assert virtual.signals["UO001"] == 1.0
    assert virtual.signals.since("UO001") == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize(
    ("control", "text", "signal"),
    [
        ("sinumerik-840d", "WHILE $A_IN[1]==FALSE\nENDWHILE\nG0 X10\nM30\n", "$A_IN[1]"),
        ("syntec-mill", "%@MACRO\nWHILE (READDI(3) = 0) DO\nEND_WHILE;\nG0 X10.;\nM30;\n", "I3"),
    ],
)
def test_a_program_waits_for_an_input(control: str, text: str, signal: str) -> None:
    virtual = power_on(text, control)
    virtual.cycle_start()
    virtual.step(1.0)
    assert virtual.machine_position[0] == 0.0
    virtual.signals[signal] = 1.0
    assert virtual.run(limit_s=10.0) is State.READY
    assert virtual.machine_position[0] == 10.0


TILTED = "O1\nG54 G90 G31 X60. Y30. F3000\n#100=#5061\n#101=#5062\nM30\n"
SURFACES = {
    "plane": [{"shape": "plane", "at": {"X": 40, "Y": 20}, "direction": {"X": -1, "Y": -0.5}, "tip": 3}],
    "ball": [{"shape": "sphere", "at": {"X": 50, "Y": 22, "Z": 4}, "radius": 12, "tip": 1}],
    "bore": [
        {"shape": "cylinder", "at": {"X": 10}, "direction": {"Z": 1}, "radius": 25, "inside": True, "tip": 2},
        {"shape": "plane", "at": {"X": 59}, "direction": {"X": -1}},
    ],
}


@pytest.mark.parametrize("name", SURFACES)
def test_a_surface_ends_the_move_at_the_same_place_with_and_without_a_clock(name: str) -> None:
    setup = {"work_offsets": {"G54": {"X": 5.0}}, "switches": {"skip_surfaces": SURFACES[name]}}
    session = open_session(TILTED, control="fanuc-m", setup=setup)
    result = session.run()
    virtual = power_on(TILTED, setup=setup)
    virtual.cycle_start()
    assert virtual.run() is State.READY
    touched = [result.variables[number] for number in ("#100", "#101")]
    assert [virtual.read_variable(number) for number in ("#100", "#101")] == pytest.approx(touched)
    x, y = touched[0] + 5.0, touched[1]
    assert y / x == pytest.approx(30.0 / 65.0)  # on the way
    if name == "plane":
        assert ((x - 40.0) + 0.5 * (y - 20.0)) / hypot(1.0, 0.5) == pytest.approx(-3.0)
    elif name == "ball":
        assert dist((x, y, 0.0), (50.0, 22.0, 4.0)) == pytest.approx(13.0)
    else:
        assert hypot(x - 10.0, y) == pytest.approx(23.0)
    assert virtual.machine_position[0] > x  # the braking distance


def test_a_surface_beside_the_way_ends_nothing() -> None:
    surface = {"shape": "sphere", "at": {"X": 30, "Y": 60}, "radius": 12}
    virtual = power_on(TILTED, setup={"switches": {"skip_surfaces": [surface]}})
    virtual.cycle_start()
    virtual.run()
    assert virtual.machine_position[:2] == pytest.approx([60.0, 30.0])


@pytest.mark.parametrize("control", ["fanuc-m", "syntec-mill"])
@pytest.mark.parametrize("seconds", [0.02, 0.6, 1.2])
def test_a_signal_by_the_clock_comes_at_the_same_place_with_and_without_a_clock(
    control: str, seconds: float
) -> None:
    syntec = "G54 G90 G31 X60. Y30. F3000\n@1 := #1361;\n@2 := #1362;\nM30\n"
    text = TILTED if control == "fanuc-m" else syntec
    names = ("#100", "#101") if control == "fanuc-m" else ("@1", "@2")
    setup = {"switches": {"skip_signal_after": seconds}}
    result = open_session(text, control=control, setup=setup).run()
    virtual = power_on(text, control, setup=setup)
    virtual.cycle_start()
    assert virtual.run() is State.READY
    skipped = [float(result.variables[name]) for name in names]
    assert 0.0 < skipped[0] < 60.0
    assert [virtual.read_variable(name) for name in names] == pytest.approx(skipped, abs=1e-6)


def test_a_signal_after_the_move_ends_nothing() -> None:
    setup = {"switches": {"skip_signal_after": 30.0}}
    assert open_session(TILTED, control="fanuc-m", setup=setup).run().variables["#100"] == 60.0
    virtual = power_on(TILTED, setup=setup)
    virtual.cycle_start()
    virtual.run()
    assert virtual.read_variable("#100") == pytest.approx(60.0)
