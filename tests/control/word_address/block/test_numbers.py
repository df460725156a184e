"""Typed numbers in internal units."""

from __future__ import annotations

from decimal import ROUND_DOWN, ROUND_HALF_UP, Decimal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.control.word_address.block.numbers import NumberRules, angle_converter, length_converter
from polycnc.language.word_address.words import word_key
from tests.support import ends, run


def length(
    number: str, rules: NumberRules | None = None, *, inch: bool = False, diameter: bool = False
) -> float:
    """A typed length in millimetres."""
    form = word_key("X", number.lstrip("-"))[1:]
    convert = length_converter(form, rules or NumberRules(), inch=inch, diameter=diameter)
    return convert(float(number)) if convert else float(number)


@pytest.mark.parametrize(
    ("number", "inch", "mm"),
    [
        ("1000", False, 1.0),
        ("1.", False, 1.0),
        ("10000", True, 25.4),
        ("1.", True, 25.4),
        ("-5", False, -0.005),
    ],
)
def test_a_number_without_a_point_counts_least_increments(number: str, inch: bool, mm: float) -> None:
    assert length(number, inch=inch) == pytest.approx(mm)


def test_calculator_input_makes_whole_millimetres() -> None:
    assert length("12", NumberRules(calculator=True)) == 12.0


def test_a_diameter_is_halved() -> None:
    assert length("30.", diameter=True) == 15.0
    assert length("30000", diameter=True) == 15.0


@given(st.decimals(-9999, 9999, places=6, allow_nan=False))
def test_digits_below_the_increment_are_cut_off_toward_zero(number: Decimal) -> None:
    kept = number.quantize(Decimal("0.001"), rounding=ROUND_DOWN)
    assert length(f"{number:f}") == pytest.approx(float(kept), abs=1e-9)


@given(st.decimals(-9999, 9999, places=4, allow_nan=False))
def test_a_value_of_an_expression_is_rounded_half_away_from_zero(number: Decimal) -> None:
    kept = number.quantize(Decimal("0.001"), rounding=ROUND_HALF_UP)
    convert = length_converter("#", NumberRules(), inch=False)
    assert convert is not None
    assert convert(float(number)) == pytest.approx(float(kept), abs=1e-9)


@given(st.integers(-9_999_999, 9_999_999))
def test_increments_of_an_angle_are_thousandths_of_a_degree(count: int) -> None:
    convert = angle_converter("", NumberRules())
    assert convert is not None
    assert convert(float(count)) == pytest.approx(count / 1000.0)


@pytest.mark.parametrize(("bit", "mm"), [(0, 10.0), (1, 0.1), (2, 1.0)])
def test_the_input_increment_is_a_parameter(bit: int, mm: float) -> None:
    channel = run("G0 X1000\nM30\n", setup={"parameters": {f"1013#{bit}": 1}})
    assert ends(channel) == [(mm, 0, 0)]
