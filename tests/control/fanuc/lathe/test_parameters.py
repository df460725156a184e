"""The list of parameters of a control."""

from __future__ import annotations

import re
from importlib.resources import files
from pathlib import Path

from polycnc.control import registry
from polycnc.control.parameters import known_parameters

LATHE = known_parameters(registry.control("fanuc-0i-tf"))
#: A bit or a number of a parameter, as the lathe's modules ask for them.
READ = re.compile(r"\b(?:bit|number|cycle_parameter)\(\s*(\d+)(?:, (\d)\b)?")


def test_every_parameter_that_the_lathe_reads_is_in_the_list() -> None:
    names = {parameter.name for parameter in LATHE}
    numbers = {name.partition("#")[0] for name in names}
    missing = set()
    for module in Path(str(files("polycnc.control.fanuc.lathe"))).rglob("*.py"):
        for number, bit in READ.findall(module.read_text(encoding="utf-8")):
            wanted = f"{number}#{bit}" if bit else number
            if wanted not in (names if bit else numbers):
                missing.add(wanted)
    assert not missing


def test_every_parameter_has_both_languages_and_a_key_of_its_own() -> None:
    assert all(parameter.texts["en"] and parameter.texts["zh-TW"] for parameter in LATHE)
    assert len({parameter.key for parameter in LATHE}) == len(LATHE)
