"""The variable store of custom macro B."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.control.word_address.macro_b.variables import Registry, SystemRange, format_number
from tests.support import codes, run


@given(
    st.sampled_from([*range(1, 34), *range(100, 200), *range(500, 1000), *range(98000, 98500)]),
    st.integers(-999, 999),
)
def test_every_user_variable_holds_what_was_written(number: int, value: int) -> None:
    channel = run(f"#{number}={value}\nM30\n".replace("=-", "=0-"))
    assert channel.memory.read(number) == value


@pytest.mark.parametrize("number", [34, 99, 200, 499, 4021, 6000])
def test_gaps_between_the_ranges_are_refused(number: int) -> None:
    assert codes(run(f"#1=#{number}\nM30\n")) == ["PS0115"]
    assert codes(run(f"#{number}=1\nM30\n")) == ["PS0115"]


@pytest.mark.parametrize("number", [0, 5001, 5021, 4001, 1000, 3011])
def test_variables_that_can_only_be_read(number: int) -> None:
    assert codes(run(f"#{number}=1\nM30\n")) == ["PS0116"]


@pytest.mark.parametrize("number", [3000, 3006])
def test_variables_that_can_only_be_written(number: int) -> None:
    assert codes(run(f"#1=#{number}\nM30\n")) == ["PS1115"]


def test_a_registry_finds_the_range_of_a_number() -> None:
    low, high = SystemRange(10, 19, name="_LOW"), SystemRange(30, 30)
    registry = Registry([high, low])
    assert [registry.find(n) for n in (9, 10, 19, 20, 30, 31)] == [None, low, low, None, high, None]
    assert registry.names["_LOW"] is low


def test_positions_are_of_the_block_before_and_in_the_unit_of_the_program() -> None:
    channel = run("G20 G0 X2.\n#101=#5001\n#102=#5021\nM30\n")
    assert [channel.memory.read(n) for n in (101, 102)] == pytest.approx([2.0, 2.0])


def test_a_written_offset_holds_from_the_next_absolute_word() -> None:
    channel = run("G0 X1.\n#5221=10\nG91 X1.\nG90 X1.\nM30\n")
    assert channel.coordinates.machine[0] == 11.0


@given(st.decimals(-999, 999, places=3, allow_nan=False), st.integers(0, 3))
def test_printed_numbers_read_back(value: object, decimals: int) -> None:
    text = format_number(float(str(value)), 3, decimals, pads=True)
    assert float(text.replace(" ", "")) == pytest.approx(float(str(value)), abs=0.51 * 10.0**-decimals)


def test_a_vacant_variable_prints_nothing() -> None:
    assert format_number(None, 3, 2, pads=True) == ""
