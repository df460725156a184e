"""The alarm catalogue: everything that is raised is in it, in both languages."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import polycnc.control.sinumerik
import polycnc.language.sinumerik
from polycnc.control.sinumerik.control import Sinumerik

NUMBER = re.compile(r'"((?:1\d{4}|2[0-2]\d{3}|PC\d{4}))"')
CATALOGUE = Sinumerik().catalogue


def raised() -> set[str]:
    """Alarm codes that stand in the sources of the control and of its language."""
    folders = [
        Path(str(module.__file__)).parent
        for module in (polycnc.control.sinumerik, polycnc.language.sinumerik)
    ]
    sources = [path.read_text(encoding="utf-8") for folder in folders for path in folder.rglob("*.py")]
    return {code for source in sources for code in NUMBER.findall(source)}


def test_every_alarm_that_is_raised_has_a_text() -> None:
    assert raised() - set(CATALOGUE) == set()


@pytest.mark.parametrize("code", sorted(CATALOGUE))
def test_an_alarm_has_text_and_remedy_in_both_languages(code: str) -> None:
    entry = CATALOGUE.entry(code)
    assert set(entry) >= {"en", "zh-TW", "remedy", "remedy-zh-TW"}
    places = [set(re.findall(r"\{\w+\}", entry[field])) for field in ("en", "zh-TW")]
    assert places[0] == places[1]
    assert re.search("[一-鿿]", entry["zh-TW"])
