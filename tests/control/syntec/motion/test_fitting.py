"""Which blocks G05 fits, and how near rotary axes keep to their way (manual 2.11)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.session import open_session
from tests.support import run

if TYPE_CHECKING:
    from polycnc.motion.sampling.samples import Samples
    from polycnc.toolpath import Context

SETUP = {"machine": "mill4", "parameters": {"407": 100}}


def contexts(text: str) -> list[Context]:
    channel = run(text, "syntec-mill", machine="mill4", setup={"parameters": {"407": 100}})
    assert not channel.alarms
    return [row.context for row in channel.toolpath.rows() if row.event is None]


def test_corners_of_blocks_that_move_other_axes_keep_no_tolerance() -> None:
    text = "G90 G94 F1000\nG05 P10000 X0 A0.5\nG01 X1.\nX2. A1.\nX3. Y1.\nX4.\nX5.\nA2.\nX6.\nG05 P0\nM30\n"
    found = [(context.tolerance_mm, context.turn_tolerance_deg) for context in contexts(text)]
    on, off = (0.1, 0.5), (0.0, 0.0)
    # Y is not named; the block of A alone has no way of X. The corner behind such a block belongs to it too.
    assert found == [on, on, off, off, on, off, off]


def test_without_axes_g05_fits_the_geometry_axes() -> None:
    text = "G90 G94 F1000\nG05 P10000\nG01 X1.\nX3. Y1. Z1.\nX4. A1.\nX5.\nX6.\nM30\n"
    assert [context.tolerance_mm for context in contexts(text)] == [0.1, 0.1, 0.0, 0.0, 0.1]


def test_a_reset_ends_the_choice_of_blocks() -> None:
    channel = run("G05 P10000 X0 A0.5\nG01 X1. F100\nM30\n", "syntec-mill", machine="mill4")
    assert not channel.path.is_idle
    channel.control.reset(channel)
    assert channel.path.is_idle


@settings(max_examples=12, deadline=None)
@given(st.sampled_from([0.002, 0.02, 0.2]), st.floats(0.5, 10.0), st.floats(0.01, 2.0))
def test_the_rotary_axis_keeps_its_tolerance_at_corners(tolerance: float, way: float, turn: float) -> None:
    ends = [(k * way, k % 2 * turn) for k in range(1, 6)]
    lines = "".join(f"X{x:.3f} A{a:.3f}\n" for x, a in ends)
    text = f"G90 G94 G01 X0 A0 F6000\nG05 P10000 X0 A{tolerance}\n{lines}G05 P0\nM30\n"
    session = open_session(text, control="syntec-mill", setup=SETUP, keep=False)
    x_of: list[float] = []
    a_of: list[float] = []

    def take(samples: Samples) -> None:
        x_of.extend(samples.position[:, 0])
        a_of.extend(samples.position[:, 3])

    sampler = session.sample(0.0005, take)
    assert session.run().plan.times.total_s > 0.0
    sampler.close()
    reached = np.interp([x for x, _ in ends[:-1]], x_of, a_of)
    assert reached == pytest.approx([a for _, a in ends[:-1]], abs=tolerance)
