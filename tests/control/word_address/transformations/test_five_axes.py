"""Tilted planes and tool centre point control: positions of the axes for a tip and its plane."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.machine.kinematics import Kinematics
from tests.support import codes, run

ANGLES = st.floats(-170.0, 170.0)


@given(i=ANGLES, j=st.floats(1.0, 170.0), depth=st.floats(-50.0, 50.0))
def test_on_an_aligned_plane_the_tool_moves_along_its_own_axis(i: float, j: float, depth: float) -> None:
    head = f"G68.2 X5. Y0 Z0 I{i:.3f} J{j:.3f} K0\nG53.1\nG43 H1 G0 X1. Y2. Z0\n"
    setup = {"machine": "mill5-bc-head", "tools": {1: {"length": 80}}}
    surface = run(head + "M30\n", setup=setup, machine="mill5-bc-head").coordinates.machine
    channel = run(f"{head}Z{depth:.3f}\nM30\n", setup=setup, machine="mill5-bc-head")
    kinematics = Kinematics.of(channel.machine)
    tool = kinematics.tool_on_machine(dict(zip(channel.axes, channel.coordinates.machine, strict=True)))
    way = [b - a for a, b in zip(surface[:3], channel.coordinates.machine[:3], strict=True)]
    assert way == pytest.approx([part * float(f"{depth:.3f}") for part in tool], abs=1e-5)


@pytest.mark.parametrize(
    ("block", "code"),
    [
        ("G68.2 P1 Q112 I5.", "PS5457"),
        ("G68.2 P9 I5.", "PS5457"),
        ("G53.1", "PS5458"),
        ("G68.2 J10.\nG43.4 H1", "PS5421"),
        ("G43.5 H1\nG0 X1. I0 J0 K0", "PS5459"),
    ],
)
def test_what_cannot_be_tilted_is_an_alarm(block: str, code: str) -> None:
    assert codes(run(block + "\nM30\n", machine="mill5-ac-table")) == [code]


def test_g69_leaves_the_machine_where_it_is() -> None:
    setup = {"tools": {1: {"length": 80}}}
    text = "G68.2 X5. Y1. Z2. I20. J30. K0\nG53.1\nG43 H1 G0 X1. Y2. Z3.\n"
    tilted = run(text + "M30\n", machine="mill5-ac-table", setup=setup).coordinates.machine
    ended = run(text + "G69\nM30\n", machine="mill5-ac-table", setup=setup).coordinates.machine
    assert ended == pytest.approx(tilted)
