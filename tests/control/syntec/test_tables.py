from __future__ import annotations

import re
from pathlib import Path

import pytest

import polycnc.control.syntec
import polycnc.language.syntec
from polycnc.control.registry import control
from polycnc.control.syntec.alarm_codes import ALARMS, FOREIGN_CODES
from polycnc.control.syntec.codes import ADDRESSES, G_CODES, M_CODES, POWER_ON
from polycnc.control.syntec.macros.functions import FUNCTIONS as EXECUTED
from polycnc.control.syntec.macros.variables import ARGUMENTS
from polycnc.language.syntec.functions import FUNCTIONS
from polycnc.messages import text

#: Every G code that the manual names.
MANUAL = (
    "G0 G1 G2 G3 G2.4 G3.4 G4 G4.1 G5 G5.1 G6.2 G9 G10 G10.6 G10.9 G12.1 G13.1 G15 G16 G17 G18 G19"
    " G22 G23 G28 G29 G30 G31 G31.10 G31.11 G33 G37 G37.2 G37.3 G40 G41 G42 G40.1 G41.1 G42.1 G43 G44"
    " G43.4 G43.5 G45 G46 G47 G48 G49 G50 G51 G50.1 G51.1 G50.2 G51.2 G52 G52.1 G52.2 G53 G53.1 G53.3"
    " G53.6 G54 G59.9 G54.4 G61 G62 G63 G64 G65 G66 G66.1 G67 G68 G69 G68.2 G68.3 G70 G71 G73 G74 G76"
    " G80 G81 G81.1 G81.2 G80.2 G82 G83 G84 G84.48 G85 G86 G87 G88 G89 G90 G91 G92 G92.1 G93 G94 G95"
    " G96 G97 G98 G99 G113 G114.1 G114.3 G120.1 G121 G134 G135 G136 G137.1 G41.2 G42.2 G41.6 G42.6"
    " G28.1"
)
SOURCES = [
    path
    for package in (polycnc.control.syntec, polycnc.language.syntec)
    for path in Path(package.__path__[0]).rglob("*.py")
]
CODE = re.compile(r'"((?:COM|COR|OP|PC)-?\d{3,4})"')
HINT = re.compile(r'"(hint\.[a-z.-]+)"')


def mentioned(pattern: re.Pattern[str]) -> set[str]:
    return {found for path in SOURCES for found in pattern.findall(path.read_text(encoding="utf-8"))}


@pytest.mark.parametrize("code", sorted(mentioned(CODE) | set(ALARMS.values())))
def test_every_alarm_that_can_be_raised_has_its_text_in_both_languages(code: str) -> None:
    entry = control("syntec-mill").catalogue.entry(code)
    assert entry["en"]
    assert entry["zh-TW"]
    assert entry["remedy"]
    assert entry["remedy-zh-TW"]


@pytest.mark.parametrize("hint", sorted(mentioned(HINT) | set(FOREIGN_CODES.values())))
def test_every_hint_has_its_text_in_both_languages(hint: str) -> None:
    assert text(hint, "en") != text(hint, "zh-TW")


def test_no_g_code_is_in_the_table_twice_and_each_acts_or_is_named_as_not_executed() -> None:
    for code, row in G_CODES.items():
        acts = row.handler or row.planner or row.group or row.not_yet or code == "G65"
        assert acts, code


def test_every_code_of_power_on_is_in_the_table_in_its_group() -> None:
    for group, code in POWER_ON.items():
        assert not code or G_CODES[code].group == group


def test_every_modal_group_has_a_code_at_power_on() -> None:
    assert {row.group for row in G_CODES.values() if row.group} <= set(POWER_ON)


@pytest.mark.parametrize("code", MANUAL.split())
def test_every_code_of_the_manual_is_known(code: str) -> None:
    assert code in G_CODES


def test_functions_that_are_not_calculated_are_executed_or_refused_by_name() -> None:
    open_ones = {name for name, function in FUNCTIONS.items() if not function.calculate} - set(EXECUTED)
    assert not open_ones
    assert set(EXECUTED) <= set(FUNCTIONS)


def test_arguments_fill_the_variables_of_the_reference() -> None:
    assert [ARGUMENTS[letter] for letter in "XYZABCIJKUVWQRST"] == [
        24, 25, 26, 1, 2, 3, 4, 5, 6, 21, 22, 23, 17, 18, 19, 20,
    ]  # fmt: skip
    assert not set("GNO") & set(ARGUMENTS)


def test_addresses_and_m_codes_of_the_manual_are_there() -> None:
    assert {"F", "S", "T", "H", "D", "S1"} <= set(ADDRESSES)
    assert {0, 1, 2, 30, 96, 97, 98, 99, 198} <= set(M_CODES)
