"""Seams: parts that are bent apart from each other go over into each other, within the tolerance."""

from __future__ import annotations

from copy import deepcopy

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.motion.third_order.bend import as_path, legs
from polycnc.motion.third_order.bends.seams import BESIDES, KNOWN, SIDE
from polycnc.motion.third_order.compiled import kernels
from polycnc.motion.third_order.parts import (
    Seam,
    bend_between,
    cut_out,
    known_from,
    known_to,
    numbers,
    spline_for,
    turning_for,
    whole,
)
from tests.motion.third_order.long_runs import joined
from tests.motion.third_order.programmed import Bounds
from tests.motion.third_order.programmed_paths import Drawn, drawn_paths, parts_of_leg

#: Stretches that are looked at before and behind those on which a seam may lie.
AROUND = 8


@settings(max_examples=60, deadline=None)
@given(drawn_paths(st.sampled_from((0.001, 0.01, 0.1))), st.floats(0.0, 1.0))
def test_parts_of_random_paths_go_over_into_each_other(drawn: Drawn, share: float) -> None:
    path = max(legs(drawn.path.path), key=lambda leg: len(leg.form))
    count, n = len(path.form), len(path.rotary)
    if count < 3 * AROUND:
        return
    low = AROUND + int(share * (count - 3 * AROUND))
    found, around = numbers(2), deepcopy(path)
    assert kernels().find_seam(
        around, low, low + AROUND, whole(count + 1), turning_for(count), spline_for(2 * SIDE + 5, n), found
    )
    seam = Seam(*found)
    assert path.way[low] < seam.way < path.way[low + AROUND]
    before = as_path(bend_between(deepcopy(path), None, seam))
    behind = as_path(bend_between(deepcopy(path), seam, None))
    assert before.way[-1] + behind.way[-1] == pytest.approx(path.way[-1])
    for name in ("place", "first", "second"):
        one, other = getattr(before, name)[-1], getattr(behind, name)[0]
        assert np.abs(one - other).max() <= 1e-7 * (1.0 + np.abs(one).max()), name
    # there are even knots beside the seam, and between them where the speed changes
    even = seam.apart * np.arange(SIDE + 1)
    for ways in (before.way[-1] - before.way, behind.way):
        assert np.abs(ways[:, None] - even).min(0).max() <= 1e-6 * seam.apart
    # what is bent from rest to the seam and on is within the tolerance
    first = deepcopy(path)
    both = joined(before, behind)
    assert max(parts_of_leg(first, both, 8)) <= 1.0 + 1e-6
    assert both.rows.tolist() == list(dict.fromkeys(path.row))


def test_a_part_needs_no_more_of_the_path_than_it_says() -> None:
    drawn = Drawn()
    drawn.facets(20.0, 3.0, 300, Bounds(0.01))
    path = drawn.path.path
    seam = Seam(0.5 * (path.way[150] + path.way[151]), 0.8)
    first, end = known_from(path, seam), known_to(path, seam)
    assert path.way[first + BESIDES] <= seam.way - KNOWN * seam.apart
    assert path.way[end - BESIDES] >= seam.way + KNOWN * seam.apart
    for head, tail, part in (
        (None, seam, cut_out(path, 0, end, 0.0)),
        (seam, None, cut_out(path, first, len(path.form), 0.0)),
    ):
        assert bend_between(deepcopy(path), head, tail) == bend_between(part, head, tail)


def test_seams_do_not_overlap() -> None:
    drawn = Drawn()
    drawn.facets(20.0, 3.0, 300, Bounds(0.01))
    path = drawn.path.path
    with pytest.raises(ValueError, match="too near"):
        bend_between(path, Seam(20.0, 0.8), Seam(24.0, 0.8))
