"""The alarm lists of the Hartford manual: every number of its two lists is explained in both languages."""

from __future__ import annotations

from functools import cache

import pytest

from polycnc.control.alarm_text import catalogue_of
from polycnc.control.registry import control
from polycnc.machine import load_machine
from polycnc.messages import Catalogue

#: The FANUC list, as the manual prints it (chapter on alarms, 5.1).
FANUC = (
    *(1001, 1002, 1005, 1007, 1008, 1010, 1011, 1012, 1013, 1015, 1019, 1020, 1041, 1042, 1045, 1046, 1047),
    *(1048, 1049, 1051, 1054, 1062, 1063, 1090, 1091, 1092, 1093, 1094, 1095, 1096, 1097, 1098, 1100, 1101),
    *(1102, 1103, 1104, 1105, 2001, 2002, 2004, 2006, 2007, 2008, 2009, 2010, 2012, 2013, 2014, 2017, 2018),
    *(2019, 2021, 2022, 2023, 2024, 2025, 2026, 2027, 2028, 2029, 2031, 2043, 2044, 2045, 2046, 2048, 2049),
    *(2098, 2102),
)
#: The MELDAS list (5.2): devices F0 to F15, F16 to F99, messages K1 to K29; numbers that it prints without a text.
MELDAS = (*range(4000, 4016), *range(3000, 3084), *range(1000, 1029))
RESERVED = (
    *range(4010, 4016), 3051, 3057, 3059, 3060, *range(3064, 3072), *range(3076, 3084), *range(1024, 1029),
)  # fmt: skip
LISTS = {"fanuc-m": FANUC, "meldas-m": MELDAS}


@cache
def texts(control_id: str) -> Catalogue:
    """What a Hartford machining centre can tell on a control."""
    return catalogue_of(control(control_id), load_machine("hartford"))


@pytest.mark.parametrize("control_id", LISTS)
def test_another_machine_knows_none_of_them(control_id: str) -> None:
    other = catalogue_of(control(control_id), load_machine("mill3"))
    assert not {code for code in other if code.isdigit()}


@pytest.mark.parametrize("control_id", LISTS)
@pytest.mark.parametrize("lang", ["en", "zh-TW"])
def test_every_number_of_the_list_has_text_cause_and_remedy(control_id: str, lang: str) -> None:
    for number in LISTS[control_id]:
        assert texts(control_id).text(str(number), lang), number
        assert texts(control_id).note(str(number), "cause", lang), number
        assert texts(control_id).note(str(number), "remedy", lang), number


@pytest.mark.parametrize("control_id", LISTS)
def test_the_catalogue_has_no_machine_alarm_beyond_the_list(control_id: str) -> None:
    numbers = [int(code) for code in texts(control_id) if code.isdigit()]
    assert sorted(numbers) == sorted(LISTS[control_id])


def test_numbers_without_a_text_in_the_manual_say_that_they_are_reserved() -> None:
    told_of = {number: texts("meldas-m").text(str(number), "en") for number in MELDAS}
    assert {number for number, told in told_of.items() if told.startswith("Reserved")} == set(RESERVED)


@pytest.mark.parametrize("control_id", LISTS)
def test_cause_and_remedy_say_more_than_the_text(control_id: str) -> None:
    for number in LISTS[control_id]:
        for lang in ("en", "zh-TW"):
            told = [
                texts(control_id).text(str(number), lang),
                texts(control_id).note(str(number), "cause", lang),
                texts(control_id).note(str(number), "remedy", lang),
            ]
            assert len(set(told)) == 3, (number, told)
