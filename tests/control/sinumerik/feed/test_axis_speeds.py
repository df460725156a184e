"""VELOLIM holds where the path goes over from one direction into another, too."""

from __future__ import annotations

from math import pi, sin
from random import Random

import numpy as np
import pytest

from polycnc.machine import load_machine
from polycnc.session import open_session

PERIOD, SLACK = 0.001, 1.001
HEAD = "G90 G94 BRISK {code}\nVELOLIM[X]={x}\nVELOLIM[Y]={y}\nG1 F24000\n"


@pytest.mark.parametrize("code", ["G64", "G641 ADIS=0.5", "G642 CTOL=0.05"])
@pytest.mark.parametrize(("x", "y"), [(100, 20), (50, 10), (5, 100)])
def test_no_axis_is_faster_on_rounded_corners(code: str, x: int, y: int) -> None:
    """By the limit of each row alone an axis is faster by up to a fifteenth where a row that moves it more follows."""
    draw = Random(3)
    ways = ((k, 8.0 * sin(0.08 * pi * k) + draw.uniform(-0.05, 0.05)) for k in range(1, 60))
    text = HEAD.format(code=code, x=x, y=y) + "".join(f"X{a:.3f} Y{b:.3f}\n" for a, b in ways) + "M30\n"
    session = open_session(text, control="sinumerik-840d", machine="mill3", keep=False)
    found: list[np.ndarray] = []
    sampler = session.sample(PERIOD, lambda samples: found.append(samples.position))
    result = session.run()
    assert result.plan.total_s > 0.0
    sampler.close()
    steps = np.abs(np.diff(np.concatenate(found), axis=0)).max(axis=0) / PERIOD
    machine = load_machine("mill3")
    for axis, left, fastest in zip("XY", (x, y), steps, strict=False):
        assert fastest <= 0.01 * left * machine.axis[axis].max_feed * SLACK
    assert (
        steps[0] > 0.009 * x * machine.axis["X"].max_feed
        or steps[1] > 0.0099 * y * machine.axis["Y"].max_feed
    )
