"""The kernel of compensation as machine code gives what it gives as it is written."""

from __future__ import annotations

from array import array
from copy import deepcopy
from math import cos, sin
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.compensation.runs import kernels
from polycnc.compensation.runs.compiled import LIBRARY, lead
from polycnc.compensation.runs.kernels import Offset


def test_there_is_always_a_kernel() -> None:
    assert lead() is (LIBRARY.compiled("lead") or kernels.lead)


@pytest.mark.skipif(LIBRARY.lack is not None, reason="needs compiled kernels")
@settings(max_examples=200, deadline=None)
@given(
    st.lists(st.floats(-0.4, 0.4), min_size=4, max_size=60),
    st.sampled_from((0.1, -1.0, 4.0)),
    st.integers(2, 5),
    st.sampled_from((0.0, 20.0, 90.0)),
)
def test_both_give_the_same(turns: list[float], distance: float, window: int, outer_deg: float) -> None:
    angle = u = v = 0.0
    ends = array("d")
    for turn in turns:
        angle += turn
        u, v = u + 3.0 * cos(angle), v + 3.0 * sin(angle)
        ends.extend((u, 0.5, v))
    count = len(turns)
    at = Offset(3, 0, 2, min(window, count), distance, 0.1, 0.0, -1.0, 0.0, 0.0, distance, outer_deg, True)
    given: tuple[Any, ...] = (
        at, array("B", (kernels.STRAIGHT,)) * count, ends, array("d", bytes(24 * count)),
        array("d", (0.0, distance)) * count, array("d", ends),
    )  # fmt: skip
    other = (given[0], *deepcopy(given[1:]))
    assert kernels.lead(*given) == lead()(*other)
    assert [bytes(array) for array in given[1:]] == [bytes(array) for array in other[1:]]
