"""An alarm that a parameter would prevent says which one."""

from __future__ import annotations

import pytest

import polycnc

LATHE = "fanuc-0i-tf"


def _alarm(program: str, control: str = LATHE, lang: str = "en", **parameters: int) -> str:
    setup = {
        "parameters": {name.replace("_", "#").removeprefix("p"): value for name, value in parameters.items()}
    }
    result = polycnc.run(program, control=control, setup=setup)
    return next((f"{alarm.code} {result.alarm_text(alarm, lang)}" for alarm in result.alarms), "")


CORNER = "O1\nG0 X20. Z0\nG1 Z-20.{} F.2\nX40.\nM30\n"
SHAPE = "O1\nG0 X62. Z2.\nG71 U2. R1.\nG71 P1 Q2 U.4 W.1 F.2\nN1 G0 G42 X20.\nG1 Z-20.\nN2 G40 X60.\nM30\n"
JOINED = "O1\n#1=1\nIF[[#1EQ1]AND[#1NE2]]GOTO9\nM0\nN9M30\n"


@pytest.mark.parametrize("word", [",C1.", ",R1."])
def test_a_corner_with_a_comma_on_a_lathe_names_the_parameter_that_takes_it(word: str) -> None:
    assert "3453#0 = 1" in _alarm(CORNER.format(word))
    assert _alarm(CORNER.format(word), p3453_0=1) == ""


def test_a_chamfer_by_c_names_the_parameter_that_takes_it() -> None:
    assert "3405#4 = 1" in _alarm(CORNER.format(" C1."))
    assert _alarm(CORNER.format(" C1."), p3405_4=1) == ""


def test_compensation_within_a_shape_is_named_with_its_code() -> None:
    assert _alarm(SHAPE).startswith(
        "PS0325 Command not allowed in the shape of a cycle: G42 stands between P and Q"
    )
    assert _alarm(SHAPE, p5106_2=1) == ""


@pytest.mark.parametrize("control", ["fanuc-m", LATHE])
def test_conditions_that_are_joined_name_the_parameter_that_allows_it(control: str) -> None:
    assert "6006#0 = 1" in _alarm(JOINED, control)
    assert _alarm(JOINED, control, p6006_0=1) == ""


def test_a_hint_follows_behind_a_colon_of_its_language() -> None:
    assert "格式錯誤：以 AND" in _alarm(JOINED, lang="zh-TW")
