"""The axes behind the interpolator."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.mainrun.motion.follower import Law
from polycnc.mainrun.motion.speed import Phase, ramp
from polycnc.motion.sampling.run import TimeLaw

ways = st.floats(0.1, 20.0)
speeds = st.floats(1.0, 100.0)


def phases_of(stations: list[tuple[float, float]]) -> list[Phase]:
    """Phases from rest to rest, over ways to squared speeds."""
    start2, found = 0.0, list[Phase]()
    for way, speed in stations:
        found.append(ramp(way, start2, speed * speed))
        start2 = speed * speed
    return [*found, ramp(5.0, start2, 0.0)]


@given(st.lists(st.tuples(ways, speeds), min_size=1, max_size=6), st.floats(0.001, 0.5))
def test_the_axes_follow_moment_by_moment_where_samples_have_them(
    stations: list[tuple[float, float]], window: float
) -> None:
    phases = phases_of(stations)
    law = Law(0.0, 0.0)
    law.run(0.0, 0.0, phases)
    whole = TimeLaw(
        *(np.array([getattr(phase, name) for phase in phases]) for name in ("seconds", "speed", "pull"))
    )
    times = np.linspace(0.0, whole.seconds + window, 50)
    way, speed, _ = whole.averaged(times - 0.5 * window, window)
    assert [law.mean(time, window) for time in times] == pytest.approx(way, abs=1e-9)
    assert [law.mean_speed(time, window) for time in times] == pytest.approx(speed, abs=1e-6)


def test_what_is_forgotten_changes_no_average() -> None:
    phases = phases_of([(3.0, 20.0), (1.0, 5.0), (9.0, 40.0)])
    kept, forgetful = Law(0.0, 0.0), Law(0.0, 0.0)
    for law in (kept, forgetful):
        law.run(0.0, 0.0, phases)
    forgetful.forget(0.6)
    assert forgetful.phases < kept.phases
    for time in np.linspace(0.7, 2.0, 20):
        assert forgetful.mean(time, 0.1) == pytest.approx(kept.mean(time, 0.1), abs=1e-12)
