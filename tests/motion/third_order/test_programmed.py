"""Rows become stretches."""

from __future__ import annotations

from array import array
from math import pi

import numpy as np
import pytest

from polycnc.motion.third_order.bends.stretches import put_place
from tests.motion.third_order.programmed import Bounds, ProgrammedPath


def test_a_spiral_with_rise_and_a_rotary_axis() -> None:
    path = ProgrammedPath([5.0, 0.0, 0.0, 10.0], [250.0] * 4, (False, False, False, True))
    path.arc([7.0, 0.0, 3.0, 40.0], (0.0, 0.0, 0.0), (0.0, 0.0, 2.0), 2.0 * pi, 4, Bounds(0.01, 50.0))
    stretches = path.path
    share = np.linspace(0.0, 1.0, 200_001)
    radius, angle = 5.0 + 2.0 * share, 2.0 * pi * share
    true = np.stack([radius * np.cos(angle), radius * np.sin(angle), 3.0 * share], axis=1)
    length = np.sqrt((np.diff(true, axis=0) ** 2).sum(1)).sum()
    assert stretches.way[-1] == pytest.approx(length, rel=1e-6)

    out = array("d", bytes(32))
    for e in range(len(stretches.form)):
        put_place(stretches, e, 0.5 * (stretches.way[e] + stretches.way[e + 1]), 4, out, 0)
        assert np.sqrt(((true - np.array(out[:3])) ** 2).sum(1)).min() < 0.02 * 0.01
    assert path.position == [7.0, 0.0, 3.0, 40.0]
    assert set(stretches.row) == {4}


def test_the_way_is_that_of_the_linear_axes() -> None:
    path = ProgrammedPath([0.0, 0.0, 0.0, 0.0], [250.0] * 4, (False, False, False, True))
    path.line([3.0, 4.0, 0.0, 100.0], 0, Bounds(0.01))
    path.line([3.0, 4.0, 0.0, 130.0], 1, Bounds(0.01))
    path.line([3.0, 4.0, 0.0, 130.0], 2, Bounds(0.01))
    assert list(path.path.way) == [0.0, 5.0, 35.0]
    assert list(path.path.row) == [0, 1]
