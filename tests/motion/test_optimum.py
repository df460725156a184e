"""Limited jerk against a discretised optimum with jerk limits, on thirty paths of different kind (`jerk_paths.py`)."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import polycnc
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
#: Cuts that are planned ahead: median and worst of the times over the optimum.
MEDIAN, WORST = 1.09, 1.19


@pytest.fixture(scope="module")
def optimum() -> dict[str, float]:
    """Least time of each path."""
    pytest.importorskip("scipy", reason="scipy, which solves the linear programmes, is not installed")
    return {p.name: least_time(np.array(p.points), p.tolerance, p.feed, MILL) for p in jerk_paths()}


def ratios(optimum: dict[str, float], settings: Settings, **context: Any) -> dict[str, float]:
    """Times over the optimum of the paths in a context."""
    return {
        p.name: p.rows.plan(MILL, settings=settings).total_s / optimum[p.name] for p in jerk_paths(**context)
    }


@pytest.mark.parametrize(("settings", "median", "worst"), [(SOFT, MEDIAN, WORST), (AVERAGED, 1.57, 2.42)])
def test_paths_with_limited_jerk_are_close_to_the_optimum(
    optimum: dict[str, float], settings: Settings, median: float, worst: float
) -> None:
    """The median, and the worst path."""
    found = ratios(optimum, settings)
    assert len(found) == 30
    assert min(found.values()) >= COARSE, found
    assert float(np.median(list(found.values()))) <= median, found
    assert max(found.values()) <= worst, found


@pytest.mark.parametrize(
    ("control", "code"),
    [
        ("syntec-mill", ""),
        ("fanuc-m", "G05.1 Q1"),
        ("fanuc-m", "G08 P1"),
        ("meldas-m", "G05 P2"),
        ("meldas-m", "G61.1"),
    ],
)
def test_so_they_are_on_controls_that_plan_ahead(optimum: dict[str, float], control: str, code: str) -> None:
    result = polycnc.run(f"O1\n{code}\nG1 X1. F100.\nM30\n", control=control, machine="mill3")
    acceleration = result.toolpath.contexts[0].acceleration
    found = ratios(optimum, result.lead["settings"], acceleration=acceleration)
    assert float(np.median(list(found.values()))) <= MEDIAN, found
    assert max(found.values()) <= WORST, found


def test_a_law_takes_no_longer_than_averages() -> None:
    for averaged, led in zip(jerk_paths(), jerk_paths(), strict=True):
        least = averaged.rows.plan(MILL, settings=AVERAGED).total_s
        assert led.rows.plan(MILL, settings=SOFT).total_s <= 1.001 * least, led.name


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
