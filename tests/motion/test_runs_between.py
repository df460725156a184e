"""A line from rest has averages of its own, whatever stands behind it or beside it in the table.

Plan and main run take the same time where a program changes from limited jerk to BRISK, where lines stand in front of
rows of a tool's tip, and where functions of the machine run beside the motion.
"""

from __future__ import annotations

import pytest

import polycnc
from polycnc.mainrun import State
from polycnc.motion.planner import Planner
from polycnc.motion.sampling.samples import Sampler, Samples
from tests.mainrun.support import power_on, recorded

ARC = "G3 X20 Y10 I0 J10"
LINE = "G1 X20 Y10"
#: Two lines in one direction, which count as one.
TWO, ONE = "G1 X5.\nG1 X10.", "G1 X10."


def seconds(text: str, control: str, machine: str = "mill3") -> float:
    """Planned time, which is that of the main run."""
    result = polycnc.run(text, control=control, machine=machine)
    assert result.ok, result.alarms
    virtual = power_on(text, control, machine=machine)
    records, start = recorded(virtual), virtual.time
    virtual.cycle_start()
    virtual.run(limit_s=1000.0)
    assert virtual.state is State.READY
    took = next(record.time for record in reversed(records) if record.what == "state") - start
    assert took == pytest.approx(result.plan.total_s, abs=0.001)
    return float(result.plan.total_s)


@pytest.mark.parametrize("last", [LINE, ARC])
@pytest.mark.parametrize("between", ["", "M3 S100", "G4 F0.1"])
def test_a_line_under_soft_in_front_of_brisk_is_as_quick_as_by_itself(between: str, last: str) -> None:
    head, foot = "G71 G90 G94 G64 F12000", "M30\n"
    both = seconds(f"{head} SOFT\nG1 X10\n{between}\nBRISK\n{last}\n{foot}", "sinumerik-840d")
    soft = seconds(f"{head} SOFT\nG1 X10\n{foot}", "sinumerik-840d")
    brisk = seconds(f"{head} BRISK\nG9 G0 X10\n{between}\n{last}\n{foot}", "sinumerik-840d")
    rapid = seconds(f"{head} BRISK\nG9 G0 X10\n{foot}", "sinumerik-840d")
    assert both == pytest.approx(soft + brisk - rapid, abs=1e-6)


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m", "syntec-mill"])
def test_lines_in_front_of_a_tip_count_as_one_like_others(control: str) -> None:
    """On SYNTEC a law leads two of them, which takes a little longer."""
    text = "G90 G94 F1000.\n{}\nG43.4 H1\nG1 X20. B4. C4.\nG49\nM30\n"
    times = [seconds(text.format(lines), control, "mill5-bc-head") for lines in (ONE, TWO)]
    assert times[0] == pytest.approx(times[1], abs=0.005 if control == "syntec-mill" else 1e-6)


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m", "syntec-mill", "sinumerik-840d"])
@pytest.mark.parametrize("code", ["M8", "M8\nM8", "G1 X6. M8"])
def test_a_function_beside_the_motion_waits_alike(control: str, code: str) -> None:
    seconds(f"G90 G94 G64 F1000.\nG1 X1.\n{code}\nG1 X12.\nY5.\nM30\n", control)


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m", "syntec-mill", "sinumerik-840d"])
@pytest.mark.parametrize("code", ["G1 X2. M8", "G1 X2. M8\nG1 X3. M8", "G0 X2. M8\nG1 X3.", "G1 Y1. M8"])
def test_a_function_that_outlasts_its_block_waits_at_its_end(control: str, code: str) -> None:
    longer = seconds(f"G90 G94 G64 F9000.\nG1 X1.\n{code}\nG1 X12.\nX30.\nM30\n", control)
    shorter = seconds(f"G90 G94 G64 F9000.\nG1 X1.\n{code.replace(' M8', '')}\nG1 X12.\nX30.\nM30\n", control)
    assert longer - shorter > 0.1 * code.count("M8")


def test_the_axes_stand_at_the_end_of_a_block_that_a_function_outlasts() -> None:
    result = polycnc.run(
        "G90 G94 F6000.\nG1 X1.\nG1 X2. M8\nG1 X30.\nM30\n", control="fanuc-m", machine="mill3"
    )
    found: list[Samples] = []
    planner = Planner(result.toolpath, result.machine, **result.lead)
    sampler = Sampler(result.toolpath, result.machine, planner, result.lead["settings"], 0.001, found.append)
    for chunk in result.toolpath.chunks:
        sampler.take(chunk)
    planner.finish()
    sampler.close()
    assert sum(int((abs(each.position[:, 0] - 2.0) < 1e-6).sum()) for each in found) > 100
