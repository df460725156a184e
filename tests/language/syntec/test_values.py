from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.language.syntec.values import VACANT, Text, bit_not, divide, modulo, storable, to_long, whole
from polycnc.messages import AlarmError

LONGS = st.integers(-(2**31), 2**31 - 1)


@given(LONGS, LONGS.filter(bool))
def test_quotient_and_remainder_of_longs_give_the_dividend_back(a: int, b: int) -> None:
    quotient, remainder = divide(a, b), modulo(a, b)
    assert isinstance(quotient, int)
    assert quotient * b + remainder == a
    assert abs(remainder) < abs(b)
    assert remainder == 0 or (remainder < 0) == (a < 0)


def test_one_double_makes_the_quotient_a_double() -> None:
    assert divide(1, 2) == 0
    assert divide(1.0, 2) == 0.5


@given(LONGS)
def test_not_turns_every_bit_over(x: int) -> None:
    assert bit_not(x) == -(x + 1)


def test_vacant_counts_as_zero_in_calculations_and_differs_from_zero() -> None:
    assert VACANT + 5 == 5
    assert 5 - VACANT == 5
    assert 2.5 * VACANT == 0
    assert -VACANT == 0
    assert VACANT < 1
    zero: object = 0
    assert zero != VACANT


@pytest.mark.parametrize("calculation", [lambda t: t + 1, lambda t: 1 + t, lambda t: t * 2, lambda t: 2 * t])
def test_a_text_refuses_to_be_calculated_with(calculation) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(AlarmError, match="COR-023"):
        calculation(Text("12"))


@pytest.mark.parametrize("value", [2**31, -(2**31) - 1, float("inf")])
def test_a_value_that_no_variable_holds_is_an_alarm(value: float) -> None:
    with pytest.raises(AlarmError, match="COR-004"):
        storable(value)


def test_registers_drop_the_fraction_towards_zero() -> None:
    assert to_long(-2.9) == -2
    assert to_long(VACANT) == 0


@pytest.mark.parametrize("value", [2.5, VACANT, Text("2")])
def test_an_index_must_be_a_whole_number(value: object) -> None:
    assert whole(3.0, "COR-016") == 3
    with pytest.raises(AlarmError, match="COR-016"):
        whole(value, "COR-016")  # type: ignore[arg-type]


def test_mod_and_division_by_zero_are_alarms() -> None:
    for operation in (divide, modulo):
        with pytest.raises(AlarmError, match="COR-004"):
            operation(1, VACANT)
    with pytest.raises(AlarmError, match="COR-054"):
        modulo(7.0, 2)
