"""Limits of jerk that hardly bind: a run takes no longer than with less jerk, and little longer than without any."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from polycnc.motion import Settings
from polycnc.toolpath.modes import AccelerationMode
from tests.motion.jerk_paths import jerk_paths
from tests.motion.paths import MILL

if TYPE_CHECKING:
    from polycnc.machine import Machine

SOFT = Settings(acceleration=AccelerationMode.JERK_LIMITED, bends_by_way=True)
BRISK = Settings(acceleration=AccelerationMode.CONSTANT)
#: Axes build their acceleration up in 6 ms and less: over so many there are none that take longer.
PULL, JERKS = 3000.0, (5e5, 3e6, 1.5e7)
NAMES = ("zigzag 20 mm, 90°, 0.1 mm", "square of 50 mm, 0.2 mm", "facets of a wave", "slot", "circle of 5 mm")


def with_jerk(jerk: float) -> Machine:
    """The mill with axes of so much jerk, mm/s³."""
    return replace(MILL, axes=tuple(replace(axis, acceleration=PULL, jerk=jerk) for axis in MILL.axes))


@pytest.mark.parametrize("name", NAMES)
def test_runs_whose_jerk_hardly_binds_take_little_longer_than_without_a_limit(name: str) -> None:
    path = next(path for path in jerk_paths() if path.name == name)
    times = [path.rows.plan(with_jerk(jerk), settings=SOFT).total_s for jerk in JERKS]
    least = path.rows.plan(with_jerk(JERKS[-1]), settings=BRISK).total_s
    assert times == sorted(times, reverse=True) or max(times) - min(times) < 0.01 * least
    assert times[-1] < 1.1 * least
