"""The table of cycles: signatures, arguments of every kind, alarms."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import polycnc.control.sinumerik.cycles
from polycnc.control.sinumerik.control import Sinumerik
from polycnc.control.sinumerik.cycles.arguments import FEEDS, NUMBERS, TEXTS
from polycnc.control.sinumerik.cycles.table import CYCLES
from polycnc.language.sinumerik import keywords
from tests.control.sinumerik.support import codes, run

START = ("G17 G90 G94 T1 D1 M6", "S1000 M3 F200")
TOOLS = {1: {"radius": 5.0, "length": 0.0}}


def test_every_cycle_is_a_word_of_the_language() -> None:
    assert set(CYCLES) <= set(keywords.CYCLES)


@pytest.mark.parametrize("name", sorted(CYCLES))
def test_a_signature_names_every_parameter_once(name: str) -> None:
    names = CYCLES[name].signature.split()
    assert len(names) == len(set(names))


def test_a_parameter_is_of_one_kind() -> None:
    assert not NUMBERS & FEEDS
    assert not TEXTS & (NUMBERS | FEEDS)


def test_every_alarm_of_the_cycles_has_a_text() -> None:
    folder = Path(str(polycnc.control.sinumerik.cycles.__file__)).parent
    sources = [path.read_text(encoding="utf-8") for path in folder.rglob("*.py")]
    raised = {code for source in sources for code in re.findall(r'"(6[12]\d{3})"', source)}
    assert len(raised) > 20
    assert raised <= set(Sinumerik().catalogue)


@pytest.mark.parametrize("name", sorted(set(CYCLES) - {"CYCLE800", "CYCLE832"}))
def test_a_cycle_without_arguments_never_breaks(name: str) -> None:
    result = run(*START, name, tools=TOOLS, machine="mill5-ac-table")
    assert len(codes(result)) <= 1


@pytest.mark.parametrize("name", sorted(CYCLES))
@pytest.mark.parametrize("value", ["-1", "0.5", "99999", '"X"'])
def test_a_cycle_with_odd_arguments_alarms_or_runs(name: str, value: str) -> None:
    count = len(CYCLES[name].signature.split())
    result = run(*START, f"{name}({','.join([value] * count)})", tools=TOOLS, machine="mill5-ac-table")
    assert len(codes(result)) <= 1
