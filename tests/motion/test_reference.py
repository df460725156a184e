"""The planner against the time-optimal bound of an independent solver.

The bound knows the path that is driven, with the bends of rounded corners, and the speeds at which the plan passes
joints that are none.
"""

from __future__ import annotations

import warnings

import pytest
from benchmarks.planner import WORST_RATIO, planned, reference
from benchmarks.planner_paths import paths

PATHS = {path.name: path for path in paths()}


@pytest.mark.parametrize("name", PATHS)
def test_the_cycle_time_is_close_to_the_time_optimal_bound(name: str) -> None:
    pytest.importorskip("toppra", reason="toppra, the reference for time-optimal plans, is not installed")
    path = PATHS[name]
    driven = planned(path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        bound = reference(path, driven)
    # The reference interpolates between its own grid points: it may be a little above the true bound.
    assert 0.994 * bound <= driven.seconds <= WORST_RATIO * bound
