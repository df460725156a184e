"""Random programs with couplings under TRAORI: every axis keeps its limits, and the slide is where its law has it."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.conformance.reading import HERE
from tests.mainrun.support import power_on

CONTROL, MACHINE = "sinumerik-840d", str(HERE / "machines/mill5-bc-head-v.toml")
CYCLE, SLACK, ROUNDING = 0.004, 1.001, 1e-6
CI, EXPLORE = 3, 300


def program(random: Random) -> tuple[str, str, float]:
    """A program, the leading axis of V in it, and the factor."""
    leading, factor = random.choice("XYZ"), random.choice((-1.5, 0.4, 1.0))
    lines = [
        random.choice(("SOFT", "BRISK")), random.choice(("G60", "G64")), "T1 D1",
        f"G0 B{random.uniform(-40, 40):.1f} C{random.uniform(-90, 90):.1f}", "TRAORI", "G0 X0 Y0 Z0",
        f"TRAILON(V,{leading},{factor})", "G1 F3000",
    ]  # fmt: skip
    for _ in range(random.randrange(3, 8)):
        axes = [axis for axis in "XYZBC" if random.random() < 0.5] or ["X"]
        words = " ".join(f"{axis}{random.uniform(-50, 50):.2f}" for axis in axes)
        lines.append(f"{random.choice(('G0', 'G1', 'G1'))} {words} F{random.randrange(500, 9000)}")
    lines += [f"R1=$AA_IW[{leading}] R2=$AA_IM[V]", "M30"]
    return "\n".join(lines) + "\n", leading, factor


def check(seed: int) -> None:
    text, _, factor = program(Random(seed))
    virtual = power_on(
        text, CONTROL, machine=MACHINE, setup={"tools": {1: {"length": 80, "type": 120, "radius": 5}}}
    )
    virtual.cycle_start()
    places = [list(virtual.positions.real.values())]
    while virtual.is_busy and len(places) < 20_000:
        virtual.step(CYCLE)
        places.append(list(virtual.positions.real.values()))
    assert virtual.alarms == (), text
    leading, slide = (float(str(virtual.read_variable(name))) for name in ("R1", "R2"))
    assert slide == pytest.approx(factor * leading, abs=1e-3), text
    steps = np.diff(places, axis=0)
    for i, axis in enumerate(virtual.machine.channel_axes(1)):
        data = virtual.machine.axis[axis]
        assert np.abs(steps[:, i]).max() <= data.rapid * CYCLE * SLACK + ROUNDING, (axis, text)
        slope = data.acceleration * CYCLE**2
        assert np.abs(np.diff(steps[:, i])).max(initial=0.0) <= slope * SLACK + ROUNDING, (axis, text)


@pytest.mark.parametrize("seed", range(CI))
def test_axes_keep_their_limits_and_the_slide_its_law(seed: int) -> None:
    check(seed)


@settings(max_examples=EXPLORE if settings.get_current_profile_name() == "explore" else 1, deadline=None)
@given(st.integers(CI, 1_000_000))
def test_so_it_is_with_programs_that_nobody_has_seen(seed: int) -> None:
    check(seed)
