"""The class of bent paths, on the simple ones."""

from __future__ import annotations

import numpy as np
import pytest

from tests.motion.jerk_paths import JerkPath, jerk_paths
from tests.motion.paths import MILL
from tests.motion.third_order.even_path import even_path


@pytest.mark.parametrize("path", jerk_paths()[2:13], ids=lambda path: path.name)
def test_pieces_go_over_into_each_other(path: JerkPath) -> None:
    bent = even_path(np.array(path.points), path.tolerance, path.feed, MILL)
    ends = bent.way[1:-1]
    for values, before in zip(
        (bent.place, bent.first, bent.second), bent.at(ends * (1.0 - 1e-14)), strict=True
    ):
        assert np.abs(values[1:-1] - before).max() < 1e-7
    assert np.abs(bent.place[-1] - path.points[-1]).max() < 1e-9
    assert bent.axes == 3


def test_derivatives_are_those_of_the_positions() -> None:
    path = jerk_paths()[3]
    bent = even_path(np.array(path.points), path.tolerance, path.feed, MILL)
    ways, step = 0.5 * (bent.way[1:] + bent.way[:-1]), 1e-5
    _, first, second = bent.at(ways)
    before, after = bent.at(ways - step), bent.at(ways + step)
    for values, low, high in ((first, before[0], after[0]), (second, before[1], after[1])):
        assert np.abs((high - low) / (2.0 * step) - values).max() < 1e-6
    assert np.abs((after[2] - before[2]) / (2.0 * step) - bent.third).max() < 1e-6
