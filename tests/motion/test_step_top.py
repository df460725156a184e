"""The bound of a step of q'' is exact where it matters, and above what is asked where it is not worked out."""

from __future__ import annotations

from math import inf

from hypothesis import given
from hypothesis import strategies as st

from polycnc.motion.kernels.jerk import JERK_CURVE, step_top2


@given(
    st.floats(1.0, 1e7) | st.just(inf),
    st.floats(1e-4, 0.5),
    st.floats(2e-9, 10.0),
    st.floats(1e-4, 1e3) | st.just(inf),
    st.floats(0.0, 1e8) | st.just(inf),
)
def test_what_is_above_is_above_and_all_else_exact(
    j: float, blend: float, step: float, spacing: float, enough: float
) -> None:
    exact = min(0.3 * j * blend / step, (JERK_CURVE * j * spacing / step) ** (2.0 / 3.0))
    found = step_top2(j, blend, step, spacing, 0.3, enough)
    assert found == exact if exact <= enough else found > enough
