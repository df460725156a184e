"""Rows on which a curve table of lines leads an axis: the path rests where the table has a kink, and nowhere else.

Random tables and rows: by the differences of sampled positions no axis exceeds its velocity, its acceleration or, under
SOFT, its jerk, and the main run is where the samples are. `pytest --hypothesis-profile=explore` draws 200 others.
"""

from __future__ import annotations

from pathlib import Path
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.motion.limits import channel_axes
from polycnc.motion.sampling.samples import Samples
from polycnc.session import open_session
from tests.mainrun.support import power_on

CONTROL, MACHINE = "sinumerik-840d", "mill5-xyzvw"
PERIOD, CYCLE = 0.001, 0.004
SLACK = 1.001
#: Largest distance of samples and main run, mm: an arc is a circle in the main run, cubics of 7.5° in the samples.
APART = 0.002
CI, EXPLORE = 6, 200


def program(seed: int) -> str:
    random = Random(seed)
    draw = random.uniform
    lines = [f"G1 F3000 {random.choice(('SOFT', 'BRISK'))} {random.choice(('G64', 'G60', 'G642'))}", "X0 V0"]
    count, x, v, periodic = random.randint(1, 6), -100.0, 0.0, random.choice((0, 0, 1))
    lines += [f"CTABDEF(V,X,1,{periodic})", f"G1 X{x} V0"]
    for k in range(count):
        x, v = x + draw(5.0, 30.0), random.choice((0.0, v, v + draw(-8.0, 8.0)))
        lines.append(f"X{x:.3f} V{0.0 if periodic and k == count - 1 else v:.3f}")
    lines += ["CTABEND", "LEADON(V,X,1)"]
    for _ in range(random.randint(1, 4)):
        i, j = draw(-15.0, 15.0), draw(-15.0, 15.0)
        lines.append(
            random.choice(
                (
                    f"G1 X{draw(-120.0, 80.0):.3f} Y{draw(-30.0, 30.0):.3f} F{random.choice((800, 8000))}",
                    f"G0 X{draw(-120.0, 80.0):.3f}",
                    f"{random.choice(('G2', 'G3'))} X=IC({2 * i:.3f}) Y=IC({2 * j:.3f}) I{i:.3f} J{j:.3f} F2000",
                    f"G1 Y{draw(-30.0, 30.0):.3f} V=IC({draw(-3.0, 3.0):.3f}) F1500",
                )
            )
        )
    return "\n".join([*lines, "LEADOF(V,X)", "M30", ""])


def sampled(
    text: str, machine: str | Path = MACHINE
) -> tuple[float, Samples, list[tuple[float, float, float]]]:
    """Planned time, samples, and velocity, acceleration and jerk of the axes."""
    found: list[Samples] = []
    session = open_session(text.encode(), control=CONTROL, machine=machine, keep=False)
    sampler = session.sample(PERIOD, found.append)
    result = session.run()
    total = result.plan.total_s
    sampler.close()
    axes = channel_axes(result.machine, 1, result.machine.channels[0].names)
    limits = [(axis.rapid, axis.acceleration, axis.jerk) for axis in axes if axis is not None]
    return total, Samples(*(np.concatenate(column) for column in zip(*found, strict=True))), limits


def check(text: str) -> None:
    _, samples, limits = sampled(text)
    for i, own in enumerate(limits):
        for order in (1, 2, 3) if "SOFT" in text else (1, 2):
            changes = np.abs(np.diff(samples.position[:, i], order)) / PERIOD**order
            assert changes.max(initial=0.0) <= own[order - 1] * SLACK, text
    virtual = power_on(text, CONTROL, machine=MACHINE)
    virtual.cycle_start()
    for places in samples.position[::4]:
        for place, sample in zip(virtual.machine_position, places, strict=True):
            assert place == pytest.approx(sample, abs=APART), text
        virtual.step(CYCLE)


@pytest.mark.parametrize("seed", range(CI))
def test_axes_keep_their_limits_at_the_kinks_of_a_table(seed: int) -> None:
    check(program(seed))


@settings(max_examples=EXPLORE if settings.get_current_profile_name() == "explore" else 1, deadline=None)
@given(st.integers(100, 1_000_000))
def test_so_they_do_on_tables_that_nobody_has_seen(seed: int) -> None:
    text = program(seed)
    if (
        open_session(text.encode(), control=CONTROL, machine=MACHINE).run().ok
    ):  # no arc beyond the table's reach
        check(text)


@pytest.mark.parametrize("mode", ["SOFT", "BRISK"])
def test_a_kink_of_an_axis_that_polar_interpolation_makes_costs_a_stop_too(mode: str) -> None:
    text = (
        f"{mode} G18 DIAMOF G0 X20 Z5 F2000\nTRANSMIT\nCTABDEF(V,Y,1,0)\nG1 Y0 V0\nY10 V4\nY20 V20\nCTABEND\n"
    )
    machine = Path(__file__).parents[3] / "conformance" / "machines" / "lathe-c-transmit-v.toml"
    _, samples, limits = sampled(f"{text}LEADON(V,Y,1)\nY15\nY0\nM30\n", machine)
    for column, own in zip(samples.position.T, limits, strict=True):
        assert np.abs(np.diff(column)).max() <= own[0] * PERIOD * SLACK
        assert np.abs(np.diff(column, 2)).max() <= own[1] * PERIOD**2 * SLACK


@pytest.mark.parametrize("mode", ["SOFT", "BRISK"])
def test_a_kink_costs_a_stop_at_its_place_not_the_way_of_its_row(mode: str) -> None:
    points = ("X0 V0", "X30 V10", "X60 V10", "X80 V30", "X100 V30")
    table = "\n".join((f"{mode} G64", "CTABDEF(V,X,1,0)", "G1 " + points[0], *points[1:], "CTABEND"))
    total, samples, _ = sampled(f"{table}\nLEADON(V,X,1)\nG1 X100 F2000\nM30\n")
    assert 3.0 < total < 3.5
    x, speed = samples.position[:, 0], np.abs(samples.velocity[:, 0])
    assert speed[(x > 35.0) & (x < 55.0)].min() == pytest.approx(2000.0 / 60.0)
    for kink in (30.0, 60.0, 80.0):
        assert speed[np.abs(x - kink) < 0.01].min() < 2.0
