"""Plan, samples and main run take the same time where spindles run up and a magazine turns beside the axes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.machine import parse_setup
from polycnc.mainrun import State
from polycnc.session import open_session
from tests.mainrun.support import power_on, recorded

if TYPE_CHECKING:
    from pathlib import Path

MACHINE = """base = "mill3"
[magazine]
places = 24
place_time_s = 0.4
change_time_s = 2
pockets = "{pockets}"
[spindle.1]
speed_wait = "{wait}"
acceleration = 2000
"""
PROGRAM = """O1
G90 G54 {mode} T9
M3 S3000
G0 X100. Y20.
Z5.
G1 Z-2. F600
X150. F1500
G0 Z50.
M5
T5 M6
M3 S6000
T9
G0 X0 Y0
G0 Z5.
G1 Z-3. F800
S1000
G2 X20. Y0 I10. F2000
G4 P500
S5000
G1 X30. M8
M19
M6
G0 Z50.
M30
"""
SIEMENS = """G90 G54 G64 T9
M3 S3000
G0 X100 Y20
Z5
G1 Z-2 F600
X150 F1500
G0 Z50
M5
T5 M6
M3 S6000
T9
G0 X0 Y0
G0 Z5
G1 Z-3 F800
S1000
G2 X20 Y0 I10 J0 F2000
G4 F0.5
S5000
G1 X30
M6
G0 Z50
M30
"""
TOOLS = {"tools": {tool: {"length": 50.0} for tool in (1, 5, 9)}, "spindle_tool": 1}
PROGRAMS = {
    "fanuc-m": PROGRAM.format(mode="G64"),
    "meldas-m": PROGRAM.format(mode="G64"),
    "syntec-mill": PROGRAM.format(mode="G64"),
    "sinumerik-840d": SIEMENS,
}


def planned(text: str, control: str, machine: str) -> tuple[float, float, float]:
    """Total, its share that the spindle and the tool changes take, and the end of the samples."""
    session = open_session(text.encode(), control=control, machine=machine, setup=TOOLS, keep=False)
    sampler = session.sample(0.01, lambda _: None)
    result = session.run()
    assert result.ok, result.alarms
    times = result.plan.times
    sampler.close()
    return times.total_s, times.spindle_s + times.tool_change_s, sampler.time


def executed(text: str, control: str, machine: str) -> float:
    virtual = power_on(text, control, machine=machine, setup=parse_setup(TOOLS))
    records = recorded(virtual)
    start = virtual.time
    virtual.cycle_start()
    virtual.run(limit_s=10_000.0)
    assert virtual.state is State.READY
    return next(record.time for record in reversed(records) if record.what == "state") - start


@pytest.mark.parametrize("control", PROGRAMS)
def test_plan_samples_and_main_run_wait_alike(tmp_path: Path, control: str) -> None:
    waited = set()
    for wait in ("block", "cut", "never"):
        for pockets in ("random", "fixed"):
            file = tmp_path / f"{wait}-{pockets}.toml"
            file.write_text(MACHINE.format(wait=wait, pockets=pockets))
            total, standing, end = planned(PROGRAMS[control], control, str(file))
            assert end == pytest.approx(total, abs=1e-6), (wait, pockets)
            assert executed(PROGRAMS[control], control, str(file)) == pytest.approx(total, abs=0.001), (
                wait,
                pockets,
            )
            waited.add(round(standing, 3))
    assert len(waited) == 6


@pytest.mark.parametrize(("feed", "waits"), [(2000, True), (200, False)])
def test_so_they_do_for_a_spindle_that_turns_to_an_angle(tmp_path: Path, feed: int, waits: bool) -> None:
    """G96.3 waits for what is left of the way that G96.2 has begun; G96.1 begins a new one."""
    file = tmp_path / "slow.toml"
    file.write_text('base = "lathe2"\n[spindle.1]\norient_s = 1\n')
    cut = f"G1 X80. F{feed}\n"
    beside = f"O1\nG98 G0 X100. Z10.\nG96.2 P1 R90.\n{cut}G96.3 P1\nG1 X70.\nM30\n"
    total, standing, end = planned(beside, "fanuc-0i-tf", str(file))
    assert end == pytest.approx(total, abs=1e-6)
    assert executed(beside, "fanuc-0i-tf", str(file)) == pytest.approx(total, abs=0.001)
    assert 0.0 < standing < 0.8 if waits else standing == 0.0
    again = beside.replace("G96.3 P1", "G96.1 P1 R0")
    total, standing, _ = planned(again, "fanuc-0i-tf", str(file))
    assert standing == pytest.approx(1.0)
    assert executed(again, "fanuc-0i-tf", str(file)) == pytest.approx(total, abs=0.001)


#: Cuts at constant surface speed with rapids between them to other radii.
TURNED = {
    "fanuc-0i-tf": "O1\nG99 G97 S300 M3\nG0 X120. Z5.\nG96 S180\nG1 Z-10. F0.2\nG0 X20.\nZ2.\nG1 Z-5.\nX40.\n"
    "G0 X100. Z-20.\nG0 X60.\nG1 X30.\nG0 X25.\nG97 S500\nG0 X50.\nG1 Z-30.\nM30\n",
    "sinumerik-840d": "G95 S300 M3 F0.2\nG0 X120 Z5\nG96 S180\nG1 Z-10\nG0 X20\nZ2\nG1 Z-5\nX40\n"
    "G0 X100 Z-20\nG0 X60\nG1 X30\nG0 X25\nG97 S500\nG0 X50\nG1 Z-30\nM30\n",
}


@pytest.mark.parametrize("control", TURNED)
def test_so_they_do_where_the_spindle_runs_up_beside_rapids_at_constant_surface_speed(
    tmp_path: Path, control: str
) -> None:
    found = {}
    for wait in ("block", "cut", "never"):
        file = tmp_path / f"{wait}.toml"
        file.write_text(f'base = "lathe2"\n[spindle.1]\nspeed_wait = "{wait}"\nacceleration = 1000\n')
        total, standing, end = planned(TURNED[control], control, str(file))
        assert end == pytest.approx(total, abs=1e-6), wait
        assert executed(TURNED[control], control, str(file)) == pytest.approx(total, abs=0.001), wait
        found[wait] = standing
    assert found["cut"] > found["never"] + 1.0
