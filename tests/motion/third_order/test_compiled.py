"""Compiled and plain kernels bend alike."""

from __future__ import annotations

from copy import deepcopy

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.motion.third_order import bend as bending
from polycnc.motion.third_order import compiled, parts
from tests.motion.third_order.programmed_paths import Drawn, drawn_paths


@pytest.mark.skipif(compiled.LIBRARY.lack is not None, reason="no compiled kernels")
@settings(max_examples=20, deadline=None)
@given(drawn_paths(st.sampled_from((0.001, 0.1))))
def test_the_same_numbers(drawn: Drawn) -> None:
    path = drawn.path.path
    fast = bending.bend(deepcopy(path))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(parts, "kernels", compiled.plain)
        plain = bending.bend(deepcopy(path))
    for one, other in zip(fast, plain, strict=True):
        for name in ("way", "place", "first", "second", "cap2", "row"):
            assert np.array_equal(getattr(one, name), getattr(other, name)), name
