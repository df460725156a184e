"""Plan, samples and main run are one motion too where machine files give time constants."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING

import numpy as np
import pytest

from polycnc.machine.setup.file import parse_setup
from polycnc.mainrun import State
from tests.examples import examples
from tests.mainrun.motion.random_programs import Writer, writer
from tests.mainrun.motion.test_disturbed import disturb, joints_of, play
from tests.mainrun.motion.test_one_motion import PLACES, executed, planned
from tests.mainrun.support import power_on

if TYPE_CHECKING:
    from pathlib import Path

CONSTANTS = """base = "{machine}"
[defaults.linear]
rapid_time_s = 0.1
rapid_bell_s = {bell}
cutting_time_s = 0.15
cutting_bell_s = 0.04
after_interpolation_s = {after}
[defaults.rotary]
rapid_time_s = 0.2
"""
T = 0.064
CUTS = "O1\nG1 X20. F6000\nG2 X30. Y10. R10.\nG1 Y14.\nX-10. Y14.\nX-10. Y0\nM30\n"
#: Seeds of programs of the word-address controls.
SEEDS = range(24)


@pytest.mark.parametrize("seed", SEEDS[: examples(len(SEEDS))])
def test_plan_samples_and_main_run_are_one_motion(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    written = writer(seed)
    file = tmp_path / "constants.toml"
    file.write_text(
        CONSTANTS.format(machine=written.machine, bell=0.05 * (seed % 2), after=0.064 * (seed % 3 > 0))
    )
    monkeypatch.setattr(type(written), "machine", str(file))
    text = written.program()
    total, end, samples, machine = planned(text, written)
    assert end == pytest.approx(total, abs=1e-6)
    rotary = [machine.axis[name].rotary for name in machine.channels[0].axes]
    time = executed(text, written, samples.position[:PLACES], rotary)
    assert time == pytest.approx(total, abs=0.001)
    assert np.isfinite(samples.position).all()


def test_scripts_of_an_operator_lead_to_the_same_end_along_the_same_rows(tmp_path: Path) -> None:
    file = tmp_path / "constants.toml"
    file.write_text(CONSTANTS.format(machine="mill3", bell=0.03, after=T))

    def run(seed: int | None) -> tuple[list[tuple[float, ...]], list[float]]:
        virtual = power_on(machine=str(file))
        joints = joints_of(virtual)
        if seed is None:
            virtual.cycle_start()
            virtual.run()
        else:
            for _ in play(virtual, Random(seed), 12):
                pass
        return joints, virtual.machine_position

    path, end = run(None)
    for seed in range(examples(100)):
        assert run(seed) == (path, end), seed


def test_whatever_an_operator_does_a_cut_takes_its_time_constant_to_change_its_speed(tmp_path: Path) -> None:
    file = tmp_path / "constants.toml"
    file.write_text(CONSTANTS.format(machine="mill3", bell=0.03, after=T))
    feed, step = 6000.0 / 60.0, 0.004
    for seed in range(examples(20)):
        virtual = power_on(CUTS, machine=str(file))
        random = Random(seed)
        places = [virtual.machine_position]
        virtual.cycle_start()
        for _ in range(4000):
            if random.random() < 0.05:
                disturb(virtual, random)
            virtual.step(step)
            places.append(virtual.machine_position)
            if virtual.state is State.READY:
                break
        velocity = np.diff(np.array(places), axis=0) / step
        # Turned round, a speed changes by twice itself; the feed override is 200 % at most.
        most = 2.0 * 2.0 * feed / (0.5 * T)
        assert np.abs(np.diff(velocity, axis=0)).max() / step <= most * 1.01, seed


AHEAD = {
    "fanuc-m": {"1660": 2000, "1772": 40, "1769": 30, "1783": 300, "1737": 500, "1735": 400, "1732": 300},
    "syntec-mill": {"406": 300, "408": 1200},
}


@pytest.mark.parametrize("seed", range(9))
def test_what_parameters_bound_ahead_is_one_motion_too(monkeypatch: pytest.MonkeyPatch, seed: int) -> None:
    control = ("fanuc-m", "fanuc-m", "syntec-mill")[seed % 3]
    written = Writer(Random(seed), control)
    head, _, rest = written.program().partition("\n")
    text = f"{head}\nG05 P10000\n{rest}" if control == "fanuc-m" else f"{head}\n{rest}"
    monkeypatch.setattr(Writer, "setup", {**Writer.setup, "parameters": AHEAD[control]})
    total, end, samples, machine = planned(text, written)
    assert end == pytest.approx(total, abs=1e-6)
    rotary = [machine.axis[name].rotary for name in machine.channels[0].axes]
    assert executed(text, written, samples.position[:PLACES], rotary) == pytest.approx(total, abs=0.001)


def test_no_script_makes_an_axis_exceed_its_jerk_before_a_time_constant_behind() -> None:
    cycle, pull, bell = 0.004, 2000.0, 0.04
    text = "O1\nG05 P10000\nG90 G1 X40. F6000\nX40. Y30.\nX10. Y10.\nG05 P0\nM30\n"
    setup = parse_setup({"parameters": {"1660": pull, "1772": 1000.0 * bell, "1769": 30}})
    for seed in range(4):
        virtual, random = power_on(text, setup=setup), Random(seed)
        places = [virtual.machine_position]
        virtual.cycle_start()
        for _ in range(1500):
            if random.random() < 0.05:
                disturb(virtual, random)
            virtual.step()
            places.append(virtual.machine_position)
            if virtual.state is State.READY:
                break
        assert np.abs(np.diff(np.array(places), 3, axis=0)).max() / cycle**3 <= pull / bell * 1.001, seed
