"""Monitoring of grinding wheels: which signals, and when."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, run

WHEEL = {1: {"radius": 100.0, "type": 400}}


def signals(*lines: str) -> list[tuple[str, float]]:
    result = run(*lines, tools=WHEEL)
    assert not result.alarms
    return [(row["name"], row["value"]) for row in result.rows if row["type"] == "signal"]


def test_a_wheel_within_its_limits_tells_nothing() -> None:
    assert signals("$TC_TPG3[1]=100 $TC_TPG4[1]=10 $TC_TPG5[1]=10", "TMON(1)") == []


@pytest.mark.parametrize("datum", ["$TC_TPG3[1]=100.1", "$TC_TPG4[1]=0.1"])
def test_radius_and_width_have_one_signal(datum: str) -> None:
    assert signals(datum, "TMON(1)") == [("DB34.DBX83.3", 1.0)]


def test_a_monitoring_lasts_over_the_end_of_a_program() -> None:
    assert signals("$TC_TPG3[1]=150", "TMON(1)", "TMOF(0)", "TMOF(0)")[-1] == ("DB34.DBX83.3", 0.0)


@pytest.mark.parametrize("call", ["TMON", "TMON(2)", "TMOF(2)"])
def test_a_wheel_that_is_not_there_is_refused(call: str) -> None:
    assert codes(run(call, tools=WHEEL)) == [("17190", 1)]


def test_a_spindle_that_is_not_there_is_refused() -> None:
    assert codes(run("$TC_TPG1[1]=3", "TMON(1)", tools=WHEEL)) == [("16761", 2)]
