"""The planner against the time-optimal bound of an independent solver.

The bound knows the path as it is programmed, and the speeds at which the plan passes its joints. It does not know that
rounded corners are bent, which takes of the axes' acceleration: there it is lower than any plan can be.
"""

from __future__ import annotations

import warnings

import pytest
from benchmarks.planner import WORST_RATIO, planned, reference
from benchmarks.planner_paths import paths

PATHS = {path.name: path for path in paths()}
#: Times over the bound of paths that are not within WORST_RATIO of it: rounded corners, and splines.
OVER = {"facets, rounded": 1.205, "spline": 1.075, "wave as spline": 1.082}


@pytest.mark.parametrize("name", PATHS)
def test_the_cycle_time_is_close_to_the_time_optimal_bound(name: str) -> None:
    pytest.importorskip("toppra", reason="toppra, the reference for time-optimal plans, is not installed")
    path = PATHS[name]
    seconds, entries = planned(path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        bound = reference(path, entries)
    # The reference interpolates between its own grid points: it may be a little above the true bound.
    assert 0.995 * bound <= seconds <= OVER.get(name, WORST_RATIO) * bound
