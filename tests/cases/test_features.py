"""The list of functions that work, and what each is called."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest

from polycnc.cases.features import functions, in_manual_order, proved, shipped
from polycnc.control.registry import ids
from polycnc.messages.catalogue import LANGUAGES

if TYPE_CHECKING:
    from pathlib import Path

HAN = re.compile(r"[\u4e00-\u9fff]")


@pytest.mark.parametrize("control", ids())
def test_every_function_that_works_has_a_name_and_its_words(control: str) -> None:
    nameless = set(shipped()[control]) - set(functions())
    assert not nameless, "name them in data/functions"


def test_every_function_is_called_something_in_both_languages() -> None:
    for feature in functions():
        entry = functions().entry(feature)
        assert all(entry[language].strip() for language in LANGUAGES), feature
        assert not HAN.search(entry["en"]), feature


def test_functions_stand_in_the_order_of_the_manual_and_unknown_ones_last() -> None:
    assert in_manual_order({"own.b": 1, "fan.g72": 1, "own.a": 1, "fan.g71": 1}) == [
        "fan.g71",
        "fan.g72",
        "own.a",
        "own.b",
    ]


def test_a_machine_file_is_found_from_the_case_file_that_names_it(tmp_path: Path) -> None:
    (tmp_path / "machines").mkdir()
    (tmp_path / "machines" / "own.toml").write_text('base = "mill4"\n')
    (tmp_path / "mill").mkdir()
    (tmp_path / "mill" / "table.yaml").write_text(
        "- {id: turn, feature: own.a, control: fanuc-m, setup: {machine: ../machines/own.toml},"
        ' program: "G0 A90.\\nM30", expect: {final: {work: {A: 90}}}}\n'
    )
    assert proved(tmp_path) == {"fanuc-m": {"own.a": 1}}
