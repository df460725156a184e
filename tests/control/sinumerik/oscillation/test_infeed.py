"""Partial infeeds add up to the whole way."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.control.sinumerik.oscillation.infeed import PartialInfeeds


def parts(way: float, partial: float, mode: int) -> list[float]:
    made = PartialInfeeds(0.0, way, partial, mode)
    places = [0.0, *(made.after(part) for part in range(1, made.count + 1))]
    return [after - before for before, after in pairwise(places)]


def test_all_parts_are_equal_in_mode_1() -> None:
    assert parts(5.0, 1.5, 1) == pytest.approx([1.25] * 4)


def test_the_last_two_share_what_is_left_in_mode_0() -> None:
    assert parts(-10.0, 4.0, 0) == pytest.approx([-4.0, -3.0, -3.0])


def test_a_way_of_nothing_has_no_parts() -> None:
    assert parts(0.0, 1.0, 0) == []


@pytest.mark.parametrize("mode", [0, 1])
def test_one_part_suffices_for_a_short_way(mode: int) -> None:
    assert parts(0.4, 1.0, mode) == pytest.approx([0.4])


@given(st.floats(-100.0, 100.0), st.floats(0.5, 30.0), st.sampled_from((0, 1)))
def test_no_part_is_longer_than_told_and_all_lead_to_the_end(way: float, partial: float, mode: int) -> None:
    made = parts(way, partial, mode)
    assert sum(made) == pytest.approx(way if made else 0.0, abs=1e-6)
    assert all(abs(part) <= partial + 1e-6 for part in made)


def test_a_way_in_very_many_parts_is_no_list() -> None:
    assert PartialInfeeds(10.0, 2e9, 1.0, 0).after(3) == 13.0
