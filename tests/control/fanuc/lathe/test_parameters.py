"""The list of parameters of the lathe, and the module that is written from it."""

from __future__ import annotations

import re
from importlib.resources import files
from pathlib import Path

from polycnc.control import registry
from polycnc.control.fanuc.lathe.parameters import LatheParameters
from polycnc.control.parameter_module import module_text
from polycnc.control.parameters import known_parameters

LATHE = known_parameters(registry.control("fanuc-0i-tf"))
#: A bit or a number of a parameter, as the lathe's modules ask for them.
READ = re.compile(r"\b(?:bit|number|cycle_parameter)\(\s*(\d+)(?:, (\d)\b)?")
CONTROL = Path(str(files("polycnc.control")))


def test_the_module_is_what_the_list_gives() -> None:
    written = (CONTROL / "fanuc/lathe/parameters.py").read_text(encoding="utf-8")
    assert written == module_text("fanuc/lathe/parameters.toml", "Lathe")


def test_every_parameter_that_the_lathe_reads_is_in_the_list() -> None:
    names = {parameter.number for parameter in LATHE}
    numbers = {name.partition("#")[0] for name in names}
    missing = set()
    for module in Path(str(files("polycnc.control.fanuc.lathe"))).rglob("*.py"):
        for number, bit in READ.findall(module.read_text(encoding="utf-8")):
            wanted = f"{number}#{bit}" if bit else number
            if wanted not in (names if bit else numbers):
                missing.add(wanted)
    assert not missing


def test_every_parameter_has_both_languages_and_a_key_and_a_name_of_its_own() -> None:
    assert all(parameter.texts["en"] and parameter.texts["zh-TW"] for parameter in LATHE)
    assert len({parameter.key for parameter in LATHE}) == len(LATHE)
    assert len({parameter.name for parameter in LATHE}) == len(LATHE)
    assert all(parameter.name.isidentifier() for parameter in LATHE)


def test_no_name_is_one_of_the_values_themselves() -> None:
    own = set(dir(LatheParameters.__mro__[1])) | {"given", "axis"}
    assert not own & {parameter.name for parameter in LATHE}
