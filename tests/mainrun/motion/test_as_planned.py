"""The main run is where the samples are, on programs whose way or corners its own rules could take otherwise."""

from __future__ import annotations

import numpy as np
import pytest

from polycnc.machine import parse_setup
from polycnc.mainrun import State
from polycnc.motion.sampling.samples import Samples
from polycnc.session import open_session
from tests.mainrun.support import power_on, recorded

PERIOD = 0.001
SPIRALS = [
    "G21 G90 G61\nG1 X20. F1000\nG3.1 X0 Y5. I-20. J0\nM30\n",
    "G21 G90 G64\nG1 X5. F1000\nG3.1 X0 Y50. Z8. I-5. J0\nG1 Y60.\nM30\n",
]
#: The rotary axis turns fast on a way of half a millimetre: no law leads from one into the next row.
TURNS = "G1 X1.723 Y-7.118 Z6.415 A=DC(63.933) F6000\nG1 X2.037 Y-7.276 Z6.123 A=IC(52)\n"
ARC = "G2 X10.6218 Y-35.4401 I4.54472 J-14.00514 F500\n"
LEFT = "G1 X10.6 Y-35.6 A=IC(200)\n"
CLAMPS: dict[str, object] = {"5161#4": 1, "5110": 68, "13543": 78, "13544": 68, "13545": 178}
TAPS: dict[str, object] = {"5203#4": 1, "5200#4": 1, "5211": 200}
TO_AND_FRO = "TRAORI\nFOR R1=1 TO 8\nX=R1*5 A=12*(R1 MOD 2)\nENDFOR\nM30\n"
#: Programs of which plan and main run have thought otherwise: control, text, setup.
DOUBTFUL: dict[str, tuple[str, str, dict[str, object]]] = {
    "a lathe that begins at a diameter": (
        "fanuc-0i-tf", "G0 X100. Z30.\nG1 X90. F100 G98\nM30\n", {"start": {"X": 80, "Z": 40}},
    ),
    "a preprocessing stop": ("sinumerik-840d", "G64 G1 X10 F6000\nSTOPRE\nX20 Y1\nR1=$AA_IM[X]\nX30\nM30\n", {}),
    "a signal that is read": ("fanuc-m", "G64 G1 X10. F6000\n#1=#1000\n#2=#1001\nX20. Y1.\nM30\n", {}),
    "a stop that is switched off": ("meldas-m", "G64 G1 X10. F6000\nM1\nX20. Y1.\nM30\n", {}),
    "a wait of the program": ("syntec-mill", "%@MACRO\nG64 G1 X10. F6000;\nWAIT();\nG1 X20. Y1.;\nM30;\n", {}),
    "a function that outlasts its block": ("fanuc-m", "G1 X1. F6000 M8\nX2. M9\nX3. M8\nG4 P100\nM30\n", {}),
    "a function in a block that waits for its tool": ("syntec-mill", "T2 M6\nG1 X1. F1000. M8\nM30\n", {}),
    "a function beside BRISK behind SOFT": (
        "sinumerik-840d", "SOFT\nG1 X20 F8000\nBRISK\nX21 M8\nM30\n", {},
    ),
    "an arc at constant surface speed under SOFT": (
        "sinumerik-840d", "G18 DIAMON SOFT G0 X46.392\nG96 S120 M3\nG3 X75.7 Z-14.9 CR=16.7 F0.5\nG1 X80\nM30\n",
        {"machine": "lathe2"},
    ),
    "an arc at constant surface speed behind a corner": (
        "sinumerik-840d",
        "G18 DIAMON BRISK G64 G95\nG96 S120 M3\nG0 X133.1 Z-26.9\nG2 X119.7 Z-24.2 CR=7.2 F0.2\nM30\n",
        {"machine": "lathe2"},
    ),
    "a stroke behind a clamp": (
        "fanuc-0i-tf", "G98 G0 X40. Z0 C0\nG83 Z-10. R-2. F1000. M68\nG80\nM30\n",
        {"machine": "lathe-c", "parameters": CLAMPS},
    ),
    "a tap on which the override acts": (
        "fanuc-0i-tf", "G99 G0 X0 Z5.\nM29 S600\nG84 Z-18. R-3. F1.\nG80\nM30\n", {"parameters": TAPS},
    ),
    "a tool that turns within its tolerance": (
        "sinumerik-840d", f"G64 G1 F20000 OST OTOL=1\n{TO_AND_FRO}", {"machine": "mill5-ca-head"},
    ),
    "a tool that turns within a distance": (
        "sinumerik-840d", f"G642 G1 F20000 OSD\n$SC_ORI_SMOOTH_DIST=2\n{TO_AND_FRO}", {"machine": "mill5-ca-head"},
    ),
}  # fmt: skip
#: Two blocks between which very many have no way: each calculates, changes nothing, or repeats a point.
BETWEEN = {
    "sinumerik-840d": ("G64 BRISK G1 X10 F3000\n", "X20 Y1\nY20\nM30\n", ("R1=R1+1\n", "G90\n", "X10\n")),
    "fanuc-m": ("G64 G1 X10. F3000\n", "X20. Y1.\nY20.\nM30\n", ("#1=#1+1\n", "G90\n", "X10.\n")),
    "meldas-m": ("G64 G1 X10. F3000\n", "X20. Y1.\nY20.\nM30\n", ("#1=#1+1\n", "G90\n", "X10.\n")),
    "syntec-mill": ("G64 G1 X10. F3000\n", "X20. Y1.\nY20.\nM30\n", ("G90\n", "X10.\n")),
    "fanuc-0i-tf": ("G98 G1 X10. F3000\n", "X20. Z1.\nZ20.\nM30\n", ("#1=#1+1\n", "G98\n", "X10.\n")),
}
#: Blocks that a law leads and that a function outlasts: the axes rest behind them in any case.
OUTLASTED = [
    "G0 X2.515 Y-29.513\nG0 X-23.644 Y8.649 M8\nG2 X-23.6492 Y8.2103 I-1.96125 J-0.19613 M8 F6000\nM30\n",
    "G1 X12 Y11 M8 F3000\nX9.946 Y13.343\nG0 X23.34 Y-24.467 M8\nG2 X26.3 Y-21.9 CR=6 M9\nG1 X26.05\nM30\n",
]


def sampled(
    text: str, control: str, machine: str | None = None, setup: dict[str, object] | None = None
) -> Samples:
    """The samples of a program."""
    given: list[Samples] = []
    session = open_session(text.encode(), control=control, machine=machine, setup=setup, keep=False)
    sampler = session.sample(PERIOD, given.append)
    assert session.run().plan.total_s > 0.0
    sampler.close()
    return Samples(*(np.concatenate(column) for column in zip(*given, strict=True)))


@pytest.mark.parametrize("text", SPIRALS)
def test_a_spiral_is_run_as_its_way_grows(text: str) -> None:
    virtual = power_on(text, "meldas-m")
    virtual.cycle_start()
    for place in sampled(text, "meldas-m", "mill3").position[::4]:
        assert virtual.machine_position == pytest.approx(place, abs=1e-5)
        virtual.step(4.0 * PERIOD)


@pytest.mark.parametrize("corners", ["G64", "G642", "G641 ADIS=0.05"])
@pytest.mark.parametrize("blocks", [TURNS + ARC, ARC + LEFT, TURNS + ARC + LEFT + ARC])
def test_the_axes_rest_where_no_law_leads_on_around_one_line(corners: str, blocks: str) -> None:
    text = f"G71 G90 SOFT {corners}\n{blocks.replace('I4.54472 J-14.00514', 'CR=40')}M30\n"
    virtual = power_on(text, "sinumerik-840d", machine="mill4")
    records, planned = recorded(virtual), sampled(text, "sinumerik-840d", "mill4").time[-1]
    virtual.cycle_start()
    assert virtual.run() is State.READY
    end = next(record.time for record in reversed(records) if record.what == "state")
    assert end == pytest.approx(planned, abs=8.0 * PERIOD)


@pytest.mark.parametrize("name", DOUBTFUL)
def test_plan_and_main_run_agree_on(name: str) -> None:
    control, text, setup = DOUBTFUL[name]
    virtual = power_on(text, control, setup=parse_setup(setup))
    records, samples = recorded(virtual), sampled(text, control, setup=setup)
    axes = virtual.machine.axes
    virtual.cycle_start()
    for place in samples.position[::4]:
        assert virtual.machine_position == pytest.approx(place, abs=0.002)
        virtual.step(4.0 * PERIOD)
    assert virtual.run() is State.READY
    end = next(record.time for record in reversed(records) if record.what == "state")
    assert end == pytest.approx(samples.time[-1], abs=PERIOD + 1e-6)
    steps = np.diff(samples.position, 2, axis=0)
    for step, axis in zip(steps.T, axes, strict=True):
        assert np.abs(step).max() <= axis.acceleration * PERIOD**2 * 1.001


@pytest.mark.parametrize("blocks", OUTLASTED)
def test_the_axes_rest_behind_a_run_by_law_that_a_function_outlasts(blocks: str) -> None:
    text = f"G71 G90 SOFT G641 ADIS=0.3\n{blocks}"
    virtual = power_on(text, "sinumerik-840d")
    records, planned = recorded(virtual), sampled(text, "sinumerik-840d").time[-1]
    virtual.cycle_start()
    assert virtual.run() is State.READY
    end = next(record.time for record in reversed(records) if record.what == "state")
    assert end == pytest.approx(planned, abs=2.0 * PERIOD)


@pytest.mark.parametrize("count", [300, 3000])
@pytest.mark.parametrize("control", BETWEEN)
def test_the_axes_wait_for_no_block_without_a_way(control: str, count: int) -> None:
    before, behind, between = BETWEEN[control]
    planned = sampled(before + behind, control).time[-1]
    for block in between:
        virtual = power_on(before + count * block + behind, control)
        records = recorded(virtual)
        virtual.cycle_start()
        assert virtual.run() is State.READY
        end = next(record.time for record in reversed(records) if record.what == "state")
        assert end == pytest.approx(planned, abs=PERIOD + 1e-6), block
