"""Rapids against the time-optimal motion of an independent generator, with limited jerk.

ruckig (L. Berscheid and T. Kröger, "Jerk-limited Real-time Trajectory Generation with Arbitrary Target States", RSS
2021) gives the least time of one axis from rest to rest. A rapid that is a line is such an axis with what its slowest
one allows along the path; where every axis runs alone, the slowest of them counts.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.motion import Settings
from polycnc.toolpath.modes import AccelerationMode
from tests.examples import examples
from tests.motion.paths import MILL, Build
from tests.motion.test_limits import UNEVEN

if TYPE_CHECKING:
    from polycnc.machine import Machine

ruckig = pytest.importorskip("ruckig", reason="ruckig, the reference for rapids, is not installed")
#: Largest part by which a rapid may take longer than the optimum, and rounding below it.
WORST, ROUNDING = 1.03, 1e-9
way = st.one_of(st.just(0.0), st.floats(-0.5, 0.5), st.floats(-20.0, 20.0), st.floats(-500.0, 500.0)).map(
    lambda mm: round(mm, 3)
)
ways = st.tuples(way, way, way).filter(any)
machines = st.sampled_from([MILL, UNEVEN])


def least_s(length: float, velocity: float, acceleration: float, jerk: float) -> float:
    """Least time of one axis from rest to rest."""
    asked, found = ruckig.InputParameter(1), ruckig.Trajectory(1)
    asked.target_position = [length]
    asked.max_velocity, asked.max_acceleration, asked.max_jerk = [velocity], [acceleration], [jerk]
    ruckig.Ruckig(1).calculate(asked, found)
    return float(found.duration)


def planned_s(end: tuple[float, float, float], machine: Machine, *, by_axis: bool) -> float:
    lead = Settings(acceleration=AccelerationMode.JERK_LIMITED, rapid_by_axis=by_axis)
    return Build().rapid(*end).plan(machine, settings=lead).total_s


@settings(max_examples=examples(200))
@given(ways, machines)
def test_a_rapid_on_a_line_takes_the_least_time(end: tuple[float, float, float], machine: Machine) -> None:
    length = hypot(*end)
    limits = [
        min(limit * length / abs(way) for limit, way in zip(own, end, strict=True) if way)
        for own in zip(*((axis.rapid, axis.acceleration, axis.jerk) for axis in machine.axes), strict=True)
    ]
    least = least_s(length, *limits)
    assert least * (1.0 - ROUNDING) <= planned_s(end, machine, by_axis=False) <= WORST * least


@settings(max_examples=examples(200))
@given(ways, machines)
def test_a_rapid_of_axes_alone_takes_as_long_as_the_slowest(
    end: tuple[float, float, float], machine: Machine
) -> None:
    least = max(
        least_s(abs(way), axis.rapid, axis.acceleration, axis.jerk)
        for axis, way in zip(machine.axes, end, strict=True)
        if way
    )
    assert least * (1.0 - ROUNDING) <= planned_s(end, machine, by_axis=True) <= WORST * least
