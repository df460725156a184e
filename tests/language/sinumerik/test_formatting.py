from __future__ import annotations

import pytest

from polycnc.language.sinumerik.formatting import formatted
from polycnc.language.sinumerik.names.values import Axis
from polycnc.messages import AlarmError


@pytest.mark.parametrize(
    ("text", "values", "shown"),
    [
        ("%D", [12.5], "13"),
        ("%4D|%04D", [-7, -7], "  -7|-007"),
        ("%F %.1F %8.2F", [1, 2.25, -3.14159], "1.000000 2.2    -3.14"),
        ("%.2E", [12345.678], "1.23E+04"),
        ("%X %04X", [255, 10], "FF 000A"),
        ("%B%B", [True, 0], "TRUEFALSE"),
        ("%C%C", [65, "Bee"], "AB"),
        ("%S %5S", [Axis("X1"), "ab"], "X1    ab"),
        ("100%%", [], "100%"),
        ("no mark", [], "no mark"),
    ],
)
def test_marks_are_replaced_by_values_in_order(text: str, values: list[object], shown: str) -> None:
    assert formatted(text, values) == shown


@pytest.mark.parametrize(
    ("text", "values", "code"),
    [
        ("%D", [], "14020"),
        ("%D", [1, 2], "14020"),
        ("%D", ["a"], "12150"),
        ("%S", [1], "12150"),
        ("%Q", [1], "12160"),
    ],
)
def test_a_format_that_does_not_fit_is_an_alarm(text: str, values: list[object], code: str) -> None:
    with pytest.raises(AlarmError) as alarm:
        formatted(text, values)
    assert alarm.value.code == code


def test_a_result_longer_than_a_string_is_an_alarm() -> None:
    with pytest.raises(AlarmError) as alarm:
        formatted("%300D", [1])
    assert alarm.value.code == "14099"
