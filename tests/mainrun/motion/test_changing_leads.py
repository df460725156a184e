"""In the main run too threads whose lead changes are where the spindle's angle asks them to be."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

import pytest

from tests.mainrun.support import power_on

if TYPE_CHECKING:
    from polycnc.mainrun import VirtualControl

CYCLE_S, TURNS_S = 0.004, 10.0
FANUC = "O1\nG99 G97 S600 M3\nG0 X20. Z5.\nG34 Z-55. F2. K0.2\nG0 X30.\nZ5.\nM30\n"
SIEMENS = "G90 G95 S600 M3 BRISK\nG0 X20 Z5\nG34 Z-55 K2 F0.2\nG0 X30\nZ5\nM30\n"
SOFT = SIEMENS.replace("BRISK", "SOFT")
PROGRAMS = [(FANUC, "fanuc-0i-tf"), (SIEMENS, "sinumerik-840d"), (SOFT, "sinumerik-840d")]


def turns(virtual: VirtualControl) -> float:
    """What the spindle has turned since the thread began, by where Z is."""
    way = 5.0 - virtual.machine_position[1]
    return (sqrt(2.0**2 + 2.0 * 0.2 * way) - 2.0) / 0.2


def on_the_thread(text: str, control: str, override: float = 1.0) -> VirtualControl:
    """A control whose Z has come to -10 on the thread, under a spindle override."""
    virtual = power_on(text, control, machine="lathe2")
    virtual.override(spindle=override)
    virtual.cycle_start()
    virtual.run_until(lambda control: control.machine_position[1] > 4.0)
    assert virtual.run_until(lambda control: control.machine_position[1] < -10.0)
    return virtual


def follows(virtual: VirtualControl, turns_s: float, until: float) -> None:
    """The thread keeps up with the spindle until Z is there."""
    since, begun = virtual.time, turns(virtual)
    while virtual.machine_position[1] > until:
        virtual.step(CYCLE_S)
        assert turns(virtual) - begun == pytest.approx((virtual.time - since) * turns_s, abs=1e-6)


@pytest.mark.parametrize(("text", "control"), PROGRAMS)
def test_the_place_follows_the_angle(text: str, control: str) -> None:
    follows(on_the_thread(text, control), TURNS_S, -45.0)


@pytest.mark.parametrize("override", [0.5, 1.2])
def test_a_spindle_override_makes_the_axis_slower_or_faster(override: float) -> None:
    for text, control in PROGRAMS[1:]:
        follows(on_the_thread(text, control, override), override * TURNS_S, -40.0)


@pytest.mark.parametrize("override", [0.5, 1.2])
@pytest.mark.parametrize("text", [SIEMENS, SIEMENS.replace("G34 Z-55 K2 F0.2", "G33 Z-55 K4")])
def test_an_override_within_a_thread_acts_at_once(text: str, override: float) -> None:
    virtual = on_the_thread(text, "sinumerik-840d")
    virtual.override(spindle=override)
    virtual.step(0.05)
    since, place = virtual.time, virtual.machine_position[1]
    lead = 4.0 if "G33" in text else sqrt(4.0 + 0.4 * (5.0 - place))
    virtual.step(CYCLE_S)
    speed = (place - virtual.machine_position[1]) / (virtual.time - since)
    assert speed == pytest.approx(override * TURNS_S * lead, rel=0.01)
    if "G34" in text:
        follows(virtual, override * TURNS_S, -45.0)


def test_the_spindle_override_acts_on_no_thread_of_the_lathe() -> None:
    follows(on_the_thread(*PROGRAMS[0], 0.5), TURNS_S, -45.0)


@pytest.mark.parametrize(("text", "control"), PROGRAMS)
def test_feed_hold_and_feed_override_do_nothing_in_it(text: str, control: str) -> None:
    virtual = on_the_thread(text, control)
    virtual.feed_hold()
    virtual.override(feed=0.3)
    follows(virtual, TURNS_S, -45.0)


def test_single_block_lets_a_chain_of_the_lathe_run_on() -> None:
    text = FANUC.replace("K0.2\n", "K0.2\nG32 Z-90. F5.2915\n")
    virtual = power_on(text, "fanuc-0i-tf", machine="lathe2")
    virtual.set_switches(single_block=True)
    for _ in range(2):
        virtual.cycle_start()
        virtual.run(limit_s=20.0)
    assert virtual.machine_position[1] == pytest.approx(5.0)
    virtual.cycle_start()
    virtual.run_until(lambda control: control.machine_position[1] < -10.0)
    follows(virtual, TURNS_S, -50.0)
    virtual.run_until(lambda control: control.machine_position[1] < -60.0)
    since, place = virtual.time, virtual.machine_position[1]
    virtual.step(0.1)
    assert place - virtual.machine_position[1] == pytest.approx(0.1 * TURNS_S * 5.2915, rel=1e-4)
    assert virtual.time > since
    virtual.run(limit_s=20.0)
    assert virtual.machine_position == pytest.approx([15.0, -90.0])


def test_a_reset_brakes_it() -> None:
    virtual = on_the_thread(SIEMENS, "sinumerik-840d")
    virtual.reset()
    virtual.step(1.0)
    place = virtual.machine_position[1]
    assert -20.0 < place < -10.0
    virtual.step(1.0)
    assert virtual.machine_position[1] == pytest.approx(place)
