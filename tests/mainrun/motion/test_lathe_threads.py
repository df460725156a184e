"""What threads and taps of the lathe keep from the operator (FANUC 0i-TF Plus II.3.1, 4.1.2, 4.3.7)."""

from __future__ import annotations

import pytest

from polycnc.machine import parse_setup
from polycnc.mainrun import State, VirtualControl
from tests.mainrun.support import power_on, run_through

THREAD = "O1\nG99 G97 S600 M03\nG00 X40. Z2.\nG32 Z-20. F2.\nG00 X50.\nZ2.\nX40.\nM30\n"
CYCLE = "O1\nG99 G97 S600 M03\nG00 X40. Z2.\nG92 X30. Z-20. F2.\nG00 X60.\nM30\n"


def held(text: str, *, at_z: float, **parameters: int) -> VirtualControl:
    """A control on which feed hold was pressed once while a thread was cut, when the axes stand."""
    setup = parse_setup({"parameters": parameters, "switches": {"thread_chamfer": False}})
    virtual = power_on(text, "fanuc-0i-tf", setup=setup)
    virtual.cycle_start()
    assert virtual.run_until(lambda control: control.machine_position[1] < at_z)
    virtual.feed_hold()
    virtual.step(30.0)
    return virtual


def test_feed_hold_in_a_thread_acts_behind_the_first_block_that_is_none() -> None:
    virtual = held(THREAD, at_z=-5.0)
    assert virtual.machine_position == pytest.approx([25.0, -20.0])
    assert virtual.state is State.HOLD
    assert run_through(virtual) is State.READY
    assert virtual.machine_position == pytest.approx([20.0, 2.0])


def test_feed_hold_in_a_thread_cycle_acts_back_at_its_start() -> None:
    assert held(CYCLE, at_z=-5.0).machine_position == pytest.approx([20.0, 2.0])


def test_feed_hold_in_a_thread_cycle_acts_behind_the_retract_by_parameter() -> None:
    virtual = held(CYCLE, at_z=-5.0, **{"5109#3": 1})
    assert virtual.machine_position == pytest.approx([20.0, -20.0])


def test_a_thread_runs_at_one_hundred_per_cent_whatever_the_overrides() -> None:
    times = []
    for feed, spindle in ((1.0, 1.0), (0.1, 1.0), (1.0, 0.5)):
        virtual = power_on("O1\nG99 G97 S600 M03\nG32 Z-20. F2.\nM30\n", "fanuc-0i-tf")
        virtual.override(feed=feed, spindle=spindle)
        assert run_through(virtual) is State.READY
        times.append(virtual.time)
    assert times[1] == pytest.approx(times[0], abs=0.05)
    assert times[2] == pytest.approx(times[0], abs=0.05)


def test_feed_hold_in_a_tap_acts_back_at_the_initial_level() -> None:
    text = "O1\nG99 G97 S600 M03\nG00 X0 Z5.\nG84 Z-20. R-3. F1.\nG80\nG00 X30.\nM30\n"
    assert held(text, at_z=-5.0).machine_position == pytest.approx([0.0, 5.0])


@pytest.mark.parametrize(("roc", "slower"), [(0, 5.0), (1, 0.0)])
def test_the_rapid_override_acts_on_a_retract_at_its_own_speed_unless_a_parameter_forbids(
    roc: int, slower: float
) -> None:
    # 5 mm at 1 mm/s, at half of it with the override; the other rapids are fast.
    times = []
    for rapid in (1.0, 0.5):
        parameters = {"1466": 60, "1403#4": roc, "5109#3": 1}
        setup = parse_setup({"parameters": parameters, "switches": {"thread_chamfer": False}})
        virtual = power_on(CYCLE, "fanuc-0i-tf", setup=setup)
        virtual.override(rapid=rapid)
        assert run_through(virtual) is State.READY
        times.append(virtual.time)
    assert times[1] - times[0] == pytest.approx(slower, abs=0.6)


def test_the_rapid_override_leaves_a_retract_at_rapid_traverse_alone_by_parameter() -> None:
    speeds = []
    for roc in (0, 1):
        setup = parse_setup({"parameters": {"1403#4": roc}, "switches": {"thread_chamfer": False}})
        virtual = power_on(CYCLE, "fanuc-0i-tf", setup=setup)
        virtual.override(rapid=0.01)
        assert run_through(virtual) is State.READY
        speeds.append(virtual.time)
    assert speeds[0] > speeds[1] + 0.5
