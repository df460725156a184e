"""The parameters of SYNTEC: what axes have, units, and what macros read by number."""

from __future__ import annotations

import pytest

from polycnc.control.syntec.macros.machine_parameters import long_of
from polycnc.control.syntec.parameters import SyntecParameters
from polycnc.control.syntec.units import decimals
from polycnc.machine.setup.values import parameter_key


def given(**values: float) -> SyntecParameters:
    """Parameters by number, as `pr17=3`."""
    return SyntecParameters({parameter_key(name[2:]): value for name, value in values.items()})


def test_each_axis_has_its_value_under_a_number_of_its_own() -> None:
    assert given(pr282=1).diameter_axes[:3] == (0, 1, 0)
    assert given(pr2803=-5000).reference_points_2[1:4] == (None, -5000, None)


def test_a_fraction_of_a_whole_number_is_cut_off() -> None:
    assert given(pr3807=10.9).arc_tolerance == 10
    assert given(pr5809=0.5).normal_shortest == 0.5


@pytest.mark.parametrize(("unit", "metric", "inch"), [(1, 2, 3), (2, 3, 4), (3, 4, 5), (9, 3, 4)])
def test_pr17_says_the_least_input_units(unit: int, metric: int, inch: int) -> None:
    assert decimals(given(pr17=unit), inch=False) == metric
    assert decimals(given(pr17=unit), inch=True) == inch


@pytest.mark.parametrize(
    ("number", "value"), [(17, 2), (3600, 96), (300, 0), (301, None), (4200, 0), (5501, None), (2801, None)]
)
def test_macros_read_a_delivered_value_by_its_number(number: int, value: int | None) -> None:
    assert long_of(given(), number) == value


def test_macros_read_a_parameter_of_the_setup_that_the_list_does_not_have() -> None:
    assert long_of(given(pr9999=7.5), 9999) == 7
