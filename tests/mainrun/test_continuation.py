"""A calculation that goes on in time comes to an end, whatever the program waits for."""

from __future__ import annotations

import pytest

import polycnc

CONTROL = "sinumerik-840d"


def test_a_path_that_an_override_of_nothing_holds_for_ever_is_an_alarm() -> None:
    result = polycnc.run("ID=1 DO $AC_OVR=0\nG1 X10 F1000\nM30\n", control=CONTROL)
    assert [alarm.code for alarm in result.alarms] == ["PC0013"]


def test_a_slow_path_is_no_waiting() -> None:
    result = polycnc.run("ID=1 DO $AC_OVR=1\nG1 X10 F100\nM30\n", control=CONTROL)
    assert not result.alarms
    assert result.main_run_s == pytest.approx(600.0, abs=1.0)


def test_cycles_in_which_actions_look_count_as_blocks() -> None:
    text = "ID=1 DO $AC_PARAM[0]=$AA_IM[X]\nG1 X100 F10\nM30\n"
    limited = polycnc.run(text, control=CONTROL, block_limit=20_000)
    assert [alarm.code for alarm in limited.alarms] == ["PC0002"]
    assert limited.main_run_s is not None
    assert 80.0 <= limited.main_run_s <= 111.0  # cycles of 4 ms, looked at each 30 s
    whole = polycnc.run(text.replace("F10", "F1000"), control=CONTROL, block_limit=20_000)
    assert not whole.alarms
