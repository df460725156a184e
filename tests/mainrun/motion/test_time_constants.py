"""Plan, samples and main run are one motion too where machine files give time constants."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from tests.mainrun.motion.random_programs import Threads, writer
from tests.mainrun.motion.test_one_motion import PLACES, executed, planned

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
#: Seeds of programs of the word-address controls.
SEEDS = range(24)


@pytest.mark.parametrize("seed", SEEDS)
def test_plan_samples_and_main_run_are_one_motion(tmp_path: Path, seed: int) -> None:
    written = writer(seed)
    file = tmp_path / "constants.toml"
    file.write_text(
        CONSTANTS.format(machine=written.machine, bell=0.05 * (seed % 2), after=0.064 * (seed % 3 > 0))
    )
    written.machine = str(file)
    text = written.program()
    total, end, samples, machine = planned(text, written)
    threads = isinstance(written, Threads)
    assert threads or end == pytest.approx(total, abs=1e-6)
    compared = 0 if threads else min(len(samples.time), PLACES)
    rotary = [machine.axis[name].rotary for name in machine.channels[0].axes]
    time = executed(text, written, samples.position[:compared], rotary)
    assert time == pytest.approx(total, abs=0.001)
    assert np.isfinite(samples.position).all()
