"""A checkpoint brings the whole control back, in the midst of a motion too: the same happens again."""

from __future__ import annotations

from math import cos, sin
from random import Random
from typing import TYPE_CHECKING

import pytest

from polycnc.mainrun import Record, Snapshot, VirtualControl
from tests.mainrun.execution.test_channels import two_channels
from tests.mainrun.support import MILL, power_on, recorded

if TYPE_CHECKING:
    from collections.abc import Callable

SINUMERIK = """N10 G54 G90 G0 X10 Y5 S1000 M3
N20 R1=0
AGAIN:
N30 G1 X=40+R1 F2000 M8
N40 G2 X=50+R1 Y15 CR=10
N50 R1=R1+1
N55 G4 F0.1
N60 CYCLE81(10,0,2,-5)
N70 IF R1<3 GOTOB AGAIN
N80 STOPRE
N90 G0 Z100 M5
M30
"""
MACRO = """O1
#1=0
WHILE [#1 LT 4] DO1
G1 G90 X[#1*10.] F3000
G41 D1 Y[#1*2.]
X[#1*10.+5.] M8
G40 Y0
G81 X[#1*3.] Z-3. R2. F500.
G80
#1=#1+1
END1
M30
"""
LATHE = """O1
G50 S2000
G96 S150 M3
G0 X50. Z5.
G76 P010060 Q100 R50
G76 X40. Z-20. P1500 Q400 F2.
G1 X60. F.3
M30
"""
PROGRAMS = {
    "fanuc-m": MACRO,
    "sinumerik-840d": SINUMERIK,
    "meldas-m": MILL,
    "syntec-mill": MILL,
    "fanuc-0i-tf": LATHE,
}


def trace(virtual: VirtualControl, disturb: Callable[[int], None]) -> tuple[list[Snapshot], list[Record]]:
    """What the control shows and tells from now on, while somebody disturbs it."""
    records = recorded(virtual)
    shown = []
    for moment in range(40):
        disturb(moment)
        virtual.step(0.06)
        shown.append(virtual.snapshot)
    virtual.listeners.clear()
    return shown, records


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("control", PROGRAMS)
def test_behind_a_checkpoint_the_same_happens_again(control: str, seed: int) -> None:
    random = Random(f"{control} {seed}")
    virtual = power_on(PROGRAMS[control], control)
    virtual.cycle_start()
    virtual.step(random.uniform(0.0, 5.0))
    hold_at, start_at, override_at = sorted(random.sample(range(40), 3))

    def disturb(moment: int) -> None:
        if moment == hold_at and virtual.allows("feed_hold"):
            virtual.feed_hold()
        if moment == start_at and virtual.allows("cycle_start"):
            virtual.cycle_start()
        if moment == override_at:
            virtual.override(feed=0.7)

    checkpoint = virtual.checkpoint()
    first = trace(virtual, disturb)
    for _ in range(2):
        checkpoint.restore()
        assert trace(virtual, disturb) == first


FACETS = "".join(f"X{20 - 20 * cos(k / 20):.3f} Y{20 * sin(k / 20):.3f}\n" for k in range(1, 120))


@pytest.mark.parametrize("begun", [0.0, 0.1, 0.6, 1.3])
def test_a_run_that_a_law_leads_comes_back_in_its_midst(begun: float) -> None:
    """And once more when the law has been found anew."""
    virtual = power_on(f"SOFT G642 CTOL=0.02 G1 F4000\n{FACETS}M30\n", "sinumerik-840d")
    virtual.cycle_start()
    virtual.step(begun)

    def disturb(moment: int) -> None:
        if moment == 2:
            virtual.override(feed=0.6)
        if moment == 4 and virtual.allows("feed_hold"):
            virtual.feed_hold()
        if moment == 8 and virtual.allows("cycle_start"):
            virtual.cycle_start()

    for _ in range(2):
        checkpoint = virtual.checkpoint()
        first = trace(virtual, disturb)
        for _ in range(2):
            checkpoint.restore()
            assert trace(virtual, disturb) == first
        checkpoint.restore()
        virtual.override(feed=0.8)
        virtual.step(0.1)


def test_axes_under_way_by_hand_come_back_too() -> None:
    virtual = power_on()
    virtual.select_mode("jog")
    virtual.jog("X", 1)
    virtual.step(0.3)
    here, checkpoint = virtual.machine_position, virtual.checkpoint()
    virtual.stop_jog()
    virtual.run()
    assert virtual.machine_position != here
    checkpoint.restore()
    assert virtual.machine_position == here
    assert virtual.is_busy


def test_several_channels_come_back_together() -> None:
    virtual = two_channels()
    virtual.cycle_start()
    virtual.step(0.5)
    checkpoint = virtual.checkpoint()
    first = trace(virtual, lambda _: None)
    checkpoint.restore()
    assert trace(virtual, lambda _: None) == first


def test_variables_are_those_of_the_checkpoint() -> None:
    virtual = power_on("O1\n#500=1\nM0\n#500=2\nM30\n")
    virtual.cycle_start()
    virtual.run()
    checkpoint = virtual.checkpoint()
    virtual.cycle_start()
    virtual.run()
    assert virtual.read_variable("#500") == 2
    checkpoint.restore()
    assert virtual.read_variable("#500") == 1
