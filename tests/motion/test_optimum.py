"""Limited jerk against a discretised optimum with jerk limits, on thirty paths of different kind (`jerk_paths.py`)."""

from __future__ import annotations

import numpy as np
import pytest

from polycnc.motion import Settings
from polycnc.toolpath.modes import AccelerationMode
from tests.motion.jerk_paths import jerk_paths
from tests.motion.optimum import least_time
from tests.motion.paths import MILL

SOFT = Settings(acceleration=AccelerationMode.JERK_LIMITED, bends_by_way=True)
#: As controls do that average over time behind the interpolator (`bell-shaped`).
AVERAGED = Settings(acceleration=AccelerationMode.JERK_LIMITED)
#: The optimum is discretised, and finds up to this part too little.
COARSE = 0.97


@pytest.mark.parametrize(("settings", "median", "worst"), [(SOFT, 1.12, 1.27), (AVERAGED, 1.57, 2.42)])
def test_paths_with_limited_jerk_are_close_to_the_optimum(
    settings: Settings, median: float, worst: float
) -> None:
    """Times over the optimum: the median, and the worst path."""
    pytest.importorskip("scipy", reason="scipy, which solves the linear programmes, is not installed")
    ratios = {}
    for path in jerk_paths():
        least = least_time(np.array(path.points), path.tolerance, path.feed, MILL)
        ratios[path.name] = path.rows.plan(MILL, settings=settings).total_s / least
    assert len(ratios) == 30
    assert min(ratios.values()) >= COARSE, ratios
    assert float(np.median(list(ratios.values()))) <= median, ratios
    assert max(ratios.values()) <= worst, ratios


@pytest.mark.parametrize(("length", "feed"), [(100.0, 100.0), (10.0, 1000.0)])
def test_the_optimum_of_a_line_is_that_of_seven_phases(length: float, feed: float) -> None:
    pytest.importorskip("scipy", reason="scipy, which solves the linear programmes, is not installed")
    axis = MILL.axes[0]
    pull, jerk = axis.acceleration, axis.jerk
    exact = length / feed + feed / pull + pull / jerk
    if length < 100.0:  # too short for its acceleration
        exact = 4.0 * (length / (2.0 * jerk)) ** (1.0 / 3.0)
    line = np.array([[0.0, 0.0, 0.0], [length, 0.0, 0.0]])
    assert least_time(line, 0.01, feed, MILL) == pytest.approx(exact, rel=0.03)
