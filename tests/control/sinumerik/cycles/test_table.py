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


@pytest.mark.parametrize(
    ("call", "code"),
    [
        (
            "POCKET3(10,0,2,-4,30,20,5,0,0,0,4,0,0,500,100,2,{})",
            {"111": "PC0001", "-11": "61002", "17": "61002"},
        ),
        ("POCKET1(10,0,2,-4,,30,20,5,0,0,0,100,500,4,2,0,{})", {"11": "PC0001"}),
        ("CYCLE71(10,2,2,0,0,0,60,20,0,0,8,3,0,500,{})", {"131": "PC0001", "-31": "61002"}),
        ("CYCLE77(10,0,2,,4,40,0,0,4,0,0,500,100,2,{},50)", {"11": "PC0001"}),
        ("CYCLE83(10,0,2,-20,,,5,0,0,0,1,{})", {"11": "PC0001", "-1": "61002"}),
        ("CYCLE84(10,0,2,-20,,0,3,,1,0,300,300,3,0,0,{},5)", {"11": "PC0001", "3": "61002", "-1": "61002"}),
        ("CYCLE99(0,24,-20,,3,0,1,0.1,0,0,3,1,1.5,{},1,1)", {"300301": "PC0001", "300111": "PC0001"}),
        ('CYCLE95("CON",3,0,0,0,0.3,0.2,0.1,{})', {"1009": "61002", "-9": "61002", "313": "61002"}),
        ("SLOT1(10,0,2,,4,1,30,12,0,0,20,0,0,100,500,4,2,0,{})", {"111": "PC0001"}),
    ],
)
def test_digits_of_vari_that_are_not_known(call: str, code: dict[str, str]) -> None:
    for value, alarm in code.items():
        assert codes(run(*START, call.format(value), tools=TOOLS)) == [(alarm, 3)]
