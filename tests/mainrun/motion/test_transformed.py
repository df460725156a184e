"""Real axes under a transformation."""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

import pytest

import polycnc
from polycnc.machine import parse_setup
from polycnc.mainrun import State
from tests.mainrun.support import power_on, recorded

if TYPE_CHECKING:
    from pathlib import Path

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


@pytest.mark.parametrize("acceleration", [300, 1000])
def test_the_main_run_goes_by_the_limits_by_which_rows_of_a_transformation_are_planned(
    tmp_path: Path, acceleration: int
) -> None:
    """The plane moves as the slowest linear axis can. X can do more: the main run took 0.33 s less than the plan."""
    machine = tmp_path / "slow.toml"
    machine.write_text(
        f'base = "lathe-c-transmit"\n[axis.Z]\nacceleration = {acceleration}\n'
        "[axis.C]\nacceleration = 20000\nmax_feed = 100000\n"
    )
    text = (
        "BRISK G641 ADIS=1 T1 D1\nG0 X60 Z5\nTRANSMIT\nG1 X40 Y0 F9000\nG3 X30 Y20 CR=14\nG2 X20 Y34 CR=20\n"
        "G1 X10 Y36\nX-10\nTRAFOOF\nG0 X80\nM30\n"
    )
    setup = {"tools": {1: {"length": 50}}}
    result = polycnc.run(text, control="sinumerik-840d", machine=str(machine), setup=setup)
    virtual = power_on(text, "sinumerik-840d", machine=str(machine), setup=parse_setup(setup))
    records, start = recorded(virtual), virtual.time
    virtual.cycle_start()
    assert virtual.run(limit_s=100.0) is State.READY
    ready = next(record.time for record in reversed(records) if record.what == "state")
    assert ready - start == pytest.approx(result.plan.total_s, abs=0.001)
