"""The list of functions that work, and what each is called."""

from __future__ import annotations

import re

import pytest

from polycnc.cases.features import functions, in_manual_order, shipped
from polycnc.control.registry import ids
from polycnc.messages.catalogue import LANGUAGES

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
