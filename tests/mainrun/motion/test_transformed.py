"""Real axes under a transformation."""

from __future__ import annotations

from math import hypot

import pytest

import polycnc
from polycnc.machine import parse_setup
from polycnc.mainrun import State
from tests.mainrun.support import power_on

POLAR = "O1\nG98 G0 X60. Z5. C0\nG12.1\nG1 X30. F600\nC15.\nX-30.\nG13.1\nG0 X80.\nM30\n"


def test_polar_interpolation_moves_the_real_axes() -> None:
    virtual = power_on(POLAR, "fanuc-0i-tf", machine="lathe-c-transmit")
    final = polycnc.run(POLAR, control="fanuc-0i-tf", machine="lathe-c-transmit").final
    x, c = (virtual.channel.axis_index[name] for name in "XC")
    virtual.cycle_start()
    before = virtual.machine_position
    while virtual.state is State.RUNNING:
        virtual.step()
        now = virtual.machine_position
        assert max(abs(a - b) for a, b in zip(now, before, strict=True)) < 5.0, "no axis jumps"
        if virtual.active_block.line == 6:
            assert 15.0 - 1e-9 <= now[x] <= hypot(30.0, 15.0) + 1e-9
            assert now[c] > 0.0
        before = now
    assert virtual.state is State.READY
    assert virtual.positions.machine == pytest.approx(final["machine"])


def test_reset_under_polar_interpolation_leaves_the_axes_where_they_are() -> None:
    virtual = power_on(POLAR, "fanuc-0i-tf", machine="lathe-c-transmit")
    virtual.cycle_start()
    assert virtual.run_until(lambda control: control.active_block.line == 6, limit_s=100.0)
    virtual.step(0.2)
    virtual.feed_hold()
    virtual.run()
    here = virtual.machine_position
    virtual.reset()
    assert virtual.machine_position == pytest.approx(here)
    assert virtual.positions.work["C"] == pytest.approx(virtual.positions.machine["C"])


@pytest.mark.parametrize("length", [4.0, -4.0])
def test_no_axis_jumps_where_a_tool_along_the_infeed_comes_through_the_centre(length: float) -> None:
    text = "T1 D1 F1000\nG0 X20\nTRANSMIT\nG1 X5 Y0\nX0\nX-5\nX0\nX0 Y-5\nX0 Y0\nX5\nM30\n"
    setup = {"tools": {1: {"type": 120, "x": length}}}
    virtual = power_on(text, "sinumerik-840d", machine="lathe-c-transmit", setup=setup)
    virtual.cycle_start()
    before = virtual.machine_position
    while virtual.state is State.RUNNING:
        virtual.step()
        now = virtual.machine_position
        ways = [abs(a - b) for a, b in zip(now, before, strict=True)]
        ways[2] = abs((now[2] - before[2] + 180.0) % 360.0 - 180.0)
        assert max(ways) < 3.0
        before = now
    assert virtual.state is State.READY


@pytest.mark.parametrize("call", ["TRANSMIT", "TRACYL(40)"])
def test_a_real_axis_beside_the_transformation_goes_along_the_next_block(call: str) -> None:
    text = f"T1 D1 F1000\nG0 X25 Y5 Z0 CC=0\n{call}\nG1 X25 Y0 Z-5\nT2 D1\nX20 Y0\nM30\n"
    setup = {"tools": {1: {"type": 120, "y": 2}, 2: {"type": 120, "y": -1}}}
    virtual = power_on(text, "sinumerik-840d", machine="lathe-c-transmit-y", setup=parse_setup(setup))
    virtual.cycle_start()
    assert virtual.run_until(lambda control: control.active_block.line == 4, limit_s=100.0)
    before = virtual.machine_position
    while virtual.state is State.RUNNING:
        virtual.step()
        now = virtual.machine_position
        assert abs(now[1] - before[1]) < 1.0, "the Y axis does not jump"
        before = now
    assert virtual.state is State.READY
    assert before[1] == pytest.approx(-1.0)
