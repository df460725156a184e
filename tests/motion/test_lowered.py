"""A bound that is lowered without a division is what the division gives."""

from __future__ import annotations

from math import inf

from hypothesis import given
from hypothesis import strategies as st

from polycnc.motion.kernels.alone import (
    SLOWED,
    alone_pull,
    alone_top,
    best_ramp,
    is_slower_alone,
    rest_to_rest,
)
from polycnc.motion.kernels.columns import Limits, PathLimits, lowered, zeros
from polycnc.motion.kernels.jerk import MOST_TENTS, ROW_ACROSS, step_hold2

SIZES = st.floats(1e-9, 1e9)


@given(bound=SIZES | st.just(inf), part=SIZES | st.just(0.0), asked=SIZES)
def test_it_is_the_lesser_of_bound_and_quotient(bound: float, part: float, asked: float) -> None:
    assert lowered(bound, part, asked) == min(bound, part / asked)


@given(quotient=SIZES, asked=SIZES, off=st.floats(-3e-6, 3e-6))
def test_it_is_so_where_both_are_nearly_the_same(quotient: float, asked: float, off: float) -> None:
    bound, part = quotient * (1.0 + off), quotient * asked
    assert lowered(bound, part, asked) == min(bound, part / asked)


@given(a=SIZES, j=SIZES, blend=st.floats(1e-4, 1.0), step=SIZES, shorter=SIZES, x2=SIZES | st.just(inf))
def test_the_turn_at_a_joint_of_a_row_bounds_as_written(
    a: float, j: float, blend: float, step: float, shorter: float, x2: float
) -> None:
    jump, near = j * blend * blend / step, ROW_ACROSS * a * blend * blend / step
    expected = min(x2, jump * jump, near * min(near, shorter / MOST_TENTS) / (blend * blend))
    assert step_hold2(a, j, blend, step, shorter, x2) == (expected if step > 1e-9 else x2)


@given(
    way=st.floats(1e-6, 1e3), corner=st.floats(1e-3, 1e3), jerk=st.floats(1e2, 1e7), pull=st.floats(1.0, 1e5),
    top=st.floats(1e-2, 1e4),
)  # fmt: skip
def test_a_line_that_is_slower_alone_for_certain_is(
    way: float, corner: float, jerk: float, pull: float, top: float
) -> None:
    direction, rest = zeros(1), zeros(1)
    direction[0], rest[0] = 1.0, jerk
    limits = Limits(rest, rest, rest, rest, rest, rest, rest, rest, rest, [0, -1, -1], PathLimits(), zeros(0))
    ramp = best_ramp(way, top, pull, jerk)
    own = alone_pull(ramp, pull, jerk)
    alone = ramp + rest_to_rest(way, 0.0, alone_top(way, top, own, ramp), own)
    if is_slower_alone(1, limits, direction, way, corner):
        assert alone > (1.0 + SLOWED) * way / corner
    if alone < (1.0 + SLOWED) * way / corner:
        assert not is_slower_alone(1, limits, direction, way, corner)
