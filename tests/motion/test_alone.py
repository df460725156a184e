"""Lines from rest to rest with averages of their own: a corner that slows nobody is passed."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from polycnc.motion.kernels.alone import alone_pull, alone_top, best_ramp, rest_to_rest


@given(st.floats(1e-4, 1e4), st.floats(0.1, 2e3), st.floats(1.0, 2e4), st.floats(10.0, 1e7))
def test_a_line_from_rest_to_rest_takes_longer_than_one_at_full_speed(
    way: float, top: float, pull: float, jerk: float
) -> None:
    ramp = best_ramp(way, top, pull, jerk)
    own = alone_pull(ramp, pull, jerk)
    assert ramp + rest_to_rest(way, 0.0, alone_top(way, top, own, ramp), own) > way / top
