"""Partial infeeds add up to the whole way."""

from __future__ import annotations

import pytest

from polycnc.control.sinumerik.oscillation.infeed import parts


def test_all_parts_are_equal_in_mode_1() -> None:
    assert parts(5.0, 1.5, 1) == pytest.approx([1.25] * 4)


def test_the_last_two_share_what_is_left_in_mode_0() -> None:
    assert parts(-10.0, 4.0, 0) == pytest.approx([-4.0, -3.0, -3.0])


def test_a_way_of_nothing_has_no_parts() -> None:
    assert parts(0.0, 1.0, 0) == []


@pytest.mark.parametrize("mode", [0, 1])
def test_one_part_suffices_for_a_short_way(mode: int) -> None:
    assert parts(0.4, 1.0, mode) == pytest.approx([0.4])
