"""The list of parameters of the lathe, and the module that is written from it."""

from __future__ import annotations

import ast
from importlib.resources import files
from pathlib import Path

from polycnc.control import registry
from polycnc.control.fanuc.lathe.parameters import LatheParameters
from polycnc.control.parameter_module import module_text
from polycnc.control.parameters import BY_NAME, known_parameters

LATHE = known_parameters(registry.control("fanuc-0i-tf"))
CONTROL = Path(str(files("polycnc.control")))


def test_the_module_is_what_the_list_gives() -> None:
    written = (CONTROL / "fanuc/lathe/parameters.py").read_text(encoding="utf-8")
    assert written == module_text("fanuc/lathe/parameters.toml", "Lathe")


def test_the_parameters_that_the_list_gives_to_handlers_are_those_that_they_read() -> None:
    modules = [path for path in (CONTROL / "fanuc").rglob("*.py") if path.name != "parameters.py"]
    trees = [ast.parse(path.read_text(encoding="utf-8")) for path in modules]
    read = {node.attr for tree in trees for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    names = {
        how: {each.name for each in LATHE if each.read == how} for how in (BY_NAME, "by number", "not yet")
    }
    assert names[BY_NAME] <= read
    assert not names["not yet"] & read
    assert sum(map(len, names.values())) == len(LATHE)


def test_every_parameter_has_both_languages_and_a_key_and_a_name_of_its_own() -> None:
    assert all(parameter.texts["en"] and parameter.texts["zh-TW"] for parameter in LATHE)
    assert len({parameter.key for parameter in LATHE}) == len(LATHE)
    assert len({parameter.name for parameter in LATHE}) == len(LATHE)
    assert all(parameter.name.isidentifier() for parameter in LATHE)


def test_no_name_is_one_of_the_values_themselves() -> None:
    own = set(dir(LatheParameters.__mro__[1])) | {"given", "axis"}
    assert not own & {parameter.name for parameter in LATHE}
