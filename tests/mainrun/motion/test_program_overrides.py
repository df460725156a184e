"""What a program takes out of the operator's hands: M73 to M76, #3004, G63, tapping cycles."""

from __future__ import annotations

import pytest

from polycnc.machine import parse_setup
from polycnc.mainrun import State
from tests.mainrun.support import hartford, power_on, run_through


def seconds(text: str, control: str = "fanuc-m", **rates: float) -> float:
    """How long a program takes under overrides; M73 to M76 are Hartford's."""
    virtual = hartford(text, control)
    if rates:
        virtual.override(**rates)
    assert run_through(virtual) is State.READY
    return virtual.time


CUT = "G1 X100. F1000\n"


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m"])
def test_m73_makes_the_feed_override_one_hundred_per_cent_until_m74(control: str) -> None:
    plain = seconds(f"O1\n{CUT}M30\n", control)
    assert seconds(f"O1\n{CUT}M30\n", control, feed=0.5) > 1.9 * plain
    assert seconds(f"O1\nM73\n{CUT}M30\n", control, feed=0.5) == pytest.approx(plain, abs=0.1)
    again = seconds(f"O1\nM73\n{CUT}M74\nX0\nM30\n", control, feed=0.5)
    assert again == pytest.approx(3.0 * plain, rel=0.03)


def test_m73_moves_even_where_the_override_stands_at_zero() -> None:
    plain = seconds(f"O1\n{CUT}M30\n")
    assert seconds(f"O1\nM73\n{CUT}M30\n", feed=0.0) == pytest.approx(plain, abs=0.1)


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m"])
def test_m75_makes_the_spindle_override_one_hundred_per_cent_until_m76(control: str) -> None:
    virtual = hartford("O1\nM3 S1000\nG4 P9000\nM75\nG4 P9000\nM76\nG4 P9000\nM30\n", control)
    virtual.override(spindle=1.2)
    speeds = []
    virtual.cycle_start()
    for line in (3, 5, 7):
        while virtual.active_block.line != line:
            virtual.step(0.1)
        virtual.step(5.0)
        speeds.append(virtual.spindle.rpm)
    assert speeds == [1200.0, 1000.0, 1200.0]


def test_m75_holds_for_a_feed_per_revolution() -> None:
    text = "O1\nM3 S1000\n{}G95 G1 X100. F1.\nM30\n"
    assert seconds(text.format(""), spindle=0.5) > 1.9 * seconds(text.format(""))
    assert seconds(text.format("M75\n"), spindle=0.5) == pytest.approx(seconds(text.format("")), abs=0.1)


@pytest.mark.parametrize(
    ("control", "tap"),
    [("fanuc-m", "G84 Z-20. R0 F500"), ("fanuc-m", "G74 Z-20. R0 F500"), ("meldas-m", "G84 Z-20. R0 F1.")],
)
def test_a_tapping_cycle_runs_at_one_hundred_per_cent(control: str, tap: str) -> None:
    text = f"O1\nM3 S500\n{tap}\nG80\nM30\n"
    assert seconds(text, control, feed=0.1, spindle=0.5) == pytest.approx(seconds(text, control), abs=0.01)


def test_the_spindle_turns_as_programmed_while_it_taps_and_with_the_override_before_and_behind() -> None:
    virtual = power_on("O1\nM3 S500\nG1 X10. F600\nG84 Z-20. R0 F500\nG80 G1 X20.\nM30\n")
    virtual.override(spindle=1.2)
    seen: dict[int, set[float]] = {}
    virtual.cycle_start()
    while virtual.run(limit_s=0.05) is State.RUNNING:
        seen.setdefault(virtual.active_block.line, set()).add(virtual.spindle.rpm)
    assert seen[3] == seen[5] == {600.0}
    assert 500.0 in seen[4]


@pytest.mark.parametrize("before", ["#3004=2\n", "G63\n"])
def test_macro_and_tapping_mode_switch_the_feed_override_off(before: str) -> None:
    plain = seconds(f"O1\n{CUT}M30\n")
    assert seconds(f"O1\n{before}{CUT}M30\n", feed=0.2) == pytest.approx(plain, abs=0.1)


def test_a_feed_hold_waits_for_the_end_of_what_may_not_be_held() -> None:
    virtual = power_on("O1\n#3004=1\nG1 X50. F6000\n#3004=0\nX100.\nM30\n")
    virtual.cycle_start()
    virtual.run(limit_s=0.1)
    virtual.feed_hold()
    virtual.run(limit_s=100.0)
    assert 50.0 <= virtual.machine_position[0] < 60.0


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m"])
def test_a_rapid_goes_at_45_degrees_until_the_shorter_axis_is_there(control: str) -> None:
    virtual = power_on("O1\nG91 G00 X25. Y-10.\nM30\n", control)
    places = []
    virtual.cycle_start()
    while virtual.run(limit_s=0.004) is State.RUNNING:
        places.append(virtual.machine_position[:2])
    moving = [(x, y) for x, y in places if 0.0 < x < 25.0]
    assert any(0.05 < x < 0.35 for x, _ in moving)
    assert all(y == pytest.approx(-x, abs=1e-6) for x, y in moving if x < 0.35), (
        "until the shorter one brakes"
    )
    assert any(x < 24.0 and y == pytest.approx(-10.0, abs=1e-3) for x, y in moving)


@pytest.mark.parametrize(("control", "parameter"), [("fanuc-m", {"1401#1": 1}), ("meldas-m", {"1086": 0})])
def test_a_parameter_makes_the_rapid_a_straight_line(control: str, parameter: dict[str, int]) -> None:
    virtual = power_on("O1\nG91 G00 X25. Y-10.\nM30\n", control, setup=parse_setup({"parameters": parameter}))
    virtual.cycle_start()
    while virtual.run(limit_s=0.02) is State.RUNNING:
        x, y, _ = virtual.machine_position
        assert y == pytest.approx(-0.4 * x, abs=1e-6)
