"""How many parts a way has, and that no cycle makes more than a program can mean."""

from __future__ import annotations

from math import inf

import pytest

from polycnc.cycles.count import MOST_PARTS, checked, parts
from polycnc.messages import AlarmError


def test_a_way_has_as_few_parts_as_its_largest_one_allows() -> None:
    assert [parts(10.0, 4.0), parts(8.0, 4.0), parts(8.001, 4.0), parts(8.001, 4.0, 0.01)] == [3, 2, 3, 2]


def test_more_parts_than_a_program_can_mean_are_an_alarm() -> None:
    assert checked(MOST_PARTS) == MOST_PARTS
    with pytest.raises(AlarmError, match="PC0002"):
        parts(100.0, 1e-7)


@pytest.mark.parametrize("most", [0.0, 1e-320])
def test_a_number_without_a_value_is_no_number_of_parts(most: float) -> None:
    with pytest.raises(ArithmeticError):
        parts(inf if most else 1.0, most)
