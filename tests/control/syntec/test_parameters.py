"""The list of parameters of SYNTEC, the module that is written from it, and what macros read by number."""

from __future__ import annotations

import ast
from importlib.resources import files
from pathlib import Path

import pytest

from polycnc.control import registry
from polycnc.control.parameter_module import module_text
from polycnc.control.parameters import BY_NAME, known_parameters
from polycnc.control.syntec.macros.machine_parameters import FILE, long_of
from polycnc.control.syntec.parameters import SyntecParameters
from polycnc.control.syntec.units import decimals
from polycnc.machine.setup.values import Parameters, parameter_key

LIST = known_parameters(registry.control("syntec-mill"))
FOLDER = Path(str(files("polycnc.control"))) / "syntec"


def given(**values: float) -> SyntecParameters:
    """Parameters by number, as `pr17=3`."""
    return SyntecParameters({parameter_key(name[2:]): value for name, value in values.items()})


def test_the_module_is_what_the_list_gives() -> None:
    assert (FOLDER / "parameters.py").read_text(encoding="utf-8") == module_text(FILE, "Syntec")


def test_the_parameters_that_the_list_gives_to_handlers_are_those_that_they_read() -> None:
    modules = [path for path in FOLDER.rglob("*.py") if path.name != "parameters.py"]
    trees = [ast.parse(path.read_text(encoding="utf-8")) for path in modules]
    read = {node.attr for tree in trees for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    assert {each.name for each in LIST if each.read == BY_NAME} <= read
    assert not {each.name for each in LIST if each.read == "not yet"} & read


def test_every_parameter_has_both_languages_and_a_name_and_numbers_of_its_own() -> None:
    keys = [key for parameter in LIST for key in parameter.keys]
    assert all(parameter.texts["en"] and parameter.texts["zh-TW"] for parameter in LIST)
    assert len(set(keys)) == len(keys)
    assert len({parameter.name for parameter in LIST}) == len(LIST)


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
    assert long_of(Parameters(), number) == value


def test_macros_read_a_parameter_of_the_setup_that_the_list_does_not_have() -> None:
    assert long_of(given(pr9999=7.5), 9999) == 7
